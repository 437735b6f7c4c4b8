//! Dyadic numbers are exact, and intervals contain what they promise and no more.

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

fn any_interval() -> impl Strategy<Value = Interval> {
    (any_dyadic(), any_dyadic()).prop_map(|(a, b)| Interval::new(a.min(b), a.max(b)).unwrap())
}

/// An interval and one of its members.
fn interval_and_member() -> impl Strategy<Value = (Interval, Dyadic)> {
    (any_dyadic(), any_dyadic(), any_dyadic()).prop_map(|(a, b, c)| {
        let mut sorted = [a, b, c];
        sorted.sort();
        (Interval::new(sorted[0], sorted[2]).unwrap(), sorted[1])
    })
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
    fn intervals_contain_every_result((i, x) in interval_and_member(), (j, y) in interval_and_member()) {
        let holds = |interval: Option<Interval>, value: Option<Dyadic>| match (interval, value) {
            (Some(interval), Some(value)) => interval.contains(value),
            // Where the ends fit the members do, but for members finer than 2^-126 or wider than i128.
            _ => true,
        };
        prop_assert!(holds(i.checked_add(j), x.checked_add(y)));
        prop_assert!(holds(i.checked_sub(j), x.checked_sub(y)));
        prop_assert!(holds(i.checked_mul(j), x.checked_mul(y)));
        prop_assert!((-i).contains(-x) && -(-i) == i);
        prop_assert!(i.hull(j).contains(x) && i.hull(j).contains(y));
        prop_assert!(i.hull(j).contains_interval(i) && i.hull(j).contains_interval(j));
        prop_assert!(x.abs() <= i.magnitude() && (i.contains(i.magnitude()) || i.contains(-i.magnitude())));
        for rounding in Rounding::ALL {
            prop_assert!(i.round(3, rounding).contains(x.round(3, rounding)));
        }
    }

    #[test]
    fn interval_ends_are_reached(i in any_interval(), j in any_interval()) {
        if let Some(product) = i.checked_mul(j) {
            let corners: Vec<_> = [(i.low(), j.low()), (i.low(), j.high()), (i.high(), j.low()), (i.high(), j.high())]
                .into_iter().map(|(a, b)| a.checked_mul(b).unwrap()).collect();
            prop_assert!(corners.contains(&product.low()) && corners.contains(&product.high()));
        }
        if let Some(sum) = i.checked_add(j) {
            prop_assert_eq!(Some(sum.low()), i.low().checked_add(j.low()));
            prop_assert_eq!(Some(sum.high()), i.high().checked_add(j.high()));
        }
        prop_assert_eq!(Interval::new(i.high(), i.low()).is_some(), i.low() == i.high());
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
