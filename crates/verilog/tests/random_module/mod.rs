//! Random modules with everything a builder can make: operators in each other, shared and named ones, registers with
//! and without reset, memories with and without contents, feedback, instances three deep.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, Signal};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// A top module over two levels of others.
pub fn hierarchy(random: &mut Pcg64Mcg, name: &str) -> Arc<Netlist> {
    let mut below: Vec<Arc<Netlist>> = Vec::new();
    for index in 0..3 {
        let next = module(random, &format!("{name}_part{index}"), &below, 25);
        below.push(next);
    }
    module(random, name, &below, 50)
}

fn width(random: &mut Pcg64Mcg) -> u32 {
    match random.random_range(0..10) {
        0..3 => 1,
        3..7 => random.random_range(2..=12),
        7..9 => random.random_range(13..=64),
        _ => random.random_range(65..=128),
    }
}

/// Signals to build from; of each whether it is shown in the end. At first those are all that have a name; what nobody
/// took joins them. So a fault is seen wherever it is, and operators are still written inside each other.
struct Pool<'m>(Vec<Entry<'m>>);

struct Entry<'m> {
    signal: Signal<'m>,
    has_name: bool,
    taken: bool,
}

impl<'m> Pool<'m> {
    fn push(&mut self, signal: Signal<'m>, has_name: bool) {
        self.0.push(Entry { signal, has_name, taken: false });
    }

    /// Any signal from place `from` on.
    fn take(&mut self, random: &mut Pcg64Mcg, from: usize) -> Signal<'m> {
        let place = random.random_range(from..self.0.len());
        self.0[place].taken = true;
        self.0[place].signal
    }

    /// Any signal, brought to a width.
    fn any(&mut self, random: &mut Pcg64Mcg, width: u32) -> Signal<'m> {
        let signal = self.take(random, 0);
        fit(random, signal, width)
    }

    /// All bits of what is shown, folded into 32.
    fn folded(&self, m: &'m Module) -> Signal<'m> {
        let shown = self.0.iter().filter(|entry| entry.has_name || !entry.taken);
        shown.fold(m.lit(32, 0), |sum, Entry { signal, .. }| {
            let parts = (0..signal.width().div_ceil(32))
                .map(|i| signal.slice((32 * i + 31).min(signal.width() - 1), 32 * i).zext(32));
            parts.fold(m.cat(&[sum.slice(30, 0), sum.bit(31)]), |sum, part| sum ^ part)
        })
    }
}

/// A signal brought to a width: cut, or extended either way.
fn fit<'m>(random: &mut Pcg64Mcg, signal: Signal<'m>, width: u32) -> Signal<'m> {
    if signal.width() > width {
        let lo = random.random_range(0..=signal.width() - width);
        signal.slice(lo + width - 1, lo)
    } else if random.random() {
        signal.zext(width)
    } else {
        signal.sext(width)
    }
}

fn module(random: &mut Pcg64Mcg, name: &str, below: &[Arc<Netlist>], operators: usize) -> Arc<Netlist> {
    let m = Module::new(name, "A random module.");
    let go = m.input("go", 1);
    let mut pool = Pool(Vec::new());
    (0..6).for_each(|i| pool.push(m.input(&format!("i{i}"), width(random)), false));
    let constant = width(random);
    pool.push(m.lit(constant, random.random::<u128>() & (u128::MAX >> (128 - constant))), false);
    m.comment("State");
    let with_reset: Vec<_> = (0..4)
        .map(|i| {
            let width = width(random);
            m.reg(&format!("r{i}"), width).reset(random.random::<u128>() & (u128::MAX >> (128 - width)))
        })
        .collect();
    let without: Vec<_> = (0..2).map(|i| m.reg(&format!("s{i}"), width(random)).doc("no reset")).collect();
    with_reset.iter().chain(&without).for_each(|register| pool.push(register.q(), true));
    let wires: Vec<_> = (0..2).map(|i| m.wire(&format!("w{i}"), width(random))).collect();
    for wire in &wires {
        // From inputs and registers only, so that there is no loop.
        let (one, two) = (pool.any(random, wire.q().width()), pool.any(random, wire.q().width()));
        wire.drive(one ^ two);
    }
    wires.iter().for_each(|wire| pool.push(wire.q(), true));

    m.comment("Parts");
    for (index, part) in below.iter().enumerate() {
        let instance = m.instance(&format!("u{index}"), part);
        instance.connect("go", go);
        for input in &part.inputs[1..] {
            instance.connect(&input.name, pool.any(random, part.width(input.node)));
        }
        for output in part.outputs.iter().filter(|output| output.name == "folded" || random.random_bool(0.8))
        {
            pool.push(instance.output(&output.name), true);
        }
    }

    m.comment("Operators");
    for index in 0..operators {
        let signal = operator(random, &m, &mut pool);
        match random.random_bool(0.3) {
            true => pool.push(signal.named(&format!("n{index}")), true),
            false => pool.push(signal, false),
        }
    }

    m.comment("Memory");
    let (addr_bits, word) = (random.random_range(1..=4), width(random));
    let words = 1 << addr_bits;
    let ram = m.memory("ram", addr_bits, words, word).starts(u128::from(random.random::<bool>()));
    let rom = m.memory("rom", addr_bits, words, word);
    let mut any_word = || random.random::<u128>() & (u128::MAX >> (128 - word));
    (0..words).step_by(3).for_each(|row| _ = ram.holds(row, any_word(), "a row of its own"));
    (0..words).for_each(|row| _ = rom.holds(row, any_word(), ""));
    let fetched = rom.read(!go | pool.any(random, 1), pool.any(random, addr_bits));
    pool.push(fetched, true);
    for _ in 0..random.random_range(1..=2) {
        ram.write(go & pool.any(random, 1), pool.any(random, addr_bits), pool.any(random, word));
    }
    for _ in 0..random.random_range(1..=2) {
        let read = ram.read(!go | pool.any(random, 1), pool.any(random, addr_bits));
        pool.push(read, true);
    }

    m.comment("Next state");
    let shared = pool.any(random, 1);
    for register in with_reset {
        let width = register.q().width();
        for _ in 0..random.random_range(1..=3) {
            let condition = if random.random() { shared } else { pool.any(random, 1) };
            match random.random_bool(0.2) {
                true => register.set(pool.any(random, width)),
                false => register.when(condition, pool.any(random, width)),
            };
        }
    }
    for register in without {
        let width = register.q().width();
        register.when(!go | pool.any(random, 1), go.mux(pool.any(random, width), 0));
    }
    for index in 0..6 {
        let from = pool.0.len() / 2;
        m.output(&format!("q{index}"), pool.take(random, from));
    }
    m.output("folded", pool.folded(&m));
    m.finish().unwrap()
}

fn operator<'m>(random: &mut Pcg64Mcg, m: &'m Module, pool: &mut Pool<'m>) -> Signal<'m> {
    // Younger signals are taken more often, so that expressions grow.
    let from = if random.random() { pool.0.len() * 2 / 3 } else { 0 };
    let a = pool.take(random, from);
    let w = a.width();
    let b = pool.any(random, w);
    let c = pool.any(random, 1);
    let n = random.random_range(0..=w);
    match random.random_range(0..33) {
        0 => a + b,
        1 => a - b,
        2 => -a,
        3 => a & b,
        4 => a | b,
        5 => a ^ b,
        6 => !a,
        7 => a.eq(b),
        8 => a.ne(b),
        9 => a.lt(b),
        10 => a.le(b),
        11 => a.gt(b),
        12 => a.ge(b),
        13 => a.slt(b),
        14 => a.sle(b),
        15 => a.sgt(b),
        16 => a.sge(b),
        17..=19 => c.mux(a, b),
        20 => a.shl(n),
        21 => a.shr(n),
        22 => a.sar(n),
        23 => a.shl_by(pool.any(random, 5)),
        24 => a.shr_by(pool.any(random, 5)),
        25 => a.sar_by(pool.any(random, 5)),
        26 => {
            let width = width(random);
            fit(random, a, width)
        }
        27 => a.any(),
        28 => a.all() | a.parity(),
        29 if w <= 100 => a * pool.any(random, 20),
        30 if w <= 100 => a.smul(pool.any(random, 20)),
        31 if w <= 63 => m.cat(&[a, b, c]),
        _ => a.slt(n as i32 / 2) ^ b.ge(u128::from(n) & (u128::MAX >> (128 - w))),
    }
}
