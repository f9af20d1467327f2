//! Numbers in sentences.

use std::fmt::Display;

/// So many things: `1 pixel`, `2 pixels`.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, thing: &str) -> String {
    let ending = if count == N::from(1) { "" } else { "s" };
    format!("{count} {thing}{ending}")
}

#[cfg(test)]
mod tests {
    use super::counted;

    #[test]
    fn only_one_is_singular() {
        let pixels = [0_u64, 1, 2, 100].map(|count| counted(count, "pixel"));
        assert_eq!(pixels, ["0 pixels", "1 pixel", "2 pixels", "100 pixels"]);
        assert_eq!(counted(0.5, "instruction"), "0.5 instructions");
    }
}
