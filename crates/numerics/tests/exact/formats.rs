//! Exact numbers and roundings against crate `fixed`, whose formats are fixed at compile time, and against
//! big rationals.

use crate::rational::{ratio, round_to_integer};
use edgewalk_numerics::{Dyadic, Format, Rounding};
use fixed::types::extra::{U0, U3, U8, U16, U20, U40, U64};
use fixed::{FixedI8, FixedI16, FixedI32, FixedI64, FixedU8, FixedU16, FixedU32, FixedU64};
use num_bigint::BigInt;
use proptest::prelude::*;

/// Runs every operation on numbers of a format of crate `fixed`, and on the same numbers here.
macro_rules! against_fixed {
    ($name:ident, $fixed:ty, $signed:literal, $integer:literal, $fraction:literal) => {
        proptest! {
            #[test]
            fn $name(a in any::<<$fixed as fixed::traits::Fixed>::Bits>(), b in any::<<$fixed as fixed::traits::Fixed>::Bits>()) {
                type Theirs = $fixed;
                let format = Format::new($signed, $integer, $fraction).unwrap();
                let range = format.min_raw()..=format.max_raw();
                prop_assert_eq!(&range, &(Theirs::MIN.to_bits().into()..=Theirs::MAX.to_bits().into()));

                let (x, y) = (Theirs::from_bits(a), Theirs::from_bits(b));
                let [u, v] = [a, b].map(|raw| Dyadic::new(raw.into(), $fraction).unwrap());
                let ours = |exact: Option<Dyadic>| {
                    exact.and_then(|exact| exact.scaled($fraction)).filter(|raw| range.contains(raw))
                };
                let theirs = |value: Option<Theirs>| value.map(|value| i128::from(value.to_bits()));
                prop_assert_eq!(ours(u.checked_add(v)), theirs(x.checked_add(y)));
                prop_assert_eq!(ours(u.checked_sub(v)), theirs(x.checked_sub(y)));
                prop_assert_eq!(ours(Some(-u)), theirs(x.checked_neg()));
                // A product rounds as `fixed` does it, by floor; one of two numbers of 64 bits may have no
                // room here.
                if let Some(product) = u.checked_mul(v) {
                    prop_assert_eq!(ours(Some(product.round($fraction, Rounding::Floor))), theirs(x.checked_mul(y)));
                }
                let whole = |rounding| ours(Some(u.round(0, rounding)));
                prop_assert_eq!(whole(Rounding::Floor), theirs(x.checked_floor()));
                prop_assert_eq!(whole(Rounding::Ceiling), theirs(x.checked_ceil()));
                prop_assert_eq!(whole(Rounding::TowardZero), Some(i128::from(x.round_to_zero().to_bits())));
                prop_assert_eq!(whole(Rounding::NearestHalfAway), theirs(x.checked_round()));
                prop_assert_eq!(whole(Rounding::NearestHalfEven), theirs(x.checked_round_ties_even()));
                prop_assert_eq!(u.to_f64(), x.to_num::<f64>());
            }
        }
    };
}

against_fixed!(fixed_q5_3, FixedI8<U3>, true, 5, 3);
against_fixed!(fixed_uq5_3, FixedU8<U3>, false, 5, 3);
against_fixed!(fixed_uq0_8, FixedU8<U8>, false, 0, 8);
against_fixed!(fixed_q8_8, FixedI16<U8>, true, 8, 8);
against_fixed!(fixed_uq16_0, FixedU16<U0>, false, 16, 0);
against_fixed!(fixed_q12_20, FixedI32<U20>, true, 12, 20);
against_fixed!(fixed_uq16_16, FixedU32<U16>, false, 16, 16);
against_fixed!(fixed_q24_40, FixedI64<U40>, true, 24, 40);
against_fixed!(fixed_uq0_64, FixedU64<U64>, false, 0, 64);

proptest! {
    #[test]
    fn division_rounds_as_defined(
        numerator in any::<i128>(),
        denominator in prop_oneof![any::<i128>(), -20i128..20],
        rounding in proptest::sample::select(Rounding::ALL.to_vec()),
    ) {
        prop_assume!(denominator != 0 && numerator != i128::MIN && denominator != i128::MIN);
        let expected = round_to_integer(&ratio(numerator, denominator), rounding);
        prop_assert_eq!(rounding.divide(numerator, denominator).map(BigInt::from), Some(expected));
    }
}
