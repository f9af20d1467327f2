//! The exact tier with one dial turned.

use fixel::fragment::Gouraud565;
use fixel::num::{OneStep, Table};
use fixel::quality::{Exact, Quality};
use fixel::varying::{Color565, Linear32, Perspective32, PerspectiveSpans};

/// The exact tier but for what is said.
macro_rules! exact_but {
    ($(#[$doc:meta])* $name:ident, $($dial:tt)*) => {
        $(#[$doc])*
        pub enum $name {}

        impl Quality for $name {
            const NAME: &'static str = stringify!($name);
            exact_but!(@perspective $($dial)*);
            exact_but!(@color $($dial)*);
            exact_but!(@precision $($dial)*);
            exact_but!(@trigonometry $($dial)*);
        }
    };
    (@perspective perspective $n:ident $kind:ty) => { type Perspective<const $n: usize> = $kind; };
    (@perspective $($other:tt)*) => { type Perspective<const N: usize> = <Exact as Quality>::Perspective<N>; };
    (@color color $kind:ty, $fragment:ident) => {
        type Color = $kind;
        type Gouraud = $fragment;
        const GOURAUD: $fragment = $fragment;
    };
    (@color $($other:tt)*) => {
        type Color = <Exact as Quality>::Color;
        type Gouraud = <Exact as Quality>::Gouraud;
        const GOURAUD: Self::Gouraud = <Exact as Quality>::GOURAUD;
    };
    (@precision precision $kind:ty) => { type Precision = $kind; };
    (@precision $($other:tt)*) => { type Precision = <Exact as Quality>::Precision; };
    (@trigonometry trigonometry $kind:ty) => { type Trigonometry = $kind; };
    (@trigonometry $($other:tt)*) => { type Trigonometry = <Exact as Quality>::Trigonometry; };
}

exact_but! {
    /// Values in perspective taken as linear over the screen.
    Affine, perspective N Linear32<N>
}
exact_but! {
    /// By a reciprocal from a table, or linear where that is within half a texel.
    HalfTexel, perspective N PerspectiveSpans<N, 128>
}
exact_but! {
    /// The same within an eighth of a texel.
    EighthTexel, perspective N PerspectiveSpans<N, 32>
}
exact_but! {
    /// As good as words of 32 bits do it, divided at every pixel.
    Narrow, perspective N Perspective32<N>
}
exact_but! {
    /// Two channels of a colour in a word.
    Packed, color Color565, Gouraud565
}
exact_but! {
    /// Reciprocals, roots and powers from tables alone.
    Tables, precision Table
}
exact_but! {
    /// One Newton step after the table.
    OneNewton, precision OneStep
}
