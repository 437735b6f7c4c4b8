//! The share of single faults in the netlists that the lock-step comparison finds, and the names of those it does not.
//!
//! A fault that survives is handed to a prover: where no input whatever makes a difference at the ports of the unit, there is
//! nothing to find. Such a fault is named as equivalent and not counted; nothing else is taken out of the count.
//!
//! The test run takes every sixteenth fault. All of them:
//! `cargo test --release -p edgewalk-vectors mutants:: -- --ignored --nocapture`

mod setup;
mod shaded;
mod traces;

use crate::common;
use edgewalk_machine::{
    Blend, BlendKind, Dither, EdgeKind, Gate, Hazard, Lines, Machine, Plan, Precision, ScreenDoor, Shadow,
    ShadowLight, Transmits,
};
use edgewalk_netlist::Module;
use edgewalk_netlist::mutate::mutants;
use edgewalk_tool::Stop;
use edgewalk_vectors::prove::{Proof, prove};
use edgewalk_vectors::{Interface, Unit, design};
use traces::traces;

/// Of so many faults the test run tries one; of SETUP, which is slow to run, of so many.
const SAMPLE: usize = 16;
const SAMPLE_OF_SETUP: usize = 320;
/// Of POLY, whose memories keep the prover busy.
const SAMPLE_OF_POLY: usize = 160;

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

/// The prover is right: of the faults that the suites see it calls none equivalent. The machine has the shortest words.
#[test]
fn no_fault_that_is_seen_is_proved_equivalent() {
    let machine = machine_for(common::DEPTH);
    let netlist = design::netlist(&machine, common::SPAN).expect("a checked machine");
    let interface = Interface::new(&machine, common::SPAN);
    let traces = traces(&machine, common::SPAN);
    let mut seen = 0;
    for mutant in mutants(&netlist).iter().step_by(32) {
        let device = common::native(&mutant.apply(&netlist), &interface).expect("the same ports");
        if traces.iter().any(|trace| trace.lockstep_of(&mut device.clone()).is_err()) {
            seen += 1;
            let proof = prove(&interface, &netlist, mutant, true).expect("Yosys is installed");
            assert_ne!(proof, Proof::Equivalent, "{}: {}", mutant.module, mutant.description);
        }
    }
    println!("{seen} faults are seen and not called equivalent");
    assert!(seen >= 4);
}

/// A unit with EDGE's ports that takes a triangle, offers one line, and waits. With the fault its increment follows the
/// port before the next triangle is taken, in cycles in which no line is offered: the suites see that, so the prover must.
#[test]
fn values_held_too_short_are_no_equivalent() {
    let interface = Interface::new(&machine_for(common::EDGE), common::EDGE);
    let m = Module::new("holder", "");
    let inputs: Vec<_> =
        interface.inputs().iter().map(|port| (&port.name, m.input(&port.name, port.width()))).collect();
    let [prim_valid, line_ready, prim_z_g] = ["prim_valid", "line_ready", "prim_z_g"]
        .map(|name| inputs.iter().find(|(port, _)| *port == name).expect("a port of EDGE").1);
    let running = m.reg("running", 1).reset(0);
    let idle = !running.q();
    running.when(running.q() & line_ready, 0).when(idle & prim_valid, 1);
    let held = m.reg("held", prim_z_g.width());
    held.when(prim_valid, idle.mux(prim_z_g, held.q()));
    for port in interface.outputs() {
        let value = match port.name.as_str() {
            "prim_ready" => idle,
            "line_valid" => running.q(),
            "inc_z" => held.q(),
            _ => m.lit(port.width(), 0),
        };
        m.output(&port.name, value);
    }
    let netlist = m.finish().expect("a module");
    let all = mutants(&netlist);
    let wanted = "`held` is updated always instead of when `prim_valid`";
    let fault = all.iter().find(|mutant| mutant.description == wanted).expect("a fault of the register");
    assert_eq!(prove(&interface, &netlist, fault, true).expect("Yosys is installed"), Proof::Differs);
}

/// A ROM of four words of two bits behind an address that is never 3; nothing sees bit 1 of word 2.
#[test]
fn a_bit_of_a_rom_that_nobody_sees_is_equivalent() {
    let m = Module::new("fetch", "");
    let go = m.input("go", 1);
    let pc = m.reg("pc", 2).reset(0);
    pc.when(go, pc.q().eq(2).mux(0, pc.q() + 1));
    let rom = m.memory("rom", 2, 4, 2);
    [1, 2, 0, 3].into_iter().enumerate().for_each(|(row, word)| _ = rom.holds(row, word, ""));
    let word = rom.read(m.lit(1, 1), pc.q());
    let last = m.reg("last", 2).set(pc.q());
    m.output("low", word.bit(0));
    m.output("high", word.bit(1) & last.q().ne(2));
    let netlist = m.finish().expect("a module");
    let interface = Interface::new(&machine_for(common::SPAN), common::SPAN);
    let mut equivalent = Vec::new();
    for mutant in mutants(&netlist).iter().filter(|mutant| mutant.description.starts_with("bit ")) {
        let proof = prove(&interface, &netlist, mutant, false).expect("Yosys is installed");
        if proof == Proof::Equivalent {
            equivalent.push(mutant.description.clone());
        }
    }
    let word = |bit: u32, word: u32, is: u32| format!("bit {bit} of word {word} of `rom` is {is}");
    assert_eq!(equivalent, [word(1, 2, 1), word(0, 3, 0), word(1, 3, 0)]);
}

/// POLY with exact edges and lines, and with slopes.
fn machines_with_poly() -> Vec<(Plan, Unit)> {
    let each = |(kind, lines): (EdgeKind, Lines)| {
        let mut machine = Machine::clone(&common::small());
        (machine.polygon.edges, machine.polygon.lines) = (8, lines);
        (machine.edge_kind, machine.edge_fraction) = (kind, 10);
        (machine.plan().expect("can be built"), common::POLY)
    };
    [(EdgeKind::Exact, Lines::Yes), (EdgeKind::Slope, Lines::No)].map(each).to_vec()
}

/// Of POLY.
const POLY_LEAST: usize = 98;

#[test]
fn single_faults_of_poly_are_found() {
    share_found(&machines_with_poly(), |_| SAMPLE_OF_POLY, LEAST);
}

#[test]
#[ignore = "minutes: each fault of POLY"]
fn every_fault_of_poly_is_found() {
    share_found(&machines_with_poly(), |_| 1, POLY_LEAST);
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

/// DITHER with a screen door, bits cut or not.
fn machines_with_dither() -> Vec<(Plan, Unit)> {
    let each = |[color, bits, kt_bits]: [u32; 3]| {
        let mut machine = Machine::clone(&machine_for(common::DEPTH));
        machine.color.bits = color;
        machine.dither = Dither { bits, screen_door: ScreenDoor::Yes };
        machine.blend.kt_bits = kt_bits;
        (machine.plan().expect("can be built"), common::DITHER)
    };
    [[7, 4, 5], [9, 4, 4], [3, 0, 6]].map(each).to_vec()
}

#[test]
fn every_fault_of_dither_is_found() {
    share_found(&machines_with_dither(), |_| 1, BLEND_LEAST);
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
        let proof = match prove(&interface, &netlist, mutant, unit != common::SETUP) {
            // On a busy machine the prover may reach the limit of a tool first.
            Err(Stop::TimeLimit { .. }) => Proof::Unknown,
            proof => proof.expect("Yosys is installed"),
        };
        let verdict = match proof {
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
