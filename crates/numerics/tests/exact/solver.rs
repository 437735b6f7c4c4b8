//! The solver's bits suffice, and its witness breaks one bit fewer: both by exact simulation.

use crate::rational::{exact, ratio, round_to_integer};
use crate::triangle::{Interpolator, Triangle};
use edgewalk_numerics::bounds::triangle_error;
use edgewalk_numerics::solver::{least_fraction_bits, solve};
use edgewalk_numerics::{ChannelBits, Dyadic, Rounding, Screen, SolverError, Steps, Target, Witness};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;

const COLOUR: ChannelBits = ChannelBits { output: 8, vertex: 4 };
const DEPTH: ChannelBits = ChannelBits { output: 24, vertex: 4 };
const DEFAULT: Screen = Screen { width: 640, height: 480, guard_columns: 8191 };

/// Sum and exact value, LSB, of the witness's pixel as simulated with `fraction_bits`.
fn simulate(
    witness: &Witness,
    screen: Screen,
    rounding: Rounding,
    fraction_bits: u32,
) -> (BigRational, BigRational) {
    let machine = Interpolator {
        fraction_bits,
        vertex_bits: witness.channel.vertex,
        rounding,
        height: screen.height.into(),
    };
    let most = ((1i64 << witness.channel.output) - 1) << witness.channel.vertex;
    let vertices = witness.vertices.map(|(x, y, c)| {
        let guard = f64::from(screen.guard_columns.max(screen.width).max(screen.height));
        assert!(f64::from(x.abs().max(y.abs())) <= guard * 256.0, "outside the guard band");
        assert!(i64::try_from(c).unwrap() <= most, "outside the range");
        (x.into(), y.into(), c.try_into().unwrap())
    });
    let triangle = Triangle::new(machine, vertices).unwrap();
    let (column, line) = (i64::from(witness.pixel.0), i64::from(witness.pixel.1));
    assert!(witness.pixel.0 < screen.width && witness.pixel.1 < screen.height);
    let line = triangle.lines.iter().find(|found| found.line == line).expect("the line is covered");
    assert!(line.columns.0 <= column && column <= line.columns.1, "the pixel is covered");
    assert_eq!(line.down[0] + line.down[1], i64::from(witness.steps.lines));
    assert_eq!(triangle.columns_to(line, column), i64::from(witness.steps.columns));
    (triangle.sum(line, column), triangle.exact(line, column))
}

/// Whether a sum meets the target.
fn meets(target: Target, channel: ChannelBits, sum: &BigRational, true_value: &BigRational) -> bool {
    match target {
        Target::InRange => {
            let output = round_to_integer(sum, Rounding::NearestHalfUp);
            (BigInt::ZERO..BigInt::from(1) << channel.output).contains(&output)
        }
        Target::AtMost(error) => (sum - true_value).abs() <= exact(error),
    }
}

/// Solves, and simulates the witness with one bit fewer and with the bits of the solution.
fn check(screen: Screen, channel: ChannelBits, rounding: Rounding, target: Target) -> (u32, Witness) {
    let solution = solve(screen, channel, rounding, target).unwrap();
    let witness =
        solution.one_bit_fewer.unwrap_or_else(|| panic!("{screen} {rounding} {target:?}: no witness"));
    assert_eq!(witness.fraction_bits + 1, solution.fraction_bits);
    let (sum, true_value) = simulate(&witness, screen, rounding, witness.fraction_bits);
    assert_eq!(sum, exact(witness.sum), "{witness}");
    assert_eq!(true_value, ratio(witness.exact.0, witness.exact.1), "{witness}");
    assert!(!meets(target, channel, &sum, &true_value), "{witness}");
    let (sum, true_value) = simulate(&witness, screen, rounding, solution.fraction_bits);
    assert!(meets(target, channel, &sum, &true_value), "{witness}");
    assert!((sum - true_value).abs() <= exact(solution.error), "{witness}");
    (solution.fraction_bits, witness)
}

#[test]
fn a4_bits_of_common_screens_and_one_bit_fewer_wraps_255_to_256() {
    for (screen, bits) in [
        (Screen::clipped(640, 480), 11),
        (Screen::clipped(1920, 1080), 12),
        (Screen::clipped(4096, 4096), 13),
        (DEFAULT, 14),
    ] {
        let (found, witness) = check(screen, COLOUR, Rounding::NearestHalfUp, Target::InRange);
        assert_eq!(found, bits, "{screen}");
        assert_eq!(witness.output(), 256);
        assert!(witness.to_string().contains("output 256 of 0..=255"));
        let (found, witness) = check(screen, COLOUR, Rounding::Floor, Target::InRange);
        assert_eq!(found, bits + 1, "{screen}");
        assert_eq!(witness.output(), -1);
    }
    let (bits, _) = check(DEFAULT, DEPTH, Rounding::NearestHalfUp, Target::InRange);
    assert_eq!(bits, 14);
    // The triangle of 4096x4096 shows bound 2 to be all but reached.
    let (_, witness) = check(Screen::clipped(4096, 4096), COLOUR, Rounding::NearestHalfUp, Target::InRange);
    let bound = exact(triangle_error(Rounding::NearestHalfUp, 12, witness.steps).high());
    let error = exact(witness.sum) - ratio(witness.exact.0, witness.exact.1);
    assert!(error > bound * ratio(999, 1000), "{witness}");
}

#[test]
fn every_screen_has_a_witness_but_next_to_a_power_of_two() {
    let (mut found, mut next_to) = (0, 0);
    for width in [3, 5, 16, 33, 100, 320, 511, 1000] {
        for height in [1, 2, 4, 17, 64, 200, 479, 514] {
            let terms: u32 = width + height - 1; // N + 1
            for rounding in [Rounding::NearestHalfUp, Rounding::NearestHalfEven, Rounding::Floor] {
                if terms - (1 << terms.ilog2()) >= 2 {
                    check(Screen::clipped(width, height), COLOUR, rounding, Target::InRange);
                    found += 1;
                } else {
                    next_to += 1;
                }
            }
        }
    }
    assert_eq!(found + next_to, 8 * 8 * 3);
    assert!(found > 5 * next_to, "witnesses for {found}, next to a power of two {next_to}");
}

#[test]
fn error_targets_are_met_and_missed_with_one_bit_fewer() {
    let mut last = 0;
    for (n, bits) in [(1, 2), (1, 4), (3, 6), (1, 8), (5, 12)] {
        let target = Target::AtMost(Dyadic::new(n, bits).unwrap());
        let (found, _) = check(DEFAULT, COLOUR, Rounding::NearestHalfUp, target);
        assert!(found >= last);
        last = found;
        check(Screen::clipped(641, 481), DEPTH, Rounding::NearestHalfEven, target);
        check(Screen::clipped(1921, 1081), COLOUR, Rounding::Floor, target);
    }
}

#[test]
fn the_number_of_steps_may_be_given() {
    let steps = |n| Steps { lines: 0, columns: n };
    // 9310 terms of u/2 make at most 1/8 LSB with 16 bits.
    let target = Target::AtMost(Dyadic::new(1, 3).unwrap());
    assert_eq!(least_fraction_bits(steps(9309), Rounding::NearestHalfUp, target), Ok(16));
    assert_eq!(least_fraction_bits(steps(9309), Rounding::NearestHalfUp, Target::InRange), Ok(14));
    // 8 terms of u/2 make exactly 1/4 LSB with 4 bits: at most, not less than.
    let quarter = Target::AtMost(Dyadic::new(1, 2).unwrap());
    assert_eq!(least_fraction_bits(steps(7), Rounding::NearestHalfUp, quarter), Ok(4));
    assert_eq!(least_fraction_bits(steps(0), Rounding::Floor, Target::InRange), Ok(1));
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let refused = |result: Result<_, SolverError>| result.unwrap_err().to_string();
    let screen = Screen::clipped(640, 480);
    let nearest = Rounding::NearestHalfUp;
    let zero = Target::AtMost(Dyadic::ZERO);
    assert!(refused(solve(screen, COLOUR, nearest, zero)).contains("more than 40 fraction bits"));
    assert!(refused(solve(screen, COLOUR, Rounding::TowardZero, Target::InRange)).contains("toward-zero"));
    assert!(refused(solve(Screen::clipped(0, 480), COLOUR, nearest, Target::InRange)).contains("width = 0"));
    assert!(refused(solve(Screen::clipped(1, 1 << 16), COLOUR, nearest, Target::InRange)).contains("height"));
    let wide = ChannelBits { output: 33, vertex: 0 };
    assert!(refused(solve(screen, wide, nearest, Target::InRange)).contains("output bits = 33"));
}
