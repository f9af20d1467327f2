//! The arguments of one command, read from left to right and checked one by one, so that the first fault in the
//! line is the one reported.

use super::lex::{Line, Token};
use super::names;
use super::{Fault, Place};

/// What is left to read of a line.
#[derive(Debug)]
pub struct Arguments<'a> {
    keyword: Token<'a>,
    rest: std::vec::IntoIter<Token<'a>>,
    place: Place,
}

impl<'a> Arguments<'a> {
    /// The arguments of a line that must have exactly `count` of them.
    pub fn new(line: Line<'a>, count: usize) -> Result<Self, Fault> {
        let Line { keyword, arguments } = line;
        let found = arguments.len();
        if found != count {
            let few_or_many = if found < count { "few" } else { "many" };
            let plural = if count == 1 { "" } else { "s" };
            return Err(Fault::new(
                keyword.place,
                format!(
                    "too {few_or_many} arguments: {} takes {count} argument{plural}, found {found}",
                    keyword.text
                ),
            ));
        }
        Ok(Self {
            place: keyword.place,
            keyword,
            rest: arguments.into_iter(),
        })
    }

    /// The keyword's place.
    pub fn keyword(&self) -> Place {
        self.keyword.place
    }

    /// The place of the argument read last; the keyword's before the first.
    pub fn last(&self) -> Place {
        self.place
    }

    /// The next word as it stands.
    pub fn word(&mut self) -> Result<Token<'a>, Fault> {
        let token = self.rest.next().ok_or_else(|| {
            Fault::new(
                self.keyword.place,
                format!("too few arguments to {}", self.keyword.text),
            )
        })?;
        self.place = token.place;
        Ok(token)
    }

    /// The next argument as a finite decimal number.
    pub fn number(&mut self) -> Result<f64, Fault> {
        let token = self.word()?;
        let value = decimal(token.text).ok_or_else(|| fault(token, "expected a number"))?;
        if value.is_finite() {
            Ok(value)
        } else {
            Err(fault(token, "too large a number"))
        }
    }

    /// The next `N` arguments as finite decimal numbers.
    pub fn numbers<const N: usize>(&mut self) -> Result<[f64; N], Fault> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.number()?;
        }
        Ok(values)
    }

    /// The next sixteen numbers as a matrix, row by row.
    pub fn matrix(&mut self) -> Result<[[f64; 4]; 4], Fault> {
        Ok([self.numbers()?, self.numbers()?, self.numbers()?, self.numbers()?])
    }

    /// The next argument as an integer from `low` to `high`; `what` names it in the message.
    pub fn integer(&mut self, what: &str, low: u32, high: u32) -> Result<u32, Fault> {
        let token = self.word()?;
        let value = integer(token)?;
        u32::try_from(value)
            .ok()
            .filter(|value| (low..=high).contains(value))
            .ok_or_else(|| {
                let must = format!("the {what} must be from {low} to {high}");
                fault(token, &must)
            })
    }

    /// The next argument as the index of one of the `made` vertices, resolved to a position from 0.
    pub fn index(&mut self, made: usize) -> Result<usize, Fault> {
        let token = self.word()?;
        let value = integer(token)?;
        if value == 0 {
            return Err(fault(token, "vertex indices start at 1 (or -1)"));
        }
        let distance = usize::try_from(value.unsigned_abs()).unwrap_or(usize::MAX);
        let position = if value > 0 {
            Some(distance - 1).filter(|&position| position < made)
        } else {
            made.checked_sub(distance)
        };
        position.ok_or_else(|| {
            let so_far = format!("no such vertex: {made} made so far");
            fault(token, &so_far)
        })
    }

    /// The next `N` arguments as vertex indices.
    pub fn indices<const N: usize>(&mut self, made: usize) -> Result<[usize; N], Fault> {
        let mut positions = [0; N];
        for position in &mut positions {
            *position = self.index(made)?;
        }
        Ok(positions)
    }

    /// The next argument as a file name that stays in its folder, without detours (`a/../b` is `b`).
    pub fn file_name(&mut self) -> Result<String, Fault> {
        let token = self.word()?;
        names::inside(token.text).map_err(|message| fault(token, message))
    }
}

/// A decimal number, with a point and an exponent if it likes; infinite if it is too large.
pub fn decimal(text: &str) -> Option<f64> {
    // Rust's own parser takes the grammar's numbers and besides `inf`, `infinity` and `nan`.
    let allowed = |byte: u8| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E');
    text.bytes().all(allowed).then(|| text.parse().ok()).flatten()
}

/// An integer of any size; one beyond 64 bits is cut to the largest, which every range refuses just the same.
fn integer(token: Token<'_>) -> Result<i64, Fault> {
    let digits = token.text.strip_prefix(['+', '-']).unwrap_or(token.text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(fault(token, "expected an integer"));
    }
    let largest = if token.text.starts_with('-') {
        i64::MIN
    } else {
        i64::MAX
    };
    Ok(token.text.parse().unwrap_or(largest))
}

fn fault(token: Token<'_>, message: &str) -> Fault {
    Fault::new(token.place, format!("{message}, found {}", quoted(token.text)))
}

/// A word for a message: one line, printable, and not the whole file when the file has no spaces.
pub fn quoted(word: &str) -> String {
    const LONGEST: usize = 40;
    let shown: String = word.chars().take(LONGEST).collect();
    let more = if shown.len() < word.len() { "..." } else { "" };
    format!("`{}`{more}", shown.escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::lex;

    fn read<T>(text: &str, read: impl Fn(&mut Arguments<'_>) -> Result<T, Fault>) -> Result<T, (usize, String)> {
        let line = lex::lines(text.as_bytes()).next().expect("one line");
        let line = line.expect("UTF-8");
        let count = line.arguments.len();
        Arguments::new(line, count)
            .and_then(|mut arguments| read(&mut arguments))
            .map_err(|fault| (fault.place.column, fault.message))
    }

    #[test]
    fn the_grammars_numbers_and_no_others() {
        for (text, value) in [
            ("1", 1.0),
            ("+1", 1.0),
            (".5", 0.5),
            ("-.5", -0.5),
            ("1.", 1.0),
            ("-1.e-2", -0.01),
            ("6.123E-17", 6.123e-17),
            ("1e-999", 0.0),
        ] {
            let line = format!("k {text}");
            assert_eq!(read(&line, |a| a.number()), Ok(value), "{text}");
        }
        for text in [
            "nan", "inf", "-inf", "infinity", "NaN", "0x10", "1_000", "1e", "e5", ".", "-", "+-1", "1,5", "1f",
            "1e999", "-1e999", "١", "--1", "1e5.5",
        ] {
            let line = format!("k {text}");
            let column = read(&line, |a| a.number()).map_err(|(column, _)| column);
            assert_eq!(column, Err(3), "{text}");
        }
    }

    #[test]
    fn integers_are_digits() {
        for (text, value) in [("3", 3), ("+3", 3), ("003", 3)] {
            let line = format!("k {text}");
            assert_eq!(read(&line, |a| a.integer("level", 1, 8)), Ok(value));
        }
        for text in ["0", "9", "-3", "3.0", "3e0", "x", "", "99999999999999999999", "+", "-"] {
            let line = format!("k {text} 1");
            assert!(read(&line, |a| a.integer("level", 2, 8)).is_err(), "{text}");
        }
    }

    #[test]
    fn indices_count_from_both_ends() {
        let at = |text: &str, made| read(&format!("k {text}"), |a| a.index(made)).ok();
        assert_eq!(at("1", 3), Some(0));
        assert_eq!(at("3", 3), Some(2));
        assert_eq!(at("-1", 3), Some(2));
        assert_eq!(at("-3", 3), Some(0));
        for beyond in [
            "0",
            "-0",
            "4",
            "-4",
            "1.0",
            "99999999999999999999",
            "-99999999999999999999",
        ] {
            assert_eq!(at(beyond, 3), None, "{beyond}");
        }
        assert_eq!(at("1", 0), None);
        assert_eq!(at("-1", 0), None);
    }

    #[test]
    fn long_and_odd_words_are_quoted_short() {
        let fault = read(&format!("k {}\u{7}", "x".repeat(9000)), |a| a.number());
        assert!(fault.is_err_and(|(_, message)| message.len() < 100));
        assert_eq!(quoted("a\u{7}"), "`a\\u{7}`");
    }
}
