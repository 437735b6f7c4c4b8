//! MOVER: takes the values of the channels from span to span.

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens;
use edgewalk_netlist::{Module, Signal};

use super::between::{Between, Span};
use super::pass::Pair;
use crate::wires::{Registers, Token, parts, plus};

/// What MOVER reads of the rest of POLY.
pub(super) struct Links<'a, 'm> {
    pub prim: &'a Token<'m>,
    /// A polygon begins.
    pub begins: Signal<'m>,
    /// One is walked.
    pub walking: Signal<'m>,
    pub pair: Pair<'m>,
    /// The line is accepted.
    pub line_ready: Signal<'m>,
    /// PIXEL has not loaded the increments of the span before.
    pub fresh_queued: Signal<'m>,
}

/// What MOVER tells.
pub(super) struct Mover<'m> {
    /// The pair is taken or dropped.
    pub pair_leaves: Signal<'m>,
    /// MOVER holds a span.
    pub has_span: Signal<'m>,
    pub line_valid: Signal<'m>,
    /// For PIXEL.
    pub increments: Registers<'m>,
    line: Token<'m>,
    /// The line is the polygon's first.
    first: Signal<'m>,
    /// The line has increments of its own.
    fresh: Signal<'m>,
}

/// Where the values go to.
struct Way<'m> {
    /// A line down.
    down: Signal<'m>,
    /// Columns are left to go.
    along: Signal<'m>,
    /// What is added a column is doubled.
    doubles: Signal<'m>,
    /// The values change in this clock.
    adds: Signal<'m>,
    /// The columns lie to the left.
    left: Signal<'m>,
}

impl<'m> Mover<'m> {
    /// The registers of MOVER.
    pub fn new(m: &'m Module, plan: &Plan, links: &Links<'_, 'm>) -> Mover<'m> {
        let Links { prim, begins, walking, pair, line_ready, fresh_queued } = *links;
        m.comment("MOVER: the pair that waits; it is dropped if it has no column of the screen.");
        let has_span = m.reg("has_span", 1).doc("a span is offered, or values move to it").reset(0);
        let arrives = m.wire("line_valid", 1);
        let fires = (arrives.q() & line_ready).named("line_fires");
        let free = (!has_span.q() | fires).named("free");
        let takes = (pair.waits & pair.some & free).named("takes_pair");
        let pair_leaves = pair.waits & (free | !pair.some);
        has_span.when(fires, 0).when(takes, 1);

        let way = Way::new(m, plan, links, takes);
        let there = has_span.q() & !way.down & !way.along;
        let between = Between::new(m, plan, &Span { pair, takes, there, fires, fresh_queued });
        arrives.drive(between.as_ref().map_or(there, |between| has_span.q() & between.offers));

        m.comment("The line that is offered. While no polygon is walked everything takes the next one, again and again.");
        let mut kept = parts(&tokens::line(plan));
        kept.retain(|part| part.name != "major_right" && part.name != "fence");
        if between.is_some() {
            kept.retain(|part| part.name != "fresh");
        }
        let line = Registers::new(m, "line", kept);
        line["y"].when(takes, pair.line);
        line["cmaj"].when(takes, pair.first);
        line["cmin"].when(takes, pair.behind);
        let first = match line.get("fresh") {
            Some(fresh) => fresh,
            None => m.reg("line_first", 1).doc("first span of the polygon"),
        };
        let first = first.when(fires, 0).when(!walking, 1).q();
        for name in ["thin", "flat", "tag"] {
            if let (Some(register), Some(value)) = (line.get(name), prim.get(name)) {
                register.when(!walking, value);
            }
        }
        let increments = Registers::new(m, "inc", parts(&tokens::held_by_edge(plan)));
        for name in ["kt", "record"] {
            if let (Some(register), Some(value)) = (increments.get(name), prim.get(name)) {
                register.when(begins, value);
            }
        }
        m.comment("Values: d0 is added once a line. For each set bit i of the number of columns the increment, doubled i times, is added.");
        if let Some(between) = &between {
            between.connect(plan, takes, &line, &increments);
        }
        for channel in plan.planes().map(|(_, channel)| channel.name) {
            let of_prim = |result: &str| prim[format!("{channel}_{result}").as_str()];
            let increment = increments[channel].when(begins, of_prim("g")).q();
            let down = of_prim("d0");
            let down = m
                .reg(&format!("{channel}_d0"), down.width())
                .doc("step to the next line")
                .when(!walking, down)
                .q();
            let along = m
                .reg(&format!("{channel}_along"), down.width())
                .doc("increment, doubled as often as it was asked for");
            along.when(way.doubles, along.q().shl(1)).when(takes, increment).when(!walking, of_prim("start"));
            let along = along.q() ^ way.left.sext(down.width());
            let added = way.down.mux(down, along).named(&format!("{channel}_added"));
            let value = line[channel];
            let moved = plus(&format!("{channel}_moved"), value.q(), added, !way.down & way.left);
            value.when(way.adds, moved).when(!walking, 0);
        }
        let (has_span, line_valid) = (has_span.q(), arrives.q());
        let fresh = if between.is_some() { m.lit(1, 1) } else { first };
        Mover { pair_leaves, has_span, line_valid, increments, line: line.token(), first, fresh }
    }

    /// A field of the line.
    pub fn line(&self, name: &str) -> Signal<'m> {
        match name {
            // A span begins at its left end.
            "major_right" => self.has_span.module().lit(1, 0),
            // Of one polygon no two spans have a pixel in common.
            "fence" => self.first,
            "fresh" => self.fresh,
            own => self.line[own],
        }
    }
}

impl<'m> Way<'m> {
    /// From the span before, or from where the values start, to the pair that is taken.
    fn new(m: &'m Module, plan: &Plan, links: &Links<'_, 'm>, takes: Signal<'m>) -> Way<'m> {
        let Links { prim, walking, pair, .. } = *links;
        m.comment("The way to the span: lines down, then columns to the right or to the left.");
        let bits = column_bits(plan);
        let line = m.reg("at_line", pair.line.width()).doc("line of the span before");
        let column = m.reg("at_column", bits).doc("its first column");
        let first = pair.first.trunc(bits);
        let below = pair.line - line.q();
        let beside =
            (first.zext(bits + 1) - column.q().zext(bits + 1)).named_doc("beside", "signed, columns");
        let left = beside.msb();
        // Both ways are subtracted side by side.
        let back = (column.q() - first).named("back");
        let far = left.mux(back, beside.trunc(bits));
        let away = first.ne(column.q());
        let away = pair.thin.map_or(away, |thin| !thin & away);
        let far = pair.thin.map_or(far, |thin| thin.mux(0, far)).named("columns_away");
        line.when(takes, pair.line).when(!walking, prim["start_y"]);
        column.when(takes, first).when(!walking, prim["start_x"].zext(bits));

        let lines = m.reg("lines_down", pair.line.width()).doc("lines left to go down");
        let columns = m.reg("columns_along", bits).doc("columns left to go, in doubles of what is added");
        let down = m.reg("down", 1).doc("lines are left").reset(0);
        let along = m.reg("along", 1).doc("columns are left");
        let to_left = m.reg("to_left", 1).doc("they lie to the left").when(takes, left).when(!walking, 0).q();
        let doubles = (!down.q() & along.q()).named("doubles");
        let half = columns.q().shr(1);
        lines.when(down.q(), lines.q() - 1).when(takes, below);
        down.when(down.q(), lines.q().ne(1)).when(takes, pair.line.ne(line.q()));
        // While no polygon is walked a column is to go: the start.
        columns.when(doubles, half).when(takes, far).when(!walking, 1);
        along.when(doubles, half.any()).when(takes, away).when(!walking, 1);
        let adds = (down.q() | (along.q() & columns.q().bit(0))).named("adds");
        Way { down: down.q(), along: along.q(), doubles, adds, left: to_left }
    }
}

/// Bits of a column of the screen, of the map that the machine draws, or of the pixel at which values start.
fn column_bits(plan: &Plan) -> u32 {
    let [start, _] = plan.window_bits();
    let widest = if plan.shadow.draws_map() { plan.width.max(plan.shadow.size) } else { plan.width };
    widest.next_power_of_two().ilog2().max(start)
}
