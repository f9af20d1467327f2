//! The lines that the measured program reports, on the board and on the host.

use fixel_workloads::machine::Line;

use crate::failure::Failure;

/// What one workload came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// Which workload.
    pub name: String,
    /// Instructions; 0 on the host.
    pub instructions: u32,
    /// Pixels covered.
    pub units: u32,
    /// Checksum of colour.
    pub color: u32,
    /// Checksum of depth.
    pub depth: u32,
}

impl From<&Line<'_>> for Outcome {
    fn from(line: &Line<'_>) -> Self {
        Outcome {
            name: line.name.to_owned(),
            instructions: line.instructions,
            units: line.units,
            color: line.color,
            depth: line.depth,
        }
    }
}

impl Outcome {
    /// From `name instructions units colour depth`.
    pub fn parse(line: &str) -> Option<Self> {
        let mut words = line.split_whitespace();
        let outcome = Outcome {
            name: words.next()?.to_owned(),
            instructions: words.next()?.parse().ok()?,
            units: words.next()?.parse().ok()?,
            color: u32::from_str_radix(words.next()?, 16).ok()?,
            depth: u32::from_str_radix(words.next()?, 16).ok()?,
        };
        words.next().is_none().then_some(outcome)
    }

    /// All lines of an image's output.
    pub fn parse_all(output: &str) -> Result<Vec<Self>, Failure> {
        let parse = |line| Self::parse(line).ok_or_else(|| Failure::Off(format!("the image printed: {line}")));
        output.lines().map(parse).collect()
    }

    /// The same picture of the same triangles: all but the cost.
    pub fn same_bits(&self, other: &Self) -> bool {
        let bits = |o: &Self| (o.units, o.color, o.depth);
        self.name == other.name && bits(self) == bits(other)
    }
}

/// The outcome called `name`.
pub fn find<'a>(outcomes: &'a [Outcome], name: &str) -> Option<&'a Outcome> {
    outcomes.iter().find(|outcome| outcome.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_as_they_are_written() {
        let line = Line {
            name: "W2",
            instructions: 1_000,
            units: 40,
            color: 0xdead_beef,
            depth: 1,
        };
        let read = Outcome::parse(&line.to_string());
        assert_eq!(read, Some(Outcome::from(&line)));
    }

    #[test]
    fn anything_else_that_an_image_prints_is_a_fault() {
        assert!(Outcome::parse_all("W1 1 2 3 4 5").is_err());
        assert!(Outcome::parse_all("panicked").is_err());
    }
}
