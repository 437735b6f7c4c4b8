//! A fragment on its way from PIXEL to DEPTH, and what the shading units need beside it.

use crate::named::{Named, Number, Place, named};
use crate::tokens::{Fragment, Source, Sourced};
use edgewalk_machine::Plan;

/// Most terms of a machine.
pub const MAX_TERMS: usize = 18;

/// Values beside a fragment: PIXEL gives the outputs of the terms, BUMP, NORMAL and LAMP put cosines in their place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cosines {
    /// One value a term, signed, in LSB of its output; 0 behind the last.
    pub terms: [i32; MAX_TERMS],
    /// Number of the material.
    pub material: u32,
    /// Exponent of the material's highlights, for NORMAL and LAMP.
    pub gloss: u32,
    /// From LAMP: the share of the light that arrives, 2^16 for all of it.
    pub beam: u32,
    /// From TEXEL to BUMP: slopes of the relief along u and v, 2^(ξ-1) for the largest.
    pub slopes: [i32; 2],
}

named! {
    [] Cosines, |_| Cosines::NONE,
    {
        terms [nl0([0]), nh0([1]), nl1([2]), nh1([3])] terms [""()];
        material [material()];
        gloss [gloss()];
        beam [beam()];
        slopes [bu([0]), bv([1])];
    }
}

impl Cosines {
    /// Beside a fragment of a machine without shading.
    pub const NONE: Cosines =
        Cosines { terms: [0; MAX_TERMS], material: 0, gloss: 0, beam: 0, slopes: [0; 2] };
}

/// A fragment with its cosines, as a unit holds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lit<const C: usize> {
    /// The fragment.
    pub frag: Fragment<C>,
    /// Terms or cosines of the fragment.
    pub cosines: Cosines,
}

/// A fragment that a unit offers to the next one. It is looked at in its register, and copied only where it is taken.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a, const C: usize> {
    /// The fragment.
    pub frag: &'a Fragment<C>,
    /// Terms or cosines of the fragment; [`Cosines::NONE`] behind SHADE.
    pub cosines: &'a Cosines,
}

impl<const C: usize> Default for Lit<C> {
    fn default() -> Self {
        Lit { frag: Fragment::default(), cosines: Cosines::NONE }
    }
}

impl<const C: usize> Lit<C> {
    /// Offers it.
    #[inline]
    #[must_use]
    pub fn given(&self) -> Given<'_, C> {
        Given { frag: &self.frag, cosines: &self.cosines }
    }
}

impl<'a, const C: usize> Given<'a, C> {
    /// A fragment behind SHADE, or of a machine without it.
    #[inline]
    #[must_use]
    pub fn alone(frag: &'a Fragment<C>) -> Self {
        Given { frag, cosines: &Cosines::NONE }
    }

    /// A copy to be held.
    #[inline]
    #[must_use]
    pub fn lit(&self) -> Lit<C> {
        Lit { frag: *self.frag, cosines: *self.cosines }
    }
}

/// The names of both; the cosines come first.
impl<const C: usize> Named for Lit<C> {
    const NAMES: u16 = Cosines::NAMES + Fragment::<C>::NAMES;

    fn blank(_: &Plan) -> Self {
        Lit::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Place> {
        Cosines::find(plan, name).or_else(|| Some(Fragment::<C>::find(plan, name)?.behind(Cosines::NAMES)))
    }

    fn at(&mut self, place: Place) -> &mut dyn Number {
        match place.in_front(Cosines::NAMES) {
            None => self.cosines.at(place),
            Some(place) => self.frag.at(place),
        }
    }
}

impl<const C: usize> Sourced for Lit<C> {
    fn source(&mut self) -> &mut Source {
        &mut self.frag.source
    }
}
