//! No size, buffer, pool or corner makes the bands panic; this profile keeps overflow checks and debug assertions on.

use fixel::bands::{Bands, Blocking, DepthTest, Pool};
use fixel::depth::{Greater, LessOrEqual, NoDepth};
use fixel::fragment::Flat;
use fixel::screen::{Corner, FineDepth, Position, Shape, SubPx};
use fixel::span::Corners;
use fixel::window::Window;
use proptest::prelude::*;

/// Any number of corners, none included.
#[derive(Debug, Clone)]
struct Any(Vec<Corner<()>>);

impl Corners for Any {
    fn count(&self) -> usize {
        self.0.len()
    }
    fn position(&self, index: usize) -> (i32, i32) {
        let position = self.0.get(index).map_or(Position::default(), |corner| corner.position);
        (position.x().to_bits(), position.y().to_bits())
    }
}

impl Shape for Any {
    type Varying = ();
    fn depth(&self, index: usize) -> i32 {
        self.0.get(index).map_or(0, |corner| corner.depth.to_bits() as i32)
    }
    fn varying(&self, _: usize) {}
}

fn corner() -> impl Strategy<Value = Corner<()>> + Clone {
    let near = (-9000..40000i32, -9000..40000i32);
    (prop_oneof![2 => near, 1 => (any::<i32>(), any::<i32>())], any::<u32>()).prop_map(|((x, y), depth)| Corner {
        position: Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y)),
        depth: FineDepth::from_bits(depth),
        varying: (),
    })
}

fn side() -> impl Strategy<Value = u16> {
    prop_oneof![3 => 0..100u16, 1 => 4000..4100u16, 1 => any::<u16>()]
}

type Lengths = (usize, usize, usize);

fn draw<Z: DepthTest, const CORNERS: usize, const POLYGONS: usize, const BANDS: usize>(
    (width, height): (u16, u16),
    (front, back, depths): Lengths,
    polygons: &[Any],
    single: bool,
) {
    let (mut front, mut back, mut depths) = (vec![0u8; front], vec![0u8; back], vec![0; depths]);
    let bands = if single {
        Bands::single(width, height, &mut front[..], 1)
    } else {
        Bands::new(width, height, [&mut front[..], &mut back[..]], 1)
    };
    let Ok(mut bands) = bands.and_then(|bands| bands.with_depth::<Z>(&mut depths)) else {
        return;
    };
    let mut pool = Pool::<Flat<u8>, CORNERS, POLYGONS, BANDS>::new();
    let mut rows = 0;
    let mut sink = Blocking(|window: Window, band: &[u8]| {
        assert_eq!(band.len(), window.width() * window.height());
        rows += window.height();
        Ok::<(), ()>(())
    });
    let submitted = bands.render(&mut pool, &mut sink, |frame| {
        for polygon in polygons {
            frame.polygon(polygon, Flat(2));
            if let [a, b, c, ..] = polygon.0[..] {
                frame.triangle([a, b, c], Flat(3));
            }
        }
    });
    assert!(submitted.is_ok());
    assert_eq!(bands.each(&mut sink, |_, _| ()), Ok(()));
    if width > 0 {
        assert_eq!(rows, 2 * usize::from(height));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_size_and_any_corners(
        size in (side(), side()), lengths in (0..9000usize, 0..9000usize, 0..9000usize),
        polygons in prop::collection::vec(prop::collection::vec(corner(), 0..9).prop_map(Any), 0..12), single in any::<bool>(),
    ) {
        draw::<NoDepth, 40, 12, 5>(size, lengths, &polygons, single);
        draw::<LessOrEqual, 9, 20, 300>(size, lengths, &polygons, single);
        draw::<Greater, 100, 30, 0>(size, lengths, &polygons, single);
        draw::<Greater, 2, 0, 9>(size, lengths, &polygons, single);
    }
}
