//! The only room that opens files.
//!
//! A file is written whole or not at all: into a temporary one beside it, which is then renamed over it. A run that
//! fails or is killed leaves an existing file as it was.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::picture::Picture;
use crate::png;

/// What went wrong with a file: one line that names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trouble(pub String);

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Trouble {}

fn trouble(path: &Path, verb: &str, error: impl std::fmt::Display) -> Trouble {
    Trouble(format!("{}: cannot {verb}: {error}", path.display()))
}

/// The bytes of a file.
pub fn read(path: &Path) -> Result<Vec<u8>, Trouble> {
    fs::read(path).map_err(|error| trouble(path, "read", error))
}

/// A PNG file as a picture.
pub fn read_picture(path: &Path) -> Result<Picture, Trouble> {
    let picture = open_file(path).and_then(png::decode);
    picture.map_err(|error| trouble(path, "read", error))
}

/// A PNG file as a texture; the error says what is wrong with it, without the name.
pub fn read_texture(path: &Path) -> Result<Picture, String> {
    png::decode_texture(open_file(path)?)
}

/// A file proper, opened; the error says what is wrong with it, without the name.
fn open_file(path: &Path) -> Result<BufReader<File>, String> {
    let kind = fs::metadata(path).map_err(|error| error.to_string())?;
    // A pipe would make us wait for ever for somebody to write.
    if !kind.is_file() {
        return Err("not a file".to_owned());
    }
    let file = File::open(path).map_err(|error| error.to_string())?;
    Ok(BufReader::new(file))
}

/// Tells whether two names mean the same file, whatever their spelling, links included.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Identity {
    /// An existing file: device and number.
    Existing(u64, u64),
    /// A file that is not there yet, or a system that doesn't number files: the name without links or detours.
    Named(PathBuf),
}

/// The identity of a file; nothing for a pipe or a device, where writing overwrites nothing.
pub fn identity(path: &Path) -> Option<Identity> {
    let path = followed(path);
    match fs::metadata(&path) {
        Ok(found) if !found.is_file() && !found.is_dir() => None,
        Ok(found) => Some(numbered(&found).unwrap_or_else(|| named(&path))),
        Err(_) => Some(named(&path)),
    }
}

#[cfg(unix)]
fn numbered(found: &fs::Metadata) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    Some(Identity::Existing(found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn numbered(_: &fs::Metadata) -> Option<Identity> {
    None
}

fn named(path: &Path) -> Identity {
    let inside = |folder: PathBuf| path.file_name().map(|name| folder.join(name));
    let canonical = fs::canonicalize(path)
        .ok()
        .or_else(|| inside(fs::canonicalize(folder_of(path)).ok()?))
        .or_else(|| std::path::absolute(path).ok());
    Identity::Named(canonical.unwrap_or_else(|| path.to_owned()))
}

/// The file that a name finally means: links are followed, also one whose end does not exist yet. The name of a
/// pipe or device is left alone, as what it links to need not be a path.
fn followed(path: &Path) -> PathBuf {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    if let Ok(found) = fs::metadata(&path) {
        let file = found.is_file().then(|| fs::canonicalize(&path).ok());
        return file.flatten().unwrap_or(path);
    }
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&path) else {
            break;
        };
        path = folder_of(&path).join(next);
    }
    path
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The descriptor that a name such as `/dev/stdout` or `/dev/fd/3` means, links followed: whoever opened the file behind it
/// wants it written where it stands, not replaced.
fn descriptor(path: &Path) -> Option<u32> {
    const MOST_LINKS: usize = 40;
    let folder = fs::canonicalize("/dev/fd").ok()?;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        if fs::canonicalize(folder_of(&path)).is_ok_and(|found| found == folder) {
            return path.file_name()?.to_str()?.parse().ok();
        }
        path = folder_of(&path).join(fs::read_link(&path).ok()?);
    }
    None
}

/// A file that is ready to take its place.
#[derive(Debug)]
pub struct Staged {
    name: PathBuf,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    /// Written beside its target, to be renamed over it.
    Beside(NamedTempFile, PathBuf),
    /// A pipe or a device, which must not be replaced by a file.
    Stream(Vec<u8>),
    /// A descriptor that somebody opened for us.
    Descriptor(u32, Vec<u8>),
}

/// Prepares `name` to hold `bytes`. Nothing is changed until [`Staged::commit`]; dropping it changes nothing.
pub fn stage(name: &Path, bytes: Vec<u8>) -> Result<Staged, Trouble> {
    if let Some(number) = descriptor(name) {
        return Ok(Staged {
            name: name.to_owned(),
            kind: Kind::Descriptor(number, bytes),
        });
    }
    let target = followed(name);
    let kind = match fs::metadata(&target) {
        Ok(found) if found.is_dir() => {
            return Err(trouble(name, "write", "it is a directory"));
        }
        Ok(found) if !found.is_file() => Kind::Stream(bytes),
        Ok(found) => {
            // Renaming needs leave for the folder only; a file its owner has protected stays as it is.
            OpenOptions::new()
                .write(true)
                .open(&target)
                .map_err(|error| trouble(name, "write", error))?;
            beside(target, &bytes, Some(found.permissions())).map_err(|error| trouble(name, "write", error))?
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            beside(target, &bytes, None).map_err(|error| trouble(name, "write", error))?
        }
        Err(error) => return Err(trouble(name, "write", error)),
    };
    Ok(Staged {
        name: name.to_owned(),
        kind,
    })
}

fn beside(target: PathBuf, bytes: &[u8], mode: Option<Permissions>) -> io::Result<Kind> {
    let named = target.file_name().is_some() && !target.as_os_str().as_encoded_bytes().ends_with(b"/");
    if !named {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "expected the name of a file",
        ));
    }
    let folder = folder_of(&target);
    if !folder.exists() {
        let message = format!("there is no folder {}", folder.display());
        return Err(io::Error::new(io::ErrorKind::NotFound, message));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".host-render-").suffix(".part");
    #[cfg(unix)]
    {
        // What any program's new file gets, less the umask; without this it would be private.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder).map_err(without_name)?;
    file.write_all(bytes).map_err(without_name)?;
    if let Some(mode) = mode {
        file.as_file().set_permissions(mode)?;
    }
    Ok(Kind::Beside(file, target))
}

/// The error without the temporary file's name, which means nothing to the user.
fn without_name(error: io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(code) => io::Error::from_raw_os_error(code),
        None => error.kind().into(),
    }
}

fn all(mut stream: impl Write, bytes: &[u8]) -> io::Result<()> {
    stream.write_all(bytes)?;
    stream.flush()
}

impl Staged {
    /// Puts the file in its place.
    pub fn commit(self) -> Result<(), Trouble> {
        let done = match self.kind {
            Kind::Beside(file, target) => file.persist(target).map(drop).map_err(|e| e.error),
            Kind::Stream(bytes) => OpenOptions::new()
                .write(true)
                .open(&self.name)
                .and_then(|mut stream| stream.write_all(&bytes)),
            Kind::Descriptor(1, bytes) => all(io::stdout().lock(), &bytes),
            Kind::Descriptor(2, bytes) => all(io::stderr().lock(), &bytes),
            // Another one can only be opened anew: at the file's end, where nothing is lost.
            Kind::Descriptor(_, bytes) => OpenOptions::new()
                .append(true)
                .open(&self.name)
                .and_then(|mut stream| stream.write_all(&bytes)),
        };
        done.map_err(|error| trouble(&self.name, "write", error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_changes_before_the_commit() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.png");
        fs::write(&file, "old").expect("written");
        drop(stage(&file, b"new".to_vec()).expect("staged"));
        assert_eq!(fs::read(&file).expect("read"), b"old");
        let staged = stage(&file, b"new".to_vec()).expect("staged");
        assert_eq!(fs::read(&file).expect("read"), b"old");
        staged.commit().expect("in its place");
        assert_eq!(fs::read(&file).expect("read"), b"new");
        let left = fs::read_dir(folder.path()).expect("read").count();
        assert_eq!(left, 1, "a temporary file was left behind");
    }

    #[test]
    fn identity_sees_through_spelling() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| identity(&folder.path().join(name));
        fs::create_dir(folder.path().join("sub")).expect("a folder");
        assert_eq!(at("new.png"), at("sub/../new.png"));
        assert_eq!(at("new.png"), at("./new.png"));
        assert_ne!(at("new.png"), at("sub/new.png"));
        let before = at("new.png");
        fs::write(folder.path().join("new.png"), "").expect("written");
        assert_eq!(at("new.png"), at("sub/../new.png"));
        assert_ne!(at("new.png"), before, "an existing file is known by its number");
    }

    #[test]
    fn textures_are_files_of_their_kind() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("text.png"), "png 8 8 out.png").expect("written");
        let picture = Picture::new(1, 1, vec![[1; 4]]);
        fs::write(at("good.png"), png::encode(&picture).expect("encoded")).expect("written");
        assert_eq!(read_texture(&at("good.png")).as_ref(), Ok(&picture));
        for name in ["nosuch.png", "text.png", ".", "good.png/x"] {
            assert!(read_texture(&at(name)).is_err(), "{name}");
        }
        assert_eq!(read_picture(&at("good.png")), Ok(picture));
    }
}
