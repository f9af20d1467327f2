//! Families of HW2 scenes: one number is driven to its limits, and nothing else changes.

use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Width and height of every picture.
pub const SIZE: u32 = 128;

/// A family of scenes.
pub struct Family {
    /// What it is called, in file names too.
    pub name: &'static str,
    /// What the number is.
    pub parameter: &'static str,
    /// The numbers, from harmless on.
    pub values: &'static [f64],
    /// Up to here the bound is promised to hold.
    pub promised: f64,
    /// The scene for a number.
    pub scene: fn(f64) -> String,
}

/// Every family, in the order of the table.
pub const FAMILIES: [Family; 10] = [
    Family {
        name: "far-over-near",
        parameter: "far/near of the frustum",
        values: &[1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e12],
        promised: 1e9,
        scene: far_over_near,
    },
    Family {
        name: "w-above-zero",
        parameter: "1/w of one corner",
        values: &[1e1, 1e2, 1e3, 1e4, 1e6, 1e9, 1e12, 1e15, 1e30],
        promised: 1e15,
        scene: |value| towards_zero(1.0 / value),
    },
    Family {
        name: "w-below-zero",
        parameter: "−1/w of one corner",
        values: &[1e1, 1e2, 1e3, 1e4, 1e6, 1e9, 1e12, 1e15, 1e30],
        promised: 1e15,
        scene: |value| towards_zero(-1.0 / value),
    },
    Family {
        name: "slivers",
        parameter: "length over height of triangles",
        values: &[1e1, 1e2, 1e3, 1e4, 2.5e4, 1e5, 1e6],
        promised: 1e6,
        scene: slivers,
    },
    Family {
        name: "coordinates",
        parameter: "largest coordinate",
        values: &[1e1, 1e3, 1e6, 1e9, 1e12, 1e15, 1e20, 1e30, 1e100, 1e300],
        promised: 1e15,
        scene: coordinates,
    },
    Family {
        name: "rotations",
        parameter: "rotations accumulated",
        values: &[1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6],
        promised: 1e6,
        scene: rotations,
    },
    Family {
        name: "large-scale",
        parameter: "scale",
        values: &[1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e12],
        promised: 1e6,
        scene: scale,
    },
    Family {
        name: "small-scale",
        parameter: "1/scale",
        values: &[1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e12],
        promised: 1e6,
        scene: |value| scale(1.0 / value),
    },
    Family {
        name: "coplanar",
        parameter: "layers in one plane",
        values: &[1e0, 1e1, 1e2, 1e3, 1e4],
        promised: 1e4,
        scene: coplanar,
    },
    Family {
        name: "texture-coordinates",
        parameter: "largest texture coordinate",
        values: &[1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e9],
        promised: 1e6,
        scene: texture_coordinates,
    },
];

/// As [`FAMILIES`], but lit.
pub const EXPONENTS: Family = Family {
    name: "exponents",
    parameter: "exponent of the highlight",
    values: &[1e0, 1e1, 1e2, 1e3, 1e4, 65535.0, 65536.0],
    promised: 1e4,
    scene: exponents,
};

/// A small generator (xorshift64*), so that scenes stay the same whatever crates do.
struct Random(u64);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let unit = (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * unit
    }

    fn color(&mut self) -> String {
        let [r, g, b] = [(); 3].map(|()| self.within(0.0, 1.0));
        format!("color {r:.3} {g:.3} {b:.3}\n")
    }
}

/// The scene's first line, and a generator.
fn start() -> (String, Random) {
    (
        format!("png {SIZE} {SIZE} extreme.png\n"),
        Random(0x9e37_79b9_7f4a_7c15),
    )
}

/// A vertex of a colour of its own.
fn vertex(text: &mut String, random: &mut Random, position: &[f64]) {
    text.push_str(&random.color());
    text.push_str(if position.len() == 4 { "xyzw" } else { "xyz" });
    for coordinate in position {
        // Writing into a string cannot fail.
        let _ = write!(text, " {coordinate:e}");
    }
    text.push('\n');
}

/// The latest three vertices.
const TRIG: &str = "trig -3 -2 -1\n";

/// Triangles through one another from the near plane to the far one, as many at each distance.
fn far_over_near(ratio: f64) -> String {
    let (mut text, mut random) = start();
    let _ = writeln!(text, "frustum -1 1 1 -1 1 {ratio:e}");
    for i in 0..40 {
        let place = ratio.powf(f64::from(i) / 40.0);
        for _ in 0..3 {
            let distance = place * random.within(1.0, ratio.powf(0.25));
            let [x, y] = [(); 2].map(|()| random.within(-1.2, 1.2) * distance);
            vertex(&mut text, &mut random, &[x, y, -distance]);
        }
        text.push_str(TRIG);
    }
    text
}

/// Triangles of which one corner runs to infinity.
fn towards_zero(w: f64) -> String {
    let (mut text, mut random) = start();
    for i in 0..24 {
        let angle = f64::from(i) / 24.0 * TAU;
        for turn in [-0.1, 0.1] {
            let [x, y] = [(angle + turn).cos(), (angle + turn).sin()].map(|v| v * 0.1);
            let z = random.within(0.1, 0.9);
            vertex(&mut text, &mut random, &[x, y, z, 1.0]);
        }
        let z = random.within(0.1, 0.9) * w;
        vertex(&mut text, &mut random, &[angle.cos(), angle.sin(), z, w]);
        text.push_str(TRIG);
    }
    text
}

/// A fan of triangles of the picture's length.
fn slivers(thinness: f64) -> String {
    let (mut text, mut random) = start();
    for i in 0..60 {
        let angle = f64::from(i) / 60.0 * TAU;
        let [cosine, sine] = [angle.cos(), angle.sin()];
        let height = 0.95 / thinness;
        for [along, aside] in [[0.05, 0.0], [1.0, height / 2.0], [1.0, -height / 2.0]] {
            let position = [
                along * cosine - aside * sine,
                along * sine + aside * cosine,
                random.within(0.2, 0.8),
            ];
            vertex(&mut text, &mut random, &position);
        }
        text.push_str(TRIG);
    }
    text
}

/// Triangles whose corners lie all around, the picture inside most of them.
fn coordinates(largest: f64) -> String {
    let (mut text, mut random) = start();
    for _ in 0..24 {
        let from = random.within(0.0, TAU);
        for corner in 0..3 {
            let angle = from + (f64::from(corner) + random.within(0.0, 0.6)) / 3.0 * TAU;
            let far = largest * random.within(0.3, 1.0);
            let z = random.within(0.0, 1.0);
            vertex(&mut text, &mut random, &[far * angle.cos(), far * angle.sin(), z]);
        }
        text.push_str(TRIG);
    }
    text
}

/// A few triangles around the middle, and a few turns before they are drawn.
fn rotations(count: f64) -> String {
    let (mut text, mut random) = start();
    text.push_str("loadp .7 0 0 0  0 .7 0 0  0 0 .4 .5  0 0 0 1\n");
    for _ in 0..count as u32 {
        text.push_str("rotate 36.1 1 2 3\n");
    }
    ball(&mut text, &mut random, 1.0);
    text
}

fn scale(factor: f64) -> String {
    let (mut text, mut random) = start();
    text.push_str("loadp .7 0 0 0  0 .7 0 0  0 0 .4 .5  0 0 0 1\n");
    let _ = writeln!(text, "scale {factor:e} {factor:e} {factor:e}\nrotate 30 1 2 3");
    ball(&mut text, &mut random, 1.0 / factor);
    text
}

/// Triangles through one another within a ball.
fn ball(text: &mut String, random: &mut Random, radius: f64) {
    for _ in 0..40 {
        for _ in 0..3 {
            let position = [(); 3].map(|()| random.within(-0.7, 0.7) * radius);
            vertex(text, random, &position);
        }
        text.push_str(TRIG);
    }
}

/// Triangles in one tilted plane, none with the corners of another.
fn coplanar(layers: f64) -> String {
    let (mut text, mut random) = start();
    for _ in 0..layers as u32 {
        for _ in 0..3 {
            let [x, y] = [(); 2].map(|()| random.within(-1.0, 1.0));
            vertex(&mut text, &mut random, &[x, y, 0.5 + 0.21 * x - 0.13 * y]);
        }
        text.push_str(TRIG);
    }
    text
}

/// Triangles in perspective whose texture repeats that often.
fn texture_coordinates(largest: f64) -> String {
    let (mut text, mut random) = start();
    text.push_str("texture tile.png\n");
    for _ in 0..12 {
        for _ in 0..3 {
            let [s, t] = [(); 2].map(|()| random.within(-largest, largest));
            let _ = writeln!(text, "texcoord {s:e} {t:e}");
            let [x, y, z] = [(); 3].map(|()| random.within(-1.0, 1.0));
            let w = random.within(1.0, 2.0);
            vertex(&mut text, &mut random, &[x * w, y * w, (0.5 + 0.4 * z) * w, w]);
        }
        text.push_str("trit -3 -2 -1\n");
    }
    text
}

/// Curved surfaces under a sun and a lamp.
fn exponents(exponent: f64) -> String {
    let (mut text, mut random) = start();
    let _ = writeln!(
        text,
        "color 1 .9 .8\nsunlight .3 -.5 -1\nxyz .5 -.4 -.6\nbulb -1\nshininess {exponent}"
    );
    for _ in 0..12 {
        for _ in 0..3 {
            let [x, y] = [(); 2].map(|()| random.within(-1.0, 1.0));
            let _ = writeln!(text, "normal {x:.4} {y:.4} -1");
            let z = random.within(0.2, 0.8);
            vertex(&mut text, &mut random, &[x, y, z]);
        }
        text.push_str(TRIG);
    }
    text
}
