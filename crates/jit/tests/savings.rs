//! Small circuits and what a clock of each costs: a line for each saving that the presets ([cost](cost.rs)) do not show by themselves.
//! None changes a value, so nothing else would see one undone.
//! After a change that is meant: `UPDATE_EXPECT=1 cargo test --release -p edgewalk-jit --test savings`.
#![allow(clippy::unwrap_used)] // a test may
#![allow(clippy::erasing_op)] // that it comes to 0 is what is looked at

use edgewalk_jit::{Cost, Simulator};
use edgewalk_netlist::{Module, Signal};
use expect_test::expect_file;

type Relation = for<'m> fn(Signal<'m>, Signal<'m>) -> [Signal<'m>; 2];
type Reader = for<'m> fn(Signal<'m>) -> Signal<'m>;
type Way = for<'m> fn(&'m Module, Signal<'m>, Signal<'m>, Signal<'m>);

/// What a clock of a circuit costs, as a line.
fn line(name: &str, circuit: impl Fn(&Module)) -> String {
    let m = Module::new("circuit", "");
    circuit(&m);
    let Cost { instructions, loads, stores, blocks } = Simulator::new(&m.finish().unwrap()).unwrap().cost();
    format!("{name}: {instructions} instructions, {loads} loads, {stores} stores, {blocks} blocks\n")
}

/// A line for each way with a bit and two words.
fn lines(ways: &[(&str, Way)]) -> String {
    let line = |(name, way): &(&str, Way)| {
        line(name, |m| {
            let c = m.input("c", 1);
            let [a, b] = inputs(m, 20, ["a", "b"]);
            way(m, c, a, b);
        })
    };
    ways.iter().map(line).collect()
}

fn inputs<'m, const N: usize>(m: &'m Module, width: u32, names: [&str; N]) -> [Signal<'m>; N] {
    names.map(|name| m.input(name, width))
}

/// A condition and its opposite are worked out once.
#[test]
fn opposites() {
    let relations: [(&str, Relation); 6] = [
        ("ge, lt", |a, b| [a.ge(b), a.lt(b)]),
        ("le, gt", |a, b| [a.le(b), a.gt(b)]),
        ("ne, eq", |a, b| [a.ne(b), a.eq(b)]),
        ("gt, lt turned", |a, b| [a.gt(b), b.lt(a)]),
        ("ge, lt signed", |a, b| [a.sge(b), a.slt(b)]),
        ("le, gt signed", |a, b| [a.sle(b), a.sgt(b)]),
    ];
    let mut costs = String::new();
    for (name, relation) in relations {
        costs += &line(name, |m| {
            let [a, b, p, q] = inputs(m, 20, ["a", "b", "p", "q"]);
            let [one, other] = relation(a, b);
            m.output("one", one.mux(p, q));
            m.output("other", other.mux(p, q));
        });
    }
    expect_file!["snapshots/opposites.txt"].assert_eq(&costs);
}

/// Operators that come to less: a constant, an operand, a cheaper one.
#[test]
fn simpler_ways_to_say_it() {
    let ways: [(&str, Way); 19] = [
        ("c ? 1 : bit", |m, c, a, _| m.output("y", c.mux(m.lit(1, 1), a.msb()))),
        ("c ? bit : 0", |m, c, a, _| m.output("y", c.mux(a.msb(), m.lit(1, 0)))),
        ("c ? 0 : 1", |m, c, _, _| m.output("y", c.mux(m.lit(1, 0), m.lit(1, 1)))),
        ("c ? 1 : 0", |m, c, _, _| m.output("y", c.mux(m.lit(1, 1), m.lit(1, 0)))),
        ("c ? a : a", |m, c, a, _| m.output("y", c.mux(a, a))),
        ("!c ? a : b", |m, c, a, b| m.output("y", (!c).mux(a, b))),
        ("c ? a : c ? b : a + b", |m, c, a, b| m.output("y", c.mux(a, c.mux(b, a + b)))),
        ("1 ? a : b", |m, _, a, b| m.output("y", m.lit(1, 1).mux(a, b))),
        ("0 ? a : b", |m, _, a, b| m.output("y", m.lit(1, 0).mux(a, b))),
        ("a == 0", |m, _, a, _| m.output("y", a.eq(0))),
        ("c == 0, c == 1", |m, c, _, _| m.output("y", m.cat(&[c.eq(0), c.eq(1)]))),
        ("!!a", |m, _, a, _| m.output("y", !!a)),
        ("a & 0, a & ones, a | 0, a | ones", |m, _, a, _| {
            m.output("y", m.cat(&[a & 0, a & 0xfffff, a | 0, a | 0xfffff]));
        }),
        ("a & a, a | a", |m, _, a, _| m.output("y", m.cat(&[a & a, a | a]))),
        ("a + 0, 0 + a, a - 0", |m, _, a, _| {
            m.output("y", m.cat(&[a + m.lit(20, 0), m.lit(20, 0) + a, a - m.lit(20, 0)]));
        }),
        ("bits of bits", |m, _, a, _| m.output("y", a.slice(17, 2).slice(9, 3))),
        ("bits of extensions", |m, _, a, b| {
            m.output("y", m.cat(&[a.sext(40).slice(9, 3), b.zext(40).slice(9, 3), b.zext(40).slice(39, 20)]));
        }),
        ("bits of parts", |m, _, a, b| m.output("y", m.cat(&[a, b]).slice(33, 22))),
        ("bits of one of two words", |m, _, a, b| {
            let sum = a.sext(90) + b.zext(90);
            m.output("y", m.cat(&[sum.slice(40, 20), sum.slice(80, 70), sum.slice(70, 60)]));
        }),
    ];
    expect_file!["snapshots/simpler.txt"].assert_eq(&lines(&ways));
}

/// An arm of a choice gets a branch from so many instructions on; those of more than 64 bits count for more.
#[test]
fn arms_with_branches() {
    let mut costs = String::new();
    for (width, sums) in [(20, 6), (20, 7), (20, 8), (20, 9), (63, 3), (64, 3), (65, 2), (65, 3)] {
        costs += &line(&format!("an arm of {sums} sums of {width} bits"), |m| {
            let c = m.input("c", 1);
            let values: Vec<Signal> = (0..=sums).map(|i| m.input(&format!("a{i}"), width)).collect();
            let sum = values[1..].iter().fold(values[0], |sum, value| sum + *value);
            m.output("y", c.mux(sum, values[0]));
        });
    }
    for deep in [63, 64, 65, 80] {
        costs += &line(&format!("arms in arms, {deep} deep"), |m| {
            let values: Vec<Signal> = (0..=deep).map(|i| m.input(&format!("a{i}"), 20)).collect();
            let mut arm = values[deep];
            for i in 0..deep {
                arm = (0..9).fold(arm, |sum, k| (sum ^ values[(i + k) % deep]) + values[i]);
                arm = m.input(&format!("c{i}"), 1).mux(arm, values[i]);
            }
            m.output("y", arm);
        });
    }
    for sums in [10, 11] {
        costs += &line(&format!("a bit and one of {sums} sums"), |m| {
            let c = m.input("c", 1);
            let values: Vec<Signal> = (0..=sums).map(|i| m.input(&format!("a{i}"), 20)).collect();
            let sum = values[1..].iter().fold(values[0], |sum, value| sum + *value);
            m.output("y", c & sum.lt(values[0]));
        });
    }
    costs += &line("an arm that reads a sum of 6 twice", |m| {
        let c = m.input("c", 1);
        let values: Vec<Signal> = (0..=6).map(|i| m.input(&format!("a{i}"), 20)).collect();
        let sum = values[1..].iter().fold(values[0], |sum, value| sum + *value);
        m.output("y", c.mux(sum ^ sum.shl(1), values[0]));
    });
    costs += &line("an arm that is read elsewhere", |m| {
        let c = m.input("c", 1);
        let values: Vec<Signal> = (0..=9).map(|i| m.input(&format!("a{i}"), 20)).collect();
        let sum = values[1..].iter().fold(values[0], |sum, value| sum + *value);
        m.output("y", c.mux(sum, values[0]));
        m.output("sum", sum);
    });
    expect_file!["snapshots/arms.txt"].assert_eq(&costs);
}

/// Registers kept with their sign above their bits, or with zeros: as they are read more often.
#[test]
fn registers_with_signs() {
    let readers: [(&str, Reader); 8] = [
        ("extended with its sign", |q| q.sext(30)),
        ("shifted with its sign", |q| q.sar(3).zext(30)),
        ("its sign", |q| q.msb().zext(30)),
        ("its upper bits", |q| q.slice(19, 8).zext(30)),
        ("extended with zeros", |q| q.zext(30)),
        ("less than, signed", |q| q.slt(100).zext(30)),
        ("its sum, with its sign", |q| (q + 5).sext(30)),
        ("its lower bits", |q| q.slice(8, 2).zext(30)),
    ];
    let mut costs = String::new();
    for (name, reader) in readers {
        costs += &line(name, |m| {
            let c = m.input("c", 1);
            let [a, b] = inputs(m, 20, ["a", "b"]);
            let register = m.reg("register", 20);
            register.set(c.mux(register.q() + a, b));
            m.output("y", reader(register.q()));
        });
    }
    costs += &line("of parts, the first with its sign", |m| {
        let [a, b] = inputs(m, 20, ["a", "b"]);
        m.output("y", m.cat(&[a.sext(25), b]).sext(50));
        m.output("z", m.cat(&[a.sext(25), b]).sext(70));
    });
    expect_file!["snapshots/signs.txt"].assert_eq(&costs);
}

/// Signs of words that the processor has, of others, and of more than one word.
#[test]
fn signed_words() {
    let mut costs = String::new();
    for width in [8, 16, 31, 32, 64, 80] {
        costs += &line(&format!("less than, {width} bits"), |m| {
            let [a, b] = inputs(m, width, ["a", "b"]);
            m.output("y", (a + b).slt(b));
        });
    }
    expect_file!["snapshots/signed.txt"].assert_eq(&costs);
}

/// Registers that change together share a branch; one that changes before it is read costs a copy.
#[test]
fn registers_that_change() {
    let mut costs = String::new();
    costs += &line("by the same bit", |m| {
        let c = m.input("c", 1);
        for i in 0..4 {
            let [a, b] = [format!("a{i}"), format!("b{i}")].map(|name| m.input(&name, 20));
            m.reg(&format!("r{i}"), 20).set(c.mux(a + b, b));
        }
    });
    costs += &line("by the same bit, to values that are known", |m| {
        let c = m.input("c", 1);
        for i in 0..4 {
            let [a, b] = [format!("a{i}"), format!("b{i}")].map(|name| m.input(&name, 20));
            let value = c.mux(a, b);
            m.reg(&format!("r{i}"), 20).set(value);
            m.output(&format!("y{i}"), value);
        }
    });
    costs += &line("one after the other", |m| {
        let mut value = m.input("a", 20);
        for i in 0..6 {
            let register = m.reg(&format!("r{i}"), 20);
            register.set(value);
            value = register.q();
        }
        m.output("y", value);
    });
    costs += &line("one after the other, each by its own bit", |m| {
        let mut value = m.input("a", 20);
        for i in 0..6 {
            let register = m.reg(&format!("r{i}"), 20);
            register.when(m.input(&format!("c{i}"), 1), value);
            value = register.q();
        }
        m.output("y", value);
    });
    costs += &line("around", |m| {
        let bits = inputs(m, 1, ["c0", "c1"]);
        let registers = [0, 1, 2, 3].map(|i| m.reg(&format!("r{i}"), 20));
        for i in 0..4 {
            registers[i].when(bits[i % 2], registers[(i + 1) % 4].q() + 1);
        }
        m.output("y", registers[0].q());
    });
    costs += &line("the same in every clock", |m| {
        let a = m.input("a", 20);
        for i in 0..3 {
            let register = m.reg(&format!("r{i}"), 20).reset(0);
            register.set(register.q() + a);
            m.output(&format!("y{i}"), register.q());
        }
    });
    costs += &line("in every clock, and one to another value by a bit", |m| {
        let [c, a] = [m.input("c", 1), m.input("a", 20)];
        let registers = [0, 1, 2].map(|i| m.reg(&format!("r{i}"), 20));
        registers[0].set(registers[1].q()).when(c, a);
        registers[1].set(registers[2].q() + 1);
        registers[2].when(a.bit(0), registers[0].q() ^ registers[1].q());
        m.output("y", registers[0].q());
    });
    costs += &line("read back from a memory", |m| {
        let [write, read] = inputs(m, 1, ["write", "read"]);
        let [to, from] = inputs(m, 3, ["to", "from"]);
        let memory = m.memory("memory", 3, 8, 20).write(write, to, m.input("a", 20));
        m.output("y", memory.read(read, from) + 1);
        m.output("z", memory.read(read, to));
    });
    costs += &line("looked up", |m| {
        let code = m.input("code", 4);
        m.output("y", code.eq(3) | code.eq(5) | code.ge(12));
        m.output("z", (code.zext(8) + 3) ^ 0x55);
    });
    expect_file!["snapshots/changes.txt"].assert_eq(&costs);
}

/// A bit that is read or worked out as a word stays one, with anything above it.
#[test]
fn bits_as_words() {
    let readers: [(&str, Way); 7] = [
        ("a bit of a sum", |m, _, a, b| m.output("y", (a + b).bit(7))),
        ("a bit of a sum, and another", |m, c, a, b| m.output("y", (a + b).bit(7) & c)),
        ("the opposite of a bit of a sum, and another", |m, c, a, b| m.output("y", !(a + b).bit(7) & c)),
        ("the opposite of a relation, and another", |m, c, a, b| m.output("y", !a.lt(b) & c)),
        ("copies of a bit of a sum", |m, _, a, b| m.output("y", (a + b).bit(7).sext(20))),
        ("a bit below a word", |m, c, a, _| m.output("y", m.cat(&[a, c]))),
        ("a bit of a sum below a word", |m, _, a, b| m.output("y", m.cat(&[a, (a + b).bit(7)]))),
    ];
    let mut costs = String::new();
    for (name, reader) in readers {
        costs += &line(name, |m| {
            let c = m.input("c", 1);
            let [a, b] = inputs(m, 20, ["a", "b"]);
            reader(m, c, a, b);
        });
    }
    expect_file!["snapshots/bits.txt"].assert_eq(&costs);
}

/// Two registers that take what two neighbours are, one load and one store; not in other forms, or if one is not a neighbour.
#[test]
fn stages_of_queues() {
    let stage = |m: &Module, turned: bool, signed: bool, compared: bool| {
        let words = inputs(m, 20, ["in0", "in1"]);
        let first = [0, 1].map(|i| m.reg(&format!("a{i}"), 20).set(words[i] + 1).q());
        let c = m.input("c", 1);
        for i in 0..2 {
            let register = m.reg(&format!("b{i}"), 20);
            let value = first[if turned { 1 - i } else { i }];
            let last = if compared { register.set(value).q() } else { register.when(c, value).q() };
            m.output(&format!("y{i}"), if signed && i == 1 { last.sext(30) } else { last });
            if compared {
                let other = Module::new(&format!("other{i}"), "");
                let sees = other.input("sees", 20);
                other.output("sum", other.reg("sum", 20).when(other.input("c", 1), sees + 1).q());
                let other = m.instance(&format!("u_{i}"), &other.finish().unwrap());
                other.connect("sees", last).connect("c", c);
                m.output(&format!("z{i}"), other.output("sum"));
            }
        }
    };
    let mut costs = String::new();
    costs += &line("two words", |m| stage(m, false, false, false));
    costs += &line("two words, turned round", |m| stage(m, true, false, false));
    costs += &line("two words, one kept with its sign", |m| stage(m, false, true, false));
    costs += &line("two words that other units follow from", |m| stage(m, false, false, true));
    expect_file!["snapshots/queues.txt"].assert_eq(&costs);
}

/// What several steps need is not kept a second time where it is there anyway.
#[test]
fn kept_once() {
    let ways: [(&str, Way); 6] = [
        ("a bit of a sum", |m, c, a, b| {
            let bit = ((a + b) ^ (a - b)).bit(7);
            for i in 0..6 {
                let register = m.reg(&format!("x{i}"), 20);
                register
                    .when(if i % 2 == 0 { c } else { a.bit(i) }, m.cat(&[b.slice(18, 0), bit ^ b.bit(i)]));
                m.output(&format!("y{i}"), register.q());
            }
            m.output("q", m.reg("y", 1).when(bit, !c).q());
        }),
        ("a sum that a register takes", |m, _, a, b| {
            m.output("p", m.reg("x", 20).set(a + b).q());
            m.output("q", m.reg("y", 20).when(a.bit(0), (a + b) ^ a).q());
        }),
        ("a sum that a register takes with its sign", |m, _, a, b| {
            m.output("p", m.reg("x", 20).set(a + b).q().sext(30));
            m.output("q", m.reg("y", 20).when(a.bit(0), (a + b) ^ a).q());
        }),
        ("a sum that a register takes if a bit says so", |m, c, a, b| {
            m.output("p", m.reg("x", 20).when(c, a + b).q());
            m.output("q", m.reg("y", 20).when(a.bit(0), (a + b) ^ a).q());
        }),
        ("a register with zeros above, and a bit's opposite", |m, c, a, _| {
            m.output("p", m.reg("x", 30).when(c, a.zext(30) + 1).q());
            m.output("q", m.reg("y", 30).when(a.bit(0), a.zext(30) + 2).q());
            m.output("r", m.reg("z", 1).when(a.bit(1), !c).q() ^ !c);
        }),
        ("a register's upper bits", |m, c, a, _| {
            m.output("p", m.reg("x", 10).when(c, a.slice(19, 10) + 1).q());
            m.output("q", m.reg("y", 10).when(a.bit(0), a.slice(19, 10) + 2).q());
        }),
    ];
    expect_file!["snapshots/kept.txt"].assert_eq(&lines(&ways));
}

/// A choice among registers by a number is read at an address, if all of them are as they were and are kept alike.
#[test]
fn choices_among_registers() {
    fn choice(m: &Module, widths: [u32; 4], signed: bool) -> Signal<'_> {
        let [c, number] = [m.input("c", 1), m.input("number", 2)];
        let registers: Vec<Signal> = (0..4)
            .map(|i| m.reg(&format!("r{i}"), widths[i]).when(c, m.input(&format!("in{i}"), widths[i])).q())
            .collect();
        if signed {
            m.output("sign", registers[2].sext(60));
        }
        let [p, q, r, s] = [0, 1, 2, 3].map(|i| registers[i].zext(20));
        number.eq(3).mux(p, number.eq(1).mux(q, number.bit(1).mux(r, s)))
    }
    let mut costs = String::new();
    costs += &line("one of four", |m| m.output("y", choice(m, [20; 4], false)));
    costs += &line("one of four, of other widths", |m| m.output("y", choice(m, [20, 7, 12, 20], false)));
    costs += &line("one of four, one kept with its sign", |m| m.output("y", choice(m, [20; 4], true)));
    let readers: [(&str, Way); 5] = [
        ("one of two", |m, c, a, b| m.output("y", c.mux(a, b))),
        ("one of two, by a bit that is worked out", |m, c, a, b| m.output("y", (c ^ a.lt(b)).mux(a, b))),
        ("one of two, or a number", |m, c, a, _| m.output("y", c.mux(a, m.lit(20, 7)))),
        ("one of two bits", |m, c, a, b| m.output("y", c.mux(a.bit(3), b.bit(3)))),
        ("one of two, of which one has changed", |m, c, a, b| {
            let register = m.reg("register", 20);
            register.when(c, a ^ b);
            m.output("y", m.reg("after", 20).when(register.q().bit(0), c.mux(register.q(), a)).q());
        }),
    ];
    for (name, reader) in readers {
        costs += &line(name, |m| {
            let c = m.input("c", 1);
            let [a, b] = inputs(m, 20, ["a", "b"]);
            reader(m, c, a, b);
        });
    }
    expect_file!["snapshots/arrays.txt"].assert_eq(&costs);
}

/// Registers in a unit of their own: a counter that its unit does not see, and what follows from registers that stay for a while.
#[test]
fn free_running_and_calm_registers_get_units() {
    let mut costs = String::new();
    for (name, hides) in [("a counter that a bit hides", true), ("a counter that is seen", false)] {
        costs += &line(name, |m| {
            let [go, load] = inputs(m, 1, ["go", "load"]);
            let (count, adds) = (m.reg("count", 5), m.reg("adds", 1));
            count.set(count.q() - 1).when(go, m.input("from", 5));
            adds.when(count.q().eq(0), 0).when(go, 1);
            let sum = m.reg("sum", 20);
            sum.when(if hides { adds.q() } else { load }, sum.q() + count.q().zext(20));
            m.output("y", sum.q());
        });
    }
    // The same by a choice: of what is added, and of what is not.
    for (name, hidden_is_one) in
        [("by a choice, where the bit is 0", false), ("by a choice, where it is 1", true)]
    {
        costs += &line(name, |m| {
            let go = m.input("go", 1);
            let (count, adds) = (m.reg("count", 5), m.reg("adds", 1));
            count.set(count.q() - 1).when(go, m.input("from", 5));
            adds.when(count.q().eq(0), 0).when(go, 1);
            let sum = m.reg("sum", 20);
            let (seen, unseen) = (sum.q() + count.q().zext(20), sum.q() + 1);
            sum.set(if hidden_is_one { (!adds.q()).mux(unseen, seen) } else { adds.q().mux(seen, unseen) });
            m.output("y", sum.q());
        });
    }
    for calm in [5, 6] {
        costs += &line(&format!("{calm} differences of corners"), |m| {
            let load = m.input("load", 1);
            let corners =
                [0, 1, 2, 3].map(|i| m.reg(&format!("r{i}"), 20).when(load, m.input(&format!("a{i}"), 20)));
            for i in 0..calm {
                let [a, b] = [corners[i % 4].q(), corners[(i + 1 + i / 4) % 4].q()];
                let larger = a.lt(b).mux(b, a);
                m.output(&format!("y{i}"), m.reg(&format!("d{i}"), 20).set(larger - b).q());
            }
            m.output("y", load);
        });
    }
    for registers in [1, 2, 4] {
        costs += &line(&format!("{registers} registers that another unit follows from"), |m| {
            let other = Module::new("other", "");
            let sees: Vec<Signal> = (0..registers).map(|i| other.input(&format!("sees{i}"), 20)).collect();
            let sum = sees[1..].iter().fold(sees[0], |sum, value| sum + *value);
            other.output("sum", other.reg("sum", 20).set(sum).q());
            let other = m.instance("u_other", &other.finish().unwrap());
            for i in 0..registers {
                let register = m.reg(&format!("r{i}"), 20).set(m.input(&format!("a{i}"), 20) + 1);
                other.connect(&format!("sees{i}"), register.q());
            }
            m.output("sum", other.output("sum"));
        });
    }
    expect_file!["snapshots/free_running.txt"].assert_eq(&costs);
}
