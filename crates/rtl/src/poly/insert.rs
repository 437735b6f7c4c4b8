//! Stage D of PASS: an edge goes into the active list of the next line, by its column.

use edgewalk_netlist::{Module, Reg, Signal};

use super::table::{Tables, Word};

/// The list of the next line, and the edge in D.
pub(super) struct Inserts<'a, 'm> {
    m: &'m Module,
    tables: &'a Tables<'m>,
    /// Words in the list.
    pub count: Reg<'m>,
    /// First word of the list.
    pub head: Register<'m>,
    /// Last word of the list.
    top: Register<'m>,
    /// The edge in D.
    pub edge: Register<'m>,
    /// There is one.
    pub valid: Reg<'m>,
    /// Words move up for it.
    moving: Reg<'m>,
    /// Words begin to move up in this clock.
    moves: Signal<'m>,
}

/// What comes into D, and where it goes from there.
pub(super) struct Comes<'m> {
    /// The active list of the next line.
    pub list: Signal<'m>,
    /// An edge may come into D.
    pub advance: Signal<'m>,
    /// One does.
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

    fn when(self, is: Signal<'m>, word: Word<'m>) {
        self.key.when(is, word.key);
        self.index.when(is, word.index);
    }
}

impl<'a, 'm> Inserts<'a, 'm> {
    /// The registers, without updates.
    pub fn new(m: &'m Module, tables: &'a Tables<'m>) -> Inserts<'a, 'm> {
        m.comment("Stage D: does the edge go behind the last of its list, or before some?");
        let count = m.reg("count", tables.index + 1).doc("edges in the list of the next line").reset(0);
        let word = |name: &str, doc: &str| Register::new(m, tables, name, doc);
        let doc = |of: &str| of.replace("column", tables.sorted_by);
        let edge = word("d", &doc("signed, column of the edge on the next line"));
        let head = word("head", &doc("signed, first column of the list"));
        let top = word("top", &doc("signed, last column of the list"));
        let valid = m.reg("d_valid", 1).reset(0);
        let moving = m.reg("moving", 1).doc("words move up for the edge of D").reset(0);
        let before = edge.q().key.slt(top.q().key).named("before_top");
        let moves = (valid.q() & !moving.q() & count.q().any() & before).named("begins_moving");
        Inserts { m, tables, count, head, top, edge, valid, moving, moves }
    }

    /// D does not take another edge in this clock.
    pub fn holds(&self) -> Signal<'m> {
        self.moving.q() | self.moves
    }

    /// The updates, and the list's ports.
    pub fn update(&self, comes: &Comes<'m>) {
        let Inserts { m, tables, count, head, top, edge, valid, moving, moves } = *self;
        m.comment(
            "The words before which the edge goes move up, the last of them first; then it takes the gap.",
        );
        let gap = m.reg("gap", tables.index).doc("the place that is free");
        let end = count.q().trunc(tables.index);
        let before_gap = (moving.q().mux(gap.q() - 1, end - 1) - 1).named("before_gap");
        let word = tables.word(tables.lists.read(valid.q(), tables.at(comes.list, before_gap)));
        let shifts = gap.q().any() & edge.q().key.slt(word.key);
        let shifts = (moving.q() & shifts).named("shifts");
        let leaves = (valid.q() & !moves & !shifts).named_doc("placed", "the edge has its place");
        moving.when(leaves, 0).when(moves, 1);
        gap.when(shifts, gap.q() - 1).when(moves, end - 1);

        let place = moving.q().mux(gap.q(), end).named("list_place");
        let moved = (moves | shifts).named("moved");
        let written = Word::choose(moved, Word::choose(shifts, word, top.q()), edge.q());
        tables.lists.write(valid.q(), tables.at(comes.list, place), written.joined());
        let first = moving.q().mux(!gap.q().any(), !count.q().any());
        head.when(leaves & first, edge.q());
        top.when(leaves & !moving.q(), edge.q());
        count.when(leaves, count.q() + 1).when(comes.line_ends, 0);

        valid.when(leaves, 0).when(comes.advance, comes.valid);
        edge.when(comes.advance, comes.edge);
    }
}
