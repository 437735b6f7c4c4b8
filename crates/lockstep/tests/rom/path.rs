//! Both runs at a word of a path, and what the path says of numbers.

use super::flow::Flow;
use super::form::{Atom, Form};
use super::known::{At, Known};
use super::range::Range;
use super::thing::Differing;
use std::collections::{BTreeMap, BTreeSet};

/// What is known in front of the first word.
pub struct Start<'f> {
    pub known: &'f Known,
    pub late: BTreeSet<u8>,
    /// The order of the vertices is the last.
    pub sorted: bool,
}

/// A, W and rows of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    pub a: Form,
    pub w: Form,
    /// A as control sees it.
    pub before: Form,
    /// Rows that have been written: whether W, which, from which clock on, and what.
    pub written: Vec<(bool, u8, u32, Form)>,
}

impl Lane {
    /// A or W of a row that is read in this clock.
    pub fn row(&self, start: &Start<'_>, of_w: bool, row: u8, clock: u32) -> Form {
        let written =
            self.written.iter().rev().find(|(w, at, from, _)| (*w, *at) == (of_w, row) && *from <= clock);
        if let Some((.., form)) = written {
            return form.clone();
        }
        let is_late = start.late.contains(&row);
        let (place, version) = (usize::from(row), if is_late { clock.min(2) as u8 } else { 2 });
        let range = start.known.rows[place];
        match of_w {
            true if start.known.w_zero[place] && !is_late => Form::default(),
            true => Form::of(Atom::RowW(row, version)),
            false if range.low == range.high && !is_late => Form::constant(range.low),
            false => Form::of(Atom::RowA(row, version)),
        }
    }
}

/// Both runs at a word.
#[derive(Clone)]
pub struct Path {
    pub at: At,
    pub clock: u32,
    pub runs: [Lane; 2],
    /// Whether these are below 0.
    pub signs: BTreeMap<Form, bool>,
    /// What signs say of single atoms.
    pub ranges: BTreeMap<Atom, Range>,
    pub differing: Differing,
    /// Changes of the order of the vertices.
    pub order: u32,
}

impl Path {
    pub fn sign(&self, flow: &Flow, start: &Start<'_>, form: &Form) -> Option<bool> {
        if let Some(number) = form.number() {
            return Some(number < 0);
        }
        // What is masked keeps its sign.
        if let Some((Atom::Masked(of), 1, 0)) = form.single() {
            return self.sign(flow, start, of);
        }
        let told = self.signs.get(form).copied();
        let told = told.or_else(|| self.signs.get(&form.complement()).map(|negative| !negative));
        told.or_else(|| match self.range(flow, start, form).signs()[..] {
            [negative] => Some(negative),
            _ => None,
        })
    }

    /// Bounds of a sum.
    pub fn range(&self, flow: &Flow, start: &Start<'_>, form: &Form) -> Range {
        let mut sum = Range::ZERO;
        for (atom, count) in &form.atoms {
            sum = sum.plus(self.atom(flow, start, atom).times(*count), false);
        }
        // Signs of sums of the same atoms, or of their negatives.
        let atoms = Form { constant: 0, ..form.clone() };
        for (other, negative) in &self.signs {
            let of = Form { constant: 0, ..other.clone() };
            let (least, most) = match negative {
                true => (None, Some(-1 - other.constant)),
                false => (Some(-other.constant), None),
            };
            let (least, most) = match () {
                () if of == atoms => (least, most),
                () if of == Form::default().plus(&atoms, -1) => (most.map(|n| -n), least.map(|n| -n)),
                () => continue,
            };
            sum.low = least.map_or(sum.low, |least| sum.low.max(least));
            sum.high = most.map_or(sum.high, |most| sum.high.min(most));
        }
        sum = sum.rounded(flow.pixel);
        // Of sorted vertices.
        if let [(Atom::Vertex(a, 1, 0), i), (Atom::Vertex(b, 1, 0), j)] =
            form.atoms.iter().collect::<Vec<_>>()[..]
            && start.sorted
            && (*i, *j) == (-1, 1)
            && a < b
        {
            sum.low = sum.low.max(0);
        }
        sum = sum.plus(
            Range { low: form.constant, high: form.constant, lines: form.constant % flow.pixel == 0 },
            false,
        );
        // What a lane cannot hold is not known.
        if sum.low < -flow.most || sum.high >= flow.most {
            Range { lines: sum.lines, ..Range::ANY }
        } else {
            sum
        }
    }

    fn atom(&self, flow: &Flow, start: &Start<'_>, atom: &Atom) -> Range {
        let known = start.known;
        let all = match atom {
            Atom::A => known.a,
            Atom::Before => known.before,
            Atom::RowA(row, 2) => known.rows[usize::from(*row)],
            Atom::Vertex(_, part, _) => known.rows[128 + usize::from(*part)],
            Atom::Digits(_, rows) => {
                rows.iter().map(|row| self.range(flow, start, row)).reduce(Range::join).unwrap_or(Range::ANY)
            }
            Atom::Masked(of) => {
                let of = self.range(flow, start, of);
                let floor = |number: i128| number.div_euclid(flow.pixel) * flow.pixel;
                Range { low: floor(of.low), high: floor(of.high), lines: true }
            }
            _ => Range::ANY,
        };
        let Some(range) = self.ranges.get(atom) else { return all };
        Range { low: all.low.max(range.low), high: all.high.min(range.high), ..all }.rounded(flow.pixel)
    }

    /// The sign of a sum, and what it says of its atom, if it has one alone.
    pub fn tell(&mut self, form: &Form, negative: bool) {
        if form.number().is_some() {
            return;
        }
        if let Some((Atom::Masked(of), 1, 0)) = form.single() {
            return self.tell(of, negative);
        }
        self.signs.insert(form.clone(), negative);
        let range = match form.single() {
            Some((_, 1, constant)) if negative => Range { high: -1 - constant, ..Range::ANY },
            Some((_, 1, constant)) => Range { low: -constant, ..Range::ANY },
            Some((_, -1, constant)) if negative => Range { low: constant + 1, ..Range::ANY },
            Some((_, -1, constant)) => Range { high: constant, ..Range::ANY },
            _ => return,
        };
        if let Some((atom, ..)) = form.single() {
            let known = self.ranges.entry(atom.clone()).or_insert(Range::ANY);
            (known.low, known.high) = (known.low.max(range.low), known.high.min(range.high));
        }
    }
}
