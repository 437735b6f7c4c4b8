//! Every operator against arithmetic in big integers written here: all values of small widths, random ones of all widths.

use edgewalk_netlist::Module;
use num_bigint::BigInt;
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use crate::simulator;

/// An operand: its bits and its width.
#[derive(Clone, Debug)]
struct Value {
    bits: u128,
    width: u32,
}

impl Value {
    fn unsigned(&self) -> BigInt {
        BigInt::from(self.bits)
    }
    fn signed(&self) -> BigInt {
        let half = power(self.width - 1);
        if self.unsigned() < half { self.unsigned() } else { self.unsigned() - power(self.width) }
    }
    /// Least significant first.
    fn digits(&self) -> Vec<bool> {
        (0..self.width).map(|i| self.bits >> i & 1 == 1).collect()
    }
}

fn power(n: u32) -> BigInt {
    BigInt::from(2).pow(n)
}

/// Rounded down, also for negative numbers.
fn floor_div(a: &BigInt, b: &BigInt) -> BigInt {
    let quotient = a / b;
    if &quotient * b > *a { quotient - 1 } else { quotient }
}

/// Taken modulo 2^width.
fn modulo(a: &BigInt, width: u32) -> u128 {
    let m = power(width);
    u128::try_from(a - floor_div(a, &m) * &m).unwrap()
}

fn from_digits(digits: impl IntoIterator<Item = bool>) -> BigInt {
    digits.into_iter().enumerate().map(|(i, digit)| power(i as u32) * u8::from(digit)).sum()
}

fn truth(holds: bool) -> BigInt {
    BigInt::from(u8::from(holds))
}

/// What each output of [`module`] ought to be before it is cut to its width.
fn expected(name: &str, a: &Value, b: &Value, n: &Value, c: bool) -> BigInt {
    let (x, y) = (a.unsigned(), b.unsigned());
    let (sx, sy) = (a.signed(), b.signed());
    let bitwise =
        |f: fn(bool, bool) -> bool| from_digits(a.digits().into_iter().zip(b.digits()).map(|(p, q)| f(p, q)));
    let count = u32::try_from((n.bits & 0xffff).min(1000)).unwrap(); // shifting by 1000 empties any word
    let constant = shift_of(a.width);
    let (hi, lo) = slice_of(a.width);
    match name {
        "add" => x + y,
        "sub" => x - y,
        "neg" => -x,
        "mul" => x * n.unsigned(),
        "smul" => sx * n.signed(),
        "and" => bitwise(|p, q| p && q),
        "or" => bitwise(|p, q| p || q),
        "xor" => bitwise(|p, q| p != q),
        "not" => from_digits(a.digits().into_iter().map(|p| !p)),
        "eq" => truth(x == y),
        "ne" => truth(x != y),
        "lt" => truth(x < y),
        "le" => truth(x <= y),
        "gt" => truth(x > y),
        "ge" => truth(x >= y),
        "slt" => truth(sx < sy),
        "sle" => truth(sx <= sy),
        "sgt" => truth(sx > sy),
        "sge" => truth(sx >= sy),
        "mux" => {
            if c {
                x
            } else {
                y
            }
        }
        "shl" => x * power(constant),
        "shr" => floor_div(&x, &power(constant)),
        "sar" => floor_div(&sx, &power(constant)),
        "shl_out_of" | "shr_out_of" => BigInt::ZERO,
        "sar_out_of" => -truth(sx < BigInt::ZERO),
        "shl_by" => x * power(count),
        "shr_by" => floor_div(&x, &power(count)),
        "sar_by" => floor_div(&sx, &power(count)),
        "slice" => from_digits(a.digits()[lo as usize..=hi as usize].iter().copied()),
        "zext" => x,
        "sext" => sx,
        "cat" => (x * power(n.width) + n.unsigned()) * 2 + u8::from(c),
        "any" => truth(a.digits().contains(&true)),
        "all" => truth(!a.digits().contains(&false)),
        "parity" => truth(a.digits().iter().filter(|p| **p).count() % 2 == 1),
        _ => panic!("an output without an expectation: {name}"),
    }
}

fn shift_of(width: u32) -> u32 {
    width.div_ceil(3)
}

/// As far as the word is wide or farther, up to three times so: past the end of any machine word that holds it.
fn out_of(width: u32) -> u32 {
    width + shift_of(width) * (width % 7)
}

fn slice_of(width: u32) -> (u32, u32) {
    (width - 1 - width / 4, width / 3)
}

/// All operators on a, b of `width` bits, n of `other` bits and the bit c; those whose result fits in 128 bits.
fn module(width: u32, other: u32) -> Module {
    let m = Module::new("operators", "");
    let (a, b) = (m.input("a", width), m.input("b", width));
    let (n, c) = (m.input("n", other), m.input("c", 1));
    let (hi, lo) = slice_of(width);
    let (constant, far) = (shift_of(width), out_of(width));
    let distance = n.trunc(other.min(16));
    let outputs = [
        ("add", a + b),
        ("sub", a - b),
        ("neg", -a),
        ("and", a & b),
        ("or", a | b),
        ("xor", a ^ b),
        ("not", !a),
        ("eq", a.eq(b)),
        ("ne", a.ne(b)),
        ("lt", a.lt(b)),
        ("le", a.le(b)),
        ("gt", a.gt(b)),
        ("ge", a.ge(b)),
        ("slt", a.slt(b)),
        ("sle", a.sle(b)),
        ("sgt", a.sgt(b)),
        ("sge", a.sge(b)),
        ("mux", c.mux(a, b)),
        ("shl", a.shl(constant)),
        ("shr", a.shr(constant)),
        ("sar", a.sar(constant)),
        ("shl_out_of", a.shl(far)),
        ("shr_out_of", a.shr(far)),
        ("sar_out_of", a.sar(far)),
        ("shl_by", a.shl_by(distance)),
        ("shr_by", a.shr_by(distance)),
        ("sar_by", a.sar_by(distance)),
        ("slice", a.slice(hi, lo)),
        ("any", a.any()),
        ("all", a.all()),
        ("parity", a.parity()),
        ("zext", a.zext((width + other).min(128))),
        ("sext", a.sext((width + other).min(128))),
    ];
    for (name, signal) in outputs {
        m.output(&format!("{name}_out"), signal);
    }
    // The names of Verilog's gates are taken, hence the suffix.
    if width + other <= 128 {
        m.output("mul_out", a * n);
        m.output("smul_out", a.smul(n));
    }
    if width + other < 128 {
        m.output("cat_out", m.cat(&[a, n, c]));
    }
    m
}

/// Compares all outputs for every stimulus; returns how many values were compared.
fn compare(width: u32, other: u32, stimuli: impl Iterator<Item = (u128, u128, u128, bool)>) -> usize {
    let netlist = module(width, other).finish().unwrap();
    let mut sim = simulator(&netlist);
    let mut compared = 0;
    for (a, b, n, c) in stimuli {
        for (name, value) in [("a", a), ("b", b), ("n", n), ("c", c.into())] {
            sim.set_input(name, value).unwrap();
        }
        let (a, b) = (Value { bits: a, width }, Value { bits: b, width });
        let n = Value { bits: n, width: other };
        for output in &netlist.outputs {
            let name = output.name.trim_end_matches("_out");
            let wanted = modulo(&expected(name, &a, &b, &n, c), netlist.width(output.driver));
            let found = sim.get(&output.name).unwrap();
            assert_eq!(found, wanted, "{name} of a {a:?} b {b:?} n {n:?} c {c}");
            compared += 1;
        }
    }
    compared
}

#[test]
fn all_values_of_small_widths() {
    let mut compared = 0;
    for width in 1..=4 {
        for other in 1..=3 {
            let values = (0..1u128 << width).flat_map(move |a| {
                (0..1u128 << width).flat_map(move |b| {
                    (0..1u128 << other).flat_map(move |n| [false, true].map(|c| (a, b, n, c)))
                })
            });
            compared += compare(width, other, values);
        }
    }
    assert_eq!(compared, 36 * 2 * (2 + 4 + 8) * (4 + 16 + 64 + 256), "every operator, every value");
}

#[test]
fn random_values_of_all_widths() {
    let mut random = Pcg64Mcg::new(1);
    let mut compared = 0;
    for width in 1..=128 {
        for other in [1, 7, 8, random.random_range(1..=128), 129 - width, 128 - width] {
            let other = other.max(1);
            let stimuli: Vec<_> = (0..30)
                .map(|_| {
                    let (a, b) = (corner_or_any(&mut random, width), corner_or_any(&mut random, width));
                    let b = if random.random_bool(0.1) { a } else { b };
                    (a, b, corner_or_any(&mut random, other), random.random())
                })
                .collect();
            compared += compare(width, other, stimuli.into_iter());
        }
    }
    assert!(compared > 600_000, "compared {compared}");
}

/// Half the time one of 0, 1, 2, the largest, and both sides of the sign change.
fn corner_or_any(random: &mut Pcg64Mcg, width: u32) -> u128 {
    let mask = u128::MAX >> (128 - width);
    let half = 1 << (width - 1);
    let corners = [0, 1, 2 & mask, mask, half, half - 1];
    if random.random() {
        corners[random.random_range(0..corners.len())]
    } else {
        random.random::<u128>() & mask
    }
}
