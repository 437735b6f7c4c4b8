//! What is to be seen of the machine: its units one after the other, with the readies between them.

use super::{Inputs, Model};
use crate::depth::DepthInputs;
use crate::view::View;
use edgewalk_machine::Plan;

impl<const C: usize> Model<C> {
    /// Shows the machine in a cycle with these inputs, before the clock edge.
    pub fn view(&self, plan: &Plan, inputs: &Inputs, view: &mut View) {
        view.begin();
        let Model { setup, edge, span, pixel, depth, .. } = self;
        let pass = depth.pass();
        let pass_ready = self.blend().is_some_and(|blend| blend.pass_ready(pass, &inputs.blend));
        let frag = pixel.frag();
        let block = depth.block(frag, inputs.depth_write);
        let frag_ready = inputs.rd_ready && block.is_none();
        let (span_ready, fresh_queued) = (pixel.span_ready(frag_ready), span.fresh_queued());
        let line = edge.line();
        let line_ready = line.is_some() && span.line_ready();
        let prim = setup.prim();
        let depth_inputs = DepthInputs {
            depth_func: inputs.depth_func,
            depth_write: inputs.depth_write,
            rd_ready: inputs.rd_ready,
            data: inputs.data,
            wr_ready: inputs.wr_ready,
            color_write: inputs.blend.color_write,
            pass_ready,
        };
        setup.view(inputs.tri, edge.prim_ready(fresh_queued), view);
        edge.view(plan, prim, fresh_queued, line_ready, view);
        span.view(plan, line, span_ready, view);
        pixel.view(plan, span.span(), frag_ready, view);
        depth.view(plan, frag, &depth_inputs, view);
        if let Some(blend) = self.blend() {
            blend.view(plan, pass, &inputs.blend, view);
        }
        view.cause(self.activity(
            block,
            frag_ready,
            super::Waits { light: false, pass: pass.is_some() && !pass_ready, walk: false, tables: false },
        ));
    }
}
