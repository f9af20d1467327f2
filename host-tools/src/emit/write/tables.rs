//! A kind's numbers as tables.

use std::collections::HashMap;
use std::fmt::{Display, Write};

use super::kinds::{Form, Kind, Place};
use super::shapes::{index, row};
use super::{Batch, Sorted};
use crate::emit::drawing::Varying;

/// Characters in a line of a table.
const LINE: usize = 100;

/// Corners, looks and faces of a kind.
pub fn push(sorted: &Sorted<'_>, kind: &Kind, code: &mut String) {
    push_corners(sorted, kind, code);
    push_looks(kind, code);
    for (number, batch) in sorted.batches.iter().enumerate() {
        if sorted.kinds[batch.kind].name == kind.name {
            push_faces(sorted, kind, number, batch, code);
        }
    }
}

fn push_corners(sorted: &Sorted<'_>, kind: &Kind, code: &mut String) {
    let upper = kind.upper();
    let depth = sorted.drawing.depth.is_some();
    let (name, of, what) = match kind.form {
        Form::Square | Form::Disc => {
            let of = if depth {
                "(i32, i32, u32, i32)"
            } else {
                "(i32, i32, i32)"
            };
            ("CENTERS", of.to_owned(), "column, row, depth, size")
        }
        Form::Billboard => {
            let of = if depth {
                "(i32, i32, u32, i32, [i32; 2])"
            } else {
                "(i32, i32, i32, [i32; 2])"
            };
            (
                "CENTERS",
                of.to_owned(),
                "column, row, depth, size, texture coordinates of the far corner",
            )
        }
        _ => {
            let what = match (kind.varying, kind.stores_over_w()) {
                (Varying::Nothing, _) => "column, row, depth",
                (Varying::Linear, _) => "column, row, depth, values",
                (Varying::Perspective, false) => "column, row, depth, 1/w, values",
                (Varying::Perspective, true) => "column, row, depth, 1/w, values, values over w",
            };
            ("CORNERS", row(sorted, kind).0, what)
        }
    };
    let what = if depth {
        what.to_owned()
    } else {
        what.replace(", depth", "")
    };
    let items = kind.corners.iter().map(|place| corner(kind, place, depth));
    let count = kind.corners.len();
    let _ = writeln!(code, "/// Of each: {what}. Positions are in 1/256 px.");
    push_table(&format!("{upper}_{name}"), &of, count, items, code);
}

fn corner(kind: &Kind, place: &Place, depth: bool) -> String {
    let mut items = Vec::new();
    match place {
        Place::Center([x, y, z, size]) => {
            items.extend([x, y].map(i32::to_string));
            items.extend(depth.then(|| (*z as u32).to_string()));
            items.push(size.to_string());
        }
        Place::Billboard([x, y, z, size, s, t]) => {
            items.extend([x, y].map(i32::to_string));
            items.extend(depth.then(|| (*z as u32).to_string()));
            items.push(size.to_string());
            items.push(format!("[{s}, {t}]"));
        }
        Place::Corner(corner) => {
            let (x, y) = corner.position;
            items.extend([x, y].map(|c| c.to_string()));
            items.extend(depth.then(|| corner.depth.to_string()));
            match kind.varying {
                Varying::Nothing => {}
                Varying::Linear => items.push(format!("{:?}", corner.values)),
                Varying::Perspective => {
                    items.push(corner.inverse.to_string());
                    items.push(format!("{:?}", corner.values));
                    items.extend(kind.stores_over_w().then(|| format!("{:?}", corner.over_w)));
                }
            }
        }
    }
    format!("({})", items.join(", "))
}

fn push_looks(kind: &Kind, code: &mut String) {
    if !kind.has_looks() {
        return;
    }
    let (name, upper) = (&kind.name, kind.upper());
    let varied = || kind.parameters.iter().enumerate().filter(|(_, p)| p.constant.is_none());
    let _ = writeln!(code, "struct {name}Look {{");
    for (_, parameter) in varied() {
        let _ = writeln!(code, "    {}: {},", parameter.name, parameter.of);
    }
    *code += "}\n\n";
    let look = |look: &Vec<String>| {
        let fields: Vec<_> = varied().map(|(i, p)| format!("{}: {}", p.name, look[i])).collect();
        format!("{name}Look {{ {} }}", fields.join(", "))
    };
    let items = kind.looks.iter().map(look);
    push_table(
        &format!("{upper}_LOOKS"),
        &format!("{name}Look"),
        kind.looks.len(),
        items,
        code,
    );
}

fn push_faces(sorted: &Sorted<'_>, kind: &Kind, number: usize, batch: &Batch, code: &mut String) {
    let of = index(kind);
    let mut items: Vec<String> = Vec::new();
    for (i, (look, corners)) in batch.draws.iter().enumerate() {
        if sorted.is_general(kind) && i > 0 {
            items.push(format!("{of}::MAX"));
        }
        items.extend(kind.has_looks().then(|| look.to_string()));
        items.extend(corners.iter().map(usize::to_string));
    }
    let count = items.len();
    push_table(&sorted.table(number, kind), of, count, items.into_iter(), code);
}

/// A table of `count` items, as many on a line as have room.
pub fn push_table(name: &str, of: &str, count: usize, items: impl Iterator<Item = impl Display>, code: &mut String) {
    let _ = writeln!(code, "#[rustfmt::skip]\nstatic {name}: [{of}; {count}] = [");
    let mut line = String::from("   ");
    for item in items {
        let item = format!(" {item},");
        if line.len() + item.len() > LINE && line.len() > 3 {
            let _ = writeln!(code, "{line}");
            line.truncate(3);
        }
        line += &item;
    }
    if line.len() > 3 {
        let _ = writeln!(code, "{line}");
    }
    *code += "];\n\n";
}

/// The textures that are used.
pub fn push_textures(sorted: &Sorted<'_>, code: &mut String) {
    for number in sorted.textures() {
        let Some(texture) = sorted.drawing.textures.get(number) else {
            continue;
        };
        let count = texture.pixels.len();
        let (format, made) = match sorted.palettes.of(number) {
            Some(colors) => {
                let numbers: HashMap<_, _> = colors.iter().zip(0usize..).collect();
                let items = colors.iter().map(|c| format!("{c:?}"));
                push_table(&format!("PALETTE_{number}"), "[u8; 4]", colors.len(), items, code);
                let texels = texture.pixels.iter().map(|texel| numbers[texel]);
                push_table(&format!("TEXELS_{number}"), "u8", count, texels, code);
                ("Palette<'static>", format!("Palette(&PALETTE_{number})"))
            }
            None => {
                let items = texture.pixels.iter().map(|c| format!("{c:?}"));
                push_table(&format!("TEXELS_{number}"), "[u8; 4]", count, items, code);
                ("Rgba8888", "Rgba8888".to_owned())
            }
        };
        let (width, height) = (texture.width, texture.height);
        let head = format!("const TEXTURE_{number}: Texture<'static, {format}> =");
        let made = format!("match Texture::new({made}, &TEXELS_{number}, {width}, {height}) {{");
        // As rustfmt lays it out: on one line where that has room.
        let (between, inner) = if head.len() + made.len() < 100 {
            (" ", "")
        } else {
            ("\n    ", "    ")
        };
        let _ = write!(
            code,
            "{head}{between}{made}
{inner}    Ok(texture) => texture,
{inner}    Err(_) => panic!(\"a texture of another size\"),
{inner}}};

"
        );
    }
}
