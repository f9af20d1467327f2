//! A target that fails on what a rasterizer must not do: a pixel drawn twice, or rows and columns it never offered.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::collections::BTreeMap;

use fixel::target::Target;
use fixel::window::Window;

/// A picture of characters, `.` where nothing was drawn.
pub struct StrictTarget {
    window: Window,
    pixels: Vec<u8>,
    row_before: Option<(i32, Vec<u8>)>,
    allow_twice: bool,
}

impl StrictTarget {
    /// An empty picture of what `window` holds; drawing a pixel twice fails unless `allow_twice`.
    pub fn new(window: Window, allow_twice: bool) -> Self {
        let pixels = vec![b'.'; window.width() * window.height()];
        StrictTarget {
            window,
            pixels,
            row_before: None,
            allow_twice,
        }
    }

    /// The rows, one line each.
    pub fn picture(mut self) -> Vec<String> {
        self.check();
        let width = self.window.width().max(1);
        self.pixels
            .chunks(width)
            .map(|row| String::from_utf8_lossy(row).into_owned())
            .collect()
    }

    /// How many pixels hold each character.
    pub fn census(mut self) -> BTreeMap<char, usize> {
        self.check();
        let mut counts = BTreeMap::new();
        self.pixels
            .iter()
            .for_each(|&p| *counts.entry(p as char).or_default() += 1);
        counts
    }

    fn range(&self, row: i32) -> std::ops::Range<usize> {
        let start = (row - self.window.top) as usize * self.window.width();
        start..start + self.window.width()
    }

    /// Programs mark a pixel drawn over with `!`.
    fn check(&mut self) {
        if !self.allow_twice
            && let Some((row, before)) = self.row_before.take()
        {
            let now = &self.pixels[self.range(row)];
            for (x, (old, new)) in before.iter().zip(now).enumerate() {
                assert!(
                    old == new || *old == b'.',
                    "pixel ({}, {row}) drawn twice",
                    x as i32 + self.window.left
                );
                assert!(
                    *new != b'!',
                    "pixel ({}, {row}) drawn twice",
                    x as i32 + self.window.left
                );
            }
        }
    }
}

impl Target for StrictTarget {
    type Pixel = u8;

    fn window(&self) -> Window {
        self.window
    }

    fn row(&mut self, row: i32) -> &mut [u8] {
        assert!(
            (self.window.top..self.window.bottom).contains(&row),
            "row {row} is out of bounds"
        );
        self.check();
        let range = self.range(row);
        self.row_before = Some((row, self.pixels[range.clone()].to_vec()));
        &mut self.pixels[range]
    }
}

/// Draws its character, and `!` over anything but `.`.
pub struct Mark(pub u8);

impl fixel::fragment::Fragment for Mark {
    type Varying = ();
    type Pixel = u8;
    fn shade(&self, (): (), below: u8) -> Option<u8> {
        Some(if below == b'.' { self.0 } else { b'!' })
    }
}
