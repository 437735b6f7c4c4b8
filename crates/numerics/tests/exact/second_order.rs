//! Bound 8: quadratics stepped by second differences, in exact rationals.

use crate::rational::{power_of_two, ratio, round_to_integer};
use edgewalk_numerics::{Rounding, Steps};
use num_rational::BigRational;
use num_traits::Signed;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const NEAREST: Rounding = Rounding::NearestHalfUp;

/// Roundings behind N steps: the start, N first differences and N(N-1)/2 second ones.
fn roundings(steps: Steps) -> u64 {
    let n = steps.total();
    (n * n + n + 2) / 2
}

/// Bound 8: magnitude of the error of a quadratic stepped by second differences, all six rounded to nearest:
/// (N²+N+2)/4·u.
fn second_order_error(fraction_bits: u32, steps: Steps) -> BigRational {
    ratio(roundings(steps), 2) / power_of_two(fraction_bits)
}

/// Value, difference to the right, difference down, and the second differences: along x, along y, and mixed.
type Differences = [BigRational; 6];

fn step_right([value, right, down, along_x, _, mixed]: &mut Differences) {
    *value += &*right;
    *right += &*along_x;
    *down += &*mixed; // for the lines below; nobody reads it along the last line
}

fn step_down([value, right, down, _, along_y, mixed]: &mut Differences) {
    *value += &*down;
    *down += &*along_y;
    *right += &*mixed;
}

/// `T5 x² + T4 xy + T3 y² + T2 x + T1 y + T0`, coefficients T0 first.
fn polynomial(t: &[BigRational; 6], x: &BigRational, y: &BigRational) -> BigRational {
    &t[0] + &t[1] * y + &t[2] * x + &t[3] * y * y + &t[4] * x * y + &t[5] * x * x
}

/// Its differences at (x, y), as `docs/numerics.md` states them.
fn differences(t: &[BigRational; 6], x: &BigRational, y: &BigRational) -> Differences {
    let two = ratio(2, 1);
    [
        polynomial(t, x, y),
        &t[5] * (&two * x + ratio(1, 1)) + &t[4] * y + &t[2],
        &t[3] * (&two * y + ratio(1, 1)) + &t[4] * x + &t[1],
        &two * &t[5],
        &two * &t[3],
        t[4].clone(),
    ]
}

#[test]
fn a8_quadratics_down_and_along() {
    let mut random = Pcg64Mcg::seed_from_u64(8);
    let (mut most, mut checked) = (0f64, 0);
    for case in 0..150 {
        let bits = random.random_range(0..=10u32);
        let scale = power_of_two(bits);
        // Odd denominators. Every third case rounds everything up, and every third down, by almost half a
        // unit.
        let mut coefficient = |case: i32| match case % 3 {
            0 => ratio(random.random_range(-40_000..=40_000), 1009),
            1 => ratio(1001 * random.random_range(-20..=20) + 501, 1001) / &scale,
            _ => ratio(1001 * random.random_range(-20..=20) + 500, 1001) / &scale,
        };
        let t: [BigRational; 6] = std::array::from_fn(|_| coefficient(0));
        let (x, y) = (coefficient(0), coefficient(0));
        let mut truth = differences(&t, &x, &y);
        if case % 3 != 0 {
            truth = std::array::from_fn(|_| coefficient(case));
        }
        let mut stepped = truth
            .clone()
            .map(|value| BigRational::from_integer(round_to_integer(&(value * &scale), NEAREST)) / &scale);
        let start = Steps::default();
        let (mut steps, most_steps) = (start, random.random_range(1..50));
        while steps.total() < most_steps {
            // Lines and columns in any order.
            if random.random() {
                steps.columns += 1;
                step_right(&mut truth);
                step_right(&mut stepped);
            } else {
                steps.lines += 1;
                step_down(&mut truth);
                step_down(&mut stepped);
            }
            if case % 3 == 0 {
                let (x, y) = (&x + ratio(steps.columns, 1), &y + ratio(steps.lines, 1));
                assert_eq!(truth[0], polynomial(&t, &x, &y), "differences of {t:?}");
            }
            let bound = second_order_error(bits, steps);
            let error = (&stepped[0] - &truth[0]).abs();
            assert!(error <= bound, "case {case} {steps:?}, {bits} bits: {error} over {bound}");
            let share = error / bound * ratio(10_000, 1);
            most = most.max(round_to_integer(&share, NEAREST).to_string().parse::<f64>().unwrap() / 1e4);
            checked += 1;
        }
    }
    println!("bound 8: {checked} values, {most:.4} of the bound reached");
    assert!(most > 0.99 && checked > 3000, "{most}, {checked}");
}

#[test]
fn a8_bitlen_of_the_roundings_is_the_first_under_a_half() {
    let half = ratio(1, 2);
    for n in 0..2000u32 {
        let steps = Steps { lines: n / 3, columns: n - n / 3 };
        let first = (0..80).find(|bits| second_order_error(*bits, steps) < half);
        assert_eq!(first, Some(roundings(steps).ilog2() + 1), "{n} steps");
    }
}
