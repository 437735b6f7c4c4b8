//! What is to be seen of EDGE.

use super::Edge;
use crate::tokens::EdgeWalk;
use crate::tokens::Prim;
use crate::view::{View, increment, word};
use edgewalk_machine::units::tokens::{remainder_bits, results};
use edgewalk_machine::{Fill, Plan};

impl<const C: usize> Edge<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(
        &self,
        plan: &Plan,
        prim: Option<&Prim<C>>,
        fresh_queued: bool,
        line_ready: bool,
        view: &mut View,
    ) {
        view.unit(plan, "edge");
        let w = plan.widths();
        view.triangle(self.running.then_some(self.line.source.id));
        let running = view.flag("running", "a triangle is being walked", self.running);
        view.wire(|| "running".to_owned());
        view.live(Some(running));
        let y = view.number("y", "line on the screen", w.line, self.line.y);
        view.wire(|| "line_y".to_owned());
        view.number("n1", "lines left of the upper part", w.line + 1, self.remaining[0]);
        view.wire(|| "n1".to_owned());
        view.number("n2", "lines left of the lower part", w.line + 1, self.remaining[1]);
        view.wire(|| "n2".to_owned());
        view.flag("fresh", "first line of the triangle", self.line.fresh);
        view.wire(|| "line_fresh".to_owned());
        view.flag("major_right", "the major edge is the right one", self.line.major_right);
        view.wire(|| "line_major_right".to_owned());
        if plan.polygon.has_lines() {
            view.flag("thin", "a line, a pixel wide", self.line.thin);
            view.wire(|| "line_thin".to_owned());
            view.flag("flat", "of a line: x and y have changed places", self.line.flat);
            view.wire(|| "line_flat".to_owned());
        }
        view.table("edges", &EdgeWalk::COLUMNS, false);
        view.row("major");
        self.major.view(plan, Some("major"), view);
        view.row("minor");
        self.minor.view(plan, Some("minor"), view);
        view.row("second");
        self.held.minor[1].view(plan, Some("second"), view);
        let carry = self.major.r < self.major.f;
        view.flag("carry", "R < f of the major edge: the column goes one further", carry);
        view.wire(|| "carry".to_owned());
        let bits = remainder_bits(plan) + 1;
        for (edge, name) in
            [(&self.major, "major_rest"), (&self.minor, "minor_rest"), (&self.held.minor[1], "second_rest")]
        {
            let rest = i64::from(edge.r) - i64::from(edge.f);
            view.signed(name, "R − f of the edge: what the hardware's register holds", bits, rest);
            view.wire(|| name.to_owned());
        }
        self.view_channels(plan, view);
        view.live(None);
        view.lane(y, self.running);
        view.band(y);
        self.say(plan, prim.is_some(), fresh_queued, line_ready, view);
        view.gives("line", Some("span"), self.running, line_ready);
        view.step("line", 'l');
    }

    fn view_channels(&self, plan: &Plan, view: &mut View) {
        let names = || results(plan).iter().map(|(name, _)| *name);
        let steps: Vec<&str> = names().filter(|name| name.starts_with('d')).collect();
        let columns: Vec<&str> = std::iter::once("value").chain(steps.iter().copied()).collect();
        view.table("values, LSB", &columns, false);
        for (i, channel) in plan.channels().iter().enumerate() {
            view.row(channel.name);
            view.cell("at the first pixel of the line", || word(channel), self.line.values[i]);
            view.wire(|| format!("line_{}", channel.name));
            for (name, delta) in steps.iter().zip(&self.held.delta) {
                let doc = match plan.fill {
                    Fill::Exact => "to the next line, d1 with a carry, d0 without",
                    Fill::Textbook => "to the next line of the part",
                };
                view.cell(doc, || increment(channel), delta[i]);
                view.wire(|| format!("{}_{name}", channel.name));
            }
        }
        let second = names().any(|name| name == "start_b");
        view.table("held, LSB", if second { &["g", "start_b"] } else { &["g"] }, true);
        for (i, channel) in plan.channels().iter().enumerate() {
            view.row(channel.name);
            view.cell(
                "to the next pixel of the span, for PIXEL",
                || increment(channel),
                self.held.gradient[i],
            );
            view.wire(|| format!("inc_{}", channel.name));
            if second {
                view.cell("first value of the lower part", || word(channel), self.held.start[1][i]);
                view.wire(|| format!("{}_start_b", channel.name));
            }
        }
    }

    fn say(&self, plan: &Plan, prim: bool, fresh_queued: bool, line_ready: bool, view: &mut View) {
        let [n1, n2] = self.remaining;
        let steps = self.running && line_ready;
        let (knee, last) = (n1 == 1 && n2 > 0, n1 + n2 == 1);
        let along = steps && !last && !knee;
        let (exact, carry) = (plan.fill == Fill::Exact, self.major.r < self.major.f);
        view.says(!self.running && prim && !fresh_queued, "takes a triangle, at its first line.");
        view.says(
            !self.running && prim && fresh_queued,
            "cannot take the next triangle: PIXEL has not taken the increments of the last one yet.",
        );
        view.says(steps, "hands over line {y}: major column {major.C}, minor column {minor.C}.");
        view.says(self.running && !line_ready, "waits with line {y}: the FIFO of SPAN is full.");
        view.says(
            along && carry,
            "major edge: R {major.R} < f {major.f}, so a carry: R + M − f, and the column goes q + 1 = {major.q} + 1 further.",
        );
        view.says(
            along && !carry,
            "major edge: R {major.R} ≥ f {major.f}, no carry: R − f, and the column goes q = {major.q} further.",
        );
        view.says(along && exact && carry, "the values take d1.");
        view.says(along && exact && !carry, "the values take d0.");
        view.says(along && !exact, "the values take the increment of the part.");
        view.says(steps && knee, "the upper part ends here: the second minor edge takes over.");
        view.says(steps && last, "that was the last line of the triangle.");
    }
}
