//! The share of single faults in the netlists that the lock-step comparison finds, and the names of those it does not.
//!
//! A fault that survives is handed to a prover: where no input whatever makes a difference at the ports of the unit, there is
//! nothing to find. Such a fault is named as equivalent and not counted; nothing else is taken out of the count.
//!
//! The test run takes every sixteenth fault. All of them:
//! `cargo test --release -p edgewalk-vectors mutants:: -- --ignored --nocapture`

mod cut;
mod miter;
mod proof;
mod shaded;

use crate::common;
use edgewalk_machine::{
    Blend, BlendKind, Channel, Gate, Hazard, Machine, Plan, Precision, Shadow, ShadowLight, Transmits,
};
use edgewalk_model::DrawState;
use edgewalk_netlist::mutate::mutants;
use edgewalk_vectors::{Interface, StallKind, Suite, Trace, Unit, capture, capture_tokens, design};
use proof::{Proof, prove};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Of so many faults the test run tries one; of SETUP, which is slow to run, of so many.
const SAMPLE: usize = 16;
const SAMPLE_OF_SETUP: usize = 320;

/// Least share killed of those that are not proved equivalent, in percent; what is measured is printed.
const LEAST: usize = 95;

/// Of BLEND and of DEPTH's fork.
const BLEND_LEAST: usize = 98;

/// What became of the mutants of a unit.
#[derive(Default)]
struct Tally {
    tried: usize,
    killed: usize,
    equivalent: usize,
}

#[test]
fn single_faults_are_found() {
    let step = |unit| if unit == common::SETUP { SAMPLE_OF_SETUP } else { SAMPLE };
    share_found(&machines(), step, LEAST);
}

/// Of SHADOW.
const SHADOW_LEAST: usize = 98;

#[test]
fn single_faults_of_blend_are_found() {
    share_found(&machines_with_blend(), |_| SAMPLE, LEAST);
}

#[test]
#[ignore = "minutes: each fault, every fortieth of SETUP"]
fn every_fault_is_found() {
    share_found(&machines(), |unit| if unit == common::SETUP { 40 } else { 1 }, LEAST);
}

#[test]
#[ignore = "minutes: each fault of BLEND and of DEPTH's fork"]
fn every_fault_of_blend_is_found() {
    share_found(&machines_with_blend(), |_| 1, BLEND_LEAST);
}

#[test]
#[ignore = "20 minutes: each fault of SETUP"]
fn every_fault_of_setup_is_found() {
    let machine = machine_for(common::SETUP);
    // Each half of the faults by itself, side by side.
    let tallies = common::two_at_a_time(&[0, 1], |_, first| tally(&machine, common::SETUP, *first, 2));
    judge(&tallies, BLEND_LEAST);
}

/// The prover is right: of the faults that the suites see it calls none equivalent.
#[test]
fn no_fault_that_is_seen_is_proved_equivalent() {
    let machine = machine_for(common::SPAN);
    let netlist = design::netlist(&machine, common::SPAN).expect("a checked machine");
    let interface = Interface::new(&machine, common::SPAN);
    let traces = traces(&machine, common::SPAN);
    let mut seen = 0;
    for mutant in mutants(&netlist).iter().step_by(32) {
        let device = common::native(&mutant.apply(&netlist), &interface).expect("the same ports");
        if traces.iter().any(|trace| trace.lockstep_of(&mut device.clone()).is_err()) {
            seen += 1;
            let proof = prove(&interface, &netlist, mutant, true);
            assert_ne!(proof, Proof::Equivalent, "{}: {}", mutant.module, mutant.description);
        }
    }
    println!("{seen} faults are seen and not called equivalent");
    assert!(seen >= 4);
}

fn machines() -> Vec<(Plan, Unit)> {
    let units = [common::SETUP, common::EDGE, common::SPAN, common::PIXEL, common::DEPTH];
    units.map(|unit| (machine_for(unit), unit)).to_vec()
}

/// BLEND with each policy and number of multipliers, and DEPTH's fork.
fn machines_with_blend() -> Vec<(Plan, Unit)> {
    let kinds = [
        (common::BLEND, Hazard::Forward, 3, 1),
        (common::BLEND, Hazard::Interlock, 1, 2),
        (common::BLEND, Hazard::Drain, 0, 1),
        (common::DEPTH, Hazard::Forward, 3, 1),
        (common::DEPTH, Hazard::Drain, 3, 1),
    ];
    let each = |(unit, hazard, multipliers, stages)| {
        let mut machine = Machine::clone(&machine_for(common::DEPTH));
        let blend = Blend { kind: BlendKind::Constant, kt_bits: 4, queue: 3, hazard, ..machine.blend };
        machine.blend = Blend { multipliers, stages, ..blend };
        machine.hazard = hazard;
        machine.color.bits = if unit == common::BLEND { 3 } else { 2 };
        (machine.plan().expect("can be built"), unit)
    };
    kinds.map(each).to_vec()
}

/// SHADOW with each gate, a side that is a power of two and one that is not, a map that transmits.
fn machines_with_shadow() -> Vec<(Plan, Unit)> {
    let kinds = [
        ([4, 1, 4], Gate::And, 3, Transmits::No),
        ([3, 1, 4], Gate::Scale, 2, Transmits::No),
        ([3, 1, 4], Gate::Scale, 2, Transmits::Yes),
    ];
    let each = |([size, guard_bits, depth_bits], gate, queue, transmits): ([u32; 3], Gate, u32, _)| {
        let mut machine = Machine::clone(&machine_for(common::DEPTH));
        let light = Shadow { light: ShadowLight::Parallel, size, guard_bits, depth_bits, ..machine.shadow };
        machine.shadow = Shadow { gate, queue, transmits, fraction: 8, vertex_fraction: 2, ..light };
        (machine.plan().expect("can be built"), common::SHADOW)
    };
    kinds.map(each).to_vec()
}

#[test]
fn single_faults_of_shadow_are_found() {
    share_found(&machines_with_shadow(), |_| SAMPLE, LEAST);
}

#[test]
#[ignore = "minutes: each fault of SHADOW"]
fn every_fault_of_shadow_is_found() {
    share_found(&machines_with_shadow(), |_| 1, SHADOW_LEAST);
}

/// Of TERM, PIXEL's terms, TEXEL, BUMP, NORMAL, LAMP and SHADE; of PROJECT.
const SHADE_LEAST: usize = 98;

#[test]
fn single_faults_of_project_are_found() {
    share_found(&shaded::machines_with_project(), |_| SAMPLE, LEAST);
}

/// Those of the machines that shade with one of these units.
fn shaded_with(units: &[Unit]) -> Vec<(Plan, Unit)> {
    shaded::machines().into_iter().filter(|(_, unit)| units.contains(unit)).collect()
}

#[test]
fn single_faults_of_bump_are_found() {
    share_found(&shaded_with(&[common::BUMP]), |_| SAMPLE, LEAST);
}

#[test]
#[ignore = "minutes: each fault of TERM, of PIXEL with terms and of TEXEL"]
fn every_fault_of_term_is_found() {
    share_found(&shaded_with(&[common::TERM, common::PIXEL, common::TEXEL]), |_| 1, SHADE_LEAST);
}

#[test]
#[ignore = "minutes: each fault of BUMP"]
fn every_fault_of_bump_is_found() {
    share_found(&shaded_with(&[common::BUMP]), |_| 1, SHADE_LEAST);
}

#[test]
#[ignore = "minutes: each fault of NORMAL"]
fn every_fault_of_normal_is_found() {
    share_found(&shaded_with(&[common::NORMAL]), |_| 1, SHADE_LEAST);
}

#[test]
#[ignore = "minutes: each fault of LAMP"]
fn every_fault_of_lamp_is_found() {
    share_found(&shaded_with(&[common::LAMP]), |_| 1, SHADE_LEAST);
}

#[test]
#[ignore = "minutes: each fault of SHADE, by tables and multiplied"]
fn every_fault_of_shade_is_found() {
    share_found(&shaded_with(&[common::SHADE]), |_| 1, SHADE_LEAST);
}

#[test]
#[ignore = "minutes: each fault of PROJECT"]
fn every_fault_of_project_is_found() {
    share_found(&shaded::machines_with_project(), |_| 1, SHADE_LEAST);
}

/// Of each unit's faults every so manieth, as `step` says.
fn share_found(work: &[(Plan, Unit)], step: impl Fn(Unit) -> usize + Sync, least: usize) {
    let tallies = common::two_at_a_time(work, |_, (machine, unit)| {
        let tally = tally(machine, *unit, 0, step(*unit));
        let Tally { tried, killed, equivalent } = tally;
        println!("{}: killed {killed} / {}, {equivalent} equivalent", unit.name(), tried - equivalent);
        tally
    });
    judge(&tallies, least);
}

/// At least so many percent of those that are not equivalent are killed.
fn judge(tallies: &[Tally], least: usize) {
    let sum = |of: fn(&Tally) -> usize| tallies.iter().map(of).sum::<usize>();
    let (killed, equivalent) = (sum(|t| t.killed), sum(|t| t.equivalent));
    let expected = sum(|t| t.tried) - equivalent;
    let percent = 100.0 * killed as f64 / expected as f64;
    println!("killed {killed} / {expected}, {percent:.1} %; {equivalent} more are proved equivalent");
    assert!(expected >= 8);
    assert!(100 * killed >= least * expected, "only {killed} of {expected} killed");
}

/// SETUP has four lanes, so that the area may be the last to be known; edges often do not fit, as there are few sub-pixels, and are
/// doubled in one clock; z is doubled an odd number of times, and more often than the others. What DEPTH carries is short: the prover then sees
/// through four fragments in flight.
fn machine_for(unit: Unit) -> Plan {
    let small = common::small();
    if unit == common::SETUP {
        let z = Precision { fraction: small.z.fraction + 3, ..small.z };
        return Machine { z, lanes: 4, subpixel_bits: 2, ..Machine::clone(&small) }
            .plan()
            .expect("can be built");
    }
    if unit != common::DEPTH {
        return small;
    }
    Machine {
        width: 8,
        height: 4,
        guard_bits: 4,
        z: Precision { bits: 4, ..small.z },
        color: Precision { bits: 2, ..small.color },
        ..Machine::clone(&small)
    }
    .plan()
    .expect("can be built")
}

/// What becomes of every so manieth fault from one on.
fn tally(machine: &Plan, unit: Unit, first: usize, step: usize) -> Tally {
    let netlist = design::netlist(machine, unit).expect("a checked machine");
    let interface = Interface::new(machine, unit);
    let traces = traces(machine, unit);
    for trace in &traces {
        common::lockstep(trace, &netlist).expect("the netlist without a fault agrees");
    }
    let mut tally = Tally::default();
    let mutants = mutants(&netlist);
    let all = mutants.len().saturating_sub(first).div_ceil(step);
    for mutant in mutants.iter().skip(first).step_by(step) {
        let faulty = mutant.apply(&netlist);
        // A long run that is ended before its time has said how far it came.
        if tally.tried > 0 && tally.tried % 50 == 0 {
            println!("{}: {} / {all} tried, killed {}", unit.name(), tally.tried, tally.killed);
        }
        tally.tried += 1;
        let device = common::native(&faulty, &interface).expect("the same ports");
        if traces.iter().any(|trace| trace.lockstep_of(&mut device.clone()).is_err()) {
            tally.killed += 1;
            continue;
        }
        let verdict = match prove(&interface, &netlist, mutant, unit != common::SETUP) {
            Proof::Equivalent => {
                tally.equivalent += 1;
                "equivalent (proved by pdr)"
            }
            Proof::Differs => "survives, though there are inputs that show it",
            Proof::Unknown => "survives; neither proved nor refuted",
        };
        println!("  {}: {verdict}: {}: {}", unit.name(), mutant.module, mutant.description);
    }
    tally
}

/// What a unit's mutants are tried with.
fn traces(machine: &Plan, unit: Unit) -> Vec<Trace> {
    let names: &[&str] =
        if unit == common::SETUP { &["corners", "random"] } else { &["hazards", "corners", "random"] };
    let suites = names.iter().map(|name| Suite::named(machine, name, 1, 24).expect("listed"));
    let suite = Suite::joined("mutants", "all that is directed, and some at random", suites);
    let half = suite.clone().on_half_depth(machine);
    // Only DEPTH looks at the function and the write mask.
    let functions = match unit.name() {
        "depth" => 0..8,
        // Under always most comes to it.
        "blend" => 7..8,
        _ => 1..2,
    };
    let mut traces = Vec::new();
    for depth_func in functions {
        for stalls in StallKind::ALL {
            let state = DrawState { depth_func, ..suite.state() };
            let suite = if depth_func & 4 != 0 { &half } else { &suite };
            traces.push(capture(machine, unit, suite, state, stalls));
        }
    }
    let masked = DrawState { depth_write: false, ..suite.state() };
    traces.push(capture(machine, unit, &suite, masked, StallKind::Mixed));
    if machine.blend.is_there() && unit == common::DEPTH {
        let unwritten = DrawState { color_write: false, ..DrawState::default() };
        traces.push(capture(machine, unit, &suite, unwritten, StallKind::Mixed));
    }
    match unit.name() {
        "shadow" => {
            for name in ["light", "light_off"] {
                let suite = Suite::named(machine, name, 1, 24).expect("listed");
                traces.push(capture(machine, unit, &suite, suite.state(), suite.stalls));
            }
            let any = [StallKind::Mixed, StallKind::None, StallKind::Late].into_iter().zip(1..);
            let any: Vec<_> =
                any.map(|(stalls, seed)| any_fragments(machine, &traces[1], stalls, seed)).collect();
            traces.extend(any);
        }
        "term" | "texel" | "bump" | "normal" | "lamp" | "shade" | "project" => {
            let own = if unit == common::PROJECT { "light" } else { "shade" };
            let suite = Suite::named(machine, own, 1, 24).expect("listed");
            // The directed words once, the rest at random: whole suites under every stall take long.
            traces.truncate(1);
            for stalls in [StallKind::Mixed, StallKind::Late] {
                traces.push(capture(machine, unit, &suite, suite.state(), stalls));
            }
            let any = StallKind::ALL.into_iter().zip(1..);
            let any: Vec<_> = any
                .map(|(stalls, seed)| shaded::any_tokens(machine, &traces[0], 0.05, stalls, seed))
                .collect();
            traces.extend(any);
            // First, as they are few, tokens of one material, so that a reset finds fragments inside.
            traces.insert(0, shaded::any_tokens(machine, &traces[0], 0.0, StallKind::None, 7));
        }
        "setup" => {
            let far = far(machine);
            let cut = [8, 60].map(|each| cut_often(&far, each));
            traces.extend([specks(machine), far, halves(machine)].into_iter().chain(cut));
        }
        "span" => traces.extend((1..=4).map(|seed| any_lines(machine, &traces[1], seed)).collect::<Vec<_>>()),
        "blend" => {
            let kinds = [(false, StallKind::Mixed), (true, StallKind::Mixed), (false, StallKind::None)];
            let any = kinds
                .into_iter()
                .zip(1..)
                .map(|((add, stalls), seed)| any_passes(machine, &traces[1], add, stalls, seed));
            let any: Vec<_> = any.collect();
            traces.extend(any);
        }
        _ => {}
    }
    traces
}

/// Triangles of a few sub-pixels around a pixel's centre: their areas are the small divisors that meet halves. Values of half of
/// them differ by as little or not at all, so that the area itself is the modulus, even or odd.
fn specks(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let scale = f64::from(1 << machine.subpixel_bits);
    let vertex = |random: &mut Pcg64Mcg, n: usize| {
        let mut at = || 2.5 + f64::from(random.random_range(-3..=3)) / scale;
        let at = (at(), at());
        let value = |channel: &Channel| {
            let few =
                |bits: u32| f64::from(bits) / f64::from(1 << channel.vertex_fraction) / channel.host_unit();
            match n % 4 {
                0 => few(random.random_range(0..=3)),
                2 => few(1),
                _ => channel.host_range().1 * random.random::<f64>(),
            }
        };
        let values: Vec<f64> = machine.channels().iter().map(value).collect();
        machine.port_vertex(at.0, at.1, &values).expect("inside")
    };
    let triangle = |n| std::array::from_fn(|_| vertex(&mut random, n));
    let triangles = (0..300).map(triangle).collect();
    let suite = Suite::of_triangles("specks", "areas of few sub-pixels", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}

/// Triangles with corners at the ends of the guard band, half of them only there, and values at their ends or anywhere: the widest differences,
/// areas and steps that the words of SETUP have to hold.
fn far(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let limit = f64::from((1u32 << machine.guard_bits) - 1);
    let vertex = |random: &mut Pcg64Mcg, kinds: u32, ends: bool| {
        let mut at = || match random.random_range(0..kinds) {
            0 => -limit,
            1 => limit,
            _ => random.random_range(-limit..=limit),
        };
        let at = (at(), at());
        let channels = machine.channels().len();
        let values: Vec<f64> = if ends {
            (0..channels).map(|_| f64::from(random.random_range(0..=1u8))).collect()
        } else {
            (0..channels).map(|_| random.random()).collect()
        };
        machine.port_vertex(at.0, at.1, &values).expect("inside")
    };
    let triangle =
        |n| std::array::from_fn(|_| vertex(&mut random, if n % 2 == 0 { 2 } else { 4 }, n / 2 % 2 == 0));
    let triangles = (0..400).map(triangle).collect();
    let suite = Suite::of_triangles("far", "as far and as steep as can be", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}

/// The same, with a reset in so many cycles or so: one comes in every state of the work.
fn cut_often(of: &Trace, each: u64) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(4);
    let mut trace = of.clone();
    trace.setting.resets = (0..of.cycles).filter(|_| random.random_range(0..each) == 0).collect();
    trace
}

/// Triangles whose area is a power of two: their quotients are ties as often as can be.
fn halves(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let scale = 1 << machine.subpixel_bits;
    let triangle = |_| {
        let at = loop {
            let at: [[i64; 2]; 3] =
                std::array::from_fn(|_| [0; 2].map(|_| random.random_range(0..32 * scale)));
            let [u, v] = [1, 2].map(|i| [0, 1].map(|axis| at[i][axis] - at[0][axis]));
            let area = (u[0] * v[1] - u[1] * v[0]).unsigned_abs();
            if area.is_power_of_two() && area >= 1 << (machine.z.fraction - 2) {
                break at;
            }
        };
        at.map(|at| {
            let [x, y] = at.map(|at| at as f64 / scale as f64);
            let values: Vec<f64> = machine.channels().iter().map(|_| random.random()).collect();
            machine.port_vertex(x, y, &values).expect("inside")
        })
    };
    let triangles = (0..100).map(triangle).collect();
    let suite = Suite::of_triangles("halves", "areas that are powers of two", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}

/// As many lines, with flags that no EDGE gives, half of them somewhere around the screen: many are empty.
fn any_lines(machine: &Plan, of: &Trace, seed: u64) -> Trace {
    let line = &of.interface.links[0];
    let place = |field| line.place(field).expect("a line has it");
    let flags = ["fresh", "fence"].map(place);
    let ends = ["cmaj", "cmin"].map(place);
    let column_mask = (1u128 << machine.widths().column) - 1;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        flags.iter().for_each(|flag| token[*flag] = u128::from(random.random::<bool>()));
        if random.random() {
            let column = random.random_range(-4..machine.width as i128 + 4);
            let length = random.random_range(-2..4);
            token[ends[0]] = column as u128 & column_mask;
            token[ends[1]] = (column + length) as u128 & column_mask;
        }
    }
    // A line without flags comes first: what a reset left would be seen.
    flags.iter().for_each(|flag| tokens[0][*flag] = 0);
    capture_tokens(machine, of.interface.unit, tokens, DrawState::default(), StallKind::Mixed, seed)
}

/// As many fragments around the map, as no PIXEL gives them.
fn any_fragments(machine: &Plan, of: &Trace, stalls: StallKind, seed: u64) -> Trace {
    let frag = &of.interface.links[0];
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        for (field, port) in frag.fields.iter().enumerate() {
            let number = match port.field.name.as_str() {
                "lx" | "ly" => random.random_range(-2..=i64::from(machine.shadow.size) + 1),
                "lz" => random.random_range(-2..=(1 << machine.shadow.depth_bits) + 1),
                _ => random.random_range(0..1 << port.width().min(32)),
            };
            token[field] = number as u128 & (u128::MAX >> (128 - port.width()));
        }
    }
    let ambient = random.random_range(1..=machine.color.max());
    let state = DrawState { shadow_on: true, ambient, ..DrawState::default() };
    capture_tokens(machine, of.interface.unit, tokens, state, stalls, seed)
}

/// As many fragments on three pixels, each in four with a k_t of 0, or of 1 and more, and fences as no DEPTH gives them.
fn any_passes(machine: &Plan, of: &Trace, blend_add: bool, stalls: StallKind, seed: u64) -> Trace {
    let pass = &of.interface.links[0];
    let place = |field| pass.place(field).expect("a fragment has it");
    let [addr, kt, fence] = ["addr", "kt", "fence"].map(place);
    let one = 1u128 << machine.blend.kt_bits;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        token[addr] = random.random_range(0..3);
        token[fence] = random.random_range(0..2);
        token[kt] = match random.random_range(0..4) {
            0 => 0,
            1 => one + random.random_range(0..one),
            _ => random.random_range(0..one),
        };
        for color in ["r", "g", "b"] {
            token[place(color)] = random.random_range(0..1 << machine.color.bits);
        }
    }
    let state = DrawState { blend_add, ..DrawState::default() };
    capture_tokens(machine, of.interface.unit, tokens, state, stalls, seed)
}
