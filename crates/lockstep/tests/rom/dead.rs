//! Flips of a bit of the program that no port shows: each changed value is made anew before it is read.
//!
//! A flip changes the word's effect on some of SETUP's registers and rows. From there every path is followed, with the set
//! of what may differ from the right run. The flip counts if such a thing decides the next word or leaves with a prim.

use super::differences::{differences, given, numbered};
use super::flow::Flow;
use super::known::{At, Known, code};
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
    if is_redundant(flow, place, &other) {
        return true;
    }
    let is_at = |at: &&At| at.place as usize == place;
    flow.known.keys().filter(is_at).all(|at| {
        let first = differences(flow, *at, &flow.known[at], &other);
        first.is_some_and(|first| follow(flow, at.place, *at, Differing::default(), first, &other))
    })
}

/// R m between `negate t[digits]` and D m, left out or done on a condition.
///
/// In front of R, -M <= A <= M, as all numbers of the table are. R changes the pair (W, A), but not the number W + A / M. If
/// -M <= A < M, A changes its sign; D m brings the pairs (W, A) and (W + 1, A - M) of A >= 0 and A - M < 0 to the same pair
/// (2W + 1, 2A - M), and the pairs of A < 0 likewise. If A = M, D m leaves A = M with R left out, and A = -M with R, as often
/// as it is done; the R m behind the next addition, or behind the last D m, brings both to the same pair.
fn is_redundant(flow: &Flow, place: usize, other: &Word) -> bool {
    let Some([before, word, behind]) =
        place.checked_sub(1).and_then(|first| flow.words.get(first..first + 3))
    else {
        return false;
    };
    let moves = |word: &Word, base: u32| {
        word.is("steps")
            && word.is("by_a")
            && (word.get("base"), word.get("only"), word.get("mode")) == (base, 0, 0)
    };
    let negates =
        before.is("steps") && before.is("minus") && (before.get("base"), before.get("mode")) == (0, 1);
    negates
        && moves(word, 1)
        && moves(behind, 2)
        && word.get("row") == behind.get("row")
        && word.differs_in(other, &["steps", "only"])
}

/// Follows all paths from there until nothing more is found that may differ; false: something is seen. `place` is that of
/// the flipped word; `extra` is what the word there changes besides.
pub fn follow(
    flow: &Flow,
    place: u32,
    from: At,
    differing: Differing,
    extra: Differing,
    other: &Word,
) -> bool {
    let mut reached: BTreeMap<At, Differing> = BTreeMap::new();
    let mut open = vec![(from, differing, extra)];
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
            let extra = if on.place == place {
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

/// What the flipped word changes where other things differ already: what it makes of them, and what it changes where none
/// does.
pub fn again(flow: &Flow, at: At, other: &Word, differing: &Differing) -> Option<Differing> {
    let known = &flow.known[&at];
    let mut found = differences(flow, at, known, other)?;
    found.join(&pass(at, known, other, differing)?);
    Some(found)
}

/// What differs behind a word, if this much does in front of it; none: a port or the next word does.
pub fn pass(at: At, known: &Known, word: &Word, before: &Differing) -> Option<Differing> {
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

    let row = known.read(word, at.number);
    let row_moves = match row {
        Row::At(_) if word.get("mode") == 1 => before.any(&[F, G]),
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
    let row_below = rows.iter().any(|row| before.has(RowBelow(*row)));
    let row_high = rows.iter().any(|row| before.has(RowHigh(*row)));
    let row_w = row_moves || rows.iter().any(|row| before.has(RowW(*row)));
    if word.is("load_f") {
        if row_a || row_below {
            after.add([F])
        } else {
            after.mend(F, LOADED)
        }
        after.mend(Left, LOADED);
    }
    // The skipping that has begun for nothing begins anew.
    if (word.is("load_f") || word.is("load_g")) && before.has(Skips) {
        let anew = |left: u8| if left > 2 { known.skipping } else { left };
        after.0.entry(Skips).and_modify(|left| *left = left.map(anew));
    }
    if word.is("load_g") {
        if row_a || row_below {
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
        let loads =
            word.get("base") == 0 && ["minus", "by_a", "by_side", "raised"].iter().all(|part| !word.is(part));
        let masks_or_loads = [0, 3].contains(&word.get("base"));
        // Added to something it reaches the bits above.
        let reaches = row_below && !whole && !loads || before.has(Below) && !masks_or_loads;
        after.set(
            A,
            depends || keeps && before.has(A) || reaches || if whole { before.has(W) } else { row_a },
        );
        after.set(Below, row_below && !whole || only != 0 && before.has(Below));
        let raised = word.is("raised") && row_a;
        after.set(High, keeps && before.has(High) || row_high);
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
        for (thing, row) in [(A, RowA(written)), (Below, RowBelow(written))] {
            if after.has(thing) { after.add([row]) } else { after.mend(row, WRITTEN) }
        }
    }
    if word.is("write_w") {
        for (thing, row) in [(W, RowW(written)), (High, RowHigh(written))] {
            if after.has(thing) { after.add([row]) } else { after.mend(row, WRITTEN) }
        }
    }
    let give = word.get("give") as u8;
    if give > 0 {
        let walked = (4..=7).contains(&give) && before.any(&[Upper, Lower]);
        let differs = walked || give > 3 && before.has(Number) || after.any(given(give));
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
        // What lands in this clock is not shifted.
        let lands = |thing: &Thing| before.0.get(thing) == Some(&Some(1));
        after.add([F, G, Left].into_iter().filter(|thing| !lands(thing)));
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
