//! Which picture goes to which file, decided before anything is rendered.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::args::Args;
use crate::exit::Failure;
use crate::files::{self, Identity};
use crate::load::{Loaded, Refused};

/// The files one scene writes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outputs {
    /// The fixed-point core's picture.
    pub picture: PathBuf,
    /// The float64 reference's picture.
    pub reference: Option<PathBuf>,
    /// The classified difference picture.
    pub diff: Option<PathBuf>,
    /// The depth picture.
    pub depth: Option<PathBuf>,
}

impl Outputs {
    /// What the command line and the scene say.
    pub fn new(args: &Args, loaded: &Loaded) -> Self {
        Self {
            picture: match &args.output {
                Some(file) => file.clone(),
                None => args.out_dir.join(loaded.scene.output()),
            },
            reference: args.reference_out.clone(),
            diff: args.diff_out.clone(),
            depth: args.depth_out.clone(),
        }
    }

    /// All of them.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        std::iter::once(self.picture.as_path())
            .chain(self.reference.as_deref())
            .chain(self.diff.as_deref())
            .chain(self.depth.as_deref())
    }
}

/// What a file is to this run.
enum Role<'a> {
    /// Read, and never to be overwritten; what it is read as.
    Input(&'static str),
    /// Written by this scene.
    Output(&'a Loaded),
}

/// The outputs of all scenes, in order, if no file is written twice and none that is read is written. Scenes that
/// failed to load write nothing, but no output may overwrite them either.
pub fn plan(args: &Args, scenes: &[Result<Loaded, Refused>]) -> Result<Vec<Outputs>, Failure> {
    let mut roles: HashMap<Identity, Role<'_>> = HashMap::new();
    let mut protect = |file: &Path, what| {
        if let Some(identity) = files::identity(file) {
            roles.insert(identity, Role::Input(what));
        }
    };
    for scene in scenes {
        match scene {
            Ok(loaded) => loaded.textures().for_each(|file| protect(&file, "a texture")),
            Err(refused) => refused.textures.iter().for_each(|file| protect(file, "a texture")),
        }
    }
    for file in &args.scenes {
        protect(file, "a scene");
    }
    for (file, what) in [(&args.against, "--against"), (&args.ties, "--ties")] {
        if let Some(file) = file {
            protect(file, what);
        }
    }
    if let Some(file) = &args.report {
        claim_report(&mut roles, file)?;
    }
    let good = || scenes.iter().flatten();
    let outputs: Vec<_> = good().map(|loaded| Outputs::new(args, loaded)).collect();
    for (loaded, outputs) in good().zip(&outputs) {
        for file in outputs.files() {
            claim(&mut roles, file, loaded)?;
        }
    }
    Ok(outputs)
}

/// Takes a file for the report, which is of no scene.
fn claim_report(roles: &mut HashMap<Identity, Role<'_>>, file: &Path) -> Result<(), Failure> {
    let Some(identity) = files::identity(file) else {
        return Ok(());
    };
    match roles.insert(identity, Role::Input("the report")) {
        Some(Role::Input(what)) => Err(Failure::bad(format!(
            "the report {} would overwrite {what}",
            file.display()
        ))),
        _ => Ok(()),
    }
}

fn claim<'a>(roles: &mut HashMap<Identity, Role<'a>>, file: &Path, scene: &'a Loaded) -> Result<(), Failure> {
    let Some(identity) = files::identity(file) else {
        return Ok(());
    };
    let (scene_name, file) = (scene.file.display(), file.display());
    match roles.insert(identity, Role::Output(scene)) {
        None => Ok(()),
        Some(Role::Input(what)) => Err(Failure::bad(format!(
            "{scene_name}: its output {file} would overwrite {what}"
        ))),
        Some(Role::Output(other)) if std::ptr::eq(other, scene) => {
            Err(Failure::bad(format!("{scene_name}: two pictures would go to {file}")))
        }
        Some(Role::Output(other)) if other.file == scene.file => Err(Failure::bad(format!(
            "{scene_name} is named twice, and would write {file} twice"
        ))),
        Some(Role::Output(other)) => Err(Failure::bad(format!(
            "{} and {scene_name} would both write {file}",
            other.file.display()
        ))),
    }
}
