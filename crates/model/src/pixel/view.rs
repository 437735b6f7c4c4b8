//! What is to be seen of PIXEL.

use super::Pixel;
use crate::tokens::Span;
use crate::view::{Shape, View, fragments, increment, modulo, word};
use edgewalk_machine::Plan;

impl<const C: usize> Pixel<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(&self, plan: &Plan, span: Option<&Span<C>>, frag_ready: bool, view: &mut View) {
        view.unit(plan, "pixel");
        let w = plan.widths();
        let phases = plan.clocks_per_pixel();
        view.triangle(self.active.then_some(self.source.id));
        let active = view.flag("active", "a span is being stepped along", self.active);
        view.wire(|| "active".to_owned());
        view.live(Some(active));
        let x = view.signed("x", "column, may lie off the screen", w.column, self.x.into());
        view.wire(|| "x".to_owned());
        let y = view.number("y", "line", w.y, self.place().1);
        view.number("left", "pixels left of the span, this one too", w.column, self.count);
        view.wire(|| "count".to_owned());
        view.number("phase", "clock of the pixel, the adders' turn", 4, self.phase);
        if phases > 1 {
            view.wire(|| "phase".to_owned());
        }
        view.table("values, LSB", &["value", "g"], false);
        for (i, channel) in plan.channels().iter().enumerate() {
            let raw = |aligned: u64| (aligned >> self.align[i]) & (u64::MAX >> (64 - channel.word()));
            view.row(channel.name);
            view.cell("at this pixel", || word(channel), raw(self.values[i]));
            view.cell("to the next pixel", || increment(channel), raw(self.gradient[i]));
        }
        self.view_terms(plan, view);
        view.live(None);
        self.view_stages(plan, view);
        if plan.segments > 1 {
            view.note("the segments of the adders are not modelled, only their clocks");
        }
        view.lane(x, self.active);
        view.mark(x, y);

        let moves = self.advance(frag_ready);
        let emits = self.active && moves && self.phase == self.last_phase;
        view.says(emits && self.on_screen(), "sends pixel ({x}, {y}) on its way; every channel adds its g.");
        view.says(emits && !self.on_screen(), "steps over column {x}, which is off the screen.");
        view.says(
            self.active && moves && self.phase < self.last_phase,
            &format!("adds up pixel ({{x}}, {{y}}): clock {{phase}} of 0 to {}.", phases - 1),
        );
        view.says(!moves, "stands still: nobody takes its fragment.");
        let takes = self.span_ready(frag_ready) && span.is_some();
        view.says(takes, "takes the next span.");
        view.says(takes && span.is_some_and(|span| span.fresh), "and the increments of a new triangle.");
        let behind = plan.units().skip_while(|unit| unit.name != "pixel").nth(1);
        let next = behind.map_or("depth", |unit| unit.name);
        view.gives("frag", Some(next), self.out.is_some(), frag_ready);
        view.step("pixel", 'p');
    }

    /// With TERM, the terms at this pixel.
    fn view_terms(&self, plan: &Plan, view: &mut View) {
        if plan.terms().is_empty() {
            return;
        }
        view.table("terms", &["v", "g", "gg"], false);
        for (term, steps) in plan.terms().iter().zip(&self.walked.terms) {
            let docs = ["at this pixel", "to the next pixel", "from a step to the next"];
            view.row(term.name);
            for (word, doc) in
                [steps.v, steps.g, steps.gg].into_iter().zip(docs).take(term.degree as usize + 1)
            {
                let (bits, fraction) = (term.word(), term.fraction);
                let shape = Shape::Number { bits, fraction, signed: true, modular: true };
                view.cell(doc, || shape, modulo(word as i64, bits));
            }
        }
    }

    /// The out stages, the last first.
    fn view_stages(&self, plan: &Plan, view: &mut View) {
        view.kind("fragment", "fragments", || fragments::fields(plan));
        view.table("out stages", &["fragment"], false);
        let before = (0..self.before).map(|place| &self.stages[(self.oldest + place) % self.before]);
        for (place, stage) in std::iter::once(&self.out).chain(before).enumerate() {
            let values =
                stage.as_ref().map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
            let token = stage.as_ref().zip(values.as_ref());
            view.row(&(plan.segments as usize - 1 - place).to_string());
            view.token_cell(
                "a fragment on its way out",
                "fragment",
                token.map(|(fragment, values)| (fragment.source.id, &values[..])),
            );
            if place == 0 {
                view.wire(|| "frag".to_owned());
            }
        }
    }
}
