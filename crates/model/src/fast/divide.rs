//! Exact division without dividing: a quotient guessed with a reciprocal in f64, set right by its integer remainder.
//!
//! The guess of n·2^s/d is within 7/8 of it as long as it is at most 2^50: n as f64, the reciprocal and the product are
//! each off by at most 2^-53 of their value, 3·2^-53·2^50 = 3/8 in all, and rounding to an integer adds 1/2. The
//! remainder n·2^s − guess·d then lies below d in magnitude; so it can be had modulo 2^64, however long n·2^s is, and
//! one step up or down makes the quotient exact.

use crate::tokens::FEW;
use std::array::from_fn;

/// 1.5·2^52: adding it rounds a number below 2^51 to an integer, which then stands in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// Guesses up to here are exact after one step.
const LARGEST: f64 = (1u64 << 50) as f64;

/// Numerators of the channels are shifted by so many bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shifts {
    bits: [u32; FEW],
    /// 2^bits.
    scale: [f64; FEW],
}

impl Shifts {
    /// At most 62 bits.
    pub(super) fn new(bits: [u32; FEW]) -> Self {
        Shifts { bits, scale: bits.map(|bits| (1i64 << bits) as f64) }
    }
}

/// A divisor, 1 to 2^60.
#[derive(Clone, Copy, Debug)]
pub(super) struct Divisor {
    value: i64,
    reciprocal: f64,
}

impl Divisor {
    #[inline(always)]
    pub(super) fn new(value: i64) -> Self {
        Divisor { value, reciprocal: 1.0 / value as f64 }
    }

    /// RN(n·2^s/d) = floor(n·2^s/d + 1/2), modulo 2^64, of all channels, and whether all are exact.
    ///
    /// Every statement does one thing to all channels: so the compiler makes it one vector instruction.
    #[inline(always)]
    pub(super) fn round(self, n: [i64; FEW], shifts: &Shifts) -> ([i64; FEW], bool) {
        let guess: [f64; FEW] = from_fn(|i| float(n[i]) * (self.reciprocal * shifts.scale[i]));
        let quotient = guess.map(integer);
        let twice: [i64; FEW] = from_fn(|i| {
            n[i].wrapping_shl(shifts.bits[i])
                .wrapping_sub(quotient[i].wrapping_mul(self.value))
                .wrapping_mul(2)
        });
        let up: [i64; FEW] = from_fn(|i| i64::from(twice[i] >= self.value));
        let down: [i64; FEW] = from_fn(|i| i64::from(twice[i] < -self.value));
        let exact = guess.iter().fold(true, |all, guess| all & (guess.abs() <= LARGEST));
        (from_fn(|i| quotient[i].wrapping_add(up[i]).wrapping_sub(down[i])), exact)
    }

    /// floor(n/d) and n mod d; |n/d| <= 2^50.
    #[inline(always)]
    pub(super) fn floor(self, n: i64) -> (i64, i64) {
        let quotient = integer(n as f64 * self.reciprocal);
        let remainder = n.wrapping_sub(quotient.wrapping_mul(self.value));
        let down = remainder >> 63; // -1 if the guess is too high
        (quotient.wrapping_add(down), remainder.wrapping_add(down & self.value))
    }
}

/// The nearest number in f64, as the conversion has it, by halves: 2^52 + low and 2^84 + 2^63 + 2^32·high are put together from bits,
/// what is too much is taken away exactly, and the sum is rounded once. (There is no vector instruction for it in AVX2.)
#[inline(always)]
fn float(n: i64) -> f64 {
    let low = f64::from_bits(n as u64 & 0xFFFF_FFFF | 0x4330_0000_0000_0000);
    let high = f64::from_bits(n as u64 >> 32 ^ 0x4530_0000_8000_0000);
    (high - f64::from_bits(0x4530_0000_8010_0000)) + low
}

/// Rounds to an integer, |x| <= 2^50.
#[inline(always)]
pub(super) fn integer(x: f64) -> i64 {
    (x + ROUND).to_bits().wrapping_sub(ROUND.to_bits()) as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{RngCore, SeedableRng};

    /// A signed number of up to `bits` bits, every length equally often, and often next to a multiple of `d`.
    fn number(random: &mut Pcg64, bits: u32, d: i64) -> i64 {
        let n = random.next_u64() as i64 >> (64 - bits) >> (random.next_u32() % bits);
        match random.next_u32() % 4 {
            0 => n / d * d + (random.next_u32() % 3) as i64 - 1,
            1 => n / d * d + d / 2 + (random.next_u32() % 3) as i64 - 1,
            _ => n,
        }
    }

    #[test]
    fn quotients_are_exact_or_say_so() {
        let mut random = Pcg64::seed_from_u64(1);
        let (mut exact, mut large) = (0, 0);
        for _ in 0..2_000_000 {
            let d = (random.next_u64() >> 18 >> (random.next_u32() % 46)).max(1) as i64;
            let bits = random.next_u32() % 40;
            let n = from_fn(|_| number(&mut random, 62, d));
            let (quotients, reliable) = Divisor::new(d).round(n, &Shifts::new([bits; FEW]));
            let dividends = n.map(|n| i128::from(n) << bits);
            let expected = dividends.map(|n| (n + i128::from(d / 2)).div_euclid(i128::from(d)));
            if reliable {
                assert_eq!(quotients, expected.map(|n| n as i64), "{n:?} * 2^{bits} / {d}");
                exact += 1;
            } else {
                assert!(
                    expected.iter().any(|n| n.abs() > 1 << 49),
                    "{n:?} * 2^{bits} / {d} could be divided"
                );
                large += 1;
            }
            for n in n {
                assert_eq!(float(n), n as f64, "{n}");
                if n.abs() / d < 1 << 50 {
                    assert_eq!(Divisor::new(d).floor(n), (n.div_euclid(d), n.rem_euclid(d)), "{n} / {d}");
                }
            }
        }
        println!("{exact} times all quotients exact, {large} times one too large");
        assert!(exact > 500_000 && large > 100_000);
    }
}
