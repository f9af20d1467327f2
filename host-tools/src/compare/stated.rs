//! What the fixed-point core states about its own errors, and what float64 costs: every constant that an allowance of
//! the comparison is made of. Nothing else in the comparison is a tolerance.

/// Rounding a corner to 1/256 px moves it by at most half a unit in x and in y: √2 · 2⁻⁹ px.
pub const SNAP: f64 = std::f64::consts::SQRT_2 / 512.0;

/// Relative error of the core's matrices, vectors and their products against the largest entry of the result: 64-bit
/// words share one exponent per vector or matrix, of which 62 bits are mantissa; four bits are left for the sums.
pub const FIXED_PRODUCT: f64 = 1.0 / (1u64 << 58) as f64;

/// Absolute error of the core's sine and cosine, and relative error of its unit vectors.
pub const FIXED_TRIGONOMETRY: f64 = FIXED_PRODUCT;

/// The reference's own rounding of one product: four terms are rounded to 53 bits and summed, γ₄ = 4 · 2⁻⁵³ against
/// the product of the norms.
pub const FLOAT_PRODUCT: f64 = 2.0 * f64::EPSILON;

/// Interpolation of a colour, in levels of 255 for colours up to 1 (in proportion beyond): units of 2⁻¹⁶ levels, and
/// rounded gradients stepped along a span in 2⁻¹⁴ of them.
pub const COLOR_LEVELS: f64 = 1.0 / 256.0;

/// A gradient is off by this part of itself (normalised numerator, reciprocal, product). From the polygon's first corner
/// on, that adds up to as much of |gradient in x| · columns + |gradient in y| · rows, which matters for slivers.
pub const GRADIENT: f64 = 1.0 / (1u64 << 28) as f64;

/// Perspective: error of the interpolated 1/w and of the numerators against their largest corner value.
pub const PERSPECTIVE: f64 = 1.0 / (1u64 << 26) as f64;

/// Depth is rounded to the nearest of 65535 steps. So two depths that decide a pixel may be one step apart.
pub const DEPTH_ROUNDING: f64 = 0.5;

/// Depth is stepped along a row in units of 2⁻¹⁵ steps, each cut off: steps of 65535 per column of the picture.
pub const DEPTH_PER_COLUMN: f64 = 1.0 / (1u64 << 15) as f64;

/// Half the side of the guard band in px, which pictures larger than it widen to [`WIDE_GUARD`]. Beyond it a triangle is
/// cut off, so that the largest 1/w that counts for a pixel is the largest inside the band.
pub const GUARD: f64 = 4096.0;

/// See [`GUARD`].
pub const WIDE_GUARD: f64 = 32768.0;
