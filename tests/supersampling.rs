//! Averages of N×N samples against exact fractions, and a picture resolved strip by strip against one resolved whole.

use fixel::blend::{ONE, Rgba, over565};
use fixel::depth::NoDepth;
use fixel::draw;
use fixel::error::Error;
use fixel::fragment::{Fragment, Gouraud565};
use fixel::screen::{Corner, FineDepth, Position};
use fixel::supersample::Level;
use fixel::target::Buffer;
use fixel::varying::Linear;
use fixel::window::Window;

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A block's samples: colours and alphas of any size, often all of a size, often equal, often none.
    fn samples(&mut self, count: usize) -> Vec<Rgba> {
        let (color_shift, alpha_shift, kind) = (self.next() % 32, self.next() % 29, self.next() % 5);
        let base = self.next() as i32;
        let sample = |random: &mut Random| Rgba {
            color: [(); 3].map(|()| match kind {
                0 => [i32::MIN, i32::MAX][random.next() as usize % 2],
                1 => base.wrapping_add(random.next() as i32 >> color_shift),
                _ => random.next() as i32 >> color_shift,
            }),
            alpha: match random.next() % 4 {
                0 if kind < 4 => 0,
                1 if kind < 3 => ONE,
                _ => (random.next() as i32 & (2 * ONE - 1)).min(ONE) >> alpha_shift,
            },
        };
        (0..count).map(|_| sample(self)).collect()
    }
}

fn level(n: usize) -> Level {
    Level::new(n as u32).unwrap()
}

#[test]
fn levels_are_1_to_16() {
    for n in 1..=16 {
        assert_eq!(Level::new(n).map(Level::side), Ok(n as usize));
    }
    for n in [0, 17, 256, 257, u32::MAX] {
        assert_eq!(Level::new(n), Err(Error::SupersamplingLevel));
    }
}

/// Alpha is the nearest, a channel within ½ unit + 2^-22 of its range; both by exact fractions.
#[test]
fn averages_keep_their_bounds() {
    let mut random = Random(1);
    let mut worst = 0.0f64;
    for i in 0..60_000 {
        let n = i % 16 + 1;
        let count = n * n;
        let samples = random.samples(count);
        let mut pixels = Vec::new();
        level(n).resolve(&samples, n, |x, pixel| pixels.push((x, pixel)));
        let &[(0, pixel)] = &pixels[..] else {
            panic!("{pixels:?}")
        };

        let total: i128 = samples.iter().map(|s| i128::from(s.alpha)).sum();
        assert_eq!(
            i128::from(pixel.alpha),
            (2 * total + count as i128) / (2 * count as i128)
        );
        if total == 0 {
            assert_eq!(pixel, Rgba::default());
            continue;
        }
        for c in 0..3 {
            let seen = || samples.iter().filter(|s| s.alpha > 0).map(|s| i128::from(s.color[c]));
            let (least, most) = (seen().min().unwrap(), seen().max().unwrap());
            let result = i128::from(pixel.color[c]);
            assert!((least..=most).contains(&result), "{samples:?}");
            let sum: i128 = samples
                .iter()
                .map(|s| i128::from(s.color[c]) * i128::from(s.alpha))
                .sum();
            // In units of 1/total.
            let excess = (2 * (result * total - sum).abs() - total).max(0) as f64 / (2 * total) as f64;
            assert!(excess <= (most - least) as f64 * 2f64.powi(-22), "{samples:?}");
            worst = worst.max(excess / (most - least).max(1) as f64 * 2f64.powi(22));
        }
    }
    println!("largest error of a channel: 1/2 unit + {worst:.3} x 2^-22 of the range");
}

/// The hardest weights: one nearly empty sample far away from 255 bright ones, and 256 that all lose nearly a unit.
#[test]
fn extreme_weights() {
    for (a, b) in [(ONE, 1), (1, ONE), (ONE, ONE - 1), (ONE - 1, 31), ((1 << 27) + 31, 31)] {
        for (color_a, color_b) in [(i32::MIN, i32::MAX), (i32::MAX, i32::MIN), (0, 1)] {
            for bright in [0, 1, 128, 255, 256] {
                let sample = |i| if i < bright { (color_a, a) } else { (color_b, b) };
                let samples: Vec<Rgba> = (0..256)
                    .map(|i| Rgba {
                        color: [sample(i).0; 3],
                        alpha: sample(i).1,
                    })
                    .collect();
                let total: i128 = samples.iter().map(|s| i128::from(s.alpha)).sum();
                let sum: i128 = samples
                    .iter()
                    .map(|s| i128::from(s.color[0]) * i128::from(s.alpha))
                    .sum();
                level(16).resolve(&samples, 16, |_, pixel| {
                    let error = (i128::from(pixel.color[0]) * total - sum).abs();
                    let range = (i128::from(color_a) - i128::from(color_b)).abs();
                    assert!(
                        error <= total / 2 + ((range * total) >> 22) + 1,
                        "{color_a} {a} {color_b} {b} {bright}"
                    );
                });
            }
        }
    }
}

/// What has no alpha has no say: no dark fringe, and no bright one.
#[test]
fn covered_part_keeps_its_colour() {
    let mut random = Random(2);
    for n in 1..=16usize {
        for covered in 0..=n * n {
            let color = [(); 3].map(|()| random.next() as i32);
            let alpha = 1 + (random.next() as i32 & (ONE - 1));
            let nothing = Rgba {
                color: [(); 3].map(|()| random.next() as i32),
                alpha: 0,
            };
            let sample = |i| {
                if i * 7 % (n * n) < covered {
                    Rgba { color, alpha }
                } else {
                    nothing
                }
            };
            let samples: Vec<Rgba> = (0..n * n).map(sample).collect();
            let seen = samples.iter().any(|s| s.alpha > 0);
            level(n).resolve(&samples, n, |_, pixel| {
                assert_eq!(pixel.color, if seen { color } else { [0; 3] })
            });
        }
    }
}

#[test]
fn one_sample_is_itself() {
    let mut random = Random(3);
    let samples = random.samples(1000);
    let mut count = 0;
    level(1).resolve(&samples, 1000, |x, pixel| {
        let expected = if samples[x].alpha == 0 {
            Rgba::default()
        } else {
            samples[x]
        };
        assert_eq!(pixel, expected);
        count += 1;
    });
    assert_eq!(count, 1000);
}

/// Random words, all black, all white; exactly the nearest.
#[test]
fn averages_of_565_are_exact() {
    let mut random = Random(4);
    for i in 0..40_000 {
        let n = i % 16 + 1;
        let (and, or) = [(0xffff, 0), (0, 0), (0, 0xffff), (0xf81f, 0x0400), (0x0841, 0)][i / 16 % 5];
        let samples: Vec<u16> = (0..n * n).map(|_| random.next() as u16 & and | or).collect();
        let mean = |shift: u32, mask: u16| {
            let sum: usize = samples.iter().map(|&v| usize::from(v >> shift & mask)).sum();
            ((2 * sum + n * n) / (2 * n * n)) as u16
        };
        let expected = mean(11, 31) << 11 | mean(5, 63) << 5 | mean(0, 31);
        level(n).resolve565(&samples, n, |_, pixel| assert_eq!(pixel, expected));
    }
}

/// Every sum there is, for every level: as that many of a channel's steps over the samples.
#[test]
fn every_sum_of_565_is_rounded_to_nearest() {
    for n in 1..=16usize {
        for sum in 0..=n * n * 63 {
            let mut left = sum;
            let samples: Vec<u16> = std::iter::repeat_with(|| {
                let part = left.min(63);
                left -= part;
                (part as u16) << 5
            })
            .take(n * n)
            .collect();
            let expected = ((2 * sum + n * n) / (2 * n * n)) as u16;
            level(n).resolve565(&samples, n, |_, pixel| assert_eq!(pixel, expected << 5));
        }
    }
}

/// Whole blocks only, by stride and by what is there.
#[test]
fn blocks_that_are_not_whole_are_left_out() {
    let columns = |n, samples: usize, stride| {
        let mut columns = Vec::new();
        level(n).resolve(&vec![Rgba::default(); samples], stride, |x, _| columns.push(x));
        let mut same = Vec::new();
        level(n).resolve565(&vec![0; samples], stride, |x, _| same.push(x));
        assert_eq!(columns, same);
        assert!(columns.iter().copied().eq(0..columns.len()));
        columns.len()
    };
    assert_eq!(columns(2, 16, 8), 4);
    assert_eq!(columns(2, 100, 8), 4);
    assert_eq!(columns(2, 15, 8), 3);
    assert_eq!(columns(2, 10, 8), 1);
    assert_eq!(columns(2, 9, 8), 0);
    assert_eq!(columns(3, 21, 7), 2);
    assert_eq!(
        (
            columns(2, 0, 8),
            columns(2, 16, 1),
            columns(2, 16, 0),
            columns(1, 16, usize::MAX)
        ),
        (0, 0, 0, 16)
    );
}

struct Blended;

impl Fragment for Blended {
    type Varying = Linear<4>;
    type Pixel = Rgba;
    fn shade(&self, [red, green, blue, alpha]: [i32; 4], below: Rgba) -> Option<Rgba> {
        Some(
            Rgba {
                color: [red, green, blue],
                alpha,
            }
            .over(below),
        )
    }
}

const WIDTH: usize = 37;
const HEIGHT: usize = 29;

fn triangles<V>(n: usize, varying: impl Fn(&mut Random) -> V) -> Vec<[Corner<V>; 3]> {
    let mut random = Random(5);
    let mut corner = || {
        let [x, y] = [WIDTH, HEIGHT].map(|size| (random.next() % (size * n * 3 / 2) as u64) as i16 - 4);
        Corner {
            position: Position::from_pixels(x, y),
            depth: FineDepth::ZERO,
            varying: varying(&mut random),
        }
    };
    (0..20).map(|_| [corner(), corner(), corner()]).collect()
}

/// Drawn and resolved `rows` output rows at a time.
fn blended(n: usize, rows: usize) -> Vec<u16> {
    let triangles = triangles(n, |random| Linear([(); 4].map(|()| (random.next() % (1 << 28)) as i32)));
    let mut picture = vec![0x39e7; WIDTH * HEIGHT];
    for (i, strip) in picture.chunks_mut(WIDTH * rows).enumerate() {
        let (top, bottom) = (n * rows * i, n * (rows * i + strip.len() / WIDTH));
        let mut samples = vec![Rgba::default(); n * WIDTH * (bottom - top)];
        let window = Window::new(0, top as i32, (n * WIDTH) as i32, bottom as i32);
        let mut target = Buffer::strip(&mut samples, window).unwrap();
        for &corners in &triangles {
            draw::triangle(&mut target, &mut NoDepth, corners, &Blended);
        }
        for (row, samples) in strip.chunks_mut(WIDTH).zip(samples.chunks(n * WIDTH * n)) {
            level(n).resolve(samples, n * WIDTH, |x, pixel| row[x] = over565(pixel, row[x]));
        }
    }
    picture
}

/// The same with opaque RGB565 samples.
fn opaque(n: usize, rows: usize) -> Vec<u16> {
    let triangles = triangles(n, |random| {
        let [r, g, b, ..] = random.next().to_le_bytes();
        Gouraud565::corner(r, g, b)
    });
    let mut picture = vec![0; WIDTH * HEIGHT];
    for (i, strip) in picture.chunks_mut(WIDTH * rows).enumerate() {
        let (top, bottom) = (n * rows * i, n * (rows * i + strip.len() / WIDTH));
        let mut samples = vec![0x39e7; n * WIDTH * (bottom - top)];
        let window = Window::new(0, top as i32, (n * WIDTH) as i32, bottom as i32);
        let mut target = Buffer::strip(&mut samples, window).unwrap();
        for &corners in &triangles {
            draw::triangle(&mut target, &mut NoDepth, corners, &Gouraud565);
        }
        for (row, samples) in strip.chunks_mut(WIDTH).zip(samples.chunks(n * WIDTH * n)) {
            level(n).resolve565(samples, n * WIDTH, |x, pixel| row[x] = pixel);
        }
    }
    picture
}

#[test]
fn strips_equal_the_whole() {
    for n in [1, 2, 3, 4, 7, 16] {
        for draw in [blended, opaque] {
            let whole = draw(n, HEIGHT);
            let mut colors = whole.clone();
            colors.sort_unstable();
            colors.dedup();
            assert!(colors.len() > 100, "a picture of {} colours", colors.len());
            for rows in [1, 2, 3, 7] {
                assert!(draw(n, rows) == whole, "N = {n} in strips of {rows}");
            }
        }
    }
}
