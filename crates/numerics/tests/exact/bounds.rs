//! Every bound holds in exact simulation, and is reached to the share that `docs/numerics.md` states.
//!
//! Steps of dA/n with n a power of two are exact and show nothing, so the tables use odd n.

use crate::classical::{Place, Prestep};
use crate::rational::{exact, power_of_two, ratio, round_to_integer, rounded};
use edgewalk_numerics::bounds::{
    range_safe_fraction_bits, slope_edge_error, surely_ordered_difference, triangle_error,
};
use edgewalk_numerics::{Dyadic, Interval, Rounding, Steps};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const NEAREST: Rounding = Rounding::NearestHalfUp;

fn holds(bound: Interval, error: &BigRational) -> bool {
    exact(bound.low()) <= *error && *error <= exact(bound.high())
}

/// |error| over the bound's magnitude.
fn share(error: &BigRational, bound: &BigRational) -> f64 {
    let share = error.abs() / bound;
    share.numer().to_string().parse::<f64>().unwrap() / share.denom().to_string().parse::<f64>().unwrap()
}

#[test]
fn a1_every_step_of_odd_ddas() {
    let bits = 4;
    for rounding in Rounding::ALL {
        let (mut most, mut checked) = (0f64, 0);
        for n in [3i64, 7, 15, 33, 99] {
            for difference in -2 * n..=2 * n {
                let start = ratio(difference * 37, 16 * 101);
                let slope = ratio(difference, n);
                let increment = rounded(&slope, bits, rounding);
                let mut value = rounded(&start, bits, rounding);
                for step in 0..=n {
                    let error = &value - (&start + &slope * ratio(step, 1));
                    let bound = triangle_error(rounding, bits, Steps { lines: step as u32, columns: 0 });
                    assert!(
                        holds(bound, &error),
                        "{rounding} {difference}/{n} step {step}: {error} in {bound}"
                    );
                    if step >= 15 {
                        most = most.max(share(&error, &exact(bound.magnitude())));
                    }
                    checked += 1;
                    value += &increment;
                }
            }
        }
        println!("bound 1 {rounding}: {checked} values, {most:.4} of the bound reached");
        assert!(most > 0.95 && most <= 1.0, "{rounding}: {most}");
    }
}

#[test]
fn a3_machines_with_prestep_and_reciprocal() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let (mut most, mut checked) = (0f64, 0);
    for case in 0..4000 {
        // Every other machine has no error but the roundings to r bits, and few steps that could hide one.
        let fine = case % 2 == 0;
        let mut dyadic = |size: i64, bits: u32| {
            let n = random.random_range(-size..=size);
            Dyadic::new(n.into(), bits).unwrap()
        };
        // Gradients along x and down the edge, slope, and the reciprocal's relative error.
        let (gradient, edge_gradient, slope, eta) =
            (dyadic(4000, 9), dyadic(4000, 9), dyadic(3000, 10), dyadic(if fine { 0 } else { 3 }, 12));
        let start = dyadic(1 << 20, 13);
        let edge_start = dyadic(1 << 20, 13);
        let mut small = |limit: u32| random.random_range(0..=limit);
        let (bits, steps) = (
            4 + small(8),
            Steps { lines: small(if fine { 2 } else { 40 }), columns: small(if fine { 2 } else { 40 }) },
        );
        let machine = Prestep {
            distance_bits: if fine { 40 } else { small(8) },
            edge_bits: if fine { 40 } else { 4 + small(12) },
        };
        let place = Place { start, edge_start, gradient, edge_gradient, slope, eta };
        let bound = place.bound(bits, steps, &machine);
        let error = place.error(bits, steps, &machine);
        assert!(error.abs() <= bound, "{machine:?} {place:?} {steps:?} {bits} bits: {error} over {bound}");
        if !fine && steps.total() >= 8 {
            most = most.max(share(&error, &bound));
        }
        checked += 1;
    }
    println!("bound 3: {checked} machines, {most:.4} of the bound reached");
    assert!(most > 0.8 && checked == 4000, "{most}");
}

#[test]
fn a4_is_the_first_number_of_bits_that_stays_under_a_half() {
    let half = ratio(1, 2);
    for n in 0..4000u32 {
        let steps = Steps { lines: n / 3, columns: n - n / 3 };
        let nearest = |bits: u32| ratio(n + 1, 2) / power_of_two(bits) < half;
        let floor = |bits: u32| ratio(n + 1, 1) / power_of_two(bits) <= half; // never reached by floor
        assert_eq!((0..40).find(|bits| nearest(*bits)), Some(range_safe_fraction_bits(NEAREST, steps)));
        assert_eq!((0..40).find(|bits| floor(*bits)), Some(range_safe_fraction_bits(Rounding::Floor, steps)));
    }
    let most = Steps { lines: u32::MAX, columns: u32::MAX };
    assert_eq!(range_safe_fraction_bits(NEAREST, most), 33);
    assert_eq!(range_safe_fraction_bits(Rounding::Floor, most), 34);
}

#[test]
fn a5_slope_edges_err_only_next_to_the_edge() {
    let (mut most, mut checked, mut wrong) = (0f64, 0, 0);
    for bits in [1, 3, 6, 10] {
        for height in [3i64, 9, 31, 77] {
            for width in -90i64..=90 {
                let slope = ratio(width, height);
                let start = ratio(width * 13 + 5, 97);
                let increment = rounded(&slope, bits, NEAREST);
                let mut x = rounded(&start, bits, NEAREST);
                for line in 0..height {
                    let truth = &start + &slope * ratio(line, 1);
                    let bound = exact(slope_edge_error(bits, line as u32));
                    let error = (&x - &truth).abs();
                    assert!(error <= bound, "{width}/{height} line {line}, {bits} bits");
                    if line >= 8 {
                        most = most.max(share(&error, &bound));
                    }
                    // Columns whose centre lies right of one edge but not of the other.
                    let columns = [x.ceil(), truth.ceil()];
                    let (low, high) = (columns.iter().min().unwrap(), columns.iter().max().unwrap());
                    let mut column = low.clone();
                    while column < *high {
                        assert!((&column - &truth).abs() <= bound);
                        column += ratio(1, 1);
                        wrong += 1;
                    }
                    x += &increment;
                    checked += 1;
                }
            }
        }
    }
    println!("bound 5: {checked} lines, {most:.4} of the bound reached, {wrong} columns on the wrong side");
    assert!(most > 0.95 && wrong > 1000);
}

#[test]
fn a7_orders_depths_and_one_step_less_does_not() {
    // Everything in sixteenths of an LSB.
    let sixteenths = |n: i64| ratio(n, 16);
    let output = |value: i64| round_to_integer(&sixteenths(value), NEAREST);
    let (mut ordered, mut tied) = (0, 0);
    for (e1, e2) in [(0, 0), (1, 3), (7, 7), (4, 20)] {
        let [a, b] = [e1, e2].map(|e: i64| Dyadic::new(e.into(), 4).unwrap());
        let enough = surely_ordered_difference(a, b).unwrap().scaled(4).unwrap() as i64;
        for near in 0..64 {
            for more in 0..20 {
                // The nearer comes out too far and the farther too near.
                let outputs = |difference: i64| (output(near + e1), output(near + difference - e2));
                let (front, back) = outputs(enough + more);
                assert!(front < back);
                ordered += 1;
            }
            let (front, back) = (output(near + e1), output(near + enough - 1 - e2));
            tied += i32::from(front >= back);
        }
    }
    assert!(ordered == 4 * 64 * 20 && tied > 0, "{ordered} ordered, {tied} tied with a step less");
}

#[test]
fn a9_quotient_and_remainder_accumulate_nothing() {
    for rounding in [Rounding::Floor, NEAREST] {
        let (mut most, mut checked) = (0f64, 0);
        for n in [3i64, 7, 33, 99, 255] {
            for difference in [-1000, -97, -1, 0, 1, 50, 101, 4096] {
                for bits in [0u32, 4] {
                    // Value = (accumulator + remainder/n) units of u; RN starts half a unit higher.
                    let numerator: i64 = difference << bits;
                    let (quotient, fraction) = (numerator.div_euclid(n), numerator.rem_euclid(n));
                    let (mut accumulator, mut remainder) = (0, if rounding == NEAREST { n / 2 } else { 0 });
                    for step in 0..=3 * n {
                        let truth = ratio(difference * step, n);
                        let error = ratio(accumulator, 1) / power_of_two(bits) - truth;
                        let bound = triangle_error(rounding, bits, Steps::default());
                        assert!(holds(bound, &error), "{rounding} {difference}/{n} step {step}: {error}");
                        most = most.max(share(&error, &exact(bound.magnitude())));
                        checked += 1;
                        accumulator += quotient;
                        remainder += fraction;
                        if remainder >= n {
                            remainder -= n;
                            accumulator += 1;
                        }
                    }
                }
            }
        }
        println!("bound 9 {rounding}: {checked} values, {most:.4} of the bound reached");
        assert!(most > 0.99, "{rounding}: {most}");
    }
}

#[test]
fn the_bounds_take_senseless_numbers() {
    let most = Steps { lines: u32::MAX, columns: u32::MAX };
    assert!(triangle_error(NEAREST, u32::MAX, most).high() > Dyadic::ZERO);
    assert!(!BigRational::is_zero(&exact(slope_edge_error(u32::MAX, 0))));
    assert_eq!(BigInt::from(slope_edge_error(0, 3).numerator()), BigInt::from(2));
}
