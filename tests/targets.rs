//! A picture and its depths in any memory: windows of their own, rows apart by more than they are wide, more than is needed.
//! Where they go together triangles are drawn by blocks, where not row by row; the bits are the same, and nothing else is
//! touched.

mod row_by_row;

use fixel::depth::{DepthBuffer, FAR, LessOrEqual};
use fixel::draw;
use fixel::fragment::{Fragment, Gouraud565};
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::target::{Buffer, Target};
use fixel::texture::Tiled565;
use fixel::varying::{Color565, Perspective, Perspective32, PerspectiveSpans, Varying};
use fixel::window::Window;
use proptest::prelude::*;
use row_by_row::RowByRow;

/// What is in memory that nothing is drawn to.
const UNTOUCHED: u16 = 0x5a5a;

static BOARD: [[u16; 4]; 4] = [[1, 2, 3, 4], [5, 6, 7, 8], [9, 10, 11, 12], [13, 14, 15, 16]];

/// Where a part of the picture lies.
#[derive(Debug, Clone, Copy)]
struct Layout {
    window: Window,
    /// How much farther apart rows are than they are wide.
    gap: usize,
    /// How much memory follows.
    slack: usize,
}

impl Layout {
    const WHOLE: Self = Layout {
        window: Window::new(-8, -8, 56, 56),
        gap: 0,
        slack: 0,
    };

    fn stride(&self) -> usize {
        self.window.width() + self.gap
    }

    fn memory(&self, filling: u16) -> Vec<u16> {
        vec![filling; self.stride() * self.window.height() + self.slack]
    }

    fn over<'a>(&self, memory: &'a mut [u16]) -> Buffer<'a, u16> {
        Buffer::with_stride(memory, self.stride(), self.window).unwrap()
    }

    /// Where in memory the pixels of `inner` are, in its order.
    fn places(self, inner: Window) -> impl Iterator<Item = usize> {
        let Window { left, top, .. } = self.window;
        (inner.top..inner.bottom).flat_map(move |y| {
            (inner.left..inner.right).map(move |x| (y - top) as usize * self.stride() + (x - left) as usize)
        })
    }
}

/// A corner in subpixels, its depth in steps and what it carries.
type Drawn = ((i32, i32), u16, [u8; 3]);

fn shape<V: Varying>(corners: &[Drawn; 3], varying: impl Fn([u8; 3]) -> V) -> [Corner<V>; 3] {
    corners.map(|((x, y), depth, carried)| Corner {
        position: Position::new(SubPx::from_bits(x), SubPx::from_bits(y)).unwrap(),
        depth: FineDepth::from_bits((depth as u32) << 15),
        varying: varying(carried),
    })
}

/// Texels −16…15 at a 1/w of ¼…1.
fn perspective([s, t, inverse]: [u8; 3]) -> Perspective<2> {
    let texel = |v: u8| (v as i32 - 128) << 13;
    Perspective::new([texel(s), texel(t)], (1 << 28) + inverse as i32 * 3_150_000)
}

fn draw_all(
    color: &mut impl Target<Pixel = u16>,
    depth: &mut impl Target<Pixel = u16>,
    triangles: &[(u8, [Drawn; 3])],
) {
    fn draw<V: Varying>(
        color: &mut impl Target<Pixel = u16>,
        depth: &mut impl Target<Pixel = u16>,
        corners: &[Corner<V>; 3],
        fragment: &impl Fragment<Varying = V, Pixel = u16>,
    ) {
        draw::triangle(color, &mut DepthBuffer::<_, LessOrEqual>::new(depth), corners, fragment);
    }
    for (kind, corners) in triangles {
        match kind {
            0 => {
                let corners = shape::<Color565>(corners, |[r, g, b]| Gouraud565::corner(r, g, b));
                draw(color, depth, &corners, &Gouraud565);
            }
            1 => {
                let corners = shape(corners, |v| Perspective32(perspective(v)));
                draw(color, depth, &corners, &Tiled565::<_, 4, 4>::new(&BOARD));
            }
            _ => {
                let corners = shape(corners, |v| PerspectiveSpans::<2, 64>(perspective(v)));
                draw(color, depth, &corners, &Tiled565::<_, 4, 4>::new(&BOARD));
            }
        }
    }
}

/// Small ones, large ones, and such as reach beyond any window.
fn triangle() -> impl Strategy<Value = (u8, [Drawn; 3])> {
    let place = |size: i32| (-size..size, -size..size);
    let carried = || (any::<u16>(), any::<[u8; 3]>());
    let reach = prop_oneof![Just(1800), Just(6000), Just(30_000)];
    (0..3u8, (-3000..14_000, -3000..14_000), reach)
        .prop_flat_map(move |(kind, first, reach)| {
            let corner = move || (place(reach), carried());
            (Just(kind), Just(first), [corner(), corner(), corner()])
        })
        .prop_map(|(kind, (x, y), corners)| {
            (
                kind,
                corners.map(|((dx, dy), (depth, carried))| ((x + dx, y + dy), depth, carried)),
            )
        })
}

fn layout() -> impl Strategy<Value = Layout> {
    ((-8..56, -8..56), (1..64, 1..64), 0..3usize, 0..40usize).prop_map(|((left, top), (width, height), gap, slack)| {
        Layout {
            window: Window::new(left, top, left + width, top + height).intersect(Layout::WHOLE.window),
            gap,
            slack,
        }
    })
}

/// One layout for both, the same with other memory around it, or two.
fn layouts() -> impl Strategy<Value = (Layout, Layout)> {
    prop_oneof![
        layout().prop_map(|both| (both, both)),
        (layout(), 0..2usize, 0..40usize).prop_map(|(color, gap, slack)| (color, Layout { gap, slack, ..color })),
        (layout(), layout()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn any_memory_has_the_same_bits(
        (color, depth) in layouts(),
        triangles in prop::collection::vec(triangle(), 1..8),
    ) {
        let (mut colors, mut depths) = (Layout::WHOLE.memory(UNTOUCHED), Layout::WHOLE.memory(FAR));
        draw_all(
            &mut RowByRow(Layout::WHOLE.over(&mut colors)),
            &mut RowByRow(Layout::WHOLE.over(&mut depths)),
            &triangles,
        );
        let both = color.window.intersect(depth.window);
        let (mut expected_colors, mut expected_depths) = (color.memory(UNTOUCHED), depth.memory(FAR));
        for (from, (to_color, to_depth)) in
            Layout::WHOLE.places(both).zip(color.places(both).zip(depth.places(both)))
        {
            expected_colors[to_color] = colors[from];
            expected_depths[to_depth] = depths[from];
        }

        let (mut found_colors, mut found_depths) = (color.memory(UNTOUCHED), depth.memory(FAR));
        draw_all(&mut color.over(&mut found_colors), &mut depth.over(&mut found_depths), &triangles);
        prop_assert!(found_colors == expected_colors, "colours");
        prop_assert!(found_depths == expected_depths, "depths");
    }
}
