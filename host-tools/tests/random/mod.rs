//! Random scenes that can be drawn again: a generator of our own, and which seeds there are.

use std::ops::Range;
use std::sync::LazyLock;

/// A small generator (xorshift64*), so that scenes stay the same whatever crates do.
pub struct Random(u64);

impl Random {
    /// Of a kind of scenes, each with its own numbers.
    pub fn new(kind: &str, seed: u64) -> Self {
        let name = kind.bytes().fold(14_695_981_039_346_656_037, |h: u64, b| {
            (h ^ u64::from(b)).wrapping_mul(1_099_511_628_211)
        });
        Random(name ^ seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// In 0…1, without 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn one_in(&mut self, n: u32) -> bool {
        self.unit() * f64::from(n) < 1.0
    }
}

/// The seeds of a kind's scenes: the first `count`, or those of `FIXEL_SEEDS=FIRST..END`; and of the `former` ones, kind and seed,
/// those of the kind.
pub fn seeds(kind: &str, count: u64, former: &[(&str, u64)]) -> Vec<u64> {
    static ASKED: LazyLock<Option<Range<u64>>> = LazyLock::new(|| {
        let asked = std::env::var("FIXEL_SEEDS").ok()?;
        let range = asked.split_once("..").map(|(first, end)| (first.parse(), end.parse()));
        let Some((Ok(first), Ok(end))) = range else {
            panic!("FIXEL_SEEDS={asked}: expected FIRST..END");
        };
        Some(first..end)
    });
    let former = former.iter().filter(|(of, _)| *of == kind).map(|(_, seed)| *seed);
    ASKED.clone().unwrap_or(0..count).chain(former).collect()
}

/// Fails where some of so many scenes have differences that nothing explains, and names the first.
pub fn none_unexplained(bad: &[String], scenes: usize) {
    let some = bad.get(..5).unwrap_or(bad).join("\n");
    assert!(
        bad.is_empty(),
        "unexplained in {} of {scenes} scenes:\n{some}",
        bad.len()
    );
}
