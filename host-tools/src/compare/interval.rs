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
        Self::of([self.low, self.high, other.low, other.high])
    }

    /// Whether `other` lies in this one.
    pub fn holds(&self, other: Self) -> bool {
        self.low <= other.low && other.high <= self.high
    }
}
