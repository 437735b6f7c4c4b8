//! The bounds are no looser than they must be: cases that reach them, one for each term, up to a stated
//! speck.

use crate::classical::{Place, Prestep};
use crate::rational::{exact, power_of_two, ratio, rounded};
use edgewalk_numerics::bounds::triangle_error;
use edgewalk_numerics::{Dyadic, Rounding, Steps};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

fn dyadic(numerator: i128, bits: u32) -> Dyadic {
    Dyadic::new(numerator, bits).unwrap()
}

#[test]
fn a1_is_reached_by_a_start_and_an_increment_that_err_alike() {
    let bits = 4;
    let speck = ratio(1, 1 << 20);
    let half = ratio(1, 2);
    let mut checked = 0;
    for rounding in Rounding::ALL {
        for n in [0u32, 1, 2, 15, 1000, u32::MAX] {
            let count = ratio(n, 1) + ratio(1, 1);
            let bound = exact(triangle_error(rounding, bits, Steps { lines: n, columns: 0 }).magnitude());
            // The fractions, in units of u, at which one rounding errs most.
            let fractions = [speck.clone(), &half - &speck, half.clone(), ratio(1, 1) - &speck];
            let reached = fractions.map(|fraction| {
                let value = fraction / power_of_two(bits);
                let error = rounded(&value, bits, rounding) - value;
                error.abs() * &count
            });
            let most = reached.iter().max().unwrap();
            let gap = &bound - most;
            assert!(!gap.is_negative(), "{rounding} {n}: {most} over {bound}");
            assert!(gap <= &speck * &count / power_of_two(bits), "{rounding} {n}: {bound} for {most}");
            checked += 1;
        }
    }
    println!("bound 1: {checked} bounds reached");
    assert_eq!(checked, 7 * 6);
}

/// A machine and a place with no error of any kind.
fn without_error() -> (Prestep, Place) {
    let (one, none) = (Dyadic::ONE, Dyadic::ZERO);
    let machine = Prestep { distance_bits: 60, edge_bits: 60 };
    let place =
        Place { start: none, edge_start: none, gradient: one, edge_gradient: one, slope: one, eta: none };
    (machine, place)
}

/// What bound 3 leaves over, in units of what the term in question amounts to.
fn left_over(bits: u32, steps: Steps, machine: Prestep, place: Place, term: &BigRational) -> BigRational {
    let bound = place.bound(bits, steps, &machine);
    let error = place.error(bits, steps, &machine).abs();
    assert!(!term.is_zero() && error <= bound, "{error} over {bound}");
    (bound - error) / term
}

#[test]
fn a3_is_reached_term_by_term() {
    let (exact_machine, still) = without_error();
    let mut worst: Vec<(&str, f64)> = Vec::new();
    for (lines, columns) in [(0u32, 0u32), (1, 0), (0, 1), (5, 9), (300, 200)] {
        let steps = Steps { lines, columns };
        let mut note = |what, left: BigRational| {
            let share = num_traits::ToPrimitive::to_f64(&left).unwrap();
            worst.push((what, share));
        };

        // Roundings, in units of u/2. Start, edge increment and gradient lie half a u below a multiple and
        // are rounded up. The gradient's is then 2^10 u, its product with the distance 1 - 2^-11 again a tie.
        let u = |halves: i128| dyadic(halves, 5);
        let ties = Place {
            start: u(1),
            edge_start: dyadic(1, 11),
            gradient: u(2 * 1024 - 1),
            edge_gradient: u(3),
            ..still
        };
        note("roundings", left_over(4, steps, exact_machine, ties, &ratio(1, 32)));

        // The distance, here 2^-3 less a speck, cut to 3 bits.
        let cut = Prestep { distance_bits: 3, ..exact_machine };
        let short = Place { edge_start: dyadic(-(1 << 27) + 1, 30), gradient: Dyadic::integer(-5), ..still };
        note("distance", left_over(50, steps, cut, short, &ratio(5, 8)));

        // The edge: start and slope a tie of its DDA.
        let coarse = Prestep { edge_bits: 6, ..exact_machine };
        let tied =
            Place { edge_start: dyadic(1, 7), slope: dyadic(1, 7), gradient: Dyadic::integer(-5), ..still };
        note("edge", left_over(50, steps, coarse, tied, &ratio(5 * (i64::from(lines) + 1), 128)));

        // The reciprocal, all three of its parts with one sign: the edge moves left as the value rises, and
        // ends a speck right of a centre, so that the distance is all but 1.
        let (eta, edge_gradient, gradient, slope) = (dyadic(1, 12), 3, 5, -7);
        let moved = dyadic(-i128::from(slope) * i128::from(lines) * 4097, 12);
        let through = Place {
            edge_start: moved.checked_add(dyadic(1, 40)).unwrap(),
            edge_gradient: Dyadic::integer(edge_gradient),
            gradient: Dyadic::integer(gradient),
            slope: Dyadic::integer(slope),
            eta,
            ..still
        };
        let (y, x) = (i64::from(lines), i64::from(columns));
        let parts = ratio(y * 3 + (x + 1) * 5 + y * 35, 4096);
        note("reciprocal", left_over(50, steps, exact_machine, through, &parts));
    }
    for what in ["roundings", "distance", "edge", "reciprocal"] {
        let left = worst.iter().filter(|(name, _)| *name == what).map(|(_, left)| *left).fold(0.0, f64::max);
        println!("bound 3 {what}: at most {left:.1e} of the term left over");
        assert!(left < 1e-3, "{what}: {left}");
    }
    assert_eq!(worst.len(), 5 * 4);
}
