//! Choices among registers by a number or a bit, of registers that change before and after they are read; queues of words side
//! by side; and bits of which little more than the lowest is worked out.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, Signal};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

pub fn module(random: &mut Pcg64Mcg) -> Arc<Netlist> {
    let m = Module::new("named", "");
    let (data, number, go, on) =
        (m.input("data", 64), m.input("number", 3), m.input("go", 1), m.input("on", 1));
    let widths =
        [[12, 12, 12, 12], [9, 12, 5, 12], [64, 64, 64, 64], [2, 3, 30, 31]][random.random_range(0..4)];
    let widest = *widths.iter().max().unwrap();
    // Some of them change in every clock, some now and then, in any order beside those that read them.
    let registers: Vec<Signal> = (0..4)
        .map(|i| {
            let register = m.reg(&format!("r{i}"), widths[i]);
            let register = if random.random() { register.reset(random.random_range(0..4)) } else { register };
            let value = data.slice(widths[i] - 1, 0) + register.q();
            match random.random_range(0..3) {
                0 => register.set(value).q(),
                1 => register.when(go, value).q(),
                _ => {
                    register.when(go & on, value).when(number.eq(i as u128), data.slice(widths[i] - 1, 0)).q()
                }
            }
        })
        .collect();
    let wide: Vec<Signal> = registers.iter().map(|q| q.zext(widest)).collect();
    let any = |random: &mut Pcg64Mcg| wide[random.random_range(0..4)];
    let named = m.reg("named", 3).when(on, number).q();
    for (i, number) in [number, named, number.slice(1, 0).zext(3), (named + 1)].into_iter().enumerate() {
        let [a, b, c, d] = [(); 4].map(|()| any(random));
        let value = number.eq(2).mux(a, number.bit(0).mux(b, number.ge(5).mux(c, d)));
        m.output(&format!("y{i}"), value);
        m.reg(&format!("s{i}"), widest).set(value + 1);
        m.output(&format!("z{i}"), m.reg(&format!("t{i}"), widest).when(go, value).q().sext(widest + 3));
        let two = (number.bit(i as u32 % 3)).mux(any(random), any(random));
        m.output(&format!("w{i}"), m.reg(&format!("u{i}"), widest).set(two).q());
        // A bit that is there as a word, and one that is not.
        m.output(&format!("v{i}"), [go, on.eq(go), named.bit(1)][i % 3].mux(a, d));
    }
    stages(random, &m, data, [go, on]);
    bits(random, &m, data, [go, on]);
    kept(random, &m, data, [go, on, number.bit(0)]);
    // Registers that are read more often with their sign, but named without it.
    let signed = [0, 1].map(|i| m.reg(&format!("signed{i}"), 12).when(go, data.slice(11 + i, i)).q());
    for i in 0..8 {
        m.output(&format!("signed_sum{i}"), signed[i % 2].sext(20 + i as u32) + 1);
    }
    m.output("unsigned_one", on.mux(signed[0].zext(20), signed[1].zext(20)));
    m.finish().unwrap()
}

/// What a register takes behind one bit, and what is worked out behind another, both needed again behind them.
fn kept(random: &mut Pcg64Mcg, m: &Module, data: Signal, [go, on, third]: [Signal; 3]) {
    let [a, b] = [0, 1].map(|i| m.reg(&format!("k{i}"), 20).set(data.slice(39 + i, 20 + i)).q());
    let sum = (a + b) ^ a.shl(3);
    for (i, when) in [go, on, !on, go & on].into_iter().enumerate() {
        let takes = random.random();
        let first = m.reg(&format!("first{i}"), 20).when(when, if takes { sum } else { sum + 5 });
        let then = m.reg(&format!("then{i}"), 20).when(when & third, sum ^ b);
        m.output(
            &format!("first{i}_out"),
            if random.random() { first.q().sext(30) } else { first.q().zext(30) },
        );
        m.output(&format!("then{i}_out"), then.q());
    }
}

/// Three stages of a queue of five words; some of what is in them is read with its sign, or changed on the way.
fn stages(random: &mut Pcg64Mcg, m: &Module, data: Signal, enables: [Signal; 2]) {
    let widths = [20, 20, 1, 64, 7];
    let mut words = [0, 1, 2, 3, 4].map(|i| data.slice(widths[i] - 1, 0));
    for stage in 0..4 {
        let back = random.random();
        let when = enables[random.random_range(0..2)];
        let always = random.random_bool(0.3);
        let next: Vec<Signal> = (0..5)
            .map(|i| {
                let register = m.reg(&format!("q{stage}_{i}"), widths[i]);
                let value = if random.random_bool(0.1) { words[i] ^ words[i].shl(1) } else { words[i] };
                if always { register.set(value).q() } else { register.when(when, value).q() }
            })
            .collect();
        for (i, word) in next.iter().enumerate() {
            let sign = random.random_bool(0.3) && (2..64).contains(&widths[i]);
            m.output(&format!("o{stage}_{i}"), if sign { word.sext(64) } else { *word });
        }
        let turned = if back { [1, 0, 2, 3, 4] } else { [0, 1, 2, 3, 4] };
        words = turned.map(|i| next[i]);
    }
}

/// `And`, `Or`, `Xor` and `Not` of bits from registers, sums, comparisons and each other, and what is made of them.
fn bits(random: &mut Pcg64Mcg, m: &Module, data: Signal, enables: [Signal; 2]) {
    let [a, b] = [0, 1].map(|i| m.reg(&format!("a{i}"), 20).set(data.slice(19 + i, i) + i as u128).q());
    let sum = a + b;
    let mut bits =
        vec![a.bit(3), sum.bit(0), sum.bit(7), sum.msb(), a.lt(b), enables[0], enables[1], a.bit(19)];
    for i in 0..24 {
        let [p, q] = [(); 2].map(|()| bits[random.random_range(0..bits.len())]);
        let bit = match random.random_range(0..7) {
            0 => p & q,
            1 => p | q,
            2 => p ^ q,
            3 => !p,
            4 => p & !q,
            5 => p.mux(q, sum.bit(i % 20)),
            _ => m.reg(&format!("bit{i}"), 1).set(p).q(),
        };
        bits.push(bit);
    }
    for (i, bit) in bits.iter().enumerate().skip(8) {
        let other = bits[random.random_range(0..bits.len())];
        m.output(&format!("b{i}"), *bit);
        m.output(&format!("c{i}"), m.cat(&[*bit, sum.slice(9, 5), other]));
        m.output(&format!("d{i}"), bit.sext(20) ^ other.zext(20));
        m.output(
            &format!("e{i}"),
            m.reg(&format!("f{i}"), 20).when(*bit, bit.mux(a, b) + other.zext(20)).q(),
        );
    }
    m.output("g", sum.bit(7).sext(30));
    m.output("h", m.cat(&[sum, a.slice(2, 0)]).slice(20, 1));
}
