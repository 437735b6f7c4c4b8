//! The netlists against the model: every port, every cycle, on machines and triangles drawn at random.

mod common;

use common::configurations::random_machine;
use common::lockstep::{Checked, Stimulus, lockstep};
use common::probe::{Failure, Probe};
use common::triangles::{after_it, one_pixel, random_triangle};
use common::units;
use edgewalk_machine::{Fill, Hazard, Machine, Plan};
use edgewalk_model::{Stalls, setup_clocks};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Machines drawn for each suite.
const MACHINES: usize = 300;
/// Triangles drawn on whole machines, at least.
const TRIANGLES: u64 = 100_000;

fn random_stimulus(rng: &mut Pcg64Mcg) -> Stimulus {
    let mut chance = |often: f64| if rng.random_bool(often) { rng.random_range(0..200) } else { 0 };
    let (rd, data, wr, gaps) = (chance(0.5), chance(0.5), chance(0.5), chance(0.3));
    Stimulus {
        depth_func: if rng.random_bool(0.6) { 1 } else { rng.random_range(0..8) },
        depth_write: rng.random_bool(0.9),
        stalls: Stalls { seed: rng.random(), rd, data, wr },
        gaps,
        reset_at: rng.random_bool(0.3).then(|| rng.random_range(1..3000)),
        seed: rng.random(),
    }
}

fn report(all: &Checked) {
    let Checked { cycles, triangles, ports, writes, .. } = all;
    println!("{triangles} triangles, {cycles} cycles, {writes} writes, {ports} values of ports compared");
    for (corner, count) in all.coverage.counts() {
        println!("  {count:>9} {corner}");
    }
}

/// Slow machines get fewer triangles, so that each takes about the same time.
fn shares(machines: &[Plan]) -> Vec<u64> {
    let speed = |machine: &Plan| {
        let clocks = setup_clocks(machine);
        let pixels = 6 * machine.clocks_per_pixel();
        1.0 / f64::from(clocks.phase1 + clocks.phase2 + pixels)
    };
    let all: f64 = machines.iter().map(speed).sum();
    machines.iter().map(|machine| (TRIANGLES as f64 * speed(machine) / all).ceil() as u64).collect()
}

#[test]
fn whole_machines() {
    let mut rng = Pcg64Mcg::seed_from_u64(2);
    let machines: Vec<Plan> = (0..MACHINES).map(|_| random_machine(&mut rng)).collect();
    let mut all = Checked::default();
    for (machine, share) in machines.iter().zip(shares(&machines)) {
        let triangles: Vec<_> = (0..share).map(|_| random_triangle(machine, &mut rng)).collect();
        let stimulus = random_stimulus(&mut rng);
        match lockstep(machine, &triangles, &stimulus) {
            Ok(checked) => all.merge(&checked),
            Err(failure) => panic!("{failure}\n{machine:?}\n{stimulus:?}"),
        }
    }
    report(&all);
    assert!(all.triangles >= TRIANGLES && all.ports > 10 * all.cycles);
    assert_eq!(all.coverage.missing(), [""; 0], "not met");
}

/// Triangles of one pixel on one address, right behind others that end there: what the in-flight queue must get right.
#[test]
fn hazards_on_one_pixel() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let mut all = Checked::default();
    let cases = [Hazard::Drain, Hazard::Interlock, Hazard::Forward].into_iter().flat_map(|hazard| {
        [Fill::Exact, Fill::Textbook]
            .into_iter()
            .flat_map(move |fill| (1..=5).map(move |depth| (hazard, fill, depth)))
    });
    for (hazard, fill, inflight) in cases {
        let mut machine =
            Machine { width: 6, height: 6, guard_bits: 3, hazard, inflight, ..Machine::default() };
        (machine.fill, machine.lanes, machine.radix) = (fill, 4, 16);
        machine.subpixel_bits = if fill == Fill::Textbook { 0 } else { 2 };
        let machine = machine.plan().expect("can be built");
        let pairs = (0..100).flat_map(|_| {
            let first = random_triangle(&machine, &mut rng);
            [first, after_it(&machine, &mut rng, &first), one_pixel(&machine, &mut rng, 2, 3)]
        });
        let triangles: Vec<_> = pairs.collect();
        let stimulus = Stimulus { reset_at: None, gaps: 0, depth_write: true, ..random_stimulus(&mut rng) };
        match lockstep(&machine, &triangles, &stimulus) {
            Ok(checked) => all.merge(&checked),
            Err(failure) => panic!("{failure}\n{machine:?}\n{stimulus:?}"),
        }
    }
    report(&all);
    let met = &all.coverage;
    assert!(met.drain_stall > 0 && met.interlock_stall > 0, "hazards that wait were not met");
    assert!(met.forward_compare > 0, "forwarding was not met");
    assert!(met.forward_write > 0 && met.forward_used > 0, "forwarding was not met");
}

/// Runs a unit of every machine for some cycles.
fn unit(seed: u64, cycles: u64, run: fn(&Plan, u64, &mut Pcg64Mcg) -> Result<Probe, Failure>) {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let (mut ports, mut machines) = (0, 0);
    for _ in 0..MACHINES {
        let machine = random_machine(&mut rng);
        match run(&machine, cycles, &mut rng) {
            Ok(probe) => ports += probe.compared,
            Err(failure) => panic!("{failure}\n{machine:?}"),
        }
        machines += 1;
    }
    println!("{machines} of {MACHINES} machines, {cycles} cycles each, {ports} values of ports compared");
    assert!(ports > cycles * MACHINES as u64);
}

#[test]
fn setup_alone() {
    unit(11, 3000, units::setup);
}

#[test]
fn edge_alone() {
    unit(12, 2000, units::edge);
}

#[test]
fn span_alone() {
    unit(13, 2000, units::span);
}

#[test]
fn pixel_alone() {
    unit(14, 2000, units::pixel);
}

#[test]
fn depth_alone() {
    unit(15, 2000, units::depth);
}

#[test]
fn memory_alone() {
    unit(16, 2000, units::memory);
}
