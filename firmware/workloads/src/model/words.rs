//! Numbers from 16-bit words.

use fixel::num::Block;

/// The words that are left. Reading past their end gives `None`.
#[derive(Clone)]
pub struct Words<'a>(&'a [u16]);

impl<'a> Words<'a> {
    pub fn new(words: &'a [u16]) -> Self {
        Words(words)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn take(&mut self, count: usize) -> Option<&'a [u16]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    pub fn word(&mut self) -> Option<u16> {
        self.take(1)?.first().copied()
    }

    /// Two words, the lower first.
    pub fn number(&mut self) -> Option<i32> {
        let (low, high) = (self.word()?, self.word()?);
        Some((high as i32) << 16 | low as i32)
    }

    pub fn numbers<const N: usize>(&mut self) -> Option<[i32; N]> {
        let mut numbers = [0; N];
        for number in &mut numbers {
            *number = self.number()?;
        }
        Some(numbers)
    }

    /// Mantissas, then the exponent.
    pub fn block<const N: usize>(&mut self) -> Option<Block<i32, N>> {
        let mantissas = self.numbers()?;
        Some(Block::new(mantissas, self.number()?))
    }

    pub fn triples(&mut self, count: usize) -> Option<&'a [[u16; 3]]> {
        let (triples, _) = self.take(count.checked_mul(3)?)?.as_chunks();
        Some(triples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_read_in_order_and_not_past_their_end() {
        let mut words = Words::new(&[7, 0xfffe, 0xffff, 1, 2, 3, 4, 0, 3, 0]);
        assert_eq!(words.word(), Some(7));
        assert_eq!(words.number(), Some(-2));
        assert_eq!(words.triples(1), Some(&[[1, 2, 3]][..]));
        assert_eq!(words.block(), Some(Block::from_integers([32])));
        assert!(words.is_empty() && words.word().is_none() && words.triples(1).is_none());
    }
}
