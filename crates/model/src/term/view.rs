//! What is to be seen of TERM.

use super::{Term, Way};
use crate::tokens::Span;
use crate::view::{Shape, View, modulo};
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

const PARTS: [(&str, &str); 6] = [
    ("V", "at this pixel"),
    ("X", "to the next pixel"),
    ("Y", "to the next line"),
    ("XX", "of X, to the next pixel"),
    ("XY", "of X, to the next line"),
    ("YY", "of Y, to the next line"),
];

impl Term {
    /// Shows the unit in a cycle with these inputs; `pixel_ready`: PIXEL takes a span.
    pub fn view<const C: usize>(
        &self,
        plan: &Plan,
        span: Option<&Span<C>>,
        records: &WordIn,
        pixel_ready: bool,
        view: &mut View,
    ) {
        view.unit(plan, "term");
        let w = plan.widths();
        view.triangle(span.map(|span| span.source.id));
        let loading = self.fetch.loading();
        view.flag("loading", "a record is being read", loading);
        view.wire(|| "loading".to_owned());
        view.flag(
            "begun",
            "the words are those of the span that is offered, the first of its triangle",
            self.begun,
        );
        view.wire(|| "begun".to_owned());
        let x = view.signed("x", "column at which the walk stands", w.column, self.x.into());
        view.wire(|| "x".to_owned());
        let y = view.number("y", "its line", w.y, self.y);
        view.wire(|| "y".to_owned());
        view.number("done", "clocks of the step that are done", 5, self.done);
        view.flag("under_way", "a result is written into the memory", self.under_way);
        view.table("terms, in entries of a table", &PARTS.map(|(part, _)| part), false);
        for (term, words) in plan.terms().iter().zip(&self.terms) {
            view.row(term.name);
            for ((_, doc), word) in PARTS.iter().zip(words).take(term.words() as usize) {
                let shape =
                    Shape::Number { bits: term.word(), fraction: term.fraction, signed: true, modular: true };
                view.cell(doc, || shape, modulo(*word as i64, term.word()));
            }
        }
        let there = self.there(span);
        view.lane(x, span.is_some());
        view.mark(x, y);

        let way = span.filter(|span| self.fits(span) && !self.stands_at(span)).map(|span| self.way(span));
        view.says(way == Some(Way::Down), "walks from column {x} down to the line below {y}.");
        view.says(way == Some(Way::Forward), "walks from column {x} towards the end of the span.");
        view.says(way == Some(Way::Back), "walks back from column {x}.");
        view.says(loading, "reads the record of a triangle: its reference pixel, material and words.");
        view.says(there && pixel_ready, "stands at the span's first pixel, ({x}, {y}), and hands it on.");
        view.says(there && !pixel_ready, "stands at ({x}, {y}) before PIXEL is ready.");
        let read = self.read(0).is_some();
        view.takes("tdata", records.word.is_some(), loading);
        view.gives("trd", None, read, records.ready);
        view.gives("walked", Some("pixel"), there, pixel_ready);
    }
}
