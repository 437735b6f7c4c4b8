//! Differences between a flipped word and the right word.

use super::flow::Flow;
use super::known::{At, Known, code};
use super::thing::{Differing, Thing, Thing::*};
use super::word::{Row, Word};

/// Of A and W the parts that a result is made of. The order is that of the ROM's numbers.
pub fn given(give: u8) -> &'static [Thing] {
    match give {
        4 => &[A, Below],
        // The others are numbers of P.
        1..=3 | 6 | 7 => &[A],
        // q is short.
        5 => &[A, W],
        _ => &[W, High],
    }
}

/// Results of lines have no number.
pub fn numbered(give: u8, at: At) -> u8 {
    if give <= 3 { 0 } else { at.number as u8 }
}

/// What the flipped word changes where nothing differs in front of it; none: the next word, or a port.
pub fn differences(flow: &Flow, at: At, known: &Known, other: &Word) -> Option<Differing> {
    let word = flow.word(at);
    let mut found = Differing::default();
    jumps_alike(flow, at, known, word, other, &mut found)?;
    acts_alike(flow, at, known, word, other, &mut found)?;
    let (row, other_row) = (known.read(word, at.number), known.read(other, at.number));
    let same_a = row == other_row || known.row(row) == known.row(other_row) && known.row(row).is_zero();
    for (load, factor) in [("load_f", F), ("load_g", G)] {
        match (word.is(load), other.is(load)) {
            (true, true) if !same_a => found.add([factor]),
            (a, b) if a != b => {
                found.add([factor, Left]);
                if load == "load_g" {
                    found.add([Skips]);
                    if b && known.settled {
                        found.0.insert(Skips, Some(known.skipping_of(known.row(other_row))));
                    }
                }
            }
            _ => {}
        }
    }
    let [mut a, mut below, mut w, mut high] = [false; 4];
    for negative in known.a.signs() {
        for right in at.right.map_or(vec![true, false], |right| vec![right]) {
            for upper in at.upper.map_or(vec![true, false], |upper| vec![upper]) {
                let case = Case { negative, right, upper };
                let [old, new] = [word, other].map(|word| sum(at, known, word, case));
                let above = [&old.0, &new.0].iter().all(|sum| sum.is_above(known, flow.pixel));
                a |= old.0 != new.0 && !above;
                below |= old.0 != new.0 && above;
                // The sum without its raised operand.
                let low = |sum: &Sum| {
                    let operand = sum.operand.filter(|(row, _)| !known.is_w_zero(*row));
                    Sum { operand, more: (None, sum.more.1), ..*sum }
                };
                let alike = low(&old.1) == low(&new.1);
                w |= !alike;
                high |= alike && old.1 != new.1;
            }
        }
    }
    found.add(
        [(a, A), (below, Below), (w, W), (high, High)]
            .into_iter()
            .filter(|(is, _)| *is)
            .map(|(_, thing)| thing),
    );
    if a && [word, other].iter().any(|word| word.get("act") == code::CHECK) {
        found.add([Unfit]);
    }
    let written = |word: &Word, which: &str| word.is(which).then(|| word.written(at.number));
    let zero = !w && !high && known.is_w_zero_behind(word, row);
    for (which, thing, differs) in [
        ("write_a", RowA as fn(u8) -> Thing, a),
        ("write_a", RowBelow as fn(u8) -> Thing, below),
        ("write_w", RowW as fn(u8) -> Thing, w),
        ("write_w", RowHigh as fn(u8) -> Thing, high),
    ] {
        let [old, new] = [written(word, which), written(other, which)];
        if old == new && !differs {
            continue;
        }
        // A 0 that is written over a 0.
        let stays = |row: &u8| which == "write_w" && zero && known.w_zero[usize::from(*row)];
        found.add([old, new].into_iter().flatten().filter(|row| !stays(row)).map(thing));
    }
    let gives = [word.get("give") as u8, other.get("give") as u8];
    // Of an edge that there is not nothing is taken.
    let is_there = |give: &u8| (1..=12).contains(give) && !((4..=7).contains(give) && at.number > 2);
    // Nor what has been taken.
    let again = |give: u8| !a && !w && !word.is("steps") && known.given == Some((give, numbered(give, at)));
    let takes = |give: &u8| is_there(give) && !again(*give);
    for give in gives.into_iter().filter(takes) {
        let parts = given(give);
        if gives[0] != gives[1]
            || a && parts.contains(&A)
            || w && parts.contains(&W)
            || high && parts.contains(&High)
        {
            // The prim before may be offered yet, or this one is.
            if !known.room || word.get("act") == code::DONE {
                return None;
            }
            found.add([Prim(give, numbered(give, at))]);
        }
    }
    Some(found)
}

/// A case that a step tells apart.
#[derive(Clone, Copy)]
struct Case {
    negative: bool,
    right: bool,
    upper: bool,
}

/// A sum: the register that it keeps, and its second operand. Two equal texts are equal sums.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Sum {
    /// 0, the same, twice, masked.
    base: u32,
    /// The row, and whether it is subtracted; none where it is 0.
    operand: Option<(Row, bool)>,
    /// Of W: a row that is raised, and the carry of a modulus.
    more: (Option<Row>, i8),
    /// W stands for the row.
    whole: bool,
}

impl Sum {
    /// The bits of A above P stay. Nothing is added to A, or A is masked and the number added is below P.
    fn is_above(&self, known: &Known, pixel: i128) -> bool {
        match self.operand {
            None => matches!(self.base, 1 | 3),
            Some((row, subtracts)) => {
                let number = known.row(row);
                self.base == 3 && !self.whole && !subtracts && number.low >= 0 && number.high < pixel
            }
        }
    }
}

/// The sums of A and of W.
fn sum(at: At, known: &Known, word: &Word, case: Case) -> (Sum, Sum) {
    let done = word.is("steps")
        && match word.get("only") {
            1 => case.negative,
            2 => !case.negative,
            3 => !case.upper,
            4 => case.right,
            _ => true,
        };
    let base_a = |base: u32| match base {
        _ if known.a.is_zero() => 0,
        3 if known.a.lines => 1,
        base => base,
    };
    let base_w = |base: u32| match base {
        _ if known.w => 0,
        3 => 1,
        base => base,
    };
    let of = |base: u32| Sum { base, operand: None, more: (None, 0), whole: false };
    if !done {
        return (of(base_a(1)), of(base_w(1)));
    }
    let row = known.read(word, at.number);
    let minus = word.is("minus") ^ (word.is("by_side") && case.right);
    let (subtracts, lowers) = if word.is("by_a") { (!case.negative, case.negative) } else { (minus, minus) };
    let (base, whole, is_zero) = (word.get("base"), word.is("whole"), known.row(row).is_zero());
    let operand = match whole {
        true => Some((Row::At(0), subtracts)),
        false => (!is_zero).then_some((row, subtracts)),
    };
    let a = Sum { operand, whole, ..of(base_a(base)) };
    // -x - 1 + 1, or x + 1, or -x - 1.
    let carry = i8::from(subtracts) - i8::from(lowers);
    let raised = (word.is("raised") && !is_zero).then_some(row);
    let operand = (raised.is_some() || !known.is_w_zero(row)).then_some((row, lowers));
    (a, Sum { operand, more: (raised, carry), ..of(base_w(base)) })
}

/// The word that follows, and what the jump does besides.
fn jumps_alike(
    flow: &Flow,
    at: At,
    known: &Known,
    word: &Word,
    other: &Word,
    found: &mut Differing,
) -> Option<()> {
    let [mut old, mut new] = [word, other].map(|word| Jump::of(at, known, word));
    for jump in [&mut old, &mut new] {
        let (Next::At(target) | Next::By(_, target)) = &mut jump.next;
        *target = flow.same(*target);
        // No triangle is there for some clocks: a word more that culls changes nothing.
        let ends = match jump.next {
            Next::At(target) => flow.ends(target),
            Next::By(by, target) => by == code::UNFIT && flow.ends(target) && flow.ends(at.place + 1),
        };
        if flow.ends(at.place) && at.place > 0 && ends {
            jump.next = Next::At(0);
        }
    }
    if old.next != new.next {
        return None;
    }
    if old.counts != new.counts {
        found.add([Count]);
    }
    if old.consumes != new.consumes {
        found.add([F, G, Left]);
        if !known.settled {
            found.add([Skips]);
        }
    }
    if old.links != new.links {
        found.add([Link]);
    }
    if old.numbers != new.numbers {
        found.add([Number]);
    }
    Some(())
}

/// What a jump does. Which word follows depends on a condition of which nothing is known, or it is a place.
#[derive(PartialEq, Eq)]
struct Jump {
    next: Next,
    counts: bool,
    consumes: bool,
    links: bool,
    numbers: bool,
}

#[derive(PartialEq, Eq)]
enum Next {
    At(u32),
    /// By the condition of this jump, with this target.
    By(u32, u32),
}

impl Jump {
    fn of(at: At, known: &Known, word: &Word) -> Jump {
        let (jump, target, behind) = (word.get("jump"), word.get("target"), at.place + 1);
        let signs = known.before.signs();
        let by = |condition: Option<bool>| match condition {
            Some(true) => Next::At(target),
            Some(false) => Next::At(behind),
            None if target == behind => Next::At(behind),
            None => Next::By(jump, target),
        };
        let next = match jump {
            // A triangle is there in all words but the first.
            code::WORDS if at.place > 0 => Next::At(behind),
            code::ROOM if known.room => Next::At(behind),
            code::SETTLE if known.settled && !word.is("load_f") => Next::At(behind),
            code::WORDS | code::ROOM | code::SETTLE | code::DIGITS | code::AGAIN => Next::By(jump, 0),
            code::ZEROS | code::MORE => Next::By(jump, target),
            code::NEGATIVE => by((signs.len() == 1).then(|| signs[0])),
            code::UNFIT if known.unfit => by(Some(true)),
            code::UNFIT => by(known.fits.then_some(false)),
            code::NO_UPPER => by(at.upper.map(|upper| !upper)),
            code::NO_LOWER => by(at.lower.map(|lower| !lower)),
            code::ROUNDS => by(Some(at.number > 0)),
            code::GOTO | code::CALL => Next::At(target),
            code::RETURN => Next::At(at.link),
            _ => Next::At(behind),
        };
        Jump {
            next,
            counts: jump == code::AGAIN,
            consumes: [code::DIGITS, code::ZEROS, code::MORE].contains(&jump),
            links: jump == code::CALL,
            numbers: jump == code::ROUNDS && at.number > 0,
        }
    }
}

/// The other acts of a word.
fn acts_alike(
    flow: &Flow,
    at: At,
    known: &Known,
    word: &Word,
    other: &Word,
    found: &mut Differing,
) -> Option<()> {
    let acts = [word.get("act"), other.get("act")];
    if acts[0] == acts[1] {
        return Some(());
    }
    // No port tells why a triangle is culled.
    if acts.iter().all(|act| code::DROPS.contains(act)) {
        return Some(());
    }
    let signs = known.before.signs();
    // The number of the round before is set last.
    let counts = at.number > 0 && [word, other].iter().all(|word| word.get("jump") == code::ROUNDS);
    for act in acts {
        match act {
            code::BESIDE if counts => {}
            act if counts && code::EDGES.contains(&act) => {}
            code::UNSORTED if known.unsorted => {}
            code::UNSORTED => found.add([Order]),
            act if code::SWAPS.contains(&act) && signs == [false] => {}
            act if code::SWAPS.contains(&act) => found.add([Order]),
            code::SIDE if signs.len() == 1 && at.right == Some(signs[0]) => {}
            code::SIDE => found.add([Right]),
            code::UPPER if signs.len() == 1 && at.upper == Some(!signs[0]) => {}
            code::UPPER => found.add([Upper]),
            code::LOWER if signs.len() == 1 && at.lower == Some(!signs[0]) => {}
            code::LOWER => found.add([Lower]),
            code::SHIFT => found.add([F, G]),
            code::JUDGE if known.fits => {}
            code::JUDGE | code::CHECK => found.add([Unfit]),
            act if code::TIMES.contains(&act) => found.add([Count]),
            code::SCALE => found.add([Scale]),
            code::LAST_ROUND if at.number == flow.last_round => found.add([Scale]),
            code::LAST_ROUND => found.add([Scale, Number]),
            act if code::EDGES.contains(&act) && act - code::EDGES[0] == at.number => {}
            act if code::EDGES.contains(&act) => found.add([Number]),
            code::BESIDE if at.number == 0 => {}
            code::BESIDE => found.add([Number]),
            act if code::DROPS.contains(&act) || act == code::DONE => return None,
            _ => {}
        }
    }
    Some(())
}
