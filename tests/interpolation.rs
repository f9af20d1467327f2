//! What is carried from the corners to the pixels: near the exact value, in the range of the corners, the same bits in
//! any window.

mod exact;
mod naive;
mod triangles;

use exact::block;
use fixel::clip::{Behind, DepthRange, Planes};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::matrix::Matrix;
use fixel::num::Word;
use fixel::target::Buffer;
use fixel::varying::{Linear, Perspective, Varying};
use fixel::view::{Carried, Cull, Vertex, View};
use fixel::viewport::Viewport;
use fixel::window::Window;
use proptest::prelude::*;
use triangles::{Case, Keep, Triangle, cases, fine_error, positions, stated_error, values};

/// Units that a perspective quotient may be off by itself: one for rounding it down, two for value/w cut to 32 bits
/// before it is multiplied by the reciprocal; and 2^-30 of the value for the 32 bits of the reciprocal and of 1/w.
const QUOTIENT: f64 = 3.0;

/// Units that a constant may lose where planes cut its triangle: half a unit of value/w and of 1/w, over a 1/w that is
/// down to some 1/4000 of the polygon's largest (the guard band cuts near w = |x|/256, far corners are at w = 12).
const CLIPPED_CONSTANT: i64 = 4096;

fn triangle<V>(case: &Case, varyings: [V; 3]) -> Triangle<V> {
    Triangle {
        corners: case.corners,
        depths: [0; 3],
        varyings,
    }
}

fn check_linear<W: Word>(case: &Case, corner: [i32; 3]) -> Result<(), TestCaseError> {
    let wide = corner.map(i64::from);
    let (least, most) = (*corner.iter().min().unwrap(), *corner.iter().max().unwrap());
    for ((x, y), [value]) in values::<W, _>(&triangle(case, corner.map(|v| Linear([v]))), case.window) {
        prop_assert!(
            (least..=most).contains(&value),
            "{} is out of {}..={}",
            value,
            least,
            most
        );
        let (numerator, area) = naive::value(case.corners, wide, x, y);
        let error = (value as i128 * area - numerator) as f64 / area as f64;
        let stated = stated_error(case.corners, wide, (x, y));
        prop_assert!(error.abs() <= stated, "({}, {}) is {} off, not {}", x, y, error, stated);
    }
    Ok(())
}

/// The exact value at a pixel of what is `values` at corners with 1/w `inverses`, and how far the computed one may be
/// off: by the errors of value/w and of 1/w over the pixel's 1/w, and by the quotient's own. `None` where 1/w is
/// all error.
fn exact_perspective(case: &Case, values: [i32; 3], inverses: [i32; 3], at: (i32, i32)) -> Option<(f64, f64)> {
    let over_w = [0, 1, 2].map(|i| values[i] as i64 * inverses[i] as i64);
    let (numerator, area) = naive::value(case.corners, over_w, at.0, at.1);
    let (inverse, _) = naive::value(case.corners, inverses.map(i64::from), at.0, at.1);
    let (truth, one) = (numerator as f64 / inverse as f64, (1 << 30) as f64);
    let fine_over_w = fine_error(case.corners, over_w.map(|v| v >> 30), at);
    let fine_inverse = fine_error(case.corners, inverses.map(i64::from), at);
    // 1/w may be too small by its own error; half a unit is the rounding of value/w at the corners.
    let least = (inverse as f64 / area as f64).abs() - fine_inverse;
    let bound = one / least * (fine_over_w + 0.5 + fine_inverse * truth.abs() / one) + QUOTIENT + truth.abs() / one;
    (least > fine_inverse).then_some((truth, bound))
}

fn check_perspective<W: Word>(case: &Case, corner: [i32; 3], inverses: [i32; 3]) -> Result<(), TestCaseError> {
    let (least, most) = (*corner.iter().min().unwrap(), *corner.iter().max().unwrap());
    let shape = triangle(case, [0, 1, 2].map(|i| Perspective::new([corner[i]], inverses[i])));
    for (at, [value]) in values::<W, _>(&shape, case.window) {
        prop_assert!(
            (least..=most).contains(&value),
            "{} is out of {}..={}",
            value,
            least,
            most
        );
        if let Some((truth, bound)) = exact_perspective(case, corner, inverses, at) {
            prop_assert!(
                (value as f64 - truth).abs() <= bound,
                "{:?}: {} is not {} ± {}",
                at,
                value,
                truth,
                bound
            );
        }
    }
    Ok(())
}

/// Up to 2^30 either way, the domain of a varying.
fn value() -> impl Strategy<Value = i32> + Clone {
    prop_oneof![3 => -(1 << 30)..=1 << 30, 1 => Just(1 << 30), 1 => Just(-(1 << 30)), 2 => 0..255 << 16, 1 => -5..5i32]
}

/// 1/w of three corners of one sign, the largest 1 and the others not under 1/1000 of it.
fn inverses() -> impl Strategy<Value = [i32; 3]> {
    let one = (0.0..9.96f64).prop_map(|power| ((1 << 30) as f64 * (-power).exp2()) as i32);
    (prop::array::uniform2(one), 0..3usize, any::<bool>()).prop_map(|([a, b], turn, negative)| {
        let mut all = [1 << 30, a, b];
        all.rotate_left(turn);
        all.map(|v| if negative { -v } else { v })
    })
}

/// The values of all of the picture's pixels, of a triangle seen from the origin with a frustum of 90°.
fn through_view<T: Word, V>(eye: [[f64; 3]; 3], carried: [[i32; 1]; 3], range: DepthRange) -> Vec<((i32, i32), i32)>
where
    V: Carried<Vertex = [i32; 1]> + Varying<Values = [i32; 1]>,
{
    let projection = Matrix::<T>::frustum([-0.5, 0.5, -0.5, 0.5, 0.5, 30.0].map(exact::scaled)).unwrap();
    let viewport = Viewport::<i32>::new(0, 0, 32, 32).unwrap();
    let (behind, cull) = (Behind::Cut, Cull::Nothing);
    let view = View::<T, i32, 0> {
        projection,
        planes: Planes::default(),
        viewport,
        depth_range: range,
        behind,
        cull,
    };
    let window = Window::new(0, 0, 32, 32);
    let mut pixels = vec![None; 32 * 32];
    let mut target = Buffer::strip(&mut pixels, window).unwrap();
    let vertices = [0, 1, 2].map(|i| {
        let [x, y, z] = eye[i];
        Vertex {
            position: block([x, y, z, 1.0]),
            carried: carried[i],
        }
    });
    draw::primitive(
        &view,
        &mut target,
        &mut NoDepth,
        &vertices,
        &Keep::<V>(std::marker::PhantomData),
    );
    positions(window)
        .zip(pixels)
        .filter_map(|(at, v)| Some((at, v?[0])))
        .collect()
}

/// Two draws of the same, in a window and in a part of it, get the same bits.
fn check_part<V: Varying<Values: PartialEq + std::fmt::Debug>>(
    shape: &Triangle<V>,
    window: Window,
    part: Window,
) -> Result<(), TestCaseError> {
    let mut whole = values::<i32, _>(shape, window);
    whole.retain(|&((x, y), _)| part.left <= x && x < part.right && part.top <= y && y < part.bottom);
    prop_assert_eq!(whole, values::<i32, _>(shape, part));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn linear_values_are_near_the_exact_ones(case in cases(4096), wide in cases(32700), corner in prop::array::uniform3(value())) {
        check_linear::<i32>(&case, corner)?;
        check_linear::<i64>(&wide, corner)?;
    }
    #[test]
    fn perspective_values_are_near_the_exact_ones(
        case in cases(4096), wide in cases(32700), corner in prop::array::uniform3(value()), inverses in inverses(),
    ) {
        check_perspective::<i32>(&case, corner, inverses)?;
        check_perspective::<i64>(&wide, corner, inverses)?;
    }

    /// With 1/w of both signs the pole is inside: no panic, and near the exact value far from it.
    #[test]
    fn mixed_signs_saturate(case in cases(60), corner in prop::array::uniform3(value()), inverses in prop::array::uniform3(value())) {
        let shape = triangle(&case, [0, 1, 2].map(|i| Perspective::new([corner[i]], inverses[i])));
        for (at, [value]) in values::<i32, _>(&shape, case.window) {
            if let Some((truth, bound)) = exact_perspective(&case, corner, inverses, at) {
                let truth = truth.clamp(i32::MIN as f64, i32::MAX as f64);
                prop_assert!((value as f64 - truth).abs() <= bound, "{:?}: {} is not {} ± {}", at, value, truth, bound);
            }
        }
    }

    #[test]
    fn a_constant_stays_constant(case in cases(4096), v in value(), inverses in inverses()) {
        for (at, [value]) in values::<i32, _>(&triangle(&case, [Linear([v]); 3]), case.window) {
            prop_assert_eq!(value, v, "{:?}", at);
        }
        for (at, [value]) in values::<i32, _>(&triangle(&case, inverses.map(|i| Perspective::new([v], i))), case.window) {
            prop_assert_eq!(value, v, "{:?}", at);
        }
    }

    /// Also where the camera is inside the triangle's plane and the near plane cuts corners off.
    #[test]
    fn a_constant_stays_constant_through_clipping(
        eye in prop::array::uniform3((-9.0..9.0f64, -9.0..9.0f64, -12.0..6.0f64)), v in value(),
        range in prop::sample::select(&[DepthRange::MinusOneToOne, DepthRange::Unlimited][..]),
    ) {
        let (eye, carried) = (eye.map(|(x, y, z)| [x, y, z]), [[v]; 3]);
        let near = |value: i32| (value as i64 - v as i64).abs() <= CLIPPED_CONSTANT;
        for (at, value) in through_view::<i32, Linear<1>>(eye, carried, range) {
            prop_assert!(near(value), "linear {:?}: {} instead of {}", at, value, v);
        }
        for (at, value) in through_view::<i64, Linear<1>>(eye, carried, range) {
            prop_assert!(near(value), "linear, wide words, {:?}: {} instead of {}", at, value, v);
        }
        for (at, value) in through_view::<i32, Perspective<1>>(eye, carried, range) {
            prop_assert!(near(value), "perspective {:?}: {} instead of {}", at, value, v);
        }
    }

    /// Whatever window of a picture is drawn, its pixels have the bits of the whole one.
    #[test]
    fn any_window_has_the_same_bits(
        case in cases(200), corner in prop::array::uniform3(prop::array::uniform2(value())), inverses in prop::array::uniform3(value()),
        left in -30..30i32, top in -30..30i32, width in 1..30i32, height in 1..30i32,
    ) {
        let (window, part) = (Window::new(-60, -60, 60, 60), Window::new(left, top, left + width, top + height));
        check_part(&triangle(&case, corner.map(Linear)), window, part)?;
        check_part(&triangle(&case, [0, 1, 2].map(|i| Perspective::new(corner[i], inverses[i]))), window, part)?;
    }

    /// With one w everywhere, perspective is linear: to a unit per pixel of the span, which only `Linear` may lose.
    #[test]
    fn without_perspective_both_kinds_agree(case in cases(4096), corner in prop::array::uniform3(value())) {
        let linear = values::<i32, _>(&triangle(&case, corner.map(|v| Linear([v]))), case.window);
        let other = values::<i32, _>(&triangle(&case, corner.map(|v| Perspective::new([v], 1 << 30))), case.window);
        for ((at, [a]), (_, [b])) in linear.into_iter().zip(other) {
            let bound = 2.0 * stated_error(case.corners, corner.map(i64::from), at);
            prop_assert!((a as i64 - b as i64).abs() as f64 <= bound, "{:?}: {} and {}", at, a, b);
        }
    }
}
