//! 3D on microcontrollers: triangles and lines in fixed point, without floats, allocation or panics, and with coverage that
//! equals exact geometry.
//!
//! # The walk
//!
//! ```text
//! vertex ──► clip ──► setup ──► span ──► pixel ──► target
//! matrix     clip     gradient  edge     depth     target
//! view       viewport slope     span     fragment  eg
//!                     varying
//! ```
//!
//! A primitive goes through these rooms once; [`draw`] calls them, and they do not call one another. From setup on
//! everything works on positions that were snapped once to 1/256 px: orientation, culling, coverage and gradients use the
//! same ones. All positions are those of the whole picture, so that a picture drawn strip by strip has the same bits as one
//! drawn whole, and a microcontroller draws the same bits as the desktop.
//!
//! # Three doors
//!
//! **Raster**: corners on the screen, for those who do their own 3D or draw in 2D.
//!
//! ```
//! use fixel::{depth::NoDepth, draw, fragment::Flat, screen::Position, target::Buffer};
//!
//! let mut picture = [b'.'; 24 * 6];
//! let corners = [(2, 0), (0, 6), (24, 4)].map(|(x, y)| Position::from_pixels(x, y).flat());
//! draw::triangle(&mut Buffer::new(&mut picture, 24, 6)?, &mut NoDepth, corners, &Flat(b'#'));
//!
//! let rows: Vec<_> = picture.chunks(24).map(|row| str::from_utf8(row).unwrap()).collect();
//! assert_eq!(rows, [
//!     "........................",
//!     "..######................",
//!     "..###########...........",
//!     ".##################.....",
//!     ".#######################",
//!     ".###########............",
//! ]);
//! # Ok::<(), fixel::error::Error>(())
//! ```
//!
//! **View**: vertices in eye space, clipped, projected and drawn by [`draw::primitive`]; see [`view::View`].
//!
//! **Pipeline**: your own vertex and fragment programs, several colour buffers, discard, blending, samplers; see
//! [`pipeline`], and `docs/toon-shader.md` step by step.
//!
//! Beside triangles both doors take [lines between subpixel ends](segment), plain and antialiased, [`square`]s (points,
//! billboards) and [`disc`]s; the raster door also [lines between pixels](mod@line).
//!
//! For fragment programs there are [`texture`]s, [`light`]s and [`blend`]ing, for curved surfaces Bézier [`patch`]es, and for
//! models in flash indexed [`mesh`]es with a cache of transformed vertices. What has been drawn can be
//! [averaged](supersample) and [encoded as sRGB](srgb).
//!
//! A frame that does not fit the memory is drawn in [`bands`], one on its way to the display while the next is drawn.
//!
//! # What a draw pays for
//!
//! Everything is chosen by type: [`NoDepth`](depth::NoDepth) or a depth buffer and its comparison, varyings
//! [none](varying), [linear](varying::Linear), [in perspective](varying::Perspective) or pairs of these, the fragment
//! program, the pixel, the word size. What is not chosen is not compiled in.
//!
//! How exact it is is chosen by type as well: [`quality`] has three tiers, each a set of dials, and `docs/dials.md` says how far
//! off each of them is. For displays of few levels there is [`dither`].
//!
//! # Numbers
//!
//! | quantity | format | error |
//! |---|---|---|
//! | matrices, points before the screen | [block floating point](num::Block) of 32- or 64-bit words | 2^-30 or 2^-62 of the largest entry per operation |
//! | screen positions | 1/256 px, ±4096 px ([`screen::SubPx`]) | rounded once, at most 1/512 px |
//! | coverage | exact integers ([`edge`](mod@edge)) | 0 |
//! | weights of antialiased lines | 2^-28 ([`segment::Pairs`]) | 1.25 units |
//! | depth | 16 bits, linear over the screen ([`screen::FineDepth`]) | one step |
//! | linear varyings | the user's units in an `i32` ([`gradient`]) | a unit per pixel along a span, never outside the corners' range |
//! | colours for RGB565 | two channels a word ([`varying::Color565`]) | within a level of the exact value |
//! | varyings in perspective | as linear ones, divided per pixel | see [`varying::Perspective`] |
//! | the same in words of 32 bits | divided [per pixel](varying::Perspective32) or [by a table](varying::PerspectiveSpans) | stated there, or chosen |
//! | colours with alpha | 2^-28, straight, ±8 times full ([`blend::Rgba`]) | half a unit + 2^-29 of the two colours' distance |
//! | sRGB | 2^-16 level ([`srgb`]) | 0.0002 level |
//! | light | 2^-28 of full at [points](light::world), 2^-16 in [HW2](mod@light) | stated there, far below a level of 255 |
//!
//! # Features
//!
//! None by default. `embedded-graphics`: targets for that ecosystem (`eg`). `micromath`: rotations from its f32 sine.
#![no_std]
#![forbid(unsafe_code)]

pub mod bands;
mod barycentric;
pub mod blend;
pub mod clip;
pub mod depth;
pub mod disc;
pub mod dither;
pub mod draw;
pub mod edge;
#[cfg(feature = "embedded-graphics")]
pub mod eg;
pub mod error;
pub mod fragment;
pub mod gradient;
pub mod light;
pub mod line;
pub mod matrix;
pub mod mesh;
pub mod num;
pub mod patch;
pub mod pipeline;
pub mod quality;
pub mod screen;
pub mod segment;
pub mod slope;
mod small;
pub mod span;
pub mod square;
pub mod srgb;
pub mod supersample;
pub mod target;
pub mod texture;
pub mod varying;
pub mod view;
pub mod viewport;
pub mod window;
