//! An edge as the cells of a row.

use super::{Shape, View, modulo};
use crate::tokens::EdgeWalk;
use edgewalk_machine::units::tokens::remainder_bits;
use edgewalk_machine::{EdgeKind, Plan};

impl EdgeWalk {
    /// What stands above the cells.
    pub(crate) const COLUMNS: [&'static str; 5] = ["C", "R", "q", "f", "M"];

    /// The cells; `wires` is what the netlist's registers of the edge begin with. R is none of them: they keep R - f.
    pub(crate) fn view(&self, plan: &Plan, wires: Option<&str>, view: &mut View) {
        let (column, remainder) = (plan.widths().column, remainder_bits(plan));
        let mut cell = |part: &str, doc: &str, shape: Shape, value: i32| {
            view.cell(doc, || shape, modulo(value.into(), shape.bits()));
            if let Some(wires) = wires.filter(|_| part != "dist") {
                view.wire(|| format!("{wires}_{part}"));
            }
        };
        cell("c", "first column on or right of the edge", Shape::signed(column), self.c);
        cell("dist", "distance from the edge to that column, 1/M column", Shape::whole(remainder), self.r);
        cell("q", "whole columns a line", Shape::signed(column), self.q);
        cell("f", "1/M column a line", Shape::whole(remainder), self.f);
        // The modulus of a slope is 2^F, and no register.
        match plan.edge_kind {
            EdgeKind::Exact => cell("m", "modulus of R and f", Shape::whole(remainder), self.m),
            EdgeKind::Slope => {
                _ = view.cell("modulus of R and f", || Shape::whole(remainder + 1), self.m as u64)
            }
        }
    }
}
