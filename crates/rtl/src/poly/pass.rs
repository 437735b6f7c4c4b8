//! PASS: goes through the active list of a line, and makes that of the next.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal};

use super::columns::Columns;
use super::insert::{Comes, Inserts};
use super::load::Load;
use super::table::{EdgeColour, Tables, Word};
use crate::light_pass::LightPass;
use crate::stepping::Rest;
use crate::wires::{Token, plus};

/// What PASS reads of the rest of POLY.
pub(super) struct Links<'a, 'm> {
    pub load: &'a Load<'m>,
    pub prim: &'a Token<'m>,
    /// A polygon is walked.
    pub walking: Signal<'m>,
    /// MOVER takes the pair that waits, or drops it.
    pub pair_leaves: Signal<'m>,
    pub light_pass: LightPass<'m>,
}

/// What PASS tells.
pub(super) struct Pass<'m> {
    /// Lines are passed.
    pub run: Signal<'m>,
    /// PASS writes to `rests`.
    pub writes: Signal<'m>,
    pub pair: Pair<'m>,
}

/// The pair of columns that waits for MOVER.
#[derive(Clone, Copy)]
pub(super) struct Pair<'m> {
    /// There is one.
    pub waits: Signal<'m>,
    pub line: Signal<'m>,
    /// The pair has columns on the screen: whether some, the first, and the one behind the last.
    pub some: Signal<'m>,
    pub first: Signal<'m>,
    pub behind: Signal<'m>,
    /// The pair is the pixel of a line, twice.
    pub thin: Option<Signal<'m>>,
    /// With bilinear colours: both edges.
    pub ends: Option<[End<'m>; 2]>,
}

/// An edge of a pair: its key, and its colours in their order.
#[derive(Clone, Copy)]
pub(super) struct End<'m> {
    pub key: Signal<'m>,
    pub colours: [Signal<'m>; 3],
}

/// The registers of a line, without updates.
struct Line<'m> {
    run: Reg<'m>,
    /// The order list's first word is stored.
    fills: Reg<'m>,
    y: Reg<'m>,
    /// The line below, and the one below that.
    next: Reg<'m>,
    below: Reg<'m>,
    /// The active list that is read.
    list: Reg<'m>,
    half: Reg<'m>,
    /// Valid of the stages.
    b_valid: Reg<'m>,
    c_valid: Reg<'m>,
    entering: Reg<'m>,
}

impl<'m> Pass<'m> {
    /// The registers of PASS, and its ports of the memories.
    pub fn new(m: &'m Module, plan: &Plan, tables: &Tables<'m>, links: &Links<'_, 'm>) -> Pass<'m> {
        let Links { load, prim, walking, pair_leaves, light_pass } = *links;
        m.comment(
            "PASS: the active list of line y through the stages B, a word, and C, the word with its record.",
        );
        let line = Line::new(m, tables);
        let Line { run, fills, y, next, half, b_valid, c_valid, entering, .. } = line;
        let held = |name: &str| prim.get(name).map(|value| m.reg(name, 1).when(!walking, value).q());
        let thin = held("thin");
        let pair_waits = m.reg("pair_waits", 1).doc("a pair of columns waits for MOVER").reset(0);

        let leaving = c_valid.q() & !entering.q();
        let leaving = leaving.named_doc("passed", "the edge of C meets line y");
        let pairs = (leaving & thin.map_or(half.q(), |thin| thin | half.q())).named("closes_pair");
        let blocked = (pairs & pair_waits.q()).named("blocked");
        let inserts = Inserts::new(m, tables);
        let works = (run.q() & !fills.q()).named("works");
        let advance = (works & !inserts.holds() & !blocked).named("advance");

        let entry = Entry::new(m, tables, load, &line, advance);
        let empty = !inserts.stepped_valid.q() & !b_valid.q() & !c_valid.q() & !entry.enters;
        let ends = works & !inserts.holds() & empty;
        let ends = ends.named_doc("line_ends", "no edge is left on it, none enters");
        entry.updates(ends);
        let words = (inserts.count.q().any() | inserts.valid.q()).named_doc("some_words", "of the next line");
        let starts = (ends & words).named("next_line_starts");
        let b = line.read(m, tables, &inserts, advance, ends);

        m.comment("Stage C: the word with its record.");
        let is_bilinear = !tables.colours.is_empty();
        let column_of = |key: Signal<'m>| match is_bilinear {
            false => key,
            true => key.slice(tables.key - 1, tables.key - tables.column),
        };
        let head = inserts.head.q();
        let index = b_valid.q().mux(b.index, entry.enters.mux(entry.index, head.index)).named("next_index");
        let column = b_valid.q().mux(b.key, head.key);
        let place = tables.at(!load.bank, index).named("read_place");
        let steps = tables.parts_of_steps(tables.steps.read(advance, place));
        let record = tables.rests.read(advance, place);
        let lines_left = record.trunc(tables.line + 1).named("lines_left");
        let rest = record.slice(record.width() - 1, tables.line + 1).named_doc("rest", "R - f, signed");
        let c = Word {
            key: m.reg(if is_bilinear { "c_key" } else { "c_column" }, tables.key).when(advance, column).q(),
            index: m.reg("c_index", tables.index).when(advance, index).q(),
        };
        c_valid.when(advance, b_valid.q() | entry.enters | starts);
        entering.when(advance, !b_valid.q() & entry.enters);

        m.comment(
            "Each second column closes a pair. While no pair waits its place takes what may become one.",
        );
        let walked = (advance & leaving).named("walked");
        let left = m.reg("left", tables.key).doc(&format!("first {} of the pair", tables.sorted_by));
        let left = left.when(!half.q(), c.key).q();
        let colours = Colours::read(m, tables, advance, place);
        let left_colours = colours.as_ref().map(|colours| colours.of_left(m, tables, !half.q()));
        half.when(walked, !half.q()).when(ends, 0);
        let closes = (advance & pairs).named("pair_closed");
        pair_waits.when(pair_leaves, 0).when(closes, 1);
        let left = thin.map_or(left, |thin| thin.mux(c.key, left));
        let columns = Columns::new(m, plan, light_pass, [left, c.key].map(column_of), thin);
        let free = !pair_waits.q();
        let register = |name: &str, value: Signal<'m>| m.reg(name, value.width()).when(free, value).q();
        let pair = Pair {
            waits: pair_waits.q(),
            line: register("pair_line", y.q()),
            some: register("pair_some", columns.some),
            first: register("pair_first", columns.first),
            behind: register("pair_behind", columns.behind),
            thin,
            ends: colours.as_ref().zip(left_colours).map(|(right, of_left)| {
                let of_left =
                    [0, 1, 2].map(|k| thin.map_or(of_left[k], |thin| thin.mux(right.values[k], of_left[k])));
                let end = |side: &str, key: Signal<'m>, values: [Signal<'m>; 3]| End {
                    key: register(&format!("pair_{side}_key"), key),
                    colours: [0, 1, 2]
                        .map(|k| register(&format!("pair_{side}_{}", tables.colours[k].name), values[k])),
                };
                [end("left", left, of_left), end("right", c.key, right.values)]
            }),
        };

        m.comment("Stage D: the edge on the next line, and its record written back.");
        let leaves = (!entering.q() & lines_left.eq(1)).named_doc("leaves", "line y is its last one");
        let stepped = (column_of(c.key) + steps["q"] + rest.msb().zext(tables.column)).named("stepped");
        let (first, stepped) = match is_bilinear {
            false => (steps["c"], stepped),
            // R on the next line is R - f, with M = 2^F added where that is below 0.
            true => (m.cat(&[steps["c"], !steps["dist"]]), m.cat(&[stepped, !rest.trunc(rest.width() - 1)])),
        };
        let edge = Word { key: entering.q().mux(first, stepped), index: c.index };
        let stepped = match steps.get("m") {
            // M - f is added with a carry, else f is taken away.
            Some(back) => {
                let (carry, bits) = (rest.msb(), rest.width());
                plus("rest_stepped", rest, carry.mux(back.zext(bits), !steps["f"].zext(bits)), !carry)
            }
            None => Rest { name: "rest", rest, f: steps["f"], modulus: None }.next(m),
        };
        let stepped = m.reg("d_rest", stepped.width()).doc("R - f, signed").set(stepped).q();
        let lines = m.reg("d_lines_left", lines_left.width()).set(lines_left - 1).q();
        let writes = m.reg("writes", 1).doc("the record of D is written").reset(0);
        let writes = writes.set(advance & leaving & !leaves).q();
        let stores = (load.stores | writes).named("rests_written");
        let place = writes.mux(tables.at(!load.bank, inserts.stepped.q().index), load.place);
        tables.rests.write(stores, place, writes.mux(m.cat(&[stepped, lines]), load.rest));
        if let Some(colours) = &colours {
            colours.write(m, tables, &Writes { stores, place, writes, of_load: &load.values });
        }
        let valid = c_valid.q() & !leaves;
        inserts.update(&Comes { list: !line.list.q(), advance, valid, edge, line_ends: ends });

        m.comment("The next line.");
        let last = (ends & !words & !entry.some).named("polygon_ends");
        run.when(last, 0).when(load.begins, 1);
        fills.set(load.begins);
        let first = prim["start_y"].zext(tables.line);
        // The line before the first has no pair, and needs no number.
        y.when(ends, next.q());
        next.when(ends, line.below.q()).when(!run.q(), first);
        line.below.when(ends, line.below.q() + 1).when(!run.q(), (first + 1).named("second_line"));
        line.list.when(ends, !line.list.q());
        Pass { run: run.q(), writes, pair }
    }
}

/// The colours of the edge in C, on line y, and their steps to the next line.
struct Colours<'m> {
    values: [Signal<'m>; 3],
    steps: [Signal<'m>; 3],
}

/// When and where colours are written.
struct Writes<'a, 'm> {
    stores: Signal<'m>,
    place: Signal<'m>,
    /// By PASS, not by LOAD.
    writes: Signal<'m>,
    of_load: &'a [Signal<'m>],
}

impl<'m> Colours<'m> {
    /// With the record of C; none without bilinear colours.
    fn read(
        m: &'m Module,
        tables: &Tables<'m>,
        advance: Signal<'m>,
        place: Signal<'m>,
    ) -> Option<Colours<'m>> {
        if tables.colours.is_empty() {
            return None;
        }
        m.comment("Colours of the edge in C.");
        let read = |k: usize| {
            let EdgeColour { name, values, steps } = &tables.colours[k];
            let value = values.read(advance, place).named(&format!("c_{name}"));
            (value, steps.read(advance, place).named(&format!("c_{name}_step")))
        };
        let read = [0, 1, 2].map(read);
        Some(Colours { values: read.map(|(value, _)| value), steps: read.map(|(_, step)| step) })
    }

    /// Colours of the left edge of a pair.
    fn of_left(&self, m: &'m Module, tables: &Tables<'m>, is_left: Signal<'m>) -> [Signal<'m>; 3] {
        [0, 1, 2].map(|k| {
            let name = format!("left_{}", tables.colours[k].name);
            m.reg(&name, self.values[k].width()).when(is_left, self.values[k]).q()
        })
    }

    /// A line further, and back to the table.
    fn write(&self, m: &'m Module, tables: &Tables<'m>, of: &Writes<'_, 'm>) {
        for (k, table) in tables.colours.iter().enumerate() {
            let stepped = self.values[k] + self.steps[k];
            let stepped = m.reg(&format!("d_{}", table.name), stepped.width()).set(stepped).q();
            table.values.write(of.stores, of.place, of.writes.mux(stepped, of.of_load[k]));
        }
    }
}

impl<'m> Line<'m> {
    fn new(m: &'m Module, tables: &Tables<'m>) -> Line<'m> {
        Line {
            run: m.reg("run", 1).doc("lines are passed").reset(0),
            fills: m.reg("fills", 1).doc("the first word of the order list is stored"),
            y: m.reg("y", tables.line).doc("the line"),
            next: m.reg("y_below", tables.line).doc("the line below"),
            below: m.reg("y_after", tables.line).doc("the line below that"),
            list: m.reg("list", 1).doc("the active list that is read: that of the line").reset(0),
            half: m.reg("half", 1).doc("the first column of a pair is there").reset(0),
            b_valid: m.reg("b_valid", 1).reset(0),
            c_valid: m.reg("c_valid", 1).reset(0),
            entering: m.reg("entering", 1).doc("the edge of C begins on the next line"),
        }
    }

    /// The word of stage B: those of the list behind its first, in turn.
    fn read(
        &self,
        m: &'m Module,
        tables: &Tables<'m>,
        inserts: &Inserts<'_, 'm>,
        advance: Signal<'m>,
        ends: Signal<'m>,
    ) -> Word<'m> {
        m.comment("Stage B: the next word of the list. Its first is kept in a register, to begin with on the next line.");
        let (words, last) = (inserts.count.q(), inserts.valid.q());
        let unread = m.reg("unread", tables.index + 1).doc("words of the list not read yet").reset(0);
        let next = m.reg("next_word", tables.index).doc("place of the next word");
        let some = unread.q().any().named("some_unread");
        // The word in E goes to the end of the list in this clock.
        let many = words.gt(1).named_doc("many", "two words at least, without that in E");
        let several = (many | (words.any() & last)).named("several");
        let reads = (advance & some).named("reads");
        let behind = last.mux(words - 1, words - 2).named_doc("behind_second", "words behind the second");
        unread.when(reads, unread.q() - 1).when(ends, several.mux(behind, 0));
        next.when(reads, next.q() + 1).when(ends, 2);
        // Where none is left the second of the next line's is read, for the clock in which the line ends.
        let list = some.mux(self.list.q(), !self.list.q());
        let place = some.mux(next.q(), 1);
        let word = tables.lists.read(advance, tables.at(list, place));
        self.b_valid.when(advance, some | (ends & several));
        // A second word that goes to the list in the clock in which it is read stays in E. Of a thin polygon with several
        // edges C may wait for MOVER then, and B with it.
        let in_e = m.reg("b_in_e", 1).doc("the word of B is that of E").when(advance, ends & !many).q();
        Word::choose(in_e, inserts.edge.q(), tables.word(word))
    }
}

/// The next edge of the order list.
struct Entry<'m> {
    /// There is one.
    some: Signal<'m>,
    /// The edge begins on the next line.
    enters: Signal<'m>,
    /// Number of the edge.
    index: Signal<'m>,
    /// The register of that, and what it is when the line has ended.
    due: Reg<'m>,
    after_next: Signal<'m>,
}

impl<'m> Entry<'m> {
    fn new(
        m: &'m Module,
        tables: &Tables<'m>,
        load: &Load<'m>,
        line: &Line<'m>,
        advance: Signal<'m>,
    ) -> Entry<'m> {
        m.comment("The next edge of the order list in registers, and the word behind it on the memory's port; while no polygon is walked, the first of the one that is loaded.");
        let Line { run, fills, next, below, b_valid, .. } = *line;
        let waiting = m.reg("waiting", tables.index + 1).doc("edges that have not entered");
        let behind = m.reg("order_next", tables.index).doc("place of the word that is read next");
        let word = m.wire("order_word", tables.line + tables.index);
        let read = tables.word(word.q());
        let first = m.reg("order_line", tables.line).doc("first line of the next edge");
        let index = m.reg("order_index", tables.index).doc("its number");
        let due = m.reg("due", 1).doc("the next edge begins on the next line");
        let enters = (run.q() & !b_valid.q() & due.q()).named("enters");
        let taken = (advance & enters).named("entered");
        let loads = (taken | fills.q()).named("order_loads");
        waiting.when(taken, waiting.q() - 1).when(!run.q(), load.edges);
        behind.when(loads, behind.q() + 1).when(!run.q(), 1);
        first.when(loads, read.key);
        index.when(loads, read.index);
        let more = (fills.q() | waiting.q().gt(1)).named("more_wait");
        due.when(loads, more & read.key.eq(next.q()));
        let place = behind.q() & run.q().sext(tables.index);
        let place = tables.at(load.bank ^ run.q(), place);
        word.drive(tables.order.read(!run.q() | loads, place));
        let some = waiting.q().any().named("some_waits");
        let after_next = (some & first.q().eq(below.q())).named("due_after_next");
        Entry { some, enters, index: index.q(), due, after_next }
    }

    /// The line ends.
    fn updates(&self, ends: Signal<'m>) {
        self.due.when(ends, self.after_next);
    }
}
