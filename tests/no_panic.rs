//! No input whatsoever panics, overflows or indexes out of bounds: this profile keeps overflow checks and debug
//! assertions on. What is drawn is not looked at here.

use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::{Always, DepthBuffer, LessOrEqual, NoDepth};
use fixel::draw;
use fixel::fragment::Fragment;
use fixel::matrix::Matrix;
use fixel::num::{Block, Word};
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::target::{Buffer, Target};
use fixel::varying::{Linear, Perspective, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;

/// Says that it holds `window` and lends rows of `row` pixels, too few of them or too many.
struct Anywhere<P> {
    window: Window,
    row: Vec<P>,
}

impl<P: Copy> Target for Anywhere<P> {
    type Pixel = P;
    fn window(&self) -> Window {
        self.window
    }
    fn row(&mut self, row: i32) -> &mut [P] {
        assert!(
            (self.window.top..self.window.bottom).contains(&row),
            "row {row} was not offered"
        );
        &mut self.row
    }
}

/// Looks at the values, so that they are computed.
struct Look<V>(std::marker::PhantomData<V>);

impl<V: Varying> Fragment for Look<V> {
    type Varying = V;
    type Pixel = u8;
    fn shade(&self, values: V::Values, below: u8) -> Option<u8> {
        let _ = std::hint::black_box(values);
        Some(below.wrapping_add(1))
    }
}

fn look<V>() -> Look<V> {
    Look(std::marker::PhantomData)
}

/// Any number, the ends of the range and small ones more often.
fn int() -> impl Strategy<Value = i32> + Clone {
    const ENDS: &[i32] = &[i32::MIN, i32::MIN + 1, i32::MAX, 0, 1, -1, 1 << 30, -(1 << 30), 1 << 29];
    prop_oneof![3 => any::<i32>(), 2 => prop::sample::select(ENDS), 2 => -300..300i32, 1 => (0..31u32).prop_map(|b| 1 << b)]
}

fn long() -> impl Strategy<Value = i64> + Clone {
    const ENDS: &[i64] = &[i64::MIN, i64::MIN + 1, i64::MAX, 0, 1, -1, 1 << 62, -(1 << 62), 1 << 61];
    prop_oneof![3 => any::<i64>(), 2 => prop::sample::select(ENDS), 2 => -300..300i64, 1 => (0..63u32).prop_map(|b| 1 << b)]
}

fn exponent() -> impl Strategy<Value = i32> + Clone {
    prop_oneof![4 => -40..40i32, 1 => any::<i32>(), 1 => prop::sample::select(&[i32::MIN, i32::MAX][..])]
}

/// A window anywhere, inverted, empty, as large as numbers allow, or an ordinary one.
fn window() -> impl Strategy<Value = Window> {
    let anywhere = (int(), int(), int(), int()).prop_map(|(l, t, r, b)| Window::new(l, t, r, b));
    let ordinary =
        (-20..20i32, -20..20i32, -3..40i32, -3..40i32).prop_map(|(l, t, w, h)| Window::new(l, t, l + w, t + h));
    prop_oneof![1 => anywhere, 2 => ordinary]
}

/// Positions near the windows, and anywhere within the guard band.
fn positions() -> impl Strategy<Value = [Position; 3]> {
    let near = (-9000..9000i32, -9000..9000i32);
    let one = prop_oneof![2 => near, 1 => (int(), int())];
    let nearest = |(x, y)| Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y));
    prop::array::uniform3(one).prop_map(move |p| p.map(nearest))
}

/// Draws with no depth, and with depth in another window.
fn draw_corners<V: Varying>(corners: [Corner<V>; 3], window: Window, depth_window: Window, length: usize) {
    let mut color = Anywhere {
        window,
        row: vec![0; length],
    };
    draw::triangle(&mut color, &mut NoDepth, corners, &look());
    let mut depth = DepthBuffer::<_, LessOrEqual>::new(Anywhere {
        window: depth_window,
        row: vec![9999; 50],
    });
    draw::triangle(&mut color, &mut depth, corners, &look());
}

/// Everything that makes a view of words `T` and `W`, as numbers.
#[derive(Debug, Clone)]
struct Parts<T> {
    projection: Option<([T; 16], i32)>,
    planes: Vec<([T; 4], i32)>,
    viewport: (i32, i32, u16, u16, bool, bool),
    depth_range: DepthRange,
    behind: Behind,
    cull: Cull,
    vertices: [([T; 4], i32); 3],
    carried: [[i32; 2]; 3],
}

fn parts<T: Word>(word: impl Strategy<Value = T> + Clone + 'static) -> impl Strategy<Value = Parts<T>> {
    use prop::sample::select;
    let point = || (prop::array::uniform4(word.clone()), exponent());
    let near = prop::array::uniform4(-9..10i32).prop_map(|p| (p.map(T::from_i32), 0));
    let vertices = prop_oneof![prop::array::uniform3(point()), prop::array::uniform3(near)];
    let matrix = (prop::array::uniform16(word.clone()), exponent());
    let edges = (int(), int(), any::<u16>(), any::<u16>(), any::<bool>(), any::<bool>());
    let small = (-9..9i32, -9..9i32, 0..70u16, 0..70u16, any::<bool>(), any::<bool>());
    (
        prop::option::of(matrix),
        prop::collection::vec(point(), 0..4),
        prop_oneof![1 => edges, 3 => small],
        select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..]),
        select(&[Behind::Cut, Behind::Divide][..]),
        select(&[Cull::Nothing, Cull::Clockwise, Cull::CounterClockwise][..]),
        vertices,
        prop::array::uniform3(prop::array::uniform2(int())),
    )
        .prop_map(
            |(projection, planes, viewport, depth_range, behind, cull, vertices, carried)| Parts {
                projection,
                planes,
                viewport,
                depth_range,
                behind,
                cull,
                vertices,
                carried,
            },
        )
}

fn draw_view<T: Word, W: Word>(parts: &Parts<T>, window: Window) {
    let (left, top, width, height, up, centers) = parts.viewport;
    let Ok(mut viewport) = Viewport::<W>::new(left, top, width, height) else {
        return;
    };
    viewport = if up { viewport.y_up() } else { viewport };
    viewport = if centers {
        viewport.samples_at_centers()
    } else {
        viewport
    };
    let mut planes = Planes::<T, 3>::default();
    for &(plane, exponent) in &parts.planes {
        planes.push(Block::new(plane, exponent)).unwrap();
    }
    let matrix = |(m, e)| Matrix::from_rows(Block::new(m, e));
    let view = View {
        projection: parts.projection.map_or(Matrix::identity(), matrix),
        planes,
        viewport,
        depth_range: parts.depth_range,
        behind: parts.behind,
        cull: parts.cull,
    };
    draw_kind::<T, W, Linear<2>>(&view, parts, window);
    draw_kind::<T, W, Perspective<2>>(&view, parts, window);
}

fn draw_kind<T: Word, W: Word, V: Carried<Vertex = [i32; 2]>>(view: &View<T, W, 3>, parts: &Parts<T>, window: Window) {
    let vertices = [0, 1, 2].map(|i| {
        let (position, exponent) = parts.vertices[i];
        Vertex {
            position: Block::new(position, exponent),
            carried: parts.carried[i],
        }
    });
    let mut color = Anywhere {
        window,
        row: vec![0; 70],
    };
    let mut depth = DepthBuffer::<_, Always>::new(Anywhere {
        window,
        row: vec![0; 70],
    });
    draw::primitive(view, &mut color, &mut depth, &vertices, &look::<V>());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn any_corners_in_any_window(
        positions in positions(), depths in prop::array::uniform3(any::<u32>()),
        values in prop::array::uniform3(prop::array::uniform2(int())), inverses in prop::array::uniform3(int()),
        over_w in prop::array::uniform3(prop::array::uniform2(int())),
        window in window(), depth_window in window(), length in 0..60usize,
    ) {
        fn corners<V>(positions: [Position; 3], depths: [u32; 3], varying: impl Fn(usize) -> V) -> [Corner<V>; 3] {
            [0, 1, 2].map(|i| Corner {
                position: positions[i],
                depth: FineDepth::from_bits(depths[i]),
                varying: varying(i),
            })
        }
        draw_corners(corners(positions, depths, |_| ()), window, depth_window, length);
        draw_corners(corners(positions, depths, |i| Linear(values[i])), window, depth_window, length);
        let honest = |i: usize| Perspective::new(values[i], inverses[i]);
        draw_corners(corners(positions, depths, honest), window, depth_window, length);
        let nonsense = |i: usize| Perspective { over_w: over_w[i], inverse: inverses[i], values: values[i] };
        draw_corners(corners(positions, depths, nonsense), window, depth_window, length);
    }

    #[test]
    fn any_view_of_narrow_words(parts in parts(int()), window in window()) {
        draw_view::<i32, i32>(&parts, window);
        draw_view::<i32, i64>(&parts, window);
    }

    #[test]
    fn any_view_of_wide_words(parts in parts(long()), window in window()) {
        draw_view::<i64, i32>(&parts, window);
        draw_view::<i64, i64>(&parts, window);
    }

    #[test]
    fn any_buffer(window in window(), stride in prop_oneof![0..80usize, any::<usize>()], length in 0..4000usize) {
        let mut pixels = vec![0u8; length];
        if let Ok(mut buffer) = Buffer::with_stride(&mut pixels, stride, window) {
            for row in window.top..window.bottom {
                // What was accepted has all its rows.
                prop_assert_eq!(buffer.row(row).len(), window.width());
            }
        }
        prop_assert_eq!(window.width() == 0 || window.height() == 0, window.is_empty());
    }
}
