//! Bound 12: words of terms against formula (1) and the fit in rationals, and how much of the bound is
//! reached.

use crate::rational::{power_of_two, ratio, round_to_integer};
use edgewalk_numerics::Rounding;
use edgewalk_numerics::term::{
    Degree, NODE_BITS, Shares, TermWords, node, term_roundings, term_roundings_of_box,
};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Formula (1) in integers without end, then modulo 2^width.
fn formula(words: [u64; 6], (i, n): (i64, i64), width: u32) -> u64 {
    let [v, x, y, xx, xy, yy] = words.map(BigInt::from);
    let (i, n) = (BigInt::from(i), BigInt::from(n));
    let pairs = |k: &BigInt| -> BigInt { k * (k - 1) / 2 };
    let value: BigInt = v + &i * x + &n * y + pairs(&i) * xx + pairs(&n) * yy + &i * &n * xy;
    let modulus = BigInt::from(1) << width;
    let rest: BigInt = value % &modulus;
    let rest: BigInt = (rest + &modulus) % &modulus;
    rest.to_u64().unwrap()
}

#[test]
fn words_follow_the_formula_wherever_they_are_moved() {
    let mut random = Pcg64Mcg::seed_from_u64(12);
    let mut checked = 0;
    for _ in 0..4000 {
        let width = random.random_range(1..=64);
        let words = TermWords::new(width, random.random()).unwrap();
        let mut place = || (random.random_range(-9000..=9000i64), random.random_range(-9000..=9000i64));
        let (a, b) = (place(), place());
        let there = words.moved(a.0, a.1);
        assert_eq!(words.at(b.0, b.1), formula(words.words(), b, width), "{words:?} {b:?}");
        assert_eq!(there.at(b.0 - a.0, b.1 - a.1), words.at(b.0, b.1), "{words:?} by way of {a:?} to {b:?}");
        assert_eq!(there.moved(-a.0, -a.1), words);
        checked += 1;
    }
    println!("{checked} words of 1 to 64 bits");
    assert_eq!(checked, 4000);
    assert!(TermWords::new(0, [0; 6]).is_none() && TermWords::new(65, [0; 6]).is_none());
}

/// Corners in half sub-pixels, and what they weigh at the centre of a pixel, along a span to the right or to
/// the left.
fn shares(corners: [[i64; 2]; 3], pixel: [i64; 2], leftward: bool) -> Shares {
    let weight = |k: usize, [x, y]: [i64; 2]| {
        let ([ax, ay], [bx, by]) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        (ax - x) * (by - y) - (ay - y) * (bx - x)
    };
    let at = |x: i64, y: i64| [0, 1, 2].map(|k| weight(k, [512 * x + 256, 512 * y + 256]));
    let [x, y] = pixel;
    let (here, column, line) = (at(x, y), at(x + if leftward { -1 } else { 1 }, y), at(x, y + 1));
    let growth = |to: [i64; 3]| [0, 1, 2].map(|k| to[k] - here[k]);
    Shares { here, column: growth(column), line: growth(line) }
}

/// The function itself at a pixel, from the nodes.
fn function(degree: Degree, nodes: [[i64; 3]; 2], weights: [i64; 3]) -> BigRational {
    let total: BigInt = weights.iter().map(|w| BigInt::from(*w)).sum();
    let l = weights.map(|w| BigRational::new(w.into(), total.clone()));
    let [v, m] = nodes.map(|list| list.map(|value| ratio(value, 1) / power_of_two(NODE_BITS)));
    let mut sum = BigRational::zero();
    for k in 0..3 {
        sum += match degree {
            Degree::Linear => &v[k] * &l[k],
            Degree::Quadratic => {
                &v[k] * &l[k] * (&l[k] * ratio(2, 1) - ratio(1, 1))
                    + &m[k] * &l[(k + 1) % 3] * &l[(k + 2) % 3] * ratio(4, 1)
            }
        };
    }
    sum
}

#[test]
fn rounded_once_and_never_farther_than_the_bound() {
    let mut random = Pcg64Mcg::seed_from_u64(13);
    let (mut checked, mut slivers) = (0, 0);
    let mut reached = [0f64; 2];
    for case in 0..1200 {
        let degree = if case % 3 == 0 { Degree::Linear } else { Degree::Quadratic };
        let side = random.random_range(3..=40i64);
        let mut corner = || [0, 1].map(|_| random.random_range(0..=512 * side));
        let mut corners = [corner(), corner(), corner()];
        if case % 5 == 0 {
            // A hair's breadth.
            corners[2] = [corners[0][0] / 2 + corners[1][0] / 2 + 1, corners[0][1] / 2 + corners[1][1] / 2];
        }
        let middle = [side / 2, side / 2];
        let shares = shares(corners, middle, case % 2 == 0);
        let total: i64 = shares.here.iter().sum();
        let nodes: [[i64; 3]; 2] =
            std::array::from_fn(|_| std::array::from_fn(|_| node(random.random_range(-1.0..=1.0))));
        let (fraction, whole, offset) = (random.random_range(0..=14u32), random.random_range(0..=13u32), -77);
        let words = match degree {
            Degree::Linear => shares.plane(nodes[0], whole + fraction, offset, 64),
            Degree::Quadratic => shares.six_point(nodes, whole + fraction, offset, 64),
        };
        let Some(words) = words else {
            assert_eq!(total, 0);
            continue;
        };
        slivers += u32::from(total.abs() < 512 * side);
        for (i, n) in (0..40).map(|_| (random.random_range(-20..=20), random.random_range(-20..=20))) {
            let weights = [0, 1, 2].map(|k| shares.here[k] + i * shares.column[k] + n * shares.line[k]);
            let truth = function(degree, nodes, weights) * power_of_two(whole + fraction) + ratio(offset, 1);
            // Both modulo 2^64: the word may have wrapped, their difference is small.
            let modulus = power_of_two(64);
            let away = ratio(words.at(i, n), 1) - truth;
            let turns =
                BigRational::from_integer(round_to_integer(&(&away / &modulus), Rounding::NearestHalfUp));
            let away = away - turns * &modulus;
            let roundings = term_roundings(degree, i, n);
            let bound = ratio(roundings, 2); // of u
            let share = (away.abs() / &bound).to_f64().unwrap();
            assert!(away.abs() <= bound, "case {case}, {i} {n}: {share} of the bound");
            let place = usize::from(degree == Degree::Quadratic);
            if roundings > 3 {
                reached[place] = reached[place].max(share);
            }
            checked += 1;
        }
    }
    println!(
        "bound 12: {checked} words, {slivers} thin triangles, planes {:.4}, quadratics {:.4} reached",
        reached[0], reached[1]
    );
    assert!(checked > 40_000 && slivers > 50 && reached.iter().all(|share| *share > 0.9));
}

/// RN is floor(x + 1/2), of negative words too, and whichever way the triangle runs round.
#[test]
fn halves_are_rounded_up() {
    for weight in [1, -1] {
        let shares =
            Shares { here: [weight, 0, 0], column: [-weight, weight, 0], line: [-weight, 0, weight] };
        // A column on is the second vertex, a line down the third.
        for (v, x, y, rounded) in [
            (-1.5, -2.5, 2.5, [-1, -2, 3]),
            (-0.5, -7.5, 0.5, [0, -7, 1]),
            (-2.75, -2.25, -3.0, [-3, -2, -3]),
        ] {
            let words = shares.plane([v, v + x, v + y].map(node), 0, 0, 64).unwrap().words();
            assert_eq!(words[..3], rounded.map(|word: i64| word as u64), "{v} {x} {y}, weight {weight}");
        }
    }
}

#[test]
fn bits_are_the_first_that_hold_and_six_points_stay_within_five_thirds() {
    for (width, height) in [(1, 1), (3, 2), (32, 32), (33, 32), (100, 7), (640, 480), (8192, 8192)] {
        for degree in [Degree::Linear, Degree::Quadratic] {
            // The least bits with which a word stays within half of its whole unit.
            let most = term_roundings_of_box(degree, width, height);
            let bits = most.next_power_of_two().ilog2();
            let error = |bits: u32| ratio(most, 2) / power_of_two(bits);
            let half = ratio(1, 2);
            assert!(error(bits) <= half && (bits == 0 || error(bits - 1) > half));
        }
    }
    // The table of docs/numerics.md.
    let sides = [(32, 32), (64, 64), (128, 128), (256, 256), (512, 512), (640, 480), (1280, 960)];
    let bits = sides.map(|(width, height)| {
        term_roundings_of_box(Degree::Quadratic, width, height).next_power_of_two().ilog2()
    });
    assert_eq!(bits, [10, 12, 14, 16, 18, 18, 20]);
    // Values of +-1 with the signs of the nodal functions: 5/3 in the middle.
    let one = node(1.0);
    let middle = function(Degree::Quadratic, [[-one; 3], [one; 3]], [1, 1, 1]);
    assert_eq!(middle, ratio(5, 3));
    assert_eq!((node(2e9), node(-2e9)), (1 << 60, -(1 << 60)));
}
