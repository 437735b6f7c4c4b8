//! Units that stand still, each for a reason of its own, and what wakes each.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist};

/// Bits of a word.
const W: u32 = 12;

/// A top module with units that follow one another and come to rest a while after their inputs do.
pub fn module() -> Arc<Netlist> {
    let m = Module::new("units", "");
    let input = |name: &str, width| m.input(name, width);
    let (data, go, addr) = (input("data", W), input("go", 1), input("addr", 2));

    let chain = m.instance("u_chain", &chain());
    chain.connect("data", data);
    let hold = m.instance("u_hold", &hold());
    hold.connect("go", go).connect("late", chain.output("last"));
    let words = m.instance("u_words", &words());
    words.connect("en", input("en", 1)).connect("addr", addr).connect("word", hold.output("held"));
    let tail = m.instance("u_tail", &tail());
    tail.connect("last", chain.output("last")).connect("held", hold.output("held"));
    // A bit that follows from two units decides whether a third one moves.
    let gate = (hold.output("odd") & chain.output("last").bit(3)).named("gate");
    let gated = m.instance("u_gated", &gated());
    gated.connect("gate", gate).connect("word", words.output("q"));
    for (name, value) in [
        ("last", chain.output("last")),
        ("held", hold.output("held")),
        ("q", words.output("q")),
        ("sum", tail.output("sum")),
        ("count", gated.output("count")),
        ("taken", gated.output("taken")),
    ] {
        m.output(name, value);
    }
    // The top module is a unit too: it counts until it is full.
    let full = m.reg("full", 4).reset(0);
    full.when(!full.q().eq(15) & go, full.q() + 1);
    m.output("full", full.q());
    m.finish().unwrap()
}

/// Seven registers, one after the other: the longest way in it.
fn chain() -> Arc<Netlist> {
    let m = Module::new("chain", "");
    let mut last = m.input("data", W);
    for i in 0..7 {
        last = m.reg(&format!("c{i}"), W).set(last + i).q();
    }
    m.output("last", last);
    m.finish().unwrap()
}

/// A register that takes a value now and then, one that feeds itself till it meets another, and a way round through two.
fn hold() -> Arc<Netlist> {
    let m = Module::new("hold", "");
    let (go, late) = (m.input("go", 1), m.input("late", W));
    let held = m.reg("held", W).reset(5);
    let climbs = m.reg("climbs", W);
    climbs.set(climbs.q().lt(late).mux(climbs.q() + 1, climbs.q()));
    let (there, back) = (m.reg("there", W), m.reg("back", W));
    there.set(back.q().lt(held.q()).mux(back.q() + 3, back.q()));
    back.set(there.q());
    held.when(go, climbs.q() ^ back.q());
    m.output("held", held.q());
    m.output("odd", climbs.q().bit(0));
    m.finish().unwrap()
}

/// Words that are read all the time, where one is written now and then; from the word that comes to the one that goes it is
/// a long way, half of it before the memory.
fn words() -> Arc<Netlist> {
    let m = Module::new("words", "");
    let (en, addr) = (m.input("en", 1), m.input("addr", 2));
    let words = m.memory("words", 2, 4, W).starts(3);
    let later = |name: &str, word| (0..6).fold(word, |word, i| m.reg(&format!("{name}{i}"), W).set(word).q());
    words.write(en, addr, later("before", m.input("word", W)));
    m.output("q", later("after", words.read(m.lit(1, 1), m.lit(2, 2))));
    m.finish().unwrap()
}

/// It follows from two units in every clock.
fn tail() -> Arc<Netlist> {
    let m = Module::new("tail", "");
    let once = m.reg("once", W).set(m.input("last", W) + m.input("held", W)).q();
    m.output("sum", m.reg("again", W).set(once).q());
    m.finish().unwrap()
}

/// It moves only when a bit from elsewhere lets it.
fn gated() -> Arc<Netlist> {
    let m = Module::new("gated", "");
    let (gate, word) = (m.input("gate", 1), m.input("word", W));
    let opened = m.reg("opened", 1).set(gate).q();
    let count = m.reg("count", 8).reset(0);
    count.when(gate & !opened, count.q() + 1);
    let taken = m.reg("taken", W).when(!gate, word);
    m.output("count", count.q());
    m.output("taken", taken.q());
    m.finish().unwrap()
}
