//! Mutants change what the netlist does, one place at a time, and leave the original alone.
#![allow(clippy::unwrap_used)] // a test may

use std::sync::Arc;

use edgewalk_netlist::mutate::{DIFFERS, Mutant, mutants};
use edgewalk_netlist::{Module, Netlist, Simulator};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A stepping value in a module of its own, and a comparison around it.
fn machine() -> Arc<Netlist> {
    let m = Module::new("dda", "");
    let (load, init, slope_in) = (m.input("load", 1), m.input("init", 6), m.input("slope", 6));
    let slope = m.reg("held", 6).reset(0).when(load, slope_in);
    let value = m.reg("value", 6).reset(5);
    value.set(value.q() + slope.q()).when(load, init);
    m.output("q", value);
    let dda = m.finish().unwrap();

    let m = Module::new("top", "");
    let (load, a, b) = (m.input("load", 1), m.input("a", 6), m.input("b", 6));
    let unit = m.instance("u_dda", &dda).connect("load", load).connect("init", a).connect("slope", b);
    let q = unit.output("q").named("q_now");
    let ram = m.memory("ram", 2, 4, 6).starts(3).write(load, q.trunc(2), q);
    let old = ram.read(!load, b.slice(4, 3));
    m.output("below", q.slt(old));
    m.output("shown", load.mux(q, old.sar(1)) + 1);
    m.finish().unwrap()
}

/// The outputs of a few hundred random cycles, with a fresh start now and then.
fn behaviour(netlist: &Netlist) -> Vec<u128> {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let mut sim = Simulator::new(netlist);
    let mut shown = Vec::new();
    for cycle in 0..600 {
        if cycle % 20 == 0 {
            sim = Simulator::new(netlist);
        }
        sim.set_input("rst", u128::from(random.random_bool(0.1))).unwrap();
        sim.set_input("load", u128::from(random.random_bool(0.3))).unwrap();
        sim.set_input("a", random.random_range(0..64)).unwrap();
        sim.set_input("b", random.random_range(0..64)).unwrap();
        shown.extend(["below", "shown"].map(|name| sim.get(name).unwrap()));
        sim.tick();
    }
    shown
}

#[test]
fn every_mutant_behaves_differently() {
    let original = machine();
    let expected = behaviour(&original);
    let mutants = mutants(&original);
    let alive: Vec<String> = mutants
        .iter()
        .filter(|mutant| behaviour(&mutant.apply(&original)) == expected)
        .map(|mutant| format!("{}: {}", mutant.module, mutant.description))
        .collect();
    assert_eq!(alive, [] as [&str; 0]);
    assert_eq!(mutants.len(), 8 + 12, "counted by hand, in dda and top");
    assert_eq!(behaviour(&original), expected, "the original is as it was");
}

#[test]
fn descriptions_are_words() {
    let all: Vec<String> = mutants(&machine()).into_iter().map(|mutant| mutant.description).collect();
    for wanted in [
        "`Add(value, held)` becomes `Sub(value, held)`",
        "`held` is updated always instead of when `load`",
        "`value` is reset to 4 instead of 5",
        "`held` is not reset",
        "`ram` starts with 2 instead of 3",
        "`init` and `slope` of `u_dda` are exchanged",
    ] {
        assert!(all.iter().any(|description| description == wanted), "{wanted} in {all:#?}");
    }
    let constant = "`1` becomes `2` in `Add(";
    assert!(all.iter().any(|description| description.starts_with(constant)), "{constant} in {all:#?}");
}

#[test]
fn a_mutant_still_is_a_netlist_of_shared_modules() {
    let original = machine();
    for mutant in mutants(&original) {
        let names: Vec<String> =
            mutant.apply(&original).modules().iter().map(|module| module.name.clone()).collect();
        assert_eq!(names, ["dda", "top"], "{}", mutant.description);
    }
}

/// A RAM with a row of its own, read and written by turns, and a ROM.
fn contents() -> Arc<Netlist> {
    let m = Module::new("contents", "");
    let (load, a, b) = (m.input("load", 1), m.input("a", 2), m.input("b", 3));
    let ram = m.memory("ram", 2, 3, 3).holds(1, 5, "five").write(load, a, b);
    let rom = m.memory("rom", 1, 2, 2).holds(0, 2, "").holds(1, 1, "");
    m.output("ram_q", ram.read(!load, a));
    m.output("rom_q", rom.read(load, b.bit(2)));
    m.finish().unwrap()
}

#[test]
fn every_bit_of_contents_is_a_mutant() {
    let original = contents();
    let of_contents = |text: &str| text.starts_with("bit ");
    let mutants: Vec<Mutant> =
        mutants(&original).into_iter().filter(|mutant| of_contents(&mutant.description)).collect();
    let texts: Vec<&str> = mutants.iter().map(|mutant| mutant.description.as_str()).collect();
    assert_eq!(texts[..2], ["bit 0 of word 1 of `ram` is 0", "bit 1 of word 1 of `ram` is 1"]);
    assert_eq!(texts[6], "bit 1 of word 1 of `rom` is 1");
    assert_eq!(texts.len(), 3 + 2 * 2);
    for mutant in mutants {
        let (faulty, mut differ) = (mutant.apply(&original), Vec::new());
        let mut sims = [Simulator::new(&original), Simulator::new(&faulty)];
        // Both words of the ROM, then the row of the RAM.
        for (load, a, b) in [(1, 0, 0), (1, 0, 4), (0, 1, 0)] {
            let shown = sims.each_mut().map(|sim| {
                [("load", load), ("a", a), ("b", b)]
                    .iter()
                    .for_each(|(name, value)| sim.set_input(name, *value).unwrap());
                sim.tick();
                (sim.get("ram_q").unwrap(), sim.get("rom_q").unwrap())
            });
            differ.push(shown[0] != shown[1]);
        }
        assert!(differ.contains(&true), "{}", mutant.description);
    }
}

/// The fault of that description.
fn fault(netlist: &Arc<Netlist>, description: &str) -> Mutant {
    let all = mutants(netlist);
    let found = all.into_iter().find(|mutant| mutant.description == description);
    found.unwrap_or_else(|| panic!("no fault {description}"))
}

/// A comparison and what it is told to hold, twice side by side.
fn twice() -> Arc<Netlist> {
    let m = Module::new("part", "");
    let (load, a, b) = (m.input("load", 1), m.input("a", 3), m.input("b", 3));
    m.output("less", a.lt(b));
    m.output("held", m.reg("held", 3).reset(0).when(load, a));
    let part = m.finish().unwrap();

    let m = Module::new("top", "");
    let (load, a, b, c) = (m.input("load", 1), m.input("a", 3), m.input("b", 3), m.input("c", 3));
    for (name, [a, b]) in [("one", [a, b]), ("two", [b, c])] {
        let unit = m.instance(&format!("u_{name}"), &part);
        unit.connect("load", load).connect("a", a).connect("b", b);
        m.output(&format!("less_{name}"), unit.output("less"));
        m.output(&format!("held_{name}"), unit.output("held"));
    }
    m.finish().unwrap()
}

/// Whether a fault counts with this load, a, b and held.
type Counts<'f> = &'f dyn Fn([u128; 4]) -> bool;

/// By hand: a node's value is another, or what a register takes, in either of the two modules.
#[test]
fn a_watched_fault_says_in_which_cycles_it_counts() {
    let original = twice();
    let signed = |x: u128| if x < 4 { x as i32 } else { x as i32 - 8 };
    let le = |[_, a, b, _]: [u128; 4]| a == b;
    let signs = |[_, a, b, _]: [u128; 4]| (a < b) != (signed(a) < signed(b));
    let always = |[load, a, _, held]: [u128; 4]| load == 0 && a != held;
    let faults: [(&str, Counts); 3] = [
        ("`Lt(a, b)` becomes `Le(a, b)`", &le),
        ("`Lt(a, b)` becomes `LtSigned(a, b)`", &signs),
        ("`held` is updated always instead of when `load`", &always),
    ];
    for (description, differs) in faults {
        let watched = fault(&original, description).watched(&original).expect(description);
        let (mut plain, mut sim) = (Simulator::new(&original), Simulator::new(&watched));
        let mut random = Pcg64Mcg::seed_from_u64(4);
        let (mut in_one, mut in_two) = (0, 0);
        for _ in 0..2000 {
            let inputs = [("load", 2), ("a", 8), ("b", 8), ("c", 8)].map(|(name, values)| {
                let value = random.random_range(0..values);
                plain.set_input(name, value).unwrap();
                sim.set_input(name, value).unwrap();
                value
            });
            for output in ["less_one", "held_one", "less_two", "held_two"] {
                assert_eq!(sim.get(output), plain.get(output), "{output} without the fault: {description}");
            }
            let [load, a, b, c] = inputs;
            let held = ["held_one", "held_two"].map(|name| plain.get(name).unwrap());
            let (one, two) = (differs([load, a, b, held[0]]), differs([load, b, c, held[1]]));
            assert_eq!(sim.get(DIFFERS), Ok(u128::from(one || two)), "{description}: {inputs:?}");
            in_one += u32::from(one && !two);
            in_two += u32::from(two && !one);
            plain.tick();
            sim.tick();
        }
        assert!(in_one > 50 && in_two > 50, "{description}: {in_one}, {in_two}");
    }
    // What is neither a node nor an update that comes too often is not watched.
    assert!(fault(&original, "`held` is not reset").watched(&original).is_none());
}

/// Till a fault shows the original, watched, has told it.
#[test]
fn no_fault_shows_before_it_is_told() {
    let original = machine();
    let (mut watched, mut told) = (0, 0);
    for mutant in mutants(&original) {
        let Some(netlist) = mutant.watched(&original) else { continue };
        watched += 1;
        let faulty = mutant.apply(&original);
        let mut random = Pcg64Mcg::seed_from_u64(5);
        let mut shown = 0;
        for _ in 0..200 {
            let mut sims = [Simulator::new(&original), Simulator::new(&netlist), Simulator::new(&faulty)];
            let mut differs = false;
            for _ in 0..20 {
                for (name, values) in [("rst", 2), ("load", 2), ("a", 64), ("b", 64)] {
                    let value = random.random_range(0..values);
                    sims.iter_mut().for_each(|sim| sim.set_input(name, value).unwrap());
                }
                differs |= sims[1].get(DIFFERS) == Ok(1);
                let [plain, same, other] = &mut sims;
                let outputs = |sim: &mut Simulator| ["below", "shown"].map(|name| sim.get(name).unwrap());
                let expected = outputs(plain);
                assert_eq!(outputs(same), expected, "watched: {}", mutant.description);
                if outputs(other) != expected {
                    assert!(differs, "not told: {}: {}", mutant.module, mutant.description);
                    shown += 1;
                    break;
                }
                sims.iter_mut().for_each(Simulator::tick);
            }
        }
        assert!(shown > 0, "{}: {}", mutant.module, mutant.description);
        told += shown;
    }
    // Not four of resets, two of an update behind another, a memory's start, exchanged inputs.
    assert!(watched == 20 - 8 && told > 1000, "{told} times of {watched} faults");
}
