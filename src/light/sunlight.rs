//! One sun on stored vertices: a dot product each.

use crate::error::Error;
use crate::matrix::Directions;
use crate::num::{Block, Word, unit};

/// A sun and an ambient part, for normals as they are stored: the sun is turned into the model's space once instead of
/// every normal out of it. For models that are only turned, moved and scaled evenly.
///
/// A vertex with unit normal n gets ambient + diffuse · max(0, n·l), component by component, in the unit of those two. Not
/// clamped: the two should not add up to more than is full.
///
/// **Error**: each component is within 2^9 + 2^-13·|diffuse| of the value for the numbers given: in 2^-16 levels of 255,
/// less than a hundredth of a level.
///
/// ```
/// use fixel::{light::Sunlight, matrix::Directions};
/// // A white surface as RGB565 (see `Gouraud565::corner`), a quarter of it without the sun, which shines along −z.
/// let [ambient, diffuse] = [[8, 16, 8], [23, 47, 23]].map(|c| c.map(|v| v << 16));
/// let light = Sunlight::new([0, 0, 1], &Directions::<i32>::identity(), ambient, diffuse)?;
/// assert_eq!(light.shade([0, 0, -32768]), ambient);
/// assert_eq!(light.shade([0, 0, 16384]).map(|v| v >> 16), [19, 39, 19]);
/// # Ok::<(), fixel::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sunlight {
    /// Towards the sun in the model's space, length 1 in units of 2^-15.
    towards: [i32; 3],
    ambient: [i32; 3],
    /// In units of 2^9 of the ambient part's.
    diffuse: [i32; 3],
}

/// What the diffuse part is cut by, so that a product with a cosine in units of 2^-15 fits 32 bits.
const CUT: u32 = 9;

impl Sunlight {
    /// `towards` the sun, in eye space, of any length; `directions` takes normals of the model there. |ambient| ≤ 2^30,
    /// |diffuse| ≤ 2^24.
    ///
    /// # Errors
    /// [`Error::ZeroVector`] for length 0. [`Error::TooLarge`] for colours beyond that.
    pub fn new<T: Word>(
        towards: [i32; 3],
        directions: &Directions<T>,
        ambient: [i32; 3],
        diffuse: [i32; 3],
    ) -> Result<Self, Error> {
        let beyond = |color: [i32; 3], bits: u32| color.iter().any(|c| c.unsigned_abs() > 1 << bits);
        if beyond(ambient, 30) || beyond(diffuse, 24) {
            return Err(Error::TooLarge);
        }
        // (D·n)·l = n·(Dᵀ·l).
        let eye = Block::new(unit(towards).ok_or(Error::ZeroVector)?.map(T::from_i32), -30);
        let model = directions
            .turn_back(eye)
            .mantissas()
            .map(|m| (m >> (T::BITS - 30)).low_i32());
        let rounded = |v: i32, cut: u32| (v + (1 << (cut - 1))) >> cut;
        Ok(Sunlight {
            towards: unit(model).ok_or(Error::ZeroVector)?.map(|c| rounded(c, 15)),
            ambient,
            diffuse: diffuse.map(|c| rounded(c, CUT)),
        })
    }

    /// The colour of a vertex: its normal has length 1 in units of 2^-15, as stored. A longer one is brighter, up to √3.
    #[inline(always)]
    pub fn shade(&self, normal: [i16; 3]) -> [i32; 3] {
        let ([a, b, c], [x, y, z]) = (self.towards, normal.map(i32::from));
        // Below √3·2^30, and so is every part of the sum.
        let cosine = (a * x + b * y + c * z).max(0) >> 15;
        let mut color = self.ambient;
        for (color, diffuse) in color.iter_mut().zip(self.diffuse) {
            // Below 2^15·√3·2^15.
            *color += (diffuse * cosine) >> (15 - CUT);
        }
        color
    }
}
