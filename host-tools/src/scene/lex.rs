//! Text to tokens: lines of words, each word with its place.
//!
//! The line-oriented formats share this: words are separated by spaces and tabs, lines end in LF or CRLF, a line
//! whose first word begins with `#` is a comment.

use super::{Fault, Place};

/// A word and where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token<'a> {
    /// The word itself, never empty.
    pub text: &'a str,
    /// Its first character.
    pub place: Place,
}

/// A line with at least one word that is not a comment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line<'a> {
    /// The first word.
    pub keyword: Token<'a>,
    /// The rest.
    pub arguments: Vec<Token<'a>>,
}

/// The lines of a text that say something, in order. A line that is not UTF-8 is a fault at its first bad byte, so
/// that a fault further up in the file is still the first to be reported. A byte order mark at the start is skipped
/// and does not count as a column.
pub fn lines(text: &[u8]) -> impl Iterator<Item = Result<Line<'_>, Fault>> {
    let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    text.split(|&byte| byte == b'\n')
        .enumerate()
        .filter_map(|(index, bytes)| {
            let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
            match decode(bytes, index + 1) {
                Ok(line) => split(line, index + 1).map(Ok),
                Err(fault) => Some(Err(fault)),
            }
        })
}

fn decode(bytes: &[u8], line: usize) -> Result<&str, Fault> {
    std::str::from_utf8(bytes).map_err(|error| {
        let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        let column = good.chars().count() + 1;
        Fault::new(Place { line, column }, "the text is not UTF-8 from here on")
    })
}

fn split(text: &str, line: usize) -> Option<Line<'_>> {
    let mut tokens = tokens(text, line);
    let keyword = tokens.next()?;
    if keyword.text.starts_with('#') {
        return None;
    }
    Some(Line {
        keyword,
        arguments: tokens.collect(),
    })
}

/// The words of one line. Columns are counted along the way: a line of any length is walked once.
pub(super) fn tokens(text: &str, line: usize) -> impl Iterator<Item = Token<'_>> {
    let mut column = 1;
    text.split([' ', '\t']).filter_map(move |word| {
        let place = Place { line, column };
        column += word.chars().count() + 1;
        (!word.is_empty()).then_some(Token { text: word, place })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &[u8]) -> Vec<(String, usize, usize)> {
        lines(text)
            .filter_map(Result::ok)
            .flat_map(|line| {
                let all: Vec<_> = std::iter::once(line.keyword).chain(line.arguments).collect();
                all.into_iter()
                    .map(|t| (t.text.to_owned(), t.place.line, t.place.column))
            })
            .collect()
    }

    #[test]
    fn places_count_characters_and_lines() {
        let found = words("a  b\tc\r\n\n \té é x \n#c d\n  # e\nlast".as_bytes());
        let expected = [
            ("a", 1, 1),
            ("b", 1, 4),
            ("c", 1, 6),
            ("é", 3, 3),
            ("é", 3, 5),
            ("x", 3, 7),
            ("last", 6, 1),
        ];
        assert_eq!(
            found,
            expected.map(|(word, line, column)| (word.to_owned(), line, column))
        );
    }

    #[test]
    fn a_byte_order_mark_is_no_column() {
        assert_eq!(words(b"\xEF\xBB\xBFpng"), [("png".to_owned(), 1, 1)]);
    }

    #[test]
    fn bad_utf8_has_a_place() {
        let faults: Vec<_> = lines("ok\né \u{0}".as_bytes()).collect();
        assert!(faults.iter().all(Result::is_ok));
        let fault = lines(b"ok\n\xC3\xA9 \xFF").find_map(Result::err);
        assert_eq!(fault.map(|f| f.place), Some(Place { line: 2, column: 3 }));
    }

    #[test]
    fn a_comment_does_not_start_in_mid_line() {
        assert_eq!(words(b"cull # no").len(), 3);
    }
}
