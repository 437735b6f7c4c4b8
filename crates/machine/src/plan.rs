//! The checked machine: what units, drawing and tools take.

use crate::blend::BlendKind;
use crate::channel::Channel;
use crate::machine::Machine;
use crate::record::{self, Term};
use crate::shadow::LIGHT_SPACE;
use crate::text::MachineError;
use crate::units::UNITS;
use crate::vertex::PortStamp;
use crate::widths::Widths;
use std::ops::{Deref, Range};

/// A machine that can be built. Only [`Machine::plan`] makes one; the keys can be read through it, not changed.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Plan {
    machine: Machine,
    channels: Vec<Channel>,
    terms: Vec<Term>,
    widths: Widths,
    port: PortStamp,
}

impl Machine {
    /// The machine with all that follows from its keys.
    ///
    /// # Errors
    /// The first combination of keys that cannot be built, with the reason and a value that would do.
    pub fn plan(&self) -> Result<Plan, MachineError> {
        // The depth, what the memory stores beside it, and then what only some machines have.
        let depth = (crate::units::depth::SPEC.wants)(self).into_iter();
        let others = UNITS.iter().filter(|unit| unit.name != "depth").flat_map(|unit| (unit.wants)(self));
        let channels: Vec<Channel> = depth.chain(crate::units::memory::wants(self)).chain(others).collect();
        crate::check::check(self, &channels)?;
        let constant = self.blend.kind == BlendKind::Constant;
        let port = PortStamp::of(
            self.guard_bits,
            self.subpixel_bits,
            &channels,
            if constant { self.blend.kt_bits } else { 0 },
        );
        let terms = record::terms(self);
        Ok(Plan { machine: self.clone(), channels, terms, widths: self.widths(), port })
    }
}

/// The keys.
impl Deref for Plan {
    type Target = Machine;

    fn deref(&self) -> &Machine {
        &self.machine
    }
}

impl Default for Plan {
    fn default() -> Self {
        #[allow(clippy::expect_used)]
        Machine::default().plan().expect("a test plans every preset")
    }
}

impl Plan {
    /// The channels that the units want, in the order of the words: z, r, g, b, the user's own, then kt where it is one.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
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

    /// The terms that TERM walks and PIXEL steps, in the order of their words.
    #[must_use]
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// A triangle has one transmission coefficient, that of its first vertex.
    #[must_use]
    pub fn has_triangle_kt(&self) -> bool {
        self.blend.kind == BlendKind::Constant
    }

    /// The word lengths of this machine.
    #[must_use]
    pub fn widths(&self) -> Widths {
        self.widths
    }

    /// Clocks a pixel inside a span, T = ceil(N/A).
    #[must_use]
    pub fn clocks_per_pixel(&self) -> u32 {
        (self.channels.len() as u32).div_ceil(self.adders)
    }

    /// The channels of each adder: floor(a·N/A) up to floor((a+1)·N/A). The one at place i of its adder is added in
    /// clock i of a pixel; an adder with fewer than T channels rests in the others.
    #[must_use]
    pub fn slots(&self) -> Vec<Range<usize>> {
        let (channels, adders) = (self.channels.len(), self.adders as usize);
        (0..adders).map(|adder| adder * channels / adders..(adder + 1) * channels / adders).collect()
    }

    /// What the vertices made for this machine carry.
    pub(crate) fn port_stamp(&self) -> PortStamp {
        self.port
    }

    /// The same machine with a tag of 32 bits, which changes nothing but the tag ports: a tool then sees the triangle of
    /// each write.
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
    use crate::presets::PRESETS;

    #[test]
    fn every_preset_can_be_planned() {
        for (name, _) in PRESETS {
            let machine = Machine::preset(name).expect("listed");
            assert!(machine.plan().is_ok(), "{name}");
        }
        assert_eq!(PRESETS.len(), 4);
    }

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
