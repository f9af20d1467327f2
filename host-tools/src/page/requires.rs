//! What a picture of this size needs of a microcontroller's memory.

use maud::{Markup, html};

use crate::load::Loaded;

/// Rows of a strip in the table.
const STRIP: u32 = 16;

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
