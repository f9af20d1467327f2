//! Intervals of values that the core may have.

/// The values from `low` to `high`, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The least.
    pub low: f64,
    /// The greatest.
    pub high: f64,
}

impl Interval {
    /// Every number.
    pub const ALL: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// 0 alone.
    pub const ZERO: Self = Self { low: 0.0, high: 0.0 };

    /// `value` ± `by`; all numbers if that is not a number.
    pub fn around(value: f64, by: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
        .widened(by)
    }

    /// From the least to the greatest of some values.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut range = Self {
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
        };
        for value in values {
            range.low = range.low.min(value);
            range.high = range.high.max(value);
        }
        range
    }

    /// Both ends moved apart by `by`.
    #[must_use]
    pub fn widened(self, by: f64) -> Self {
        let (low, high) = (self.low - by, self.high + by);
        if low.is_nan() || high.is_nan() {
            return Self::ALL;
        }
        Self { low, high }
    }

    /// Both ends brought into `range`.
    #[must_use]
    pub fn clamped(self, range: Self) -> Self {
        let bring = |value: f64| value.max(range.low).min(range.high);
        Self {
            low: bring(self.low),
            high: bring(self.high),
        }
    }

    /// The least interval that holds both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Whether `other` lies in this one.
    pub fn holds(&self, other: Self) -> bool {
        self.low <= other.low && other.high <= self.high
    }

    /// The sums.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            low: self.low + other.low,
            high: self.high + other.high,
        }
        .widened(0.0)
    }

    /// The products; 0 times anything is 0.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let with = |b: f64| [product(self.low, b), product(self.high, b)];
        Self::of(with(other.low).into_iter().chain(with(other.high)))
    }

    /// max(0, base)^exponent for bases up to 1 and exponents from 0: it grows with the base and falls with the exponent.
    #[must_use]
    pub fn powered(self, exponent: Self) -> Self {
        let base = self.clamped(Self { low: 0.0, high: 1.0 });
        Self {
            low: base.low.powf(exponent.high),
            high: base.high.powf(exponent.low.max(0.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn interval(low: f64, high: f64) -> Interval {
        Interval { low, high }
    }

    #[test]
    fn products_have_their_extremes_at_the_ends() {
        assert_eq!(interval(-2.0, 3.0).times(interval(-5.0, 4.0)), interval(-15.0, 12.0));
        assert_eq!(interval(2.0, 3.0).times(interval(-1.0, -0.5)), interval(-3.0, -1.0));
        assert_eq!(Interval::ALL.times(Interval::ZERO), Interval::ZERO);
        assert_eq!(Interval::ALL.plus(Interval::ALL), Interval::ALL);
    }

    #[test]
    fn powers_of_what_may_be_below_0_begin_at_0() {
        assert_eq!(interval(-0.5, 0.5).powered(interval(2.0, 3.0)), interval(0.0, 0.25));
        assert_eq!(interval(0.5, 1.5).powered(interval(1.0, 2.0)), interval(0.25, 1.0));
    }
}
