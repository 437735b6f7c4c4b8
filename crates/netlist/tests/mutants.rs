//! Mutants change what the netlist does, one place at a time, and leave the original alone.
#![allow(clippy::unwrap_used)] // a test may

use std::sync::Arc;

use edgewalk_netlist::mutate::mutants;
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
