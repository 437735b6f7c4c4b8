//! Values that may differ from the right run.

use std::collections::BTreeMap;

/// A value that may differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Thing {
    A,
    /// A, but only its bits below P: its sign is the right one.
    Below,
    W,
    /// W, but not its low bits that stand for a row of A.
    High,
    /// The sign of A that control sees.
    Sign,
    RowA(u8),
    RowBelow(u8),
    RowW(u8),
    RowHigh(u8),
    F,
    G,
    Left,
    Skips,
    Order,
    Right,
    Upper,
    Lower,
    Number,
    Scale,
    Count,
    Unfit,
    Link,
    /// The result of this number, of this edge or round.
    Prim(u8, u8),
}

/// What may differ, and in how many words it will not any more: for a new value comes some clocks behind its word.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Differing(pub BTreeMap<Thing, Option<u8>>);

impl Differing {
    pub fn has(&self, thing: Thing) -> bool {
        self.0.contains_key(&thing)
    }

    pub fn any(&self, things: &[Thing]) -> bool {
        things.iter().any(|thing| self.has(*thing))
    }

    pub fn add(&mut self, things: impl IntoIterator<Item = Thing>) {
        self.0.extend(things.into_iter().map(|thing| (thing, None)));
    }

    /// It is the right one again, so many words from here.
    pub fn mend(&mut self, thing: Thing, words: u8) {
        if words == 0 {
            self.0.remove(&thing);
        } else if let Some(left) = self.0.get_mut(&thing) {
            *left = Some(left.unwrap_or(words).min(words));
        }
    }

    pub fn set(&mut self, thing: Thing, differs: bool) {
        if differs { self.add([thing]) } else { self.mend(thing, 0) }
    }

    /// Takes over what differs there; true: that is more.
    pub fn join(&mut self, other: &Differing) -> bool {
        let before = self.clone();
        for (thing, words) in &other.0 {
            let known = self.0.entry(*thing).or_insert(*words);
            *known = known.zip(*words).map(|(a, b)| a.max(b));
        }
        *self != before
    }

    pub fn word_is_over(&mut self) {
        self.0.retain(|_, left| *left != Some(1));
        for left in self.0.values_mut().flatten() {
            *left -= 1;
        }
    }
}
