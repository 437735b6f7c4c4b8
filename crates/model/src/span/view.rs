//! What is to be seen of SPAN.

use super::Span;
use crate::tokens::{self, Line};
use crate::view::{Field, Shape, View, modulo, word};
use edgewalk_machine::Plan;

impl<const C: usize> Span<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(&self, plan: &Plan, line: Option<&Line<C>>, span_ready: bool, view: &mut View) {
        view.unit(plan, "span");
        let bits = (self.depth + 1).next_power_of_two().ilog2();
        view.triangle(self.span().map(|span| span.source.id));
        let held = self.held.as_ref();
        let holds = view.flag("line_held", "a line stands before the FIFO", held.is_some());
        view.wire(|| "line_held".to_owned());
        view.live(Some(holds));
        view.number("held_y", "its line", plan.widths().line, held.map_or(0, |line| line.y));
        view.wire(|| "held_y".to_owned());
        view.live(None);
        let count = view.number("queued", "spans in the FIFO", bits, self.fifo.len() as u64);
        view.wire(|| "queue.count".to_owned());
        view.kind("span", "spans", || fields(plan));
        view.table(&format!("FIFO of {}", self.depth), &["span"], false);
        for place in 0..self.depth {
            let span = (place < self.fifo.len()).then(|| self.fifo.at(place));
            let values = span.map(|span| values(plan, span));
            view.row(&if place == 0 { "head".to_owned() } else { place.to_string() });
            let token = span.zip(values.as_ref()).map(|(span, values)| (span.source.id, &values[..]));
            view.token_cell("a span that waits", "span", token);
            view.wire(|| format!("queue.place{place}"));
        }
        view.flag(
            "fresh_in_queue",
            "the first span of a triangle waits: PIXEL needs the increments",
            self.fresh_in_fifo > 0,
        );
        view.wire(|| "fresh_in_queue".to_owned());
        view.flag("pend_fresh", "a first line was dropped", self.pend_fresh);
        view.wire(|| "pend_fresh".to_owned());
        view.flag("pend_fence", "a line with a fence was dropped", self.pend_fence);
        view.wire(|| "pend_fence".to_owned());
        view.lane(count, held.is_some() || !self.fifo.is_empty());

        let moves = held.is_some() && self.has_room();
        let empty = held.is_some_and(|line| self.cut(line).is_none());
        view.says(line.is_some() && self.line_ready(), "takes the line and cuts it where it ends.");
        view.says(moves && !empty, "queues the pixels of line {held_y}.");
        view.says(moves && empty, "drops line {held_y}: no column of it is on the screen.");
        view.says(held.is_some() && !moves, "is full: line {held_y} has to wait.");
        let fires = !self.fifo.is_empty() && span_ready;
        view.says(fires, "hands over {head.count} pixels of line {head.y} from column {head.x} on.");
        let next = if plan.shade.is_there() { "term" } else { "pixel" };
        view.gives("span", Some(next), !self.fifo.is_empty(), span_ready);
        view.step("span", 's');
    }
}

fn fields(plan: &Plan) -> Vec<Field> {
    let w = plan.widths();
    let field = |name, shape| Field { name, shape, brief: true };
    let mut fields = vec![
        field("x", Shape::signed(w.column)),
        field("y", Shape::whole(w.y)),
        field("count", Shape::whole(w.column)),
        field("leftward", Shape::Flag),
    ];
    fields.extend(
        plan.channels().iter().map(|channel| Field { brief: false, ..field(channel.name, word(channel)) }),
    );
    fields.extend(["fresh", "fence"].map(|name| Field { brief: false, ..field(name, Shape::Flag) }));
    fields
}

fn values<const C: usize>(plan: &Plan, span: &tokens::Span<C>) -> Vec<u64> {
    let mut values = vec![
        modulo(span.x.into(), plan.widths().column),
        span.y.into(),
        span.count.into(),
        span.leftward.into(),
    ];
    values.extend(&span.values[..plan.channels().len()]);
    values.extend([u64::from(span.fresh), u64::from(span.fence)]);
    values
}
