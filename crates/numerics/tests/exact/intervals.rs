//! Dyadic numbers are exact, and intervals end at their least and greatest number.

use crate::rational::{exact, power_of_two, round_to_integer};
use edgewalk_numerics::{Dyadic, Interval, Rounding};
use num_rational::BigRational;
use proptest::prelude::*;

fn any_dyadic() -> impl Strategy<Value = Dyadic> {
    let numerator =
        prop_oneof![3 => -1000i128..1000, 1 => any::<i64>().prop_map(i128::from), 1 => any::<i128>()];
    (numerator, prop_oneof![0u32..8, 0..=Dyadic::MAX_FRACTION_BITS])
        .prop_filter_map("-2^127 is no numerator", |(numerator, bits)| Dyadic::new(numerator, bits))
}

proptest! {
    #[test]
    fn dyadic_arithmetic_is_exact(a in any_dyadic(), b in any_dyadic(), bits in 0u32..130) {
        let same = |ours: Option<Dyadic>, theirs: BigRational| ours.is_none_or(|ours| exact(ours) == theirs);
        prop_assert!(same(a.checked_add(b), exact(a) + exact(b)));
        prop_assert!(same(a.checked_sub(b), exact(a) - exact(b)));
        prop_assert!(same(a.checked_mul(b), exact(a) * exact(b)));
        prop_assert_eq!(exact(-a), -exact(a));
        prop_assert_eq!(a.abs(), a.max(-a));
        prop_assert_eq!(a.cmp(&b), exact(a).cmp(&exact(b)));
        prop_assert_eq!(a == b, exact(a) == exact(b));
        for rounding in Rounding::ALL {
            let integer = round_to_integer(&(exact(a) * power_of_two(bits)), rounding);
            let expected = BigRational::from_integer(integer) / power_of_two(bits);
            prop_assert_eq!(exact(a.round(bits, rounding)), expected);
        }
    }

    #[test]
    fn small_dyadics_never_overflow(a in -1000i128..1000, b in -1000i128..1000, m in 0u32..40, n in 0u32..40) {
        let (a, b) = (Dyadic::new(a, m).unwrap(), Dyadic::new(b, n).unwrap());
        prop_assert!(a.checked_add(b).is_some() && a.checked_sub(b).is_some() && a.checked_mul(b).is_some());
        prop_assert_eq!(a.to_f64() + b.to_f64(), a.checked_add(b).unwrap().to_f64());
    }

    #[test]
    fn a_hull_ends_at_the_least_and_the_greatest(a in any_dyadic(), b in any_dyadic(), c in any_dyadic()) {
        let [one, two, three] = [a, b, c].map(Interval::point);
        let mut sorted = [a, b, c];
        sorted.sort();
        for hull in [one.hull(two).hull(three), one.hull(two.hull(three))] {
            prop_assert_eq!([hull.low(), hull.high()], [sorted[0], sorted[2]]);
            prop_assert_eq!(Some(hull.magnitude()), sorted.map(Dyadic::abs).into_iter().max());
        }
    }
}

#[test]
fn the_finest_and_the_widest_are_refused_not_approximated() {
    assert!(Dyadic::new(1, 127).is_none());
    assert_eq!(Dyadic::new(2, 127), Dyadic::new(1, 126));
    assert_eq!(Dyadic::new(0, u32::MAX), Some(Dyadic::ZERO));
    let widest = Dyadic::new(i128::MAX, 0).unwrap();
    assert!(widest.checked_add(Dyadic::ONE).is_none());
    assert!(Dyadic::new(i128::MIN, 0).is_none());
    assert_eq!(Dyadic::new(i128::MIN, 1), Dyadic::new(i128::MIN / 2, 0));
    assert!(Dyadic::new(1, 100).unwrap().checked_mul(Dyadic::new(1, 100).unwrap()).is_none());
    assert!(widest > Dyadic::new(i128::MAX, 126).unwrap());
}
