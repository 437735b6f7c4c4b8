//! Which lines of the screen the two parts of a triangle meet.

use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::control::Control;
use super::schedule::Op;
use super::sort::Vertices;
use crate::wires::Registers;

/// First lines, signed, G + 2 bits.
pub(super) struct Lines<'m> {
    /// Of the triangle.
    pub jm: Signal<'m>,
    /// Of the upper part.
    pub j0: Signal<'m>,
    /// Of the lower part.
    pub j1: Signal<'m>,
    /// There is no line.
    pub none: Signal<'m>,
}

impl<'m> Lines<'m> {
    /// j0, j1 and the counts n1, n2 of the prim, taken at the first clock of the operations.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        control: &Control<'m>,
        vertices: &Vertices<'m>,
        prim: &Registers<'m>,
    ) -> Lines<'m> {
        let [j0, j1, n1, n2] = match plan.fill {
            Fill::Exact => exact(m, plan, vertices),
            Fill::Textbook => textbook(m, plan, vertices),
        };
        let take = (control.load & control.during(&[Op::EdgeStep])).named("take_lines");
        let count = |name: &str, n: Signal<'m>| prim[name].when(take, n.trunc(prim[name].q().width())).q();
        let (n1, n2) = (count("n1", n1), count("n2", n2));
        let line = |name: &str, j: Signal<'m>| m.reg(name, j.width()).doc("line, signed").when(take, j).q();
        let (j0, j1) = (line("j0", j0), line("j1", j1));
        let upper = n1.any().named("upper");
        let jm = upper.mux(j0, j1).named_doc("jm", "first line of the triangle");
        Lines { jm, j0, j1, none: !upper & !n2.any() }
    }
}

fn at_least<'m>(a: Signal<'m>, b: Signal<'m>) -> Signal<'m> {
    a.slt(b).mux(b, a)
}

fn at_most<'m>(a: Signal<'m>, b: Signal<'m>) -> Signal<'m> {
    a.slt(b).mux(a, b)
}

/// Centres from vertex to vertex, the upper end included, the lower not.
fn exact<'m>(m: &'m Module, plan: &Plan, vertices: &Vertices<'m>) -> [Signal<'m>; 4] {
    m.comment("Lines: from ceil(v/P) of the upper to before ceil(v/P) of the lower end, on the screen.");
    let (bits, t) = (plan.widths().column, plan.widths().center_fraction);
    let ceil = |place: usize| {
        let v = vertices.v(place);
        let up = v.trunc(t).any().zext(bits);
        (v.slice(v.width() - 1, t).sext(bits) + up).named_doc(&format!("line{place}"), "ceil(v/P)")
    };
    let j0 = at_least(ceil(0), m.lit(bits, 0)).named("j0_next");
    let end = at_least(at_most(ceil(2), m.lit(bits, plan.height.into())), j0).named("end_line");
    let j1 = at_most(at_least(ceil(1), j0), end).named("j1_next");
    [j0, j1, j1 - j0, end - j1]
}

/// Lines from vertex to vertex, both included; a part without height has none.
fn textbook<'m>(m: &'m Module, plan: &Plan, vertices: &Vertices<'m>) -> [Signal<'m>; 4] {
    m.comment("Lines of each part: from Y of the upper to Y of the lower end, both drawn, on the screen.");
    let (bits, t) = (plan.widths().column, plan.widths().center_fraction);
    let y = |place: usize| vertices.v(place).slice(plan.widths().center - 1, t).sext(bits);
    let first = |place: usize, name: &str| at_least(y(place), m.lit(bits, 0)).named(name);
    let (j0, j1) = (first(0, "j0_next"), first(1, "j1_next"));
    let count = |part: usize, first: Signal<'m>| {
        let last =
            at_most(y(part + 1), m.lit(bits, u128::from(plan.height) - 1)).named(&format!("last{part}"));
        let some = (y(part).slt(y(part + 1)) & first.sle(last)).named(&format!("some{part}"));
        some.mux(last - first + 1, 0)
    };
    [j0, j1, count(0, j0), count(1, j1)]
}
