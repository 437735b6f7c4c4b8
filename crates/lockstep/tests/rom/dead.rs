//! Flips of a bit of the program that no port shows: each changed value is made anew before it is read.
//!
//! A flip changes the word's effect on some of SETUP's registers and rows. From there every path is followed, with the set
//! of what may differ from the right run. The flip counts if such a thing decides the next word or leaves with a prim.

use super::differences::{differences, given, numbered};
use super::known::{At, Flow, Known, Range, code};
use super::thing::{Differing, Thing, Thing::*};
use super::word::{Row, Word};
use std::collections::BTreeMap;

/// Words behind one that writes a row in which the row still has what it had.
const WRITTEN: u8 = 3;
/// The same for a factor.
const LOADED: u8 = 2;
/// The flip of bits `flip` of the word at this place changes nothing that a port shows.
pub fn is_dead(flow: &Flow, fields: &[(&'static str, u32)], place: usize, flipped: u128) -> bool {
    let other = Word::new(fields, flipped);
    let is_at = |at: &&At| at.place as usize == place;
    flow.known.keys().filter(is_at).all(|at| {
        let Some(first) = differences(flow, *at, &flow.known[at], &other) else { return false };
        follow(flow, *at, first, &other)
    })
}

/// Follows all paths until nothing more is found that may differ; false: something is seen.
fn follow(flow: &Flow, at: At, first: Differing, other: &Word) -> bool {
    let mut reached: BTreeMap<At, Differing> = BTreeMap::new();
    let mut open = vec![(at, Differing::default(), first)];
    while let Some((from, differing, extra)) = open.pop() {
        let Some(mut after) = pass(from, &flow.known[&from], flow.word(from), &differing) else {
            return false;
        };
        after.0.extend(extra.0);
        after.word_is_over();
        if after.0.is_empty() {
            continue;
        }
        for on in flow.next(from) {
            let there = reached.entry(*on).or_default();
            if !there.join(&after) {
                continue;
            }
            let differing = there.clone();
            let extra = if on.place == at.place {
                again(flow, *on, other, &differing)
            } else {
                Some(Differing::default())
            };
            let Some(extra) = extra else { return false };
            open.push((*on, differing, extra));
        }
    }
    true
}

/// What the flipped word changes where other things differ already: all that it has to do with.
fn again(flow: &Flow, at: At, other: &Word, differing: &Differing) -> Option<Differing> {
    let known = &flow.known[&at];
    if flow.word(at).get("jump") != other.get("jump") {
        return None;
    }
    let rows = vec![Range::ANY; known.rows.len()];
    let unknown = Known {
        a: Range::ANY,
        before: Range::ANY,
        w: false,
        rows,
        w_zero: vec![false; known.w_zero.len()],
        ..known.clone()
    };
    let mut found = differences(flow, at, &unknown, other)?;
    found.add(pass(at, known, other, differing)?.0.into_keys());
    Some(found)
}

/// What differs behind a word, if this much does in front of it; none: a port or the next word does.
fn pass(at: At, known: &Known, word: &Word, before: &Differing) -> Option<Differing> {
    let decides: &[Thing] = match word.get("jump") {
        code::SETTLE => &[F, G, Left, Skips],
        code::DIGITS | code::MORE => &[Left],
        code::ZEROS => &[F, G, Left],
        code::AGAIN => &[Count],
        code::NEGATIVE => &[Sign],
        code::UNFIT => &[Unfit],
        code::NO_UPPER => &[Upper],
        code::NO_LOWER => &[Lower],
        code::ROUNDS => &[Number],
        code::RETURN => &[Link],
        _ => &[],
    };
    if before.any(decides) {
        return None;
    }
    let mut after = before.clone();
    skip(known, before, &mut after);
    act(word, before, &mut after);
    if word.get("jump") == code::CALL {
        after.mend(Link, 0);
    }

    let row = word.row(at.number);
    let row_moves = match row {
        Row::At(_) => word.get("mode") != 0 && word.get("mode") != 4 && before.has(Number),
        Row::Digits(_) => before.any(&[F, G]),
        Row::Vertex(..) => {
            let by_number = word.get("row") & 15 == 15 || word.get("mode") > 5;
            before.has(Order) || by_number && before.has(Number)
        }
    };
    let rows: Vec<u8> = match row {
        Row::At(row) => vec![row],
        Row::Digits(table) => (table..table + 4).collect(),
        Row::Vertex(..) => vec![],
    };
    let row_a = row_moves || rows.iter().any(|row| before.has(RowA(*row)));
    let row_w = row_moves || rows.iter().any(|row| before.has(RowW(*row)));
    if word.is("load_f") {
        if row_a {
            after.add([F])
        } else {
            after.mend(F, LOADED)
        }
        after.mend(Left, LOADED);
    }
    if word.is("load_g") {
        if row_a {
            after.add([G])
        } else {
            after.mend(G, LOADED)
        }
        after.mend(Left, LOADED);
        after.mend(Skips, LOADED);
    }

    after.set(Sign, before.has(A));
    if word.is("steps") {
        let only = word.get("only");
        let depends = word.is("by_a") && before.has(A)
            || word.is("by_side") && before.has(Right)
            || matches!(only, 1 | 2) && before.has(A)
            || only == 3 && before.has(Upper)
            || only == 4 && before.has(Right);
        let keeps = word.get("base") != 0 || only != 0;
        let whole = word.is("whole");
        after.set(A, depends || keeps && before.has(A) || if whole { before.has(W) } else { row_a });
        let raised = word.is("raised") && row_a;
        after.set(W, depends || keeps && before.has(W) || row_w || raised);
    }
    if word.get("act") == code::CHECK && (before.has(A) || after.has(A)) {
        after.add([Unfit]);
    }
    let written = word.written(at.number);
    if word.is("write_numbered") && before.has(Number) && (word.is("write_a") || word.is("write_w")) {
        return None;
    }
    if word.is("write_a") {
        if after.has(A) { after.add([RowA(written)]) } else { after.mend(RowA(written), WRITTEN) }
    }
    if word.is("write_w") {
        if after.has(W) { after.add([RowW(written)]) } else { after.mend(RowW(written), WRITTEN) }
    }
    let give = word.get("give") as u8;
    if give > 0 {
        let walked = (4..=7).contains(&give) && before.any(&[Upper, Lower]);
        let differs = walked || before.has(Number) || after.any(given(give));
        after.set(Prim(give, numbered(give, at)), differs);
    }
    if word.get("act") == code::DONE && after.0.keys().any(|thing| matches!(thing, Prim(..) | Right)) {
        return None;
    }
    Some(after)
}

/// Leading digits are skipped by themselves.
fn skip(known: &Known, before: &Differing, after: &mut Differing) {
    let skips = before.has(Skips) || known.skips;
    if skips && before.any(&[F, G, Left, Skips]) {
        after.add([F, G, Left]);
        if known.skips {
            after.add([Skips]);
        }
    }
}

/// What the act, and counting, do.
fn act(word: &Word, before: &Differing, after: &mut Differing) {
    let act = word.get("act");
    match act {
        code::UNSORTED => after.mend(Order, 0),
        code::SIDE => after.set(Right, before.has(Sign)),
        code::UPPER => after.set(Upper, before.has(Sign)),
        code::LOWER => after.set(Lower, before.has(Sign)),
        // A step that is checked just before may say so yet.
        code::JUDGE => after.mend(Unfit, 4),
        code::TIMES_K => after.set(Count, before.any(&[Scale, Number])),
        code::LAST_ROUND => {
            after.mend(Number, 0);
            after.mend(Scale, 0);
        }
        code::BESIDE => after.mend(Number, 0),
        _ => {}
    }
    if code::SWAPS.contains(&act) && before.has(Sign) {
        after.add([Order]);
    }
    if code::TIMES.contains(&act) && act != code::TIMES_K {
        after.mend(Count, 0);
    }
    if code::EDGES.contains(&act) {
        after.mend(Number, 0);
    }
}
