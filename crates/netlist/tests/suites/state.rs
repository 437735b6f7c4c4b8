//! Registers, memories and hierarchy over the clock.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, SimError};

use crate::{Simulator, simulator};

fn finish(m: Module) -> Arc<Netlist> {
    m.finish().unwrap()
}

/// Sets the inputs, clocks once, returns the output.
fn step(sim: &mut Simulator, inputs: &[(&str, u128)], output: &str) -> u128 {
    for (name, value) in inputs {
        sim.set_input(name, *value).unwrap();
    }
    sim.tick();
    sim.get(output).unwrap()
}

#[test]
fn of_several_updates_the_last_wins_and_reset_wins_over_all() {
    let m = Module::new("ranks", "");
    let (first, second) = (m.input("first", 1), m.input("second", 1));
    let r = m.reg("r", 4).reset(9).when(first, 1).when(second, 2);
    m.output("q", r);
    let mut sim = simulator(&finish(m));
    let mut next =
        |first, second, rst| step(&mut sim, &[("first", first), ("second", second), ("rst", rst)], "q");
    assert_eq!(next(0, 0, 0), 0, "zero before the first update");
    assert_eq!(next(1, 0, 0), 1);
    assert_eq!(next(0, 0, 0), 1, "holds");
    assert_eq!(next(0, 1, 0), 2);
    assert_eq!(next(1, 1, 0), 2, "the later update wins");
    assert_eq!(next(1, 1, 1), 9, "reset wins");
    assert_eq!(next(0, 0, 0), 9);
}

#[test]
fn an_unconditional_update_hides_those_before_it_only() {
    let m = Module::new("order", "");
    let (a, b) = (m.input("a", 1), m.input("b", 1));
    m.output("q", m.reg("r", 4).when(a, 1).set(2).when(b, 3));
    let mut sim = simulator(&finish(m));
    assert_eq!(step(&mut sim, &[("a", 1), ("b", 0)], "q"), 2);
    assert_eq!(step(&mut sim, &[("a", 0), ("b", 1)], "q"), 3);
}

#[test]
fn a_register_without_reset_ignores_it() {
    let m = Module::new("some", "");
    let data = m.input("data", 4);
    m.output("p_q", m.reg("p", 4).reset(5).set(data));
    m.output("q_q", m.reg("q", 4).set(data));
    let mut sim = simulator(&finish(m));
    assert_eq!(step(&mut sim, &[("data", 7), ("rst", 1)], "p_q"), 5);
    assert_eq!(sim.get("q_q").unwrap(), 7);
}

#[test]
fn registers_change_together() {
    let m = Module::new("swap", "");
    let (one, two) = (m.reg("one", 4).reset(1), m.reg("two", 4).reset(2));
    one.set(two);
    two.set(one);
    let mut sim = simulator(&finish(m));
    assert_eq!(step(&mut sim, &[("rst", 1)], "one"), 1);
    assert_eq!(step(&mut sim, &[("rst", 0)], "one"), 2);
    assert_eq!(sim.get("two").unwrap(), 1);
}

#[test]
fn memory_reads_the_old_word_and_holds() {
    let m = Module::new("ram", "");
    let (we, re) = (m.input("we", 1), m.input("re", 1));
    let (wa, ra, data) = (m.input("wa", 3), m.input("ra", 3), m.input("data", 8));
    let ram = m.memory("words", 3, 6, 8).starts(0xaa).write(we, wa, data);
    m.output("q", ram.read(re, ra));
    let mut sim = simulator(&finish(m));
    let mut next = |we, wa, data, re, ra| {
        step(&mut sim, &[("we", we), ("wa", wa), ("data", data), ("re", re), ("ra", ra)], "q")
    };
    assert_eq!(next(0, 0, 0, 0, 0), 0, "nothing read yet");
    assert_eq!(next(1, 3, 7, 1, 3), 0xaa, "the word before the write");
    assert_eq!(next(0, 0, 0, 1, 3), 7);
    assert_eq!(next(1, 3, 8, 0, 3), 7, "holds without enable");
    assert_eq!(next(1, 6, 9, 1, 6), 0, "beyond the words");
    assert_eq!(next(0, 0, 0, 1, 3), 8);
    assert_eq!(sim.memory("words").unwrap(), [0xaa, 0xaa, 0xaa, 8, 0xaa, 0xaa]);
}

#[test]
fn logic_behind_a_memory_follows_the_word_that_is_read() {
    let m = Module::new("ram", "");
    let (we, addr, data) = (m.input("we", 1), m.input("addr", 2), m.input("data", 4));
    let ram = m.memory("words", 2, 4, 4).starts(3).write(we, addr, data);
    m.output("inverse", !ram.read(m.lit(1, 1), addr));
    let mut sim = simulator(&finish(m));
    // Nothing but the memory's output changes from the second clock on.
    assert_eq!(step(&mut sim, &[("we", 1), ("addr", 1), ("data", 5)], "inverse"), 12, "the word before");
    assert_eq!(step(&mut sim, &[], "inverse"), 10);
    assert_eq!(step(&mut sim, &[], "inverse"), 10);
}

#[test]
fn words_nobody_may_read_yet_are_another_each() {
    let m = Module::new("ram", "");
    let ram = m.memory("words", 2, 4, 5).write(m.input("we", 1), m.input("wa", 2), m.input("data", 5));
    m.output("q", ram.read(m.lit(1, 1), m.input("ra", 2)));
    let mut sim = simulator(&finish(m));
    let words = sim.memory("words").unwrap().to_vec();
    assert!((1..4).all(|place| !words[..place].contains(&words[place])), "{words:?}");
    for (place, word) in words.into_iter().enumerate() {
        assert_eq!(step(&mut sim, &[("ra", place as u128)], "q"), word, "read all the same");
    }
    assert_eq!(
        step(&mut sim, &[("we", 1), ("wa", 2), ("data", 9), ("ra", 0)], "q"),
        sim.memory("words").unwrap()[0]
    );
    assert_eq!(step(&mut sim, &[("we", 0), ("ra", 2)], "q"), 9);
}

#[test]
fn a_rom_reads_its_contents_and_holds() {
    let m = Module::new("rom", "");
    let (re, ra) = (m.input("re", 1), m.input("ra", 3));
    let words = [3, u128::MAX, 0, 1 << 127, 0x55];
    let rom = m.memory("words", 3, 5, 128);
    words.iter().enumerate().for_each(|(address, word)| _ = rom.holds(address, *word, ""));
    m.output("q", rom.read(re, ra));
    let mut sim = simulator(&finish(m));
    for (address, word) in words.iter().enumerate() {
        assert_eq!(step(&mut sim, &[("re", 1), ("ra", address as u128)], "q"), *word);
        assert_eq!(step(&mut sim, &[("re", 0), ("ra", 2)], "q"), *word, "holds without enable");
    }
    assert_eq!(step(&mut sim, &[("re", 1), ("ra", 5)], "q"), 0, "beyond the words");
    assert_eq!(sim.memory("words").unwrap(), words);
}

#[test]
fn a_reset_does_not_restore_a_written_row() {
    let m = Module::new("ram", "");
    let (we, addr, data) = (m.input("we", 1), m.input("addr", 2), m.input("data", 8));
    let ram = m.memory("words", 2, 4, 8).starts(7).holds(2, 9, "nine").holds(0, 8, "").write(we, addr, data);
    m.output("q", ram.read(m.lit(1, 1), addr));
    m.output("r", m.reg("held", 1).reset(0).set(we));
    let mut sim = simulator(&finish(m));
    assert_eq!(sim.memory("words").unwrap(), [8, 7, 9, 7]);
    let mut next = |rst, we, addr, data| {
        step(&mut sim, &[("rst", rst), ("we", we), ("addr", addr), ("data", data)], "q")
    };
    assert_eq!(next(0, 1, 2, 5), 9, "the word before the write");
    assert_eq!(next(1, 0, 2, 0), 5, "as it was written");
    assert_eq!(next(1, 1, 0, 6), 8, "a reset keeps no write away");
    assert_eq!(next(0, 0, 0, 0), 6);
    assert_eq!(sim.memory("words").unwrap(), [6, 7, 5, 7]);
}

#[test]
fn rows_of_unknown_words_are_known() {
    let m = Module::new("ram", "");
    let ram = m.memory("words", 2, 4, 5).holds(1, 0, "zero").holds(3, 31, "all ones");
    ram.write(m.input("we", 1), m.input("wa", 2), m.input("data", 5));
    m.output("q", ram.read(m.lit(1, 1), m.input("ra", 2)));
    let sim = simulator(&finish(m));
    let words = sim.memory("words").unwrap();
    assert_eq!((words[1], words[3]), (0, 31));
    assert!(words[0] != words[2] && words[0] != 0 && words[2] != 0, "{words:?}");
}

#[test]
fn of_two_write_ports_the_later_wins() {
    let m = Module::new("ram", "");
    let (first, second) = (m.input("first", 1), m.input("second", 1));
    let addr = m.lit(1, 1);
    let ram = m.memory("words", 1, 2, 4).starts(0).write(first, addr, 1).write(second, addr, 2);
    m.output("q", ram.read(m.lit(1, 1), addr));
    let mut sim = simulator(&finish(m));
    step(&mut sim, &[("first", 1), ("second", 1)], "q");
    assert_eq!(sim.memory("words").unwrap(), [0, 2]);
}

/// A counter and two of it in a chain, with a feedback wire through both.
#[test]
fn hierarchy_with_feedback() {
    let m = Module::new("stage", "");
    let (value, ready) = (m.input("value", 8), m.input("ready", 1));
    let held = m.reg("held", 8).reset(0).when(ready, value + 1);
    m.output("q", held);
    m.output("ready_out", !ready);
    let cell = finish(m);

    let m = Module::new("chain", "");
    let back = m.wire("back", 1);
    let one = m.instance("one", &cell).connect("value", m.input("start", 8)).connect("ready", back);
    let two = m.instance("two", &cell).connect("value", one.output("q")).connect("ready", m.input("go", 1));
    back.drive(two.output("ready_out"));
    m.output("q", two.output("q"));
    let chain = finish(m);

    let mut sim = simulator(&chain);
    assert_eq!(step(&mut sim, &[("start", 10), ("go", 0)], "one.held"), 11);
    assert_eq!(sim.get("two.ready").unwrap(), 0);
    assert_eq!(step(&mut sim, &[("go", 1)], "q"), 12);
    assert_eq!(sim.get("one.held").unwrap(), 11, "the feedback held it");
    assert_eq!(sim.get("back").unwrap(), 0);
    assert_eq!(step(&mut sim, &[("rst", 1)], "one.held"), 0, "reset reaches the instances");
    let names: Vec<_> = chain.modules().iter().map(|module| module.name.clone()).collect();
    assert_eq!(names, ["stage", "chain"]);
}

#[test]
fn names_and_values_that_do_not_fit_are_refused() {
    let m = Module::new("adder", "");
    m.output("q", m.input("a", 4) + 1);
    let mut sim = simulator(&finish(m));
    assert_eq!(sim.set_input("b", 0), Err(SimError::NoInput("b".into())));
    assert_eq!(sim.set_input("rst", 0), Err(SimError::NoInput("rst".into())), "nothing to reset");
    assert_eq!(sim.set_input("a", 16).unwrap_err().to_string(), "16 does not fit input `a` of 4 bits");
    assert_eq!(sim.get("u.a"), Err(SimError::NoSignal("u.a".into())));
    assert_eq!(sim.memory("m"), Err(SimError::NoMemory("m".into())));
}

#[test]
fn a_constant_is_computed_once_and_right() {
    let m = Module::new("constants", "");
    let three = m.constant("THREE", 4, 3);
    let low = m.cat(&[m.lit(1, 1), m.lit(2, 0), m.lit(1, 1)]);
    m.output("q", (three + 2) ^ low);
    assert_eq!(simulator(&finish(m)).get("q").unwrap(), 5 ^ 9);
}
