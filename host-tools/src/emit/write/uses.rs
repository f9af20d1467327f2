//! What a file uses of the core.

use std::collections::HashSet;

/// Modules and what may be used of them.
const NAMES: [(&str, &[&str]); 17] = [
    ("blend", &["Rgba"]),
    (
        "depth",
        &["Depth", "DepthBuffer", "LessOrEqual", "LessOrFar", "NoDepth"],
    ),
    ("disc", &["Disc"]),
    ("", &["draw"]),
    ("fragment", &["Antialiased", "Flat", "Fragment"]),
    ("light", &["Finish", "Light", "Lights", "Lit", "Matte"]),
    (
        "light::world",
        &["Glossy", "Material", "PointLight", "PointLights", "PointLit"],
    ),
    ("num", &["Block"]),
    (
        "screen",
        &["Center", "Corner", "FineDepth", "Position", "Shape", "SubPx"],
    ),
    ("", &["span"]),
    ("square", &["Square"]),
    ("", &["srgb"]),
    ("supersample", &["Level"]),
    ("target", &["Target"]),
    (
        "texture",
        &["Floor", "Nearest", "Palette", "Rgba8888", "Texture", "TowardsZero"],
    ),
    ("varying", &["Linear", "Perspective", "Varying"]),
    ("window", &["Window"]),
];

/// The `use` lines of some code.
pub fn of(code: &str) -> String {
    let code: String = code
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n")
        .collect::<String>()
        // Named in full where they are used.
        .replace("fixel::light::Matte", "");
    let words: HashSet<&str> = code.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let mut lines = String::new();
    for (module, names) in NAMES {
        let used: Vec<&str> = names
            .iter()
            .filter(|&&name| match module {
                "" => code.contains(&format!("{name}::")),
                // Programs name their varyings so, too.
                "varying" if name == "Varying" => code.contains("V: Varying"),
                _ => words.contains(name),
            })
            .copied()
            .collect();
        match used.as_slice() {
            [] => {}
            [name] if module.is_empty() => lines += &format!("use fixel::{name};\n"),
            [name] => lines += &format!("use fixel::{module}::{name};\n"),
            names => lines += &format!("use fixel::{module}::{{{}}};\n", names.join(", ")),
        }
    }
    lines
}
