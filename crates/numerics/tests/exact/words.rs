//! Run-time words against crate `fixed`, whose formats are fixed at compile time, and against big rationals:
//! every pair of words at 4 to 6 bits, random ones at large widths.

use crate::rational::{exact, power_of_two, ratio, round_to_integer};
use edgewalk_numerics::{Format, Rounding, Word, WordError};
use fixed::types::extra::{U0, U3, U8, U16, U20, U40, U64};
use fixed::{FixedI8, FixedI16, FixedI32, FixedI64, FixedU8, FixedU16, FixedU32, FixedU64};
use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;

/// The value of a word, from its raw integer and its format alone.
fn value(word: Word) -> BigRational {
    BigRational::from_integer(word.raw().into()) / power_of_two(word.format().fraction_bits())
}

/// What `result` must be if the exact result of an operation is `raw` (in units of the last bit).
fn check(raw: &BigInt, format: Format, checked: Result<Word, WordError>, wrapping: Word) {
    let (low, high) = (BigInt::from(format.min_raw()), BigInt::from(format.max_raw()));
    if low <= *raw && *raw <= high {
        assert_eq!(checked.as_ref().map(|word| BigInt::from(word.raw())), Ok(raw.clone()));
    } else {
        assert_eq!(checked, Err(WordError::Overflow { format }));
    }
    let wrapped = BigInt::from(wrapping.raw());
    assert!(low <= wrapped && wrapped <= high, "{wrapping} leaves its format");
    assert_eq!((raw - wrapped) % (BigInt::from(1) << format.width()), BigInt::ZERO, "{wrapping} for {raw}");
}

/// Every format of 4 to 6 bits.
fn small_formats() -> impl Iterator<Item = Format> {
    (4..=6).flat_map(|width| {
        (0..=width).flat_map(move |fraction| {
            [false, true].map(|signed| Format::new(signed, width - fraction, fraction).unwrap())
        })
    })
}

/// Every word of a format.
fn words(format: Format) -> impl Iterator<Item = Word> {
    (format.min_raw()..=format.max_raw()).map(move |raw| Word::new(format, raw).unwrap())
}

#[test]
fn every_sum_difference_negative_and_product_of_small_words() {
    let mut checked = 0;
    for format in small_formats() {
        for a in words(format) {
            check(&-BigInt::from(a.raw()), format, a.checked_neg(), a.wrapping_neg());
            for b in words(format) {
                let (x, y) = (BigInt::from(a.raw()), BigInt::from(b.raw()));
                check(&(&x + &y), format, a.checked_add(b), a.wrapping_add(b).unwrap());
                check(&(&x - &y), format, a.checked_sub(b), a.wrapping_sub(b).unwrap());
                assert_eq!(value(a.full_mul(b).unwrap()), value(a) * value(b));
                checked += 1;
            }
        }
    }
    // 2 · (5 · 4^4 + 6 · 4^5 + 7 · 4^6) pairs
    assert_eq!(checked, 72192);
}

#[test]
fn every_small_word_rounded_to_every_small_format() {
    let mut checked = 0;
    for from in small_formats() {
        for to in small_formats() {
            let unit = power_of_two(to.fraction_bits());
            for word in words(from) {
                assert_eq!(exact(word.value()), value(word));
                for rounding in Rounding::ALL {
                    let raw = round_to_integer(&(value(word) * &unit), rounding);
                    let (kept, wrapped) =
                        (word.checked_round_to(to, rounding), word.wrapping_round_to(to, rounding));
                    check(&raw, to, kept, wrapped);
                    checked += 1;
                }
            }
        }
    }
    assert_eq!(checked, 2 * (5 * 16 + 6 * 32 + 7 * 64) * 36 * 7);
}

#[test]
fn mismatched_formats_are_refused_and_named() {
    let a = Word::new("Q4.4".parse().unwrap(), 3).unwrap();
    let b = Word::new("Q5.3".parse().unwrap(), 3).unwrap();
    let unsigned = Word::new("UQ4.4".parse().unwrap(), 3).unwrap();
    for refused in [
        a.wrapping_add(b),
        a.wrapping_sub(b),
        a.checked_add(b),
        a.checked_sub(b),
        a.checked_add(unsigned),
        a.full_mul(unsigned),
    ] {
        let error = refused.unwrap_err();
        assert!(matches!(error, WordError::Mismatch { .. }));
        assert!(error.to_string().contains("Q4.4"), "{error}");
    }
    let wide = Word::new(Format::signed(61, 0).unwrap(), 1).unwrap();
    assert!(matches!(wide.full_mul(wide), Err(WordError::Format(_))));
}

/// Runs every operation in a format of crate `fixed` and in the same format chosen at run time.
macro_rules! against_fixed {
    ($name:ident, $fixed:ty, $format:literal) => {
        proptest! {
            #[test]
            fn $name(a in any::<<$fixed as fixed::traits::Fixed>::Bits>(), b in any::<<$fixed as fixed::traits::Fixed>::Bits>()) {
                type Theirs = $fixed;
                let format: Format = $format.parse().unwrap();
                let (x, y) = (Theirs::from_bits(a), Theirs::from_bits(b));
                let ours = |bits| Word::new(format, i128::from(bits)).unwrap();
                let (u, v) = (ours(a), ours(b));
                let raw = |word: Word| word.raw();
                let theirs = |value: Option<Theirs>| value.map(|value| i128::from(value.to_bits()));

                prop_assert_eq!(raw(u.wrapping_add(v).unwrap()), i128::from(x.wrapping_add(y).to_bits()));
                prop_assert_eq!(raw(u.wrapping_sub(v).unwrap()), i128::from(x.wrapping_sub(y).to_bits()));
                prop_assert_eq!(raw(u.wrapping_neg()), i128::from(x.wrapping_neg().to_bits()));
                prop_assert_eq!(u.checked_add(v).ok().map(raw), theirs(x.checked_add(y)));
                prop_assert_eq!(u.checked_sub(v).ok().map(raw), theirs(x.checked_sub(y)));
                prop_assert_eq!(u.checked_neg().ok().map(raw), theirs(x.checked_neg()));
                // `fixed` drops the low bits of a product (its rounding is floor).
                if let Ok(product) = u.full_mul(v) {
                    let product = product.wrapping_round_to(format, Rounding::Floor);
                    prop_assert_eq!(raw(product), i128::from(x.wrapping_mul(y).to_bits()));
                }
                // Rounding to an integer of the same type.
                let whole = |rounding| {
                    let integer = Format::new(format.is_signed(), format.integer_bits(), 0);
                    integer.ok().and_then(|integer| u.checked_round_to(integer, rounding).ok())
                        .and_then(|word| word.checked_round_to(format, rounding).ok()).map(raw)
                };
                if format.integer_bits() > 1 {
                    prop_assert_eq!(whole(Rounding::Floor), theirs(x.checked_floor()));
                    prop_assert_eq!(whole(Rounding::Ceiling), theirs(x.checked_ceil()));
                    prop_assert_eq!(whole(Rounding::TowardZero), Some(i128::from(x.round_to_zero().to_bits())));
                    prop_assert_eq!(whole(Rounding::NearestHalfAway), theirs(x.checked_round()));
                    prop_assert_eq!(whole(Rounding::NearestHalfEven), theirs(x.checked_round_ties_even()));
                }
                prop_assert_eq!(u.value().to_f64(), x.to_num::<f64>());
            }
        }
    };
}

against_fixed!(fixed_q5_3, FixedI8<U3>, "Q5.3");
against_fixed!(fixed_uq5_3, FixedU8<U3>, "UQ5.3");
against_fixed!(fixed_uq0_8, FixedU8<U8>, "UQ0.8");
against_fixed!(fixed_q8_8, FixedI16<U8>, "Q8.8");
against_fixed!(fixed_uq16_0, FixedU16<U0>, "UQ16.0");
against_fixed!(fixed_q12_20, FixedI32<U20>, "Q12.20");
against_fixed!(fixed_uq16_16, FixedU32<U16>, "UQ16.16");
against_fixed!(fixed_q24_40, FixedI64<U40>, "Q24.40");
against_fixed!(fixed_uq0_64, FixedU64<U64>, "UQ0.64");

/// Any format, wide ones as likely as narrow ones.
fn any_format() -> impl Strategy<Value = Format> {
    (any::<bool>(), 1..=Format::MAX_WIDTH)
        .prop_flat_map(|(signed, width)| (Just(signed), Just(width), 0..=width))
        .prop_map(|(signed, width, fraction)| Format::new(signed, width - fraction, fraction).unwrap())
}

/// Any word of a format, and often one next to its limits, where overflow happens.
fn any_word(format: Format) -> impl Strategy<Value = Word> {
    let near = prop_oneof![
        3 => any::<i128>(),
        1 => (0i128..4).prop_map(move |k| format.max_raw() - k),
        1 => (0i128..4).prop_map(move |k| format.min_raw() + k),
    ];
    near.prop_map(move |raw| Word::wrapping(format, raw))
}

proptest! {
    #[test]
    fn sums_of_wide_words_are_exact_or_refused(
        (a, b) in any_format().prop_flat_map(|format| (any_word(format), any_word(format)))
    ) {
        let (x, y) = (BigInt::from(a.raw()), BigInt::from(b.raw()));
        check(&(&x + &y), a.format(), a.checked_add(b), a.wrapping_add(b).unwrap());
        check(&(&x - &y), a.format(), a.checked_sub(b), a.wrapping_sub(b).unwrap());
        check(&-x, a.format(), a.checked_neg(), a.wrapping_neg());
        prop_assert_eq!(Word::wrapping(a.format(), a.bits() as i128), a);
    }

    #[test]
    fn wide_products_are_exact(
        (a, b) in (1u32..=60, 1u32..=60, any::<bool>()).prop_flat_map(|(m, n, signed)| (
            any_word(Format::new(signed, m / 3, m - m / 3).unwrap()),
            any_word(Format::new(signed, n - n / 4, n / 4).unwrap()),
        ))
    ) {
        prop_assert_eq!(value(a.full_mul(b).unwrap()), value(a) * value(b));
    }

    #[test]
    fn wide_words_round_as_defined(
        word in any_format().prop_flat_map(any_word),
        to in any_format(),
        rounding in proptest::sample::select(Rounding::ALL.to_vec()),
    ) {
        let raw = round_to_integer(&(value(word) * power_of_two(to.fraction_bits())), rounding);
        check(&raw, to, word.checked_round_to(to, rounding), word.wrapping_round_to(to, rounding));
    }

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
