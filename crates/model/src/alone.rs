//! A unit by itself, found by its name.

use crate::blend::Blend;
use crate::bump::Bump;
use crate::depth::Depth;
use crate::dither::Dither;
use crate::edge::Edge;
use crate::lamp::Lamp;
use crate::normal::Normal;
use crate::pixel::Pixel;
use crate::ports::Ported;
use crate::project::Project;
use crate::shade::Shade;
use crate::shadow::Shadow;
use crate::span::Span;
use crate::term::Term;
use crate::texel::Texel;
use crate::tokens::Sourced;
use edgewalk_machine::Plan;

/// A visitor of a unit of any type.
pub trait Visit<const C: usize> {
    /// What is made of it.
    type Out;

    /// Sees the unit.
    fn visit<U: Ported<C, Takes: Sourced> + 'static>(self, unit: U) -> Self::Out;
}

/// The unit of that name after reset. None is called so, or it is SETUP, which takes triangles.
pub fn alone<const C: usize, V: Visit<C>>(plan: &Plan, name: &str, visit: V) -> Option<V::Out> {
    Some(match name {
        "edge" => visit.visit(Edge::<C>::new(plan)),
        "span" => visit.visit(Span::<C>::new(plan)),
        "term" => visit.visit(Term::new(plan)),
        "pixel" => visit.visit(Pixel::<C>::new(plan)),
        "texel" => visit.visit(Texel::<C>::new(plan)),
        "bump" => visit.visit(Bump::<C>::new(plan)),
        "normal" => visit.visit(Normal::<C>::new(plan)),
        "lamp" => visit.visit(Lamp::<C>::new(plan)),
        "shade" => visit.visit(Shade::<C>::new(plan)),
        "project" => visit.visit(Project::<C>::new(plan)),
        "shadow" => visit.visit(Shadow::<C>::new(plan)),
        "dither" => visit.visit(Dither::new(plan)),
        "depth" => visit.visit(Depth::<C>::new(plan)),
        "blend" => visit.visit(Blend::<C>::new(plan)),
        _ => return None,
    })
}
