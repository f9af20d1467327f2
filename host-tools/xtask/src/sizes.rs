//! Flash per set of features, stack per kind of triangle: against their goals, and against what is stored.

use std::fs;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::added::Sizes as Added;
use crate::board::{Board, M4};
use crate::elf::Elf;
use crate::emulator;
use crate::failure::Failure;
use crate::image::{self, Profile, root};
use crate::outcome::{Outcome, find};
use crate::rooms;
use crate::toolchain::Toolchain;

/// Bytes may grow by three hundredths.
const TOLERANCE: f64 = 1.03;

/// Images of sets of features, what they are, and what they should take on thumbv7em in KiB.
static SETS: [(&str, &str, f64); 7] = [
    ("flat", "flat", 4.0),
    ("flat_compact", "flat, compact", 4.0),
    ("gouraud", "Gouraud, depth", 8.0),
    ("gouraud_compact", "Gouraud, depth, compact", 8.0),
    ("textured", "textured in perspective, depth", 12.0),
    ("textured_compact", "textured, depth, compact", 12.0),
    ("everything", "everything", 40.0),
];

const PROFILES: [Profile; 2] = [Profile::Small, Profile::Fast];

/// All of them for size; for speed without the last, which takes minutes to build.
fn sets(profile: Profile) -> &'static [(&'static str, &'static str, f64)] {
    match profile {
        Profile::Small => &SETS,
        Profile::Fast => SETS.split_last().map_or(&[], |(_, others)| others),
    }
}

const BOARDS: [Board; 1] = [M4];

/// Kinds of triangles whose stack has a goal, in bytes.
const STACKS: [(&str, u32); 3] = [
    ("flat", 1024),
    ("gouraud_depth", 1024),
    ("view_lit_textured_two_planes", 2048),
];

/// What the calibration of the stack takes: its array, and a few words around it.
const CALIBRATION: std::ops::RangeInclusive<u32> = 2000..=2064;

/// Measures, prints and compares all; what is off. `update` stores the figures instead.
pub fn check(update: bool) -> Result<Vec<String>, Failure> {
    let mut stored = Stored::read()?;
    let mut off = Vec::new();
    let mut judge = |key: &str, compiler: &str, figures: &[(String, u32)]| {
        if update {
            stored.update(key, compiler, figures);
        } else {
            let (over, notes) = stored.compare(key, compiler, figures);
            notes.iter().for_each(|note| println!("note: {note}"));
            off.extend(over);
        }
    };
    for board in &BOARDS {
        let toolchain = Toolchain::find(board.target)?;
        let mut sizes = sizes(board, &toolchain)?;
        print_sizes(board, toolchain.version(), &sizes);
        sizes.extend(raster_door()?);
        print_rooms(board)?;
        judge(board.target, toolchain.version(), &sizes);
    }
    let toolchain = Toolchain::find(M4.target)?;
    let stacks = stacks(&toolchain)?;
    print_stacks(&stacks);
    judge("stack", toolchain.version(), &stacks);
    if update {
        stored.write()?;
    }
    Ok(off)
}

/// Bytes of flash of every set in every profile, called `set/profile`.
fn sizes(board: &Board, toolchain: &Toolchain) -> Result<Vec<(String, u32)>, Failure> {
    let mut sizes = Vec::new();
    for profile in PROFILES {
        let names: Vec<_> = ["empty"]
            .into_iter()
            .chain(sets(profile).iter().map(|(set, ..)| *set))
            .map(|set| format!("size_{set}"))
            .collect();
        let files = image::build_all(board, toolchain, profile, &names)?;
        let bytes = |file: &PathBuf| {
            let bytes = fs::read(file).map_err(|e| Failure::trouble(file.display(), e))?;
            let image =
                Elf::parse(&bytes).ok_or_else(|| Failure::Trouble(format!("{}: not an image", file.display())))?;
            Ok(image.code_size() as u32)
        };
        let bytes = files.iter().map(bytes).collect::<Result<Vec<_>, Failure>>()?;
        let Some((empty, bytes_of_sets)) = bytes.split_first() else {
            continue;
        };
        for ((set, ..), bytes) in sets(profile).iter().zip(bytes_of_sets) {
            sizes.push((format!("{set}/{}", profile.name()), bytes.saturating_sub(*empty)));
        }
    }
    Ok(sizes)
}

/// The same of the raster door alone, which `cargo xtask measure` prints.
fn raster_door() -> Result<Vec<(String, u32)>, Failure> {
    let Added { flash, compact, .. } = Added::measure()?;
    let both = [("W2", flash), ("W2_compact", compact)];
    let named =
        both.map(|(set, [fast, small])| [(format!("{set}/3"), fast as u32), (format!("{set}/s"), small as u32)]);
    Ok(named.into_iter().flatten().collect())
}

fn print_sizes(board: &Board, compiler: &str, sizes: &[(String, u32)]) {
    println!(
        "\nKiB of flash, {}, rustc {compiler}, an empty image taken off",
        board.target
    );
    print!("{:<34}", "");
    PROFILES.iter().for_each(|profile| print!("{:>16}", profile.name()));
    println!("{:>10}", if board.key == M4.key { "goal" } else { "" });
    for (set, title, goal) in SETS {
        print!("{title:<34}");
        for profile in PROFILES {
            let name = format!("{set}/{}", profile.name());
            match sizes.iter().find(|(key, _)| *key == name) {
                Some((_, bytes)) => print!("{:>16.1}", f64::from(*bytes) / 1024.0),
                None => print!("{:>16}", "-"),
            }
        }
        println!(
            "{}",
            if board.key == M4.key {
                format!("{goal:>10}")
            } else {
                String::new()
            }
        );
    }
}

/// Where the flash of the largest image goes, once it is built.
fn print_rooms(board: &Board) -> Result<(), Failure> {
    let file = image::built_for(board, Profile::Small, "size_everything");
    let bytes = fs::read(&file).map_err(|e| Failure::trouble(file.display(), e))?;
    let image = Elf::parse(&bytes).ok_or_else(|| Failure::Trouble(format!("{}: not an image", file.display())))?;
    rooms::print(&image);
    Ok(())
}

/// Bytes of stack of every kind of triangle on the reference.
fn stacks(toolchain: &Toolchain) -> Result<Vec<(String, u32)>, Failure> {
    let image = image::build_bare(&M4, toolchain, "stack")?;
    let outcomes = Outcome::parse_all(&emulator::run(&M4, &image)?)?;
    calibrated(&outcomes)?;
    let kinds = outcomes.into_iter().filter(|outcome| outcome.name != "calibration");
    Ok(kinds.map(|outcome| (outcome.name, outcome.instructions)).collect())
}

/// Refuses figures of an image whose known depth is another.
fn calibrated(outcomes: &[Outcome]) -> Result<(), Failure> {
    let bytes = find(outcomes, "calibration").map_or(0, |outcome| outcome.instructions);
    let message = || Failure::Off(format!("stack: 2000 bytes counted as {bytes}"));
    CALIBRATION.contains(&bytes).then_some(()).ok_or_else(message)
}

fn print_stacks(stacks: &[(String, u32)]) {
    println!("\nbytes of stack, {}", M4.core);
    for (name, bytes) in stacks {
        let goal = STACKS.iter().find(|(kind, _)| kind == name);
        let goal = goal.map_or(String::new(), |(_, goal)| {
            format!("   goal {goal}{}", if bytes > goal { ": OVER" } else { "" })
        });
        println!("{name:<34}{bytes:>8}{goal}");
    }
}

/// Figures as they were.
struct Stored(Map<String, Value>);

impl Stored {
    fn file() -> PathBuf {
        root().join("firmware/sizes.json")
    }

    fn read() -> Result<Self, Failure> {
        let file = Self::file();
        let text = fs::read_to_string(&file).map_err(|e| Failure::trouble(file.display(), e))?;
        Ok(Stored(
            serde_json::from_str(&text).map_err(|e| Failure::trouble(file.display(), e))?,
        ))
    }

    fn write(&self) -> Result<(), Failure> {
        let file = Self::file();
        let text = format!("{:#}\n", Value::Object(self.0.clone()));
        fs::write(&file, text).map_err(|e| Failure::trouble(file.display(), e))
    }

    fn update(&mut self, key: &str, compiler: &str, figures: &[(String, u32)]) {
        let bytes: Map<_, _> = figures
            .iter()
            .map(|(name, bytes)| (name.clone(), json!(bytes)))
            .collect();
        self.0.insert(key.into(), json!({"compiler": compiler, "bytes": bytes}));
    }

    /// What is over the limit, and what else is worth telling. Figures of another compiler are noted, not judged.
    fn compare(&self, key: &str, compiler: &str, figures: &[(String, u32)]) -> (Vec<String>, Vec<String>) {
        let (mut over, mut notes) = (Vec::new(), Vec::new());
        let stored = self.0.get(key).unwrap_or(&Value::Null);
        let same_compiler = stored["compiler"] == compiler;
        if !same_compiler {
            notes.push(format!(
                "{key}: stored with rustc {}: nothing fails for its size",
                stored["compiler"]
            ));
        }
        for (name, bytes) in figures {
            let Some(limit) = stored["bytes"][name].as_f64() else {
                notes.push(format!("{key} {name}: {bytes} bytes, nothing is stored"));
                continue;
            };
            let ratio = f64::from(*bytes) / limit;
            let change = format!(
                "{key} {name}: {bytes} bytes, stored {limit} ({:+.1} %)",
                (ratio - 1.0) * 100.0
            );
            if ratio > TOLERANCE && same_compiler {
                over.push(change);
            } else if !(1.0 / TOLERANCE..=TOLERANCE).contains(&ratio) {
                notes.push(change);
            }
        }
        (over, notes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(bytes: u32) -> [(String, u32); 1] {
        [("flat/s".into(), bytes)]
    }

    fn stored() -> Stored {
        let mut stored = Stored(Map::new());
        stored.update("m4", "1.0", &figures(1000));
        stored
    }

    #[test]
    fn three_hundredths_more_pass_and_more_fails() {
        let over = |bytes| stored().compare("m4", "1.0", &figures(bytes)).0.len();
        assert_eq!([over(500), over(1030), over(1031)], [0, 0, 1]);
    }

    #[test]
    fn another_compiler_and_a_missing_figure_are_noted() {
        let (over, notes) = stored().compare("m4", "1.1", &figures(5000));
        assert!(over.is_empty() && notes.len() == 2);
        let (over, notes) = stored().compare("m0", "1.0", &figures(1));
        assert!(over.is_empty() && notes.len() == 2);
    }

    #[test]
    fn a_stack_that_is_not_counted_is_found() {
        let calibration = |bytes| {
            [Outcome {
                name: "calibration".into(),
                instructions: bytes,
                units: 0,
                color: 0,
                depth: 0,
            }]
        };
        assert!(calibrated(&calibration(2024)).is_ok());
        assert!(
            calibrated(&calibration(0)).is_err()
                && calibrated(&calibration(16384)).is_err()
                && calibrated(&[]).is_err()
        );
    }
}
