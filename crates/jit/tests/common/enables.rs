//! Random modules of registers that share enables: conjunctions, alternatives, several updates in different orders of
//! priority, costly values on one side of a choice, memories.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, Signal};
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

pub fn module(random: &mut Pcg64Mcg) -> Arc<Netlist> {
    let m = Module::new("enables", "");
    let bits: Vec<Signal> = (0..5).map(|i| m.input(&format!("e{i}"), 1)).collect();
    let state = m.reg("state", 2).reset(0);
    let mut conditions: Vec<Signal> = bits.clone();
    conditions.extend((0..4).map(|value| state.q().eq(value)));
    for _ in 0..8 {
        let (a, b) = (pick(random, &conditions), pick(random, &conditions));
        conditions.push(match random.random_range(0..4) {
            0 => a | b,
            1 => !(a | b),
            2 => a & !b,
            _ => a & b,
        });
    }
    let width = *[1, 7, 22, 64, 90].choose(random).unwrap();
    let registers: Vec<_> = (0..12)
        .map(|i| {
            let register = m.reg(&format!("r{i}"), width);
            if random.random() { register.reset(i as u128 & 1) } else { register }
        })
        .collect();
    let mut values: Vec<Signal> = registers.iter().map(|register| register.q()).collect();
    values.push(m.input("data", width));
    let ram = m.memory("ram", 3, random.random_range(5..=8), width).starts(1);
    let addr = m.input("addr", 3);
    values.push(ram.read(pick(random, &conditions), addr));
    for _ in 0..30 {
        let (a, b) = (pick(random, &values), pick(random, &values));
        values.push(match random.random_range(0..5) {
            0 => a + b,
            1 => a - b,
            2 => a ^ b,
            3 => a.shr(width / 2) | b,
            _ => pick(random, &conditions).mux(a, b),
        });
    }
    ram.write(pick(random, &conditions), addr ^ 1, pick(random, &values));
    ram.write(pick(random, &conditions), addr, pick(random, &values));
    for i in 0..4 {
        state.when(pick(random, &conditions), i);
    }
    // Few pairs of conditions for many registers, in either order.
    let pairs: Vec<_> = (0..3).map(|_| [pick(random, &conditions), pick(random, &conditions)]).collect();
    for register in &registers {
        let mut pair = *pairs.choose(random).unwrap();
        if random.random() {
            pair.swap(0, 1);
        }
        for condition in pair {
            register.when(condition, pick(random, &values));
        }
        if random.random_bool(0.1) {
            register.set(pick(random, &values)).when(pair[0], pick(random, &values));
        }
    }
    for (i, register) in registers.iter().enumerate() {
        m.output(&format!("q{i}"), register.q());
    }
    m.output("sum", pick(random, &values) + pick(random, &values));
    m.finish().unwrap()
}

fn pick<'m>(random: &mut Pcg64Mcg, signals: &[Signal<'m>]) -> Signal<'m> {
    // Younger signals are taken more often, so that expressions grow.
    let from = if random.random() { signals.len() * 2 / 3 } else { 0 };
    signals[random.random_range(from..signals.len())]
}
