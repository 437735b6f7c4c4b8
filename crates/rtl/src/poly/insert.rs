//! Stages D and E of PASS: an edge goes into the active list of the next line, by its column.

use edgewalk_netlist::{Module, Reg, Signal};

use super::table::{Tables, Word};

/// The list of the next line, and the edges in D and E.
pub(super) struct Inserts<'a, 'm> {
    m: &'m Module,
    tables: &'a Tables<'m>,
    /// Words in the list, without that in E.
    pub count: Reg<'m>,
    /// First word of the list, or that in E if it will be.
    pub head: Register<'m>,
    /// Last word of the list.
    top: Register<'m>,
    /// The edge in D, as it stands on the next line.
    pub stepped: Register<'m>,
    /// There is one.
    pub stepped_valid: Reg<'m>,
    /// The edge in E.
    pub edge: Register<'m>,
    /// There is one.
    pub valid: Reg<'m>,
    /// The edge in E goes before the last word of the list.
    before: Reg<'m>,
    /// Words move up for it.
    moving: Reg<'m>,
    /// Words begin to move up in this clock.
    moves: Signal<'m>,
}

/// What comes into D, and where it goes from there.
pub(super) struct Comes<'m> {
    /// The active list of the next line.
    pub list: Signal<'m>,
    /// An edge may come into D, and that of D into E.
    pub advance: Signal<'m>,
    /// One comes into D.
    pub valid: Signal<'m>,
    pub edge: Word<'m>,
    pub line_ends: Signal<'m>,
}

/// A word in registers.
#[derive(Clone, Copy)]
pub(super) struct Register<'m> {
    key: Reg<'m>,
    index: Reg<'m>,
}

impl<'m> Register<'m> {
    fn new(m: &'m Module, tables: &Tables<'m>, name: &str, doc: &str) -> Register<'m> {
        let what = if tables.key == tables.column { "column" } else { "key" };
        let key = m.reg(&format!("{name}_{what}"), tables.key).doc(doc);
        Register { key, index: m.reg(&format!("{name}_index"), tables.index).doc("its number") }
    }

    /// What it holds.
    pub fn q(self) -> Word<'m> {
        Word { key: self.key.q(), index: self.index.q() }
    }

    fn set(self, word: Word<'m>) {
        self.key.set(word.key);
        self.index.set(word.index);
    }

    fn when(self, is: Signal<'m>, word: Word<'m>) {
        self.key.when(is, word.key);
        self.index.when(is, word.index);
    }
}

impl<'a, 'm> Inserts<'a, 'm> {
    /// The registers, without updates.
    pub fn new(m: &'m Module, tables: &'a Tables<'m>) -> Inserts<'a, 'm> {
        m.comment("Stage E: does the edge go behind the last of its list, or before some? That is found out on its way from D.");
        let count = m.reg("count", tables.index + 1).doc("edges in the list of the next line").reset(0);
        let word = |name: &str, doc: &str| Register::new(m, tables, name, doc);
        let doc = |of: &str| of.replace("column", tables.sorted_by);
        let stepped = word("d", &doc("signed, column of the edge on the next line"));
        let edge = word("e", &doc("signed, column of the edge that goes into the list"));
        let head = word("head", &doc("signed, first column of the list"));
        let top = word("top", &doc("signed, last column of the list"));
        let stepped_valid = m.reg("d_valid", 1).reset(0);
        let valid = m.reg("e_valid", 1).reset(0);
        let before = m.reg("before_top", 1).doc("the edge of E goes before the last of the list");
        let moving = m.reg("moving", 1).doc("words move up for the edge of E").reset(0);
        let moves = (valid.q() & !moving.q() & before.q()).named("begins_moving");
        Inserts { m, tables, count, head, top, stepped, stepped_valid, edge, valid, before, moving, moves }
    }

    /// E does not take another edge in this clock.
    pub fn holds(&self) -> Signal<'m> {
        self.moving.q() | self.moves
    }

    /// The updates, and the list's ports.
    pub fn update(&self, comes: &Comes<'m>) {
        let Inserts {
            m,
            tables,
            count,
            head,
            top,
            stepped,
            stepped_valid,
            edge,
            valid,
            before,
            moving,
            moves,
        } = *self;
        m.comment(
            "The words before which the edge goes move up, the last of them first; then it takes the gap. They are read a clock ahead of that.",
        );
        let gap = m.reg("gap", tables.index).doc("the place that is free");
        let end = count.q().trunc(tables.index);
        let below = m.reg("next_before", tables.index).doc("place of the word that is read next");
        let place = moving.q().mux(below.q(), end - 2).named("read_before");
        below.set(place - 1);
        let read = tables.word(tables.lists.read(valid.q(), tables.at(comes.list, place)));
        let word = Register::new(m, tables, "gap_word", "the word before the gap");
        word.set(read);
        let greater = m.reg("gap_greater", 1).doc("the word before the gap goes behind the edge");
        let greater = greater.set(edge.q().key.slt(read.key)).q();
        let word = word.q();
        let fetches = m.reg("fetches", 1).doc("the word before the gap is read");
        fetches.set(moves);
        let shifts = (moving.q() & !fetches.q() & gap.q().any() & greater).named("shifts");
        let leaves = valid.q() & !moves & !fetches.q() & !shifts;
        let leaves = leaves.named_doc("placed", "the edge has its place");
        moving.when(leaves, 0).when(moves, 1);
        gap.when(shifts, gap.q() - 1).when(moves, end - 1);

        let place = moving.q().mux(gap.q(), end).named("list_place");
        let moved = (moves | shifts).named("moved");
        let written = Word::choose(moved, Word::choose(shifts, word, top.q()), edge.q());
        tables.lists.write(valid.q(), tables.at(comes.list, place), written.joined());
        top.when(leaves & !moving.q(), edge.q());
        count.when(leaves, count.q() + 1).when(comes.line_ends, 0);

        let alone =
            (!count.q().any() & !valid.q()).named_doc("first_of_list", "the list is empty, and so is E");
        let takes = (comes.advance & stepped_valid.q()).named("d_to_e");
        head.when(leaves & moving.q() & !gap.q().any(), edge.q());
        head.when(takes & alone, stepped.q());
        // The last word will be that of E, if there is one.
        let last = Word::choose(valid.q(), edge.q(), top.q());
        let smaller = stepped.q().key.slt(last.key).named("d_smaller");
        before.set(smaller & !alone);
        valid.when(leaves, 0).when(comes.advance, stepped_valid.q());
        edge.when(takes, stepped.q());
        stepped_valid.when(comes.advance, comes.valid);
        stepped.when(comes.advance, comes.edge);
    }
}
