//! The fragments between PIXEL and SHADE in a cycle, and who can take them.
//!
//! ```text
//!  PIXEL ─drawn─> [TEXEL] ─textured─> [BUMP] ─bumped─> [NORMAL or LAMP] ─normed─> SHADE ─> tinted
//! ```
//! Of a unit that the machine has not, what it would give is what it would take.

use super::{TexelInputs, Units};
use crate::shade::Cosines;
use crate::tokens::Fragment;

/// A fragment with its terms or cosines.
type Beside<const C: usize> = (Fragment<C>, Cosines);

/// The fragments that are offered in a cycle; none in a machine without SHADE.
#[derive(Clone, Copy, Debug)]
pub struct Offered<const C: usize> {
    /// By PIXEL.
    pub drawn: Option<Beside<C>>,
    /// To BUMP.
    pub textured: Option<Beside<C>>,
    /// To NORMAL or LAMP.
    pub bumped: Option<Beside<C>>,
    /// To SHADE.
    pub normed: Option<Beside<C>>,
}

/// Whether they can be taken.
#[derive(Clone, Copy, Debug)]
pub struct Readies {
    /// Of PIXEL's.
    pub drawn: bool,
    /// Of BUMP's.
    pub textured: bool,
    /// Of NORMAL's.
    pub bumped: bool,
    /// Of SHADE's.
    pub normed: bool,
}

/// A fragment and what is beside it.
#[inline(always)]
pub fn parts<const C: usize>(offered: &Option<Beside<C>>) -> (Option<&Fragment<C>>, &Cosines) {
    offered.as_ref().map_or((None, &Cosines::NONE), |(fragment, cosines)| (Some(fragment), cosines))
}

impl<const C: usize> Units<'_, C> {
    /// What is offered between PIXEL and SHADE.
    #[inline(always)]
    #[must_use]
    pub fn offered(&self, texel: &TexelInputs) -> Offered<C> {
        if self.shade.is_none() {
            return Offered { drawn: None, textured: None, bumped: None, normed: None };
        }
        let drawn = self.pixel.frag().map(|fragment| (*fragment, *self.pixel.cosines()));
        let textured = self.texel.map_or(drawn, |unit| unit.textured(texel));
        let bumped = self.bump.map_or(textured, |unit| unit.bumped().copied());
        let normed = self.normal.map_or(bumped, |unit| unit.normed().copied());
        let normed = self.lamp.map_or(normed, |unit| unit.normed().copied());
        Offered { drawn, textured, bumped, normed }
    }

    /// What can be taken, if what SHADE gives is taken or not; in a machine without SHADE: what PIXEL gives.
    #[inline(always)]
    #[must_use]
    pub fn readies(&self, offered: &Offered<C>, texel: &TexelInputs, tinted_ready: bool) -> Readies {
        let cosines = parts(&offered.normed).1;
        let normed = self.shade.map_or(tinted_ready, |unit| unit.frag_ready(cosines, tinted_ready));
        let bumped = self.normal.map_or(normed, |unit| unit.frag_ready(normed));
        let bumped = self.lamp.map_or(bumped, |unit| unit.frag_ready(normed));
        let textured = self.bump.map_or(bumped, |unit| unit.frag_ready(bumped));
        let drawn = self.texel.map_or(textured, |unit| unit.frag_ready(texel));
        Readies { drawn, textured, bumped, normed }
    }

    /// A fragment waits for tables, or for roots, or for LAMP.
    #[inline(always)]
    pub(super) fn tables_wait(&self, offered: &Offered<C>) -> bool {
        let (frag, cosines) = parts(&offered.normed);
        self.shade.is_some_and(|unit| unit.waits(frag, cosines))
            || self.normal.is_some_and(|unit| unit.waits(parts(&offered.bumped).0))
            || self.lamp.is_some_and(|unit| unit.waits(parts(&offered.bumped).0) || unit.working())
    }

    /// TEXEL waits for its memory.
    #[inline(always)]
    pub(super) fn texel_waits(&self, offered: &Offered<C>) -> bool {
        self.texel.is_some_and(|unit| !unit.full() || offered.textured.is_none())
    }
}
