//! The printed Verilog computes what the netlist means: in Icarus and in Verilator, for every operator and for random
//! modules, bit by bit and cycle by cycle.
#![allow(clippy::unwrap_used)] // a test may

mod random_module;
mod tools;

use edgewalk_netlist::mutate::mutants;
use edgewalk_netlist::{Module, Signal};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tools::bench::{Bench, Case, WARM_UP};

/// Cycles of every case.
const CYCLES: usize = WARM_UP + 64;

/// Half the time one of 0, 1, 2, the largest, and both sides of the sign change.
fn corner_or_any(random: &mut Pcg64Mcg, width: u32) -> u128 {
    let mask = u128::MAX >> (128 - width);
    let half = 1 << (width - 1);
    let corners = [0, 1, 2 & mask, mask, half, half - 1];
    if random.random() {
        corners[random.random_range(0..corners.len())]
    } else {
        random.random::<u128>() & mask
    }
}

/// No difference in either simulator, over at least so many values.
fn agree(cases: &[Case], lint_waivers: &[&str], at_least: usize) {
    let bench = Bench::new(cases, |case| case.netlist.clone());
    bench.lint(lint_waivers);
    println!("{} values compared in each simulator", bench.values());
    assert!(bench.values() >= at_least, "only {} values", bench.values());
    assert_eq!(bench.icarus().first(), None, "Icarus");
    assert_eq!(bench.verilator().first(), None, "Verilator");
}

/// Every operator on a, b of `width` bits, n of `other` bits and the bit c, alone and beside others.
fn operators(width: u32, other: u32) -> Module {
    let m = Module::new(&format!("operators_{width}_{other}"), "Every operator, alone and inside others.");
    let (a, b) = (m.input("a", width), m.input("b", width));
    let (n, c) = (m.input("n", other), m.input("c", 1));
    let (hi, lo) = (width - 1 - width / 4, width / 3);
    let by = width.div_ceil(3);
    let distance = n.trunc(other.min(16));
    let outputs: Vec<Signal> = vec![
        a + b,
        a - b,
        -a,
        a & b,
        a | b,
        a ^ b,
        !a,
        a.eq(b),
        a.ne(b),
        a.lt(b),
        a.le(b),
        a.gt(b),
        a.ge(b),
        a.slt(b),
        a.sle(b),
        a.sgt(b),
        a.sge(b),
        c.mux(a, b),
        a.shl(by),
        a.shr(by),
        a.sar(by),
        a.shl(width),
        a.shr(width),
        a.sar(width + 1),
        a.shl_by(distance),
        a.shr_by(distance),
        a.sar_by(distance),
        a.slice(hi, lo),
        a.any(),
        a.all(),
        a.parity(),
        a.zext((width + other).min(128)),
        a.sext((width + other).min(128)),
        // Where Verilog would widen or forget a sign.
        (a + b).shr(1),
        (a - b).sar(by) + b,
        (a + b).lt(b),
        (-a).zext(width.max(100)),
        (!a).zext(128).shr(1),
        (a + b).slice(hi, lo),
        (a ^ b).sext(128),
        (a.sar(1) - b.sar(by)).slt(a.sar(1)),
        (a + b).sar(1).sar(1),
        c.mux(a.sar(1), b) + 1,
        c.mux(c.mux(a, b), a + b),
        a - (b - (a - 1)),
        a - b + a - b,
        -(-a),
        !(!a & b),
        (a.sar(1).sle(b) ^ a.slt(b)) & c,
        m.cat(&[a.sar(1).bit(0), c]),
        (a.shl(1) | b).parity() | (a & b).all(),
        a.lt(0),
        a.ge(0),
        a.slt(0),
        a.sge(-1),
        a.eq(0),
        a.le(u128::MAX >> (128 - width)),
        a.sgt((1 << (width - 1)) - 1u128),
        a.shl_by(distance).shr_by(distance).sar_by(n.bit(0)),
        m.lit(width, 1).shl_by(distance),
    ];
    for (index, signal) in outputs.into_iter().enumerate() {
        m.output(&format!("q{index}"), signal);
    }
    if width + other <= 128 {
        m.output("product", a * n);
        m.output("signed_product", a.smul(n));
        m.output("of_sums", (a + b) * (n + 1));
        m.output("signed_of_sums", (a - b).smul(-n).sar(1));
        m.output("products", a * n + n * b + a.smul(n));
    }
    if width + other < 128 {
        m.output("joined", m.cat(&[a + b, -n, c]));
    }
    m
}

#[test]
fn every_operator_in_both_simulators() {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let widths = [1, 2, 3, 4, 5, 7, 8, 9, 16, 22, 31, 32, 33, 38, 63, 64, 65, 95, 97, 127, 128];
    let cases: Vec<Case> = widths
        .iter()
        .map(|&width| {
            let other = if width < 128 { random.random_range(1..=(128 - width).min(40)) } else { 7 };
            let inputs = [width, width, other, 1];
            let mut stimulus = || inputs.map(|width| corner_or_any(&mut random, width)).to_vec();
            let stimuli = (0..CYCLES).map(|_| stimulus()).collect();
            Case { netlist: operators(width, other).finish().unwrap(), stimuli }
        })
        .collect();
    agree(&cases, &[], 80_000);
}

/// A random hierarchy with random inputs, reset while it warms up and now and then.
fn random_case(random: &mut Pcg64Mcg, name: &str) -> Case {
    let netlist = random_module::hierarchy(random, name);
    let widths: Vec<u32> = netlist.inputs.iter().map(|input| netlist.width(input.node)).collect();
    let mut cycle = |cycle: usize| {
        let warm = cycle < WARM_UP;
        let rst = netlist.has_reset.then(|| u128::from(warm || random.random_bool(0.03)));
        // The first input is `go`, which keeps unknown values from being written while warming up.
        let go = u128::from(!warm);
        let rest = widths[1..].iter().map(|width| corner_or_any(random, *width));
        rst.into_iter().chain([go]).chain(rest).collect()
    };
    let stimuli = (0..CYCLES).map(&mut cycle).collect();
    Case { netlist, stimuli }
}

#[test]
fn random_modules_in_both_simulators() {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let cases: Vec<Case> = (0..8).map(|index| random_case(&mut random, &format!("random_{index}"))).collect();
    // A random module compares what Verilator finds to be constant three operators away; a person would not.
    agree(&cases, &["-Wno-UNSIGNED", "-Wno-CMPCONST"], 3_500);
}

/// The comparison is worth something: where the interpreter sees a mutant, so does the bench, and only there.
#[test]
fn a_fault_in_the_text_is_seen() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let original = [random_case(&mut random, "original")];
    let expected = original[0].expected();
    let mutants = mutants(&original[0].netlist);
    // Without its reset, or without `go`, what is unknown in Verilog stays unknown: that is another matter.
    let starts = |text: &str| !text.ends_with("is not reset") && !text.contains("go");
    let mutants: Vec<_> = mutants.iter().filter(|mutant| starts(&mutant.description)).collect();
    let (mut seen, mut equivalent) = (0, 0);
    for mutant in mutants.iter().step_by(mutants.len().div_ceil(36)) {
        let netlist = mutant.apply(&original[0].netlist);
        let changed = Case { netlist: netlist.clone(), stimuli: original[0].stimuli.clone() };
        let differs = changed.expected()[WARM_UP..] != expected[WARM_UP..];
        let found = Bench::new(&original, |_| netlist.clone()).icarus();
        assert_eq!(!found.is_empty(), differs, "{}: {}", mutant.module, mutant.description);
        *(if differs { &mut seen } else { &mut equivalent }) += 1;
    }
    println!("{seen} mutants seen, {equivalent} make no difference here");
    assert!(seen >= 12, "only {seen} of {}", seen + equivalent);
}
