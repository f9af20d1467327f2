//! *Over* keeps its bounds and its laws, and a whole picture's way, from levels through layers to levels, is within one
//! level of the same in float64.

use fixel::blend::{ONE, Rgba, over565, over888};
use fixel::srgb::{decode, decode_wide, encode};
use fixel::texture::Texel;

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Any, one of any number of bits, or an end.
    fn color(&mut self) -> i32 {
        match self.next() % 8 {
            0 => [i32::MIN, i32::MAX, 0, 1, -1, ONE, ONE - 1, -ONE][self.next() as usize % 8],
            1..4 => self.next() as i32,
            _ => self.next() as i32 >> (self.next() % 32),
        }
    }

    /// Of any number of bits, next to opaque, or an end.
    fn alpha(&mut self) -> i32 {
        match self.next() % 8 {
            0 => [0, 1, ONE - 1, ONE][self.next() as usize % 4],
            1 => ONE - (self.next() as i32 & (ONE - 1)) / (1 << (self.next() % 28)),
            2..5 => self.next() as i32 & (ONE - 1),
            _ => (self.next() as i32 & (ONE - 1)) >> (self.next() % 28),
        }
    }

    fn rgba(&mut self) -> Rgba {
        Rgba {
            color: [(); 3].map(|()| self.color()),
            alpha: self.alpha(),
        }
    }
}

/// The definition.
fn over64((top, at): ([f64; 3], f64), (below, ab): ([f64; 3], f64)) -> ([f64; 3], f64) {
    let alpha = at + ab * (1.0 - at);
    let color = [0, 1, 2].map(|i| (top[i] * at + below[i] * ab * (1.0 - at)) / alpha);
    (if alpha == 0.0 { [0.0; 3] } else { color }, alpha)
}

fn float(c: Rgba) -> ([f64; 3], f64) {
    (c.color.map(f64::from), f64::from(c.alpha) / f64::from(ONE))
}

#[test]
fn over_keeps_its_bounds() {
    let mut random = Random(1);
    let mut worst = 0.0f64;
    for _ in 0..1 << 21 {
        let (top, below) = (random.rgba(), random.rgba());
        let both = top.over(below);
        // Exactly, in units of 2^-56.
        let (at, ab) = (i128::from(top.alpha), i128::from(below.alpha));
        let exact = at * i128::from(ONE) + ab * (i128::from(ONE) - at);
        assert_eq!(i128::from(both.alpha), (exact + (1 << 27)) >> 28, "{top:?} {below:?}");

        let (expected, _) = over64(float(top), float(below));
        for (i, expected) in expected.into_iter().enumerate() {
            let (t, b, c) = (top.color[i], below.color[i], both.color[i]);
            if exact > 0 {
                assert!((t.min(b)..=t.max(b)).contains(&c), "{top:?} {below:?}");
            }
            let (error, distance) = ((f64::from(c) - expected).abs(), (f64::from(t) - f64::from(b)).abs());
            // The oracle itself is off by 2^-50 of numbers up to 2^31.
            let excess = (error - 0.5 - 2f64.powi(-18)).max(0.0);
            worst = worst.max(excess / distance.max(1.0) * 2f64.powi(29));
            assert!(excess <= distance * 2f64.powi(-29), "{top:?} {below:?}: {error}");
        }
    }
    println!("largest error of a channel: 1/2 unit + {worst:.3} x 2^-29 of the distance");
}

#[test]
fn laws_of_over() {
    let mut random = Random(2);
    let empty = Rgba::default();
    for _ in 0..100_000 {
        let (a, b) = (random.rgba(), random.rgba());
        if a.alpha == 0 {
            assert_eq!((a.over(empty), empty.over(a)), (empty, empty));
            assert_eq!(a.over(b), if b.alpha == 0 { empty } else { b });
        } else {
            // No dark fringe.
            assert_eq!((a.over(empty), empty.over(a)), (a, a));
            assert_eq!(a.over(Rgba { alpha: 0, ..b }), a);
            assert_eq!(a.over(a).color, a.color);
            assert_eq!(a.over(Rgba { alpha: b.alpha, ..a }).color, a.color);
        }
        let opaque = Rgba { alpha: ONE, ..a };
        assert_eq!(opaque.over(b), opaque);
        assert_eq!(a.over(Rgba { alpha: ONE, ..b }).alpha, ONE);
        // Beyond the ends is the end.
        for (beyond, end) in [(-1, 0), (i32::MIN, 0), (ONE + 1, ONE), (i32::MAX, ONE)] {
            assert_eq!(Rgba { alpha: beyond, ..a }.over(b), Rgba { alpha: end, ..a }.over(b));
            assert_eq!(b.over(Rgba { alpha: beyond, ..a }), b.over(Rgba { alpha: end, ..a }));
        }
    }
    let red = Rgba {
        color: [ONE, 0, 0],
        alpha: ONE / 2,
    };
    let blue = Rgba {
        color: [0, 0, ONE],
        alpha: ONE / 2,
    };
    assert!(red.over(blue).color[0] > ONE / 2 && blue.over(red).color[2] > ONE / 2);
}

/// (a over b) over c = a over (b over c) up to rounding: two steps of ½ + d·2^-29 each way, and for the rounded alpha in
/// between ½ unit of 2^-28 over the final alpha, each way.
#[test]
fn over_is_associative() {
    let mut random = Random(3);
    for _ in 0..200_000 {
        let [a, b, c] = [(); 3].map(|()| random.rgba());
        let (left, right) = (a.over(b).over(c), a.over(b.over(c)));
        assert!(left.alpha.abs_diff(right.alpha) <= 2, "{a:?} {b:?} {c:?}");
        if left.alpha == 0 || right.alpha == 0 {
            continue;
        }
        for i in 0..3 {
            let values = [a.color[i], b.color[i], c.color[i]].map(f64::from);
            let range =
                values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min);
            let bound = 2.0 + range * (4.0 * 2f64.powi(-29) + 2.0 / f64::from(left.alpha.min(right.alpha)));
            let difference = (f64::from(left.color[i]) - f64::from(right.color[i])).abs();
            assert!(difference <= bound, "{a:?} {b:?} {c:?}: {difference}");
        }
    }
}

#[test]
fn faded_is_rounded_to_nearest() {
    let mut random = Random(4);
    for _ in 0..100_000 {
        let (c, part) = (random.rgba(), random.alpha());
        let exact = i64::from(c.alpha) * i64::from(part);
        let expected = ((exact + (1 << 27)) >> 28) as i32;
        assert_eq!(c.faded(part), Rgba { alpha: expected, ..c });
    }
    let c = Rgba {
        color: [1, 2, 3],
        alpha: 77,
    };
    assert_eq!([i32::MIN, -1, 0].map(|part| c.faded(part).alpha), [0; 3]);
    assert_eq!([ONE, ONE + 1, i32::MAX].map(|part| c.faded(part)), [c; 3]);
    assert_eq!(Rgba { alpha: i32::MAX, ..c }.faded(i32::MAX).alpha, ONE);
}

/// Every byte at every shift, exactly.
#[test]
fn texels_are_rounded_to_nearest() {
    for shift in 0..=32u32 {
        for v in 0..=255u8 {
            let nearest = |shift: u32| {
                let whole = 255u64 << shift;
                ((2 * (u64::from(v) << 28) + whole) / (2 * whole)) as i32
            };
            let rgba = Rgba::from_texel(Texel([v, 255 - v, 0, v]), shift);
            assert_eq!(
                (rgba.color[0], rgba.alpha),
                (nearest(shift.min(30)), nearest(0)),
                "{v} >> {shift}"
            );
            assert_eq!(rgba.color[2], 0);
        }
    }
}

/// Within ½ + 2^-40 levels of the exact mix, cut to 0…most.
fn check_level(color: i32, alpha: i32, below: u32, most: u32, result: u32) {
    let alpha = i128::from(alpha.clamp(0, ONE));
    let lower = i128::from(below) * i128::from(ONE) * (i128::from(ONE) - alpha);
    let exact = (i128::from(color) * alpha * i128::from(most) + lower).clamp(0, i128::from(most) << 56);
    let error = (i128::from(result) << 56) - exact;
    assert!(
        error.abs() <= (1 << 55) + (1 << 16),
        "{color} {alpha} over {below}/{most}: {result}"
    );
    assert!(result <= most && (alpha > 0 || result == below));
}

#[test]
fn blending_onto_frame_buffers_is_rounded_to_nearest() {
    let mut random = Random(5);
    for _ in 0..1 << 20 {
        let mut top = random.rgba();
        if random.next().is_multiple_of(8) {
            top.alpha = random.next() as i32;
        }
        let word = random.next() as u16;
        let channels = |v: u16| {
            [
                (u32::from(v >> 11), 31),
                (u32::from(v >> 5 & 63), 63),
                (u32::from(v & 31), 31),
            ]
        };
        let result = channels(over565(top, word));
        for ((color, (below, most)), (result, _)) in top.color.into_iter().zip(channels(word)).zip(result) {
            check_level(color, top.alpha, below, most, result);
        }
        let bytes = random.next().to_le_bytes();
        let below = [bytes[0], bytes[1], bytes[2]];
        let result = over888(top, below);
        for ((color, below), result) in top.color.into_iter().zip(below).zip(result) {
            check_level(color, top.alpha, below.into(), 255, result.into());
        }
    }
}

fn decode64(c: f64) -> f64 {
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

fn encode64(c: f64) -> f64 {
    if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// One to four layers over nothing: their linear colours in fixed point and in float64, in units of full.
fn layer(random: &mut Random) -> (Rgba, ([f64; 3], f64)) {
    let alpha = random.alpha();
    let mut exact = [0.0; 3];
    let color = [0, 1, 2].map(|i| match random.next() % 4 {
        // A level; a fraction of any size, up to 2.25 times full, which is 6.5 in linear light.
        0 | 1 => {
            let level = random.next() as u8;
            exact[i] = decode64(f64::from(level) / 255.0);
            decode(level)
        }
        _ => {
            let encoded = (random.next() % (9 << 22)) as i32 >> (random.next() % 12);
            exact[i] = decode64(f64::from(encoded) / f64::from(1 << 24));
            decode_wide(encoded).min(i32::MAX.into()) as i32
        }
    });
    (Rgba { color, alpha }, (exact, f64::from(alpha) / f64::from(ONE)))
}

/// 2^20 pixels. Alpha is kept in units of 2^-28, so that with the least alpha looked at, 2^20 of them, each layer moves
/// the mix by 2^-21 of the distance at most; in the dark, 3295 levels per unit of linear light, that is 0.0016 levels for
/// a distance of 1. The distances here are up to 6.5, but random layers do
/// not add up like that.
#[test]
fn from_levels_to_levels() {
    let mut random = Random(6);
    let (mut worst, mut worst_visible, mut compared, mut other) = (0.0f64, 0.0f64, 0u32, 0u32);
    for _ in 0..1 << 20 {
        let (mut fixed, mut exact) = (Rgba::default(), ([0.0; 3], 0.0));
        for _ in 0..=random.next() % 4 {
            let (top, top64) = layer(&mut random);
            (fixed, exact) = (top.over(fixed), over64(top64, exact));
        }
        let alpha = f64::from(fixed.alpha) / f64::from(ONE);
        // ½ unit per layer.
        assert!((alpha - exact.1).abs() <= 2.5 / f64::from(ONE));
        if exact.1 < 1.0 / 255.0 {
            continue;
        }
        for (c, expected) in fixed.color.into_iter().zip(exact.0) {
            let expected = 255.0 * encode64(expected).clamp(0.0, 1.0);
            let encoded = encode(c);
            let error = (f64::from(encoded) / 65536.0 - expected).abs();
            worst = worst.max(error);
            if exact.1 >= 0.25 {
                worst_visible = worst_visible.max(error);
            }
            compared += 1;
            // Not rare: layers of little alpha leave a level whole but for less than the error.
            other += u32::from(encoded >> 16 != expected as u32);
            assert!((encoded >> 16).abs_diff(expected as u32) <= 1, "{expected}");
        }
    }
    println!(
        "{compared} channels, {other} cut to the next level; worst before cutting {worst:.5} levels, {worst_visible:.5} from alpha 1/4"
    );
    assert!(worst <= 0.001 && worst_visible <= 0.0005);
}
