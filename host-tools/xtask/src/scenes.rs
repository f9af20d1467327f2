//! The scenes that have the same bits on every board, in every tier, whole and in strips.

use fixel::quality::{Balanced, Exact, Fast, Quality};

use crate::board::{BOARDS, Board, MICROBIT};
use crate::checks::differing;
use crate::failure::Failure;
use crate::outcome::{Outcome, find};
use crate::toolchain::Toolchain;
use crate::{emulator, host, image};

/// Scenes that there must be in every tier, whole and in strips.
const FEWEST: usize = 24;

/// The tiers that there must be.
const TIERS: [&str; 3] = [Fast::NAME, Balanced::NAME, Exact::NAME];

/// Draws every scene on every board and prints a line for each; what is off.
pub fn check() -> Result<Vec<String>, Failure> {
    let expected = host::draw_scenes();
    let mut off = strips_differing(&expected);
    off.extend(too_few(&expected));
    let (mut drawn, mut summaries) = (Vec::new(), Vec::new());
    for board in &BOARDS {
        let outcomes = draw(board, "scenes")?;
        let differing = differing(board.key, &outcomes, &expected);
        summaries.push(format!(
            "{} ({}): {} pictures, {} differ from the host's or are missing",
            board.core,
            board.machine,
            outcomes.len(),
            differing.len()
        ));
        off.extend(differing);
        drawn.push(outcomes);
    }
    print_table(&expected, &drawn);
    println!("{}: {}", std::env::consts::ARCH, counted(&expected));
    summaries.iter().for_each(|summary| println!("{summary}"));
    off.extend(check_strips(&expected)?);
    Ok(off)
}

fn draw(board: &Board, image: &str) -> Result<Vec<Outcome>, Failure> {
    let image = image::build_bare(board, &Toolchain::find(board.target)?, image)?;
    Outcome::parse_all(&emulator::run(board, &image)?)
}

/// The scene and the tier of a line, if it is one of a whole picture.
fn whole(outcome: &Outcome) -> Option<(&str, &str)> {
    let name = outcome.name.as_str();
    name.split_once('/').filter(|_| !name.contains('@'))
}

/// Scenes whose strips are not those of the whole picture.
fn strips_differing(outcomes: &[Outcome]) -> Vec<String> {
    let complaint = |strips: &Outcome| {
        let (scene, _) = strips.name.split_once('@')?;
        let bits = |o: &Outcome| (o.units, o.color, o.depth);
        let same = find(outcomes, scene).is_some_and(|whole| bits(whole) == bits(strips));
        (!same).then(|| format!("{}: not the bits of the whole picture", strips.name))
    };
    outcomes.iter().filter_map(complaint).collect()
}

/// What there should be of every tier, and is not.
fn too_few(outcomes: &[Outcome]) -> Vec<String> {
    let complaint = |tier: &&str| {
        let scenes: Vec<_> = scenes_of(outcomes, tier).collect();
        let strips = |scene: &&Outcome| {
            let begins = format!("{}@", scene.name);
            outcomes.iter().any(|outcome| outcome.name.starts_with(&begins))
        };
        let whole = scenes.len();
        let in_strips = scenes.into_iter().filter(strips).count();
        (in_strips < FEWEST)
            .then(|| format!("tier {tier}: {whole} scenes, {in_strips} of them in strips: fewer than {FEWEST}"))
    };
    TIERS.iter().filter_map(complaint).collect()
}

fn scenes_of<'a>(outcomes: &'a [Outcome], tier: &str) -> impl Iterator<Item = &'a Outcome> {
    outcomes
        .iter()
        .filter(move |o| whole(o).is_some_and(|(t, _)| t == tier))
}

/// How much is compared, in words.
fn counted(outcomes: &[Outcome]) -> String {
    let scenes = TIERS.map(|tier| format!("{} {tier}", scenes_of(outcomes, tier).count()));
    let strips = outcomes.iter().filter(|o| whole(o).is_none()).count();
    format!(
        "{} scenes, whole, and {strips} of strips: {} pictures",
        scenes.join(", "),
        outcomes.len()
    )
}

/// One line a scene: its checksums and its instructions on each board.
fn print_table(expected: &[Outcome], drawn: &[Vec<Outcome>]) {
    print!("{:<30}{:>10}{:>10}", "scene", "colour", "depth");
    BOARDS.iter().for_each(|board| print!("{:>11}", board.key));
    println!("   instructions, and whether the strips' bits are the same");
    for scene in expected.iter().filter(|o| whole(o).is_some()) {
        print!("{:<30}  {:08x}  {:08x}", scene.name, scene.color, scene.depth);
        let mut equal = true;
        for outcomes in drawn {
            let there = find(outcomes, &scene.name);
            print!("{:>11}", there.map_or(0, |o| o.instructions));
            equal &= there.is_some_and(|o| o.same_bits(scene));
        }
        println!("   {}", if equal { "same" } else { "DIFFERS" });
    }
}

/// The demonstration for 16 KiB of RAM: strips there, the whole picture here.
fn check_strips(expected: &[Outcome]) -> Result<Vec<String>, Failure> {
    let drawn = draw(&MICROBIT, "strips")?;
    let mut off = Vec::new();
    if drawn.is_empty() {
        off.push(format!("{}: nothing drawn", MICROBIT.key));
    }
    for strips in &drawn {
        let name = format!("exact/{}", strips.name);
        let bits = |o: &Outcome| (o.units, o.color, o.depth);
        let same = find(expected, &name).is_some_and(|whole| bits(whole) == bits(strips));
        println!(
            "{} in strips of 16 rows, {}: colour {:08x}, depth {:08x}, {} instructions: {}",
            strips.name,
            MICROBIT.core,
            strips.color,
            strips.depth,
            strips.instructions,
            if same { "the host's frame" } else { "DIFFERS" }
        );
        if !same {
            off.push(format!("{} {}: not the host's frame", MICROBIT.key, strips.name));
        }
    }
    Ok(off)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(name: &str, color: u32) -> Outcome {
        Outcome {
            name: name.into(),
            instructions: 0,
            units: 1,
            color,
            depth: 2,
        }
    }

    #[test]
    fn strips_of_other_bits_are_found() {
        let good = [outcome("exact/a", 7), outcome("exact/a@1", 7)];
        assert!(strips_differing(&good).is_empty());
        assert_eq!(
            strips_differing(&[outcome("exact/a", 7), outcome("exact/a@1", 8)]).len(),
            1
        );
        assert_eq!(strips_differing(&[outcome("exact/a@1", 7)]).len(), 1);
    }

    #[test]
    fn a_board_with_one_bit_off_is_found() {
        let board = &BOARDS[0];
        let expected = host::draw_scenes();
        assert!(differing(board.key, &expected, &expected).is_empty());
        let mut off = expected.clone();
        off[5].depth ^= 1;
        assert_eq!(differing(board.key, &off, &expected).len(), 1);
        off.remove(9);
        assert_eq!(differing(board.key, &off, &expected).len(), 2);
    }

    #[test]
    fn too_few_scenes_are_found() {
        let all = host::draw_scenes();
        assert!(too_few(&all).is_empty());
        assert_eq!(too_few(&[]).len(), TIERS.len());
        let without = |begins: &str| {
            all.iter()
                .filter(|o| !o.name.starts_with(begins))
                .cloned()
                .collect::<Vec<_>>()
        };
        assert_eq!(too_few(&without("balanced/")).len(), 1);
        let whole = all.iter().filter(|o| whole(o).is_some()).cloned().collect::<Vec<_>>();
        assert_eq!(too_few(&whole).len(), TIERS.len());
    }
}
