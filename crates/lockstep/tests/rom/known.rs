//! What is known of a run of the program as it is, in front of each of its words: an interval of A, of each row's A, and flags.

use super::word::{Row, Word};
use std::collections::BTreeMap;

/// Rows of a lane.
pub const ROWS: usize = 256;

/// Bounds of a whole number, and whether it is a multiple of P for certain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    pub low: i128,
    pub high: i128,
    pub lines: bool,
}

/// Farther than any A lies.
const FAR: i128 = 1 << 100;

impl Range {
    pub const ANY: Range = Range { low: -FAR, high: FAR, lines: false };
    pub const ZERO: Range = Range { low: 0, high: 0, lines: true };

    pub fn is_zero(self) -> bool {
        (self.low, self.high) == (0, 0)
    }

    /// Whether it can be below 0, and 0 or above.
    pub fn signs(self) -> Vec<bool> {
        [true, false]
            .into_iter()
            .filter(|negative| if *negative { self.low < 0 } else { self.high >= 0 })
            .collect()
    }

    /// The part below 0, or the other.
    fn of_sign(self, negative: bool) -> Range {
        match negative {
            true => Range { high: self.high.min(-1), ..self },
            false => Range { low: self.low.max(0), ..self },
        }
    }

    fn join(self, other: Range) -> Range {
        Range {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            lines: self.lines && other.lines,
        }
    }

    fn plus(self, other: Range, minus: bool) -> Range {
        let (low, high) = if minus { (-other.high, -other.low) } else { (other.low, other.high) };
        let cut = |number: i128| number.clamp(-FAR, FAR);
        Range { low: cut(self.low + low), high: cut(self.high + high), lines: self.lines && other.lines }
    }
}

/// No place of the program: the register of a call holds what it held.
const NOWHERE: u32 = u32::MAX;

/// The place in the program, with what the path to it has decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct At {
    pub place: u32,
    pub number: u32,
    /// `NOWHERE` where no call is open.
    pub link: u32,
    pub upper: Option<bool>,
    pub lower: Option<bool>,
    pub right: Option<bool>,
}

/// The values known at this place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Known {
    pub a: Range,
    /// A before the step of the word before: control sees its sign.
    pub before: Range,
    /// The step of the word before has left A.
    pub alike: bool,
    /// W is 0.
    pub w: bool,
    pub rows: Vec<Range>,
    /// Rows whose W is 0.
    pub w_zero: Vec<bool>,
    /// No leading digit is skipped.
    pub settled: bool,
    /// Leading digits may be skipped in this clock.
    pub skips: bool,
    /// No number has been found not to fit.
    pub fits: bool,
    /// No prim is offered.
    pub room: bool,
}

impl Known {
    pub fn row(&self, row: Row) -> Range {
        match row {
            Row::At(row) => self.rows[usize::from(row)],
            Row::Digits(table) => {
                (0..4).map(|i| self.rows[usize::from(table) + i]).reduce(Range::join).unwrap_or(Range::ANY)
            }
            Row::Vertex(_, part) => self.rows[128 + usize::from(part)],
        }
    }

    /// W of the row is 0.
    pub fn is_w_zero(&self, row: Row) -> bool {
        match row {
            Row::At(row) => self.w_zero[usize::from(row)],
            Row::Digits(table) => (0..4).all(|i| self.w_zero[usize::from(table) + i]),
            Row::Vertex(..) => true,
        }
    }

    /// W is 0 behind the word, which reads this row.
    pub fn is_w_zero_behind(&self, word: &Word, row: Row) -> bool {
        let added =
            !word.is("by_a") && self.is_w_zero(row) && (!word.is("raised") || self.row(row).is_zero());
        let kept = self.w || word.get("base") == 0 && word.get("only") == 0;
        if word.is("steps") { added && kept } else { self.w }
    }

    fn join(&mut self, other: &Known, widen: bool) -> bool {
        let was = self.clone();
        let one = |a: Range, b: Range| {
            let all = a.join(b);
            if widen && all != a {
                Range {
                    low: if all.low < a.low { -FAR } else { a.low },
                    high: if all.high > a.high { FAR } else { a.high },
                    ..all
                }
            } else {
                all
            }
        };
        self.a = one(self.a, other.a);
        self.before = one(self.before, other.before);
        for (row, new) in self.rows.iter_mut().zip(&other.rows) {
            *row = one(*row, *new);
        }
        for (zero, new) in self.w_zero.iter_mut().zip(&other.w_zero) {
            *zero &= new;
        }
        self.w &= other.w;
        self.alike &= other.alike;
        self.settled &= other.settled;
        self.skips |= other.skips;
        self.fits &= other.fits;
        self.room &= other.room;
        *self != was
    }
}

/// The numbers of jumps and acts, as the ROM has them.
pub mod code {
    pub const WORDS: u32 = 1;
    pub const ROOM: u32 = 2;
    pub const SETTLE: u32 = 3;
    pub const DIGITS: u32 = 4;
    pub const AGAIN: u32 = 5;
    pub const ZEROS: u32 = 6;
    pub const MORE: u32 = 7;
    pub const NEGATIVE: u32 = 8;
    pub const UNFIT: u32 = 9;
    pub const NO_UPPER: u32 = 10;
    pub const NO_LOWER: u32 = 11;
    pub const ROUNDS: u32 = 12;
    pub const GOTO: u32 = 13;
    pub const CALL: u32 = 14;
    pub const RETURN: u32 = 15;

    pub const UNSORTED: u32 = 1;
    pub const SWAPS: [u32; 2] = [2, 3];
    pub const SIDE: u32 = 4;
    pub const UPPER: u32 = 5;
    pub const LOWER: u32 = 6;
    pub const SHIFT: u32 = 7;
    pub const JUDGE: u32 = 8;
    pub const CHECK: u32 = 9;
    pub const TIMES: [u32; 4] = [10, 11, 23, 24];
    pub const TIMES_K: u32 = 11;
    pub const SCALE: u32 = 12;
    pub const LAST_ROUND: u32 = 13;
    pub const EDGES: [u32; 3] = [14, 15, 16];
    pub const BESIDE: u32 = 17;
    pub const DROPS: [u32; 3] = [19, 20, 21];
    pub const DONE: u32 = 22;
}

/// The program, and what is known in front of its words.
pub struct Flow {
    pub words: Vec<Word>,
    /// The number of the last round.
    pub last_round: u32,
    pub known: BTreeMap<At, Known>,
    next: BTreeMap<At, Vec<At>>,
}

impl Flow {
    /// Follows the program from its first word; `rows` are those at the start, with the ranges of a vertex's words from 128 on.
    pub fn new(words: Vec<Word>, last_round: u32, rows: Vec<Range>, written: &[bool]) -> Flow {
        let start = At { place: 0, number: 0, link: NOWHERE, upper: None, lower: None, right: None };
        let known = Known {
            a: Range::ANY,
            before: Range::ANY,
            alike: false,
            w: false,
            // Memories start with 0, and no reset comes in between.
            w_zero: (0..ROWS).map(|row| row < 128).collect(),
            rows: rows
                .iter()
                .enumerate()
                .map(|(i, row)| if i < 128 && written[i] { Range::ANY } else { *row })
                .collect(),
            // A reset ends the skipping.
            settled: true,
            skips: false,
            fits: false,
            room: false,
        };
        let mut flow = Flow { words, last_round, known: BTreeMap::new(), next: BTreeMap::new() };
        let mut open: Vec<At> = Vec::new();
        let mut visits: BTreeMap<At, u32> = BTreeMap::new();
        // Each triangle leaves the number 0.
        flow.known.insert(start, known);
        open.push(start);
        while let Some(at) = open.pop() {
            let before = flow.known[&at].clone();
            for (next, known) in flow.steps(at, &before) {
                let count = visits.entry(next).or_default();
                *count += 1;
                let widen = *count > 40;
                match flow.known.get_mut(&next) {
                    Some(old) => {
                        if old.join(&known, widen) {
                            open.push(next);
                        }
                    }
                    None => {
                        flow.known.insert(next, known);
                        open.push(next);
                    }
                }
            }
        }
        let places = flow.known.iter().map(|(at, known)| {
            let next: Vec<At> = flow.steps(*at, known).into_iter().map(|(on, _)| on).collect();
            (*at, next)
        });
        flow.next = places.collect();
        flow
    }

    /// The word at this place.
    pub fn word(&self, at: At) -> &Word {
        &self.words[at.place as usize]
    }

    /// The words that may follow a word.
    pub fn next(&self, at: At) -> &[At] {
        &self.next[&at]
    }

    /// The words that may follow a word, each with the values known there.
    fn steps(&self, at: At, known: &Known) -> Vec<(At, Known)> {
        let word = &self.words[at.place as usize];
        let mut after = known.clone();
        self.step(at, known, &mut after);
        let mut on = at;
        let act = word.get("act");
        match act {
            code::JUDGE => after.fits = true,
            code::CHECK => after.fits = false,
            code::LAST_ROUND => on.number = self.last_round,
            code::BESIDE => on.number = 0,
            code::DONE => after.room = false,
            _ => {}
        }
        if let Some(edge) = code::EDGES.iter().position(|edge| *edge == act) {
            on.number = edge as u32;
        }
        let mut starts = vec![(on, after)];
        // From here on the paths of both values of the flag are followed apart.
        for (number, flag) in [code::SIDE, code::UPPER, code::LOWER].into_iter().enumerate() {
            if act == flag {
                starts = starts
                    .into_iter()
                    .flat_map(|(on, after)| {
                        known.before.signs().into_iter().map(move |negative| {
                            let mut on = on;
                            match number {
                                0 => on.right = Some(negative),
                                1 => on.upper = Some(!negative),
                                _ => on.lower = Some(!negative),
                            }
                            (on, after.clone())
                        })
                    })
                    .collect();
            }
        }
        starts.into_iter().flat_map(|(on, after)| self.jumps(at, known, on, after)).collect()
    }

    fn jumps(&self, at: At, known: &Known, on: At, after: Known) -> Vec<(At, Known)> {
        let word = &self.words[at.place as usize];
        let (behind, target) = (at.place + 1, word.get("target"));
        let to = |place: u32| (At { place, ..on }, after.clone());
        match word.get("jump") {
            code::WORDS => {
                vec![to(behind)]
            }
            code::SETTLE => {
                vec![(At { place: behind, ..on }, Known { settled: true, skips: false, ..after })]
            }
            code::ROOM => vec![(At { place: behind, ..on }, Known { room: true, ..after })],
            code::DIGITS | code::AGAIN => vec![to(at.place), to(behind)],
            code::ZEROS => vec![to(at.place), to(target), to(behind)],
            code::MORE => vec![to(target), to(behind)],
            code::NEGATIVE => {
                let signs = known.before.signs();
                let next = |negative: &bool| {
                    let place = if *negative { target } else { behind };
                    let mut after = after.clone();
                    if known.alike && after.alike {
                        after.a = after.a.of_sign(*negative);
                        after.before = after.before.of_sign(*negative);
                    }
                    (At { place, ..on }, after)
                };
                signs.iter().map(next).collect()
            }
            code::UNFIT if known.fits => vec![to(behind)],
            code::UNFIT => vec![to(target), to(behind)],
            code::NO_UPPER | code::NO_LOWER => {
                let upper = word.get("jump") == code::NO_UPPER;
                let known = if upper { on.upper } else { on.lower };
                let next = |walked: bool| {
                    let mut next = At { place: if walked { behind } else { target }, ..on };
                    *(if upper { &mut next.upper } else { &mut next.lower }) = Some(walked);
                    (next, after.clone())
                };
                known.map_or(vec![true, false], |walked| vec![walked]).into_iter().map(next).collect()
            }
            code::ROUNDS if on.number > 0 => vec![(At { place: target, number: on.number - 1, ..on }, after)],
            // The next triangle.
            code::GOTO if target == 0 => {
                vec![(
                    At { place: 0, number: on.number, link: NOWHERE, upper: None, lower: None, right: None },
                    after,
                )]
            }
            code::GOTO => vec![to(target)],
            code::CALL => vec![(At { place: target, link: behind, ..on }, after)],
            code::RETURN => vec![(At { place: at.link, link: NOWHERE, ..on }, after)],
            _ => vec![to(behind)],
        }
    }

    /// The step and the values that it writes.
    fn step(&self, at: At, known: &Known, after: &mut Known) {
        let word = &self.words[at.place as usize];
        after.skips = !known.settled;
        if word.is("load_g") {
            after.settled = false;
        }
        after.before = known.a;
        after.alike = !word.is("steps");
        let row = word.row(at.number);
        if word.is("steps") {
            let operand = if word.is("whole") { Range::ANY } else { known.row(row) };
            let mut results: Vec<Range> = Vec::new();
            for negative in known.a.signs() {
                let a = known.a.of_sign(negative);
                let base = match word.get("base") {
                    0 => Range::ZERO,
                    1 => a,
                    2 => a.plus(a, false),
                    _ => Range { low: (a.low - (1 << 40)).max(-FAR), lines: true, ..a },
                };
                // What is masked keeps its sign.
                let base = if word.get("base") == 3 && !negative { Range { low: 0, ..base } } else { base };
                for right in at.right.map_or(vec![true, false], |right| vec![right]) {
                    let minus = word.is("minus") ^ (word.is("by_side") && right);
                    let minus = if word.is("by_a") { !negative } else { minus };
                    let stays = match word.get("only") {
                        1 => vec![!negative],
                        2 => vec![negative],
                        3 => at.upper.map_or(vec![true, false], |upper| vec![upper]),
                        4 => vec![!right],
                        _ => vec![false],
                    };
                    results
                        .extend(stays.iter().map(|stays| if *stays { a } else { base.plus(operand, minus) }));
                }
            }
            after.a = results.into_iter().reduce(Range::join).unwrap_or(Range::ANY);
        }
        after.w = known.is_w_zero_behind(word, row);
        let written = usize::from(word.written(at.number));
        if word.is("write_a") {
            after.rows[written] = after.a;
        }
        if word.is("write_w") {
            after.w_zero[written] = after.w;
        }
    }
}
