//! Every fault is reported with the module, the names and the line that built it; nothing panics.
#![allow(clippy::unwrap_used)] // a test may

use edgewalk_netlist::{Fault, Module};

/// The faults of a module with a clean rest: one output, so that it is not empty.
fn faults(build: impl FnOnce(&Module)) -> Vec<Fault> {
    let m = Module::new("top", "");
    build(&m);
    match m.finish() {
        Ok(_) => Vec::new(),
        Err(errors) => errors.0.into_iter().map(|error| error.fault).collect(),
    }
}

fn messages(build: impl FnOnce(&Module)) -> Vec<String> {
    faults(build).iter().map(Fault::to_string).collect()
}

#[test]
fn operands_of_different_width() {
    let found = messages(|m| {
        let sum = m.input("a", 8) + m.input("b", 9);
        assert_eq!(sum.width(), 8, "stands in with the width of the left");
        m.output("q", sum);
    });
    assert_eq!(found, ["`Add(a, b)`: 8 bits against 9"]);
}

#[test]
fn error_names_the_line_and_the_module() {
    let m = Module::new("top", "");
    let line = line!() + 1;
    m.output("q", m.input("a", 8).slice(8, 1));
    let error = m.finish().unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("{}:{line}: module `top`: `Slice {{ hi: 8, lo: 1 }}(a)`: bits 8..1 of 8", file!())
    );
}

#[test]
fn widths_of_registers_outputs_and_conditions() {
    let found = messages(|m| {
        let (a, b) = (m.input("a", 8), m.input("b", 4));
        m.reg("r", 8).when(b, a);
        m.reg("s", 8).set(b);
        m.reg("t", 4).reset(16).set(b);
        m.wire("w", 4).drive(a);
        m.output("q", b.mux(a, b.zext(8)));
        m.output("p", a.lt(256));
        m.output("o", a.slt(-129));
        m.output("n", b.any().mux(1, 2));
        m.input("z", 0);
        m.input("y", 129);
    });
    assert_eq!(
        found,
        [
            "`condition of r` has 1 bits, but `b` has 4",
            "`s` has 8 bits, but `b` has 4",
            "16 does not fit in 4 bits",
            "`w` has 4 bits, but `a` has 8",
            "`Mux(b, a, ZeroExtend(8)(b))`: the condition has 4 bits instead of 1",
            "256 does not fit in 8 bits",
            "-129 does not fit in 8 bits",
            "a number without a width: one side must be a signal",
            "`z` has 0 bits, outside 1..=128",
            "`y` has 129 bits, outside 1..=128",
        ]
    );
}

#[test]
fn names() {
    let found = messages(|m| {
        let a = m.input("a", 1);
        m.output("a", a);
        m.output("wire", a);
        m.output("2x", a);
        m.output("clk", a);
        a.named("b");
        m.reg("b", 1).set(a);
    });
    assert_eq!(
        found,
        [
            "`a` is there twice",
            "`wire` is no legal Verilog name",
            "`2x` is no legal Verilog name",
            "`clk` is no legal Verilog name",
            "`b` is there twice",
        ]
    );
}

#[test]
fn an_output_may_bear_the_name_of_what_drives_it() {
    let found = faults(|m| {
        let a = m.input("a", 1);
        let r = m.reg("r", 1).set(a);
        m.output("r", r);
        m.output("s", (a & r.q()).named("s"));
    });
    assert_eq!(found, []);
}

#[test]
fn undriven_and_driven_twice() {
    let child = Module::new("child", "");
    child.output("q", child.input("a", 3) + child.input("b", 3));
    let child = child.finish().unwrap();
    let found = messages(|m| {
        let a = m.input("a", 3);
        m.reg("r", 3);
        m.wire("w", 3);
        let v = m.wire("v", 3);
        v.drive(a);
        v.drive(a);
        let u = m.instance("u", &child);
        u.connect("a", a).connect("a", a).connect("c", a).connect("q", a);
        u.output("p");
    });
    assert_eq!(
        found,
        [
            "`v` is driven twice",
            "`u.a` is driven twice",
            "module `child` has no input `c`; it has a, b",
            "module `child` has no input `q`; it has a, b",
            "module `child` has no output `p`; it has q",
            "nothing drives `r`",
            "nothing drives `w`",
            "nothing drives `u.b`",
        ]
    );
}

#[test]
fn signals_of_another_module() {
    let other = Module::new("other", "");
    let foreign = other.input("x", 4);
    let m = Module::new("top", "");
    m.output("q", m.input("a", 4) + foreign);
    let error = m.finish().unwrap_err();
    assert_eq!(error.0[0].fault.to_string(), "`x` belongs to another module");
}

#[test]
fn two_modules_of_one_name() {
    let make = |width| {
        let m = Module::new("child", "");
        m.output("q", !m.input("a", width));
        m.finish().unwrap()
    };
    let (one, two) = (make(1), make(2));
    let found = messages(|m| {
        m.instance("u1", &one).connect("a", m.input("a", 1));
        m.instance("u2", &two).connect("a", m.input("b", 2));
    });
    assert_eq!(found, ["there are two different modules `child` in it"]);
}

#[test]
fn memories_that_can_not_be() {
    let found = messages(|m| {
        m.memory("none", 4, 0, 8).starts(0);
        m.memory("far", 4, 17, 8).starts(0);
        m.memory("near", 4, 8, 8).starts(0);
        m.memory("full", 4, 16, 8).starts(256);
    });
    assert_eq!(
        found,
        [
            "memory `none`: 0 words with an address of 4 bits",
            "memory `far`: 17 words with an address of 4 bits",
            "memory `near`: 8 words with an address of 4 bits",
            "256 does not fit in 8 bits",
        ]
    );
}

#[test]
fn contents_that_can_not_be() {
    let found = messages(|m| {
        let rom = m.memory("rom", 2, 4, 8).holds(0, 1, "").holds(1, 256, "").holds(1, 2, "").holds(4, 0, "");
        m.output("q", rom.read(m.lit(1, 1), m.input("addr", 2)));
        let full = m.memory("full", 1, 2, 8).holds(1, 3, "").starts(0);
        m.output("p", full.read(m.lit(1, 1), m.input("low", 1)));
    });
    assert_eq!(
        found,
        [
            "256 does not fit in 8 bits",
            "word 1 of memory `rom` is given contents twice",
            "memory `rom` has 4 words: there is no word 4 to hold anything",
            "nothing writes memory `rom`, but word 2 has no contents: every word of a ROM needs them",
        ]
    );
}

#[test]
fn a_loop_is_reported_by_its_names() {
    let found = messages(|m| {
        let a = m.input("a", 4);
        let w = m.wire("w", 4);
        let next = (w.q() + a).named("next");
        w.drive(next ^ 1);
        m.output("q", next);
    });
    assert_eq!(found, ["combinational loop: w -> next -> w"]);
}

#[test]
fn a_loop_through_instances_only_where_it_is_one() {
    let child = Module::new("child", "");
    child.output("through", !child.input("a", 1));
    child.output("held", child.reg("r", 1).set(child.input("b", 1)));
    let child = child.finish().unwrap();
    let ring = |port: &'static str| {
        let child = child.clone();
        move |m: &Module| {
            let back = m.wire("back", 1);
            let one = m.instance("one", &child).connect("a", back).connect("b", back);
            let two = m.instance("two", &child).connect("a", one.output(port)).connect("b", one.output(port));
            back.drive(two.output(port));
            m.output("q", back);
        }
    };
    assert_eq!(messages(ring("held")), [] as [&str; 0]);
    assert_eq!(messages(ring("through")), ["combinational loop: back -> one.through -> two.through -> back"]);
}
