//! The checked machine: what units, drawing and tools take.

use crate::channel::{Channel, Precision};
use crate::machine::{Machine, SetupKind};
use crate::shadow::LIGHT_SPACE;
use crate::stamp::PortStamp;
use crate::term::Term;
use crate::widths::Widths;
use std::ops::{Deref, Range};

/// The places of red, green and blue among the channels of every machine.
pub const COLOURS: Range<usize> = 1..4;

/// A machine that can be built. Only [`Machine::plan`] makes one; the keys can be read through it, not
/// changed.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Plan {
    pub(crate) machine: Machine,
    pub(crate) channels: Vec<Channel>,
    pub(crate) terms: Vec<Term>,
    pub(crate) widths: Widths,
    pub(crate) port: PortStamp,
}

/// The keys.
impl Deref for Plan {
    type Target = Machine;

    fn deref(&self) -> &Machine {
        &self.machine
    }
}

impl Plan {
    /// The channels that the units want, in the order of the words: z, r, g, b, the user's own, then kt where
    /// it is one.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// The place of the channel of that name among [`Plan::channels`].
    #[must_use]
    pub fn channel_place(&self, name: &str) -> Option<usize> {
        self.channels.iter().position(|channel| channel.name == name)
    }

    /// The channels whose values are planes, with their places among all: with `polygon.values = bilinear` all but the
    /// colours.
    pub fn planes(&self) -> impl Iterator<Item = (usize, &Channel)> {
        let colours = if self.polygon.is_bilinear() { COLOURS } else { 0..0 };
        self.channels.iter().enumerate().filter(move |(place, _)| !colours.contains(place))
    }

    /// The user's own channels, with their places among all.
    pub fn own_channels(&self) -> impl Iterator<Item = (usize, &Channel)> {
        self.channels.iter().enumerate().skip(4).take(self.extra as usize)
    }

    /// The channels that go beyond SHADOW, with their places: all but those of the light.
    pub fn seen_channels(&self) -> impl Iterator<Item = (usize, &Channel)> {
        self.channels.iter().enumerate().filter(|(_, channel)| !LIGHT_SPACE.contains(&channel.name))
    }

    /// Bits of a word of the light's map: bz, and b below them with `shadow.transmits`.
    #[must_use]
    pub fn map_word_bits(&self) -> u32 {
        let share = if self.shadow.transmits() { self.color.bits } else { 0 };
        self.shadow.depth_bits + share
    }

    /// Colours as the frame memory has them: n bits with DITHER, else b.
    #[must_use]
    pub fn stored_color(&self) -> Precision {
        let bits = if self.dither.rounds() { self.dither.bits } else { self.color.bits };
        Precision { bits, ..self.color }
    }

    /// The step from one stored colour to the next, in LSB of the colours that PIXEL gives: (2^b - 1)/(2^n - 1), and 0 where DITHER
    /// rounds none.
    #[must_use]
    pub fn dither_step(&self) -> f64 {
        if self.dither.rounds() { self.color.max() as f64 / self.stored_color().max() as f64 } else { 0.0 }
    }

    /// The terms that TERM walks and PIXEL steps, in the order of their words.
    #[must_use]
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// The word lengths of this machine.
    #[must_use]
    pub fn widths(&self) -> Widths {
        self.widths
    }

    /// SETUP takes a triangle word by word, and does its work by a program.
    #[must_use]
    pub fn is_sequenced(&self) -> bool {
        self.setup_kind == SetupKind::Sequenced
    }

    /// Words of a triangle at the word port of a sequenced SETUP.
    #[must_use]
    pub fn triangle_words(&self) -> u32 {
        let vertex = 2 + self.channels.len() as u32;
        3 * vertex + u32::from(self.has_triangle_kt())
    }

    /// Clocks a pixel inside a span, T = ceil(N/A).
    #[must_use]
    pub fn clocks_per_pixel(&self) -> u32 {
        (self.channels.len() as u32).div_ceil(self.adders)
    }

    /// The channels of each adder: floor(a·N/A) up to floor((a+1)·N/A). The one at place i of its adder is
    /// added in clock i of a pixel; an adder with fewer than T channels rests in the others.
    #[must_use]
    pub fn slots(&self) -> Vec<Range<usize>> {
        let (channels, adders) = (self.channels.len(), self.adders as usize);
        (0..adders).map(|adder| adder * channels / adders..(adder + 1) * channels / adders).collect()
    }

    /// The same machine with a tag of 32 bits, which changes nothing but the tag ports: a tool then sees the
    /// triangle of each write.
    #[must_use]
    pub fn tagged(&self) -> Plan {
        let mut plan = self.clone();
        plan.machine.tag_bits = 32;
        plan
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_has_one_slot_and_the_busiest_adder_t() {
        let mut checked = 0;
        for extra in 0..=4 {
            for adders in 1..=4 + extra {
                let plan = Machine { adders, extra, ..Machine::default() }.plan().expect("can be built");
                let slots = plan.slots();
                assert_eq!(slots.len(), adders as usize);
                let longest = slots.iter().map(|slot| slot.len() as u32).max();
                assert_eq!(longest, Some(plan.clocks_per_pixel()));
                assert!(slots.iter().all(|slot| !slot.is_empty()));
                let served: Vec<usize> = slots.into_iter().flatten().collect();
                assert_eq!(served, (0..plan.channels().len()).collect::<Vec<_>>());
                checked += 1;
            }
        }
        assert_eq!(checked, 4 + 5 + 6 + 7 + 8);
    }
}
