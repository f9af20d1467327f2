//! Colours (formats/mp1.md sections 5 and 6): sRGB, *over*, and the average of a pixel's samples.

use super::Sample;

/// A component in linear light from one in sRGB; 1 is full.
pub fn decode(c: f64) -> f64 {
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

/// A component in sRGB from one in linear light; 1 is full.
pub fn encode(c: f64) -> f64 {
    if c <= 0.0031308 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// One colour *over* another, both red, green, blue, alpha and straight: α = αt + αb (1 − αt), c = (ct αt + cb αb (1 − αt))/α;
/// no colour at α = 0, and the upper one as it is over nothing.
pub fn over(top: [f64; 4], below: [f64; 4]) -> [f64; 4] {
    let [tr, tg, tb, ta] = top;
    let [br, bg, bb, ba] = below;
    let alpha = ta + ba * (1.0 - ta);
    let mix = |t: f64, b: f64| (t * ta + b * ba * (1.0 - ta)) / alpha;
    if alpha == 0.0 {
        [0.0; 4]
    } else if ba == 0.0 {
        top
    } else {
        [mix(tr, br), mix(tg, bg), mix(tb, bb), alpha]
    }
}

/// The average of `count` samples, their colours weighted by alpha: red, green, blue, alpha. No colour at alpha 0.
pub fn average<'s>(samples: impl Iterator<Item = &'s Sample>, count: usize) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for sample in samples {
        let [r, g, b] = sample.color.map(|c| c * sample.alpha);
        for (sum, value) in sum.iter_mut().zip([r, g, b, sample.alpha]) {
            *sum += value;
        }
    }
    let [r, g, b, alpha] = sum;
    if alpha == 0.0 {
        [0.0; 4]
    } else {
        [r / alpha, g / alpha, b / alpha, alpha / count as f64]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_there_and_back() {
        for level in 0..=255u8 {
            let c = f64::from(level) / 255.0;
            // The two branches meet within 4e-8 of each other, where no level lies; elsewhere only float64 rounds.
            assert!((encode(decode(c)) - c).abs() < 1e-15 * 4.0, "{level}");
        }
        assert_eq!([decode(0.0), decode(1.0), encode(0.0)], [0.0, 1.0, 0.0]);
        assert_eq!(
            [decode(0.04045), encode(0.0031308)],
            [0.04045 / 12.92, 12.92 * 0.0031308]
        );
        assert!((decode(0.5) - 0.21404114048223255).abs() < 1e-15);
        assert!((encode(0.5) - 0.7353569830524495).abs() < 1e-15);
        // Not clamped.
        assert_eq!([decode(-12.92), encode(-1.0)], [-1.0, -12.92]);
        assert!(decode(2.0) > 4.9);
    }

    #[test]
    fn over_mixes_straight_colours() {
        let below = [0.0, 0.5, 1.0, 1.0];
        assert_eq!(over([1.0, 0.5, 0.0, 0.25], below), [0.25, 0.5, 0.75, 1.0]);
        assert_eq!(over([1.0, 0.5, 0.0, 1.0], below), [1.0, 0.5, 0.0, 1.0]);
        assert_eq!(over([1.0, 0.5, 0.0, 0.0], below), below);
        // Half over half: 0.75 in all, two thirds of it from the upper one.
        let [r, g, b, alpha] = over([0.75, 0.75, 0.75, 0.5], [0.0, 0.375, 0.75, 0.5]);
        assert_eq!([r, g, b, alpha], [0.5, 0.625, 0.75, 0.75]);
    }

    #[test]
    fn over_nothing_a_colour_stays_and_no_alpha_has_no_colour() {
        let top = [0.1, 0.2, 0.3, 0.7];
        assert_eq!(over(top, [0.9, 0.9, 0.9, 0.0]), top);
        assert_eq!(over([0.1, 0.2, 0.3, 0.0], [0.9, 0.9, 0.9, 0.0]), [0.0; 4]);
    }

    #[test]
    fn an_average_weights_by_alpha() {
        let sample = |c: f64, alpha: f64| Sample {
            color: [c, 1.0, 0.0],
            alpha,
            depth: 1.0,
            primitive: 1,
        };
        let block = [sample(1.0, 0.75), sample(0.0, 0.25), sample(9.0, 0.0), sample(9.0, 0.0)];
        assert_eq!(average(block.iter(), 4), [0.75, 1.0, 0.0, 0.25]);
        assert_eq!(average([sample(9.0, 0.0)].iter(), 1), [0.0; 4]);
    }
}
