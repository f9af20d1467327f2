//! File names that come from a scene. A scene is somebody else's text, so what it names must stay in its folder.

/// The name without detours (`./a`, `a/../b`, `a//b`), with `/` between folders.
///
/// Refused are names that are absolute or climb out, in the spelling of any system, whichever this one is: a scene
/// must not be harmless here and harmful there. Removing the detours by their spelling, before a file system sees
/// them, is what makes `link/../../secret` harmless.
pub fn inside(name: &str) -> Result<String, &'static str> {
    const SEPARATORS: [char; 2] = ['/', '\\'];
    let drive = name.as_bytes().get(1) == Some(&b':') && name.starts_with(|first: char| first.is_ascii_alphabetic());
    if name.starts_with(SEPARATORS) || drive {
        return Err("file names must not be absolute");
    }
    if name.chars().any(char::is_control) {
        return Err("file names must not hold control characters");
    }
    let mut path: Vec<&str> = Vec::new();
    for part in name.split(SEPARATORS) {
        match part {
            "" | "." => {}
            ".." => {
                path.pop().ok_or("file names must not climb out of the folder")?;
            }
            _ => path.push(part),
        }
    }
    let names_a_file = !name.ends_with(SEPARATORS) && !name.ends_with("/.");
    if path.is_empty() || !names_a_file {
        return Err("expected the name of a file");
    }
    Ok(path.join("/"))
}

#[cfg(test)]
mod tests {
    use super::inside;

    #[test]
    fn names_inside_lose_their_detours() {
        for (name, plain) in [
            ("out.png", "out.png"),
            ("./out.png", "out.png"),
            ("a/b.png", "a/b.png"),
            ("a//b.png", "a/b.png"),
            ("a/../b.png", "b.png"),
            ("a\\b.png", "a/b.png"),
            ("..png", "..png"),
            ("...", "..."),
            ("é.png", "é.png"),
        ] {
            assert_eq!(inside(name).as_deref(), Ok(plain), "{name}");
        }
    }

    #[test]
    fn names_outside_are_refused() {
        for name in [
            "/etc/x.png",
            "\\x.png",
            "\\\\host\\share\\x.png",
            "C:\\x.png",
            "c:x.png",
            "../x.png",
            "a/../../x.png",
            "a\\..\\..\\x.png",
            "..",
            ".",
            "a/",
            "a/.",
            "a/..",
            "x\u{0}.png",
        ] {
            assert!(inside(name).is_err(), "{name}");
        }
    }
}
