//! What was recorded: the changes of every register.

use edgewalk_model::View;

/// One register over the cycles: where it changes, and to what. The first change is in the first cycle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// Cycles, ascending, counted from the first that is recorded.
    pub at: Vec<u32>,
    /// Values from there on, modulo 2^bits.
    pub value: Vec<u64>,
}

impl Column {
    /// The value in a cycle of the recording.
    #[must_use]
    pub fn in_cycle(&self, cycle: u32) -> u64 {
        let place = self.at.partition_point(|at| *at <= cycle);
        place.checked_sub(1).map_or(0, |place| self.value[place])
    }
}

/// A field of every pixel, row by row, in the narrowest type that holds it: a screen may have 2^26 pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Words of at most 8 bits.
    Bytes(Vec<u8>),
    /// Words of at most 16 bits.
    Halves(Vec<u16>),
    /// Longer words.
    Words(Vec<u32>),
}

impl Plane {
    /// Words of so many bits.
    #[must_use]
    pub fn new(bits: u32, words: impl Iterator<Item = u32>) -> Plane {
        match bits {
            0..=8 => Plane::Bytes(words.map(|word| word as u8).collect()),
            9..=16 => Plane::Halves(words.map(|word| word as u16).collect()),
            _ => Plane::Words(words.collect()),
        }
    }

    /// All words.
    pub fn words(&self) -> Box<dyn Iterator<Item = u32> + '_> {
        match self {
            Plane::Bytes(words) => Box::new(words.iter().map(|word| u32::from(*word))),
            Plane::Halves(words) => Box::new(words.iter().map(|word| u32::from(*word))),
            Plane::Words(words) => Box::new(words.iter().copied()),
        }
    }
}

/// Takes a machine down, cycle after cycle.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    view: View,
    columns: Vec<Column>,
    cycles: u32,
}

impl Recorder {
    /// Nothing recorded yet.
    #[must_use]
    pub fn new() -> Recorder {
        Recorder::default()
    }

    /// Keeps a cycle; `show` shows the machine as it stands in it.
    pub fn cycle(&mut self, show: impl FnOnce(&mut View)) {
        show(&mut self.view);
        self.columns.resize_with(self.view.values().len(), Column::default);
        for (column, value) in self.columns.iter_mut().zip(self.view.values()) {
            if column.value.last() != Some(value) {
                column.at.push(self.cycles);
                column.value.push(*value);
            }
        }
        self.cycles += 1; // as long as the limit allows
    }

    /// Cycles kept so far.
    #[must_use]
    pub fn cycles(&self) -> u32 {
        self.cycles
    }

    /// The recording; `from` is the machine's cycle that was the first, `before` what its memory held then, plane by
    /// plane and row by row.
    #[must_use]
    pub fn finish(self, from: u64, before: Vec<Plane>) -> Recording {
        Recording { view: self.view, columns: self.columns, cycles: self.cycles, from, before }
    }
}

/// A run of the machine, or a part of one.
#[derive(Clone, Debug)]
pub struct Recording {
    /// What there is to be seen, and the tokens.
    pub view: View,
    /// By register.
    pub columns: Vec<Column>,
    /// Cycles recorded.
    pub cycles: u32,
    /// The machine's cycle that is the first.
    pub from: u64,
    /// What memory held before it: by channel and pixel, row by row; then, where the machine draws it, the map.
    pub before: Vec<Plane>,
}

impl Recording {
    /// The cycles in which the token of a link moves.
    ///
    /// # Errors
    /// No link has this name.
    pub(crate) fn fires(&self, name: &str) -> Result<Vec<u32>, String> {
        let link = self.view.structure().links.iter().find(|link| link.name == name);
        let link = link.ok_or_else(|| format!("there is no link {name}"))?;
        let [valid, ready] = [link.valid, link.ready].map(|id| &self.columns[id]);
        let all = 0..self.cycles;
        Ok(all.filter(|cycle| valid.in_cycle(*cycle) & ready.in_cycle(*cycle) == 1).collect())
    }
}
