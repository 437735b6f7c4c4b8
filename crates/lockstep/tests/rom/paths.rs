//! Flips that change nothing because of what A and W are on each path: both runs are followed word by word, with A, W and
//! the rows as sums of what they were in front of the flipped word. Where a sign decides, both cases are followed apart.

use super::dead::{again, follow, pass};
use super::differences::{differences, given, numbered};
use super::flow::Flow;
use super::form::{Atom, Form};
use super::known::{At, code};
use super::path::{Lane, Path, Start};
use super::range::Range;
use super::thing::{Differing, Thing, Thing::*};
use super::word::{Row, Word};
use std::collections::{BTreeMap, BTreeSet};

/// Words that a path is followed behind the flipped one.
const DEEP: u32 = 40;

/// Words of all paths together.
const MOST: u32 = 3000;

/// Words in front of the flipped one that are followed too, and that one.
const NEAR: usize = 6;

/// Clocks from a word on until what it writes can be read.
const WRITTEN: u32 = 3;

/// The flip is dead wherever the word is executed. Rows that still differ when the word is executed again are taken to
/// differ from the start.
pub fn is_dead(flow: &Flow, place: u32, other: &Word) -> bool {
    let starts: Vec<At> = flow.known.keys().copied().filter(|at| at.place == place).collect();
    let mut differing = Differing::default();
    for _ in 0..3 {
        let mut wanted = differing.clone();
        let dead = starts.iter().all(|at| is_dead_at(flow, *at, &starts, other, &differing, &mut wanted));
        if dead || wanted == differing {
            return dead;
        }
        differing = wanted;
    }
    false
}

fn is_dead_at(
    flow: &Flow,
    at: At,
    starts: &[At],
    other: &Word,
    differing: &Differing,
    wanted: &mut Differing,
) -> bool {
    // A few words in front of the flipped one say how A and rows are related.
    let mut chain = vec![at];
    while chain.len() < NEAR {
        let first = chain[chain.len() - 1];
        match before(flow, first).collect::<Vec<_>>()[..] {
            [one] if one.place != at.place && !chain.contains(&one) => chain.push(one),
            _ => break,
        }
    }
    let first = chain[chain.len() - 1];
    let known = &flow.known[&first];
    let start = Start { known, late: late(flow, first), sorted: first.place > flow.sorted };
    let number = |range: Range, atom| match range.low == range.high {
        true => Form::constant(range.low),
        false => Form::of(atom),
    };
    let a = number(known.a, Atom::A);
    let lane = Lane {
        before: if known.alike { a.clone() } else { number(known.before, Atom::Before) },
        a,
        w: if known.w { Form::default() } else { Form::of(Atom::W) },
        written: Vec::new(),
    };
    let mut prover = Prover {
        flow,
        place: at.place,
        chain,
        other,
        start,
        left: MOST,
        unknown: 0,
        differing,
        assumed: starts,
        wanted: Differing::default(),
    };
    let path = Path {
        at: first,
        clock: 0,
        runs: [lane.clone(), lane],
        signs: BTreeMap::new(),
        ranges: BTreeMap::new(),
        differing: Differing::default(),
        order: 0,
    };
    let dead = prover.is_dead(&path);
    wanted.add(prover.wanted.0.into_keys());
    dead
}

/// Rows that the two words in front of this one may write: they hold the number of before for a clock or two.
fn late(flow: &Flow, at: At) -> BTreeSet<u8> {
    let near: BTreeSet<At> =
        before(flow, at).flat_map(|one| before(flow, one).chain([one]).collect::<Vec<_>>()).collect();
    let writes = near.into_iter().filter(|from| {
        let word = flow.word(*from);
        word.is("write_a") || word.is("write_w")
    });
    writes.map(|from| flow.word(from).written(from.number)).collect()
}

/// The words that may stand in front of one.
fn before(flow: &Flow, at: At) -> impl Iterator<Item = At> {
    flow.known.keys().copied().filter(move |from| flow.next(*from).contains(&at))
}

/// A word for the run as it is, and one for the other.
struct Prover<'f> {
    flow: &'f Flow,
    place: u32,
    /// The place, and those in front of it.
    chain: Vec<At>,
    other: &'f Word,
    start: Start<'f>,
    left: u32,
    unknown: u32,
    /// Rows that differ from the start.
    differing: &'f Differing,
    /// Places from which that is proved too.
    assumed: &'f [At],
    /// Rows that differ when the word is executed again.
    wanted: Differing,
}

impl<'f> Prover<'f> {
    fn is_dead(&mut self, path: &Path) -> bool {
        if self.left == 0 || path.clock > DEEP + NEAR as u32 {
            return false;
        }
        self.left -= 1;
        let right = self.flow.word(path.at);
        let flips = path.clock as usize + 1 == self.chain.len();
        let words = [right, if flips { self.other } else { right }];
        let mut path = path.clone();
        if flips {
            path.differing = self.differing.clone();
            for thing in self.differing.0.keys() {
                self.unknown += 2;
                let unknown = Form::of(Atom::Unknown(self.unknown));
                if let RowA(row) | RowW(row) = thing {
                    path.runs[1].written.push((matches!(thing, RowW(_)), *row, path.clock, unknown));
                }
            }
        }
        let path = &path;
        let mut cases = vec![path.clone()];
        for (lane, word) in path.runs.iter().zip(words) {
            let by_a = word.is("steps") && (word.is("by_a") || matches!(word.get("only"), 1 | 2));
            let acts = [code::SIDE, code::UPPER, code::LOWER, code::SWAPS[0], code::SWAPS[1]];
            let by_sign = word.get("jump") == code::NEGATIVE || acts.contains(&word.get("act"));
            for form in [(by_a, &lane.a), (by_sign, &lane.before)].into_iter().filter(|(asks, _)| *asks) {
                cases = cases.into_iter().flat_map(|case| self.split(case, form.1)).collect();
            }
        }
        cases.iter().all(|case| self.flags(case.at, words).into_iter().all(|at| self.case(case, at, words)))
    }

    /// Both signs of a number, if neither is known.
    fn split(&self, case: Path, form: &Form) -> Vec<Path> {
        let known = &self.flow.known[&case.at];
        let seen = [(&case.runs[0].a, known.a), (&case.runs[0].before, known.before)];
        let mut signs = vec![true, false];
        for (_, range) in seen.into_iter().filter(|(other, _)| *other == form) {
            signs.retain(|sign| range.signs().contains(sign));
        }
        if let Some(sign) = case.sign(self.flow, &self.start, form) {
            signs.retain(|other| *other == sign);
        }
        let with = |negative: bool| {
            let mut case = case.clone();
            case.tell(form, negative);
            case
        };
        signs.into_iter().map(with).collect()
    }

    /// The place with both values of flags that the path has not decided.
    fn flags(&self, at: At, words: [&Word; 2]) -> Vec<At> {
        let both = |flag: Option<bool>, asks: bool| match flag {
            None if asks => vec![Some(true), Some(false)],
            flag => vec![flag],
        };
        let any = |asks: &dyn Fn(&Word) -> bool| words.iter().any(|word| asks(word));
        let asks_upper = any(&|word| word.get("only") == 3 || word.get("jump") == code::NO_UPPER);
        let asks_right = any(&|word| word.get("only") == 4 || word.is("by_side"));
        let rights = both(at.right, asks_right);
        let with = |upper| rights.iter().map(move |right| At { upper, right: *right, ..at });
        both(at.upper, asks_upper).into_iter().flat_map(with).collect()
    }

    /// One case: the signs are those of the path, the flags those of `flags`.
    fn case(&mut self, path: &Path, flags: At, words: [&Word; 2]) -> bool {
        let (at, right) = (path.at, words[0]);
        let mut known = self.flow.known[&at].clone();
        if let Some(negative) = path.sign(self.flow, &self.start, &path.runs[0].a) {
            known.a = known.a.of_sign(negative);
        }
        if let Some(negative) = path.sign(self.flow, &self.start, &path.runs[0].before) {
            known.before = known.before.of_sign(negative);
        }
        let mut differing = path.differing.clone();
        let befores = path.runs.each_ref().map(|run| path.sign(self.flow, &self.start, &run.before));
        if befores[0].is_some() && befores[0] == befores[1] {
            differing.mend(Sign, 0);
        }
        let after = match path.clock as usize + 1 {
            clock if clock < self.chain.len() => Some(Differing::default()),
            clock if clock > self.chain.len() => pass(flags, &known, right, &differing),
            _ if path.differing.0.is_empty() => differences(self.flow, flags, &known, words[1]),
            _ => differences(self.flow, flags, &known, words[1]).and_then(|mut found| {
                found.join(&pass(flags, &known, words[1], &differing)?);
                Some(found)
            }),
        };
        let Some(mut after) = after else { return false };
        let rows = [0, 1].map(|run| self.row(path, &differing, flags, words[run], run));
        let mut runs = path.runs.clone();
        for run in 0..2 {
            let lane = &path.runs[run];
            let (a, w) = self.step(path, lane, flags, words[run], &rows[run]);
            let range = path.range(self.flow, &self.start, &a);
            let a = if range.low == range.high { Form::constant(range.low) } else { a };
            let written = words[run].written(at.number);
            for (w, field, form) in [(false, "write_a", &a), (true, "write_w", &w)] {
                if words[run].is(field) {
                    runs[run].written.push((w, written, path.clock + WRITTEN, form.clone()));
                }
            }
            runs[run] =
                Lane { before: lane.a.clone(), a, w, written: std::mem::take(&mut runs[run].written) };
        }
        for (load, factor) in [("load_f", F), ("load_g", G)] {
            if path.clock as usize + 1 == self.chain.len()
                && words.iter().all(|word| word.is(load))
                && rows[0].0 == rows[1].0
            {
                after.mend(factor, 0);
            }
        }
        after.word_is_over();
        self.refine(path, &runs, words, &mut after);
        let next_of_chain =
            self.chain.len().checked_sub(path.clock as usize + 2).map(|place| self.chain[place]);
        if next_of_chain.is_none() && after.0.is_empty() {
            return true;
        }
        let order = path.order
            + u32::from(right.get("act") == code::UNSORTED || code::SWAPS.contains(&right.get("act")));
        let next: Vec<At> = self.flow.next(at).to_vec();
        next.into_iter().filter(|on| goes(path, befores[0], right, flags, *on)).all(|on| {
            if let Some(next) = next_of_chain {
                let path = Path { at: on, clock: path.clock + 1, runs: runs.clone(), order, ..path.clone() };
                return on != next || self.is_dead(&path);
            }
            if on.place == self.place {
                let extra = again(self.flow, on, self.other, &after);
                let dead = extra
                    .is_some_and(|extra| follow(self.flow, self.place, on, after.clone(), extra, self.other));
                let rows = after.0.keys().all(|thing| matches!(thing, RowA(_) | RowW(_)));
                return dead
                    || rows && {
                        self.wanted.add(after.0.keys().copied());
                        self.assumed.contains(&on) && after.0.keys().all(|thing| self.differing.has(*thing))
                    };
            }
            let tried = path.clock as usize >= self.chain.len() && after == path.differing;
            !tried && follow(self.flow, self.place, on, after.clone(), Differing::default(), self.other) || {
                let path = Path {
                    at: on,
                    clock: path.clock + 1,
                    runs: runs.clone(),
                    signs: path.signs.clone(),
                    ranges: path.ranges.clone(),
                    differing: after.clone(),
                    order,
                };
                self.is_dead(&path)
            }
        })
    }

    /// A and W of the row that a word reads.
    fn row(
        &mut self,
        path: &Path,
        differing: &Differing,
        flags: At,
        word: &Word,
        run: usize,
    ) -> (Form, Form) {
        let row = self.flow.known[&path.at].read(word, flags.number);
        let moves = match row {
            Row::At(_) if word.get("mode") == 1 => differing.any(&[F, G]),
            Row::At(_) => ![0, 4].contains(&word.get("mode")) && differing.has(Number),
            Row::Digits(_) => differing.any(&[F, G]),
            Row::Vertex(..) => differing.any(&[Order, Number]),
        };
        if moves && run == 1 {
            self.unknown += 2;
            return (Form::of(Atom::Unknown(self.unknown)), Form::of(Atom::Unknown(self.unknown + 1)));
        }
        let lane = &path.runs[run];
        let of = |of_w: bool, row: u8| lane.row(&self.start, of_w, row, path.clock);
        match row {
            Row::At(row) => (of(false, row), of(true, row)),
            Row::Digits(table) => {
                let all = |of_w: bool| {
                    let rows: Vec<Form> = (table..table + 4).map(|row| of(of_w, row)).collect();
                    match rows.iter().all(|row| *row == rows[0]) {
                        true => rows[0].clone(),
                        false => Form::of(Atom::Digits(path.clock, rows)),
                    }
                };
                (all(false), all(true))
            }
            Row::Vertex(place, part) => (Form::of(Atom::Vertex(place, part, path.order)), Form::default()),
        }
    }

    /// A and W behind the word.
    fn step(
        &self,
        path: &Path,
        lane: &Lane,
        flags: At,
        word: &Word,
        (row_a, row_w): &(Form, Form),
    ) -> (Form, Form) {
        let stays = || (lane.a.clone(), lane.w.clone());
        if !word.is("steps") {
            return stays();
        }
        let is_right = flags.right == Some(true);
        let by_a = word.is("by_a");
        let negative = path.sign(self.flow, &self.start, &lane.a);
        let done = match word.get("only") {
            1 => negative == Some(true),
            2 => negative == Some(false),
            3 => flags.upper == Some(false),
            4 => is_right,
            _ => true,
        };
        if !done {
            return stays();
        }
        let (a, w) = match word.get("base") {
            0 => (Form::default(), Form::default()),
            1 => stays(),
            2 => (lane.a.twice(), lane.w.twice()),
            _ if path.range(self.flow, &self.start, &lane.a).lines => stays(),
            _ if lane.a == path.runs[0].a && self.flow.known[&path.at].a.lines => stays(),
            _ => (Form::of(Atom::Masked(lane.a.clone())), lane.w.clone()),
        };
        let operand = match word.is("whole") {
            true if lane.w.is_zero() => Form::default(),
            true => Form::of(Atom::Low(lane.w.clone())),
            false => row_a.clone(),
        };
        let more = match word.is("raised") && !row_a.is_zero() {
            true => Form::of(Atom::Raised(flags.number, row_a.clone(), row_w.clone())),
            false => row_w.clone(),
        };
        let minus = word.is("minus") ^ (word.is("by_side") && is_right);
        let (subtracts, lowers) = match by_a {
            true => (negative == Some(false), negative == Some(true)),
            false => (minus, minus),
        };
        let sign = |less: bool| if less { -1 } else { 1 };
        let carry = Form::constant(i128::from(subtracts) - i128::from(lowers));
        (a.plus(&operand, sign(subtracts)), w.plus(&more, sign(lowers)).plus(&carry, 1))
    }

    /// What differs in A, W and rows behind the word is what the sums say.
    fn refine(&self, path: &Path, runs: &[Lane; 2], words: [&Word; 2], after: &mut Differing) {
        let (at, clock) = (path.at, path.clock);
        let [old, new] = [&path.runs, runs];
        let same_a = new[0].a == new[1].a;
        let same_before = new[0].before == new[1].before;
        after.set(A, !same_a);
        after.set(W, new[0].w != new[1].w);
        after.mend(High, 0);
        after.mend(Below, 0);
        let signs = [0, 1].map(|run| path.sign(self.flow, &self.start, &new[run].before));
        after.set(Sign, !same_before && (signs[0].is_none() || signs[0] != signs[1]));
        let checks = words.iter().all(|word| word.get("act") == code::CHECK);
        if checks && same_a && old[0].a == old[1].a && !path.differing.has(Unfit) {
            after.mend(Unfit, 0);
        }
        after.0.retain(|thing, _| !matches!(thing, RowA(_) | RowBelow(_) | RowW(_) | RowHigh(_)));
        let rows: BTreeSet<(bool, u8)> =
            new.iter().flat_map(|run| run.written.iter().map(|(w, row, ..)| (*w, *row))).collect();
        for (of_w, row) in rows {
            let differs = |clock: u32| {
                let of = |run: usize| new[run].row(&self.start, of_w, row, clock);
                of(0) != of(1)
            };
            let thing = if of_w { RowW(row) } else { RowA(row) };
            let near = (1..WRITTEN as u8).rev().find(|near| differs(clock + u32::from(*near)));
            if differs(clock + WRITTEN) {
                after.0.insert(thing, None);
            } else if let Some(near) = near {
                after.0.insert(thing, Some(near));
            }
        }
        let give = words[0].get("give") as u8;
        if give > 0 && give == words[1].get("give") as u8 {
            let walked = (4..=7).contains(&give) && path.differing.any(&[Upper, Lower]);
            let given: &[Thing] = given(give);
            after.set(
                Prim(give, numbered(give, at)),
                walked || path.differing.has(Number) || after.any(given),
            );
        }
    }
}

/// Whether the path goes on there.
fn goes(path: &Path, negative: Option<bool>, word: &Word, flags: At, on: At) -> bool {
    let behind = on.place == path.at.place + 1;
    let target = on.place == word.get("target");
    let by_sign = match (word.get("jump"), negative) {
        (code::NEGATIVE, Some(true)) => target,
        (code::NEGATIVE, Some(false)) => behind,
        (code::NO_UPPER, _) if path.at.upper.is_none() => {
            (flags.upper == Some(true)) == (on.upper == Some(true))
        }
        _ => true,
    };
    by_sign
        && match (word.get("act"), negative) {
            (code::SIDE, Some(negative)) => on.right == Some(negative),
            (code::UPPER, Some(negative)) => on.upper == Some(!negative),
            (code::LOWER, Some(negative)) => on.lower == Some(!negative),
            _ => true,
        }
}
