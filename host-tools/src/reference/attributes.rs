//! What changes from fragment to fragment: colour, texture coordinate, normal and eye position (formats/hw2.md section 5).

/// What a material makes a colour of.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Attributes {
    /// Red, green, blue; of a flat surface its own colour.
    pub color: [f64; 3],
    /// s, t; 1 is the whole texture.
    pub texcoord: [f64; 2],
    /// Unit length at a vertex, shorter between; zero where there is no light.
    pub normal: [f64; 3],
    /// xyz/w of the position under MV; zero where there is no light.
    pub eye: [f64; 3],
    /// How opaque; only formats with transparent vertices look at it.
    pub alpha: f64,
}

/// How many numbers [`Attributes`] are.
pub const COUNT: usize = 12;

impl Attributes {
    /// All numbers, in the order of the fields.
    pub fn values(&self) -> [f64; COUNT] {
        let ([r, g, b], [s, t]) = (self.color, self.texcoord);
        let ([nx, ny, nz], [x, y, z]) = (self.normal, self.eye);
        [r, g, b, s, t, nx, ny, nz, x, y, z, self.alpha]
    }

    /// From numbers in the order of [`values`](Self::values).
    pub fn from_values([r, g, b, s, t, nx, ny, nz, x, y, z, alpha]: [f64; COUNT]) -> Self {
        Self {
            color: [r, g, b],
            texcoord: [s, t],
            normal: [nx, ny, nz],
            eye: [x, y, z],
            alpha,
        }
    }

    /// `self` at t = 0, `other` at 1; every number by itself.
    #[must_use]
    pub fn mixed(&self, other: &Self, t: f64) -> Self {
        let (mut values, others) = (self.values(), other.values());
        for (value, end) in values.iter_mut().zip(others) {
            *value += t * (end - *value);
        }
        Self::from_values(values)
    }
}

/// How far a vertex' attributes may be from the core's: a bound for each component; of the normal and the eye position for
/// the length of the difference too.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bounds {
    /// Of red, green, blue and alpha.
    pub color: f64,
    /// Of s and t.
    pub texcoord: f64,
    /// Of the unit normal; 2 and more means that nothing is known of its direction.
    pub normal: f64,
    /// Of the eye position.
    pub eye: f64,
}

impl Bounds {
    /// The larger of each.
    #[must_use]
    pub fn max(&self, other: &Self) -> Self {
        self.zip(other, f64::max)
    }

    /// The sum of each.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    fn zip(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            color: f(self.color, other.color),
            texcoord: f(self.texcoord, other.texcoord),
            normal: f(self.normal, other.normal),
            eye: f(self.eye, other.eye),
        }
    }

    /// What carrying the attributes of a primitive costs in the core: integers of 30 bits at the primitive's own scale,
    /// one for its colours, one for its texture coordinates, one for its eye positions; unit normals at a fixed one; all in
    /// units `headroom` times as large.
    pub fn of_carrying<'a>(corners: impl Iterator<Item = &'a Attributes>, headroom: f64) -> Self {
        let mut largest = Self::default();
        let size = |values: &[f64]| values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        for at in corners {
            largest = largest.max(&Self {
                color: size(&at.color),
                texcoord: size(&at.texcoord),
                normal: 0.0,
                eye: size(&at.eye),
            });
        }
        let diagonal = 3f64.sqrt();
        Self {
            color: headroom * CARRIED * largest.color,
            texcoord: headroom * CARRIED * largest.texcoord,
            normal: headroom * CARRIED_NORMAL * diagonal,
            eye: headroom * CARRIED * largest.eye * diagonal,
        }
    }
}

/// A carried value's rounding against the largest of its primitive: 30 bits, one of which the scale may leave unused.
pub const CARRIED: f64 = 1.0 / (1u64 << 29) as f64;

/// Error of each component of a unit normal as the core carries it.
const CARRIED_NORMAL: f64 = 1.0 / (1u64 << 28) as f64;
