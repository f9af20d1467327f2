//! Subpixel lines and Wu lines: the pixels and weights of the rule, values near the exact ones, and the same bits in any
//! window.

use std::fmt::Debug;
use std::marker::PhantomData;

use fixel::depth::{Always, DepthBuffer, FAR, NoDepth};
use fixel::draw;
use fixel::fragment::{Antialiased, Fragment};
use fixel::num::Word;
use fixel::screen::{Corner, FineDepth, Position, Shape, SubPx};
use fixel::segment::{Nearest, Pairs, WHOLE};
use fixel::span::Corners;
use fixel::target::Buffer;
use fixel::varying::{Linear, Perspective, Varying};
use fixel::window::Window;
use proptest::prelude::*;

/// A point in subpixels.
type Point = (i32, i32);

/// One step of the obviously correct line: the exact other coordinate is `other.0 / other.1` px, and the exact share of
/// the second end's values `share.0 / share.1`.
#[derive(Debug, Clone, Copy)]
struct Step {
    x_is_major: bool,
    k: i32,
    other: (i128, i128),
    share: (i128, i128),
    /// Steps before this one.
    number: i32,
}

impl Step {
    fn pixel(&self, across: i128) -> Point {
        if self.x_is_major {
            (self.k, across as i32)
        } else {
            (across as i32, self.k)
        }
    }
}

/// The rule, word by word.
fn rule(a: Point, b: Point) -> Vec<Step> {
    let x_is_major = (b.0 - a.0).abs() >= (b.1 - a.1).abs();
    let turned = |p: Point| if x_is_major { p } else { (p.1, p.0) };
    let (a, b) = (turned(a), turned(b));
    let (first, last) = if b.0 < a.0 { (b, a) } else { (a, b) };
    let length = (last.0 - first.0) as i128;
    let steps = (first.0 + 255).div_euclid(256)..(last.0 + 255).div_euclid(256);
    let start = steps.start;
    let step = |k: i32| {
        let on = (256 * k - first.0) as i128;
        let share = if b.0 < a.0 { length - on } else { on };
        Step {
            x_is_major,
            k,
            other: (first.1 as i128 * length + (last.1 - first.1) as i128 * on, 256 * length),
            share: (share, length),
            number: k - start,
        }
    };
    steps.map(step).collect()
}

/// floor(other + ½) at every step.
fn nearest(steps: &[Step]) -> Vec<Point> {
    steps
        .iter()
        .map(|s| s.pixel((2 * s.other.0 + s.other.1).div_euclid(2 * s.other.1)))
        .collect()
}

/// Both pixels of every step, with the exact weight of the second.
fn pairs(steps: &[Step]) -> Vec<(Point, Point, (i128, i128))> {
    let pair = |s: &Step| {
        let floor = s.other.0.div_euclid(s.other.1);
        (
            s.pixel(floor),
            s.pixel(floor + 1),
            (s.other.0.rem_euclid(s.other.1), s.other.1),
        )
    };
    steps.iter().map(pair).collect()
}

/// What of the lines' pixels `window` holds, by both iterators.
fn check_pixels<W: Word>(ends: [Point; 2], window: Window) -> Result<(), TestCaseError> {
    let steps = rule(ends[0], ends[1]);
    let mut lit = nearest(&steps);
    lit.retain(|&at| window.contains(at));
    let found: Vec<_> = Nearest::<W>::new(&ends, window).collect();
    prop_assert_eq!(found, lit, "{:?} in {:?}", ends, window);

    let mut lit = pairs(&steps);
    lit.retain(|pair| window.contains(pair.0) || window.contains(pair.1));
    let found: Vec<_> = Pairs::<W>::new(&ends, window).collect();
    prop_assert_eq!(found.len(), lit.len(), "{:?} in {:?}", ends, window);
    for (found, (first, second, (t, one))) in found.into_iter().zip(lit) {
        prop_assert_eq!(
            (found.first, found.second),
            (first, second),
            "{:?} in {:?}",
            ends,
            window
        );
        let too_little = (t * WHOLE as i128 - found.weight as i128 * one) as f64 / one as f64;
        prop_assert!(
            (0.0..1.25).contains(&too_little),
            "{:?}: weight {} short",
            ends,
            too_little
        );
    }
    Ok(())
}

/// Quarters of a pixel, or odd places, from −1 px on.
fn grid(step: i32) -> Vec<Point> {
    (0..256).map(|i| (i % 16 * step - 256, i / 16 * step - 256)).collect()
}

const AROUND: Window = Window::new(-3, -3, 6, 6);
const WINDOWS: [Window; 8] = [
    Window::new(-1, -1, 3, 3),
    Window::new(0, 0, 2, 2),
    Window::new(1, -1, 4, 1),
    Window::new(-2, 1, 1, 3),
    Window::new(0, 0, 1, 1),
    Window::new(1, 0, 2, 1),
    Window::new(2, 2, 3, 3),
    Window::new(1, 1, 1, 2),
];

/// All lines between 16×16 ends on two grids, in a window around them and in small ones.
#[test]
fn every_small_line_lights_the_pixels_of_the_rule_in_every_window() {
    for ends in [grid(64), grid(37)] {
        for &a in &ends {
            for &b in &ends {
                check_pixels::<i32>([a, b], AROUND).unwrap();
                for window in WINDOWS {
                    check_pixels::<i32>([a, b], window).unwrap();
                }
            }
        }
    }
}

/// Two ends on the screen for either word.
#[derive(Debug, Clone, Copy)]
struct Line<V> {
    ends: [Point; 2],
    depths: [i32; 2],
    varyings: [V; 2],
}

impl<V> Corners for Line<V> {
    fn count(&self) -> usize {
        2
    }
    fn position(&self, index: usize) -> Point {
        self.ends[index]
    }
}

impl<V: Varying> Shape for Line<V> {
    type Varying = V;
    fn depth(&self, index: usize) -> i32 {
        self.depths[index]
    }
    fn varying(&self, index: usize) -> V {
        self.varyings[index]
    }
}

/// Stores what each pixel gets, a part of `None` for a whole one.
struct Keep<V>(PhantomData<V>);

type Kept<V> = Option<(<V as Varying>::Values, Option<i32>)>;

impl<V: Varying> Fragment for Keep<V> {
    type Varying = V;
    type Pixel = Kept<V>;
    fn shade(&self, values: V::Values, _: Kept<V>) -> Option<Kept<V>> {
        Some(Some((values, None)))
    }
}

impl<V: Varying> Antialiased for Keep<V> {
    fn shade_part(&self, values: V::Values, part: i32, below: Kept<V>) -> Option<Kept<V>> {
        assert!(below.is_none(), "a Wu line draws no pixel twice");
        Some(Some((values, Some(part))))
    }
}

/// The pixels of the window in the order of a buffer.
fn positions(window: Window) -> impl Iterator<Item = Point> {
    (window.top..window.bottom).flat_map(move |y| (window.left..window.right).map(move |x| (x, y)))
}

type Drawn<V> = Vec<(Point, <V as Varying>::Values, Option<i32>, u16)>;

/// What a line draws into `window`: pixel, values, part, depth.
fn drawn<W: Word, V: Varying>(line: &Line<V>, wu: bool, window: Window) -> Drawn<V> {
    let size = window.width() * window.height();
    let (mut colors, mut stored) = (vec![None; size], vec![FAR; size]);
    let mut target = Buffer::strip(&mut colors, window).unwrap();
    let mut depth = DepthBuffer::<_, Always>::new(Buffer::strip(&mut stored, window).unwrap());
    if wu {
        draw::wu_stroke::<W, _, _, _, _>(&mut target, &mut depth, line, &Keep(PhantomData));
    } else {
        draw::stroke::<W, _, _, _, _>(&mut target, &mut depth, line, &Keep(PhantomData));
    }
    let pixels = positions(window).zip(colors).zip(stored);
    pixels
        .filter_map(|((at, kept), depth)| kept.map(|(values, part)| (at, values, part, depth)))
        .collect()
}

/// What is drawn in a part of a window is that part of what is drawn in it.
fn check_part<V: Varying<Values: PartialEq + Debug>>(
    line: &Line<V>,
    window: Window,
    part: Window,
) -> Result<(), TestCaseError> {
    for wu in [false, true] {
        let mut whole = drawn::<i32, V>(line, wu, window);
        whole.retain(|d| part.contains(d.0));
        prop_assert_eq!(whole, drawn::<i32, V>(line, wu, part), "{:?}", line.ends);
    }
    Ok(())
}

/// Colours, weights and depths of all lines between 16×16 ends.
#[test]
fn every_small_line_has_the_same_bits_in_every_window() {
    let ends = grid(37);
    for (i, &a) in ends.iter().enumerate() {
        for &b in ends.iter().skip(i % 3).step_by(3) {
            let line = Line {
                ends: [a, b],
                depths: [1_234_567_890, 77],
                varyings: [Linear([5 << 24, -9]), Linear([-(1 << 30), 1000])],
            };
            for part in WINDOWS {
                check_part(&line, AROUND, part).unwrap();
            }
        }
    }
}

/// How far a value at this step may be off that is stepped in units, and one that is stepped in 2^-14 of them.
fn stated(step: &Step, values: [f64; 2]) -> (f64, f64) {
    let (n, range) = (step.number as f64 + 2.0, (values[1] - values[0]).abs());
    (n + range * 2f64.powi(-28), n * 2f64.powi(-14) + range * 2f64.powi(-28))
}

/// The exact value at a step.
fn exact(step: &Step, [a, b]: [i64; 2]) -> f64 {
    let whole = a as i128 * step.share.1 + (b - a) as i128 * step.share.0;
    // Cut to 2^-20 unit before it becomes a float.
    ((whole << 20) / step.share.1) as f64 / (1 << 20) as f64
}

/// The drawn pixels of a plain line, each with its step.
fn by_step<W: Word, V: Varying>(line: &Line<V>, window: Window) -> Vec<(Step, V::Values, u16)> {
    let steps = rule(line.ends[0], line.ends[1]);
    let lit: std::collections::BTreeMap<Point, Step> = nearest(&steps).into_iter().zip(steps).collect();
    let drawn = drawn::<W, V>(line, false, window).into_iter();
    drawn.map(|(at, values, _, depth)| (lit[&at], values, depth)).collect()
}

fn check_linear<W: Word>(case: &Case, values: [i32; 2], depths: [i32; 2]) -> Result<(), TestCaseError> {
    let line = Line {
        ends: case.ends,
        depths,
        varyings: values.map(|v| Linear([v])),
    };
    for (step, [value], depth) in by_step::<W, _>(&line, case.window) {
        let in_range = |v: i32, [a, b]: [i32; 2]| a.min(b) <= v && v <= a.max(b);
        prop_assert!(in_range(value, values), "{} at {:?}", value, step);
        let (bound, _) = stated(&step, values.map(f64::from));
        let off = value as f64 - exact(&step, values.map(i64::from));
        prop_assert!(off.abs() <= bound, "{} is {} off, not {}", value, off, bound);

        let rounded = |d: i32| (d + (1 << 14)) >> 15;
        prop_assert!(in_range(depth as i32, depths.map(rounded)), "{} at {:?}", depth, step);
        let (bound, _) = stated(&step, depths.map(f64::from));
        let off = depth as f64 * 32768.0 - exact(&step, depths.map(i64::from));
        prop_assert!(
            off.abs() <= bound + 16384.0,
            "depth {} is {} off, not {}",
            depth,
            off,
            bound
        );
    }
    Ok(())
}

fn check_perspective<W: Word>(case: &Case, values: [i32; 2], inverses: [i32; 2]) -> Result<(), TestCaseError> {
    let line = Line {
        ends: case.ends,
        depths: [0; 2],
        varyings: [0, 1].map(|i| Perspective::new([values[i]], inverses[i])),
    };
    let one = (1u64 << 30) as f64;
    let over_w = [0, 1].map(|i| values[i] as i64 * inverses[i] as i64);
    for (step, [value], _) in by_step::<W, _>(&line, case.window) {
        prop_assert!(values[0].min(values[1]) <= value && value <= values[0].max(values[1]));
        let (_, over_w_error) = stated(&step, over_w.map(|v| v as f64 / one));
        let (_, inverse_error) = stated(&step, inverses.map(f64::from));
        let inverse = exact(&step, inverses.map(i64::from));
        let truth = exact(&step, over_w) / inverse;
        // As in `interpolation.rs`: the errors over the least 1/w, the quotient's 3 units and 2^-30.
        let least = inverse.abs() - inverse_error;
        let bound = one / least * (over_w_error + 0.5 + inverse_error * truth.abs() / one) + 3.0 + truth.abs() / one;
        prop_assert!(
            (value as f64 - truth).abs() <= bound,
            "{} is not {} ± {}",
            value,
            truth,
            bound
        );
    }
    Ok(())
}

/// A line and a window of 24×12 px around a point of it.
#[derive(Debug, Clone)]
struct Case {
    ends: [Point; 2],
    window: Window,
}

fn cases(guard: i32) -> impl Strategy<Value = Case> {
    let limit = guard * 256;
    let line = |reach: i32| prop::array::uniform2((-reach..=reach, -reach..=reach));
    let short = (line(limit - 800), (-800..800i32, -800..800i32)).prop_map(|([a, _], (x, y))| [a, (a.0 + x, a.1 + y)]);
    let upright = (line(limit), -300..300i32).prop_map(|([a, b], x)| [a, (a.0 / 2 + x, b.1)]);
    let kinds = prop_oneof![2 => line(5000), 2 => line(limit), 2 => short, 1 => upright];
    (kinds, 0.0..1.0f64).prop_map(|(ends, t)| {
        let on = |a: i32, b: i32| (a as f64 + (b as f64 - a as f64) * t) as i32 / 256;
        let (x, y) = (on(ends[0].0, ends[1].0), on(ends[0].1, ends[1].1));
        let window = Window::new(x - 12, y - 6, x + 12, y + 6);
        Case { ends, window }
    })
}

/// Up to 2^30 either way, the domain of a varying.
fn value() -> impl Strategy<Value = i32> {
    prop_oneof![3 => -(1 << 30)..=1 << 30, 1 => Just(1 << 30), 1 => Just(-(1 << 30)), 2 => 0..255 << 16, 1 => -5..5i32]
}

fn two<S: Strategy>(values: S) -> prop::array::UniformArrayStrategy<S, [S::Value; 2]> {
    prop::array::uniform2(values)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_line_in_any_window(case in cases(4096), wide in cases(32768), dx in -30..30i32, dy in -30..30i32) {
        check_pixels::<i32>(case.ends, case.window)?;
        check_pixels::<i64>(wide.ends, wide.window)?;
        let Window { left, top, .. } = case.window;
        check_pixels::<i32>(case.ends, Window::new(left + dx, top + dy, left + dx + 7, top + dy + 1))?;
    }

    #[test]
    fn linear_values_and_depths_are_near_the_exact_ones(
        case in cases(4096), wide in cases(32750), values in two(value()), depths in two(0..=65535 << 15),
    ) {
        check_linear::<i32>(&case, values, depths)?;
        check_linear::<i64>(&wide, values, depths)?;
    }

    #[test]
    fn perspective_values_are_near_the_exact_ones(
        case in cases(4096), wide in cases(32750), values in two(value()), power in 0.0..9.96f64, first in any::<bool>(),
        negative in any::<bool>(),
    ) {
        let small = ((1 << 30) as f64 * (-power).exp2()) as i32;
        let inverses = if first { [1 << 30, small] } else { [small, 1 << 30] };
        let inverses = inverses.map(|v| if negative { -v } else { v });
        check_perspective::<i32>(&case, values, inverses)?;
        check_perspective::<i64>(&wide, values, inverses)?;
    }

    #[test]
    fn any_window_has_the_same_bits(
        case in cases(200), values in two(two(value())), inverses in two(value()), depths in two(0..=65535 << 15),
        dx in 0..24i32, dy in 0..12i32, width in 1..12i32, height in 1..6i32,
    ) {
        let Window { left, top, .. } = case.window;
        let part = Window::new(left + dx, top + dy, left + dx + width, top + dy + height).intersect(case.window);
        let ends = case.ends;
        check_part(&Line { ends, depths, varyings: values.map(Linear) }, case.window, part)?;
        let varyings = [0, 1].map(|i| Perspective::new(values[i], inverses[i]));
        check_part(&Line { ends, depths, varyings }, case.window, part)?;
    }

    /// From the other end, a line is the same but for what the rounding of its values makes of it.
    #[test]
    fn backwards_lights_the_same_pixels(case in cases(4096)) {
        let [a, b] = case.ends;
        let there: Vec<_> = Pairs::<i32>::new(&[a, b], case.window).collect();
        prop_assert_eq!(there, Pairs::<i32>::new(&[b, a], case.window).collect::<Vec<_>>());
    }
}

/// The raster doors draw what the strokes do, and without depth as well.
#[test]
fn the_doors_agree() {
    let window = Window::new(0, 0, 20, 10);
    let corner = |x: i32, y: i32, v: i32| Corner {
        position: Position::nearest(SubPx::from_bits(x), SubPx::from_bits(y)),
        depth: FineDepth::ZERO,
        varying: Linear([v]),
    };
    let ends = [corner(300, 2000, 7), corner(4000, 100, 9 << 20)];
    let line = Line {
        ends: [(300, 2000), (4000, 100)],
        depths: [0; 2],
        varyings: ends.map(|e| e.varying),
    };
    for wu in [false, true] {
        let mut pixels = vec![None; 200];
        let mut target = Buffer::strip(&mut pixels, window).unwrap();
        if wu {
            draw::wu_line(&mut target, &mut NoDepth, ends, &Keep(PhantomData));
        } else {
            draw::segment(&mut target, &mut NoDepth, ends, &Keep(PhantomData));
        }
        let found = positions(window).zip(pixels).filter_map(|(at, kept)| Some((at, kept?)));
        let other = drawn::<i32, _>(&line, wu, window)
            .into_iter()
            .map(|(at, values, part, _)| (at, (values, part)));
        assert_eq!(found.collect::<Vec<_>>(), other.collect::<Vec<_>>());
    }
}

/// A fragment of weight 0 stores its depth, and both pixels of a step do.
#[test]
fn a_weight_of_0_stores_depth() {
    let ends = [(0, 256), (512, 256)];
    let line = Line {
        ends,
        depths: [5 << 15; 2],
        varyings: [(); 2],
    };
    let drawn = drawn::<i32, ()>(&line, true, Window::new(0, 0, 3, 4));
    let parts: Vec<_> = drawn.iter().map(|&(at, (), part, depth)| (at, part, depth)).collect();
    let [all, none] = [Some(WHOLE), Some(0)];
    assert_eq!(
        parts,
        [((0, 1), all, 5), ((1, 1), all, 5), ((0, 2), none, 5), ((1, 2), none, 5)]
    );
}
