//! Fragment programs: where colour and alpha come from, and *over* what is there.

use std::marker::PhantomData;

use fixel::blend::Rgba;
use fixel::fragment::{Antialiased, Fragment};
use fixel::texture::TowardsZero;
use fixel::varying::Varying;

use crate::emit::drawing::{self, Sampled};
use crate::fixed::sampling;

/// Texels as MP1 rounds.
pub type Sampler<'t> = sampling::Sampler<'t, TowardsZero>;

/// A sample of the picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Sample {
    /// What was blended there.
    pub color: Rgba,
    /// The primitive that drew here last, from 1; 0 is the background.
    pub primitive: u32,
}

/// Makes a fragment's colour of N interpolated values.
pub trait Paint<const N: usize> {
    /// The colour.
    fn color(&self, values: [i32; N]) -> Rgba;
    /// What it is.
    fn described(&self) -> drawing::Paint;
}

/// One colour.
pub struct Plain(pub Rgba);

/// The corners' colour and alpha, in units 2^headroom times as large.
pub struct Colors {
    /// 0 but where w has both signs.
    pub headroom: u32,
}

/// A texture's colours, in units of 2^(shift − 28).
pub struct Texels<'t> {
    /// The texture.
    pub sampler: Sampler<'t>,
    /// Its number in the log and the bits of its coordinates.
    pub sampled: Sampled,
    /// Of the scene's colours.
    pub shift: u32,
}

/// A texture over the corners' colours.
pub struct Decal<'t> {
    /// Over what.
    pub colors: Colors,
    /// What.
    pub texels: Texels<'t>,
}

impl<const N: usize> Paint<N> for Plain {
    #[inline(always)]
    fn color(&self, _: [i32; N]) -> Rgba {
        self.0
    }
    fn described(&self) -> drawing::Paint {
        drawing::Paint::Plain(self.0)
    }
}

impl Paint<4> for Colors {
    #[inline(always)]
    fn color(&self, values: [i32; 4]) -> Rgba {
        let fine = |v: i32| {
            let wide = i64::from(v) << self.headroom;
            wide.clamp(i32::MIN.into(), i32::MAX.into()) as i32
        };
        let [r, g, b, alpha] = values.map(fine);
        Rgba {
            color: [r, g, b],
            alpha,
        }
    }
    fn described(&self) -> drawing::Paint {
        drawing::Paint::Colors {
            headroom: self.headroom,
            opaque: false,
        }
    }
}

impl Paint<2> for Texels<'_> {
    #[inline(always)]
    fn color(&self, st: [i32; 2]) -> Rgba {
        Rgba::from_texel(self.sampler.texel(st), self.shift)
    }
    fn described(&self) -> drawing::Paint {
        drawing::Paint::Texels(self.sampled)
    }
}

impl Paint<6> for Decal<'_> {
    #[inline(always)]
    fn color(&self, [r, g, b, alpha, s, t]: [i32; 6]) -> Rgba {
        let below = self.colors.color([r, g, b, alpha]);
        self.texels.color([s, t]).over(below)
    }
    fn described(&self) -> drawing::Paint {
        drawing::Paint::Decal {
            sampled: self.texels.sampled,
            headroom: self.colors.headroom,
            opaque: false,
        }
    }
}

/// A paint on values of the varying `V`.
pub struct Program<V, P> {
    /// What makes the colour.
    pub paint: P,
    /// Stored with every sample.
    pub primitive: u32,
    /// How values are interpolated.
    pub varying: PhantomData<V>,
}

impl<V, P> Program<V, P> {
    /// Of a primitive.
    pub fn new(paint: P, primitive: u32) -> Self {
        Program {
            paint,
            primitive,
            varying: PhantomData,
        }
    }

    /// What it is, for the log.
    pub fn described<const N: usize>(&self) -> drawing::Program
    where
        P: Paint<N>,
    {
        drawing::Program::Paint(self.paint.described())
    }

    fn blended(&self, color: Rgba, below: Sample) -> Sample {
        Sample {
            color: color.over(below.color),
            primitive: self.primitive,
        }
    }
}

impl<V: Varying<Values = [i32; N]>, P: Paint<N>, const N: usize> Fragment for Program<V, P> {
    type Varying = V;
    type Pixel = Sample;

    #[inline]
    fn shade(&self, values: [i32; N], below: Sample) -> Option<Sample> {
        Some(self.blended(self.paint.color(values), below))
    }
}

impl<V: Varying<Values = [i32; N]>, P: Paint<N>, const N: usize> Antialiased for Program<V, P> {
    #[inline]
    fn shade_part(&self, values: [i32; N], part: i32, below: Sample) -> Option<Sample> {
        Some(self.blended(self.paint.color(values).faded(part), below))
    }
}
