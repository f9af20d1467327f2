//! What every block of the grammar is made of: braces, brackets, numbers, and names of fields.

use super::lex::Lexer;
use crate::scene::lex::Token;
use crate::scene::{Fault, Place, arguments};

/// A number or a few, each with its place.
#[derive(Debug, Clone, Copy)]
pub struct Given<const N: usize> {
    /// The numbers, finite.
    pub values: [f64; N],
    /// Where they stand.
    pub places: [Place; N],
}

/// What is left to read.
#[derive(Debug)]
pub struct Parser<'a>(Lexer<'a>);

impl<'a> Parser<'a> {
    /// Starts at the beginning of `text`.
    pub fn new(text: &'a [u8]) -> Self {
        Self(Lexer::new(text))
    }

    /// The next token; none at the end.
    pub fn next(&mut self) -> Result<Option<Token<'a>>, Fault> {
        self.0.next()
    }

    /// The next token, which must be there; `expected` says what.
    fn need(&mut self, expected: &str) -> Result<Token<'a>, Fault> {
        let ends = |place| Fault::new(place, format!("unexpected end of input, expected {expected}"));
        self.0.next()?.ok_or_else(|| ends(self.0.end()))
    }

    fn expect(&mut self, punctuation: &str) -> Result<(), Fault> {
        let expected = format!("'{punctuation}'");
        let token = self.need(&expected)?;
        if token.text == punctuation {
            return Ok(());
        }
        Err(unexpected(token, &expected))
    }

    /// The block in braces after a name: hands the names in it to `field`, which reads what follows one and tells
    /// whether it knows it. The place of the closing brace.
    pub fn block(
        &mut self,
        kind: &str,
        name: &str,
        mut field: impl FnMut(&mut Self, Token<'a>) -> Result<bool, Fault>,
    ) -> Result<Place, Fault> {
        self.expect("{")?;
        loop {
            let token = self.need("'}'")?;
            match token.text {
                "}" => return Ok(token.place),
                "{" | "[" | "]" | "," => return Err(unexpected(token, &format!("a {kind} or '}}'"))),
                _ if field(self, token)? => {}
                _ => {
                    let message = format!("unknown {kind} {} in {name}", quoted(token));
                    return Err(Fault::new(token.place, message));
                }
            }
        }
    }

    /// The list in brackets after a name: calls `entry` with the first token of each. Entries are parted by commas, and
    /// there may be one behind the last. The place of the closing bracket.
    pub fn list(&mut self, mut entry: impl FnMut(&mut Self, Token<'a>) -> Result<(), Fault>) -> Result<Place, Fault> {
        self.expect("[")?;
        loop {
            let token = self.need("']'")?;
            if token.text == "]" {
                return Ok(token.place);
            }
            entry(self, token)?;
            let token = self.need("']'")?;
            match token.text {
                "," => {}
                "]" => return Ok(token.place),
                _ => return Err(unexpected(token, "',' or ']'")),
            }
        }
    }

    /// The next `N` numbers.
    pub fn numbers<const N: usize>(&mut self) -> Result<Given<N>, Fault> {
        let place = Place { line: 1, column: 1 };
        let mut given = Given {
            values: [0.0; N],
            places: [place; N],
        };
        for (value, place) in given.values.iter_mut().zip(&mut given.places) {
            let token = self.need("a number")?;
            (*value, *place) = (number(token)?, token.place);
        }
        Ok(given)
    }

    /// The three numbers of which `first` is the first token.
    pub fn triple(&mut self, first: Token<'a>) -> Result<[f64; 3], Fault> {
        let x = number(first)?;
        let [y, z] = self.numbers()?.values;
        Ok([x, y, z])
    }
}

/// A token as a finite number.
pub fn number(token: Token<'_>) -> Result<f64, Fault> {
    let value = arguments::decimal(token.text).ok_or_else(|| unexpected(token, "a number"))?;
    if value.is_finite() {
        return Ok(value);
    }
    let message = format!("number too large, found {}", quoted(token));
    Err(Fault::new(token.place, message))
}

/// A token where something else must be.
pub fn unexpected(token: Token<'_>, expected: &str) -> Fault {
    Fault::new(token.place, format!("expected {expected}, found {}", quoted(token)))
}

/// A token for a message: one line, printable, and short.
pub fn quoted(token: Token<'_>) -> String {
    const LONGEST: usize = 40;
    let shown: String = token.text.chars().take(LONGEST).collect();
    let more = if shown.len() < token.text.len() { "..." } else { "" };
    format!("'{}'{more}", shown.escape_debug())
}
