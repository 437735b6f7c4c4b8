//! The in-flight queue of DEPTH: fragments whose old depth is on its way.
//!
//! Columns instead of records: fields are then read as they were written, one by one. A record written field by field
//! and copied whole in the next cycle would make the host wait until its stores are done.

use crate::Coverage;
use crate::tokens::{Fragment, Rgb, Source};

/// Places; the machine's queue is at most as deep.
const PLACES: usize = 16;

/// The address of a free place: none on any screen (addresses have at most 28 bits).
const NOWHERE: u32 = u32::MAX;

/// Fragments in order, the oldest first.
#[derive(Clone, Debug)]
pub(crate) struct InFlight {
    head: usize,
    len: usize,
    /// Of a fragment, or NOWHERE: so all places can be asked at once.
    addr: [u32; PLACES],
    z: [u32; PLACES],
    rgb: [Rgb; PLACES],
    source: [Source; PLACES],
    /// The old depth comes from an older fragment: `fwd_valid` and `fwd_z`.
    forwarded: [bool; PLACES],
    forward_z: [u32; PLACES],
}

/// A fragment that leaves the queue.
pub(crate) struct InFlightHead {
    pub fragment: Fragment,
    /// Its old depth, if an older fragment wrote it.
    pub forward: Option<u32>,
}

impl Default for InFlight {
    fn default() -> Self {
        InFlight {
            head: 0,
            len: 0,
            addr: [NOWHERE; PLACES],
            z: [0; PLACES],
            rgb: [Rgb::default(); PLACES],
            source: [Source::default(); PLACES],
            forwarded: [false; PLACES],
            forward_z: [0; PLACES],
        }
    }
}

impl InFlight {
    /// Fragments held.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Drops all.
    pub(crate) fn clear(&mut self) {
        self.len = 0;
        self.addr = [NOWHERE; PLACES];
    }

    #[inline]
    fn slot(&self, place: usize) -> usize {
        self.head.wrapping_add(place) & (PLACES - 1)
    }

    /// A fragment of this address is held.
    #[inline]
    pub(crate) fn holds(&self, addr: u32) -> bool {
        self.addr.iter().fold(false, |held, other| held | (*other == addr))
    }

    /// Appends a fragment and its old depth, if that is known; DEPTH lets none in when full.
    #[inline]
    pub(crate) fn push(&mut self, fragment: &Fragment, forward: Option<u32>) {
        let slot = self.slot(self.len);
        self.addr[slot] = fragment.addr;
        self.z[slot] = fragment.z;
        self.rgb[slot] = fragment.rgb;
        self.source[slot] = fragment.source;
        self.forwarded[slot] = forward.is_some();
        self.forward_z[slot] = forward.unwrap_or(0);
        self.len = self.len.wrapping_add(1);
    }

    /// Drops the oldest fragment and gives it.
    #[inline]
    pub(crate) fn pop(&mut self) -> InFlightHead {
        let slot = self.slot(0);
        let fragment = self.fragment(slot);
        let forward = self.forwarded[slot].then_some(self.forward_z[slot]);
        self.addr[slot] = NOWHERE;
        self.head = self.slot(1);
        self.len = self.len.wrapping_sub(1);
        InFlightHead { fragment, forward }
    }

    /// The youngest fragment; a stale one if there is none.
    pub(crate) fn youngest(&self) -> Fragment {
        self.fragment(self.slot(self.len.wrapping_sub(1)))
    }

    #[inline]
    fn fragment(&self, slot: usize) -> Fragment {
        Fragment {
            addr: self.addr[slot],
            z: self.z[slot],
            rgb: self.rgb[slot],
            fence: false, // not kept
            source: self.source[slot],
        }
    }

    /// Every fragment of this address takes `z` for its old depth.
    #[inline]
    pub(crate) fn forward(&mut self, addr: u32, z: u32, coverage: &mut Coverage) {
        if !self.holds(addr) {
            return;
        }
        for slot in 0..PLACES {
            if self.addr[slot] == addr {
                self.forwarded[slot] = true;
                self.forward_z[slot] = z;
                coverage.forward_compare += 1;
            }
        }
    }
}
