//! What random triangles hardly ever meet behind TERM: words exactly at the ends of SHADE's tables and one LSB off, normals of every
//! length, textures that begin anew, materials in turn, culled triangles between, reference pixels on every side.

use super::pen::{Pen, case};
use super::words::ends;
use super::{Case, Triangle};
use edgewalk_machine::{Plan, Record, Term};

/// Triangles with the record of each.
type Shaded = Vec<(Triangle, Record)>;

/// The cases, and the records of their triangles in order.
pub(super) fn cases(machine: &Plan) -> (Vec<Case>, Vec<Record>) {
    let brush = Brush { machine, pen: Pen::new(machine) };
    let cases = [
        ("words_at_the_ends_of_the_tables", brush.at_the_ends()),
        ("slopes_through_the_ends", brush.slopes()),
        ("seventeen_culled_between", brush.culled_between()),
        ("materials_in_turn", brush.materials()),
        ("reference_pixels_on_every_side", brush.references()),
    ];
    let mut records = Vec::new();
    let cases = cases.map(|(name, shaded)| {
        let (triangles, own): (Vec<_>, Vec<_>) = shaded.into_iter().unzip();
        records.extend(own);
        case(name, triangles)
    });
    (cases.into(), records)
}

struct Brush<'a> {
    machine: &'a Plan,
    pen: Pen<'a>,
}

impl Brush<'_> {
    /// A record with these words.
    fn record(&self, material: u32, terms: impl Fn(usize, &Term) -> [i128; 6]) -> Record {
        let all = self.machine.terms().iter().enumerate();
        let terms = all.map(|(i, term)| terms(i, term).map(|word| word as u64)).collect();
        let last = (1u32 << self.machine.shade.material_bits) - 1;
        let gloss = self.machine.shade.gloss_bits;
        Record { x: 2, y: 1, material: material.min(last), gloss, terms }
    }

    /// One pixel.
    fn dot(&self, z: f64) -> Triangle {
        self.pen.dot(2.0, 1.0, z)
    }

    /// Words at which something changes, one less and one more, and the lowest and highest there are.
    fn levels(&self, term: &Term) -> Vec<i128> {
        let beside = |end: i128| [-1, 0, 1].map(|off| (end << term.fraction) + off);
        let half = 1i128 << (term.word() - 1);
        ends(self.machine, term).into_iter().flat_map(beside).chain([-half, half - 1]).collect()
    }

    /// Every level of a light's first term with every level of its second.
    fn at_the_ends(&self) -> Shaded {
        let level = |n: usize, i: usize, term: &Term| {
            let levels = self.levels(term);
            let turn = if i.is_multiple_of(2) { n } else { n / levels.len() };
            levels[(turn + i / 2 * 3) % levels.len()]
        };
        let count = self.machine.terms().first().map_or(0, |term| self.levels(term).len().pow(2));
        (0..count)
            .map(|n| {
                let record = self.record(0, |i, term| [level(n, i, term), 0, 0, 0, 0, 0]);
                (self.dot(1.0 - n as f64 / count as f64), record)
            })
            .collect()
    }

    /// From below the lowest end to above the highest over the triangle, to the right and to the left, straight and bent.
    fn slopes(&self) -> Shaded {
        let (w, h) = self.pen.size();
        let (w, h) = (w.min(20.0), h.min(20.0));
        let across = [[(0.0, 0.0), (w, 0.0), (0.0, h)], [(w, 0.0), (w, h), (0.0, h)]];
        let shaded = across.into_iter().enumerate().flat_map(|(i, at)| {
            [0, 1, 2, 3].map(|kind: i128| {
                let record = self.record(0, |place, term| {
                    let ends = ends(self.machine, term);
                    let (low, range) = (ends[0] << term.fraction, (ends[1] - ends[0]) << term.fraction);
                    let (begin, slope) = (low - range / 8, range / 12 * if place % 2 == 0 { 1 } else { -1 });
                    let bend = if kind % 2 == 0 { 0 } else { range / 128 };
                    // The second half begins at the other end.
                    let v = if slope > 0 { begin } else { begin + range * 5 / 4 };
                    [v, slope, slope / 3, bend, -bend, bend / 2 * (kind - 1)]
                });
                let z = 0.9 - 0.1 * (4 * i as i128 + kind) as f64;
                (self.pen.level(at, z), Record { x: w as i32 / 2, y: 0, ..record })
            })
        });
        shaded.collect()
    }

    /// Triangles without area, each with a record that must not be used, between two that are drawn.
    fn culled_between(&self) -> Shaded {
        let flat = self.pen.level([(1.0, 1.0), (3.0, 3.0), (5.0, 5.0)], 0.0);
        (0..19)
            .map(|k: i128| {
                let record = self.record(0, |_, term| [k << term.fraction << 2; 6]);
                (if k % 18 == 0 { self.dot(0.0) } else { flat }, record)
            })
            .collect()
    }

    /// One pixel of another material after the other.
    fn materials(&self) -> Shaded {
        let inside = |term: &Term| (ends(self.machine, term)[1] << term.fraction) / 3;
        [0, 1, 1, u32::MAX, 0, u32::MAX, 1, 0]
            .map(|material| (self.dot(0.0), self.record(material, |_, term| [inside(term), 0, 0, 0, 0, 0])))
            .into()
    }

    /// Reference pixels on and off the screen, for triangles to both sides; between some lines of a sliver there is nothing to draw.
    fn references(&self) -> Shaded {
        let (w, h) = self.pen.size();
        let (w, h) = (w.min(12.0), h.min(12.0));
        let right = [(1.0, 0.0), (w, h / 2.0), (1.0, h)];
        let left = [(w, 0.0), (1.0, h / 2.0), (w, h)];
        let sliver = [(1.0, 0.0), (w, h - 1.0), (w, h)];
        let mut shaded = Shaded::new();
        for (i, x) in [-5, 0, 4, w as i32, self.machine.width as i32 + 3].into_iter().enumerate() {
            for (j, at) in [right, left, sliver].into_iter().enumerate() {
                let record = self.record(0, |place, term| {
                    let one = 1i128 << term.fraction;
                    let of = |k: i128| (k * 37 % 101 - 50) * one / 16;
                    let k = (i * 7 + j * 3 + place) as i128;
                    [
                        of(k) + (ends(self.machine, term)[1] * one) / 2,
                        of(k + 1),
                        of(k + 2),
                        of(k + 3),
                        of(k + 4),
                        of(k + 5),
                    ]
                });
                let z = 0.5 - 0.02 * (3 * i + j) as f64;
                shaded.push((self.pen.level(at, z), Record { x, y: 0, ..record }));
            }
        }
        shaded
    }
}
