//! A picture drawn in bands has the bits of the picture drawn whole, whatever the height of the bands, the size of the pool
//! and the way it is sent.

mod exact;

use std::convert::Infallible;

use exact::{block, scaled};
use fixel::bands::{Bands, Blocking, DepthTest, Pool, Sink};
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Depth, DepthBuffer, FAR, LessOrEqual, NoDepth};
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Compact, Flat, Fragment};
use fixel::matrix::Matrix;
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::target::Buffer;
use fixel::varying::{Linear, Perspective};
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;

const WIDTH: u16 = 37;
const HEIGHT: u16 = 29;
const PIXELS: usize = WIDTH as usize * HEIGHT as usize;
const BACKGROUND: u32 = 7;

/// Mixes all bits of the values with what is below, so that order and every bit count; a field differs from one primitive to
/// the next.
#[derive(Debug, Clone, Copy)]
struct Mix(u32);

impl Fragment for Mix {
    type Varying = (Linear<1>, Perspective<2>);
    type Pixel = u32;
    fn shade(&self, ([a], [b, c]): ([i32; 1], [i32; 2]), below: u32) -> Option<u32> {
        let new = below.rotate_left(7) ^ a as u32 ^ (b as u32).rotate_left(11) ^ (c as u32).rotate_left(22);
        (a & 15 != 3).then_some(new ^ self.0)
    }
}

/// What vertices carry for [`Mix`].
type Carried = ([i32; 1], [i32; 2]);

/// A triangle in eye space, and one on the screen with the same colour.
#[derive(Debug, Clone)]
struct Primitive {
    corners: [[f64; 4]; 3],
    carried: [Carried; 3],
    on_screen: [(i32, i32, u32); 3],
    color: u32,
}

fn primitive() -> impl Strategy<Value = Primitive> {
    // From a few pixels to far beyond the picture, and behind the camera: polygons of three to nine corners.
    let near = (-9.0..9.0f64, -9.0..9.0f64, -12.0..3.0f64);
    let corner = near.prop_map(|(x, y, z)| [x, y, z, 1.0]);
    let value = || -(1 << 30)..=1 << 30;
    let carried = ((value(),), (value(), value())).prop_map(|((a,), (b, c))| ([a], [b, c]));
    let on_screen = (-9000..18000i32, -9000..18000i32, 0..65536u32 << 15);
    (
        prop::array::uniform3(corner),
        prop::array::uniform3(carried),
        prop::array::uniform3(on_screen),
        any::<u32>(),
    )
        .prop_map(|(corners, carried, on_screen, color)| Primitive {
            corners,
            carried,
            on_screen,
            color,
        })
}

type Eye = View<i32, i32, 1>;

fn view() -> Eye {
    let mut planes = Planes::default();
    planes.push(block([0.3, 1.0, 0.2, 5.0])).unwrap();
    View {
        projection: Matrix::frustum([-0.5, 0.5, -0.4, 0.4, 0.5, 30.0].map(scaled)).unwrap(),
        planes,
        viewport: Viewport::new(-3, 2, 44, 25).unwrap().y_up().samples_at_centers(),
        depth_range: DepthRange::MinusOneToOne,
        behind: Behind::Cut,
        cull: Cull::Nothing,
    }
}

impl Primitive {
    fn vertices(&self) -> [Vertex<i32, Carried>; 3] {
        [0, 1, 2].map(|i| Vertex {
            position: block(self.corners[i]),
            carried: self.carried[i],
        })
    }

    fn screen(&self) -> [Corner<<Mix as Fragment>::Varying>; 3] {
        [0, 1, 2].map(|i| {
            let (x, y, depth) = self.on_screen[i];
            let ([a], values) = self.carried[i];
            Corner {
                position: Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y)),
                depth: FineDepth::from_bits(depth),
                varying: (Linear([a]), Perspective::new(values, (1 << 30) - (a.abs() >> 2))),
            }
        })
    }
}

/// A fragment program that is made of a [`Mix`].
trait Mixed: Fragment<Varying = <Mix as Fragment>::Varying, Pixel = u32> + Copy {
    fn of(mix: Mix) -> Self;
}

impl Mixed for Mix {
    fn of(mix: Mix) -> Self {
        mix
    }
}

impl Mixed for Compact<Mix> {
    fn of(mix: Mix) -> Self {
        Compact(mix)
    }
}

fn whole<F: Mixed, D: Depth>(scene: &[Primitive], depth: &mut D) -> Vec<u32> {
    let mut picture = vec![BACKGROUND; PIXELS];
    let mut color = Buffer::new(&mut picture, WIDTH, HEIGHT).unwrap();
    for primitive in scene {
        draw::primitive(
            &view(),
            &mut color,
            depth,
            &primitive.vertices(),
            &F::of(Mix(primitive.color)),
        );
        draw::triangle(&mut color, depth, primitive.screen(), &F::of(Mix(!primitive.color)));
    }
    picture
}

/// Takes a band while another is drawn, and gives it back when it is waited for.
#[derive(Default)]
struct Panel {
    picture: Vec<u32>,
    sent: usize,
}

impl<'b> Sink<u32, &'b mut [u32]> for Panel {
    type Transfer = (Window, &'b mut [u32]);
    type Error = Infallible;

    fn send(&mut self, window: Window, band: &'b mut [u32]) -> Self::Transfer {
        self.sent += 1;
        assert_eq!(self.sent, 1, "one at a time");
        (window, band)
    }

    /// Looks at the pixels as late as it can.
    fn wait(&mut self, (window, band): Self::Transfer) -> (&'b mut [u32], Result<(), Infallible>) {
        self.sent -= 1;
        assert_eq!(
            self.picture.len(),
            window.top as usize * usize::from(WIDTH),
            "from the top"
        );
        self.picture
            .extend_from_slice(&band[..window.width() * window.height()]);
        (band, Ok(()))
    }
}

/// Two frames in bands of `rows` rows; the second one's picture, and how often it was submitted.
fn in_bands<F: Mixed, Z: DepthTest, const CORNERS: usize, const POLYGONS: usize, const BANDS: usize>(
    scene: &[Primitive],
    rows: u16,
    double: bool,
) -> (Vec<u32>, u32) {
    let cells = usize::from(WIDTH) * usize::from(rows);
    let (mut front, mut back, mut depths) = (vec![0; cells], vec![0; cells + 5], vec![0; cells]);
    let bands = if double {
        Bands::new(WIDTH, HEIGHT, [&mut front[..], &mut back[..]], BACKGROUND)
    } else {
        Bands::single(WIDTH, HEIGHT, &mut front[..], BACKGROUND)
    };
    let mut bands = bands.unwrap().with_depth::<Z>(&mut depths).unwrap();
    assert_eq!(bands.rows(), rows);
    let mut pool = Box::new(Pool::<F, CORNERS, POLYGONS, BANDS>::new());
    let view = view();
    let mut last = None;
    for _ in 0..2 {
        let mut panel = Panel::default();
        let Ok(passes) = bands.render(&mut pool, &mut panel, |frame| {
            for primitive in scene {
                frame.primitive(&view, &primitive.vertices(), F::of(Mix(primitive.color)));
                frame.triangle(primitive.screen(), F::of(Mix(!primitive.color)));
            }
        });
        last = Some((panel.picture, passes));
    }
    last.unwrap()
}

fn check<F: Mixed, Z: DepthTest>(
    scene: &[Primitive],
    whole: &[u32],
    rows: u16,
    double: bool,
) -> Result<(), TestCaseError> {
    let roomy = in_bands::<F, Z, 4000, 999, 64>(scene, rows, double);
    prop_assert!(roomy.0 == whole, "bands of {} rows", rows);
    prop_assert_eq!(roomy.1, 1);
    let tight = in_bands::<F, Z, 24, 7, 64>(scene, rows, double);
    prop_assert!(tight.0 == whole, "bands of {} rows, several passes", rows);
    let few = in_bands::<F, Z, 4000, 999, 2>(scene, rows, double);
    prop_assert!(few.0 == whole, "bands of {} rows, two in a pass", rows);
    prop_assert_eq!(few.1, u32::from(HEIGHT.div_ceil(rows).div_ceil(2)));
    let none = in_bands::<F, Z, 0, 0, 0>(scene, rows, double);
    prop_assert!(none.0 == whole, "bands of {} rows without a pool", rows);
    prop_assert_eq!(none.1, u32::from(HEIGHT.div_ceil(rows)));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn bands_of_every_height_have_the_bits_of_the_whole(
        scene in prop::collection::vec(primitive(), 1..16), double in any::<bool>(),
    ) {
        let mut depths = vec![FAR; PIXELS];
        let mut depth = DepthBuffer::<_, LessOrEqual>::new(Buffer::new(&mut depths, WIDTH, HEIGHT).unwrap());
        let (plain, tested) = (whole::<Mix, _>(&scene, &mut NoDepth), whole::<Mix, _>(&scene, &mut depth));
        for rows in 1..=HEIGHT {
            check::<Mix, NoDepth>(&scene, &plain, rows, double)?;
            check::<Mix, LessOrEqual>(&scene, &tested, rows, double)?;
        }
    }

    #[test]
    fn by_less_code_as_well(scene in prop::collection::vec(primitive(), 1..16), rows in 1..=HEIGHT) {
        let plain = whole::<Compact<Mix>, _>(&scene, &mut NoDepth);
        check::<Compact<Mix>, NoDepth>(&scene, &plain, rows, false)?;
    }
}

#[test]
fn what_is_too_small_or_too_large_is_an_error() {
    let rows = |width, height, pixels, depths| {
        let (mut front, mut back, mut depths) = (vec![0u8; pixels], vec![0u8; pixels + 1], vec![0; depths]);
        let bands = Bands::new(width, height, [&mut front[..], &mut back[..]], 0)?;
        Ok(bands.with_depth::<LessOrEqual>(&mut depths)?.rows())
    };
    assert_eq!(rows(320, 240, 320 * 16, 320 * 16), Ok(16));
    assert_eq!(rows(320, 240, 320 * 16 + 319, 320 * 17), Ok(16));
    assert_eq!(rows(320, 240, 320 * 16, 320 * 9), Ok(9));
    assert_eq!(rows(320, 240, 320 * 500, 320 * 500), Ok(240));
    assert_eq!(rows(4096, 4096, 4096, 4096), Ok(1));
    assert_eq!(rows(320, 240, 319, 320), Err(Error::BufferTooSmall));
    assert_eq!(rows(320, 240, 320, 319), Err(Error::BufferTooSmall));
    assert_eq!(rows(4097, 1, 5000, 5000), Err(Error::TooLarge));
    assert_eq!(rows(1, 4097, 5000, 5000), Err(Error::TooLarge));
    assert_eq!(rows(0, 0, 0, 0), Ok(1));
}

/// A display that fails at its third band.
#[test]
fn a_failing_sink_ends_the_frame_and_leaves_the_buffers() {
    for double in [true, false] {
        let (mut front, mut back) = ([0; 4], [0; 4]);
        let bands = if double {
            Bands::new(4, 6, [&mut front[..], &mut back[..]], 0)
        } else {
            Bands::single(4, 6, &mut front[..], 0)
        };
        let mut bands = bands.unwrap();
        let mut pool = Pool::<Flat<u8>, 3, 1, 6>::new();
        let corners = [(0, 0), (0, 12), (12, 0)].map(|(x, y)| Position::from_pixels(x, y).flat());
        let mut frame = |failing: i32| {
            let mut sent = Vec::new();
            let mut sink = Blocking(|window: Window, band: &[u8]| {
                sent.extend_from_slice(band);
                if window.top == failing { Err(window.top) } else { Ok(()) }
            });
            let done = bands.render(&mut pool, &mut sink, |frame| frame.triangle(corners, Flat(1)));
            (done, sent.len())
        };
        assert_eq!(frame(2).0, Err(2));
        assert_eq!(frame(5), (Err(5), 24));
        assert_eq!(frame(-1), (Ok(1), 24));
    }
}

/// A pool that is too small is used for fewer bands; with less to draw, for more again.
#[test]
fn the_pool_takes_as_many_bands_as_fit() {
    let mut memory = [0; 8];
    let mut bands = Bands::single(8, 64, &mut memory[..], 0).unwrap();
    let mut pool = Pool::<Flat<u8>, 30, 10, 64>::new();
    let mut sink = Blocking(|_, _: &[u8]| Ok::<(), Infallible>(()));
    let mut passes = |triangles: i16| {
        let Ok(passes) = bands.render(&mut pool, &mut sink, |frame| {
            for i in 0..triangles {
                let corners = [(0, 2 * i), (0, 2 * i + 2), (8, 2 * i)];
                frame.triangle(corners.map(|(x, y)| Position::from_pixels(x, y).flat()), Flat(1));
            }
        });
        (passes, pool.used())
    };
    assert_eq!(passes(10), (1, (30, 10)));
    // 64 and 32 bands do not fit, 16 do.
    assert_eq!(passes(32), (6, (24, 8)));
    assert_eq!(passes(32), (4, (24, 8)));
    assert_eq!(passes(0), (3, (0, 0)));
    assert_eq!(passes(0), (1, (0, 0)));
}
