//! Emitted scenes, drawn in strips, and emitted meshes, a frame of each: the checksum of a picture's bytes and the instructions that it took.

#![no_std]

use fixel::blend::Rgba;
use fixel_workloads::machine::{Line, Machine};

pub mod scenes;

use scenes::{MESHES, Memory, SCENES};

/// Samples in a strip: 16 rows of up to 4096 samples a pixel row.
const SAMPLES: usize = 1 << 16;

/// Where strips are drawn.
pub struct Room {
    samples: [Rgba; SAMPLES],
    bytes: [[u8; 4]; SAMPLES],
    depths: [u16; SAMPLES],
    /// Of meshes.
    colors: [u16; SAMPLES],
}

impl Room {
    /// Not drawn on yet.
    pub const fn new() -> Self {
        Room {
            samples: [Rgba {
                color: [0; 3],
                alpha: 0,
            }; SAMPLES],
            bytes: [[0; 4]; SAMPLES],
            depths: [0; SAMPLES],
            colors: [0; SAMPLES],
        }
    }
}

impl Default for Room {
    fn default() -> Self {
        Self::new()
    }
}

/// Draws everything.
pub fn draw_all(machine: &mut impl Machine, room: &mut Room) -> bool {
    draw_scenes(machine, room) && draw_meshes(machine, room)
}

/// Draws all scenes and reports each: instructions, pixels, and the checksum of their bytes. `false` where one does not fit.
fn draw_scenes(machine: &mut impl Machine, room: &mut Room) -> bool {
    for (name, width, height, level, strip) in SCENES {
        let (mut top, mut instructions, mut sum) = (0, 0u32, u32::MAX);
        let row = usize::from(width) * usize::from(level) * usize::from(level);
        let rows = SAMPLES.checked_div(row).unwrap_or(0).clamp(1, 16) as u16;
        while top < height {
            let bottom = height.min(top.saturating_add(rows));
            let mut done = false;
            let count = usize::from(width) * usize::from(bottom - top);
            let Some(bytes) = room.bytes.get_mut(..count) else {
                return false;
            };
            let mut memory = Memory {
                samples: &mut room.samples,
                bytes,
                depths: &mut room.depths,
            };
            instructions = instructions.saturating_add(machine.count(|| {
                done = strip(&mut memory, top, bottom).is_ok();
            }));
            if !done {
                return false;
            }
            for byte in memory.bytes.as_flattened() {
                sum = crc(sum, *byte);
            }
            top = bottom;
        }
        machine.report(&Line {
            name,
            instructions,
            units: u32::from(width) * u32::from(height),
            color: !sum,
            depth: 0,
        });
    }
    true
}

/// Draws a frame of each mesh and reports it in the same way; checksums are those of little-endian pixels.
fn draw_meshes(machine: &mut impl Machine, room: &mut Room) -> bool {
    for (name, width, height, shown) in MESHES {
        let count = usize::from(width) * usize::from(height);
        let (Some(colors), Some(depths)) = (room.colors.get_mut(..count), room.depths.get_mut(..count)) else {
            return false;
        };
        let mut done = false;
        let instructions = machine.count(|| done = shown(colors, depths).is_ok());
        if !done {
            return false;
        }
        let bytes = colors.iter().flat_map(|pixel| pixel.to_le_bytes());
        machine.report(&Line {
            name,
            instructions,
            units: u32::from(width) * u32::from(height),
            color: !bytes.fold(u32::MAX, crc),
            depth: 0,
        });
    }
    true
}

/// CRC-32 of one byte more.
fn crc(sum: u32, byte: u8) -> u32 {
    (0..8).fold(sum ^ u32::from(byte), |sum, _| {
        (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
    })
}
