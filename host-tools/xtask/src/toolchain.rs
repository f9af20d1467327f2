//! A compiler for a bare-metal target: one that has its library, else one that has the library's sources.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::Failure;

/// Where a distribution's package puts its compiler.
const DISTRIBUTION: &str = "/usr/bin/rustc";

/// How to build for one target.
pub struct Toolchain {
    target: &'static str,
    compiler: Compiler,
    /// The library is built from its sources along with everything else.
    build_std: bool,
    /// Named where the compiler has none of its own.
    linker: Option<PathBuf>,
}

impl Toolchain {
    /// The first that fits: the compiler in use, then the distribution's; ready-made library first, then its sources.
    pub fn find(target: &'static str) -> Result<Self, Failure> {
        let in_use = env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
        let compilers: Vec<_> = [in_use.as_str(), DISTRIBUTION]
            .iter()
            .filter_map(|p| Compiler::at(p))
            .collect();
        let ready = compilers.iter().find(|c| c.has_library(target)).map(|c| (c, false));
        let sources = || compilers.iter().find(|c| c.has_sources()).map(|c| (c, true));
        let Some((compiler, build_std)) = ready.or_else(sources) else {
            return Err(Failure::Usage(missing(target)));
        };
        Ok(Toolchain {
            target,
            linker: linker(compiler, &compilers)?,
            compiler: compiler.clone(),
            build_std,
        })
    }

    /// The compiler's version, for figures that depend on it.
    pub fn version(&self) -> &str {
        &self.compiler.version
    }

    /// `cargo build` for the target, output below `target_dir`; what to build is the caller's to add.
    pub fn cargo_build(&self, target_dir: &Path) -> Command {
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["build", "--quiet", "--locked", "--target", self.target, "--target-dir"]);
        cargo.arg(target_dir);
        cargo.env("RUSTC", &self.compiler.program);
        // Of the cargo that runs this: another compiler's libraries, and flags meant for the host.
        for variable in ["LD_LIBRARY_PATH", "RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS"] {
            cargo.env_remove(variable);
        }
        if self.build_std {
            cargo.arg("-Zbuild-std=core,alloc").env("RUSTC_BOOTSTRAP", "1");
        }
        if let Some(linker) = &self.linker {
            let name = self.target.to_uppercase().replace('-', "_");
            cargo.env(format!("CARGO_TARGET_{name}_LINKER"), linker);
        }
        cargo
    }
}

fn missing(target: &str) -> String {
    format!(
        "no compiler here can build for {target}. Either of these will do:\n  \
         rustup target add {target}\n  \
         apt-get install --no-install-recommends rustc-web rust-web-src   (Debian's compiler with its library's sources)"
    )
}

/// None where `compiler` finds its own; else that of another compiler, else one in the search path.
fn linker(compiler: &Compiler, others: &[Compiler]) -> Result<Option<PathBuf>, Failure> {
    if compiler.linker().is_file() {
        return Ok(None);
    }
    let path = env::var_os("PATH").unwrap_or_default();
    let in_path = || env::split_paths(&path).flat_map(|dir| ["rust-lld", "ld.lld"].map(|name| dir.join(name)));
    let mut candidates = others.iter().map(Compiler::linker).chain(in_path());
    candidates.find(|linker| linker.is_file()).map(Some).ok_or_else(|| {
        Failure::Usage(
            "no bare-metal linker: neither rust-lld of a rustup toolchain nor ld.lld (apt-get install lld)".into(),
        )
    })
}

/// A compiler and where its parts are.
#[derive(Clone)]
struct Compiler {
    program: PathBuf,
    version: String,
    host: String,
    sysroot: PathBuf,
}

impl Compiler {
    /// `None` where `program` does not run.
    fn at(program: &str) -> Option<Self> {
        let about = ask(program, &["--version", "--verbose"])?;
        let field = |name| {
            about
                .lines()
                .find_map(|line| line.strip_prefix(name))
                .map(str::to_owned)
        };
        Some(Compiler {
            program: program.into(),
            version: field("release: ")?,
            host: field("host: ")?,
            sysroot: ask(program, &["--print", "sysroot"])?.into(),
        })
    }

    fn has_library(&self, target: &str) -> bool {
        self.sysroot.join("lib/rustlib").join(target).join("lib").is_dir()
    }

    fn has_sources(&self) -> bool {
        self.sysroot.join("lib/rustlib/src/rust/library/core").is_dir()
    }

    fn linker(&self) -> PathBuf {
        self.sysroot.join("lib/rustlib").join(&self.host).join("bin/rust-lld")
    }
}

/// What `program` prints, without the last line end; `None` where it fails.
fn ask(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program)
        .args(arguments)
        .env_remove("LD_LIBRARY_PATH")
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim_end().to_owned())
}
