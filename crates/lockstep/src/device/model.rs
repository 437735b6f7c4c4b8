//! The model's machine and units as devices.

use super::Device;
use crate::ports::{
    Unit, pack_fragment, pack_line, pack_prim, pack_span, pack_write, unpack_fragment, unpack_line,
    unpack_prim, unpack_span, unpack_triangle,
};
use edgewalk_machine::Plan;
use edgewalk_model::depth::{Block, Depth, DepthInputs};
use edgewalk_model::edge::Edge;
use edgewalk_model::pixel::Pixel;
use edgewalk_model::setup::Setup;
use edgewalk_model::span::SpanQueue;
use edgewalk_model::tokens::Words;
use edgewalk_model::{Coverage, Inputs, Model};

/// A unit of the model. Coverage counts from here on.
#[derive(Clone, Debug)]
pub struct ModelDevice {
    machine: Plan,
    unit: ModelUnit,
    coverage: Coverage,
    widths: Widths,
}

/// Fields of the channels that are not valid all the time.
#[derive(Clone, Debug)]
struct Widths {
    /// Fields of the unit's input token.
    input: usize,
    /// Fields of the unit's output token.
    output: usize,
}

#[derive(Clone, Debug)]
enum ModelUnit {
    Machine(Box<Model>),
    Setup(Box<Setup>),
    Edge(Box<Edge>),
    Span(Box<SpanQueue>),
    Pixel(Box<Pixel>),
    Depth(Box<Depth>),
}

/// The unit of the model after reset; the machine must have passed [`edgewalk_machine::Machine::plan`].
#[must_use]
pub fn model(machine: &Plan, unit: Unit) -> ModelDevice {
    let interface = crate::ports::interface(machine, unit);
    let fields = |name| interface.channels.iter().find(|c| c.name == name).map_or(0, |c| c.fields.len());
    let (input, output) = match unit {
        Unit::Machine => ("tri", "wr"),
        Unit::Setup => ("tri", "prim"),
        Unit::Edge => ("prim", "line"),
        Unit::Span => ("line", "span"),
        Unit::Pixel => ("span", "frag"),
        Unit::Depth => ("frag", "wr"),
    };
    ModelDevice {
        machine: machine.clone(),
        unit: match unit {
            Unit::Machine => ModelUnit::Machine(Box::new(Model::new(machine))),
            Unit::Setup => ModelUnit::Setup(Box::new(Setup::new(machine))),
            Unit::Edge => ModelUnit::Edge(Box::new(Edge::new(machine))),
            Unit::Span => ModelUnit::Span(Box::new(SpanQueue::new(machine))),
            Unit::Pixel => ModelUnit::Pixel(Box::new(Pixel::new(machine))),
            Unit::Depth => ModelUnit::Depth(Box::new(Depth::new(machine))),
        },
        coverage: Coverage::default(),
        widths: Widths { input: fields(input), output: fields(output) },
    }
}

impl ModelDevice {
    /// Hazards and corners met.
    #[must_use]
    pub fn coverage(&self) -> &Coverage {
        match &self.unit {
            ModelUnit::Machine(model) => model.coverage(),
            _ => &self.coverage,
        }
    }
}

/// Valid and fields of an output channel; fields are 0 while there is no token.
fn offer(outputs: &mut Vec<u128>, token: Option<Vec<u128>>, fields: usize) {
    outputs.push(u128::from(token.is_some()));
    match token {
        Some(token) => outputs.extend(token),
        None => outputs.resize(outputs.len() + fields, 0),
    }
}

impl Device for ModelDevice {
    fn cycle(&mut self, inputs: &[u128], outputs: &mut Vec<u128>) {
        outputs.clear();
        let (machine, coverage) = (&self.machine, &mut self.coverage);
        let Widths { input, output } = self.widths;
        let bit = |place: usize| inputs[place] == 1;
        // Every unit begins with valid and fields of its input channel.
        let token = bit(0).then(|| &inputs[1..=input]);
        match &mut self.unit {
            ModelUnit::Machine(model) => {
                // data_valid data_z rd_ready wr_ready depth_func depth_write
                let rest = input + 1;
                let triangle = token.map(|t| unpack_triangle(machine, t));
                let out = model.cycle(&Inputs {
                    rst: false,
                    tri: triangle.as_ref().map(|(vertices, tag)| (vertices, *tag)),
                    data: bit(rest).then_some(inputs[rest + 1] as u64),
                    rd_ready: bit(rest + 2),
                    wr_ready: bit(rest + 3),
                    depth_func: inputs[rest + 4] as u8,
                    depth_write: bit(rest + 5),
                });
                outputs.extend([out.tri_ready, out.data_ready].map(u128::from));
                offer(outputs, out.rd.map(|addr| vec![addr.into()]), 1);
                offer(outputs, out.wr.map(|w| pack_write(machine, &w)), output);
                outputs.extend([out.activity as u128, u128::from(out.idle)]);
            }
            ModelUnit::Setup(setup) => {
                let ready = bit(input + 1);
                outputs.push(u128::from(setup.tri_ready()));
                offer(outputs, setup.prim().map(|p| pack_prim(machine, p)), output);
                let triangle = token.map(|t| unpack_triangle(machine, t));
                setup.step(triangle.as_ref().map(|(vertices, tag)| (vertices, *tag)), ready, coverage);
            }
            ModelUnit::Edge(edge) => {
                let (ready, fresh_queued) = (bit(input + 1), bit(input + 2));
                outputs.push(u128::from(edge.prim_ready(fresh_queued)));
                let line = edge.line().map(|l| {
                    let mut token = pack_line(machine, l);
                    token.extend(edge.gradient().map(u128::from));
                    token
                });
                offer(outputs, line, output);
                let prim = token.map(|t| unpack_prim(machine, t));
                edge.step(prim.as_ref(), fresh_queued, ready, coverage);
            }
            ModelUnit::Span(span) => {
                let ready = bit(input + 1);
                let line = token.map(|t| unpack_line(machine, t));
                let line_ready = line.as_ref().is_some_and(|l| span.line_ready(l));
                outputs.push(u128::from(line_ready));
                offer(outputs, span.span().map(|s| pack_span(machine, s)), output);
                outputs.push(u128::from(span.fresh_queued()));
                span.step(line.as_ref().filter(|_| line_ready), ready, coverage);
            }
            ModelUnit::Pixel(pixel) => {
                let ready = bit(input + 1);
                outputs.push(u128::from(pixel.span_ready(ready)));
                offer(outputs, pixel.frag().map(|f| pack_fragment(machine, f)), output);
                let status = [pixel.active(), pixel.on_screen(), pixel.advance(ready), pixel.occupied()];
                outputs.extend(status.map(u128::from));
                let span = token.map(|t| unpack_span(machine, t));
                let gradient: Words = std::array::from_fn(|i| inputs[input - 3 + i] as u64); // the last four fields
                pixel.step(span.as_ref(), &gradient, ready, coverage);
            }
            ModelUnit::Depth(depth) => {
                let rest = input + 1;
                let frag = token.map(unpack_fragment);
                let depth_inputs = DepthInputs {
                    data: bit(rest).then_some(inputs[rest + 1] as u64),
                    rd_ready: bit(rest + 2),
                    wr_ready: bit(rest + 3),
                    depth_func: inputs[rest + 4] as u8,
                    depth_write: bit(rest + 5),
                };
                let block = depth.block(frag.as_ref(), depth_inputs.depth_write);
                let ready = depth_inputs.rd_ready && block.is_none();
                outputs.extend([ready, depth.data_ready(depth_inputs.wr_ready)].map(u128::from));
                let read = frag.filter(|_| block.is_none()).map(|f| vec![f.addr.into()]);
                offer(outputs, read, 1);
                offer(outputs, depth.write().map(|w| pack_write(machine, w)), output);
                let hazard = block == Some(Block::Hazard);
                // Without a fragment only a full queue blocks.
                let full = depth.block(None, depth_inputs.depth_write).is_some();
                outputs.extend([hazard, full, depth.occupied()].map(u128::from));
                depth.step(frag.as_ref(), block, &depth_inputs, coverage);
            }
        }
    }
}
