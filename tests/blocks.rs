//! Block floating point against exact arithmetic, both words, at any scale.

mod exact;

use exact::{Exact, Number, check_near, cross, dot, exacts, gathered, largest, number, units, word};
use fixel::num::{Scaled, Word};
use proptest::prelude::*;

/// All errors are in units of 2^-BITS of the largest number of the result, unless it says otherwise.
///
/// One rounding to nearest is at most half a place of a mantissa of BITS − 1 bits: a unit. A term of a sum, or a number of
/// another scale, is first cut at 2^-BITS of the last place: a unit of the larger operand, times 2^-BITS.
const ROUNDED: i64 = 1;
/// A quotient is cut to BITS bits at least and rounded then (`over`).
const QUOTIENT: i64 = 2;
/// Each component of a unit vector, in units of 2^-BITS (`unit`).
const UNIT: i64 = 4;
fn check_blocks<T: Word>(a: [Number; 3], b: [Number; 3], c: Number) -> Result<(), TestCaseError> {
    let zero = Exact::zero();
    let parts = a.map(word::<T>).map(Exact::of);
    let (a, b, c) = (gathered::<T, 3>(a), gathered::<T, 3>(b), word::<T>(c));
    let (xa, xb, xc) = (exacts(a), exacts(b), Exact::of(c));
    let cut = |of: &Exact| &(of * &units::<T>(1)) * &units::<T>(2);
    check_near(a, &parts, ROUNDED, &cut(&largest(&parts)))?;
    let slack = cut(&largest(xa.iter().chain(&xb)));
    check_near(a.plus(b), &[0, 1, 2].map(|i| &xa[i] + &xb[i]), ROUNDED, &slack)?;
    check_near(a.minus(b), &[0, 1, 2].map(|i| &xa[i] - &xb[i]), ROUNDED, &slack)?;
    check_near(a.times(c), &[0, 1, 2].map(|i| &xa[i] * &xc), ROUNDED, &zero)?;
    check_near(a.cross(b), &cross(&xa, &xb), ROUNDED, &zero)?;
    check_near(a.dot(b), &[dot(&xa, &xb)], ROUNDED, &zero)?;
    prop_assert_eq!(a.over(c).is_none(), c.is_zero());
    if let Some(quotient) = a.over(c) {
        // Multiplied back: quotient·c is a, within units of the largest.
        let back = exacts(quotient).map(|q| &q * &xc);
        let bound = &units::<T>(QUOTIENT) * &largest(&xa);
        prop_assert!(
            (0..3).all(|i| (&back[i] - &xa[i]).abs() <= bound),
            "{:?} over {:?} is {:?}",
            a,
            c,
            quotient
        );
    }
    prop_assert_eq!(a.unit().is_none(), a.is_zero());
    for (i, u) in a.unit().into_iter().flatten().enumerate() {
        // u = x/|a| within e: (|u| − e)²·a² ≤ x² ≤ (|u| + e)²·a², and the same sign.
        let (u, square) = (Exact::new(u.to_i64(), -(T::BITS as i32)), dot(&xa, &xa));
        let (x, e) = (&xa[i] * &xa[i], units::<T>(UNIT));
        let (low, high) = ((&u.clone().abs() - &e).max(Exact::zero()), &u.clone().abs() + &e);
        prop_assert!(
            &(&low * &low) * &square <= x && x <= &(&high * &high) * &square,
            "{} of {:?}",
            u.to_f64(),
            a
        );
        prop_assert!(&u * &xa[i] >= zero || u.abs() <= e);
    }
    Ok(())
}

/// The integer below the number times 2^bits, or the end of the range.
fn check_fixed<T: Word>(number: Scaled<T>, bits: u32) -> Result<(), TestCaseError> {
    let (found, truth) = (number.to_fixed(bits), &Exact::of(number) * &Exact::power(bits as i32));
    let from_below = found == i64::MIN || Exact::new(found, 0) <= truth;
    prop_assert!(from_below && (found == i64::MAX || truth < &Exact::new(found, 0) + &Exact::new(1, 0)));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn blocks(a in prop::array::uniform3(number()), b in prop::array::uniform3(number()), c in number(), bits in 0..64u32) {
        check_blocks::<i32>(a, b, c)?;
        check_blocks::<i64>(a, b, c)?;
        check_fixed(word::<i32>(c), bits)?;
        check_fixed(word::<i64>(c), bits)?;
    }
}
