//! Clocks of SETUP's two phases, whichever kind it is.

/// Clocks of a triangle in SETUP.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SetupClocks {
    /// S1: edges, area, cull; of a sequenced SETUP S, all of it.
    pub phase1: u32,
    /// S2: the channels; 0 of a triangle that is culled, and of a sequenced SETUP.
    pub phase2: u32,
}

impl SetupClocks {
    /// Of both phases.
    #[must_use]
    pub fn all(self) -> u32 {
        self.phase1 + self.phase2
    }
}
