//! DITHER: its keys, and the bits of a colour that it leaves.

use crate::key::Domain::OneOf;
use crate::key::{Domain, Key, number, word};
use crate::machine::Machine;

/// Whether DITHER drops fragments by a pattern, as many as k_t says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScreenDoor {
    /// No fragment is dropped.
    No,
    /// A fragment is dropped where the pattern's number is below the triangle's k_t.
    Yes,
}

/// DITHER.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dither {
    /// Bits n of a colour in the frame memory; 0: all b of them.
    pub bits: u32,
    /// The machine drops fragments.
    pub screen_door: ScreenDoor,
}

impl Default for Dither {
    /// No DITHER.
    fn default() -> Self {
        Dither { bits: 0, screen_door: ScreenDoor::No }
    }
}

impl Dither {
    /// The unit is there.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.rounds() || self.drops()
    }

    /// The machine rounds colours to fewer bits.
    #[must_use]
    pub fn rounds(&self) -> bool {
        self.bits > 0
    }

    /// The machine drops fragments.
    #[must_use]
    pub fn drops(&self) -> bool {
        self.screen_door == ScreenDoor::Yes
    }
}

/// The keys of DITHER.
pub const KEYS: &[Key] = &[
    Key {
        absent: Some(0),
        ..number!(
            "dither.bits",
            OneOf(&[0, 4, 5, 6, 7]),
            "bits of a colour in the frame memory, rounded by an ordered 4x4 pattern; 0: all of them",
            dither.bits
        )
    },
    Key {
        absent: Some(ScreenDoor::No as u32),
        ..word!(
            "dither.screen_door",
            ScreenDoor { "no" => No, "yes" => Yes },
            "a fragment is dropped where the pattern is below the triangle's k_t: no or yes",
            dither.screen_door
        )
    },
];

/// A triangle has a k_t for DITHER to drop fragments by.
pub(crate) fn drops(machine: &Machine) -> bool {
    machine.dither.drops()
}
