//! Tables of entries that stand for a rising function of an index, read at the floor of it: what they hold,
//! and how far that is from the function.
//!
//! ```text
//!   index   0     1     2            2^t           bin j is [j, j+1), the first one all below, the last one all above
//!           |--j--|-----|----- .. ----|             entry j = RN((f(j) + f(j+1)) / 2)
//! ```
//! An index that errs by no more than E comes from [j - E, j + 1 + E]: f there is what an entry may be wrong
//! by (bound 13, `docs/numerics.md`).

/// A function of the index that never falls.
pub trait Rising {
    /// The value, LSB of the entries.
    fn at(&self, index: f64) -> f64;
    /// The values that all indices lie between, LSB.
    fn ends(&self) -> [f64; 2];
}

/// A table of 2^t entries and the function behind it.
#[derive(Clone, Debug)]
pub struct IndexTable<F> {
    entries: Vec<u32>,
    /// The function at 0 to 2^t, LSB.
    borders: Vec<f64>,
    function: F,
}

impl<F: Rising> IndexTable<F> {
    /// Of 2^`bits` entries.
    #[must_use]
    pub fn new(bits: u32, function: F) -> Self {
        let count = 1u32 << bits;
        let [least, most] = function.ends();
        let borders: Vec<f64> = (0..=count).map(|index| function.at(index.into())).collect();
        let entry = |index: u32| {
            let low = if index == 0 { least } else { borders[index as usize] };
            let high = if index == count - 1 { most } else { borders[index as usize + 1] };
            // Of a function in 0 to 2^32 it is such a number too.
            ((low + high) / 2.0 + 0.5).floor() as u32
        };
        Self { entries: (0..count).map(entry).collect(), borders, function }
    }

    /// Like `new`, with the function's least value for the first entry, whatever its bin.
    #[must_use]
    pub fn from_least(bits: u32, function: F) -> Self {
        let mut table = Self::new(bits, function);
        table.entries[0] = (table.function.ends()[0] + 0.5).floor() as u32;
        table
    }

    /// The entries, by index.
    #[must_use]
    pub fn entries(&self) -> &[u32] {
        &self.entries
    }

    /// The function.
    #[must_use]
    pub fn function(&self) -> &F {
        &self.function
    }

    /// Bound 13: the most that an entry read differs from the function, LSB, where the index errs by no more
    /// than `index_error`.
    #[must_use]
    pub fn error(&self, index_error: f64) -> f64 {
        let last = self.entries.len() - 1;
        let [least, most] = self.function.ends();
        // The function is computed only where the borders around let an entry be worse than those before.
        let reach = index_error.ceil() as usize;
        let mut worst = 0.0;
        for (index, entry) in self.entries.iter().enumerate().rev() {
            let entry = f64::from(*entry);
            let below = index.checked_sub(reach).map_or(least, |border| self.borders[border]);
            let above = self.borders.get((index + 1).saturating_add(reach)).map_or(most, |border| *border);
            let [below, above] =
                [if index == 0 { least } else { below }, if index == last { most } else { above }];
            if (entry - below).max(above - entry) <= worst {
                continue;
            }
            let place = index as f64;
            let low = if index == 0 { least } else { self.function.at(place - index_error) };
            let high = if index == last { most } else { self.function.at(place + 1.0 + index_error) };
            worst = (entry - low).max(high - entry).max(worst);
        }
        worst
    }
}

/// Light by the cosine N·L: `base + slope·cosine`, at most `most`; the index is 2^bits times the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// t.
    pub bits: u32,
    /// Without the light, LSB.
    pub base: f64,
    /// What the light adds where it is overhead, LSB.
    pub slope: f64,
    /// The largest entry, LSB.
    pub most: f64,
}

impl Rising for Diffuse {
    fn at(&self, index: f64) -> f64 {
        let cosine = (index / f64::from(1u32 << self.bits)).clamp(0.0, 1.0);
        (self.base + self.slope * cosine).min(self.most)
    }

    fn ends(&self) -> [f64; 2] {
        [self.base.min(self.most), (self.base + self.slope).min(self.most)]
    }
}

/// A highlight by the cosine N·H: `top` times a power; the table's 2^bits entries cover the last 2^-gloss of
/// the way to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Highlight {
    /// t.
    pub bits: u32,
    /// m': index = 2^t - (1 - N·H)·2^(m' + t).
    pub gloss: u32,
    /// Of N·H, or of 2(N·H)² - 1 if `doubled`.
    pub exponent: f64,
    /// The power is of the cosine of twice the angle.
    pub doubled: bool,
    /// In the middle of the highlight, LSB.
    pub top: f64,
    /// The largest entry, LSB.
    pub most: f64,
}

impl Highlight {
    /// The table with the least bound among those with a `gloss` of at most `most`, the first of equal ones.
    #[must_use]
    pub fn sharpest(self, most: u32) -> IndexTable<Self> {
        let table = |gloss| IndexTable::new(self.bits, Self { gloss, ..self });
        let judged = |gloss| {
            let table = table(gloss);
            (table.error(0.0), table)
        };
        let better = |best: (f64, _), next: (f64, _)| if next.0 < best.0 { next } else { best };
        (1..=most).map(judged).fold(judged(0), better).1
    }

    /// What the power gives for N·H, LSB.
    fn of_cosine(&self, halfway: f64) -> f64 {
        let halfway = halfway.clamp(0.0, 1.0);
        let cosine = if self.doubled { 2.0 * halfway * halfway - 1.0 } else { halfway };
        (self.top * cosine.max(0.0).powf(self.exponent)).min(self.most)
    }
}

impl Rising for Highlight {
    fn at(&self, index: f64) -> f64 {
        let [entries, way] = [self.bits, self.bits + self.gloss].map(|bits| f64::from(1u32 << bits));
        self.of_cosine(1.0 - (entries - index) / way)
    }

    fn ends(&self) -> [f64; 2] {
        [self.of_cosine(0.0), self.of_cosine(1.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a table as SHADE does.
    fn read(entries: &[u32], index: f64) -> f64 {
        f64::from(entries[(index.floor().max(0.0) as usize).min(entries.len() - 1)])
    }

    #[test]
    fn entries_are_within_the_bound_and_reach_it() {
        let (mut checked, mut tables) = (0, 0);
        for (exponent, doubled) in
            [(1.0, false), (10.0, false), (50.0, true), (100.0, false), (200.0, true), (2.5, true)]
        {
            for bits in [8, 9, 10] {
                let plain = Highlight { bits, gloss: 0, exponent, doubled, top: 255.0, most: 255.0 };
                let table = plain.sharpest(8);
                let function = *table.function();
                for error in [0.0, 0.3, 1.75] {
                    let bound = table.error(error);
                    let mut worst = 0f64;
                    for k in -4000..=9000 {
                        // Every index, and the other one that it may have been.
                        let index = f64::from(k) * f64::from(1u32 << bits) / 4096.0;
                        for read_at in [index - error, index, index + error] {
                            worst = worst.max((read(table.entries(), read_at) - function.at(index)).abs());
                            checked += 1;
                        }
                    }
                    assert!(
                        worst <= bound && worst > 0.85 * bound,
                        "{exponent} {doubled} {bits} {error}: {worst} of {bound}"
                    );
                }
                tables += 1;
            }
        }
        println!("{tables} tables, {checked} reads");
        assert!(tables == 18 && checked > 500_000);
    }

    /// The bound of all entries, each of them computed.
    fn of_all<F: Rising>(table: &IndexTable<F>, error: f64) -> f64 {
        let last = table.entries.len() - 1;
        let [least, most] = table.function.ends();
        let off = |(index, entry): (usize, &u32)| {
            let low = if index == 0 { least } else { table.function.at(index as f64 - error) };
            let high = if index == last { most } else { table.function.at(index as f64 + 1.0 + error) };
            (f64::from(*entry) - low).max(high - f64::from(*entry))
        };
        table.entries.iter().enumerate().map(off).fold(0.0, f64::max)
    }

    #[test]
    fn no_entry_errs_more_than_the_bound() {
        let mut checked = 0;
        for error in [0.0, 0.25, 0.999, 1.0, 1.5, 7.3, 600.0, 1e300] {
            for bits in [1, 4, 8, 10] {
                for (exponent, gloss, doubled) in
                    [(1.0, 0, false), (7.5, 1, true), (60.0, 3, false), (500.0, 0, true)]
                {
                    let light = Highlight { bits, gloss, exponent, doubled, top: 300.0, most: 255.0 };
                    let table = IndexTable::new(bits, light);
                    assert_eq!(table.error(error), of_all(&table, error), "{light:?} {error}");
                    checked += 1;
                }
                let light = Diffuse { bits, base: 20.0, slope: 260.0, most: 255.0 };
                for table in [IndexTable::new(bits, light), IndexTable::from_least(bits, light)] {
                    assert_eq!(table.error(error), of_all(&table, error), "{light:?} {error}");
                    checked += 1;
                }
            }
        }
        assert_eq!(checked, 8 * 4 * 6);
    }

    /// Bound without the rounding of the entries: half of the steepest bin.
    #[test]
    fn a_scaled_index_errs_the_same_for_every_exponent() {
        for (bits, flat) in [(8, 3.13), (9, 1.57), (10, 0.79)] {
            for exponent in [50.0, 100.0, 200.0] {
                let plain = Highlight { bits, gloss: 0, exponent, doubled: false, top: 255.0, most: 255.0 };
                let (scaled, unscaled) =
                    (plain.sharpest(8).error(0.0), IndexTable::new(bits, plain).error(0.0));
                assert!(scaled < flat + 0.5 + 1e-9, "{bits} {exponent}: {scaled}");
                assert!(unscaled > 4.0 * (scaled - 0.5), "{bits} {exponent}: {unscaled} {scaled}");
            }
        }
        let gentle = Highlight { bits: 9, gloss: 0, exponent: 1.0, doubled: false, top: 255.0, most: 255.0 };
        assert_eq!(gentle.sharpest(8).function().gloss, 0, "a wide highlight has no low cut");
    }

    #[test]
    fn the_first_and_the_last_entry_stand_for_all_beyond() {
        let light = Highlight { bits: 4, gloss: 3, exponent: 20.0, doubled: false, top: 300.0, most: 255.0 };
        let table = IndexTable::new(4, light);
        let middle = |low: f64, high: f64| ((low + high) / 2.0).round() as u32;
        assert_eq!(table.entries()[0], middle(0.0, light.at(1.0)));
        assert_ne!(table.entries()[0], middle(light.at(0.0), light.at(1.0)), "the first bin begins at 0");
        assert_eq!(table.entries()[1], middle(light.at(1.0), light.at(2.0)));
        let dim = Diffuse { bits: 4, base: 0.0, slope: 100.0, most: 255.0 };
        assert_eq!(IndexTable::new(4, dim).entries()[15], middle(dim.at(15.0), 100.0));
    }

    #[test]
    fn ambient_light_alone_is_exact_and_too_much_is_cut() {
        let light = Diffuse { bits: 9, base: 25.5, slope: 204.0, most: 255.0 };
        let table = IndexTable::from_least(9, light);
        assert_eq!(table.entries()[0], 26, "RN of the ambient light, no half bin");
        assert_eq!(table.entries()[511], 229, "RN(25.5 + 204·511.5/512)");
        let half = 204.0 / 512.0 / 2.0;
        let first = table.error(0.0);
        assert!(first <= 2.0 * half + 0.5 && table.error(0.5) <= 3.0 * half + 0.5 && first > half);
        let bright = IndexTable::from_least(9, Diffuse { slope: 1000.0, ..light });
        assert_eq!(bright.entries()[511], 255);
        assert!(bright.error(0.0) <= 1000.0 / 512.0 + 0.5);
    }
}
