//! The whole machine, and what its units show inside.

use super::link::{Rules, Scope, Takes, TriangleTaker, WordPorts};
use super::unit::{Outputs, Showing};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Interface;
use crate::values::{PortId, PortValues};
use edgewalk_machine::{MemoryPort, Plan, PortVertex};
use edgewalk_model::machine::ports::ShownUnits;
use edgewalk_model::ports::Shown;
use edgewalk_model::word_memory::{Ask, MEMORIES};
use edgewalk_model::{BlendInputs, Events, Inputs, Model, ShadowInputs, View, WordIn};

/// The machine.
pub struct MachineDevice<const C: usize> {
    plan: Plan,
    model: Model<C>,
    tri: TriangleTaker,
    rules: Rules,
    depth: WordPorts,
    color: Option<WordPorts>,
    /// In the order of [`Plan::word_memories`].
    words: Vec<WordPorts>,
    /// The readies of the writes: of the pixel, or of its depth; with BLEND of its colours.
    written: [PortId; 2],
    outputs: Outputs,
    /// The units inside, if they are compared.
    inside: Vec<(&'static str, Outputs)>,
}

/// The ports of the units inside.
struct Inside<'a> {
    units: &'a mut [(&'static str, Outputs)],
    ports: &'a mut PortValues,
}

impl ShownUnits for Inside<'_> {
    type Unit<'b>
        = Showing<'b>
    where
        Self: 'b;

    fn unit(&mut self, name: &'static str) -> Showing<'_> {
        let mut units = self.units.iter_mut();
        let found = units.find(|(unit, _)| *unit == name).expect("the model shows units of the plan");
        found.1.on(self.ports)
    }
}

impl<const C: usize> MachineDevice<C> {
    pub fn new(plan: &Plan, interface: &Interface) -> Result<Self, NoPlace> {
        let scope = Scope::alone(plan, interface);
        let model = Model::new(plan);
        let inside = !interface.inner_outputs().is_empty();
        let units = plan.units().filter(|_| inside);
        let units = units.map(|unit| Ok((unit.name, Outputs::find(Scope { owner: unit.name, ..scope })?)));
        let mut units = units.collect::<Result<Vec<_>, NoPlace>>()?;
        if inside {
            model.show(&Inputs::default(), &mut Inside { units: &mut units, ports: &mut interface.values() });
        }
        units.iter().try_for_each(|(_, unit)| unit.complete())?;
        let declared = plan.ports().memory;
        let memory = |memory: &MemoryPort| WordPorts::find(scope, memory);
        let named = |name: &str| declared.iter().find(|port| port.name == name).map(memory).transpose();
        let words = plan.word_memories();
        let blends = plan.blend.is_there();
        let ready = |name: &str| scope.port(&format!("{name}_ready"));
        let mut device = MachineDevice {
            plan: plan.clone(),
            model,
            tri: TriangleTaker::find(scope)?,
            rules: Rules::find(scope)?,
            depth: named("depth")?.ok_or_else(|| NoPlace::Unit("memory".to_owned()))?,
            color: named("color")?,
            words: words.iter().map(|(_, port)| memory(port)).collect::<Result<_, _>>()?,
            written: if blends { [ready("zwr")?, ready("cwr")?] } else { [ready("wr")?; 2] },
            outputs: Outputs::find(scope)?,
            inside: units,
        };
        let outputs = edgewalk_model::Outputs::default();
        device.show(&outputs, &mut interface.values());
        device.outputs.complete()?;
        Ok(device)
    }

    /// What the memories that the host alone writes show in a cycle.
    fn words(&self, ports: &PortValues) -> [WordIn; MEMORIES] {
        let mut words = [WordIn::NONE; MEMORIES];
        for (word, memory) in words.iter_mut().zip(&self.words) {
            *word = memory.word(ports);
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
        let (state, depth) = (self.rules.state(ports), self.depth.word(ports));
        let color = self.color.as_ref().map(|color| color.word(ports));
        Inputs {
            rst: ports.rst,
            tri: triangle.map(|(vertices, tag)| (vertices, *tag)),
            depth_func: state.depth_func,
            depth_write: state.depth_write,
            rd_ready: depth.ready,
            data: depth.word.map(|word| word as u64), // at most 32 bits
            wr_ready: ports.is_high(self.written[0]),
            words,
            shadow: ShadowInputs::of(&state),
            blend: color.map_or_else(BlendInputs::default, |color| BlendInputs {
                color_write: state.color_write,
                add: state.blend_add,
                crd_ready: color.ready,
                cdata: color.word.map(|word| word as u64), // at most 48 bits
                cwr_ready: ports.is_high(self.written[1]),
            }),
        }
    }

    /// Shows the outputs of the machine.
    fn show(&mut self, outputs: &edgewalk_model::Outputs<C>, ports: &mut PortValues) {
        let blend = &outputs.blend;
        self.depth.show(Ask { addr: outputs.rd, take: outputs.data_ready }, ports);
        for (memory, ask) in self.words.iter().zip(self.model.asks()) {
            memory.show(*ask, ports);
        }
        if let Some(color) = &self.color {
            color.show(Ask { addr: blend.crd, take: blend.cdata_ready }, ports);
        }
        let mut shown = self.outputs.on(ports);
        shown.takes(outputs.tri_ready);
        if self.color.is_some() {
            shown.writes(outputs.wr.as_ref());
            shown.gives(blend.cwr.as_ref());
        } else {
            shown.gives(outputs.wr.as_ref());
        }
        shown.status("idle", outputs.idle);
        shown.number("activity", outputs.activity as u128);
    }
}

impl<const C: usize> Device for MachineDevice<C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let (triangle, words) = (self.tri.token(ports), self.words(ports));
        let inputs = self.inputs(triangle.as_ref(), &words, ports);
        if !self.inside.is_empty() {
            self.model.show(&inputs, &mut Inside { units: &mut self.inside, ports });
        }
        let outputs = self.model.cycle(&inputs);
        self.show(&outputs, ports);
        self.tri.clock(ports);
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
