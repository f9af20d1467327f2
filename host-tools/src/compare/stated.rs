//! What the fixed-point core states about its own errors, and what float64 costs: every constant that an allowance of
//! the comparison is made of. Nothing else in the comparison is a tolerance.

/// Rounding a corner to 1/256 px moves it by at most half a unit in x and in y: √2 · 2⁻⁹ px.
pub const SNAP: f64 = std::f64::consts::SQRT_2 / 512.0;

/// How far corners are from each other that are rounded to within 1/256 px in x and in y: the core may take one for both where a
/// polygon is drawn as a fan.
pub const SUBPIXEL: f64 = 2.0 * SNAP;

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
/// What the core adds to texture coordinates, in texels, so that those on a border pick the texel that exact arithmetic does.
pub const TEXEL_NUDGE: f64 = 1.0 / 4096.0;

/// A gradient is off by this part of itself (normalised numerator, reciprocal, product). From the polygon's first corner
/// on, that adds up to as much of |gradient in x| · columns + |gradient in y| · rows, which matters for slivers.
pub const GRADIENT: f64 = 1.0 / (1u64 << 28) as f64;

/// Error of the interpolated 1/w against its largest corner value.
pub const INVERSE: f64 = 1.0 / (1u64 << 26) as f64;

/// Perspective: error of the numerators against their largest corner value, for a 1/w of the largest.
pub const PERSPECTIVE: f64 = 1.0 / (1u64 << 26) as f64;

/// Depth is rounded to the nearest of 65535 steps. So two depths that decide a pixel may be one step apart.
pub const DEPTH_ROUNDING: f64 = 0.5;

/// Depth is stepped along a row in units of 2⁻¹⁵ steps, each cut off: steps of 65535 per column of the polygon, those off the picture
/// included.
pub const DEPTH_PER_COLUMN: f64 = 1.0 / (1u64 << 15) as f64;

/// Half the side of the guard band in px, which pictures larger than it widen to [`WIDE_GUARD`]. Beyond it a triangle is
/// cut off, so that the largest 1/w that counts for a pixel is the largest inside the band.
pub const GUARD: f64 = 4096.0;

/// See [`GUARD`].
pub const WIDE_GUARD: f64 = 32768.0;

/// Error of a sun's direction and of a flat normal when it is handed to the fragments: three components rounded to 2⁻³⁰.
pub const UNIT_VECTOR: f64 = 1.0 / (1u64 << 30) as f64;

/// Error of c = n·l from the fragment's integers, as `fixel::light` states it: two unit vectors and a rounding.
pub const COSINE: f64 = 6.0 / (1u64 << 30) as f64;

/// Error of k = n·h beyond [`COSINE`], times |l + unit(-p)|, as `fixel::light` states it: what is cut off l and unit(-p) turns
/// their sum the more, the shorter it is.
pub const HALFWAY: f64 = 5.0 / (1u64 << 30) as f64;

/// Error of a power, as `fixel::num::power` states it.
pub const POWER: f64 = 3.0 / (1u64 << 30) as f64;

/// Error of a power's exponent: rounded to units of 2⁻¹⁶, and to one of them at least.
pub const EXPONENT: f64 = 1.0 / (1u64 << 16) as f64;

/// What a value's error before interpolation counts: at least half a unit of 30 bits of it is rounding to that unit, for which
/// the log counts one; the quotient of interpolation adds two.
pub const UNITS: f64 = 2.5;

/// By how much the direction of a bulb may be turned if it is so far off that its position does not fit 62 bits of the fragments'
/// unit, as `fixel::light` states it.
pub const FAR_BULB: f64 = 1.0 / (1u64 << 29) as f64;

/// Rounding of a light's colour, relative to the largest channel of all lights: they have a common unit, of which that is 2²⁹ or
/// more.
pub const LIGHT_COLOR: f64 = 1.0 / (1u64 << 29) as f64;

/// Arithmetic with a lit surface's colour before the light, in levels of 255 for colours up to 1 (in proportion beyond): units of
/// 2⁻¹⁶ levels, where there is a texture, else finer ones. Half of one for rounding, two for the quotient of interpolation, one for
/// a decal, and four for 2¹⁵ steps of rounded gradients in 2⁻¹⁴ of a unit, twice: along the rows and to the row.
pub const LIT_SURFACE: f64 = 1.0 / (1u64 << 13) as f64;

/// Rounding of a lit colour in levels of 255, times the largest channel of all lights and that of the surface (full at least).
/// A unit of the light is 2⁻¹³ of the largest at most for each 2¹⁶, one of the surface 2⁻¹⁶ levels for surfaces up to 32 times
/// full, else 2⁻²¹ of the largest; one unit of both goes to each of the diffuse and the specular part, and a unit of the surface to
/// the highlight's brightness.
pub const LIT: f64 = 1.0 / (1u64 << 20) as f64;

/// The most that a lit colour may be off by arithmetic alone, in levels of 255, and still be in class *colour*. All errors above
/// of a hundred lights of colours up to 3 and exponents up to 240 add up to 1/100 level; more than two levels takes a power that
/// is steep, or brightness beyond all reason.
pub const LIT_LEVELS: f64 = 2.0;

/// `.iv`: units of materials and of lit colours, as `fixel::light::world` has them.
pub const WORLD_UNIT: f64 = 1.0 / (1u64 << 28) as f64;

/// `.iv`: a colour is rounded to 2⁻¹⁶ level before it is cut off to a byte; in levels.
pub const WORLD_LEVEL: f64 = 1.0 / (1u64 << 17) as f64;

/// `.iv`: interpolated colours are carried in quarters of [`WORLD_UNIT`], of which each pixel of a row, on the picture or not, may
/// lose one.
pub const WORLD_PER_COLUMN: f64 = WORLD_UNIT / 4.0;

/// `.iv`: error of k = n·h beyond [`COSINE`], times |unit(e − v) + unit(L − v)|, as `fixel::light::world` states it.
pub const WORLD_HALFWAY: f64 = 6.0 / (1u64 << 30) as f64;

/// MP1: the core's unit of a channel and of alpha, 1 being full, where no colour of the scene is brighter than that allows.
pub const CARRIED_CHANNEL: f64 = 1.0 / (1u64 << 28) as f64;

/// MP1: error of a decoded channel relative to the largest, at least 1: it is rounded to units of 2⁻²⁴, where the curve is
/// at most 2.3 times as steep as its value is large, which is 2⁻²³·⁸, and `fixel::srgb` adds ½ unit and 2⁻²⁸.
pub const DECODED: f64 = 1.0 / (1u64 << 23) as f64;

/// MP1: by how much an encoded channel may be too large, in levels of 255, as `fixel::srgb` states it. It is never too small.
pub const ENCODED: f64 = 12.0 / 65536.0;

/// MP1: rounding of a channel that is not encoded, in levels of 255: to the nearest 2⁻¹⁶ before it is cut off.
pub const LEVEL_ROUNDING: f64 = 1.0 / (1u64 << 17) as f64;

/// MP1: what one blend adds to a channel beyond half a unit, times the distance of the two colours; `fixel::blend` states it.
pub const BLENDED: f64 = 1.0 / (1u64 << 29) as f64;

/// MP1: error of a Wu line's weight, in units of [`CARRIED_CHANNEL`], as `fixel::segment` states it.
pub const WEIGHT: f64 = 1.25;

/// MP1: what averaging a pixel's samples adds to a channel beyond half a unit, times their colours' range; `fixel::supersample`
/// states it.
pub const RESOLVED: f64 = 1.0 / (1u64 << 22) as f64;

/// MP1: units that interpolation over a triangle adds to a channel, beyond one a column of the polygon, on the picture or not, and the ratio of the largest 1/w to the
/// pixel's: three for the quotient or, without one, steps from the corner on, and a few for rounding.
pub const INTERPOLATED: f64 = 8.0;

/// MP1: units that interpolation along a line adds, beyond one a step, as `fixel::segment` states it; and one for rounding.
pub const ALONG: f64 = 3.0;

/// MP1: a square's or disc's size is rounded to the nearest 1/256 px; all else about it is exact.
pub const SIZE_ROUNDING: f64 = 1.0 / 512.0;

/// Where w has both signs the core carries values in units so much larger: see the headroom of the fixed back end.
pub const MIXED_HEADROOM: f64 = 1024.0;
