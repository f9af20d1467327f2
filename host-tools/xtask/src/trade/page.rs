//! The tables that people read.

use fixel_workloads::tiers::TIERS;

use super::points::{MACHINES, Point, Sweep};

/// What stands before and after the README's table.
const BEGIN: &str = "<!-- cargo xtask trade --update writes from here -->\n";
const END: &str = "<!-- to here -->\n";

/// A scene's name in tables.
pub fn title(scene: &str) -> &str {
    match scene {
        "flat" => "flat mesh",
        "gouraud" => "Gouraud mesh",
        "textured" => "textured in perspective",
        "lit" => "lit per pixel",
        "convex" => "depth of what is convex",
        "filtered" => "linear filtering",
        "sky" => "output in RGB565",
        "sky by 4×4" => "output in RGB565, means of 4×4 pixels",
        "two levels" => "output in black and white",
        "two levels by 4×4" => "output in black and white, means of 4×4 pixels",
        "sines" => "sine and cosine",
        "edges" => "subpixel bits",
        other => other,
    }
}

/// What is drawn, and what errors are measured against, where that is not a scene of the tiers.
fn note(scene: &str) -> &str {
    match scene {
        "convex" => {
            "A sphere lit at its vertices. What is not seen of it faces away, and any order will do: \
             here depth costs and changes nothing.\n\n"
        }
        "filtered" => "The corridor with bricks four times as large, against linear filtering.\n\n",
        "sky" => "A grey that changes by 70 levels over the picture. The error is that of a pixel.\n\n",
        "two levels" => "The same grey, all of which black is nearer to than white. The error is that of a pixel.\n\n",
        "sky by 4×4" | "two levels by 4×4" => {
            "The same pictures. The error is that of the mean of 4×4 pixels, which is what an eye at some distance sees.\n\n"
        }
        "linear light" => {
            "The Gouraud mesh with colours that are linear light: encoded as sRGB at every pixel, which is what it is \
             measured against, or at the vertices.\n\n"
        }
        "sines" => {
            "Sine and cosine of one angle for each pixel, −1 shown as 0 and 1 as 255. Some 20 instructions of each are the \
             picture's.\n\n"
        }
        "edges" => {
            "400 triangles all over the picture invert what they cover, against corners that are not rounded. A pixel is \
             right or 255 levels off.\n\n"
        }
        _ => "",
    }
}

fn errors(point: &Point) -> String {
    let errors = &point.errors;
    format!(
        "{:.3} | {:.2} | {:.1} %",
        errors.mean,
        errors.p999,
        100.0 * errors.differing
    )
}

/// The tiers of every scene.
pub fn summary(sweeps: &[Sweep]) -> String {
    let machines = MACHINES.map(|(_, name)| name).join(" | ");
    let mut table = format!(
        "| scene | tier | {machines} | mean error | 99.9 % within | RGB565 differs |\n|---|---|{}---|---|---|\n",
        "---|".repeat(MACHINES.len())
    );
    for sweep in sweeps {
        for point in TIERS.iter().filter_map(|tier| sweep.point(tier)) {
            let costs = (0..MACHINES.len()).map(|machine| format!("{:.1}", sweep.per_pixel(point, machine)));
            let costs = costs.collect::<Vec<_>>().join(" | ");
            table += &format!(
                "| {} | {} | {costs} | {} |\n",
                title(&sweep.scene),
                point.dial,
                errors(point)
            );
        }
    }
    table
}

/// All points of every scene.
pub fn details(sweeps: &[Sweep]) -> String {
    let mut text = String::new();
    for sweep in sweeps {
        let machines = MACHINES.map(|(_, name)| name).join(" | ");
        text += &format!(
            "## {}\n\n{}{} pixels. **Bold**: on the front of that machine.\n\n\
             | | {machines} | mean error | 99.9 % within | RGB565 differs | largest |\n|---|{}---|---|---|---|\n",
            capital(title(&sweep.scene)),
            note(&sweep.scene),
            sweep.pixels,
            "---|".repeat(MACHINES.len())
        );
        for point in &sweep.points {
            let cost = |machine| {
                let cost = format!("{:.1}", sweep.per_pixel(point, machine));
                if sweep.is_on_front(point, machine) {
                    format!("**{cost}**")
                } else {
                    cost
                }
            };
            let costs = (0..MACHINES.len()).map(cost).collect::<Vec<_>>().join(" | ");
            text += &format!(
                "| {} | {costs} | {} | {:.2} |\n",
                point.dial,
                errors(point),
                point.errors.max
            );
        }
        text += "\n";
    }
    text.trim_end().to_owned() + "\n"
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// `text` with `table` between its marks; `None` without marks.
pub fn with_table(text: &str, table: &str) -> Option<String> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}{table}{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::super::points::tests::{point, sweep};
    use super::*;

    #[test]
    fn the_table_replaces_what_is_between_the_marks() {
        let text = format!("a\n{BEGIN}old\n{END}b\n");
        assert_eq!(with_table(&text, "new\n"), Some(format!("a\n{BEGIN}new\n{END}b\n")));
        assert_eq!(with_table("a\nb\n", "new\n"), None);
    }

    #[test]
    fn tables_have_their_figures() {
        let sweeps = [sweep(vec![point("fast", 1_000.0, 2.0), point("affine", 1_500.0, 3.0)])];
        assert!(summary(&sweeps).ends_with("| lit per pixel | fast | 10.0 | 20.0 | 10.0 | 2.000 | 6.00 | 25.0 % |\n"));
        let details = details(&sweeps);
        assert!(details.contains("| fast | **10.0** | **20.0** |") && details.contains("| affine | 15.0 | 30.0 |"));
    }
}
