//! Small programs to start from. Each draws a few frames on a display that is small in its own way:
//!
//! | demo | display | memory |
//! |---|---|---|
//! | [`spinning`] | 160×128 RGB565 behind SPI, driven through `embedded-graphics` | bands of 16 rows |
//! | [`dithered`] | 128×64, black and white, in pages of 8 rows | the micro:bit's 16 KiB |
//! | [`wireframe`] | the same | 4 KiB in all |
//!
//! The images in `src/bin` run them under an emulator, `cargo xtask demos` on the host as well, where they draw the same bits.

#![no_std]

pub mod crc;
pub mod dithered;
pub mod oled;
pub mod spi;
pub mod spinning;
pub mod torus;
pub mod wireframe;
