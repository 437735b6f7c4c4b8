//! Machines drawn at random, small enough for an interpreter.

use edgewalk_machine::{EdgeKind, Fill, Hazard, Machine, Plan, Precision};
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

/// A machine that passes its check; every key takes all kinds of values, the screen is at most 20 pixels wide and high.
pub fn random_machine(rng: &mut Pcg64Mcg) -> Plan {
    loop {
        if let Ok(plan) = draw(rng).plan() {
            return plan;
        }
    }
}

fn draw(rng: &mut Pcg64Mcg) -> Machine {
    let textbook = rng.random_bool(0.4);
    Machine {
        width: rng.random_range(1..=20),
        height: rng.random_range(1..=20),
        guard_bits: if rng.random_bool(0.1) { rng.random_range(8..=14) } else { rng.random_range(2..=6) },
        subpixel_bits: if textbook { 0 } else { rng.random_range(0..=8) },
        fill: if textbook { Fill::Textbook } else { Fill::Exact },
        edge_kind: pick(rng, &[EdgeKind::Exact, EdgeKind::Slope]),
        edge_fraction: rng.random_range(1..=30),
        z: channel(rng, 4..=32),
        color: channel(rng, 2..=16),
        adders: pick(rng, &[1, 2, 4]),
        segments: pick(rng, &[1, 2, 4]),
        lanes: pick(rng, &[1, 2, 4]),
        radix: pick(rng, &[2, 4, 16]),
        span_fifo: rng.random_range(1..=4),
        inflight: rng.random_range(1..=6),
        latency: rng.random_range(1..=8),
        hazard: pick(rng, &[Hazard::Drain, Hazard::Interlock, Hazard::Forward]),
        tag_bits: pick(rng, &[0, 1, 5, 32]),
        ..Machine::default()
    }
}

fn channel(rng: &mut Pcg64Mcg, bits: std::ops::RangeInclusive<u32>) -> Precision {
    let fraction = rng.random_range(0..=24);
    let vertex_fraction = rng.random_range(0..=16.min(fraction));
    Precision { bits: rng.random_range(bits), fraction, vertex_fraction }
}

fn pick<T: Copy>(rng: &mut Pcg64Mcg, choices: &[T]) -> T {
    #[allow(clippy::unwrap_used)] // every list above has entries
    *choices.choose(rng).unwrap()
}
