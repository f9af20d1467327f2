//! The command line of `host-render`.

use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, ValueEnum};

use crate::fixed::dials::Tier;
use crate::scene::format::Format;
use crate::scene::iv::Shading;
use crate::scene::size::Size;

const EXIT_CODES: &str = "\
host-render emit SCENE -o FILE.rs writes a scene as Rust for firmware; see host-render emit --help.
host-render extremes shows how far the stated bounds hold; see host-render extremes --help.
host-render sweep shows what a scene's speed costs in accuracy; see host-render sweep --help.

With --quality fast or balanced the bounds are still those of exact: what lies beyond them is counted as unexplained, \
and the run ends with 1. No quality changes which pixels are covered, but fast where things are \
rotated: its sines are within 10^-4.

Exit codes: 0 within limits, 1 differs, 2 bad scene or bad usage, 3 file trouble, 4 internal error; of several \
scenes the largest.

Colours of --diff-out: black equal, blue colour, yellow edge, green depth, cyan texel, magenta pole, orange steep, \
red unexplained.";

/// Renders scenes with the fixed-point core and with a float64 reference, and says where and why the two differ.
#[derive(Debug, Clone, Parser)]
#[command(name = "host-render", version, after_help = EXIT_CODES)]
pub struct Args {
    /// Scene files
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,

    /// Picture of the fixed-point core (one scene) [default: the name in the scene, in --out-dir]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Where pictures go
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out_dir: PathBuf,

    /// Format of the scenes [default: told from the text]
    #[arg(long, value_enum)]
    pub format: Option<Format>,

    /// Size of the picture, of iv and OBJ scenes [default: 500x500]
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,

    /// How faces get their colours, of iv and OBJ scenes [default: gouraud]
    #[arg(long, value_enum)]
    pub shading: Option<Shading>,

    /// Add a dim light at the camera, to iv and OBJ scenes
    #[arg(long)]
    pub eyelight: bool,

    /// Picture of the float64 reference (one scene)
    #[arg(long, value_name = "FILE")]
    pub reference_out: Option<PathBuf>,

    /// Classified difference picture (one scene)
    #[arg(long, value_name = "FILE")]
    pub diff_out: Option<PathBuf>,

    /// Also compare both pictures with an existing one (one scene)
    #[arg(long, value_name = "PNG")]
    pub against: Option<PathBuf>,

    /// Mask of excused pixels for --against: white is excused (one scene)
    #[arg(long, value_name = "PNG", requires = "against")]
    pub ties: Option<PathBuf>,

    /// Depth of the fixed-point core as grey, 0 black to 1 white (one scene)
    #[arg(long, value_name = "FILE")]
    pub depth_out: Option<PathBuf>,

    /// A page of HTML that shows both pictures, where they differ and why
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,

    /// Show in the report what speed costs in accuracy, as host-render sweep does; this takes a while
    #[arg(long, requires = "report")]
    pub sweep: bool,

    /// Tier of the fixed-point core
    #[arg(long, value_enum, value_name = "NAME", default_value = "exact")]
    pub quality: Tier,

    /// One JSON object per scene on standard output
    #[arg(long)]
    pub json: bool,

    /// The command line itself, quoted for a shell.
    #[arg(skip)]
    pub command: String,
}

impl Args {
    /// Reads the command line of this process; explains itself and ends the process where that makes no sense.
    pub fn read() -> Self {
        Self::from(std::env::args_os()).unwrap_or_else(|error| error.exit())
    }

    /// Reads a command line, the program's name first.
    pub fn from<T>(words: impl IntoIterator<Item = T>) -> Result<Self, clap::Error>
    where
        T: Into<std::ffi::OsString> + Clone,
    {
        let words: Vec<std::ffi::OsString> = words.into_iter().map(Into::into).collect();
        let mut args = Self::try_parse_from(&words)?;
        args.command = quoted(&words);
        match args.single_option() {
            Some(option) if args.scenes.len() > 1 => Err(Self::command().error(
                ErrorKind::ArgumentConflict,
                format!("{option} takes one scene, found {}", args.scenes.len()),
            )),
            _ => Ok(args),
        }
    }

    /// What says of one scene how it is to be read.
    pub fn of_scene(
        scene: PathBuf,
        format: Option<Format>,
        size: Option<Size>,
        shading: Option<Shading>,
        eyelight: bool,
    ) -> Self {
        Args {
            scenes: vec![scene],
            output: None,
            out_dir: PathBuf::from("."),
            format,
            size,
            shading,
            eyelight,
            reference_out: None,
            diff_out: None,
            against: None,
            ties: None,
            depth_out: None,
            report: None,
            sweep: false,
            quality: Tier::Exact,
            json: false,
            command: String::new(),
        }
    }

    /// The options of [`of_scene`](Self::of_scene), as they are given on a command line.
    pub fn scene_options(&self) -> Vec<String> {
        let mut options = Vec::new();
        if let Some(format) = self.format {
            options.push(format!("--format={format}"));
        }
        if let Some(size) = self.size {
            options.push(format!("--size={}x{}", size.width(), size.height()));
        }
        if let Some(shading) = self.shading.and_then(|shading| shading.to_possible_value()) {
            options.push(format!("--shading={}", shading.get_name()));
        }
        if self.eyelight {
            options.push("--eyelight".to_owned());
        }
        options
    }

    /// An option given that says what only iv and OBJ scenes leave open.
    pub fn view_option(&self) -> Option<&'static str> {
        [
            (self.size.is_some(), "--size"),
            (self.shading.is_some(), "--shading"),
            (self.eyelight, "--eyelight"),
        ]
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
    }

    /// An option given that names one file, and so can serve one scene only.
    fn single_option(&self) -> Option<&'static str> {
        [
            (&self.output, "--output"),
            (&self.reference_out, "--reference-out"),
            (&self.diff_out, "--diff-out"),
            (&self.against, "--against"),
            (&self.ties, "--ties"),
            (&self.depth_out, "--depth-out"),
        ]
        .into_iter()
        .find_map(|(file, name)| file.as_ref().map(|_| name))
    }
}

/// The words as one would type them, the program by its name alone.
fn quoted(words: &[std::ffi::OsString]) -> String {
    let arguments = words.iter().skip(1).map(|word| word.to_string_lossy());
    let words: Vec<_> = std::iter::once("host-render".into()).chain(arguments).collect();
    // A word with a zero byte cannot come from a command line.
    shlex::try_join(words.iter().map(|word| word.as_ref())).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(line: &str) -> bool {
        Args::from(line.split(' ')).is_err_and(|error| error.exit_code() == 2)
    }

    #[test]
    fn the_definition_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn options_that_name_one_file_take_one_scene() {
        for option in [
            "-o",
            "--output",
            "--reference-out",
            "--diff-out",
            "--depth-out",
            "--against",
            "--against r.png --ties",
        ] {
            let one = format!("host-render a.txt {option} x.png");
            assert!(!refused(&one), "{option}");
            let two = format!("host-render a.txt b.txt {option} x.png");
            assert!(refused(&two), "{option}");
        }
    }

    #[test]
    fn the_command_is_quoted() {
        let args = Args::from(["/usr/bin/host-render", "a b.txt", "--report", "it's.html"]).expect("good usage");
        assert_eq!(args.command, r#"host-render 'a b.txt' --report "it's.html""#);
    }

    #[test]
    fn exact_is_the_quality_unless_another_is_asked_for() {
        let quality = |line: &str| Args::from(line.split(' ')).expect("good usage").quality;
        assert_eq!(quality("host-render a.txt"), Tier::Exact);
        for tier in [Tier::Fast, Tier::Balanced, Tier::Exact] {
            assert_eq!(quality(&format!("host-render a.txt --quality {tier}")), tier);
        }
    }

    #[test]
    fn the_options_of_a_scene_are_read_back() {
        let line = "host-render a.iv --format=iv --size=9x8 --shading=phong --eyelight";
        let args = Args::from(line.split(' ')).expect("good usage");
        assert_eq!(
            args.scene_options().join(" "),
            "--format=iv --size=9x8 --shading=phong --eyelight"
        );
        assert!(
            Args::from(["host-render", "a.txt"])
                .expect("good usage")
                .scene_options()
                .is_empty()
        );
    }

    #[test]
    fn bad_usage() {
        for line in [
            "host-render",
            "host-render a.txt --ties t.png",
            "host-render a.txt --format png",
            "host-render a.txt --report",
            "host-render a.txt --sweep",
            "host-render a.txt --quality",
            "host-render a.txt --quality best",
            "host-render a.iv --size",
            "host-render a.iv --size 10",
            "host-render a.iv --size 0x10",
            "host-render a.iv --size 20000x1",
            "host-render a.iv --shading 1",
            "host-render a.iv --eyelight=0.5",
            "host-render a.iv --eyelight --eyelight",
            "host-render a.txt -o",
        ] {
            assert!(refused(line), "{line}");
        }
    }
}
