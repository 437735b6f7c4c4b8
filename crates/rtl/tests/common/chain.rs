//! The model's units joined as `docs/machine.md` has them, so that the channels between them can be seen.

use edgewalk_machine::Plan;
use edgewalk_model::Inputs;
use edgewalk_model::coverage::Coverage;
use edgewalk_model::depth::{Depth, DepthInputs};
use edgewalk_model::edge::Edge;
use edgewalk_model::pixel::Pixel;
use edgewalk_model::setup::Setup;
use edgewalk_model::span::SpanQueue;
use edgewalk_model::tokens::{Fragment, Line, Prim, Span, Words};

/// The units' states.
pub struct Chain {
    setup: Setup,
    edge: Edge,
    span: SpanQueue,
    pixel: Pixel,
    depth: Depth,
    coverage: Coverage,
}

/// What is on the channels between the units in a cycle. A ready without a token is not compared where it depends on it.
pub struct Between {
    pub prim: Option<Prim>,
    pub prim_ready: bool,
    pub line: Option<Line>,
    pub line_ready: bool,
    pub increments: Words,
    pub fresh_queued: bool,
    pub span: Option<Span>,
    pub span_ready: bool,
    pub fragment: Option<Fragment>,
    pub fragment_ready: bool,
}

impl Chain {
    /// All units at rest.
    pub fn new(machine: &Plan) -> Chain {
        Chain {
            setup: Setup::new(machine),
            edge: Edge::new(machine),
            span: SpanQueue::new(machine),
            pixel: Pixel::new(machine),
            depth: Depth::new(machine),
            coverage: Coverage::default(),
        }
    }

    /// The channels in a cycle with these inputs, then the clock edge.
    pub fn cycle(&mut self, inputs: &Inputs) -> Between {
        let fragment = self.pixel.frag().copied();
        let block = self.depth.block(fragment.as_ref(), inputs.depth_write);
        let fragment_ready = inputs.rd_ready && block.is_none();
        let span_ready = self.pixel.span_ready(fragment_ready);
        let line = self.edge.line().copied();
        let line_ready = line.as_ref().is_some_and(|line| self.span.line_ready(line));
        let fresh_queued = self.span.fresh_queued();
        let between = Between {
            prim: self.setup.prim().copied(),
            prim_ready: self.edge.prim_ready(fresh_queued),
            line,
            line_ready,
            increments: *self.edge.gradient(),
            fresh_queued,
            span: self.span.span().copied(),
            span_ready,
            fragment,
            fragment_ready,
        };
        let Inputs { depth_func, depth_write, rd_ready, data, wr_ready, .. } = *inputs;
        let depth = DepthInputs { depth_func, depth_write, rd_ready, data, wr_ready };
        let coverage = &mut self.coverage;
        self.depth.step(fragment.as_ref(), block, &depth, coverage);
        self.pixel.step(between.span.as_ref(), &between.increments, fragment_ready, coverage);
        self.span.step(line.as_ref(), span_ready, coverage);
        self.edge.step(between.prim.as_ref(), fresh_queued, line_ready, coverage);
        self.setup.step(inputs.tri, between.prim_ready, coverage);
        if inputs.rst {
            self.setup.reset();
            self.edge.reset();
            self.span.reset();
            self.pixel.reset();
            self.depth.reset();
        }
        between
    }
}
