//! What is to be seen of the machine: its units one after the other, with the readies between them.

use super::shading::parts;
use super::{Inputs, Model};
use crate::depth::DepthInputs;
use crate::project::Project;
use crate::shade::Shade;
use crate::view::View;
use edgewalk_machine::Plan;

impl<const C: usize> Model<C> {
    /// Shows the machine in a cycle with these inputs, before the clock edge.
    pub fn view(&self, plan: &Plan, inputs: &Inputs, view: &mut View) {
        view.begin(inputs.shadow.light_pass);
        let Model { setup, edge, span, pixel, depth, .. } = self;
        let pass = depth.pass();
        let pass_ready = self.blend().is_some_and(|blend| blend.pass_ready(pass, &inputs.blend));
        let drawn = pixel.frag();
        let units = self.units();
        let offered = units.offered(&inputs.texel);
        let colored = self.shade().map_or(drawn, Shade::tinted);
        let frag = self.project().map_or(colored, Project::projected);
        let shaded = self.shadow().and_then(|shadow| shadow.shaded(&inputs.shadow));
        let seen = if self.shadow().is_some() { shaded.as_ref() } else { frag };
        let block = depth.block(seen, inputs.depth_write);
        let seen_ready = inputs.rd_ready && block.is_none();
        let frag_ready = self.shadow().map_or(seen_ready, |shadow| shadow.frag_ready(frag, &inputs.shadow));
        let colored_ready = self.project().map_or(frag_ready, |project| project.frag_ready(frag_ready));
        let readies = units.readies(&offered, &inputs.texel, colored_ready);
        let (pixel_ready, fresh_queued) = (pixel.span_ready(readies.drawn), span.fresh_queued());
        let there = self.term().is_none_or(|term| term.there(span.span()));
        let span_ready = there && pixel_ready;
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
        if let Some(term) = self.term() {
            term.view(plan, span.span(), &inputs.term, pixel_ready, view);
        }
        pixel.view(plan, span.span().filter(|_| there), readies.drawn, view);
        let behind = match (self.normal(), self.lamp()) {
            (Some(_), _) => "normal",
            (None, Some(_)) => "lamp",
            (None, None) => "shade",
        };
        if let Some(texel) = self.texel() {
            let next = if self.bump().is_some() { "bump" } else { behind };
            let (frag, terms) = parts(&offered.drawn);
            texel.view(plan, (frag, terms), &inputs.texel, (next, readies.textured), view);
        }
        if let Some(bump) = self.bump() {
            bump.view(plan, parts(&offered.textured).0, (behind, readies.bumped), view);
        }
        if let Some(normal) = self.normal() {
            normal.view(plan, parts(&offered.bumped).0, &inputs.normal, readies.normed, view);
        }
        if let Some(lamp) = self.lamp() {
            lamp.view(plan, parts(&offered.bumped).0, &inputs.normal, readies.normed, view);
        }
        if let Some(shade) = self.shade() {
            let (frag, cosines) = parts(&offered.normed);
            let next = match (self.project(), self.shadow()) {
                (Some(_), _) => "project",
                (None, Some(_)) => "shadow",
                (None, None) => "depth",
            };
            shade.view(plan, (frag, cosines), &inputs.shade, (next, colored_ready), view);
        }
        if let Some(project) = self.project() {
            project.view(plan, colored, frag_ready, view);
        }
        if let Some(shadow) = self.shadow() {
            shadow.view(plan, frag, &inputs.shadow, seen_ready, view);
        }
        depth.view(plan, seen, &depth_inputs, view);
        if let Some(blend) = self.blend() {
            blend.view(plan, pass, &inputs.blend, view);
        }
        let waits = super::Waits {
            light: self.shadow().is_some_and(|shadow| !shadow.full() || shaded.is_none()),
            pass: pass.is_some() && !pass_ready,
            walk: !there && span.span().is_some(),
            texel: units.texel_waits(&offered),
            tables: units.tables_wait(&offered),
            dividing: self.project().is_some_and(Project::dividing),
        };
        if plan.shadow.draws_map() {
            view.pages();
        }
        view.cause(self.activity(block, readies.drawn, waits));
    }
}
