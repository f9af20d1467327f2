//! Where the flash of an image goes: bytes of machine code by room of the core.

use std::collections::{BTreeMap, BTreeSet};

use crate::elf::{Elf, Function};

/// How the core's name begins the rest of a path in a mangled name.
const CORE: &str = "_5fixel";

/// Crates that are compiled for types of the core.
const OTHERS: [&str; 3] = ["fixel_workloads", "4core", "8heapless"];

/// Rooms that a table names; smaller ones are one line together.
const LARGEST: usize = 14;

/// Bytes and functions of a room.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Share {
    bytes: usize,
    functions: usize,
}

/// Prints a line for each room, the largest first.
pub fn print(image: &Elf<'_>) {
    let mut shares: Vec<_> = shares(&image.functions()).into_iter().collect();
    shares.sort_by_key(|(_, share)| std::cmp::Reverse(share.bytes));
    println!("\n{:<34}{:>8}{:>12}", "room", "KiB", "functions");
    let rest = shares.split_off(LARGEST.min(shares.len()));
    for (room, share) in &shares {
        line(room, share);
    }
    let rest = rest.iter().fold(Share::default(), |sum, (_, share)| Share {
        bytes: sum.bytes + share.bytes,
        functions: sum.functions + share.functions,
    });
    line("others", &rest);
}

fn line(room: &str, share: &Share) {
    println!("{room:<34}{:>8.1}{:>12}", share.bytes as f64 / 1024.0, share.functions);
}

/// Of each room; what is not of the core counts as one more. A function that is compiled for several types is as many.
fn shares(functions: &[Function<'_>]) -> BTreeMap<String, Share> {
    let mut shares = BTreeMap::<String, Share>::new();
    let mut seen = BTreeSet::new();
    for function in functions.iter().filter(|function| seen.insert(function.address)) {
        let room = room(function.name).unwrap_or("not of the core");
        let share = shares.entry(room.to_owned()).or_default();
        share.bytes += function.code.len();
        share.functions += 1;
    }
    shares
}

/// The module of the core that a function is of, from its name as the compiler mangles it: identifiers behind their lengths,
/// the function's own way first. `None` where that begins in another crate.
fn room(name: &str) -> Option<&str> {
    let at = name.find(CORE)? + CORE.len();
    let before = name.get(..at)?;
    if OTHERS.iter().any(|other| before.contains(other)) {
        return None;
    }
    Some(identifier(name.get(at..)?)?.0)
}

/// The identifier that a text begins with, and what is behind it.
fn identifier(text: &str) -> Option<(&str, &str)> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let length: usize = text.get(..digits)?.parse().ok()?;
    // Between a length and a name that begins like a number stands a `_`.
    let name = text.get(digits..)?;
    let name = name.strip_prefix('_').unwrap_or(name);
    Some((name.get(..length)?, name.get(length..)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_their_rooms() {
        let plain = "_RINvNtCs1_5fixel4draw8triangleNtNtB4_6target6BufferECsb_15fixel_workloads";
        assert_eq!(room(plain), Some("draw"));
        assert_eq!(room("_RNvNtNtCs1_5fixel8pipeline4fill5plane"), Some("pipeline"));
        assert_eq!(
            room("_RINvNtCsb_15fixel_workloads5flatNtCs7_5fixel6target6BufferE"),
            None
        );
        assert_eq!(room("memcpy"), None);
    }

    #[test]
    fn two_names_of_one_function_count_once() {
        let function = |name, address| Function {
            name,
            address,
            code: &[0; 10],
        };
        let shares = shares(&[
            function("_RINvNtCs1_5fixel4draw8triangleaE", 0),
            function("_RINvNtCs1_5fixel4draw8trianglebE", 10),
            function("_RINvNtCs1_5fixel4draw8trianglecE", 10),
            function("memcpy", 20),
        ]);
        let wanted = Share {
            bytes: 20,
            functions: 2,
        };
        assert_eq!(shares.get("draw"), Some(&wanted));
        assert_eq!(shares.len(), 2);
    }
}
