//! What an image's file tells: how much of it is for flash, and the names of its functions.

/// Of 32 bits, little-endian: bytes of a section's header, and of a symbol.
const SECTION: usize = 40;
const SYMBOL: usize = 16;

/// Kinds of sections: what the program brings along, and symbols.
const PROGBITS: u32 = 1;
const SYMTAB: u32 = 2;

/// Flags of sections.
const WRITE: u32 = 1;
const ALLOC: u32 = 2;

/// An image's file.
pub struct Elf<'a> {
    bytes: &'a [u8],
    sections: Vec<Section>,
}

struct Section {
    kind: u32,
    flags: u32,
    start: usize,
    size: usize,
    /// Of symbols: the section with their names.
    link: usize,
}

impl<'a> Elf<'a> {
    /// `None` for what is no such file.
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        let is_elf32 = bytes.starts_with(b"\x7fELF\x01\x01");
        let (start, count) = (word(bytes, 32)? as usize, half(bytes, 48)?);
        let section = |index: usize| {
            let at = start + index * SECTION;
            Some(Section {
                kind: word(bytes, at + 4)?,
                flags: word(bytes, at + 8)?,
                start: word(bytes, at + 16)? as usize,
                size: word(bytes, at + 20)? as usize,
                link: word(bytes, at + 24)? as usize,
            })
        };
        let sections = (0..count).map(section).collect::<Option<_>>()?;
        is_elf32.then_some(Elf { bytes, sections })
    }

    /// Bytes of code and of constants.
    pub fn code_size(&self) -> usize {
        let is_code = |s: &&Section| s.kind == PROGBITS && s.flags & (WRITE | ALLOC) == ALLOC;
        self.sections.iter().filter(is_code).map(|s| s.size).sum()
    }

    /// Names of symbols, as the compiler has mangled them.
    pub fn symbols(&self) -> Vec<&'a str> {
        let tables = self.sections.iter().filter(|s| s.kind == SYMTAB);
        tables.flat_map(|table| self.names(table)).flatten().collect()
    }

    fn names(&self, table: &Section) -> impl Iterator<Item = Option<&'a str>> {
        let names = self.sections.get(table.link).map_or(0, |s| s.start);
        let ends = table.start + table.size;
        (table.start..ends).step_by(SYMBOL).map(move |at| {
            let name = self.bytes.get(names + word(self.bytes, at)? as usize..)?;
            let end = name.iter().position(|&byte| byte == 0)?;
            str::from_utf8(&name[..end]).ok()
        })
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let &word = bytes.get(at..)?.first_chunk()?;
    Some(u32::from_le_bytes(word))
}

fn half(bytes: &[u8], at: usize) -> Option<usize> {
    let &half = bytes.get(at..)?.first_chunk()?;
    Some(u16::from_le_bytes(half).into())
}

#[cfg(test)]
mod tests {
    use super::Elf;

    #[test]
    fn other_files_are_refused() {
        assert!(Elf::parse(b"").is_none());
        assert!(Elf::parse(&[0; 64]).is_none());
    }
}
