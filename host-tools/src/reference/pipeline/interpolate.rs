//! Interpolation of outputs (06.1 to 06.4, chapter 08).

use super::program::Values;
use super::state::Interpolation;

/// The sum of weight times value, key by key, of the keys that all have.
pub fn mix<const N: usize>(values: [&Values; N], weights: [f64; N]) -> Values {
    let Some((first, others)) = values.split_first() else {
        return Values::new();
    };
    let shared = first
        .iter()
        .filter(|(key, _)| others.iter().all(|other| other.contains_key(*key)));
    shared
        .map(|(&key, _)| (key, sum(values.map(|v| &v[key]), weights)))
        .collect()
}

fn sum<const N: usize>(vectors: [&Vec<f64>; N], weights: [f64; N]) -> Vec<f64> {
    let length = vectors.iter().map(|v| v.len()).min().unwrap_or(0);
    let component = |i| vectors.iter().zip(weights).map(|(v, weight)| weight * v[i]).sum();
    (0..length).map(component).collect()
}

/// The weights that outputs get where the window's weights are `weights`; `inverse_w` is 1/w of each vertex.
pub fn weights<const N: usize>(weights: [f64; N], inverse_w: [f64; N], interpolation: Interpolation) -> [f64; N] {
    if interpolation == Interpolation::Linear {
        return weights;
    }
    let parts: [f64; N] = std::array::from_fn(|i| weights[i] * inverse_w[i]);
    let whole: f64 = parts.iter().sum();
    parts.map(|part| part / whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn i06_1_keys_that_all_have_zero_included() {
        let a = Values::from([("only a", vec![9.0]), ("both", vec![0.0])]);
        let b = Values::from([("both", vec![1.0])]);
        assert_eq!(mix([&a, &b], [0.75, 0.25]), Values::from([("both", vec![0.25])]));
        assert_eq!(mix([&b, &a], [0.75, 0.25]), Values::from([("both", vec![0.75])]));
    }

    #[test]
    fn i06_2_linear_in_eleven_steps() {
        let ends = [0.0, 10.0].map(|v| Values::from([("v", vec![v])]));
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let value = mix(ends.each_ref(), [1.0 - t, t]);
            assert!((value["v"][0] - f64::from(i)).abs() < 1e-12);
        }
    }

    #[test]
    fn i08_1_weights_of_a_triangle() {
        let third = 1.0 / 3.0;
        let found = weights([third; 3], [1.0, 0.5, 0.25], Interpolation::PerspectiveCorrected);
        for (weight, expected) in found.iter().zip([4.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0]) {
            assert!((weight - expected).abs() < 1e-12);
        }
        assert_eq!(weights([third; 3], [1.0, 0.5, 0.25], Interpolation::Linear), [third; 3]);
    }

    #[test]
    fn i08_2_weights_of_a_line() {
        let found = weights([0.5, 0.5], [1.0, 1.0 / 3.0], Interpolation::PerspectiveCorrected);
        assert!((found[0] - 0.75).abs() < 1e-12 && (found[1] - 0.25).abs() < 1e-12);
    }

    #[test]
    fn i08_4_the_same_where_all_w_are_equal() {
        let window = [0.2, 0.3, 0.5];
        let found = weights(window, [0.7; 3], Interpolation::PerspectiveCorrected);
        assert!(found.iter().zip(window).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}
