//! Random units of a counter that nothing holds, of which a bit hides all or nearly all, and of registers that follow from others
//! that are loaded now and then.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, Signal};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// Bits of a word.
const W: u32 = 9;
/// Bits of the counter: it goes round in more clocks than a unit waits for.
const C: u32 = 6;

pub fn module(random: &mut Pcg64Mcg) -> Arc<Netlist> {
    let m = Module::new("free_running", "");
    let (go, load, data) = (m.input("go", 1), m.input("load", 1), m.input("data", W));
    let mut before = data;
    for i in 0..2 {
        let unit = m.instance(&format!("u{i}"), &unit(random, &format!("unit{i}")));
        unit.connect("go", go).connect("load", load).connect("data", before);
        before = unit.output("out");
        m.output(&format!("out{i}"), before);
    }
    m.finish().unwrap()
}

fn unit(random: &mut Pcg64Mcg, name: &str) -> Arc<Netlist> {
    let m = Module::new(name, "");
    let (go, load, data) = (m.input("go", 1), m.input("load", 1), m.input("data", W));
    // Mostly what hides the counter does it in all places.
    let mut slips = || random.random_bool(0.06);

    let count = m.reg("count", C);
    let adds = m.reg("adds", 1);
    let (digit, last) = (count.q(), count.q().eq(0));
    if slips() {
        count.set(digit - adds.q().zext(C)).when(go, data.trunc(C));
    } else {
        count.set(digit - 1).when(go, data.trunc(C));
    }
    // A mask that falls after it has risen hides the counter; one that may rise in spite of that does not.
    if slips() {
        adds.when(go, 1).when(last, 0);
    } else if slips() {
        adds.when(last, 0).when(go, 1).when(digit.eq(7), 1);
    } else {
        adds.when(last, 0).when(go, 1);
    }
    let hides = |bit, slips: bool| if slips { bit } else { bit & adds.q() };
    let sum = m.reg("sum", W);
    if slips() {
        sum.when(adds.q() | load, sum.q() + digit.zext(W)).when(go, 0);
    } else {
        sum.when(adds.q(), sum.q() + digit.zext(W)).when(go, 0);
    }
    let done = m.reg("done", W).when(hides(last, slips()), sum.q());
    let seen = m.reg("seen", C);
    seen.set(if slips() { (!adds.q()).mux(digit, 0) } else { adds.q().mux(digit, 3) });
    let either = m.reg("either", 1).set(!(!adds.q() | if slips() { last & load } else { digit.bit(1) }));
    let words = m.memory("words", 2, 4, W).starts(1);
    let to = digit.trunc(2);
    let words = words.write(hides(digit.bit(5), slips()), to, sum.q() ^ digit.zext(W));
    let word = words.read(if slips() { load } else { adds.q() }, to);

    // Three corners, and what follows from them; now and then it follows from more.
    let corners = [0, 1, 2].map(|i| m.reg(&format!("corner{i}"), W).when(load, data + i * 5));
    let mut values: Vec<Signal> = corners.iter().map(|corner| corner.q()).collect();
    for i in 0..8 {
        let from = values.len() - 3;
        let (a, b) = (values[random.random_range(0..=from)], values[from + random.random_range(0..3)]);
        let mut value = a.lt(b).mux(a - b, (b + 3) ^ a);
        if random.random_bool(0.04) {
            value = value + sum.q();
        }
        values.push(m.reg(&format!("calm{i}"), W).set(value).q());
    }
    let calm = values[values.len() - 1] ^ values[values.len() - 2];
    let kept = m.reg("kept", W).when(go, calm).q();
    let tail = [done.q(), seen.q().zext(W), either.q().zext(W), word, kept];
    m.output("out", tail.into_iter().fold(calm, |all, value| all ^ value));
    m.finish().unwrap()
}
