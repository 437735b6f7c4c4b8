//! Random sums of registers that are read with their sign, in words that are just long enough, or just not.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, Signal};
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

pub fn module(random: &mut Pcg64Mcg) -> Arc<Netlist> {
    let m = Module::new("signs", "");
    let width = *[2, 7, 31, 45, 61, 62, 63, 64].choose(random).unwrap();
    let bits: Vec<Signal> = (0..3).map(|i| m.input(&format!("e{i}"), 1)).collect();
    let registers: Vec<_> = (0..8)
        .map(|i| {
            let register = m.reg(&format!("r{i}"), width);
            // All bits, the sign alone, all but the sign, none.
            let reset = [u128::MAX >> (128 - width), 1 << (width - 1), (1 << (width - 1)) - 1, 0][i % 4];
            if random.random() { register.reset(reset) } else { register }
        })
        .collect();
    let mut values = vec![m.input("a", width), m.input("b", width)];
    values.extend(registers.iter().map(|register| register.q()));
    let mut found = bits.clone();
    for i in 0..40 {
        let pick = |random: &mut Pcg64Mcg| *values.choose(random).unwrap();
        let (a, b, bit) = (pick(random), pick(random), *found.choose(random).unwrap());
        let more = width + random.random_range(0..3);
        let (long, other) = (a.sext(more), b.sext(more));
        let sum = match random.random_range(0..8) {
            0 => long + other,
            1 => long - other,
            2 => -long,
            3 => long ^ bit.sext(more),
            4 => !long & other,
            5 => bit.mux(long, b.zext(more)) + other,
            6 => m.cat(&[a, bit]).sext(more + 1).slice(more, more + 1 - width).sext(more),
            _ => long.shl(1) | other.sar(width / 2),
        };
        found.push([sum.msb(), !sum.msb(), sum.slt(other), sum.any()][i % 4]);
        values.push(sum.trunc(width));
        m.output(&format!("s{i}"), sum);
    }
    for register in &registers {
        let (value, when) = (*values.choose(random).unwrap(), *found.choose(random).unwrap());
        if random.random() {
            register.set(value);
        } else {
            register.when(when, value);
        }
    }
    m.finish().unwrap()
}
