//! The 16-bit depth: near the exact one, never out of its corners' range, and compared by the rule that was asked for.

mod naive;
mod triangles;

use fixel::depth::{Always, Comparison, DepthBuffer, Equal, FAR, Greater, GreaterOrEqual, Less, LessOrEqual, NotEqual};
use fixel::draw;
use fixel::fragment::Flat;
use fixel::num::Word;
use fixel::span::doubled_area;
use fixel::target::Buffer;
use fixel::window::Window;
use proptest::prelude::*;
use triangles::{Case, Triangle, cases, corners, positions, stated_error};

/// Units of a corner's depth in a step of the buffer.
const STEP: i128 = 1 << 15;

/// The depths of the covered pixels.
fn depths<W: Word>(case: &Case, depths: [i32; 3]) -> Vec<((i32, i32), u16)> {
    let size = case.window.width() * case.window.height();
    let (mut colors, mut stored) = (vec![false; size], vec![FAR; size]);
    let mut depth = DepthBuffer::<_, Always>::new(Buffer::strip(&mut stored, case.window).unwrap());
    let mut target = Buffer::strip(&mut colors, case.window).unwrap();
    let triangle = Triangle {
        corners: case.corners,
        depths,
        varyings: [(); 3],
    };
    draw::polygon::<W, _, _, _, _>(
        &mut target,
        &mut depth,
        &triangle,
        doubled_area(&case.corners),
        &Flat(true),
    );
    let pixels = positions(case.window).zip(colors).zip(stored);
    pixels
        .filter_map(|((at, covered), depth)| covered.then_some((at, depth)))
        .collect()
}

/// The stored depth is within the stated error of the exact value and half a step of rounding, within one step on pictures
/// up to 4096 px, and in the corners' range but for what slopes add to it.
fn check<W: Word>(case: &Case, corner_depths: [i32; 3]) -> Result<(), TestCaseError> {
    let exact = corner_depths.map(i64::from);
    // Triangles of a usual shape and size are interpolated in 32-bit words: an eighth of a step.
    let slopes = STEP / 8;
    let rounded = |d: i128| ((d + STEP / 2) / STEP).clamp(0, 65535) as u16;
    let least = rounded(i128::from(*corner_depths.iter().min().unwrap()) - slopes);
    let most = rounded(i128::from(*corner_depths.iter().max().unwrap()) + slopes);
    for ((x, y), stored) in depths::<W>(case, corner_depths) {
        prop_assert!(
            (least..=most).contains(&stored),
            "{} is out of {}..={}",
            stored,
            least,
            most
        );
        let (numerator, area) = naive::value(case.corners, exact, x, y);
        let error = (stored as i128 * STEP * area - numerator) as f64 / area as f64;
        let stated = stated_error(case.corners, exact, (x, y)) + STEP as f64 / 2.0 + slopes as f64;
        prop_assert!(error.abs() <= stated, "({}, {}) is {} off, not {}", x, y, error, stated);
        if W::GUARD == <i32 as Word>::GUARD {
            prop_assert!(error.abs() <= STEP as f64, "({}, {}) is {} off", x, y, error);
        }
    }
    Ok(())
}

/// 0…65535 steps, its ends more often than not.
fn depth() -> impl Strategy<Value = i32> {
    prop_oneof![2 => 0..=65535 << 15, 1 => Just(0), 1 => Just(65535 << 15), 1 => 0..200_000i32]
}

/// Draws both triangles over all of 8×8 px at their depths, the first into a cleared buffer; which colour each pixel got.
fn over<C: Comparison>(first: [u32; 3], second: [u32; 3]) -> Vec<(u8, u16)> {
    let (mut colors, mut stored) = ([0u8; 64], [0x8000u16; 64]);
    let all = [(-2560, -2560), (-2560, 9000), (9000, -2560)];
    for (depths, color, always) in [(first, 1, true), (second, 2, false)] {
        let (mut target, stored) = (
            Buffer::new(&mut colors, 8, 8).unwrap(),
            Buffer::new(&mut stored, 8, 8).unwrap(),
        );
        let corners = corners(all, depths, [(); 3]);
        if always {
            draw::triangle(
                &mut target,
                &mut DepthBuffer::<_, Always>::new(stored),
                corners,
                &Flat(color),
            );
        } else {
            draw::triangle(
                &mut target,
                &mut DepthBuffer::<_, C>::new(stored),
                corners,
                &Flat(color),
            );
        }
    }
    colors.into_iter().zip(stored).collect()
}

/// The second triangle wins exactly where its depth compares so with the first's, and only then is its depth stored.
fn check_comparison<C: Comparison>(
    first: [u32; 3],
    second: [u32; 3],
    wins: fn(&u16, &u16) -> bool,
) -> Result<(), TestCaseError> {
    let alone = |depths| over::<Always>(depths, depths).into_iter().map(|(_, d)| d);
    for ((before, after), found) in alone(first).zip(alone(second)).zip(over::<C>(first, second)) {
        prop_assert_eq!(found, if wins(&after, &before) { (2, after) } else { (1, before) });
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn depths_are_near_the_exact_ones(case in cases(4096), depths in prop::array::uniform3(depth())) {
        check::<i32>(&case, depths)?;
    }

    #[test]
    fn so_they_are_on_large_pictures(case in cases(32700), depths in prop::array::uniform3(depth())) {
        check::<i64>(&case, depths)?;
    }

    /// Slivers thinner than a few subpixels: their gradients are as steep as they like.
    #[test]
    fn slivers_stay_in_range(
        a in (-9000..9000i32, -9000..9000i32), b in (-9000..9000i32, -9000..9000i32), t in 0.0..1.0f64,
        off in (-3..=3i32, -3..=3i32), depths in prop::array::uniform3(depth()),
    ) {
        let on = |u: i32, v: i32| u + ((v - u) as f64 * t) as i32;
        let corners = [a, b, (on(a.0, b.0) + off.0, on(a.1, b.1) + off.1)];
        prop_assume!(doubled_area(&corners) != 0);
        check::<i32>(&Case { corners, window: Window::new(-36, -36, 36, 36) }, depths)?;
    }

    #[test]
    fn every_comparison_is_what_it_says(first in prop::array::uniform3(depth()), second in prop::array::uniform3(depth()), same in any::<bool>()) {
        let first = first.map(|d| d as u32);
        let second = if same { first } else { second.map(|d| d as u32) };
        check_comparison::<Less>(first, second, u16::lt)?;
        check_comparison::<LessOrEqual>(first, second, u16::le)?;
        check_comparison::<Greater>(first, second, u16::gt)?;
        check_comparison::<GreaterOrEqual>(first, second, u16::ge)?;
        check_comparison::<Equal>(first, second, u16::eq)?;
        check_comparison::<NotEqual>(first, second, u16::ne)?;
        check_comparison::<Always>(first, second, |_, _| true)?;
    }

    /// Triangles of one depth that overlap: of equals the later wins all of its pixels with `LessOrEqual`, none with
    /// `Less`.
    #[test]
    fn of_coplanar_triangles_the_later_wins(first in cases(60), second in cases(60), depth in depth()) {
        let window = Window::new(-20, -20, 20, 20);
        let (mut colors, mut stored) = ([[b'.'; 40 * 40]; 2], [[FAR; 40 * 40]; 2]);
        let ([color_a, color_b], [depth_a, depth_b]) = (&mut colors, &mut stored);
        let strip = |pixels| Buffer::strip(pixels, window).unwrap();
        let (mut later, mut earlier) = (strip(color_a), strip(color_b));
        let mut le = DepthBuffer::<_, LessOrEqual>::new(Buffer::strip(depth_a, window).unwrap());
        let mut lt = DepthBuffer::<_, Less>::new(Buffer::strip(depth_b, window).unwrap());
        for (case, mark) in [(&first, b'1'), (&second, b'2')] {
            let corners = corners(case.corners, [depth.min((65535 << 15) - (1 << 15)) as u32; 3], [(); 3]);
            draw::triangle(&mut later, &mut le, corners, &Flat(mark));
            draw::triangle(&mut earlier, &mut lt, corners, &Flat(mark));
        }
        for (i, (x, y)) in positions(window).enumerate() {
            let (in_first, in_second) = (naive::covers(first.corners, x, y), naive::covers(second.corners, x, y));
            let winner = |later_wins| match (in_first, in_second) {
                (true, true) => if later_wins { b'2' } else { b'1' },
                (true, false) => b'1',
                (false, true) => b'2',
                (false, false) => b'.',
            };
            prop_assert_eq!((colors[0][i], colors[1][i]), (winner(true), winner(false)));
        }
    }
}
