//! 3D on microcontrollers: triangles and lines in fixed point, without floats, allocation or panics, and with coverage that
//! equals exact geometry.
//!
//! # The walk
//!
//! ```text
//! vertex ──► clip ──► setup ──► span ──► pixel ──► target
//! matrix     clip     gradient  edge     depth     target
//! view       viewport varying   span     fragment  eg
//! ```
//!
//! A primitive goes through these rooms once; [`draw`] calls them, and they do not call one another. From setup on
//! everything works on positions that were snapped once to 1/256 px: orientation, culling, coverage and gradients use the
//! same ones. All positions are those of the whole picture, so that a picture drawn strip by strip has the same bits as one
//! drawn whole, and a microcontroller draws the same bits as the desktop.
//!
//! # Two doors
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
//! For fragment programs there are [`texture`]s and [`light`]s, for curved surfaces Bézier [`patch`]es.
//!
//! # What a draw pays for
//!
//! Everything is chosen by type: [`NoDepth`](depth::NoDepth) or a depth buffer and its comparison, varyings
//! [none](varying), [linear](varying::Linear) or [in perspective](varying::Perspective), the fragment program, the pixel,
//! the word size. What is not chosen is not compiled in.
//!
//! # Numbers
//!
//! | quantity | format | error |
//! |---|---|---|
//! | matrices, points before the screen | [block floating point](num::Block) of 32- or 64-bit words | 2^-30 or 2^-62 of the largest entry per operation |
//! | screen positions | 1/256 px, ±4096 px ([`screen::SubPx`]) | rounded once, at most 1/512 px |
//! | coverage | exact integers ([`edge`](mod@edge)) | 0 |
//! | depth | 16 bits, linear over the screen ([`screen::FineDepth`]) | one step |
//! | linear varyings | the user's units in an `i32` ([`gradient`]) | a unit per pixel along a span, never outside the corners' range |
//! | varyings in perspective | as linear ones, divided per pixel | see [`varying::Perspective`] |
//!
//! # Features
//!
//! None by default. `embedded-graphics`: targets for that ecosystem (`eg`). `micromath`: rotations from its f32 sine.
#![no_std]
#![forbid(unsafe_code)]

pub mod clip;
pub mod depth;
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
pub mod num;
pub mod patch;
pub mod screen;
pub mod span;
pub mod target;
pub mod texture;
pub mod varying;
pub mod view;
pub mod viewport;
pub mod window;
