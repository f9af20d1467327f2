//! What the tiers state of colours, on 100,000 triangles of every kind: the bound holds, and is not looser than four times the
//! largest error. The tiers' other dials have files of their own (`docs/dials.md`).

mod naive;
mod triangles;

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::fragment::{Fragment, Gouraud565};
use fixel::quality::{Balanced, Exact, Fast, Quality};
use fixel::span::doubled_area;
use fixel::target::Buffer;
use fixel::varying::Varying;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::Cell;
use triangles::{Case, Triangle, cases, positions};

/// A tier's own fragment program, into pixels that tell whether they were drawn.
struct Keep<Q: Quality>(Q::Gouraud);

impl<Q: Quality> Fragment for Keep<Q> {
    type Varying = Q::Color;
    type Pixel = Option<u16>;
    fn shade(&self, color: <Q::Color as Varying>::Values, _: Option<u16>) -> Option<Option<u16>> {
        self.0.shade(color, 0).map(Some)
    }
}

/// Levels of each channel, from the top.
const MOST: [i64; 3] = [31, 63, 31];

/// The largest error of a stored channel in levels: half a level of rounding, and the tier's.
fn error<Q: Quality>(case: &Case, colors: [[u8; 3]; 3]) -> f64 {
    let shape = Triangle {
        corners: case.corners,
        depths: [0; 3],
        varyings: colors.map(|[red, green, blue]| Q::Color::from(Gouraud565::corner(red, green, blue))),
    };
    let mut pixels = vec![None; case.window.width() * case.window.height()];
    let mut target = Buffer::strip(&mut pixels, case.window).unwrap();
    let area = doubled_area(&shape);
    draw::polygon::<i32, _, _, _, _>(&mut target, &mut NoDepth, &shape, area, &Keep::<Q>(Q::GOURAUD));
    let mut worst = 0.0f64;
    for ((x, y), pixel) in positions(case.window).zip(pixels) {
        let Some(pixel) = pixel else { continue };
        let stored = [pixel >> 11, pixel >> 5 & 63, pixel & 31];
        for (channel, stored) in stored.into_iter().enumerate() {
            let exact = colors.map(|color| i64::from(color[channel]) * MOST[channel]);
            let (numerator, area) = naive::value(case.corners, exact, x, y);
            worst = worst.max((f64::from(stored) - numerator as f64 / area as f64 / 255.0).abs());
        }
    }
    worst
}

fn colors() -> impl Strategy<Value = [[u8; 3]; 3]> {
    prop::array::uniform3(prop::array::uniform3(prop_oneof![any::<u8>(), Just(0), Just(255)]))
}

fn check<Q: Quality>(bound: f64) {
    let worst = Cell::new(0.0f64);
    let mut runner = TestRunner::new(Config {
        cases: 100_000,
        failure_persistence: None,
        ..Config::default()
    });
    runner
        .run(&(cases(500), colors()), |(case, colors)| {
            let error = error::<Q>(&case, colors) - 0.5;
            worst.set(worst.get().max(error));
            prop_assert!(error <= bound, "{}: {error} levels before rounding", Q::NAME);
            Ok(())
        })
        .unwrap();
    println!("{}: {:.5} of {bound} levels before rounding", Q::NAME, worst.get());
    assert!(
        bound <= 4.0 * worst.get(),
        "{}: {} is far below {bound}",
        Q::NAME,
        worst.get()
    );
}

/// Spans of up to 1000 px.
#[test]
fn colors_of_the_fast_tier_are_within_half_a_level_and_rounding() {
    check::<Fast>(0.5);
}

#[test]
fn colors_of_the_balanced_tier_are_within_half_a_level_and_rounding() {
    check::<Balanced>(0.5);
}

#[test]
fn colors_of_the_exact_tier_are_within_2_to_the_16th_a_pixel_and_rounding() {
    check::<Exact>(1001.0 / 65536.0);
}
