//! Textures (06.6 to 06.8): v upwards, row 0 at v = 0.

use super::image::Image;

/// How a value is taken from the texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Filter {
    /// The texel that the place lies in.
    #[default]
    Nearest,
    /// The four texels round the place, by their distances.
    Linear,
}

/// Which texel stands for one outside the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The nearest one at the border.
    #[default]
    ClampToEdge,
    /// The image again and again.
    Repeat,
    /// The image again and again, every other one mirrored.
    MirroredRepeat,
    /// One mirrored image below 0, then the border.
    MirroredClampToEdge,
}

/// How a texture is looked up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sampler {
    /// How texels are combined.
    pub filter: Filter,
    /// Outside along u and along v.
    pub wrap: [Wrap; 2],
}

impl Wrap {
    /// The texel, 0 to `size` − 1, that stands for texel `i`; `size` is above 0.
    pub fn texel(self, i: i64, size: u32) -> i64 {
        let n = i64::from(size);
        match self {
            Self::ClampToEdge => i.clamp(0, n - 1),
            Self::Repeat => i.rem_euclid(n),
            Self::MirroredRepeat => (n - 1) - mirror(i.rem_euclid(2 * n) - n),
            Self::MirroredClampToEdge => mirror(i).clamp(0, n - 1),
        }
    }
}

fn mirror(a: i64) -> i64 {
    if a >= 0 { a } else { -1 - a }
}

impl Sampler {
    /// The texture's value at (u, v); none of an image without texels.
    pub fn sample<const N: usize>(self, image: &Image<N>, [u, v]: [f64; 2]) -> Option<[f64; N]> {
        let place = [u * f64::from(image.width()), v * f64::from(image.height())];
        match self.filter {
            Filter::Nearest => self.texel(image, place.map(|c| c.floor() as i64)),
            Filter::Linear => self.linear(image, place),
        }
    }

    fn linear<const N: usize>(self, image: &Image<N>, place: [f64; 2]) -> Option<[f64; N]> {
        let low = place.map(|c| (c - 0.5).floor());
        let [s, t] = [place[0] - 0.5 - low[0], place[1] - 0.5 - low[1]];
        let [i, j] = low.map(|c| c as i64);
        let [i1, j1] = [i.saturating_add(1), j.saturating_add(1)];
        let below = mix(self.texel(image, [i, j])?, self.texel(image, [i1, j])?, s);
        let above = mix(self.texel(image, [i, j1])?, self.texel(image, [i1, j1])?, s);
        Some(mix(below, above, t))
    }

    fn texel<const N: usize>(self, image: &Image<N>, [i, j]: [i64; 2]) -> Option<[f64; N]> {
        let [wrap_s, wrap_t] = self.wrap;
        if image.width() == 0 || image.height() == 0 {
            return None;
        }
        image.get(wrap_s.texel(i, image.width()), wrap_t.texel(j, image.height()))
    }
}

fn mix<const N: usize>(a: [f64; N], b: [f64; N], t: f64) -> [f64; N] {
    std::array::from_fn(|i| (1.0 - t) * a[i] + t * b[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn i06_6_nearest_on_the_board() {
        let board = Image::from_fn(9, 9, |x, y| [f64::from(u8::from((x + y) % 2 == 0))]);
        let at = |uv| Sampler::default().sample(&board, uv);
        assert_eq!(at([0.0, 0.0]), Some([1.0]));
        assert_eq!(at([0.12, 0.0]), Some([0.0]));
        assert_eq!(at([1.0, 1.0]), Some([1.0]));
        assert_eq!(Sampler::default().sample(&Image::new(0, 0, [1.0]), [0.5, 0.5]), None);
    }

    #[test]
    fn i06_6_v_points_up() {
        let image = Image::from_fn(1, 4, |_, y| [f64::from(y)]);
        assert_eq!(Sampler::default().sample(&image, [0.5, 0.3]), Some([1.0]));
    }

    #[test]
    fn i06_7_linear_between_two_texels() {
        let image = Image::from_fn(2, 1, |x, _| [f64::from(x)]);
        let at = |u, wrap| {
            let filter = Filter::Linear;
            let sampler = Sampler {
                filter,
                wrap: [wrap; 2],
            };
            sampler.sample(&image, [u, 0.5]).expect("texels")[0]
        };
        for (u, expected) in [(0.25, 0.0), (0.5, 0.5), (0.6, 0.7), (0.9, 1.0)] {
            assert!((at(u, Wrap::ClampToEdge) - expected).abs() < 1e-12, "{u}");
        }
        assert!((at(0.9, Wrap::Repeat) - 0.7).abs() < 1e-12);
        // Along v by the same rule.
        let image = Image::from_fn(1, 2, |_, y| [f64::from(y)]);
        let sampler = Sampler {
            filter: Filter::Linear,
            ..Sampler::default()
        };
        let value = sampler.sample(&image, [0.5, 0.6]).expect("texels")[0];
        assert!((value - 0.7).abs() < 1e-12);
    }

    #[test]
    fn i06_8_wrapping_of_whole_texels() {
        let row = |wrap: Wrap| (-5..=8).map(|i| wrap.texel(i, 4).to_string()).collect::<String>();
        assert_eq!(row(Wrap::ClampToEdge), "00000012333333");
        assert_eq!(row(Wrap::Repeat), "30123012301230");
        assert_eq!(row(Wrap::MirroredRepeat), "33210012332100");
        assert_eq!(row(Wrap::MirroredClampToEdge), "33210012333333");
    }

    #[test]
    fn i06_8_every_place_has_a_texel() {
        let image = Image::from_fn(3, 2, |x, y| [f64::from(x + y)]);
        for wrap in [
            Wrap::ClampToEdge,
            Wrap::Repeat,
            Wrap::MirroredRepeat,
            Wrap::MirroredClampToEdge,
        ] {
            for u in [-1e300, -7.3, -1.0, 0.0, 1.0, 9.9, 1e300] {
                let sampler = Sampler {
                    filter: Filter::Nearest,
                    wrap: [wrap; 2],
                };
                assert!(sampler.sample(&image, [u, u]).is_some(), "{wrap:?} {u}");
            }
        }
    }
}
