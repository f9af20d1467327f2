//! What an image's file tells: how much of it is for flash, and its functions.

/// Of 32 bits, little-endian: bytes of a section's header, and of a symbol.
const SECTION: usize = 40;
const SYMBOL: usize = 16;

/// Kinds of sections: what the program brings along, what is zero at first, and symbols.
const PROGBITS: u32 = 1;
const NOBITS: u32 = 8;
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
    address: u32,
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
                address: word(bytes, at + 12)?,
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

    /// Bytes of variables.
    pub fn ram_size(&self) -> usize {
        let is_variable =
            |s: &&Section| matches!(s.kind, PROGBITS | NOBITS) && s.flags & (WRITE | ALLOC) == WRITE | ALLOC;
        self.sections.iter().filter(is_variable).map(|s| s.size).sum()
    }

    /// Names of symbols, as the compiler has mangled them.
    pub fn symbols(&self) -> Vec<&'a str> {
        self.all_symbols().map(|symbol| symbol.name).collect()
    }

    /// The functions, each with its machine code; several names of one function are as many functions.
    pub fn functions(&self) -> Vec<Function<'a>> {
        let functions = self.all_symbols().filter(|symbol| symbol.kind == FUNCTION);
        let function = |symbol: Symbol<'a>| {
            // The lowest bit says that it is Thumb code.
            let address = symbol.address & !1;
            let section = self.sections.iter().find(|s| s.kind == PROGBITS && s.has(address))?;
            let start = section.start + (address - section.address) as usize;
            Some(Function {
                name: symbol.name,
                address,
                code: self.bytes.get(start..start + symbol.size as usize)?,
            })
        };
        functions.filter_map(function).collect()
    }

    /// Where code (`true`) and where constants between code begin, in order of addresses.
    pub fn code_marks(&self) -> Vec<(u32, bool)> {
        let mark = |symbol: Symbol<'_>| match symbol.name.get(..2) {
            Some("$t") => Some((symbol.address & !1, true)),
            Some("$d") => Some((symbol.address, false)),
            _ => None,
        };
        let mut marks: Vec<_> = self.all_symbols().filter_map(mark).collect();
        marks.sort_unstable();
        marks
    }

    fn all_symbols(&self) -> impl Iterator<Item = Symbol<'a>> {
        let tables = self.sections.iter().filter(|s| s.kind == SYMTAB);
        tables.flat_map(|table| self.entries(table)).flatten()
    }

    fn entries(&self, table: &Section) -> impl Iterator<Item = Option<Symbol<'a>>> {
        let names = self.sections.get(table.link).map_or(0, |s| s.start);
        let ends = table.start + table.size;
        (table.start..ends).step_by(SYMBOL).map(move |at| {
            let name = self.bytes.get(names + word(self.bytes, at)? as usize..)?;
            let end = name.iter().position(|&byte| byte == 0)?;
            Some(Symbol {
                name: str::from_utf8(&name[..end]).ok()?,
                address: word(self.bytes, at + 4)?,
                size: word(self.bytes, at + 8)?,
                kind: self.bytes.get(at + 12)? & 15,
            })
        })
    }
}

/// A symbol as it is stored.
struct Symbol<'a> {
    name: &'a str,
    address: u32,
    size: u32,
    kind: u8,
}

/// Kind of symbols.
const FUNCTION: u8 = 2;

/// A function of an image.
#[derive(Debug, Clone, Copy)]
pub struct Function<'a> {
    /// As the compiler has mangled it.
    pub name: &'a str,
    /// Where it begins.
    pub address: u32,
    /// What it is.
    pub code: &'a [u8],
}

impl Section {
    fn has(&self, address: u32) -> bool {
        (self.address..self.address.saturating_add(self.size as u32)).contains(&address)
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
