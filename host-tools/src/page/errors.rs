//! How large the differences are, by class.

use std::collections::HashMap;

use crate::compare::Class;
use crate::picture::Picture;

/// Pixels of one class.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OfClass {
    /// How many.
    pub pixels: u64,
    /// The largest error among them, in levels of 255.
    pub largest: u8,
}

/// Pixels by error and class. A pixel's error is the largest difference of its four bytes.
#[derive(Debug)]
pub struct Errors {
    counts: HashMap<(Class, u8), u64>,
    pixels: u64,
}

impl Errors {
    /// Of two pictures of one size.
    pub fn new(fixed: &Picture, reference: &Picture, classes: &[Class]) -> Self {
        let mut counts = HashMap::new();
        for ((a, b), class) in fixed.pixels.iter().zip(&reference.pixels).zip(classes) {
            let error = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            *counts.entry((*class, error)).or_insert(0) += 1;
        }
        Errors {
            counts,
            pixels: classes.len() as u64,
        }
    }

    /// All pixels.
    pub fn pixels(&self) -> u64 {
        self.pixels
    }

    /// Pixels of a class with an error in a range.
    pub fn count(&self, class: Class, errors: std::ops::RangeInclusive<u8>) -> u64 {
        errors.filter_map(|error| self.counts.get(&(class, error))).sum()
    }

    /// Pixels with an error of at most `most`.
    pub fn at_most(&self, most: u8) -> u64 {
        let within = self.counts.iter().filter(|((_, error), _)| *error <= most);
        within.map(|(_, count)| count).sum()
    }

    /// All of a class.
    pub fn of(&self, class: Class) -> OfClass {
        let of_class = self.counts.keys().filter(|(c, _)| *c == class);
        OfClass {
            pixels: self.count(class, 0..=u8::MAX),
            largest: of_class.map(|(_, error)| *error).max().unwrap_or(0),
        }
    }

    /// The largest error of all.
    pub fn largest(&self) -> u8 {
        self.counts.keys().map(|(_, error)| *error).max().unwrap_or(0)
    }

    /// A count as a share of all pixels.
    pub fn percent(&self, count: u64) -> f64 {
        100.0 * count as f64 / self.pixels.max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_counted_by_class() {
        let picture = |values: [u8; 4]| Picture::new(4, 1, values.map(|v| [v, 0, 0, 255]).to_vec());
        let classes = [Class::Equal, Class::Colour, Class::Colour, Class::Edge];
        let errors = Errors::new(&picture([1, 2, 3, 200]), &picture([1, 3, 5, 100]), &classes);
        assert_eq!(errors.of(Class::Colour), OfClass { pixels: 2, largest: 2 });
        assert_eq!(errors.of(Class::Pole), OfClass::default());
        assert_eq!([0, 1, 2, 99, 100].map(|e| errors.at_most(e)), [1, 2, 3, 3, 4]);
        assert_eq!((errors.largest(), errors.pixels()), (100, 4));
        assert_eq!(errors.percent(1), 25.0);
    }
}
