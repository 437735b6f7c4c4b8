//! Spans and fragments of machines with TERM and SHADE, as port values: the tokens of all machines, with the terms beside.

use super::tokens::{Find, Named, Slot};
use edgewalk_machine::Plan;
use edgewalk_model::Lit;
use edgewalk_model::term::Walked;
use edgewalk_model::tokens::{Source, Span};

/// What PIXEL takes.
#[derive(Clone, Copy, Debug)]
pub struct TermSpan<const C: usize> {
    pub span: Span<C>,
    pub walked: Walked,
}

/// What NORMAL and LAMP find, in the order of the terms.
const COSINES: [&str; 4] = ["nl0", "nh0", "nl1", "nh1"];

/// The place of the term of that name.
fn term(plan: &Plan, name: &str) -> Option<usize> {
    plan.terms().iter().position(|term| term.name == name)
}

impl<const C: usize> Named for TermSpan<C> {
    fn blank(plan: &Plan) -> Self {
        TermSpan { span: Span::blank(plan), walked: Walked::default() }
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        if name == "material" {
            return Some((|t, _| Slot::U32(&mut t.walked.material), 0));
        }
        if name == "gloss" {
            return Some((|t, _| Slot::U32(&mut t.walked.gloss), 0));
        }
        if let Some((place, part)) = name.split_once('_').and_then(|(of, part)| Some((term(plan, of)?, part)))
        {
            let slot: fn(&mut Self, usize) -> Slot<'_> = match part {
                "v" => |t, i| Slot::U64(&mut t.walked.terms[i].v),
                "g" => |t, i| Slot::U64(&mut t.walked.terms[i].g),
                "gg" => |t, i| Slot::U64(&mut t.walked.terms[i].gg),
                _ => return None,
            };
            return Some((slot, place));
        }
        let place = plan.channels().iter().position(|channel| channel.name == name);
        Some(match name {
            "x" => (|t, _| Slot::I32(&mut t.span.x), 0),
            "y" => (|t, _| Slot::U32(&mut t.span.y), 0),
            "count" => (|t, _| Slot::U32(&mut t.span.count), 0),
            "leftward" => (|t, _| Slot::Bool(&mut t.span.leftward), 0),
            "fresh" => (|t, _| Slot::Bool(&mut t.span.fresh), 0),
            "fence" => (|t, _| Slot::Bool(&mut t.span.fence), 0),
            "tag" => (|t, _| Slot::U32(&mut t.span.source.tag), 0),
            _ => (|t, i| Slot::U64(&mut t.span.values[i]), place?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.span.source
    }
}

impl<const C: usize> Named for Lit<C> {
    fn blank(_: &Plan) -> Self {
        Lit::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        if name == "material" {
            return Some((|t, _| Slot::U32(&mut t.cosines.material), 0));
        }
        if name == "gloss" {
            return Some((|t, _| Slot::U32(&mut t.cosines.gloss), 0));
        }
        if name == "beam" {
            return Some((|t, _| Slot::U32(&mut t.cosines.beam), 0));
        }
        if let Some(place) = ["bu", "bv"].iter().position(|slope| *slope == name) {
            return Some((|t, i| Slot::I32(&mut t.cosines.slopes[i]), place));
        }
        if let Some(place) = term(plan, name).or_else(|| COSINES.iter().position(|cosine| *cosine == name)) {
            return Some((|t, i| Slot::I32(&mut t.cosines.terms[i]), place));
        }
        let place = plan.channels().iter().position(|channel| channel.name == name);
        Some(match name {
            "addr" => (|t, _| Slot::U32(&mut t.frag.addr), 0),
            "fence" => (|t, _| Slot::Bool(&mut t.frag.fence), 0),
            "tag" => (|t, _| Slot::U32(&mut t.frag.source.tag), 0),
            "kt" if place.is_none() => (|t, _| Slot::U32(&mut t.frag.kt), 0),
            _ => (|t, i| Slot::U32(&mut t.frag.values[i]), place?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.frag.source
    }
}
