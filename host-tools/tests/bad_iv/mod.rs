//! The bad Inventor scenes of the conformance set, and where their faults stand.

use std::path::{Path, PathBuf};

/// A scene that must be refused.
pub struct BadScene {
    /// As the manifest calls it.
    pub name: String,
    /// The file's name.
    pub file: String,
    pub text: Vec<u8>,
    /// The line of the fault; none if it is the whole text's.
    pub line: Option<usize>,
}

/// All of them; none if there is no manifest to be had.
pub fn bad_scenes() -> Option<Vec<BadScene>> {
    let folder = PathBuf::from(std::env::var_os("FIXEL_CONFORMANCE")?);
    let manifest = std::fs::read_to_string(folder.join("MANIFEST-iv.tsv")).expect("MANIFEST-iv.tsv");
    let scenes = manifest.lines().skip(1).filter_map(|row| scene(&folder, row));
    Some(scenes.collect())
}

fn scene(folder: &Path, row: &str) -> Option<BadScene> {
    let fields: Vec<_> = row.split('\t').collect();
    let [_, name, _, kind, wanted, file, ..] = fields[..] else {
        panic!("not a row of the manifest: {row}");
    };
    if kind != "error" {
        return None;
    }
    let path = folder.join(file);
    let (_, message) = wanted
        .split_once("says as much as: ")
        .expect("the message that is wanted");
    let line = message.strip_prefix("line ").map(|rest| {
        let (line, _) = rest.split_once(':').expect("a colon behind the line");
        line.parse().expect("a line number")
    });
    Some(BadScene {
        name: name.into(),
        file: path.file_name().expect("a name").to_string_lossy().into_owned(),
        text: std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())),
        line,
    })
}
