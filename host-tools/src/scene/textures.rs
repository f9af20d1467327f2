//! The textures that a scene names: each is looked up once, and all together have a limit.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::arguments::{Arguments, quoted};
use super::{Fault, MOST_PIXELS, lex, names};
use crate::files;
use crate::picture::Picture;

/// The textures named so far, and what the lookup gave for each.
pub struct Textures<'l, T> {
    look_up: &'l mut dyn FnMut(&str) -> Result<T, String>,
    found: BTreeMap<String, T>,
}

impl<'l, T: Clone> Textures<'l, T> {
    /// No texture yet; `look_up` gives the texture of a name or says what is wrong with it.
    pub fn new(look_up: &'l mut dyn FnMut(&str) -> Result<T, String>) -> Self {
        Self {
            look_up,
            found: BTreeMap::new(),
        }
    }

    /// Reads the name that comes next; a name known already is not looked up again.
    pub fn read(&mut self, arguments: &mut Arguments<'_>) -> Result<(String, T), Fault> {
        let name = arguments.file_name()?;
        if let Some(texture) = self.found.get(&name) {
            return Ok((name, texture.clone()));
        }
        let texture = (self.look_up)(&name)
            .map_err(|message| Fault::new(arguments.last(), format!("texture {}: {message}", quoted(&name))))?;
        self.found.insert(name.clone(), texture.clone());
        Ok((name, texture))
    }

    /// Whether none was named yet.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All of them, by name.
    pub fn into_found(self) -> BTreeMap<String, T> {
        self.found
    }
}

/// The names that lines of a text give to textures, whatever is wrong with the text: what a bad scene calls its own is not
/// to be overwritten either.
pub fn named(text: &[u8]) -> Vec<String> {
    let lines = lex::lines(text).filter_map(Result::ok);
    let named = lines.filter(|line| line.keyword.text == "texture");
    named
        .filter_map(|line| names::inside(line.arguments.first()?.text).ok())
        .collect()
}

/// A lookup that reads files of `folder`, which may have [`MOST_PIXELS`] in all.
pub fn in_folder(folder: &Path) -> impl FnMut(&str) -> Result<Arc<Picture>, String> {
    let mut room = MOST_PIXELS;
    move |name| {
        let texture = files::read_texture(&folder.join(name))?;
        room = (room.checked_sub(texture.pixels.len() as u64))
            .ok_or_else(|| format!("too large: with it, the scene's textures are more than {MOST_PIXELS} pixels"))?;
        Ok(Arc::new(texture))
    }
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn textures_are_known_before_and_behind_a_fault() {
        let text = b"png 1\ntexture a.png\n# texture b.png\n\xFF\ntexture\ntexture ../c.png\n texture ./d.png 1\n";
        assert_eq!(named(text), ["a.png", "d.png"]);
    }
}
