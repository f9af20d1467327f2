//! Blending (chapter 10), component by component, alpha included; nothing is clamped.

/// Red, green, blue, alpha.
type Color = [f64; 4];

/// How the weighted source and destination become one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equation {
    /// Source + destination.
    Add,
    /// Source − destination.
    Subtract,
    /// Destination − source.
    ReverseSubtract,
    /// The lesser of the two, unweighted.
    Min,
    /// The greater of the two, unweighted.
    Max,
}

/// What the source or the destination is multiplied by. "One minus" takes it from 1; alphas fill all four components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say all")]
pub enum Factor {
    Zero,
    One,
    SrcColor,
    OneMinusSrcColor,
    DstColor,
    OneMinusDstColor,
    SrcAlpha,
    OneMinusSrcAlpha,
    DstAlpha,
    OneMinusDstAlpha,
    ConstantColor,
    OneMinusConstantColor,
    ConstantAlpha,
    OneMinusConstantAlpha,
    /// min(source alpha, 1 − destination alpha), in alpha too.
    SrcAlphaSaturate,
}

/// The options of blending; by default the source replaces the destination.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blend {
    /// The source's weight.
    pub source: Factor,
    /// The destination's weight.
    pub destination: Factor,
    /// How they become one.
    pub equation: Equation,
    /// For the factors that ask for it.
    pub constant: Color,
}

impl Default for Blend {
    fn default() -> Self {
        Self {
            source: Factor::One,
            destination: Factor::Zero,
            equation: Equation::Add,
            constant: [1.0; 4],
        }
    }
}

impl Blend {
    /// The usual transparency: as much of the source as its alpha says, of the destination the rest (10.4).
    pub fn transparency() -> Self {
        Self {
            source: Factor::SrcAlpha,
            destination: Factor::OneMinusSrcAlpha,
            ..Self::default()
        }
    }
}

impl Factor {
    /// The factor's four components.
    pub fn weight(self, source: Color, destination: Color, constant: Color) -> Color {
        let one_minus = |c: Color| c.map(|v| 1.0 - v);
        let alpha = |c: Color| [c[3]; 4];
        match self {
            Self::Zero => [0.0; 4],
            Self::One => [1.0; 4],
            Self::SrcColor => source,
            Self::OneMinusSrcColor => one_minus(source),
            Self::DstColor => destination,
            Self::OneMinusDstColor => one_minus(destination),
            Self::SrcAlpha => alpha(source),
            Self::OneMinusSrcAlpha => one_minus(alpha(source)),
            Self::DstAlpha => alpha(destination),
            Self::OneMinusDstAlpha => one_minus(alpha(destination)),
            Self::ConstantColor => constant,
            Self::OneMinusConstantColor => one_minus(constant),
            Self::ConstantAlpha => alpha(constant),
            Self::OneMinusConstantAlpha => one_minus(alpha(constant)),
            Self::SrcAlphaSaturate => [source[3].min(1.0 - destination[3]); 4],
        }
    }
}

/// The colour that the buffer gets.
pub fn blend(how: &Blend, source: Color, destination: Color) -> Color {
    let weighted = |factor: Factor, color: Color| -> Color {
        let weight = factor.weight(source, destination, how.constant);
        std::array::from_fn(|i| weight[i] * color[i])
    };
    let s = weighted(how.source, source);
    let d = weighted(how.destination, destination);
    std::array::from_fn(|i| match how.equation {
        Equation::Add => s[i] + d[i],
        Equation::Subtract => s[i] - d[i],
        Equation::ReverseSubtract => d[i] - s[i],
        Equation::Min => source[i].min(destination[i]),
        Equation::Max => source[i].max(destination[i]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: Color = [0.2, 0.4, 0.6, 0.5];
    const DESTINATION: Color = [1.0, 0.5, 0.0, 0.25];
    const CONSTANT: Color = [0.1, 0.2, 0.3, 0.4];

    #[test]
    fn i10_1_the_defaults_replace() {
        assert_eq!(blend(&Blend::default(), SOURCE, DESTINATION), SOURCE);
        let doubled = Blend {
            destination: Factor::One,
            ..Blend::default()
        };
        assert_eq!(blend(&doubled, [0.75; 4], [0.75; 4]), [1.5; 4]);
    }

    #[test]
    fn i10_2_equations() {
        let found = |equation, source, destination| {
            let how = Blend {
                source,
                destination,
                equation,
                constant: [1.0; 4],
            };
            blend(&how, [0.5; 4], [0.2; 4])
        };
        let ones = |equation| found(equation, Factor::One, Factor::One);
        assert_eq!(ones(Equation::Add), [0.7; 4]);
        assert_eq!(ones(Equation::Subtract), [0.3; 4]);
        assert_eq!(ones(Equation::ReverseSubtract), [-0.3; 4]);
        assert_eq!(ones(Equation::Min), [0.2; 4]);
        assert_eq!(ones(Equation::Max), [0.5; 4]);
        assert_eq!(found(Equation::Min, Factor::Zero, Factor::One), [0.2; 4]);
        assert_eq!(found(Equation::Max, Factor::Zero, Factor::Zero), [0.5; 4]);
        assert_eq!(found(Equation::Subtract, Factor::Zero, Factor::One), [-0.2; 4]);
    }

    #[test]
    fn i10_3_the_fifteen_factors() {
        let expected = [
            (Factor::Zero, [0.0; 4]),
            (Factor::One, [1.0; 4]),
            (Factor::SrcColor, [0.2, 0.4, 0.6, 0.5]),
            (Factor::OneMinusSrcColor, [0.8, 0.6, 0.4, 0.5]),
            (Factor::DstColor, [1.0, 0.5, 0.0, 0.25]),
            (Factor::OneMinusDstColor, [0.0, 0.5, 1.0, 0.75]),
            (Factor::SrcAlpha, [0.5; 4]),
            (Factor::OneMinusSrcAlpha, [0.5; 4]),
            (Factor::DstAlpha, [0.25; 4]),
            (Factor::OneMinusDstAlpha, [0.75; 4]),
            (Factor::ConstantColor, [0.1, 0.2, 0.3, 0.4]),
            (Factor::OneMinusConstantColor, [0.9, 0.8, 0.7, 0.6]),
            (Factor::ConstantAlpha, [0.4; 4]),
            (Factor::OneMinusConstantAlpha, [0.6; 4]),
            (Factor::SrcAlphaSaturate, [0.5; 4]),
        ];
        for (factor, weight) in expected {
            assert_eq!(factor.weight(SOURCE, DESTINATION, CONSTANT), weight, "{factor:?}");
        }
        let opaque = [1.0, 0.5, 0.0, 0.75];
        assert_eq!(Factor::SrcAlphaSaturate.weight(SOURCE, opaque, CONSTANT), [0.25; 4]);
    }
}
