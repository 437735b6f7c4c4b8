//! A unit by the ports that it declares, alone or inside the machine.
//!
//! ```text
//!  inputs of a cycle, Pins ─> Ported::show ─> outputs of the same cycle, Shown
//!                        └──> Ported::clock, the clock edge
//! ```
//! Links and memories are those of the unit's declaration in crate `machine`; only a status is told by name. A unit shows
//! itself by the same code whether it runs alone or stands in the machine.

use crate::tokens::{Sourced, Words};
use crate::word_memory::{Ask, WordIn};
use edgewalk_machine::{DrawState, Events};

/// Inputs of a unit in a cycle.
#[derive(Clone, Copy, Debug)]
pub struct Pins<'a, T, const C: usize> {
    /// The token offered on the link that the unit takes.
    pub token: Option<&'a T>,
    /// A token on the link that the unit gives is taken.
    pub next: bool,
    /// A token on the link by which the unit writes beside that is taken.
    pub write: bool,
    /// The memory that the unit reads.
    pub word: WordIn,
    /// Values that another unit holds beside the token.
    pub held: Held<C>,
    /// The constants.
    pub state: DrawState,
    /// The level `fresh_queued`.
    pub fresh_queued: bool,
}

/// Values that EDGE holds beside its lines, from one triangle to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held<const C: usize> {
    /// The increments a pixel.
    pub gradient: Words<C>,
    /// k_t of the triangle.
    pub kt: u32,
    /// Number of the triangle's record.
    pub record: u32,
}

impl<const C: usize> Default for Held<C> {
    fn default() -> Self {
        Held { gradient: [0; C], kt: 0, record: 0 }
    }
}

impl<T, const C: usize> Default for Pins<'_, T, C> {
    fn default() -> Self {
        Pins {
            token: None,
            next: false,
            write: false,
            word: WordIn::NONE,
            held: Held::default(),
            state: DrawState::default(),
            fresh_queued: false,
        }
    }
}

/// Where a unit shows its outputs.
pub trait Shown {
    /// The ready of the link that it takes.
    fn takes(&mut self, ready: bool);
    /// The token on the link that it gives.
    fn gives<T: Sourced>(&mut self, token: Option<&T>);
    /// The token on the link by which it writes beside that.
    fn writes<T: Sourced>(&mut self, token: Option<&T>);
    /// What it asks of its memory.
    fn asks(&mut self, ask: Ask);
    /// What it holds beside the token it gives.
    fn holds<const C: usize>(&mut self, held: &Held<C>);
    /// A status port.
    fn status(&mut self, name: &str, value: bool);
}

/// A unit that shows itself by its ports.
pub trait Ported<const C: usize>: Send {
    /// The token that it takes.
    type Takes: Send;

    /// Shows all outputs in a cycle with these inputs.
    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown);

    /// The clock edge of that cycle.
    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events);

    /// Synchronous reset.
    fn clear(&mut self);
}
