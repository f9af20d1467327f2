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

fn triangle<V>(case: &Case, varyings: [V; 3]) -> Triangle<V> {
    Triangle { corners: case.corners, depths: [0; 3], varyings }
}

fn check_linear<W: Word>(case: &Case, corner: [i32; 3]) -> Result<(), TestCaseError> {
    let wide = corner.map(i64::from);
    let (least, most) = (*corner.iter().min().unwrap(), *corner.iter().max().unwrap());
    for ((x, y), [value]) in values::<W, _>(&triangle(case, corner.map(|v| Linear([v]))), case.window) {
        prop_assert!((least..=most).contains(&value), "{} is out of {}..={}", value, least, most);
        let (numerator, area) = naive::value(case.corners, wide, x, y);
        let error = (value as i128 * area - numerator) as f64 / area as f64;
        if let Some(stated) = stated_error(case.corners, wide, (x, y)) {
            prop_assert!(error.abs() <= stated, "({}, {}) is {} off, not {}", x, y, error, stated);
        }
    }
    Ok(())
}

/// The exact value at a pixel of what is `values` at corners with 1/w `inverses`: numerator and denominator. And the
/// largest inverse over the pixel's.
fn exact_perspective(case: &Case, values: [i32; 3], inverses: [i32; 3], (x, y): (i32, i32)) -> (i128, i128, f64) {
    let over_w = [0, 1, 2].map(|i| values[i] as i64 * inverses[i] as i64);
    let (numerator, area) = naive::value(case.corners, over_w, x, y);
    let (inverse, _) = naive::value(case.corners, inverses.map(i64::from), x, y);
    let largest = inverses.iter().map(|i| i.abs()).max().unwrap();
    (numerator, inverse, largest as f64 * area as f64 / inverse.abs() as f64)
}

fn check_perspective<W: Word>(case: &Case, corner: [i32; 3], inverses: [i32; 3]) -> Result<(), TestCaseError> {
    let (least, most) = (*corner.iter().min().unwrap(), *corner.iter().max().unwrap());
    let largest = corner.iter().map(|v| v.abs()).max().unwrap() as f64;
    let shape = triangle(case, [0, 1, 2].map(|i| Perspective::new([corner[i]], inverses[i])));
    for (at, [value]) in values::<W, _>(&shape, case.window) {
        prop_assert!((least..=most).contains(&value), "{} is out of {}..={}", value, least, most);
        let (numerator, inverse, rho) = exact_perspective(case, corner, inverses, at);
        let error = ((value as i128 * inverse - numerator) as f64 / inverse as f64).abs();
        let over_w = shape.varyings.map(|p| p.over_w[0]);
        let fine = [over_w, inverses].map(|v| fine_error(case.corners, v.map(i64::from), at));
        let [Some(fine_over_w), Some(fine_inverse)] = fine else { continue };
        // Half a unit for the rounding of value/w at the corners; 1/w may be too small by its own error.
        let one = (1 << 30) as f64;
        let pixel = one / rho - fine_inverse;
        let bound = one / pixel * (fine_over_w + 0.5 + fine_inverse * largest / one) + 2.0;
        prop_assert!(pixel < fine_inverse || error <= bound, "{:?} is {} off, not {}", at, error, bound);
        track(W::GUARD > 5000, error/bound, error, bound, case, corner, inverses);
    }
    Ok(())
}
fn track(wide: bool, error: f64, error2: f64, bound: f64, case: &Case, d: [i32; 3], inv: [i32; 3]) {
    use std::sync::Mutex; static M: Mutex<[f64; 2]> = Mutex::new([0.0; 2]);
    let mut m = M.lock().unwrap(); if error > m[wide as usize] { m[wide as usize] = error; println!("{m:?} {error2} {bound} {case:?} {d:?} {inv:?}"); }
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50000))]

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
}
