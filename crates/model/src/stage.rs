//! The units between PIXEL and DEPTH: which of them a machine has, in which order, and what each does in a cycle.
//!
//! ```text
//!  PIXEL ─> [TEXEL] ─> [BUMP] ─> [NORMAL or LAMP] ─> [SHADE] ─> [PROJECT] ─> [SHADOW] ─> [DITHER] ─> DEPTH
//! ```
//! The plan declares the order. A machine without any of these units has an empty pipe. This is the only file with a match over
//! all of them: a new unit has one arm in each.

use crate::Events;
use crate::bump::Bump;
use crate::dither::Dither;
use crate::io::Inputs;
use crate::lamp::Lamp;
use crate::lit::{Given, Lit};
use crate::normal::Normal;
use crate::ports::{Pins, Ported, Shown};
use crate::project::Project;
use crate::shade::Shade;
use crate::shadow::Shadow;
use crate::texel::Texel;
use crate::view::View;
use crate::word_memory::{Ask, WordIn};
use edgewalk_machine::{Activity, DrawState, Plan};

/// A unit of the pipe.
#[derive(Clone, Debug)]
pub enum Unit<const C: usize> {
    /// Colours a fragment by a texel.
    Texel(Texel<C>),
    /// Turns the normal of a fragment by a relief.
    Bump(Bump<C>),
    /// Divides by the length of the normal.
    Normal(Normal<C>),
    /// Finds the cosines of a light at a point.
    Lamp(Lamp<C>),
    /// Colours a fragment by its cosines.
    Shade(Shade<C>),
    /// Divides a fragment into the light's view.
    Project(Project<C>),
    /// Looks a fragment up in the light's map.
    Shadow(Shadow<C>),
    /// Rounds the colours of a fragment, or drops it.
    Dither(Dither),
}

/// A unit in its place in the pipe.
#[derive(Clone, Debug)]
pub struct Stage<const C: usize> {
    /// The declared name of the unit.
    pub name: &'static str,
    /// The unit.
    pub unit: Unit<C>,
    /// The memory it reads, by its place in [`Plan::word_memories`].
    memory: Option<usize>,
}

/// What a unit makes in a cycle of its oldest fragment and of a word that its memory offers. It is no register: it counts in the
/// cycle in which it was made.
#[derive(Clone, Debug, Default)]
pub struct Made<const C: usize> {
    /// A fragment was made.
    there: bool,
    lit: Lit<C>,
}

/// The links of a stage in a cycle.
#[derive(Clone, Copy, Debug)]
pub struct Links<'a, const C: usize> {
    /// The fragment offered to the unit.
    pub from: Option<Given<'a, C>>,
    /// The unit itself offers a fragment.
    pub gives: bool,
    /// A fragment that the unit offers is taken.
    pub next: bool,
}

impl<const C: usize> Unit<C> {
    fn new(plan: &Plan, name: &str) -> Option<Self> {
        Some(match name {
            "texel" => Unit::Texel(Texel::new(plan)),
            "bump" => Unit::Bump(Bump::new(plan)),
            "normal" => Unit::Normal(Normal::new(plan)),
            "lamp" => Unit::Lamp(Lamp::new(plan)),
            "shade" => Unit::Shade(Shade::new(plan)),
            "project" => Unit::Project(Project::new(plan)),
            "shadow" => Unit::Shadow(Shadow::new(plan)),
            "dither" => Unit::Dither(Dither::new(plan)),
            _ => return None,
        })
    }
}

/// The pipe of a machine after reset.
pub(crate) fn pipe<const C: usize>(plan: &Plan) -> Vec<Stage<C>> {
    let memories = plan.word_memories();
    let stage = |name: &'static str| {
        let memory = memories.iter().position(|(unit, _)| *unit == name);
        Unit::new(plan, name).map(|unit| Stage { name, unit, memory })
    };
    plan.units().filter_map(|spec| stage(spec.name)).collect()
}

impl<const C: usize> Stage<C> {
    /// Ports of the memory behind the unit.
    #[inline]
    #[must_use]
    pub fn port<'a>(&self, inputs: &Inputs<'a>) -> &'a WordIn {
        self.memory.and_then(|memory| inputs.words.get(memory)).unwrap_or(&WordIn::NONE)
    }

    /// Makes the fragment that the unit offers, if it is made in this cycle: of a word of its memory, or of the fragment `from` that is
    /// offered to it. Other units hold what they offer in a register.
    #[inline]
    pub(crate) fn make<'a>(
        &self,
        from: impl FnOnce() -> Option<Given<'a, C>>,
        inputs: &Inputs,
        made: &mut Made<C>,
    ) {
        match &self.unit {
            Unit::Texel(unit) => made.there = unit.textured(self.port(inputs), &mut made.lit),
            Unit::Shadow(unit) => {
                made.there = unit.shaded(&inputs.shadow, self.port(inputs), &mut made.lit.frag);
            }
            Unit::Dither(unit) => {
                let dithered = unit.dithered(from().map(|given| given.frag));
                made.there = dithered.is_some();
                made.lit.frag = dithered.unwrap_or_default();
            }
            _ => {}
        }
    }

    /// The fragment offered on, by a register or as it was [made](Self::make).
    #[inline]
    pub(crate) fn gives<'a>(&'a self, made: &'a Made<C>) -> Option<Given<'a, C>> {
        match &self.unit {
            Unit::Texel(_) => made.there.then(|| made.lit.given()),
            Unit::Shadow(_) | Unit::Dither(_) => made.there.then(|| Given::alone(&made.lit.frag)),
            Unit::Bump(unit) => unit.bumped().map(Lit::given),
            Unit::Normal(unit) => unit.normed().map(Lit::given),
            Unit::Lamp(unit) => unit.normed().map(Lit::given),
            Unit::Shade(unit) => unit.tinted().map(Given::alone),
            Unit::Project(unit) => unit.projected().map(Given::alone),
        }
    }

    /// The fragment offered to the unit can be taken.
    #[inline]
    pub(crate) fn ready(&self, links: &Links<C>, inputs: &Inputs) -> bool {
        let Links { from, next, .. } = *links;
        match &self.unit {
            Unit::Texel(unit) => unit.frag_ready(self.port(inputs)),
            Unit::Bump(unit) => unit.frag_ready(next),
            Unit::Normal(unit) => unit.frag_ready(next),
            Unit::Lamp(unit) => unit.frag_ready(next),
            Unit::Shade(unit) => unit.frag_ready(from, next),
            Unit::Project(unit) => unit.frag_ready(next),
            Unit::Shadow(unit) => {
                unit.frag_ready(from.map(|given| given.frag), &inputs.shadow, self.port(inputs))
            }
            Unit::Dither(unit) => unit.frag_ready(from.map(|given| given.frag), next),
        }
    }

    /// The cause, if the unit is one, of a fragment's wait before it.
    pub(crate) fn waits(&self, links: &Links<C>) -> Option<Activity> {
        match &self.unit {
            // A unit with room waits for its memory's ready, one that offers nothing for its memory's data.
            Unit::Texel(unit) => (!unit.full() || !links.gives).then_some(Activity::Texel),
            Unit::Bump(_) | Unit::Dither(_) => None,
            Unit::Normal(unit) => unit.waits(links.from).then_some(Activity::Shade),
            Unit::Lamp(unit) => (unit.waits(links.from) || unit.working()).then_some(Activity::Shade),
            Unit::Shade(unit) => unit.waits(links.from).then_some(Activity::Shade),
            Unit::Project(unit) => unit.dividing().then_some(Activity::Project),
            Unit::Shadow(unit) => (!unit.full() || !links.gives).then_some(Activity::Light),
        }
    }

    /// A fragment is inside.
    #[inline]
    pub(crate) fn occupied(&self) -> bool {
        match &self.unit {
            Unit::Texel(unit) => unit.occupied(),
            Unit::Bump(unit) => unit.occupied(),
            Unit::Normal(unit) => unit.occupied(),
            Unit::Lamp(unit) => unit.occupied(),
            Unit::Shade(unit) => unit.occupied(),
            Unit::Project(unit) => unit.occupied(),
            Unit::Shadow(unit) => unit.occupied(),
            Unit::Dither(_) => false,
        }
    }

    /// What the unit asks of its memory.
    #[inline]
    pub(crate) fn asks(&self, links: &Links<C>, inputs: &Inputs) -> Option<(usize, Ask)> {
        let (addr, take) = match &self.unit {
            Unit::Bump(_) | Unit::Project(_) | Unit::Dither(_) => return None,
            Unit::Texel(unit) => (unit.read(links.from), unit.xdata_ready(links.next)),
            Unit::Normal(unit) => (unit.read(), unit.rdata_ready()),
            Unit::Lamp(unit) => (unit.read(), unit.rdata_ready()),
            Unit::Shade(unit) => (unit.read(), unit.sdata_ready()),
            Unit::Shadow(unit) => {
                let frag = links.from.map(|given| given.frag);
                (unit.read(frag, &inputs.shadow), unit.mdata_ready(links.next))
            }
        };
        self.memory.map(|memory| (memory, Ask { addr, take }))
    }

    /// Clock edge.
    #[inline]
    pub(crate) fn step(&mut self, links: &Links<C>, inputs: &Inputs, events: &mut Events) {
        let (port, Links { from, gives, next }) = (self.port(inputs), *links);
        match &mut self.unit {
            Unit::Texel(unit) => unit.step(from, port, gives && next, events),
            Unit::Bump(unit) => unit.step(from, next, events),
            Unit::Normal(unit) => unit.step(from, port, next, events),
            Unit::Lamp(unit) => unit.step(from, port, next, events),
            Unit::Shade(unit) => unit.step(from, port, next, events),
            Unit::Project(unit) => unit.step(from.map(|given| given.frag), next, events),
            Unit::Shadow(unit) => {
                let frag = from.map(|given| given.frag);
                unit.step(frag, &inputs.shadow, port, gives && next, events);
            }
            Unit::Dither(unit) => unit.step(from.map(|given| given.frag), next, events),
        }
    }

    /// Synchronous reset.
    pub(crate) fn reset(&mut self) {
        match &mut self.unit {
            Unit::Texel(unit) => unit.reset(),
            Unit::Bump(unit) => unit.reset(),
            Unit::Normal(unit) => unit.reset(),
            Unit::Lamp(unit) => unit.reset(),
            Unit::Shade(unit) => unit.reset(),
            Unit::Project(unit) => unit.reset(),
            Unit::Shadow(unit) => unit.reset(),
            Unit::Dither(unit) => unit.reset(),
        }
    }

    /// Shows the outputs of the unit.
    pub(crate) fn show(&self, links: &Links<C>, inputs: &Inputs, state: DrawState, out: &mut impl Shown) {
        let (next, word) = (links.next, *self.port(inputs));
        let (lit, frag) = (links.from.map(|given| given.lit()), links.from.map(|given| given.frag));
        let lit = Pins { token: lit.as_ref(), next, word, state, ..Pins::default() };
        let frag = Pins { token: frag, next, word, state, ..Pins::default() };
        match &self.unit {
            Unit::Texel(unit) => unit.show(&lit, out),
            Unit::Bump(unit) => unit.show(&lit, out),
            Unit::Normal(unit) => unit.show(&lit, out),
            Unit::Lamp(unit) => unit.show(&lit, out),
            Unit::Shade(unit) => unit.show(&lit, out),
            Unit::Project(unit) => unit.show(&frag, out),
            Unit::Shadow(unit) => unit.show(&frag, out),
            Unit::Dither(unit) => unit.show(&frag, out),
        }
    }

    /// Shows the unit to a recording; `behind` is the name of the unit that takes what it offers.
    pub(crate) fn view(&self, plan: &Plan, links: &Links<C>, behind: &str, inputs: &Inputs, view: &mut View) {
        let (port, Links { from, next, .. }) = (self.port(inputs), *links);
        let frag = from.map(|given| given.frag);
        match &self.unit {
            Unit::Texel(unit) => unit.view(plan, from, port, (behind, next), view),
            Unit::Bump(unit) => unit.view(plan, from, (behind, next), view),
            Unit::Normal(unit) => unit.view(plan, from, port, next, view),
            Unit::Lamp(unit) => unit.view(plan, from, port, next, view),
            Unit::Shade(unit) => unit.view(plan, from, port, (behind, next), view),
            Unit::Project(unit) => unit.view(plan, frag, next, view),
            Unit::Shadow(unit) => unit.view(plan, frag, (&inputs.shadow, port), (behind, next), view),
            Unit::Dither(unit) => unit.view(plan, frag, next, view),
        }
    }
}
