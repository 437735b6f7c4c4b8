//! PASS: goes through the active list of a line once; pairs of its columns are spans, and each edge steps into the list of the
//! next line.

use super::along::Along;
use super::table::{Bank, Colours, Record, Word};
use crate::Events;
use crate::counters::one_more;
use crate::tokens::EdgeWalk;
use edgewalk_machine::Plan;

/// A word with its record.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Read {
    pub index: u32,
    pub walk: EdgeWalk,
    /// n: lines left.
    pub lines: u32,
    /// With bilinear colours: those of the edge.
    pub colours: Colours,
    /// The edge begins on the next line.
    pub entering: bool,
}

/// An edge on a line, as one of a pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct End {
    /// First column right of it, signed; of a line of one pixel that pixel.
    pub column: i32,
    /// With bilinear colours: 2^F - 1 - R.
    pub below: i32,
    /// Colours of the edge on the line, words of b + r bits.
    pub colours: [u64; 3],
}

/// Two columns of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Pair {
    pub y: u32,
    /// The left and the right edge; of a line of one pixel both are the one that there is.
    pub ends: [End; 2],
    pub thin: bool,
}

impl Pair {
    /// First columns right of both edges.
    pub fn columns(&self) -> [i32; 2] {
        self.ends.map(|end| end.column)
    }
}

/// State of PASS.
#[derive(Clone, Debug)]
pub(super) struct Pass {
    column_bits: u32,
    line_mask: u32,
    /// With bilinear colours: their formats.
    along: Option<Along>,
    lists: [Vec<Word>; 2],
    run: bool,
    thin: bool,
    y: u32,
    /// nxt: the next edge to enter, in the order list.
    next: u32,
    /// Edges that have not entered.
    todo: u32,
    /// a: the list that is read.
    old: usize,
    /// nn: words of the new list.
    new: u32,
    /// p: the next word of the old list to read.
    place: u32,
    /// Words from there on.
    unread: u32,
    b: Option<Word>,
    c: Option<Read>,
    d: Option<Word>,
    /// E: D a clock later, compared with the last word of the new list.
    e: Option<Word>,
    /// The cycle behind that in which the polygon began.
    fills: bool,
    /// The record of D is written.
    writes: Option<(u32, Record)>,
    /// The left edge of a pair.
    left: Option<End>,
    /// The last and the first word of the new list.
    top: Word,
    head: Word,
    /// E goes to this place of the new list, or before it.
    gap: Option<u32>,
    /// The word before that place is read, and not there yet.
    fetches: bool,
    pair: Option<Pair>,
    /// Not hardware: where the span before ends on this line.
    end: Option<i32>,
}

impl Pass {
    pub fn new(plan: &Plan) -> Pass {
        let edges = plan.polygon.edges as usize;
        Pass {
            column_bits: plan.widths().column,
            line_mask: u32::MAX >> (32 - plan.widths().line),
            along: plan.polygon.is_bilinear().then(|| Along::new(plan)),
            lists: [(); 2].map(|()| vec![Word::default(); edges]),
            run: false,
            thin: false,
            y: 0,
            next: 0,
            todo: 0,
            old: 0,
            new: 0,
            place: 0,
            unread: 0,
            b: None,
            c: None,
            d: None,
            e: None,
            fills: false,
            writes: None,
            left: None,
            top: Word::default(),
            head: Word::default(),
            gap: None,
            fetches: false,
            pair: None,
            end: None,
        }
    }

    pub fn reset(&mut self) {
        self.run = false;
        self.pair = None;
        self.writes = None;
    }

    /// A polygon is walked.
    pub fn runs(&self) -> bool {
        self.run
    }

    /// The columns that wait for MOVER.
    pub fn pair(&self) -> Option<Pair> {
        self.pair
    }

    /// A record is written.
    pub fn writes(&self) -> bool {
        self.run && self.writes.is_some()
    }

    /// The line that is passed, and that of the words of the new list.
    pub fn lines(&self) -> [u32; 2] {
        [self.y, (self.y + 1) & self.line_mask]
    }

    /// The words of the old list that are not read, and those of the new one.
    pub fn words(&self) -> [&[Word]; 2] {
        let [old, new] = [&self.lists[self.old], &self.lists[1 - self.old]];
        [&old[self.place as usize..][..self.unread as usize], &new[..self.new as usize]]
    }

    /// The word that was read, that with its record, that which was stepped, and that which goes into the new list.
    pub fn stages(&self) -> (Option<Word>, Option<Read>, [Option<Word>; 2]) {
        (self.b, self.c, [self.d, self.e])
    }

    /// The left column of a pair whose right one has not come.
    pub fn left(&self) -> Option<i32> {
        self.left.map(|left| left.column)
    }

    /// Where E goes, while words make room for it.
    pub fn gap(&self) -> Option<u32> {
        self.gap
    }

    /// Edges that have not entered, and the place of the first of them in the order list.
    pub fn waiting(&self) -> [u32; 2] {
        [self.todo, self.next]
    }

    /// Starts at the line before the first.
    pub fn begin(&mut self, edges: u32, first_line: u32, thin: bool) {
        (self.run, self.thin, self.todo, self.next) = (true, thin, edges, 0);
        self.y = first_line.wrapping_sub(1) & self.line_mask;
        (self.new, self.unread, self.left, self.gap, self.end) = (0, 0, None, None, None);
        (self.b, self.c, self.d, self.e, self.writes) = (None, None, None, None, None);
        self.fills = true;
    }

    /// E is smaller than the last word of the new list.
    fn moves(&self) -> bool {
        self.gap.is_none() && self.new > 0 && self.e.is_some_and(|e| e.is_before(&self.top))
    }

    /// C makes a pair, and its place is full.
    pub fn blocked(&self) -> bool {
        let pairs = self.c.is_some_and(|c| !c.entering && (self.left.is_some() || self.thin));
        self.run && pairs && self.pair.is_some()
    }

    /// Clock edge. `emptied`: the pair leaves its place.
    pub fn step(&mut self, bank: &mut Bank, emptied: bool, events: &mut Events) {
        let blocked = self.blocked();
        if emptied {
            self.pair = None;
        }
        if !self.run {
            return;
        }
        if std::mem::take(&mut self.fills) {
            return;
        }
        events.poly.polygon_blocked += u64::from(blocked);
        let (moves, inserting) = (self.moves(), self.gap.is_some());
        let advance = !(inserting || moves || blocked);
        let next = (self.y + 1) & self.line_mask;
        let first = bank.order.get(self.next as usize).copied().filter(|_| self.todo > 0);
        let enters = first.filter(|first| self.b.is_none() && first.line == next);
        let empty = self.b.is_none() && self.c.is_none() && self.d.is_none();
        let ends = !inserting && !moves && empty && enters.is_none();
        if let Some((index, record)) = self.writes.take() {
            bank.edges[index as usize] = record;
        }
        if inserting {
            self.insert(events);
        } else if moves {
            events.poly.polygon_tie += u64::from(self.e.is_some_and(|e| e.column == self.top.column));
            self.lists[1 - self.old][self.new as usize] = self.top;
            (self.gap, self.fetches) = (Some(self.new - 1), true);
            events.poly.polygon_moves += 1;
        } else if let Some(e) = self.e.take() {
            self.lists[1 - self.old][self.new as usize] = e;
            self.head = if self.new == 0 { e } else { self.head };
            self.top = e;
            self.new += 1;
        }
        if !advance {
            return;
        }
        self.e = self.d.take();
        self.work(events);
        let words = self.new;
        let read = |index: u32, entering: bool| {
            let Record { walk, lines, colours } = bank.edges[index as usize];
            Some(Read { index, walk, lines, colours, entering })
        };
        self.c = match (self.b, enters) {
            (Some(word), _) => read(word.index, false),
            (None, Some(first)) => {
                self.next += 1;
                self.todo -= 1;
                read(first.index, true)
            }
            (None, None) if ends && words > 0 => read(self.head.index, false),
            _ => None,
        };
        if ends {
            self.end_line(events);
        }
        self.b = (self.unread > 0).then(|| self.lists[self.old][self.place as usize]);
        if self.unread > 0 {
            (self.place, self.unread) = (self.place + 1, self.unread - 1);
        }
    }

    /// A word makes room for E, or E goes to its place.
    fn insert(&mut self, events: &mut Events) {
        let (Some(gap), Some(e)) = (self.gap, self.e) else { return };
        if std::mem::take(&mut self.fetches) {
            return;
        }
        let list = &mut self.lists[1 - self.old];
        let before = gap.checked_sub(1).map(|before| list[before as usize]);
        if let Some(word) = before.filter(|word| e.is_before(word)) {
            events.poly.polygon_tie += u64::from(word.column == e.column);
            list[gap as usize] = word;
            self.gap = Some(gap - 1);
            events.poly.polygon_moves += 1;
            return;
        }
        list[gap as usize] = e;
        if gap == 0 {
            self.head = e;
            events.poly.polygon_whole_list += 1;
        }
        self.new += 1;
        (self.e, self.gap) = (None, None);
    }

    /// C makes half a pair, or a whole one, and goes on to the next line.
    fn work(&mut self, events: &mut Events) {
        let Some(c) = self.c else { return };
        if !c.entering {
            let end =
                End { column: c.walk.c, below: self.word(c.index, &c.walk).below, colours: c.colours.values };
            let ends = match (self.thin, self.left.take()) {
                (true, _) => Some([end; 2]),
                (false, Some(left)) => Some([left, end]),
                (false, None) => {
                    self.left = Some(end);
                    None
                }
            };
            if let Some(ends) = ends {
                let columns = ends.map(|end| end.column);
                let touches = columns[0] < columns[1] && self.end == Some(columns[0]);
                events.poly.polygon_touching += u64::from(touches);
                self.end = Some(columns[1]);
                self.pair = Some(Pair { y: self.y, ends, thin: self.thin });
            }
            if c.lines == 1 {
                return; // the edge leaves
            }
        }
        let mut walk = c.walk;
        if !c.entering {
            walk.step(self.column_bits);
            let colours = self.along.as_ref().map_or(c.colours, |along| along.step(&c.colours));
            self.writes = Some((c.index, Record { walk, lines: c.lines - 1, colours }));
        }
        self.d = Some(self.word(c.index, &walk));
    }

    /// The word of an edge in the list of its line.
    fn word(&self, index: u32, walk: &EdgeWalk) -> Word {
        let below = if self.along.is_some() { walk.m - 1 - walk.r } else { 0 };
        Word { column: walk.c, below, index }
    }

    /// The new list becomes the old one, whose first word is in C.
    fn end_line(&mut self, events: &mut Events) {
        let words = self.new;
        self.run = words > 0 || self.todo > 0;
        if words == 0 && self.todo > 0 && self.next > 0 {
            one_more(&mut events.poly.polygon_gap);
        }
        self.old = 1 - self.old;
        self.y = (self.y + 1) & self.line_mask;
        (self.new, self.left, self.end) = (0, None, None);
        (self.place, self.unread) = (1, words.saturating_sub(1));
    }
}
