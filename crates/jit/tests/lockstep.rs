//! Native code against the interpreter on random modules: every signal, every word, every cycle.
#![allow(clippy::unwrap_used)] // a test may

mod common {
    pub mod free_running;
    pub mod carry;
    pub mod enables;
    pub mod named;
    pub mod pair;
    pub mod ram;
    pub mod signed;
    pub mod twins;
    pub mod units;
}
#[path = "../../verilog/tests/random_module"]
mod random {
    #[path = "mod.rs"]
    pub mod module;
}

use common::pair::Pair;
use edgewalk_netlist::Netlist;
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// Runs both for so many cycles with random inputs and resets now and then; returns how many values were compared.
fn compare(netlist: &Netlist, random: &mut Pcg64Mcg, cycles: u64) -> u64 {
    let mut pair = Pair::new(netlist);
    for cycle in 0..cycles {
        for input in &netlist.inputs {
            pair.set(&input.name, corner_or_any(random, netlist.width(input.node)));
        }
        if netlist.has_reset {
            pair.set("rst", u128::from(cycle == 0 || random.random_bool(0.02)));
        }
        // Without a look between clocks now and then: a look must change nothing.
        if random.random_bool(0.7) {
            pair.compare(cycle);
        }
        pair.tick(cycle);
    }
    pair.compare(cycles);
    pair.compared
}

/// Half the time one of 0, 1, the largest, and both sides of the sign change.
fn corner_or_any(random: &mut Pcg64Mcg, width: u32) -> u128 {
    let mask = u128::MAX >> (128 - width);
    let half = 1 << (width - 1);
    let corners = [0, 1, mask, half, half - 1];
    if random.random() {
        corners[random.random_range(0..corners.len())]
    } else {
        random.random::<u128>() & mask
    }
}

#[test]
fn random_hierarchies() {
    let mut random = Pcg64Mcg::new(2);
    let compared: u64 = (0..30)
        .map(|index| {
            let netlist = random::module::hierarchy(&mut random, &format!("top{index}"));
            compare(&netlist, &mut random, 100)
        })
        .sum();
    println!("{compared} values compared");
    assert!(compared > 500_000);
}

#[test]
fn registers_that_share_enables() {
    let mut random = Pcg64Mcg::new(3);
    let compared: u64 =
        (0..60).map(|_| compare(&common::enables::module(&mut random), &mut random, 200)).sum();
    println!("{compared} values compared");
    assert!(compared > 300_000);
}

/// Words of every size in the state; few words, so that reads and writes meet.
#[test]
fn memory_collisions() {
    let mut random = Pcg64Mcg::new(4);
    let widths = [1, 7, 8, 9, 16, 17, 32, 33, 64, 65, 128];
    let mut compared = 0;
    for width in widths {
        for known in [true, false] {
            compared += compare(&common::ram::module(width, known), &mut random, 500);
        }
    }
    println!("{compared} values compared");
    assert!(compared > 100_000);
}

/// Inputs that stay for a while, till all has come to rest; then one of them changes, or there is a reset.
#[test]
fn units_that_stand_still() {
    let mut random = Pcg64Mcg::new(5);
    let netlist = common::units::module();
    let mut pair = Pair::new(&netlist);
    let mut cycle = 0;
    for _ in 0..600 {
        let input = &netlist.inputs[random.random_range(0..netlist.inputs.len())];
        pair.set(&input.name, corner_or_any(&mut random, netlist.width(input.node)));
        pair.set("rst", u128::from(random.random_bool(0.05)));
        for _ in 0..random.random_range(1..=60) {
            pair.compare(cycle);
            pair.tick(cycle);
            pair.set("rst", 0);
            cycle += 1;
        }
    }
    println!("{} values compared", pair.compared);
    assert!(pair.compared > 300_000);
}

/// Counters that run on while their unit stands still, and registers that stand still while it works.
#[test]
fn free_running_and_calm_registers_agree() {
    let mut random = Pcg64Mcg::new(9);
    let mut compared = 0;
    for _ in 0..60 {
        let mut pair = Pair::new(&common::free_running::module(&mut random));
        let mut cycle = 0;
        for _ in 0..25 {
            let [go, load] = [0.4, 0.3].map(|often| random.random_bool(often));
            pair.set("data", random.random_range(0..512));
            pair.set("go", go.into());
            pair.set("load", load.into());
            for _ in 0..random.random_range(1..=120) {
                pair.compare(cycle);
                pair.tick(cycle);
                if random.random_bool(0.8) {
                    pair.set("go", 0);
                    pair.set("load", 0);
                }
                cycle += 1;
            }
        }
        compared += pair.compared;
    }
    println!("{compared} values compared");
    assert!(compared > 1_000_000);
}

#[test]
fn sums_with_a_carry() {
    let mut random = Pcg64Mcg::new(6);
    let widths = [1, 2, 7, 31, 32, 46, 63, 64, 65, 127];
    let compared: u64 =
        widths.iter().map(|width| compare(&common::carry::module(*width), &mut random, 300)).sum();
    println!("{compared} values compared");
    assert!(compared > 30_000);
}

#[test]
fn sums_of_signed_registers() {
    let mut random = Pcg64Mcg::new(7);
    let compared: u64 =
        (0..60).map(|_| compare(&common::signed::module(&mut random), &mut random, 200)).sum();
    println!("{compared} values compared");
    assert!(compared > 500_000);
}

/// Choices among registers, queues, and logic of bits.
#[test]
fn registers_that_a_number_names() {
    let mut random = Pcg64Mcg::new(10);
    let compared: u64 =
        (0..100).map(|_| compare(&common::named::module(&mut random), &mut random, 200)).sum();
    println!("{compared} values compared");
    assert!(compared > 1_000_000);
}

/// A unit of a longer way than it could wait for works on all the time.
#[test]
fn a_way_of_a_thousand_registers() {
    let m = edgewalk_netlist::Module::new("way", "");
    let first = m.input("first", 9);
    let last = (0..1000).fold(first, |last, i| m.reg(&format!("r{i}"), 9).set(last + 1).q());
    m.output("last", last);
    let netlist = m.finish().unwrap();
    let mut pair = Pair::new(&netlist);
    for (cycle, value) in [3, 300, 300].into_iter().flat_map(|value| [value; 700]).enumerate() {
        pair.set("first", value);
        pair.tick(cycle as u64);
    }
    println!("{} values compared", pair.compared);
    assert_eq!(pair.compared, 2100);
}

/// Equal registers are at one place in the state, others are not, and all are as in the interpreter.
#[test]
fn equal_registers() {
    let mut random = Pcg64Mcg::new(8);
    let netlist = common::twins::module();
    let compared = compare(&netlist, &mut random, 2000);
    println!("{compared} values compared");
    assert!(compared > 30_000);
    let simulator = edgewalk_jit::Simulator::new(&netlist).unwrap();
    let is_one = |name: &&str| {
        simulator.signal(&format!("{name}0")).unwrap() == simulator.signal(&format!("{name}1")).unwrap()
    };
    let (equal, other) = (common::twins::EQUAL, common::twins::OTHER);
    assert_eq!(equal.iter().filter(|name| is_one(name)).count(), equal.len());
    assert_eq!(other.iter().filter(|name| is_one(name)).count(), 0);
}
