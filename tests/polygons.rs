//! A clipped triangle is drawn as one polygon, and that polygon has the pixels of its fan by exact geometry.

mod exact;
mod naive;
mod strict;

use exact::block;
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::Flat;
use fixel::matrix::Matrix;
use fixel::num::{Scaled, Word};
use fixel::span::Corners;
use fixel::view::{Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;
use strict::StrictTarget;

const WIDTH: i32 = 64;
const HEIGHT: i32 = 48;

type Point = [f64; 4];

fn view<T: Word, W: Word>(projection: Matrix<T>, depth_range: DepthRange, behind: Behind) -> View<T, W, 3> {
    let viewport = Viewport::new(0, 0, WIDTH as u16, HEIGHT as u16).unwrap();
    View {
        projection,
        planes: Planes::default(),
        viewport,
        depth_range,
        behind,
        cull: Cull::Nothing,
    }
}

/// What is drawn of a triangle is what the obviously correct rasterizer says of the polygon's corners.
fn check_polygon<T: Word, W: Word>(view: &View<T, W, 3>, triangle: [Point; 3]) -> Result<(), TestCaseError> {
    let vertices = triangle.map(|p| Vertex {
        position: block(p),
        carried: (),
    });
    let mut fans = Vec::new();
    view.project::<()>(&vertices, |polygon| {
        let corners: Vec<_> = (0..polygon.count()).map(|i| polygon.position(i)).collect();
        fans.push(
            (2..corners.len())
                .map(|i| [corners[0], corners[i - 1], corners[i]])
                .collect::<Vec<_>>(),
        );
    });
    for fan in &fans {
        let areas: Vec<_> = fan.iter().map(fixel::span::doubled_area).collect();
        // Rounding may have left a corner a subpixel inside the others.
        prop_assume!(areas.iter().all(|&a| a >= 0) || areas.iter().all(|&a| a <= 0));
    }
    let mut target = StrictTarget::new(Window::new(0, 0, WIDTH, HEIGHT), true);
    draw::primitive(view, &mut target, &mut NoDepth, &vertices, &Flat(b'#'));
    let picture = target.picture();
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let covered = |fan: &Vec<_>| fan.iter().filter(|&&t| naive::covers(t, x, y)).count();
            prop_assert!(
                fans.iter().all(|fan| covered(fan) <= 1),
                "({}, {}) is twice in one of {:?}",
                x,
                y,
                fans
            );
            let expected = fans.iter().any(|fan| covered(fan) == 1);
            let drawn = picture[y as usize].as_bytes()[x as usize] == b'#';
            prop_assert_eq!(drawn, expected, "({}, {}) of {:?}", x, y, fans);
        }
    }
    Ok(())
}

fn frustum<T: Word>() -> Matrix<T> {
    Matrix::frustum([-1, 1, -1, 1, 1, 8].map(Scaled::from_integer)).unwrap()
}

fn depth_range() -> impl Strategy<Value = DepthRange> {
    prop::sample::select(&[DepthRange::ZeroToOne, DepthRange::MinusOneToOne, DepthRange::Unlimited][..])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn polygons_are_their_fans(
        triangle in prop::array::uniform3((-6.0..6.0f64, -6.0..6.0f64, -9.0..3.0f64)), range in depth_range(),
        behind in prop::sample::select(&[Behind::Cut, Behind::Divide][..]),
        normals in prop::collection::vec(prop::array::uniform4(-3.0..3.0f64), 0..4),
    ) {
        let triangle = triangle.map(|(x, y, z)| [x, y, z, 1.0]);
        let mut narrow = view::<i32, i32>(frustum(), range, behind);
        let mut wide = view::<i64, i64>(frustum(), range, behind);
        for &normal in &normals {
            narrow.planes.push(block(normal)).unwrap();
            wide.planes.push(block(normal)).unwrap();
        }
        check_polygon(&narrow, triangle)?;
        check_polygon(&wide, triangle)?;
    }
}
