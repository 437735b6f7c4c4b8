//! What is to be seen of POLY.

use super::Poly;
use super::table::{Record, Word};
use crate::tokens::{EdgeWalk, Prim};
use crate::view::{Shape, View, increment, modulo, word};
use edgewalk_machine::{COLOURS, Plan};

/// Rows of a table: so many words of a list are shown, those that are read or written next.
const ROWS: usize = 8;

impl<const C: usize> Poly<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(
        &self,
        plan: &Plan,
        prim: Option<&Prim<C>>,
        fresh_queued: bool,
        line_taken: bool,
        view: &mut View,
    ) {
        view.unit(plan, "poly");
        let (w, edges) = (plan.widths(), plan.polygon.edges.ilog2() + 1);
        view.triangle(self.walking().then_some(self.mover.way().0.source.id));
        let run = view.flag("run", "the edges of a polygon are walked", self.pass.runs());
        view.wire(|| "run".to_owned());
        view.live(Some(run));
        let y = view.number("y", "line whose pairs are spans", w.line, self.pass.lines()[0]);
        let [todo, next] = self.pass.waiting();
        view.number("todo", "edges that have not entered", edges, todo);
        view.live(None);
        view.lane(y, self.walking());
        self.view_load(plan, next, view);
        self.view_pass(plan, view);
        self.view_mover(plan, view);
        view.band(y);
        self.say(prim, fresh_queued, line_taken, view);
        view.gives("line", Some("span"), self.line().is_some(), line_taken);
        view.step("line", 'l');
    }

    fn view_load(&self, plan: &Plan, next: u32, view: &mut View) {
        let w = plan.widths();
        let edges = plan.polygon.edges.ilog2() + 1;
        let (bank, loaded, putting) = self.load.loading();
        view.number("ne", "edges of the polygon that is loaded", edges, loaded);
        view.wire(|| "edges".to_owned());
        view.flag("chosen", "an edge is on its way into the table", self.load.has_chosen());
        view.wire(|| "edge_waits".to_owned());
        view.flag("over", "it has more edges than the table", self.load.over());
        view.wire(|| "over".to_owned());
        let puts = view.flag("putting", "an edge goes to its place in the order list", putting.is_some());
        view.live(Some(puts));
        view.number(
            "pos",
            "the place that is free for it",
            edges,
            putting.map_or(0, |putting| putting.place),
        );
        if let Some((at, found)) = self.load.sought() {
            view.number("at", "clocks for which an edge's colours have been sought", 8, at);
            view.flag("found", "the colours of the edge are found", found);
        }
        view.number("okey", "its first line", w.line, putting.map_or(0, |putting| putting.key.line));
        view.live(None);
        view.table(
            "order of the edges that are loaded, the last of them",
            &["place", "first line", "edge"],
            true,
        );
        let first = (loaded as usize).saturating_sub(ROWS);
        for row in 0..ROWS {
            let place = first + row;
            let free = putting.is_some_and(|putting| putting.place as usize == place);
            let order = bank.order.get(place).copied().filter(|_| place < loaded as usize && !free);
            let order = order.unwrap_or_default();
            view.row(&format!("loaded {row}"));
            view.cell("place in the list", || Shape::whole(edges), place as u64);
            view.cell("first line of the edge", || Shape::whole(w.line), order.line.into());
            view.cell("place in the table", || Shape::whole(edges), order.index.into());
        }
        view.table("edges that enter next", &["first line", "edge"], true);
        let walked = self.load.shown();
        let [todo, _] = self.pass.waiting();
        for row in 0..ROWS {
            let order = walked.order.get(next as usize + row).copied().filter(|_| (row as u32) < todo);
            let order = order.unwrap_or_default();
            view.row(&format!("next {row}"));
            view.cell("first line of the edge", || Shape::whole(w.line), order.line.into());
            view.cell("place in the table", || Shape::whole(edges), order.index.into());
        }
    }

    fn view_pass(&self, plan: &Plan, view: &mut View) {
        let (b, c, [_, e]) = self.pass.stages();
        let places = plan.polygon.edges.ilog2() + 1;
        let columns: Vec<&str> =
            ["edge"].into_iter().chain(EdgeWalk::COLUMNS).chain(["lines left"]).collect();
        let stage = |title: &str, name: &str, index: Option<u32>, record: Record, view: &mut View| {
            let valid =
                view.flag(&format!("{name}_valid"), &format!("a word is in {title}"), index.is_some());
            view.live(Some(valid));
            view.table(title, &columns, false);
            view.row(name);
            view.cell("place in the table", || Shape::whole(places), index.unwrap_or(0).into());
            record.walk.view(plan, None, view);
            view.cell("lines left", || Shape::whole(plan.widths().line + 1), record.lines.into());
            view.live(None);
        };
        let record =
            c.map_or_else(Record::default, |c| Record { walk: c.walk, lines: c.lines, colours: c.colours });
        stage("C, the word that is worked at", "C", c.map(|c| c.index), record, view);
        let entering = c.is_some_and(|c| c.entering);
        view.flag("entering", "the edge in C begins on the next line", entering);
        let list = |name: &str, title: &str, first: Option<Word>, words: &[Word], view: &mut View| {
            view.table(title, &["C", "edge"], false);
            for row in 0..ROWS {
                let word = match (first, row) {
                    (Some(word), 0) => Some(word),
                    (Some(_), row) => words.get(row - 1).copied(),
                    (None, row) => words.get(row).copied(),
                };
                let word = word.unwrap_or_default();
                view.row(&format!("{name} {row}"));
                let column = plan.widths().column;
                view.cell(
                    "column on the list's line",
                    || Shape::signed(column),
                    modulo(word.column.into(), column),
                );
                view.cell("place in the table", || Shape::whole(places), word.index.into());
            }
        };
        let [old, new] = self.pass.words();
        list("old", "active edges of line y, those that come next", b, old, view);
        list(
            "new",
            "active edges of the next line, the last of them",
            None,
            &new[new.len().saturating_sub(ROWS)..],
            view,
        );
        view.number("words", "of the next line so far", places, new.len() as u64);
        view.flag("half", "the left column of a pair is there", self.pass.left().is_some());
        let column = plan.widths().column;
        view.signed("left", "that column", column, self.pass.left().unwrap_or(0).into());
        let moving =
            view.flag("inserting", "words make room for a smaller column", self.pass.gap().is_some());
        view.live(Some(moving));
        view.number("gap", "the free place of the next line's list", places, self.pass.gap().unwrap_or(0));
        view.signed("key", "the smaller column", column, e.map_or(0, |e| e.column).into());
        view.live(None);
        let pair = self.pass.pair();
        let full = view.flag("pair", "a pair waits for MOVER", pair.is_some());
        view.live(Some(full));
        let pair = pair.unwrap_or_default();
        view.number("pair_y", "its line", plan.widths().line, pair.y);
        view.signed("pair_left", "its left column", column, pair.columns()[0].into());
        view.signed("pair_right", "the column right of it", column, pair.columns()[1].into());
        view.live(None);
    }

    fn view_mover(&self, plan: &Plan, view: &mut View) {
        let (line, x, y, columns, left) = self.mover.way();
        let w = plan.widths();
        let have = view.flag("have", "a span is moved to, or waits for SPAN", self.mover.has_span());
        view.live(Some(have));
        view.number("line", "of the span", w.line, line.y);
        view.signed("first", "first column of the span", w.column, line.major.into());
        view.signed("behind", "the column behind its last", w.column, line.minor.into());
        view.signed("X", "the same as `first`", w.column, x.into());
        view.number("Y", "line at which the values stand", w.line, y);
        view.number("md", "columns to go, without those done, halved for each clock", w.column, columns);
        view.flag("neg", "to the left", left);
        view.table("values, LSB", &["V", "D", "d0"], false);
        let [step, down] = self.mover.steps();
        for (i, channel) in plan.planes() {
            view.row(channel.name);
            view.cell("where MOVER stands", || word(channel), line.values[i]);
            view.cell("the step in x that comes next", || increment(channel), step[i]);
            view.cell("to the next line", || increment(channel), down[i]);
        }
        self.view_between(plan, view);
        view.live(None);
        view.table("held, LSB", &["g"], true);
        for (i, channel) in plan.channels().iter().enumerate() {
            view.row(channel.name);
            view.cell(
                "to the next pixel of the span, for PIXEL",
                || increment(channel),
                self.held.gradient[i],
            );
        }
    }

    /// Bilinear colours of the span.
    fn view_between(&self, plan: &Plan, view: &mut View) {
        let Some(between) = self.mover.between() else { return };
        let (turns, [apart, rest], differences, parts) = between.state();
        let bits = plan.channels()[COLOURS.start].word();
        let key = plan.widths().column + plan.edge_fraction;
        view.flag("dividing", "bits of T, then of G are found", between.dividing());
        view.number("turns", "bits found", (2 * bits + 2).ilog2() + 1, turns);
        view.number("apart", "from edge to edge, 2^-F px", key, apart as u64);
        view.number("rest", "of the division, below `apart`", key, rest as u64);
        view.flag("offers", "the span is offered", between.offers());
        view.table("colours, LSB", &["V", "N", "A / 2^k"], false);
        let (line, ..) = self.mover.way();
        for (k, channel) in plan.channels()[COLOURS].iter().enumerate() {
            view.row(channel.name);
            let (shape, signed) = (|| word(channel), || increment(channel));
            view.cell("of the left edge, then at the first pixel", shape, line.values[COLOURS.start + k]);
            view.cell("the right less the left edge", signed, modulo(differences[k], channel.word()));
            view.cell("what the bits so far make of it", signed, parts[k]);
        }
    }

    fn say(&self, prim: Option<&Prim<C>>, fresh_queued: bool, line_taken: bool, view: &mut View) {
        let fires = prim.filter(|prim| self.prim_ready(prim, fresh_queued));
        let (_, loaded, putting) = self.load.loading();
        let through = prim.is_some() && self.load.is_through();
        let left = prim.is_some_and(|prim| self.load.is_left(prim));
        let stays = self.load.stays(self.pass.writes());
        let seeks = left && !stays && self.load.sought().is_some_and(|(_, found)| !found);
        if self.load.sought().is_some() {
            view.says(seeks, "LOAD finds the colours of an edge: clock {at}.");
        }
        let takes = left && !seeks && !stays && putting.is_none();
        view.says(takes, "LOAD chooses an edge of the prim.");
        view.says(self.load.has_chosen() && !stays, "LOAD takes an edge into the table.");
        view.says(
            putting.is_some(),
            "LOAD puts an edge into the order list, before those that begin further down.",
        );
        let ends = fires.is_some_and(|prim| prim.ends);
        view.says(fires.is_some() && !ends, "LOAD has taken all edges of the prim: the next ones may come.");
        view.says(ends && self.load.over(), "refuses the polygon: it has more edges than the table.");
        let begins = ends && !self.load.over() && loaded > 0 && fires.is_some_and(|prim| !prim.void);
        view.says(begins, "begins with the polygon of {ne} edges.");
        view.says(
            through && prim.is_some_and(|prim| prim.ends) && fires.is_none(),
            "waits with the next polygon: the one before is walked, or PIXEL has not taken its increments.",
        );
        let (_, c, [_, e]) = self.pass.stages();
        let works = self.pass.runs() && c.is_some() && !self.pass.blocked() && self.pass.gap().is_none();
        let old = works && c.is_some_and(|c| !c.entering);
        let last = c.is_some_and(|c| c.lines == 1);
        let carry = c.is_some_and(|c| c.walk.r < c.walk.f);
        view.says(works && !old, "edge {C.edge} enters at column {C.C}.");
        view.says(old && last, "edge {C.edge} leaves: this is its last line.");
        view.says(old && !last && carry, "edge {C.edge} steps with a carry: R {C.R} < f {C.f}.");
        view.says(old && !last && !carry, "edge {C.edge} steps without a carry: R {C.R} ≥ f {C.f}.");
        view.says(
            self.pass.runs() && self.pass.blocked(),
            "waits with edge {C.edge}: a pair waits for MOVER.",
        );
        let moves = self.pass.gap().is_some() && e.is_some();
        view.says(moves, "column {key} goes before the words behind place {gap}.");
        let waits = self.pass.pair().is_some();
        view.says(waits, "pair {pair_left} to {pair_right} of line {pair_y} waits for MOVER.");
        let there = self.line().is_some();
        if let Some(between) = self.mover.between() {
            let divides = between.dividing();
            view.says(divides, "the colours are found from edge to edge: {turns} bits so far.");
        }
        view.says(
            self.mover.has_span() && !there,
            "MOVER goes to line {line}, column {first}: {md} in halves to go.",
        );
        view.says(there && line_taken, "hands over line {line}: columns {first} up to before {behind}.");
        view.says(there && !line_taken, "waits with line {line}: the FIFO of SPAN is full.");
    }
}
