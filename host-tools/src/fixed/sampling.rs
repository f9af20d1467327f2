//! Texels looked up as the dial says.

use fixel::blend::Rgba;
use fixel::pipeline::{Filter, LinearFilter, Repeat, Wrap};
use fixel::texture::{Nearest, Rgba8888, Rounding, Texel, Texture};

use super::dials::Sampling;

/// Looks up texels of a texture that repeats, texel (i, j) being centred at (i, j); `R` is how the format rounds.
#[derive(Clone, Copy)]
pub struct Sampler<'t, R> {
    texture: Texture<'t, Rgba8888>,
    nearest: Nearest<'t, Rgba8888, R>,
    fraction_bits: u32,
    sampling: Sampling,
}

impl<'t, R: Rounding> Sampler<'t, R> {
    /// At coordinates in units of 2^-`fraction_bits` texel, 30 at most.
    pub fn new(texture: Texture<'t, Rgba8888>, fraction_bits: u32, sampling: Sampling) -> Self {
        Sampler {
            texture,
            nearest: Nearest::new(texture, fraction_bits),
            fraction_bits,
            sampling,
        }
    }

    /// The texel in which a place lies, or the four around it, rounded to bytes.
    #[inline]
    pub fn texel(&self, st: [i32; 2]) -> Texel {
        match self.sampling {
            Sampling::Nearest => self.nearest.texel(st),
            Sampling::Linear => linear(&self.texture, self.fraction_bits, st),
        }
    }
}

fn linear(texture: &Texture<'_, Rgba8888>, fraction_bits: u32, st: [i32; 2]) -> Texel {
    // The filter has centres at halves, and takes 30 bits at most: whole texels get one for the half.
    let more = u32::from(fraction_bits == 0);
    let fraction_bits = fraction_bits + more;
    let place = st.map(|c| (i64::from(c) << more) + (1 << (fraction_bits - 1)));
    let texel = |i, j| {
        let (i, j) = (Repeat.wrap(i, texture.width()), Repeat.wrap(j, texture.height()));
        Rgba::from_texel(texture.texel(i, j), 0)
    };
    let Rgba { color, alpha } = LinearFilter.sample(place, fraction_bits, texel);
    let [red, green, blue] = color;
    Texel([red, green, blue, alpha].map(|c| ((i64::from(c) * 255 + (1 << 27)) >> 28) as u8))
}

#[cfg(test)]
mod tests {
    use fixel::texture::Floor;

    use super::*;

    #[test]
    fn both_agree_at_centres_and_linear_is_halfway_between() {
        let texels = [[0, 10, 20, 255], [100, 110, 20, 255]];
        let texture = Texture::new(Rgba8888, &texels, 2, 1).unwrap();
        for bits in [0, 4, 30] {
            let [nearest, linear] =
                [Sampling::Nearest, Sampling::Linear].map(|sampling| Sampler::<Floor>::new(texture, bits, sampling));
            for i in [0, 1] {
                let st = [i << bits, 0];
                assert_eq!(nearest.texel(st), Texel(texels[i as usize]));
                assert_eq!(linear.texel(st), Texel(texels[i as usize]), "{bits}");
            }
            if bits > 0 {
                let halfway = [1 << (bits - 1), 0];
                assert_eq!(linear.texel(halfway), Texel([50, 60, 20, 255]));
                assert_eq!(nearest.texel(halfway), Texel(texels[1]));
            }
        }
    }
}
