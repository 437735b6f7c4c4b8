//! Random triangles, walked exactly: bounds 2, 4 and 6, and the budget of a machine with its vertex rounding.

use crate::rational::{exact, ratio, round_to_integer, rounded};
use crate::triangle::{Interpolator, Line, Triangle, Vertex};
use edgewalk_numerics::bounds::triangle_error;
use edgewalk_numerics::{Dyadic, ErrorBudget, Rounding, Steps};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const NEAREST: Rounding = Rounding::NearestHalfUp;
/// 8-bit colour with 4 vertex bits.
const TOP: i64 = 255 << 4;

fn interpolator(fraction_bits: u32, rounding: Rounding) -> Interpolator {
    Interpolator { fraction_bits, vertex_bits: 4, rounding, height: 480 }
}

/// Corners anywhere within a box of random size (one time in four a sliver) that may lie partly above the
/// screen.
fn random_vertices(random: &mut Pcg64Mcg) -> [Vertex; 3] {
    let size = 256.0 * 2f64.powf(random.random_range(0.0..8.0));
    let flat = if random.random_range(0..4) == 0 { 0.02 } else { 1.0 };
    let turned = random.random_bool(0.5);
    let origin = (random.random_range(-8192..65536), random.random_range(-8192..65536));
    std::array::from_fn(|_| {
        let long = random.random_range(0.0..=size) as i64;
        let short = random.random_range(0.0..=size * flat) as i64;
        let (x, y) = if turned { (short, long) } else { (long, short) };
        (origin.0 + x, origin.1 + y, random.random_range(0..=TOP))
    })
}

fn steps(triangle: &Triangle, line: &Line, column: i64) -> Steps {
    let lines = (line.down[0] + line.down[1]).try_into().unwrap();
    Steps { lines, columns: triangle.columns_to(line, column).try_into().unwrap() }
}

/// Bound 6: the share of fragments whose output differs from the rounded exact value, about u·(0.83·σ +
/// 1/(15·σ)) with σ = sqrt((1 + Σn²)/12). Each n counts the additions of one increment.
///
/// A statistic, not a bound: it catches a biased rounding that never shows in the maximum.
fn mismatch_rate(fraction_bits: u32, additions: &[u32]) -> f64 {
    let squares: f64 = additions.iter().map(|n| f64::from(*n).powi(2)).sum();
    let deviation = ((1.0 + squares) / 12.0).sqrt();
    (0.83 * deviation + 1.0 / (15.0 * deviation)) / f64::from(1 << fraction_bits)
}

fn share(error: &BigRational, bound: Dyadic) -> f64 {
    (error / exact(bound)).to_f64().unwrap()
}

#[test]
fn a2_and_a4_random_triangles_stay_within_the_bound_and_the_range() {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    for rounding in [NEAREST, Rounding::NearestHalfEven, Rounding::Floor] {
        let bits = if rounding == Rounding::Floor { 12 } else { 11 };
        let (mut most, mut checked) = (0f64, 0);
        for _ in 0..3000 {
            let Some(triangle) = Triangle::new(interpolator(bits, rounding), random_vertices(&mut random))
            else {
                continue;
            };
            for line in &triangle.lines {
                // Error and bound are linear along the span, so its ends say all.
                for column in [line.columns.0, line.columns.1] {
                    let (sum, truth) = (triangle.sum(line, column), triangle.exact(line, column));
                    let steps = steps(&triangle, line, column);
                    let error = (&sum - &truth).abs();
                    let bound = triangle_error(rounding, bits, steps).magnitude();
                    assert!(error <= exact(bound), "{rounding} {steps:?}: {error}");
                    let output = round_to_integer(&sum, NEAREST);
                    assert!((0.into()..=255.into()).contains(&output), "{rounding} {steps:?}: {output}");
                    assert!((BigRational::from_integer(output) - truth).abs() < ratio(1, 1));
                    if steps.total() >= 16 {
                        most = most.max(share(&error, bound));
                    }
                    checked += 1;
                }
            }
        }
        println!("bound 2 {rounding}: {checked} pixels, {most:.4} of the bound reached");
        assert!(most > 0.95 && checked > 50_000, "{rounding}: {most} over {checked}");
    }
}

/// What [`observe`] has seen of random pixels.
struct Observed {
    /// Share whose output differs from the rounded exact value, and the share that bound 6 predicts.
    different: f64,
    predicted: f64,
    /// Mean magnitude of the error before the output rounding over the mean of its deviations.
    mean_over_deviation: f64,
}

fn observe(seed: u64, pixels: u32, bits: u32, rounding: Rounding) -> Observed {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let (mut different, mut predicted, mut error, mut deviation, mut checked) = (0, 0.0, 0.0, 0.0, 0);
    while checked < pixels {
        let Some(triangle) = Triangle::new(interpolator(bits, rounding), random_vertices(&mut random)) else {
            continue;
        };
        if triangle.lines.is_empty() {
            continue;
        }
        let line = &triangle.lines[random.random_range(0..triangle.lines.len())];
        let column = random.random_range(line.columns.0..=line.columns.1);
        if steps(&triangle, line, column).total() > 64 {
            continue; // an error beyond 1/2 LSB could skip an output
        }
        let output = |value: &BigRational| round_to_integer(value, NEAREST);
        let (sum, truth) = (triangle.sum(line, column), triangle.exact(line, column));
        different += i32::from(output(&sum) != output(&truth));
        error += (sum - truth).abs().to_f64().unwrap();
        let additions = [line.down[0], line.down[1], triangle.columns_to(line, column)];
        predicted += mismatch_rate(bits, &additions.map(|n| n.try_into().unwrap()));
        let squares: i64 = additions.iter().map(|n| n * n).sum();
        deviation += (((1 + squares) as f64) / 12.0).sqrt() / f64::from(1 << bits);
        checked += 1;
    }
    let all = f64::from(checked);
    Observed {
        different: f64::from(different) / all,
        predicted: predicted / all,
        mean_over_deviation: error / deviation,
    }
}

#[test]
fn a6_predicts_the_mismatches_and_betrays_a_floored_increment() {
    let Observed { different, predicted, mean_over_deviation } = observe(6, 40_000, 6, NEAREST);
    println!("bound 6: {different:.4} of the outputs differ, {predicted:.4} predicted");
    println!("bound 6: mean magnitude of the error {mean_over_deviation:.4} of its deviation");
    assert!((different / predicted - 1.0).abs() < 0.08, "{different} for {predicted}");
    // From the normal distribution to a single uniform one.
    assert!((0.798..0.866).contains(&mean_over_deviation), "{mean_over_deviation}");
    let floored = observe(6, 10_000, 6, Rounding::Floor);
    println!(
        "bound 6 floored: {:.4} of the outputs differ, {:.4} predicted for RN",
        floored.different, floored.predicted
    );
    assert!(floored.different / floored.predicted > 1.5);
}

/// Sums lie on a grid and a boundary of the output on one of its points: without a step the half of u below
/// it differs.
#[test]
fn a6_without_steps_and_with_many() {
    for bits in [1u32, 3, 6] {
        let fine = 1i64 << (bits + 10);
        let differ = (0..fine).filter(|k| {
            let truth = ratio(2 * k + 1, 2 * fine);
            let sum = rounded(&truth, bits, NEAREST);
            round_to_integer(&sum, NEAREST) != round_to_integer(&truth, NEAREST)
        });
        let share = differ.count() as f64 / fine as f64;
        assert_eq!(share, 0.5 / f64::from(1 << bits));
        assert!((mismatch_rate(bits, &[]) / share - 1.0).abs() < 0.07, "{share}");
    }
    // The factor of the deviation, between those of one uniform error and of a normal one.
    let factor = mismatch_rate(20, &[3000]) * f64::from(1 << 20) / 3000.0 * 12f64.sqrt();
    assert!((0.798..0.866).contains(&factor), "{factor}");
}

#[test]
fn the_budget_holds_against_vertices_before_their_rounding() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    // Few vertex bits, so that their part of the budget is seen; the host's values have 20 more.
    for (vertex_bits, bits) in [(0, 12), (2, 11), (4, 11)] {
        let host = Interpolator { fraction_bits: 24, vertex_bits: 20, ..interpolator(24, NEAREST) };
        let machine = Interpolator { fraction_bits: bits, vertex_bits, ..host };
        let (mut most, mut most_output, mut checked) = (0f64, 0f64, 0);
        for _ in 0..1500 {
            let place = random_vertices(&mut random);
            // The host's values lie near a tie, alike at all three vertices half of the time.
            let tie = (1i64 << 19 >> vertex_bits) - random.random_range(0..64);
            let values: [i64; 3] = std::array::from_fn(|_| {
                (random.random_range(0..255i64 << vertex_bits) << (20 - vertex_bits)) + tie
            });
            let quantised = values.map(|c| {
                let value = ratio(c, 1i64 << (20 - vertex_bits));
                round_to_integer(&value, Rounding::NearestHalfEven).try_into().unwrap()
            });
            let with = |c: [i64; 3]| std::array::from_fn(|i| (place[i].0, place[i].1, c[i]));
            let (Some(triangle), Some(ideal)) =
                (Triangle::new(machine, with(quantised)), Triangle::new(host, with(values)))
            else {
                continue;
            };
            for (line, ideal_line) in triangle.lines.iter().zip(&ideal.lines) {
                for column in [line.columns.0, line.columns.1] {
                    let behind = steps(&triangle, line, column);
                    let budget = ErrorBudget::new(vertex_bits, bits, behind, Dyadic::HALF);
                    let truth = ideal.exact(ideal_line, column);
                    let sum = triangle.sum(line, column);
                    let error = (&sum - &truth).abs();
                    assert!(error <= exact(budget.before_rounding()), "{error} over {budget}");
                    let output = BigRational::from_integer(round_to_integer(&sum, NEAREST));
                    let output_error = (output - truth).abs();
                    assert!(output_error <= exact(budget.after_rounding()), "{output_error} over {budget}");
                    most = most.max(share(&error, budget.before_rounding()));
                    most_output = most_output.max(share(&output_error, budget.after_rounding()));
                    checked += 1;
                }
            }
        }
        println!(
            "budget e = {vertex_bits}, r = {bits}: {checked} pixels, {most:.4} before and {most_output:.4} after rounding reached"
        );
        assert!(most > 0.9 && most_output > 0.9 && checked > 10_000);
    }
}
