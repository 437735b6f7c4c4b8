//! The machine: the units wired together, one clock.
//!
//! ```text
//!  tri ─> SETUP ─prim─> EDGE ─line─> SPAN ─span─> PIXEL ─frag─> DEPTH ─> wr
//!                         └────────── gradients ───┘              ├─> rd, <─ data
//!     with SHADOW, before DEPTH: ─> [PROJECT] ─> SHADOW ─shaded─> DEPTH
//!     with TERM and SHADE: SPAN ─span─> TERM ─walked─> PIXEL ─frag─> [TEXEL] ─> [BUMP] ─> [NORMAL or LAMP] ─> SHADE ─tinted─> DEPTH
//!                                with BLEND, for wr: ─> zwr, ─pass─> BLEND ─> crd, <─ cdata, ─> cwr
//! ```
//! Data runs to the right, readies to the left within the cycle. [`Model::cycle`] therefore works out the readies from
//! DEPTH back to SETUP, and then clocks the units in the same order, so that each still sees its source as it was.
//!
//! Rules: `docs/machine.md`, sections 8 to 17.

pub mod shading;
mod view;

use crate::Events;
use crate::blend::Blend;
pub use crate::blend::{BlendInputs, BlendOutputs};
use crate::bump::Bump;
use crate::counters::Counters;
use crate::counters::one_more;
use crate::depth::{Block, Depth, DepthInputs};
use crate::edge::Edge;
use crate::lamp::Lamp;
use crate::normal::Normal;
pub use crate::normal::NormalInputs;
use crate::pixel::Pixel;
use crate::project::Project;
use crate::setup::Setup;
use crate::shade::Shade;
pub use crate::shade::ShadeInputs;
use crate::shadow::Shadow;
pub use crate::shadow::ShadowInputs;
use crate::span::Span;
pub use crate::term::TermInputs;
use crate::term::{Term, Walked};
use crate::texel::Texel;
pub use crate::texel::TexelInputs;
use crate::tokens::{FEW, Fragment, Line, Write};
use edgewalk_machine::{Activity, Plan, PortVertex};
use shading::parts;

/// Input ports of a cycle; a valid and its data are an `Option`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inputs<'a> {
    /// Synchronous reset.
    pub rst: bool,
    /// A triangle and its tag.
    pub tri: Option<(&'a [PortVertex; 3], u32)>,
    /// Compare function, constant while the machine is busy: 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal,
    /// 6 gequal, 7 always.
    pub depth_func: u8,
    /// Fragments that pass store their depth; constant while the machine is busy.
    pub depth_write: bool,
    /// The memory takes a read.
    pub rd_ready: bool,
    /// The depth of the oldest read.
    pub data: Option<u64>,
    /// The memory takes a write.
    pub wr_ready: bool,
    /// What only machines with TERM have.
    pub term: TermInputs,
    /// What only machines with TEXEL have.
    pub texel: TexelInputs,
    /// What only machines with NORMAL or LAMP have.
    pub normal: NormalInputs,
    /// What only machines with SHADE have.
    pub shade: ShadeInputs,
    /// What only machines with SHADOW have.
    pub shadow: ShadowInputs,
    /// What only machines with BLEND have.
    pub blend: BlendInputs,
}

/// Output ports of the same cycle. A link fires if it is valid here and ready there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outputs<const C: usize> {
    /// A triangle is taken, if there is one.
    pub tri_ready: bool,
    /// Address of a depth read.
    pub rd: Option<u32>,
    /// The depth is taken, if it is there.
    pub data_ready: bool,
    /// A write; with BLEND of a depth.
    pub wr: Option<Write<C>>,
    /// With TERM: address of a word of a record.
    pub trd: Option<u32>,
    /// With TERM: a word of a record is taken, if it is there.
    pub tdata_ready: bool,
    /// With TEXEL: address of a texel.
    pub xrd: Option<u32>,
    /// With TEXEL: a texel is taken, if it is there.
    pub xdata_ready: bool,
    /// With NORMAL or LAMP: address of a root.
    pub rrd: Option<u32>,
    /// With NORMAL or LAMP: a root is taken, if it is there.
    pub rdata_ready: bool,
    /// With SHADE: address of an entry of the tables.
    pub srd: Option<u32>,
    /// With SHADE: an entry is taken, if it is there.
    pub sdata_ready: bool,
    /// With SHADOW: address of a texel.
    pub mrd: Option<u32>,
    /// With SHADOW: the depth of a texel is taken, if it is there.
    pub mdata_ready: bool,
    /// What only machines with BLEND have.
    pub blend: BlendOutputs<C>,
    /// What the cycle was spent on.
    pub activity: Activity,
    /// Nothing to do: `activity` is 0.
    pub idle: bool,
}

/// State of the whole machine, `C` words a token; [`for_channels`](crate::for_channels!) finds the number that serves a
/// plan.
#[derive(Clone, Debug)]
pub struct Model<const C: usize> {
    setup: Setup<C>,
    edge: Edge<C>,
    span: Span<C>,
    term: Option<Term>,
    pixel: Pixel<C>,
    texel: Option<Texel<C>>,
    bump: Option<Bump<C>>,
    normal: Option<Normal<C>>,
    lamp: Option<Lamp<C>>,
    shade: Option<Shade<C>>,
    project: Option<Project<C>>,
    shadow: Option<Shadow<C>>,
    depth: Depth<C>,
    blend: Option<Blend<C>>,
    counters: Counters,
    events: Events,
}

/// What keeps fragments waiting besides DEPTH.
#[derive(Clone, Copy)]
struct Waits {
    /// SHADOW has room, and so waits for the map's ready, or has nothing to offer, and so for its data.
    light: bool,
    /// BLEND does not take what DEPTH offers.
    pass: bool,
    /// The walk of TERM is not at the span that is offered.
    walk: bool,
    /// TEXEL waits for its memory's ready, or for its data.
    texel: bool,
    /// PROJECT divides, and takes no fragment.
    dividing: bool,
    /// SHADE has not the tables of the fragment that is offered to it, or NORMAL or LAMP not the roots, or LAMP works.
    tables: bool,
}

/// The units of a [`Model`].
#[derive(Clone, Copy, Debug)]
pub struct Units<'a, const C: usize> {
    /// Triangles to increments.
    pub setup: &'a Setup<C>,
    /// Increments to lines.
    pub edge: &'a Edge<C>,
    /// Lines to spans.
    pub span: &'a Span<C>,
    /// Spans to spans with terms, if the machine has it.
    pub term: Option<&'a Term>,
    /// Spans to fragments.
    pub pixel: &'a Pixel<C>,
    /// Fragments to fragments of the colour of a texel, if the machine has it.
    pub texel: Option<&'a Texel<C>>,
    /// Cosines to those of a normal that a relief has turned, if the machine has it.
    pub bump: Option<&'a Bump<C>>,
    /// Products to cosines, if the machine has it.
    pub normal: Option<&'a Normal<C>>,
    /// Products with the way to a light to cosines, if the machine has it.
    pub lamp: Option<&'a Lamp<C>>,
    /// Fragments to fragments with a colour, if the machine has it.
    pub shade: Option<&'a Shade<C>>,
    /// Fragments to fragments with their place in the light's map, if the machine has it.
    pub project: Option<&'a Project<C>>,
    /// Fragments to fragments lit or not, if the machine has it.
    pub shadow: Option<&'a Shadow<C>>,
    /// Fragments to writes.
    pub depth: &'a Depth<C>,
    /// Fragments that passed to colours, if the machine has it.
    pub blend: Option<&'a Blend<C>>,
}

impl<const C: usize> Model<C> {
    /// A machine after reset.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Model {
            setup: Setup::new(plan),
            edge: Edge::new(plan),
            span: Span::new(plan),
            term: plan.shade.is_there().then(|| Term::new(plan)),
            pixel: Pixel::new(plan),
            texel: plan.shade.textures().then(|| Texel::new(plan)),
            bump: plan.shade.bumps().then(|| Bump::new(plan)),
            normal: plan.shade.has_normal().then(|| Normal::new(plan)),
            lamp: plan.shade.is_positional().then(|| Lamp::new(plan)),
            shade: plan.shade.is_there().then(|| Shade::new(plan)),
            project: plan.shadow.projects().then(|| Project::new(plan)),
            shadow: plan.shadow.is_there().then(|| Shadow::new(plan)),
            depth: Depth::new(plan),
            blend: plan.blend.is_there().then(|| Blend::new(plan)),
            counters: Counters::default(),
            events: Events::default(),
        }
    }

    /// Performance counters since construction.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Events since construction.
    #[must_use]
    pub fn events(&self) -> &Events {
        &self.events
    }

    /// The units as they stand, to look at.
    #[inline(always)]
    #[must_use]
    pub fn units(&self) -> Units<'_, C> {
        let Model { setup, edge, span, pixel, depth, .. } = self;
        let (term, texel, bump) = (self.term(), self.texel(), self.bump());
        let (normal, lamp, shade) = (self.normal(), self.lamp(), self.shade());
        let (project, shadow, blend) = (self.project(), self.shadow(), self.blend());
        Units {
            setup,
            edge,
            span,
            term,
            pixel,
            texel,
            bump,
            normal,
            lamp,
            shade,
            project,
            shadow,
            depth,
            blend,
        }
    }

    /// TERM, as BLEND below.
    #[inline(always)]
    fn term(&self) -> Option<&Term> {
        self.term.as_ref().filter(|_| C > FEW)
    }

    /// TEXEL, as BLEND below.
    #[inline(always)]
    fn texel(&self) -> Option<&Texel<C>> {
        self.texel.as_ref().filter(|_| C > FEW)
    }

    /// BUMP, as BLEND below.
    #[inline(always)]
    fn bump(&self) -> Option<&Bump<C>> {
        self.bump.as_ref().filter(|_| C > FEW)
    }

    /// NORMAL, as BLEND below.
    #[inline(always)]
    fn normal(&self) -> Option<&Normal<C>> {
        self.normal.as_ref().filter(|_| C > FEW)
    }

    /// LAMP, as BLEND below.
    #[inline(always)]
    fn lamp(&self) -> Option<&Lamp<C>> {
        self.lamp.as_ref().filter(|_| C > FEW)
    }

    /// SHADE, as BLEND below.
    #[inline(always)]
    fn shade(&self) -> Option<&Shade<C>> {
        self.shade.as_ref().filter(|_| C > FEW)
    }

    /// PROJECT, as BLEND below.
    #[inline(always)]
    fn project(&self) -> Option<&Project<C>> {
        self.project.as_ref().filter(|_| C > FEW)
    }

    /// SHADOW, as BLEND below.
    #[inline(always)]
    fn shadow(&self) -> Option<&Shadow<C>> {
        self.shadow.as_ref().filter(|_| C > FEW)
    }

    /// BLEND; of machines with few channels, which have none, nothing of it is built.
    #[inline(always)]
    fn blend(&self) -> Option<&Blend<C>> {
        self.blend.as_ref().filter(|_| C > FEW)
    }

    /// Not hardware: the fragment whose read fired in the cycle before.
    #[must_use]
    pub fn last_read(&self) -> Fragment<C> {
        self.depth.last_read()
    }

    /// One clock cycle: the outputs of this cycle, then the clock edge.
    #[inline(always)]
    pub fn cycle(&mut self, inputs: &Inputs) -> Outputs<C> {
        self.cycle_and_tell(inputs, |_| {})
    }

    /// The same; who wants to be near the pixels in time is told the line that SPAN takes.
    #[inline(always)]
    pub(crate) fn cycle_and_tell(&mut self, inputs: &Inputs, tell: impl FnOnce(&Line<C>)) -> Outputs<C> {
        let outputs =
            if self.at_rest() { self.cycle_at_rest(inputs) } else { self.cycle_of_all(inputs, tell) };
        if inputs.rst {
            self.reset();
        }
        outputs
    }

    /// Nothing is held behind SETUP.
    #[inline]
    fn at_rest(&self) -> bool {
        !self.edge.running()
            && !self.span.line_held()
            && self.span.span().is_none()
            && !self.pixel.active()
            && !self.pixel.occupied()
            && !self.in_flight()
    }

    /// A fragment is in flight behind PIXEL.
    #[inline]
    fn in_flight(&self) -> bool {
        self.depth.occupied()
            || self.texel().is_some_and(Texel::occupied)
            || self.bump().is_some_and(Bump::occupied)
            || self.normal().is_some_and(Normal::occupied)
            || self.lamp().is_some_and(Lamp::occupied)
            || self.shade().is_some_and(Shade::occupied)
            || self.project().is_some_and(Project::occupied)
            || self.shadow().is_some_and(Shadow::occupied)
            || self.blend().is_some_and(Blend::occupied)
    }

    /// A cycle in which SPAN, PIXEL and DEPTH have nothing to move and nothing is offered to them: they stay as they
    /// are, and so only SETUP and the EDGE that may take its prim are clocked.
    #[inline(always)]
    fn cycle_at_rest(&mut self, inputs: &Inputs) -> Outputs<C> {
        let tri_ready = self.setup.tri_ready();
        let activity = if tri_ready { Activity::Idle } else { Activity::Setup };
        self.counters.cycle(activity);
        let prim_ready = self.edge.prim_ready(false);
        self.edge.step(self.setup.prim(), false, false, &mut self.events);
        let light_pass = C > FEW && inputs.shadow.light_pass;
        self.setup.step(inputs.tri, prim_ready, light_pass, &mut self.events);
        if inputs.tri.is_some() && tri_ready {
            self.taken();
        }
        Outputs { tri_ready, activity, idle: tri_ready, ..Outputs::default() }
    }

    #[inline(always)]
    fn cycle_of_all(&mut self, inputs: &Inputs, tell: impl FnOnce(&Line<C>)) -> Outputs<C> {
        // BLEND, DEPTH, and the memories behind them.
        let pass = self.depth.pass().copied();
        let pass_ready = self.blend().is_some_and(|blend| blend.pass_ready(pass.as_ref(), &inputs.blend));
        let tinted = self.shade().and_then(Shade::tinted).copied();
        let colored = if self.shade().is_some() { tinted.as_ref() } else { self.pixel.frag() };
        let projected = self.project().and_then(Project::projected).copied();
        let frag = if self.project().is_some() { projected.as_ref() } else { colored };
        let shaded = self.shadow().and_then(|shadow| shadow.shaded(&inputs.shadow));
        let seen = if self.shadow().is_some() { shaded.as_ref() } else { frag };
        let block = self.depth.block(seen, inputs.depth_write);
        let seen_ready = inputs.rd_ready && block.is_none();
        let frag_ready = self.shadow().map_or(seen_ready, |shadow| shadow.frag_ready(frag, &inputs.shadow));
        let colored_ready = self.project().map_or(frag_ready, |project| project.frag_ready(frag_ready));
        let light = self.shadow().is_some_and(|shadow| !shadow.full() || shaded.is_none());
        let offered = self.units().offered(&inputs.texel);
        let readies = self.units().readies(&offered, &inputs.texel, colored_ready);
        let there = self.term().is_none_or(|term| term.there(self.span.span()));
        let waits = Waits {
            light,
            pass: pass.is_some() && !pass_ready,
            walk: !there && self.span.span().is_some(),
            texel: self.units().texel_waits(&offered),
            tables: self.units().tables_wait(&offered),
            dividing: self.project().is_some_and(Project::dividing),
        };
        let activity = self.activity(block, readies.drawn, waits);
        let outputs = Outputs {
            tri_ready: self.setup.tri_ready(),
            rd: seen.filter(|_| block.is_none()).map(|f| f.addr),
            trd: self.term().and_then(|term| term.read(self.edge.record())),
            tdata_ready: self.term().is_some_and(Term::tdata_ready),
            xrd: self.texel().and_then(|texel| texel.read(self.pixel.frag(), self.pixel.cosines())),
            xdata_ready: self.texel().is_some_and(|texel| texel.xdata_ready(readies.textured)),
            rrd: self.normal().and_then(Normal::read).or_else(|| self.lamp().and_then(Lamp::read)),
            rdata_ready: self.normal().is_some_and(Normal::rdata_ready)
                || self.lamp().is_some_and(Lamp::rdata_ready),
            srd: self.shade().and_then(Shade::read),
            sdata_ready: self.shade().is_some_and(Shade::sdata_ready),
            mrd: self.shadow().and_then(|shadow| shadow.read(frag, &inputs.shadow)),
            mdata_ready: self.shadow().is_some_and(|shadow| shadow.mdata_ready(seen_ready)),
            data_ready: self.depth.data_ready(inputs.wr_ready, pass_ready),
            wr: self.depth.write(),
            blend: self.blend().map_or_else(BlendOutputs::default, |blend| BlendOutputs {
                crd: blend.read(pass.as_ref(), inputs.blend.add),
                cdata_ready: blend.cdata_ready(inputs.blend.cwr_ready),
                cwr: blend.write(),
            }),
            activity,
            idle: activity == Activity::Idle,
        };
        self.counters.cycle(activity);
        if outputs.rd.is_some() && inputs.rd_ready {
            one_more(&mut self.counters.fragments);
        }
        let written = match self.blend() {
            None => outputs.wr.is_some() && inputs.wr_ready,
            Some(_) => outputs.blend.cwr.is_some() && inputs.blend.cwr_ready,
        };
        if written {
            one_more(&mut self.counters.writes);
        }
        self.counters.hold(self.span.queued(), self.depth.inflight());
        let taken = inputs.tri.is_some() && outputs.tri_ready;
        if taken {
            self.events.machine.setup_overlap += u64::from(self.pixel.active());
        }
        let light_pass = C > FEW && inputs.shadow.light_pass;
        let events = &mut self.events;
        let span_ready = there && self.pixel.span_ready(readies.drawn);
        let depth_inputs = DepthInputs {
            depth_func: inputs.depth_func,
            depth_write: inputs.depth_write,
            rd_ready: inputs.rd_ready,
            data: inputs.data,
            wr_ready: inputs.wr_ready,
            color_write: inputs.blend.color_write,
            pass_ready,
        };
        if let Some(blend) = self.blend.as_mut().filter(|_| C > FEW) {
            blend.step(pass.as_ref(), &inputs.blend, events);
        }
        self.depth.step(seen, block, &depth_inputs, events);
        if let Some(shadow) = self.shadow.as_mut().filter(|_| C > FEW) {
            shadow.step(frag, &inputs.shadow, seen_ready && shaded.is_some(), events);
        }
        if let Some(project) = self.project.as_mut().filter(|_| C > FEW) {
            project.step(colored, frag_ready, events);
        }
        if let Some(shade) = self.shade.as_mut().filter(|_| C > FEW) {
            let (frag, cosines) = parts(&offered.normed);
            shade.step(frag, cosines, &inputs.shade, colored_ready, events);
        }
        if let Some(normal) = self.normal.as_mut().filter(|_| C > FEW) {
            let (frag, terms) = parts(&offered.bumped);
            normal.step(frag, terms, &inputs.normal, readies.normed, events);
        }
        if let Some(lamp) = self.lamp.as_mut().filter(|_| C > FEW) {
            let (frag, terms) = parts(&offered.bumped);
            lamp.step(frag, terms, &inputs.normal, readies.normed, events);
        }
        if let Some(bump) = self.bump.as_mut().filter(|_| C > FEW) {
            let (frag, terms) = parts(&offered.textured);
            bump.step(frag, terms, readies.bumped, events);
        }
        if let Some(texel) = self.texel.as_mut().filter(|_| C > FEW) {
            let (frag, terms) = parts(&offered.drawn);
            let taken = readies.textured && offered.textured.is_some();
            texel.step(frag, terms, &inputs.texel, taken, events);
        }

        // PIXEL and TERM.
        let span = self.span.span();
        let walked = || self.term.as_ref().map_or_else(Walked::default, Term::walked);
        if span_ready && span.is_some() {
            one_more(&mut self.counters.spans);
        }
        let reached = span.filter(|_| there);
        let held = (self.edge.gradient(), self.edge.kt());
        self.pixel.step(reached, held, walked, readies.drawn, light_pass, events);
        if let Some(term) = self.term.as_mut().filter(|_| C > FEW) {
            term.step(span, &inputs.term, span_ready, events);
        }

        // SPAN, EDGE and SETUP.
        if !span_ready && self.edge.running() && self.span.stands_still() {
            // So most cycles of a long span go by.
            self.edge.wait(events);
            self.setup.step(inputs.tri, false, light_pass, events);
            if taken {
                self.taken();
            }
            return outputs;
        }
        let fresh_queued = self.span.fresh_queued();
        let line = self.edge.line().filter(|_| self.span.line_ready());
        let line_ready = line.is_some();
        if let Some(line) = line {
            one_more(&mut self.counters.lines);
            tell(line);
        }
        self.span.step(line, span_ready, light_pass, events);
        let prim_ready = self.edge.prim_ready(fresh_queued);
        self.edge.step(self.setup.prim(), fresh_queued, line_ready, events);
        self.setup.step(inputs.tri, prim_ready, light_pass, events);
        if taken {
            self.taken();
        }
        outputs
    }

    /// SETUP has taken a triangle.
    fn taken(&mut self) {
        one_more(&mut self.counters.triangles);
        self.counters.lanes_work(self.setup.clocks());
    }

    fn reset(&mut self) {
        self.setup.reset();
        self.edge.reset();
        self.span.reset();
        self.pixel.reset();
        self.depth.reset();
        if let Some(term) = &mut self.term {
            term.reset();
        }
        if let Some(texel) = &mut self.texel {
            texel.reset();
        }
        if let Some(bump) = &mut self.bump {
            bump.reset();
        }
        if let Some(normal) = &mut self.normal {
            normal.reset();
        }
        if let Some(lamp) = &mut self.lamp {
            lamp.reset();
        }
        if let Some(shade) = &mut self.shade {
            shade.reset();
        }
        if let Some(project) = &mut self.project {
            project.reset();
        }
        if let Some(shadow) = &mut self.shadow {
            shadow.reset();
        }
        if let Some(blend) = &mut self.blend {
            blend.reset();
        }
    }

    /// The cause of this cycle, the first that holds.
    #[inline]
    fn activity(&self, block: Option<Block>, frag_ready: bool, waits: Waits) -> Activity {
        if !self.pixel.advance(frag_ready) {
            match block {
                _ if waits.texel => Activity::Texel,
                _ if waits.tables => Activity::Shade,
                _ if waits.dividing => Activity::Project,
                _ if waits.light => Activity::Light,
                Some(Block::Hazard) => Activity::Hazard,
                Some(Block::Full) if waits.pass => Activity::Blend,
                Some(Block::Full) => Activity::Queue,
                None => Activity::Memory,
            }
        } else if self.pixel.active() {
            if self.pixel.on_screen() { Activity::Draw } else { Activity::Offscreen }
        } else if waits.walk {
            Activity::Term
        } else if self.span.span().is_some() || self.span.line_held() || self.edge.running() {
            Activity::Edge
        } else if !self.setup.tri_ready() {
            Activity::Setup
        } else if self.pixel.occupied() || self.in_flight() {
            Activity::Flush
        } else {
            Activity::Idle
        }
    }
}
