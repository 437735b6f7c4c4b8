//! What is to be seen of the machine: its units one after the other, with the links between them.

use super::Model;
use crate::io::Inputs;
use crate::view::View;
use edgewalk_machine::Plan;

impl<const C: usize> Model<C> {
    /// Shows the machine in a cycle with these inputs, before the clock edge.
    pub fn view(&self, plan: &Plan, inputs: &Inputs, view: &mut View) {
        view.begin(inputs.shadow.light_pass);
        let Model { setup, walker, span, pixel, depth, .. } = self;
        let mut offers = self.room();
        let wires = self.wires(inputs, &mut offers);
        let made = offers.made();
        let fresh_queued = span.fresh_queued();
        let (prim, line) = (setup.prim(), walker.line());
        let line_taken = line.is_some() && span.line_ready();
        setup.view(inputs.tri, walker.prim_ready(prim, fresh_queued), view);
        match walker.poly() {
            None => walker.edge().view(plan, prim, fresh_queued, line_taken, view),
            Some(poly) => poly.view(plan, prim, fresh_queued, line_taken, view),
        }
        span.view(plan, line, wires.span_ready(), view);
        if let Some(term) = self.term() {
            term.view(plan, span.span(), self.records(inputs), wires.pixel_ready, view);
        }
        pixel.view(plan, span.span().filter(|_| wires.there), wires.ready(0), view);
        let pipe = self.pipe();
        for (place, stage) in pipe.iter().enumerate() {
            let behind = pipe.get(place + 1).map_or("depth", |stage| stage.name);
            stage.view(plan, &self.links(&wires, made, place), behind, inputs, view);
        }
        let seen = self.given(made, pipe.len());
        depth.view(plan, seen.map(|given| given.frag), &wires.depth_inputs(inputs), view);
        if let Some(blend) = self.blend() {
            blend.view(plan, depth.pass(), &inputs.blend, view);
        }
        if plan.shadow.draws_map() {
            view.pages();
        }
        view.cause(self.activity(&wires, made));
    }
}
