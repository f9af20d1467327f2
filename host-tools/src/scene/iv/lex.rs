//! Text to tokens: `{ } [ ] ,` by themselves, words between them. `#` starts a comment anywhere.

use crate::scene::lex::Token;
use crate::scene::{Fault, Place};

/// The tokens of a text, one by one.
///
/// Text that is not UTF-8 is a fault when its first bad byte is reached, so that a fault further up is still the first
/// to be reported. A byte order mark at the start is skipped and does not count as a column.
#[derive(Debug)]
pub struct Lexer<'a> {
    /// What is left of the part that is UTF-8.
    rest: &'a str,
    /// Whether something follows that is not.
    broken: bool,
    /// Where `rest` begins.
    place: Place,
    /// Behind the token read last.
    end: Place,
}

impl<'a> Lexer<'a> {
    /// Starts at the beginning of `text`.
    pub fn new(text: &'a [u8]) -> Self {
        let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
        let chunk = text.utf8_chunks().next();
        let start = Place { line: 1, column: 1 };
        Self {
            rest: chunk.as_ref().map_or("", |chunk| chunk.valid()),
            broken: chunk.is_some_and(|chunk| !chunk.invalid().is_empty()),
            place: start,
            end: start,
        }
    }

    /// The next token; none at the end of the text.
    pub fn next(&mut self) -> Result<Option<Token<'a>>, Fault> {
        self.skip_separators();
        let place = self.place;
        let length = match self.rest.bytes().next() {
            None => return self.whole().map(|()| None),
            Some(first) if is_punctuation(first) => 1,
            Some(_) => self.rest.bytes().position(ends_word).unwrap_or(self.rest.len()),
        };
        let text = self.advance(length);
        if self.rest.is_empty() {
            self.whole()?;
        }
        self.end = self.place;
        Ok(Some(Token { text, place }))
    }

    /// Behind the last token of the text, once [`next`](Self::next) has found no more.
    pub fn end(&self) -> Place {
        self.end
    }

    fn skip_separators(&mut self) {
        while let Some(first) = self.rest.bytes().next() {
            match first {
                b'\n' => {
                    self.rest = &self.rest[1..];
                    self.place.line += 1;
                    self.place.column = 1;
                }
                b' ' | b'\t' | b'\r' => {
                    self.advance(1);
                }
                b'#' => {
                    let length = self.rest.bytes().position(|byte| byte == b'\n');
                    self.advance(length.unwrap_or(self.rest.len()));
                }
                _ => break,
            }
        }
    }

    /// Takes so many bytes, which hold no end of line.
    fn advance(&mut self, length: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(length);
        self.place.column += taken.chars().count();
        self.rest = rest;
        taken
    }

    /// A fault if the text broke off here because it is not UTF-8.
    fn whole(&self) -> Result<(), Fault> {
        if self.broken {
            return Err(Fault::new(self.place, "the text is not UTF-8 from here on"));
        }
        Ok(())
    }
}

fn is_punctuation(byte: u8) -> bool {
    matches!(byte, b'{' | b'}' | b'[' | b']' | b',')
}

fn ends_word(byte: u8) -> bool {
    is_punctuation(byte) || matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | b'#')
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A word, its line and its column.
    type Word<'a> = (&'a str, usize, usize);

    fn words(text: &[u8]) -> Result<Vec<Word<'_>>, (usize, usize)> {
        let mut lexer = Lexer::new(text);
        let mut words = Vec::new();
        loop {
            match lexer.next() {
                Ok(Some(token)) => words.push((token.text, token.place.line, token.place.column)),
                Ok(None) => return Ok(words),
                Err(fault) => return Err((fault.place.line, fault.place.column)),
            }
        }
    }

    #[test]
    fn punctuation_needs_no_space() {
        let texts = |text: &'static str| words(text.as_bytes()).map(|w| w.iter().map(|w| w.0).collect::<Vec<_>>());
        assert_eq!(
            texts("[0,1,2,-1]"),
            Ok(vec!["[", "0", ",", "1", ",", "2", ",", "-1", "]"])
        );
        assert_eq!(texts("A{b 1.#}\n}"), Ok(vec!["A", "{", "b", "1.", "}"]));
        assert_eq!(texts("#Inventor V2.0 ascii\r\na#b\r\n##\n#"), Ok(vec!["a"]));
        assert_eq!(texts(""), Ok(vec![]));
    }

    #[test]
    fn places_count_characters_and_lines() {
        let text = "a\té{\r\n\r\n é# é\n\r b\n\n";
        let expected = [("a", 1, 1), ("é", 1, 3), ("{", 1, 4), ("é", 3, 2), ("b", 4, 3)];
        assert_eq!(words(text.as_bytes()), Ok(expected.to_vec()));
        let mut lexer = Lexer::new(text.as_bytes());
        while lexer.next() != Ok(None) {}
        assert_eq!(lexer.end(), Place { line: 4, column: 4 });
    }

    #[test]
    fn a_byte_order_mark_is_no_column() {
        assert_eq!(words(b"\xEF\xBB\xBFa"), Ok(vec![("a", 1, 1)]));
    }

    #[test]
    fn bad_utf8_has_a_place() {
        for (text, place) in [
            (&b"\xFF"[..], (1, 1)),
            (b"a\n\xC3\xA9 \xFF b", (2, 3)),
            (b"ab\xFF", (1, 3)),
            (b"# caf\xE9\n", (1, 6)),
            (b"{\xE9}", (1, 2)),
            (b"a \xE2\x82", (1, 3)),
        ] {
            assert_eq!(words(text), Err(place), "{text:?}");
        }
    }
}
