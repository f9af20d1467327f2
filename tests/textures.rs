//! Textures: the texel that is picked is exact, formats and decals keep their bounds, coordinates arrive as close as stated.

mod naive;

use fixel::depth::NoDepth;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::Fragment;
use fixel::screen::{Corner, FineDepth, Position, SubPx};
use fixel::target::Buffer;
use fixel::texture::{Floor, Format, Nearest, Palette, Rgb565, Rgba8888, Rounding, Texel, Texture, TowardsZero};
use fixel::varying::Perspective;
use naive::Point;
use proptest::prelude::*;

/// The definition: round(v / 2^bits + ½) mod size, with exact fractions.
fn defined(v: i32, bits: u32, size: u16, towards_zero: bool) -> u16 {
    // v/2^bits + ½ = numerator / denominator.
    let (numerator, denominator) = (2 * i128::from(v) + (1 << bits), 2 << bits);
    let whole = if towards_zero {
        numerator / denominator
    } else {
        numerator.div_euclid(denominator)
    };
    whole.rem_euclid(size.into()) as u16
}

/// Texels that are their own index.
fn numbered() -> Vec<u16> {
    (0..=u16::MAX).collect()
}

fn check(texels: &[u16], v: i32, bits: u32, size: u16) {
    let row = Texture::new(Rgb565, texels, size, 1).unwrap();
    let column = Texture::new(Rgb565, texels, 1, size).unwrap();
    let floor = defined(v, bits, size, false);
    let cut = defined(v, bits, size, true);
    assert_eq!(
        Nearest::<_, Floor>::new(row, bits).stored([v, -7]),
        floor,
        "{v} / 2^{bits}, {size}"
    );
    assert_eq!(
        Nearest::<_, Floor>::new(column, bits).stored([9, v]),
        floor,
        "{v} / 2^{bits}, {size}"
    );
    assert_eq!(
        Nearest::<_, TowardsZero>::new(row, bits).stored([v, -7]),
        cut,
        "{v} / 2^{bits}, {size}"
    );
    assert_eq!(
        Nearest::<_, TowardsZero>::new(column, bits).stored([9, v]),
        cut,
        "{v} / 2^{bits}, {size}"
    );
}

/// Every size up to 40, every coordinate of 5 fraction bits within four repetitions either way: 530,000 coordinates.
#[test]
fn every_coordinate_of_small_textures() {
    let texels = numbered();
    for size in 1..=40u16 {
        let reach = i32::from(size) * 32 * 4 + 16;
        for v in -reach..=reach {
            check(&texels, v, 5, size);
        }
    }
}

/// The ends of the range, with every number of fraction bits.
#[test]
fn extreme_coordinates() {
    let texels = numbered();
    for size in [1, 2, 3, 64, 1000, 1023, 32768, 65535] {
        for bits in 0..=31 {
            let half = (1i64 << bits >> 1) as i32;
            for v in [
                i32::MIN,
                i32::MIN + 1,
                -half - 1,
                -half,
                -half + 1,
                -1,
                0,
                1,
                half - 1,
                half,
                i32::MAX - 1,
                i32::MAX,
            ] {
                check(&texels, v, bits, size);
            }
        }
    }
}

proptest! {
    #[test]
    fn any_coordinate_of_any_texture(v in any::<i32>(), bits in 0..=31u32, size in 1..=u16::MAX) {
        check(&numbered(), v, bits, size);
    }

    #[test]
    fn both_axes_of_any_texture(s in any::<i32>(), t in any::<i32>(), width in 1..=300u16, height in 1..=200u16) {
        let texels = numbered();
        let texture = Texture::new(Rgb565, &texels, width, height).unwrap();
        let index = defined(t, 16, height, false) * width + defined(s, 16, width, false);
        prop_assert_eq!(Nearest::<_, Floor>::new(texture, 16).stored([s, t]), index);
    }

    /// Repetitions change nothing, and TowardsZero differs from Floor by one texel, below zero only.
    #[test]
    fn the_two_roundings(whole in -1000..1000i32, fraction in 0..65536i32) {
        let v = (whole << 16) + fraction;
        let (floor, cut) = (Floor::index(v, 16), TowardsZero::index(v, 16));
        prop_assert_eq!(Floor::index(v - (5 << 16), 16), floor - 5);
        prop_assert_eq!(cut - floor, (v < -32768 && fraction != 32768) as i32);
    }
}

/// hw2.md: −1.3, −0.3, 0.7 and 1.7 all name one texel. mp1.md: below zero it is the next one.
#[test]
fn the_formats_own_examples() {
    let texels: Vec<u16> = (0..10).collect();
    let texture = Texture::new(Rgb565, &texels, 10, 1).unwrap();
    let at = |tenths: i32| [(tenths * 10 * 65536) / 10, 0];
    let floor = Nearest::<_, Floor>::new(texture, 16);
    let cut = Nearest::<_, TowardsZero>::new(texture, 16);
    assert_eq!([-13, -3, 7, 17].map(|s| floor.stored(at(s))), [7; 4]);
    // At whole texels x + ½ is cut up below zero.
    assert_eq!([-13, -3, 7, 17].map(|s| cut.stored(at(s))), [8, 8, 7, 7]);
}

/// 1×1, odd, long, tall.
#[test]
fn odd_sizes() {
    let texels: Vec<[u8; 4]> = (0..3000u32).map(u32::to_le_bytes).collect();
    let number = |t: Texel| u32::from_le_bytes(t.0);
    for (width, height) in [(1u16, 1u16), (3, 1), (1, 3), (7, 5), (1000, 3), (3, 1000), (999, 3)] {
        let texture = Texture::new(Rgba8888, &texels, width, height).unwrap();
        assert_eq!((texture.width(), texture.height()), (width, height));
        let sampler = Nearest::<_, Floor>::new(texture, 8);
        for (i, j) in [
            (0, 0),
            (width - 1, 0),
            (0, height - 1),
            (width - 1, height - 1),
            (width / 2, height / 2),
        ] {
            let expected = u32::from(j) * u32::from(width) + u32::from(i);
            assert_eq!(number(texture.texel(i, j)), expected);
            for turns in -2..=2 {
                let coordinate = |v: u16, size: u16| (i32::from(v) + turns * i32::from(size)) * 256 - 128;
                assert_eq!(
                    number(sampler.texel([coordinate(i, width), coordinate(j, height)])),
                    expected
                );
            }
        }
        assert_eq!(texture.texel(width, 0), Texel::default());
        assert_eq!(texture.texel(0, height), Texel::default());
    }
}

#[test]
fn sizes_are_checked() {
    let texels = [0u16; 3000];
    assert!(Texture::new(Rgb565, &texels, 1000, 3).is_ok());
    assert_eq!(Texture::new(Rgb565, &texels, 1001, 3), Err(Error::BufferTooSmall));
    assert_eq!(Texture::new(Rgb565, &texels, 65535, 65535), Err(Error::BufferTooSmall));
    assert_eq!(Texture::new(Rgb565, &texels, 0, 0), Err(Error::EmptyTexture));
    assert_eq!(Texture::new(Rgb565, &texels, 3, 0), Err(Error::EmptyTexture));
}

/// All 65,536 words: each channel is the nearest byte, and none is halfway between two.
#[test]
fn rgb565_expands_exactly() {
    let nearest = |v: u16, most: u16| {
        assert_ne!((2 * 255 * u32::from(v)) % u32::from(2 * most), u32::from(most));
        ((2 * 255 * u32::from(v) + u32::from(most)) / u32::from(2 * most)) as u8
    };
    for word in 0..=u16::MAX {
        let (red, green, blue) = (word >> 11, word >> 5 & 63, word & 31);
        let expected = [nearest(red, 31), nearest(green, 63), nearest(blue, 31), 255];
        assert_eq!(Rgb565.texel(word), Texel(expected));
    }
}

/// Everything a constant: the compiler has checked the sizes by the time this runs.
#[test]
fn textures_are_constants() {
    const COLORS: [[u8; 4]; 2] = [[1, 2, 3, 255], [4, 5, 6, 7]];
    static FLAG: Texture<'static, Palette<'static>> = match Texture::new(Palette(&COLORS), &[1, 0, 2], 3, 1) {
        Ok(texture) => texture,
        Err(_) => panic!(),
    };
    static SAMPLER: Nearest<'static, Palette<'static>, Floor> = Nearest::new(FLAG, 16);
    assert_eq!(SAMPLER.texel([0, 0]), Texel([4, 5, 6, 7]));
    assert_eq!(SAMPLER.texel([1 << 16, 0]), Texel([1, 2, 3, 255]));
    // An index beyond the palette.
    assert_eq!(SAMPLER.texel([-1 << 16, 0]), Texel([0; 4]));
}

proptest! {
    /// Decals: at most ½ + d·2^-25 units from exact, and between texel and colour.
    #[test]
    fn decals_keep_their_bound(texel in any::<[u8; 4]>(), color in any::<[i32; 3]>(), near in any::<bool>()) {
        let color = if near { color.map(|c| c >> 7) } else { color };
        let mixed = Texel(texel).over(color, 0);
        let alpha = i128::from(texel[3]);
        for k in 0..3 {
            let (t, c) = (i128::from(texel[k]) << 16, i128::from(color[k]));
            // In units of 2^-25·2^-16 level, times 255.
            let error = i128::from(mixed[k]) * 255 - (t * alpha + c * (255 - alpha));
            prop_assert!((error << 25).abs() <= 255 * ((1 << 24) + (t - c).abs()), "{error}/255 units");
            prop_assert!((t.min(c)..=t.max(c)).contains(&i128::from(mixed[k])));
            if (0..=255 << 16).contains(&color[k]) {
                prop_assert!(error.abs() <= 255);
            }
        }
        if texel[3] == 0 {
            prop_assert_eq!(mixed, color);
        }
        if texel[3] == 255 {
            prop_assert_eq!(mixed, Texel(texel).channels(0));
        }
    }

    /// With units of 2^(shift − 16) levels, another half.
    #[test]
    fn bright_decals_keep_their_bound(texel in any::<[u8; 4]>(), color in any::<[i32; 3]>(), shift in 0..40u32) {
        let mixed = Texel(texel).over(color, shift);
        let alpha = i128::from(texel[3]);
        for k in 0..3 {
            // Everything in units of 2^-40 of the fragment's, times 255.
            let (t, c) = ((i128::from(texel[k]) << 56) >> shift, i128::from(color[k]) << 40);
            let error = (i128::from(mixed[k]) << 40) * 255 - (t * alpha + c * (255 - alpha));
            prop_assert!(error.abs() <= 255 * ((1i128 << 40) + ((t - c).abs() >> 25) + (1 << 20)));
        }
    }
}

/// Every level at every shift: the nearest unit, a tie upwards.
#[test]
fn channels_are_rounded() {
    for level in 0..=255u8 {
        for shift in 0..40u32 {
            let exact = (f64::from(level) * 65536.0 / f64::powi(2.0, shift as i32) + 0.5).floor();
            assert_eq!(
                Texel([level, 0, 255, 9]).channels(shift)[0],
                exact as i32,
                "{level}, {shift}"
            );
        }
    }
}

/// Stores what the varying brought.
struct Coordinates;

impl Fragment for Coordinates {
    type Varying = Perspective<2>;
    type Pixel = Option<[i32; 2]>;
    fn shade(&self, st: [i32; 2], _: Self::Pixel) -> Option<Self::Pixel> {
        Some(Some(st))
    }
}

/// A corner: position in subpixels, its w as near·2^30 / w, and texels.
#[derive(Clone, Copy)]
struct Vertex {
    position: Point,
    inverse: i64,
    texels: [i64; 2],
}

/// The largest error in texels over a triangle, and how many pixels were looked at.
fn largest_error(vertices: [Vertex; 3], bits: u32) -> (f64, usize) {
    const SIZE: (u16, u16) = (320, 240);
    let corners = vertices.map(|v| Corner {
        position: Position::nearest(SubPx::from_bits(v.position.0), SubPx::from_bits(v.position.1)),
        depth: FineDepth::ZERO,
        varying: Perspective::new(v.texels.map(|t| (t << bits) as i32), v.inverse as i32),
    });
    let mut picture = vec![None; usize::from(SIZE.0) * usize::from(SIZE.1)];
    let mut target = Buffer::new(&mut picture, SIZE.0, SIZE.1).unwrap();
    draw::triangle(&mut target, &mut NoDepth, corners, &Coordinates);

    let positions = vertices.map(|v| v.position);
    let (mut worst, mut count) = (0f64, 0);
    for (k, found) in picture.iter().enumerate() {
        let Some(found) = found else { continue };
        let (x, y) = ((k % usize::from(SIZE.0)) as i32, (k / usize::from(SIZE.0)) as i32);
        let (inverse, _) = naive::value(positions, vertices.map(|v| v.inverse), x, y);
        for (axis, found) in found.iter().enumerate() {
            let (over_w, _) = naive::value(positions, vertices.map(|v| v.inverse * v.texels[axis]), x, y);
            // Both are exact integers; found / 2^bits − over_w / inverse in one fraction.
            let numerator = i128::from(*found) * inverse - (over_w << bits);
            worst = worst.max((numerator as f64 / inverse as f64).abs() / (1u64 << bits) as f64);
        }
        count += 1;
    }
    (worst, count)
}

/// A quad from `near` (w = 1) at the bottom to `far` (w = ratio) at the top, the whole texture on it, at ten shapes whose
/// corners lie anywhere in a pixel.
fn worst_on_quads(size: i64, ratio: i64, bits: u32) -> f64 {
    let mut worst = 0f64;
    for shape in 0..10 {
        let jitter = |k: i32| (shape * 7919 + k * 104_729) % 2560;
        // Exact 1/w: the ratio divides the unit, or the unit is a multiple of it.
        let one = (1 << 30) / ratio * ratio;
        let vertex = |x: i32, y: i32, k: i32, w: i64, texels| Vertex {
            position: (x * 256 + jitter(k), y * 256 + jitter(k + 9)),
            inverse: one / w,
            texels,
        };
        let a = vertex(100, 5, 1, ratio, [0, 0]);
        let b = vertex(200, 5, 2, ratio, [size, 0]);
        let c = vertex(3, 225, 3, 1, [0, size]);
        let d = vertex(305, 225, 4, 1, [size, size]);
        for triangle in [[a, b, c], [d, c, b]] {
            let (error, count) = largest_error(triangle, bits);
            assert!(count > 1000);
            worst = worst.max(error);
        }
    }
    worst
}

/// With the customary 16 fraction bits and with as many as fit: at most 2^-8 texel, 1/16 at a ratio of 1000.
#[test]
fn coordinates_on_a_quad_in_perspective() {
    println!("largest error in units of 2^-8 texel, by ratio of w");
    println!("texture  bits      1       2      10     100    1000");
    for size in [64i64, 256, 1024] {
        let most_bits = 30 - size.ilog2();
        for bits in [16, most_bits] {
            let errors = [1, 2, 10, 100, 1000].map(|ratio| worst_on_quads(size, ratio, bits));
            let [a, b, c, d, e] = errors.map(|e| e * 256.0);
            println!("{size:4}²     {bits:2} {a:7.4} {b:7.4} {c:7.4} {d:7.4} {e:7.4}");
            let [.., widest] = errors;
            assert!(errors[..4].iter().all(|&e| e <= 1.0 / 256.0), "{size}: {errors:?}");
            assert!(widest <= 1.0 / 16.0, "{size}: {widest}");
        }
    }
}

/// A textured quad: each pixel has the texel of its exact coordinate wherever that is not within the error of a border.
#[test]
fn a_textured_quad() {
    struct Textured(Nearest<'static, Rgb565, Floor>);
    impl Fragment for Textured {
        type Varying = Perspective<2>;
        type Pixel = u16;
        fn shade(&self, st: [i32; 2], _: u16) -> Option<u16> {
            Some(self.0.stored(st))
        }
    }
    const TEXELS: [u16; 35] = {
        let mut texels = [0; 35];
        let mut i = 0;
        while i < 35 {
            texels[i] = i as u16;
            i += 1;
        }
        texels
    };
    const TEXTURE: Texture<'static, Rgb565> = match Texture::new(Rgb565, &TEXELS, 7, 5) {
        Ok(texture) => texture,
        Err(_) => panic!(),
    };
    // Three by two repetitions, from −7 texels on.
    let vertex = |x: i32, y: i32, inverse: i64, texels| Vertex {
        position: (x, y),
        inverse,
        texels,
    };
    let a = vertex(11_111, 1_000, 1 << 28, [-7, -5]);
    let b = vertex(22_222, 1_300, 1 << 28, [14, -5]);
    let c = vertex(500, 30_100, 1 << 30, [-7, 5]);
    let d = vertex(32_000, 30_001, 1 << 30, [14, 5]);
    let (mut borders, mut drawn) = (0, 0);
    for triangle in [[a, b, c], [d, c, b]] {
        let mut picture = [u16::MAX; 128 * 128];
        let corners = triangle.map(|v| Corner {
            position: Position::nearest(SubPx::from_bits(v.position.0), SubPx::from_bits(v.position.1)),
            depth: FineDepth::ZERO,
            varying: Perspective::new(v.texels.map(|t| (t << 16) as i32), v.inverse as i32),
        });
        let sampler = Textured(Nearest::new(TEXTURE, 16));
        draw::triangle(
            &mut Buffer::new(&mut picture, 128, 128).unwrap(),
            &mut NoDepth,
            corners,
            &sampler,
        );
        let positions = triangle.map(|v| v.position);
        for (k, &found) in picture.iter().enumerate() {
            let (x, y) = ((k % 128) as i32, (k / 128) as i32);
            if !naive::covers(positions, x, y) {
                assert_eq!(found, u16::MAX);
                continue;
            }
            let (inverse, _) = naive::value(positions, triangle.map(|v| v.inverse), x, y);
            let place = [0, 1].map(|axis| {
                let (over_w, _) = naive::value(positions, triangle.map(|v| v.inverse * v.texels[axis]), x, y);
                over_w as f64 / inverse as f64 + 0.5
            });
            drawn += 1;
            if place.iter().any(|p| (p - p.round()).abs() < 1.0 / 256.0) {
                borders += 1;
                continue;
            }
            let [i, j] = place.map(|p| p.floor() as i64);
            assert_eq!(
                i64::from(found),
                j.rem_euclid(5) * 7 + i.rem_euclid(7),
                "pixel ({x}, {y}) at {place:?}"
            );
        }
    }
    println!("{borders} of {drawn} pixels within 2^-8 texel of a border");
    assert!(drawn > 8000 && borders * 20 < drawn);
}
