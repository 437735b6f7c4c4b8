//! The paths of the program as it is, and what is known on them.

use super::differences::numbered;
use super::known::{At, Known, NOWHERE, ROWS, clocks_of_skipping, code};
use super::range::Range;
use super::word::{Row, Word};
use std::collections::BTreeMap;

/// The program, and what is known in front of its words.
pub struct Flow {
    pub words: Vec<Word>,
    /// The number of the last round.
    pub last_round: u32,
    /// The last word that may change the order of the vertices.
    pub sorted: u32,
    /// The row in front of those of the vertices' lines.
    pub lines: u8,
    /// P.
    pub pixel: i128,
    /// A of a lane is below this number, and not below its negative.
    pub most: i128,
    pub known: BTreeMap<At, Known>,
    next: BTreeMap<At, Vec<At>>,
}

impl Flow {
    /// Follows the program from its first word; `rows` are those at the start, with the ranges of a vertex's words from 128 on.
    pub fn new(
        words: Vec<Word>,
        last_round: u32,
        digits: u32,
        pixel: i128,
        lines: u8,
        rows: Vec<Range>,
    ) -> Flow {
        let start = At { place: 0, number: 0, link: NOWHERE, upper: None, lower: None, right: None };
        let known = Known {
            a: Range::ANY,
            before: Range::ANY,
            alike: false,
            w: false,
            // Memories start with 0, and no reset comes in between.
            w_zero: (0..ROWS).map(|row| row >> 4 != 0xb).collect(),
            rows,
            // A reset ends the skipping.
            settled: true,
            skips: false,
            fits: false,
            unfit: false,
            room: false,
            unsorted: false,
            y_of: None,
            given: None,
            same: None,
            masked: None,
            zeros: true,
            zeros_then: true,
            settling: 0,
            checked: false,
            positive: [true; 2],
            since: [None; 2],
            skipping: 2 + (0..digits).map(|first| clocks_of_skipping(digits, first)).max().unwrap_or(0),
            digits,
        };
        // A has twice the bits of a difference at the least.
        let most = 1 << (2 * (digits - 1) - 1);
        let sorted =
            words.iter().rposition(|word| code::SWAPS.contains(&word.get("act"))).unwrap_or(0) as u32;
        let mut flow = Flow {
            words,
            last_round,
            sorted,
            lines,
            pixel,
            most,
            known: BTreeMap::new(),
            next: BTreeMap::new(),
        };
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

    /// Of words that cull a triangle the first: no port tells the causes apart.
    pub fn same(&self, place: u32) -> u32 {
        let first = |target| (0..place).find(|other| self.culls(*other) == Some(target)).unwrap_or(place);
        self.culls(place).map_or(place, first)
    }

    /// The word culls, and nothing more, and the next one waits for a triangle.
    pub fn ends(&self, place: u32) -> bool {
        place == 0
            || self.words.get(place as usize).is_some_and(|word| word.get("target") == 0)
                && self.culls(place).is_some()
    }

    /// Where a word that does nothing but cull leads.
    fn culls(&self, place: u32) -> Option<u32> {
        let word = self.words.get(place as usize)?;
        let parts = ["steps", "give", "write_a", "write_w", "load_f", "load_g"];
        let alone = code::DROPS.contains(&word.get("act")) && parts.iter().all(|part| word.get(part) == 0);
        (alone && word.get("jump") == code::GOTO).then(|| word.get("target"))
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
            code::JUDGE => (after.fits, after.unfit) = (true, false),
            code::CHECK => after.checked = true,
            code::LAST_ROUND => on.number = self.last_round,
            code::BESIDE => on.number = 0,
            code::DONE => after.room = false,
            code::UNSORTED => after.unsorted = true,
            act if code::SWAPS.contains(&act) => after.unsorted = false,
            code::SHIFT => (after.since, after.zeros) = ([None; 2], false),
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
                            let (mut on, mut after) = (on, after.clone());
                            if known.alike {
                                after.before = after.before.of_sign(negative);
                                if after.alike {
                                    after.a = after.a.of_sign(negative);
                                }
                            }
                            match number {
                                0 => on.right = Some(negative),
                                1 => on.upper = Some(!negative),
                                _ => on.lower = Some(!negative),
                            }
                            (on, after)
                        })
                    })
                    .collect();
            }
        }
        starts.into_iter().flat_map(|(on, after)| self.jumps(at, known, on, after)).collect()
    }

    fn jumps(&self, at: At, known: &Known, on: At, after: Known) -> Vec<(At, Known)> {
        let word = &self.words[at.place as usize];
        let (behind, target, act) = (at.place + 1, word.get("target"), word.get("act"));
        let to = |place: u32| (At { place, ..on }, after.clone());
        // Behind the last digit of all nothing but 0 comes up.
        let over = |place: u32| {
            let zeros = after.zeros || after.since == [None; 2];
            (At { place, ..on }, Known { zeros, positive: [zeros; 2], ..after.clone() })
        };
        let more = |place: u32| (At { place, ..on }, Known { zeros: false, ..after.clone() });
        match word.get("jump") {
            code::WORDS => {
                vec![to(behind)]
            }
            code::SETTLE => {
                vec![(At { place: behind, ..on }, Known { settled: true, skips: false, ..after })]
            }
            code::ROOM => vec![(At { place: behind, ..on }, Known { room: true, ..after })],
            code::AGAIN => vec![to(at.place), to(behind)],
            code::DIGITS => vec![more(at.place), over(behind)],
            code::ZEROS => vec![more(at.place), over(target), more(behind)],
            code::MORE => vec![more(target), over(behind)],
            code::NEGATIVE => {
                let signs = known.before.signs();
                let next = |negative: &bool| {
                    let place = if *negative { target } else { behind };
                    let mut after = after.clone();
                    if known.alike {
                        after.before = after.before.of_sign(*negative);
                        if after.alike {
                            after.a = after.a.of_sign(*negative);
                        }
                    }
                    (At { place, ..on }, after)
                };
                signs.iter().map(next).collect()
            }
            code::UNFIT if known.fits => vec![to(behind)],
            code::UNFIT => {
                vec![
                    (At { place: target, ..on }, Known { unfit: act != code::JUDGE, ..after.clone() }),
                    to(behind),
                ]
            }
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
        after.settling = known.settling.saturating_sub(1);
        if word.is("load_g") || word.is("load_f") && after.settling > 0 {
            after.settling = known.skipping - 1;
        }
        after.settled = known.settled && !word.is("load_g") || after.settling == 0;
        after.fits = known.fits && !known.checked;
        after.checked = false;
        after.since = known.since.map(|words| words.map(|words| words.min(8) + 1));
        let are_new = after.since.iter().all(|words| words.is_some_and(|words| words > 1));
        after.zeros = known.zeros && known.zeros_then || are_new && known.positive == [true; 2];
        after.zeros_then = true;
        after.before = known.a;
        after.alike = !word.is("steps");
        let row = known.read(word, at.number);
        for (factor, load) in ["load_f", "load_g"].into_iter().enumerate() {
            if word.is(load) {
                let positive = known.row(row).low >= 0;
                after.positive[factor] = positive;
                after.zeros_then &= positive;
                after.since[factor] = Some(0);
            }
        }
        if word.is("steps") {
            let operand = if word.is("whole") { Range::ANY } else { known.row(row) };
            let same = !word.is("whole") && known.same.is_some_and(|same| row == Row::At(same));
            let mut results: Vec<Range> = Vec::new();
            for negative in known.a.signs() {
                let a = known.a.of_sign(negative);
                let operand = if same { a } else { operand };
                let base = match word.get("base") {
                    0 => Range::ZERO,
                    1 => a,
                    2 => a.plus(a, false),
                    _ => Range { low: a.low.div_euclid(self.pixel) * self.pixel, lines: true, ..a },
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
            // -M <= A in front of R m: the program keeps it.
            if word.is("by_a") && (word.get("base"), word.get("only")) == (1, 1) {
                after.a = after.a.of_sign(false);
            }
            let plain = word.get("only") == 0
                && !["raised", "whole", "by_a", "by_side"].iter().any(|part| word.is(part));
            after.y_of = None;
            after.same = None;
            after.given = None;
            let place = match row {
                Row::Vertex(place, 1) => Some((false, place)),
                Row::At(row) if (1..4).contains(&row.wrapping_sub(self.lines)) => {
                    Some((true, row - self.lines))
                }
                _ => None,
            };
            let of_same = known.same.filter(|row| (1..4).contains(&row.wrapping_sub(self.lines)));
            let of = known.y_of.or(of_same.map(|row| (true, row - self.lines)));
            let mode = word.get("mode");
            match (plain, word.get("base"), word.is("minus"), row) {
                (true, 0, false, Row::At(row)) => after.same = Some(row),
                // A number without its multiple of P.
                (true, 1, true, Row::At(row))
                    if known.same.is_some_and(|same| known.masked == Some((same, row))) =>
                {
                    after.a = Range { low: 0, high: self.pixel - 1, lines: false };
                }
                // An edge that is walked has its first line at or below its upper end.
                (true, 1, true, Row::Vertex(_, 1))
                    if mode == 6 && known.same.is_some_and(|row| row.wrapping_sub(self.lines) < 3) =>
                {
                    after.a.low = after.a.low.max(-self.pixel / 2);
                }
                _ => {}
            }
            if let (true, Some((is_line, place))) = (plain, place) {
                match (word.get("base"), word.is("minus"), of) {
                    (0, false, _) => after.y_of = Some((is_line, place)),
                    // Vertices are sorted, and so are their lines.
                    (1, true, Some((of, lower)))
                        if of == is_line && lower >= place && at.place > self.sorted =>
                    {
                        after.a = after.a.of_sign(false);
                    }
                    _ => {}
                }
            }
        }
        let give = word.get("give") as u8;
        if give > 0 {
            after.given = Some((give, numbered(give, at)));
        }
        after.w = known.is_w_zero_behind(word, row);
        let written = usize::from(word.written(at.number));
        if word.is("write_a") {
            after.rows[written] = after.a;
            let masks = word.is("steps") && word.get("base") == 3 && word.get("only") == 0;
            after.masked = match known.same {
                Some(of) if masks && known.row(row).is_zero() && !word.is("whole") => {
                    Some((of, written as u8))
                }
                _ => known.masked.filter(|rows| ![rows.0, rows.1].contains(&(written as u8))),
            };
            after.same = Some(written as u8);
        }
        if word.is("write_w") {
            after.w_zero[written] = after.w;
        }
    }
}
