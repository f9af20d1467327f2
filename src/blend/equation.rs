//! Blending by factors and equations, component by component.

use super::{ONE, Rgba};

/// What becomes of a pixel when a colour is drawn over it.
///
/// [`Replace`] and [`Translucent`] are fixed when compiled, a [`Blend`] is chosen when drawing, and so is an
/// `Option<Blend>`, with `None` for no blending.
///
/// ```
/// use fixel::blend::{Blending, ONE, Rgba};
///
/// /// The brighter of both, channel by channel.
/// struct Glow;
///
/// impl Blending for Glow {
///     fn blend(&self, source: Rgba, below: Rgba) -> Rgba {
///         let [r, g, b] = below.color;
///         let [sr, sg, sb] = source.color;
///         Rgba { color: [sr.max(r), sg.max(g), sb.max(b)], alpha: below.alpha }
///     }
/// }
/// ```
pub trait Blending {
    /// The new colour of a pixel of colour `below`, drawn over in colour `source`.
    fn blend(&self, source: Rgba, below: Rgba) -> Rgba;
}

/// No blending: the pixel is not even read.
///
/// ```
/// use fixel::blend::{Blending, ONE, Replace, Rgba};
/// let glass = Rgba { color: [ONE; 3], alpha: 0 };
/// assert_eq!(Replace.blend(glass, Rgba::default()), glass);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Replace;

impl Blending for Replace {
    #[inline(always)]
    fn blend(&self, source: Rgba, _below: Rgba) -> Rgba {
        source
    }
}

/// [`Blend::TRANSLUCENT`], fixed when compiled.
///
/// ```
/// use fixel::blend::{Blending, ONE, Rgba, Translucent};
/// let glass = Rgba { color: [ONE, 0, 0], alpha: ONE / 2 };
/// let black = Rgba { color: [0; 3], alpha: ONE };
/// assert_eq!(Translucent.blend(glass, black), Rgba { color: [ONE / 2, 0, 0], alpha: ONE / 4 * 3 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Translucent;

impl Blending for Translucent {
    #[inline(always)]
    fn blend(&self, source: Rgba, below: Rgba) -> Rgba {
        const RULE: Blend = Blend::TRANSLUCENT;
        RULE.blend(source, below)
    }
}

/// *equation*(*source factor* · source, *destination factor* · destination), also for alpha; straight, unclamped.
///
/// The default replaces: [`Factor::One`], [`Factor::Zero`], [`Equation::Add`], constant colour white and opaque.
///
/// **Error**: half a unit of 2^-28; what leaves the range of an `i32`, ±8 times full, saturates (`tests/pipeline_10.rs`).
///
/// ```
/// use fixel::blend::{Blend, Blending, Equation, Factor, ONE, Rgba};
/// let sum = Blend { destination: Factor::One, ..Blend::default() };
/// let grey = Rgba { color: [ONE / 2; 3], alpha: ONE };
/// // Brighter than full until it is written out.
/// assert_eq!(sum.blend(grey, sum.blend(grey, grey)).color, [ONE / 2 * 3; 3]);
/// let darkest = Blend { equation: Equation::Min, ..sum };
/// assert_eq!(darkest.blend(grey, Rgba::default()), Rgba::default());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Blend {
    /// What the drawn colour is multiplied by.
    pub source: Factor,
    /// What the pixel's colour is multiplied by.
    pub destination: Factor,
    /// How the two products make one colour.
    pub equation: Equation,
    /// For the constant factors.
    pub constant: Rgba,
}

impl Default for Blend {
    fn default() -> Self {
        Blend::REPLACE
    }
}

/// A weight of [`Blend`]; alphas count in all four components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factor {
    /// 0.
    Zero,
    /// 1.
    One,
    /// The drawn colour, component by component.
    SourceColor,
    /// 1 − the drawn colour.
    OneMinusSourceColor,
    /// The pixel's colour.
    DestinationColor,
    /// 1 − the pixel's colour.
    OneMinusDestinationColor,
    /// The drawn alpha.
    SourceAlpha,
    /// 1 − the drawn alpha.
    OneMinusSourceAlpha,
    /// The pixel's alpha.
    DestinationAlpha,
    /// 1 − the pixel's alpha.
    OneMinusDestinationAlpha,
    /// The constant colour.
    ConstantColor,
    /// 1 − the constant colour.
    OneMinusConstantColor,
    /// The constant alpha.
    ConstantAlpha,
    /// 1 − the constant alpha.
    OneMinusConstantAlpha,
    /// The lesser of the drawn alpha and 1 − the pixel's, also for alpha.
    SourceAlphaSaturate,
}

/// How [`Blend`] puts both sides together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equation {
    /// Source + destination.
    Add,
    /// Source − destination.
    Subtract,
    /// Destination − source.
    ReverseSubtract,
    /// The lesser of the two *unweighted* values.
    Min,
    /// The greater of the two *unweighted* values.
    Max,
}

impl Blend {
    /// The default: the drawn colour as it is.
    pub const REPLACE: Blend = Blend {
        source: Factor::One,
        destination: Factor::Zero,
        equation: Equation::Add,
        constant: Rgba {
            color: [ONE; 3],
            alpha: ONE,
        },
    };

    /// The usual transparency: alpha of the drawn colour, 1 − alpha of what is below.
    pub const TRANSLUCENT: Blend = Blend {
        source: Factor::SourceAlpha,
        destination: Factor::OneMinusSourceAlpha,
        ..Blend::REPLACE
    };
}

impl Blending for Blend {
    #[inline]
    fn blend(&self, source: Rgba, below: Rgba) -> Rgba {
        let (s, d) = (components(source), components(below));
        let constant = components(self.constant);
        let weights = |factor: Factor| factor.weights(s, d, constant);
        let mut result = s;
        let sides = d.into_iter().zip(weights(self.source)).zip(weights(self.destination));
        for (s, ((d, source_weight), weight)) in result.iter_mut().zip(sides) {
            // Below 2^31·(2^31 + 2^28) < 2^63; a sum that saturates is far beyond an i32 either way.
            let (over, under) = (*s * source_weight, d * weight);
            *s = match self.equation {
                Equation::Add => rounded(over.saturating_add(under)),
                Equation::Subtract => rounded(over.saturating_sub(under)),
                Equation::ReverseSubtract => rounded(under.saturating_sub(over)),
                Equation::Min => (*s).min(d),
                Equation::Max => (*s).max(d),
            };
        }
        let [red, green, blue, alpha] = result.map(|v| v.clamp(i32::MIN as i64, i32::MAX as i64) as i32);
        Rgba {
            color: [red, green, blue],
            alpha,
        }
    }
}

impl Blending for Option<Blend> {
    #[inline]
    fn blend(&self, source: Rgba, below: Rgba) -> Rgba {
        match self {
            Some(rule) => rule.blend(source, below),
            None => source,
        }
    }
}

impl Factor {
    #[inline(always)]
    fn weights(self, source: [i64; 4], below: [i64; 4], constant: [i64; 4]) -> [i64; 4] {
        const FULL: i64 = ONE as i64;
        let rest = |v: i64| FULL - v;
        let alpha = |[.., alpha]: [i64; 4]| alpha;
        match self {
            Factor::Zero => [0; 4],
            Factor::One => [FULL; 4],
            Factor::SourceColor => source,
            Factor::OneMinusSourceColor => source.map(rest),
            Factor::DestinationColor => below,
            Factor::OneMinusDestinationColor => below.map(rest),
            Factor::SourceAlpha => [alpha(source); 4],
            Factor::OneMinusSourceAlpha => [rest(alpha(source)); 4],
            Factor::DestinationAlpha => [alpha(below); 4],
            Factor::OneMinusDestinationAlpha => [rest(alpha(below)); 4],
            Factor::ConstantColor => constant,
            Factor::OneMinusConstantColor => constant.map(rest),
            Factor::ConstantAlpha => [alpha(constant); 4],
            Factor::OneMinusConstantAlpha => [rest(alpha(constant)); 4],
            Factor::SourceAlphaSaturate => [alpha(source).min(rest(alpha(below))); 4],
        }
    }
}

#[inline(always)]
fn components(color: Rgba) -> [i64; 4] {
    let [red, green, blue] = color.color;
    [red, green, blue, color.alpha].map(i64::from)
}

/// From units of 2^-56 to 2^-28, to nearest.
#[inline(always)]
fn rounded(product: i64) -> i64 {
    product.saturating_add(1 << 27) >> 28
}
