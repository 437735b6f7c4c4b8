//! The whole machine, and what its units show inside.

use super::blend::{BlendStatus, ColorPorts};
use super::bump::BumpPorts;
use super::depth::{DepthStatus, MemoryPorts};
use super::edge::EdgePorts;
use super::lamp::LampPorts;
use super::link::{Giver, Scope};
use super::normal::{self, NormalPorts};
use super::pixel::PixelPorts;
use super::project::ProjectPorts;
use super::setup::{SetupPorts, TriangleTaker};
use super::shade::{self, ShadePorts};
use super::shadow::{MapPorts, ShadowPorts};
use super::span::SpanPorts;
use super::term::{TermPorts, WordPorts};
use super::texel::{self, TexelPorts};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::machine::shading::parts;
use edgewalk_model::tokens::Passed;
use edgewalk_model::{
    BlendInputs, Events, Inputs, Model, NormalInputs, ShadeInputs, ShadowInputs, TermInputs, TexelInputs,
    View,
};

/// The machine.
pub struct MachineDevice<const C: usize> {
    plan: Plan,
    model: Model<C>,
    tri: TriangleTaker,
    memory: MemoryPorts<C>,
    /// Of TERM and of SHADE.
    words: Option<(WordPorts, WordPorts)>,
    textures: Option<WordPorts>,
    roots: Option<WordPorts>,
    map: Option<MapPorts>,
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
    texel: Option<TexelPorts<C>>,
    bump: Option<BumpPorts<C>>,
    normal: Option<NormalPorts<C>>,
    lamp: Option<LampPorts<C>>,
    shade: Option<ShadePorts<C>>,
    project: Option<ProjectPorts<C>>,
    shadow: Option<ShadowPorts<C>>,
    depth: DepthStatus,
    blend: Option<(Giver<Passed<C>>, BlendStatus)>,
}

impl<const C: usize> MachineDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        let words = || {
            let find = |read, data| WordPorts::find(scope, read, data);
            Ok::<_, NoPlace>((find("trd", "tdata")?, find("srd", "sdata")?))
        };
        let inside = !interface.inner_outputs().is_empty();
        Ok(MachineDevice {
            plan: plan.clone(),
            model: Model::new(plan),
            tri: TriangleTaker::find(plan, interface)?,
            memory: MemoryPorts::find(scope)?,
            words: plan.shade.is_there().then(words).transpose()?,
            textures: plan.shade.textures().then(|| texel::find(scope)).transpose()?,
            roots: plan.shade.normalises().then(|| WordPorts::find(scope, "rrd", "rdata")).transpose()?,
            map: plan.shadow.is_there().then(|| MapPorts::find(scope)).transpose()?,
            color: plan.blend.is_there().then(|| ColorPorts::find(scope)).transpose()?,
            activity: scope.port("activity")?,
            idle: scope.port("idle")?,
            inside: inside.then(|| Inside::find(plan, interface)).transpose()?,
        })
    }
}

impl<const C: usize> Inside<C> {
    fn find(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let of = |owner| Scope { plan, interface, owner };
        let blend = || Ok::<_, NoPlace>((of("depth").giver("pass")?, BlendStatus::find(of("blend"))?));
        Ok(Inside {
            setup: SetupPorts::find(of("setup"))?,
            edge: EdgePorts::find(of("edge"))?,
            span: SpanPorts::find(of("span"))?,
            term: plan.shade.is_there().then(|| TermPorts::find(of("term"))).transpose()?,
            pixel: PixelPorts::find(of("pixel"))?,
            texel: plan.shade.textures().then(|| TexelPorts::find(of("texel"))).transpose()?,
            bump: plan.shade.bumps().then(|| BumpPorts::find(of("bump"))).transpose()?,
            normal: plan.shade.has_normal().then(|| NormalPorts::find(of("normal"))).transpose()?,
            lamp: plan.shade.is_positional().then(|| LampPorts::find(of("lamp"))).transpose()?,
            shade: plan.shade.is_there().then(|| ShadePorts::find(of("shade"))).transpose()?,
            project: plan.shadow.projects().then(|| ProjectPorts::find(of("project"))).transpose()?,
            shadow: plan.shadow.is_there().then(|| ShadowPorts::find(of("shadow"))).transpose()?,
            depth: DepthStatus::find(of("depth"))?,
            blend: plan.blend.is_there().then(blend).transpose()?,
        })
    }

    /// The links between the units in a cycle with these inputs, from the units' states before the clock edge.
    fn show(&self, model: &Model<C>, inputs: &Inputs, ports: &mut PortValues) {
        let units = model.units();
        let drawn = units.pixel.frag();
        let offered = units.offered(&inputs.texel);
        let colored = units.shade.map_or(drawn, |shade| shade.tinted());
        let frag = units.project.map_or(colored, |project| project.projected());
        let shaded = units.shadow.and_then(|shadow| shadow.shaded(&inputs.shadow));
        let seen = if units.shadow.is_some() { shaded.as_ref() } else { frag };
        let seen_ready = inputs.rd_ready && units.depth.block(seen, inputs.depth_write).is_none();
        let frag_ready = units.shadow.map_or(seen_ready, |shadow| shadow.frag_ready(frag, &inputs.shadow));
        let colored_ready = units.project.map_or(frag_ready, |project| project.frag_ready(frag_ready));
        self.setup.show(units.setup, ports);
        self.edge.show(units.edge, units.span.fresh_queued(), ports);
        self.span.show(units.span, ports);
        let readies = units.readies(&offered, &inputs.texel, colored_ready);
        if let (Some(shown), Some(unit)) = (&self.term, units.term) {
            shown.show(unit, units.span.span(), units.pixel.span_ready(readies.drawn), ports);
        }
        self.pixel.show(units.pixel, readies.drawn, ports);
        if let (Some(shown), Some(unit)) = (&self.texel, units.texel) {
            shown.show(unit, &inputs.texel, ports);
        }
        if let (Some(shown), Some(unit)) = (&self.bump, units.bump) {
            shown.show(unit, readies.bumped, ports);
        }
        if let (Some(shown), Some(unit)) = (&self.normal, units.normal) {
            shown.show(unit, parts(&offered.bumped).0, readies.normed, ports);
        }
        if let (Some(shown), Some(unit)) = (&self.lamp, units.lamp) {
            shown.show(unit, parts(&offered.bumped).0, readies.normed, ports);
        }
        if let (Some(shown), Some(unit)) = (&self.shade, units.shade) {
            let (frag, cosines) = parts(&offered.normed);
            shown.show(unit, (frag, &cosines), colored_ready, ports);
        }
        if let (Some(shown), Some(unit)) = (&self.project, units.project) {
            shown.show(unit, frag_ready, ports);
        }
        if let (Some(shown), Some(unit)) = (&self.shadow, units.shadow) {
            shown.show(unit, frag, &inputs.shadow, ports);
        }
        self.depth.show(units.depth, seen, inputs.rd_ready, inputs.depth_write, ports);
        if let (Some((pass, status)), Some(unit)) = (&self.blend, units.blend) {
            pass.offer(units.depth.pass(), ports);
            status.show(unit, units.depth.pass(), &inputs.blend, ports);
        }
    }
}

impl<const C: usize> MachineDevice<C> {
    /// The model's inputs of a cycle.
    fn inputs<'a>(&self, triangle: Option<&'a ([PortVertex; 3], u32)>, ports: &PortValues) -> Inputs<'a> {
        let depth = self.memory.inputs(ports);
        let words = self.words.as_ref();
        Inputs {
            rst: ports.rst,
            tri: triangle.map(|(vertices, tag)| (vertices, *tag)),
            depth_func: depth.depth_func,
            depth_write: depth.depth_write,
            rd_ready: depth.rd_ready,
            data: depth.data,
            wr_ready: depth.wr_ready,
            term: words.map_or_else(TermInputs::default, |(terms, _)| terms.term_inputs(ports)),
            texel: self
                .textures
                .as_ref()
                .map_or_else(TexelInputs::default, |memory| texel::inputs(memory, ports)),
            normal: self
                .roots
                .as_ref()
                .map_or_else(NormalInputs::default, |roots| normal::inputs(roots, ports)),
            shade: words.map_or_else(ShadeInputs::default, |(_, tables)| shade::inputs(tables, ports)),
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
        let triangle = self.tri.token(ports);
        let inputs = self.inputs(triangle.as_ref(), ports);
        if let Some(inside) = &self.inside {
            inside.show(&self.model, &inputs, ports);
        }
        let outputs = self.model.cycle(&inputs);
        ports.set(self.tri.ready(), outputs.tri_ready);
        self.memory.show(outputs.rd, outputs.data_ready, outputs.wr.as_ref(), ports);
        if let Some((terms, tables)) = &self.words {
            terms.show(outputs.trd, outputs.tdata_ready, ports);
            tables.show(outputs.srd, outputs.sdata_ready, ports);
        }
        if let Some(textures) = &self.textures {
            textures.show(outputs.xrd, outputs.xdata_ready, ports);
        }
        if let Some(roots) = &self.roots {
            roots.show(outputs.rrd, outputs.rdata_ready, ports);
        }
        if let Some(map) = &self.map {
            map.show(outputs.mrd, outputs.mdata_ready, ports);
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
        let triangle = self.tri.token(ports);
        self.model.view(&self.plan, &self.inputs(triangle.as_ref(), ports), view);
        true
    }
}
