//! Random modules with everything a builder can make: operators in each other, shared and named ones, registers with
//! and without reset, memories, feedback, instances three deep.

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

fn any<'m>(random: &mut Pcg64Mcg, pool: &[Signal<'m>], width: u32) -> Signal<'m> {
    let signal = pool[random.random_range(0..pool.len())];
    fit(random, signal, width)
}

fn module(random: &mut Pcg64Mcg, name: &str, below: &[Arc<Netlist>], operators: usize) -> Arc<Netlist> {
    let m = Module::new(name, "A random module.");
    let go = m.input("go", 1);
    let mut pool: Vec<Signal> = (0..6).map(|i| m.input(&format!("i{i}"), width(random))).collect();
    let constant = width(random);
    pool.push(m.lit(constant, random.random::<u128>() & (u128::MAX >> (128 - constant))));
    m.comment("State");
    let with_reset: Vec<_> = (0..4)
        .map(|i| {
            let width = width(random);
            m.reg(&format!("r{i}"), width).reset(random.random::<u128>() & (u128::MAX >> (128 - width)))
        })
        .collect();
    let without: Vec<_> = (0..2).map(|i| m.reg(&format!("s{i}"), width(random)).doc("no reset")).collect();
    pool.extend(with_reset.iter().chain(&without).map(|register| register.q()));
    let wires: Vec<_> = (0..2).map(|i| m.wire(&format!("w{i}"), width(random))).collect();
    for wire in &wires {
        // From inputs and registers only, so that there is no loop.
        let (one, two) = (any(random, &pool, wire.q().width()), any(random, &pool, wire.q().width()));
        wire.drive(one ^ two);
    }
    pool.extend(wires.iter().map(|wire| wire.q()));

    m.comment("Parts");
    for (index, part) in below.iter().enumerate() {
        let instance = m.instance(&format!("u{index}"), part);
        instance.connect("go", go);
        for input in &part.inputs[1..] {
            instance.connect(&input.name, any(random, &pool, part.width(input.node)));
        }
        for output in part.outputs.iter().filter(|_| random.random_bool(0.8)) {
            pool.push(instance.output(&output.name));
        }
    }

    m.comment("Operators");
    for index in 0..operators {
        let signal = operator(random, &m, &pool);
        pool.push(if random.random_bool(0.3) { signal.named(&format!("n{index}")) } else { signal });
    }

    m.comment("Memory");
    let (addr_bits, word) = (random.random_range(1..=4), width(random));
    let words = 1 << addr_bits;
    let ram = m.memory("ram", addr_bits, words, word, u128::from(random.random::<bool>()));
    for _ in 0..random.random_range(1..=2) {
        ram.write(go & any(random, &pool, 1), any(random, &pool, addr_bits), any(random, &pool, word));
    }
    for _ in 0..random.random_range(1..=2) {
        let read = ram.read(!go | any(random, &pool, 1), any(random, &pool, addr_bits));
        pool.push(read);
    }

    m.comment("Next state");
    let shared = any(random, &pool, 1);
    for register in with_reset {
        let width = register.q().width();
        for _ in 0..random.random_range(1..=3) {
            let condition = if random.random() { shared } else { any(random, &pool, 1) };
            match random.random_bool(0.2) {
                true => register.set(any(random, &pool, width)),
                false => register.when(condition, any(random, &pool, width)),
            };
        }
    }
    for register in without {
        let width = register.q().width();
        register.when(!go | any(random, &pool, 1), go.mux(any(random, &pool, width), 0));
    }
    for index in 0..6 {
        m.output(&format!("q{index}"), pool[pool.len() - 1 - random.random_range(0..pool.len() / 2)]);
    }
    m.finish().unwrap()
}

fn operator<'m>(random: &mut Pcg64Mcg, m: &'m Module, pool: &[Signal<'m>]) -> Signal<'m> {
    // Younger signals are taken more often, so that expressions grow.
    let from = if random.random() { pool.len() * 2 / 3 } else { 0 };
    let a = pool[random.random_range(from..pool.len())];
    let w = a.width();
    let b = any(random, pool, w);
    let c = any(random, pool, 1);
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
        23 => a.shl_by(any(random, pool, 5)),
        24 => a.shr_by(any(random, pool, 5)),
        25 => a.sar_by(any(random, pool, 5)),
        26 => {
            let width = width(random);
            fit(random, a, width)
        }
        27 => a.any(),
        28 => a.all() | a.parity(),
        29 if w <= 100 => a * any(random, pool, 20),
        30 if w <= 100 => a.smul(any(random, pool, 20)),
        31 if w <= 63 => m.cat(&[a, b, c]),
        _ => a.slt(n as i32 / 2) ^ b.ge(u128::from(n) & (u128::MAX >> (128 - w))),
    }
}
