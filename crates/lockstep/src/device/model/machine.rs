//! The whole machine, and what its units show inside.

use super::blend::{BlendStatus, ColorPorts};
use super::bump::BumpPorts;
use super::depth::{DepthStatus, MemoryPorts};
use super::edge::EdgePorts;
use super::lamp::LampPorts;
use super::link::{Giver, Scope};
use super::normal::NormalPorts;
use super::pixel::PixelPorts;
use super::project::ProjectPorts;
use super::setup::{SetupPorts, TriangleTaker};
use super::shade::ShadePorts;
use super::shadow::{MapRules, ShadowPorts};
use super::span::SpanPorts;
use super::term::{TermPorts, WordPorts};
use super::texel::TexelPorts;
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::stage::{Links, Stage, Unit};
use edgewalk_model::tokens::Fragment;
use edgewalk_model::word_memory::MEMORIES;
use edgewalk_model::{BlendInputs, Events, Inputs, Model, ShadowInputs, View, WordIn};

/// The machine.
pub struct MachineDevice<const C: usize> {
    plan: Plan,
    model: Model<C>,
    tri: TriangleTaker,
    memory: MemoryPorts<C>,
    /// In the order of [`Plan::word_memories`].
    words: Vec<WordPorts>,
    map: Option<MapRules>,
    color: Option<ColorPorts<C>>,
    activity: PortId,
    idle: PortId,
    inside: Option<Inside<C>>,
}

/// The units inside.
struct Inside<const C: usize> {
    setup: SetupPorts<C>,
    edge: EdgePorts<C>,
    span: SpanPorts<C>,
    term: Option<TermPorts<C>>,
    pixel: PixelPorts<C>,
    /// In the order of [`Model::pipe`].
    pipe: Vec<StagePorts<C>>,
    depth: DepthStatus,
    blend: Option<(Giver<Fragment<C>>, BlendStatus)>,
}

/// What a unit between PIXEL and DEPTH shows.
enum StagePorts<const C: usize> {
    Texel(TexelPorts<C>),
    Bump(BumpPorts<C>),
    Normal(NormalPorts<C>),
    Lamp(LampPorts<C>),
    Shade(ShadePorts<C>),
    Project(ProjectPorts<C>),
    Shadow(ShadowPorts<C>),
}

impl<const C: usize> MachineDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        let words = plan.word_memories();
        let inside = !interface.inner_outputs().is_empty();
        let model = Model::new(plan);
        Ok(MachineDevice {
            plan: plan.clone(),
            tri: TriangleTaker::find(plan, interface)?,
            memory: MemoryPorts::find(scope)?,
            words: words
                .iter()
                .map(|(_, memory)| WordPorts::find(scope, memory))
                .collect::<Result<_, _>>()?,
            map: plan.shadow.is_there().then(|| MapRules::find(scope)).transpose()?,
            color: plan.blend.is_there().then(|| ColorPorts::find(scope)).transpose()?,
            activity: scope.port("activity")?,
            idle: scope.port("idle")?,
            inside: inside.then(|| Inside::find(plan, interface, model.pipe())).transpose()?,
            model,
        })
    }
}

impl<const C: usize> StagePorts<C> {
    fn find(scope: Scope, stage: &Stage<C>) -> Result<Self, NoPlace> {
        Ok(match &stage.unit {
            Unit::Texel(_) => StagePorts::Texel(TexelPorts::find(scope)?),
            Unit::Bump(_) => StagePorts::Bump(BumpPorts::find(scope)?),
            Unit::Normal(_) => StagePorts::Normal(NormalPorts::find(scope)?),
            Unit::Lamp(_) => StagePorts::Lamp(LampPorts::find(scope)?),
            Unit::Shade(_) => StagePorts::Shade(ShadePorts::find(scope)?),
            Unit::Project(_) => StagePorts::Project(ProjectPorts::find(scope)?),
            Unit::Shadow(_) => StagePorts::Shadow(ShadowPorts::find(scope)?),
        })
    }

    fn show(&self, stage: &Stage<C>, links: &Links<C>, inputs: &Inputs, ports: &mut PortValues) {
        let (port, Links { from, next, .. }) = (stage.port(inputs), *links);
        match (self, &stage.unit) {
            (StagePorts::Texel(shown), Unit::Texel(unit)) => shown.show(unit, port, ports),
            (StagePorts::Bump(shown), Unit::Bump(unit)) => shown.show(unit, next, ports),
            (StagePorts::Normal(shown), Unit::Normal(unit)) => shown.show(unit, from, next, ports),
            (StagePorts::Lamp(shown), Unit::Lamp(unit)) => shown.show(unit, from, next, ports),
            (StagePorts::Shade(shown), Unit::Shade(unit)) => shown.show(unit, from, next, ports),
            (StagePorts::Project(shown), Unit::Project(unit)) => shown.show(unit, next, ports),
            (StagePorts::Shadow(shown), Unit::Shadow(unit)) => {
                shown.show(unit, from.map(|given| given.frag), &inputs.shadow, port, ports);
            }
            _ => unreachable!("ports are found for the stages of this pipe"),
        }
    }
}

impl<const C: usize> Inside<C> {
    fn find(plan: &Plan, interface: &Interface, pipe: &[Stage<C>]) -> Result<Self, NoPlace> {
        let of = |owner| Scope { plan, interface, owner };
        let blend = || Ok::<_, NoPlace>((of("depth").giver("pass")?, BlendStatus::find(of("blend"))?));
        Ok(Inside {
            setup: SetupPorts::find(of("setup"))?,
            edge: EdgePorts::find(of("edge"))?,
            span: SpanPorts::find(of("span"))?,
            term: plan.shade.is_there().then(|| TermPorts::find(of("term"))).transpose()?,
            pixel: PixelPorts::find(of("pixel"))?,
            pipe: pipe
                .iter()
                .map(|stage| StagePorts::find(of(stage.name), stage))
                .collect::<Result<_, _>>()?,
            depth: DepthStatus::find(of("depth"))?,
            blend: plan.blend.is_there().then(blend).transpose()?,
        })
    }

    /// The links between the units in a cycle with these inputs, from the units' states before the clock edge.
    fn show(&self, model: &Model<C>, inputs: &Inputs, ports: &mut PortValues) {
        let (wires, pipe) = (model.wires(inputs), model.pipe());
        self.setup.show(&model.setup, ports);
        self.edge.show(&model.edge, model.span.fresh_queued(), ports);
        self.span.show(&model.span, ports);
        if let (Some(shown), Some(unit)) = (&self.term, model.term()) {
            shown.show(unit, model.span.span(), wires.pixel_ready, ports);
        }
        self.pixel.show(&model.pixel, wires.ready(0), ports);
        for ((place, stage), shown) in pipe.iter().enumerate().zip(&self.pipe) {
            shown.show(stage, &model.links(&wires, place), inputs, ports);
        }
        let seen = model.given(&wires, pipe.len()).map(|given| given.frag);
        self.depth.show(&model.depth, seen, inputs.rd_ready, inputs.depth_write, ports);
        if let (Some((pass, status)), Some(unit)) = (&self.blend, model.blend()) {
            pass.offer(model.depth.pass(), ports);
            status.show(unit, model.depth.pass(), &inputs.blend, ports);
        }
    }
}

impl<const C: usize> MachineDevice<C> {
    /// What the memories that the host alone writes show in a cycle.
    fn words(&self, ports: &PortValues) -> [WordIn; MEMORIES] {
        let mut words = [WordIn::NONE; MEMORIES];
        for (word, memory) in words.iter_mut().zip(&self.words) {
            *word = memory.inputs(ports);
        }
        words
    }

    /// The model's inputs of a cycle.
    fn inputs<'a>(
        &self,
        triangle: Option<&'a ([PortVertex; 3], u32)>,
        words: &'a [WordIn],
        ports: &PortValues,
    ) -> Inputs<'a> {
        let depth = self.memory.inputs(ports);
        Inputs {
            rst: ports.rst,
            tri: triangle.map(|(vertices, tag)| (vertices, *tag)),
            depth_func: depth.depth_func,
            depth_write: depth.depth_write,
            rd_ready: depth.rd_ready,
            data: depth.data,
            wr_ready: depth.wr_ready,
            words,
            shadow: self.map.as_ref().map_or_else(ShadowInputs::default, |map| map.inputs(ports)),
            blend: self.color.as_ref().map_or_else(BlendInputs::default, |color| BlendInputs {
                color_write: depth.color_write,
                ..color.inputs(ports)
            }),
        }
    }
}

impl<const C: usize> Device for MachineDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (triangle, words) = (self.tri.token(ports), self.words(ports));
        let inputs = self.inputs(triangle.as_ref(), &words, ports);
        if let Some(inside) = &self.inside {
            inside.show(&self.model, &inputs, ports);
        }
        let outputs = self.model.cycle(&inputs);
        ports.set(self.tri.ready(), outputs.tri_ready);
        self.memory.show(outputs.rd, outputs.data_ready, outputs.wr.as_ref(), ports);
        for (memory, ask) in self.words.iter().zip(&outputs.words) {
            memory.show(ask.addr, ask.take, ports);
        }
        if let Some(color) = &self.color {
            let blend = &outputs.blend;
            color.show(blend.crd, blend.cdata_ready, blend.cwr.as_ref(), ports);
        }
        ports[self.activity] = outputs.activity as u128;
        ports.set(self.idle, outputs.idle);
    }
}

impl<const C: usize> ModelDevice for MachineDevice<C> {
    fn events(&self) -> &Events {
        self.model.events()
    }

    fn view(&self, ports: &PortValues, view: &mut View) -> bool {
        let (triangle, words) = (self.tri.token(ports), self.words(ports));
        self.model.view(&self.plan, &self.inputs(triangle.as_ref(), &words, ports), view);
        true
    }
}
