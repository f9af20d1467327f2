//! The textures (PG.10, PG.12, PG.13): two of them random in the course, and fixed here so that pictures can be compared.

use super::scene::Texture;

/// A square texture, rows from v = 0 upwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Texels {
    /// Texels in a row, and rows.
    pub size: u32,
    /// `size * size` colours, red, green, blue, alpha, 0 to 1.
    pub colors: Vec<[f64; 4]>,
}

/// The two textures that the course leaves to chance.
#[derive(Debug, Clone, PartialEq)]
pub struct Textures {
    /// 16x16 colours.
    pub random: Texels,
    /// 32x32, white with alpha.
    pub frost: Texels,
}

/// Any numbers (xorshift64*): the same ones for the same seed.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// A source of numbers.
    pub fn new(seed: u64) -> Self {
        // Zero would stay zero.
        Self(seed.wrapping_mul(2).wrapping_add(1))
    }

    /// The next number.
    pub fn byte(&mut self) -> u8 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 56) as u8
    }
}

impl Textures {
    /// The fixed ones.
    pub fn fixed() -> Self {
        let random = |x, y| [0, 1, 2, 3].map(|c| 37 * x + 91 * y + 53 * c + 17 * x * y).map(level);
        Self {
            random: Texels::from_fn(16, random),
            frost: frost(|x, y| level(29 * x + 71 * y + 13 * x * y)),
        }
    }

    /// Random ones, as in the course.
    pub fn course(seed: u64) -> Self {
        let mut source = Random::new(seed);
        Self {
            random: Texels::from_fn(16, |_, _| [0; 4].map(|_: i32| level(source.byte().into()))),
            frost: frost(|_, _| level(source.byte().into())),
        }
    }

    /// The texels of a texture.
    pub fn texels(&self, texture: Texture) -> Texels {
        match texture {
            Texture::Board => board(),
            Texture::Random => self.random.clone(),
            Texture::Frost => self.frost.clone(),
        }
    }
}

impl Texels {
    fn from_fn(size: u32, mut color: impl FnMut(u32, u32) -> [f64; 4]) -> Self {
        let places = (0..size).flat_map(|y| (0..size).map(move |x| (x, y)));
        let colors = places.map(|(x, y)| color(x, y)).collect();
        Self { size, colors }
    }

    /// The colours in eight bits, rounded to nearest.
    pub fn bytes(&self) -> Vec<[u8; 4]> {
        let byte = |v: f64| (255.0 * v).round() as u8;
        self.colors.iter().map(|color| color.map(byte)).collect()
    }
}

/// The last eight bits of a number, 1 being 255.
fn level(number: u32) -> f64 {
    f64::from(number % 256) / 255.0
}

fn board() -> Texels {
    Texels::from_fn(9, |x, y| {
        let white = f64::from(u8::from((x + y) % 2 == 0));
        [white, white, white, 1.0]
    })
}

/// White with an alpha that is made of a noise of 0 to 1: nearly opaque but for some holes, and blurred.
fn frost(mut noise: impl FnMut(u32, u32) -> f64) -> Texels {
    const SIZE: u32 = 32;
    let places = (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y)));
    let alphas: Vec<f64> = places.map(|(x, y)| opacity(noise(x, y))).collect();
    let at = |alphas: &[f64], x: i32, y: i32| {
        let [x, y] = [x, y].map(|c| c.clamp(0, SIZE as i32 - 1) as usize);
        alphas[y * SIZE as usize + x]
    };
    let along_x = blurred(SIZE, |x, y, by| at(&alphas, x + by, y));
    let along_y = blurred(SIZE, |x, y, by| at(&along_x, x, y + by));
    let colors = along_y.into_iter().map(|alpha| [1.0, 1.0, 1.0, alpha]);
    Texels {
        size: SIZE,
        colors: colors.collect(),
    }
}

fn opacity(noise: f64) -> f64 {
    let t = ((noise - 0.2) / (0.7 - 0.2)).clamp(0.0, 1.0);
    let smooth = t * t * (3.0 - 2.0 * t);
    smooth.powf(1.0 / 32.0).min(1.0)
}

/// The five-tap filter 1, 4, 6, 4, 1 over the neighbours that `at` gives for each texel and distance.
fn blurred(size: u32, at: impl Fn(i32, i32, i32) -> f64) -> Vec<f64> {
    let taps = [(-2, 1.0), (-1, 4.0), (0, 6.0), (1, 4.0), (2, 1.0)];
    let places = (0..size as i32).flat_map(|y| (0..size as i32).map(move |x| (x, y)));
    let filtered = |(x, y)| taps.iter().map(|&(by, weight)| weight / 16.0 * at(x, y, by)).sum();
    places.map(filtered).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pg_10_the_board_begins_white() {
        let board = board();
        assert_eq!((board.size, board.colors.len()), (9, 81));
        assert_eq!(board.colors[0], [1.0; 4]);
        assert_eq!(board.colors[1], [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(board.colors[9], [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(board.colors[80], [1.0; 4]);
    }

    #[test]
    fn pg_12_the_fixed_colours() {
        let random = Textures::fixed().random;
        assert_eq!(random.bytes()[0], [0, 53, 106, 159]);
        // 37 · 3 + 91 · 2 + 17 · 6 = 395.
        assert_eq!(random.bytes()[2 * 16 + 3], [139, 192, 245, 42]);
    }

    #[test]
    fn pg_13_the_fixed_frost() {
        let frost = Textures::fixed().frost;
        let alpha = |x: usize, y: usize| frost.colors[y * 32 + x][3];
        for ((x, y), expected) in [((0, 0), 0.333798), ((5, 3), 0.713793), ((16, 16), 0.661073)] {
            assert!((alpha(x, y) - expected).abs() < 1e-6, "{x} {y}: {}", alpha(x, y));
        }
        let alphas = frost.colors.iter().map(|color| color[3]);
        let (least, most) = alphas.fold((1.0_f64, 0.0_f64), |(least, most), a| (least.min(a), most.max(a)));
        assert!(
            (least - 0.333798).abs() < 1e-6 && (most - 0.985280).abs() < 1e-6,
            "{least} {most}"
        );
    }

    #[test]
    fn random_textures_follow_their_seed() {
        assert_eq!(Textures::course(1), Textures::course(1));
        assert_ne!(Textures::course(1).random, Textures::course(2).random);
        assert_ne!(Textures::course(1).frost, Textures::course(2).frost);
    }
}
