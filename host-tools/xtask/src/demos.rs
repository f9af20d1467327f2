//! `cargo xtask demos`: the demo programs under the emulator, frame by frame against the same programs run here.

use std::fs;
use std::path::{Path, PathBuf};

use embedded_graphics_core::pixelcolor::raw::{RawData, RawU16};
use fixel_demos::crc::Crc;
use fixel_demos::oled::{self, Oled};
use fixel_demos::spi::{self, Driver, Panel};
use fixel_demos::{dithered, spinning, wireframe};
use fixel_host::picture::Picture;
use fixel_host::png;

use crate::board::{Board, M0, M4, require_emulators};
use crate::failure::Failure;
use crate::toolchain::Toolchain;
use crate::{emulator, image};

/// With far more memory than the demo needs.
const LARGE: Board = Board {
    package: "fixel-demos",
    ..M4
};

/// With 16 KiB of RAM, beyond which it faults.
const SMALL: Board = Board {
    package: "fixel-demos",
    machine: "microbit",
    ..M0
};

/// A frame as the images report it, and the picture that the display shows.
struct Shown {
    line: String,
    picture: Picture,
}

/// Prints what was compared; frames that differ are a failure. Pictures go to `directory`, if one is given.
pub fn run(directory: Option<&Path>) -> Result<(), Failure> {
    let off = check(directory)?;
    if off.is_empty() {
        Ok(())
    } else {
        Err(Failure::Off(off.join("\n")))
    }
}

/// What is off.
pub fn check(directory: Option<&Path>) -> Result<Vec<String>, Failure> {
    require_emulators(&[LARGE, SMALL])?;
    let demos = [
        ("spinning", LARGE, spinning()?),
        ("dithered", SMALL, dithered()?),
        ("wireframe", SMALL, wireframe()?),
    ];
    let mut off = Vec::new();
    for (name, board, shown) in demos {
        if let Some(directory) = directory {
            write(directory, name, &shown)?;
        }
        let toolchain = Toolchain::find(board.target)?;
        let built = image::build_bare(&board, &toolchain, name)?;
        let output = emulator::run(&board, &built)?;
        let reported: Vec<_> = output.lines().filter(|line| line.starts_with(name)).collect();
        let expected: Vec<_> = shown.iter().map(|frame| frame.line.as_str()).collect();
        println!(
            "{name} on {} ({}): {} frames",
            board.core,
            board.machine,
            expected.len()
        );
        if reported != expected {
            off.push(format!("{name}: {reported:?} on the board, {expected:?} here"));
        }
        if name == "spinning" && !written_out(&output, &shown) {
            off.push(format!("{name}: the picture written out is another"));
        }
    }
    Ok(off)
}

/// Whether the output ends with the last frame as a PPM file.
fn written_out(output: &str, shown: &[Shown]) -> bool {
    let mut numbers = output
        .lines()
        .skip_while(|line| !line.starts_with("P3"))
        .skip(1)
        .flat_map(str::split_whitespace);
    shown.last().is_some_and(|frame| {
        let expected = frame.picture.pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]);
        expected
            .map(|channel| channel.to_string())
            .eq(numbers.by_ref().map(str::to_owned))
    })
}

fn failed(error: fixel::error::Error) -> Failure {
    Failure::Off(format!("a demo ended with: {error}"))
}

fn spinning() -> Result<Vec<Shown>, Failure> {
    let (width, height) = (spi::WIDTH, spi::HEIGHT);
    let pixels = usize::from(width) * usize::from(height);
    let (mut memory, mut panel) = (Box::new(spinning::Memory::new()), Box::new(Panel::new()));
    let (mut whole, mut depths) = (vec![RawU16::new(0); pixels], vec![0; pixels]);
    let frame = |number| {
        panel.bytes = 0;
        let passes = spinning::frame(&mut memory, &mut Driver(&mut *panel), number).map_err(failed)?;
        spinning::whole(&mut whole, &mut depths, number).map_err(failed)?;
        let same = panel.picture().iter().eq(whole
            .iter()
            .map(|pixel| pixel.into_inner().to_be_bytes())
            .collect::<Vec<_>>()
            .iter());
        if !same || passes != 1 {
            return Err(Failure::Off(format!(
                "spinning {number}: not the picture drawn whole, or in {passes} passes"
            )));
        }
        let color = |&pixel: &[u8; 2]| {
            let pixel = u16::from_be_bytes(pixel);
            let channels = [
                (pixel >> 11) * 255 / 31,
                (pixel >> 5 & 63) * 255 / 63,
                (pixel & 31) * 255 / 31,
            ];
            let [red, green, blue] = channels.map(|channel| channel as u8);
            [red, green, blue, 255]
        };
        Ok(Shown {
            line: format!("spinning {number} {} {:08x}", panel.bytes, panel.crc()),
            picture: Picture::new(width.into(), height.into(), panel.picture().iter().map(color).collect()),
        })
    };
    (0..spinning::FRAMES).map(frame).collect()
}

/// A panel of pages as it would be seen, each pixel four times as large.
#[derive(Default)]
struct Pages {
    crc: Crc,
    pages: Vec<[u8; 128]>,
}

impl Oled for Pages {
    fn page(&mut self, number: u8, columns: &[u8; 128]) {
        assert_eq!(usize::from(number), self.pages.len(), "pages come from the top");
        self.crc.add(columns);
        self.pages.push(*columns);
    }
}

impl Pages {
    fn shown(self, name: &str, number: u32, passes: u32) -> Shown {
        let (width, height) = (4 * u32::from(oled::WIDTH), 4 * u32::from(oled::HEIGHT));
        let lit = |x: u32, y: u32| self.pages[y as usize / 8][x as usize] >> (y & 7) & 1 > 0;
        let level = |x, y| if lit(x / 4, y / 4) { [255; 4] } else { [0, 0, 0, 255] };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| level(x, y))).collect();
        Shown {
            line: format!("{name} {number} {passes} {:08x}", self.crc.value()),
            picture: Picture::new(width, height, pixels),
        }
    }
}

fn dithered() -> Result<Vec<Shown>, Failure> {
    let mut memory = dithered::Memory::new();
    let frame = |number| {
        let mut pages = Pages::default();
        let passes = dithered::frame(&mut memory, &mut pages, number).map_err(failed)?;
        Ok(pages.shown("dithered", number, passes))
    };
    (0..dithered::FRAMES).map(frame).collect()
}

fn wireframe() -> Result<Vec<Shown>, Failure> {
    let mut memory = [0; oled::PAGE];
    let frame = |number| {
        let mut pages = Pages::default();
        wireframe::frame(&mut memory, &mut pages, number).map_err(failed)?;
        Ok(pages.shown("wireframe", number, 1))
    };
    (0..wireframe::FRAMES).map(frame).collect()
}

/// As `directory/name-number.png`.
fn write(directory: &Path, name: &str, shown: &[Shown]) -> Result<(), Failure> {
    fs::create_dir_all(directory).map_err(|e| Failure::trouble(directory.display(), e))?;
    for (number, frame) in shown.iter().enumerate() {
        let file: PathBuf = directory.join(format!("{name}-{number}.png"));
        let bytes = png::encode(&frame.picture).map_err(|e| Failure::trouble(file.display(), e))?;
        fs::write(&file, bytes).map_err(|e| Failure::trouble(file.display(), e))?;
    }
    Ok(())
}
