//! The host tools of fixel: scene files in, pictures and an explained comparison out.
//!
//! ```text
//! text -> scene -> interpret -+-> fixed     -> picture -+
//!                             +-> reference -> picture -+-> compare -> report
//! ```
//!
//! [`scene`] turns text into typed commands with their place in the text. [`interpret`] walks them once and drives a
//! [`backend::BackEnd`]. Two exist and share no arithmetic: `fixed`, which uses nothing but what firmware could use,
//! and [`reference`](mod@reference) in float64.

pub mod against;
pub mod args;
pub mod backend;
pub mod compare;
pub mod emit;
pub mod exit;
pub mod extremes;
pub mod files;
pub mod fixed;
pub mod interpret;
pub mod load;
pub mod lower;
pub mod maps;
pub mod outputs;
pub mod page;
pub mod picture;
pub mod playground;
pub mod png;
pub mod ppm;
pub mod reference;
pub mod render;
pub mod report;
pub mod run;
pub mod scene;
pub mod shaded;
pub mod sweep;
pub mod words;
