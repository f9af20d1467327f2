//! What a scene and a picture of its size need of a microcontroller.

use maud::{Markup, html};

use crate::emit::emit;
use crate::load::Loaded;

/// Rows of a strip in the table.
const STRIP: u32 = 16;

/// The features of the core that the scene asks for, and the flash that they take: what `host-render emit` writes.
pub fn features(loaded: &Loaded) -> Markup {
    html! {
        @match emit(&loaded.scene, "") {
            Ok(emitted) => {
                details.features {
                    summary { "What firmware needs to draw it, of what host-render emit writes" }
                    ul { @for line in emitted.requirements.lines() { li { (line) } } }
                }
            }
            Err(fault) => p { "host-render emit: " (fault) },
        }
    }
}

/// RAM for colour and depth, whole and in strips.
pub fn table(loaded: &Loaded, width: u32, height: u32) -> Markup {
    let bytes = |rows: u32, per_pixel: u64| u64::from(width) * u64::from(rows.min(height)) * per_pixel;
    html! {
        table.requires {
            caption { "RAM for " (loaded.format) " at " (width) "×" (height) ", in bytes" }
            thead { tr { th { "" } th { "whole picture" } th { "strip of " (STRIP) " rows" } } }
            tbody {
                @for (what, per_pixel) in [("RGB565", 2), ("RGB565 and depth", 4), ("RGBA8888 and depth", 6)] {
                    tr {
                        th { (what) }
                        td.number { (bytes(height, per_pixel)) }
                        td.number { (bytes(STRIP, per_pixel)) }
                    }
                }
            }
        }
    }
}
