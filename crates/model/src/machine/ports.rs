//! What the units inside the machine show at their ports in a cycle.

use super::Model;
use crate::io::Inputs;
use crate::ports::{Pins, Ported, Shown};
use crate::word_memory::WordIn;

/// Where the units of a machine show their outputs.
pub trait ShownUnits {
    /// Where one of them does.
    type Unit<'a>: Shown
    where
        Self: 'a;

    /// The ports of the unit of this name.
    fn unit(&mut self, name: &'static str) -> Self::Unit<'_>;
}

impl<const C: usize> Model<C> {
    /// Shows the outputs of every unit in a cycle with these inputs, before the clock edge.
    pub fn show(&self, inputs: &Inputs, out: &mut impl ShownUnits) {
        let (mut offers, pipe) = (self.room(), self.pipe());
        let wires = self.wires(inputs, &mut offers);
        let made = offers.made();
        let state = inputs.state();
        let held = self.walker.held();
        let fresh_queued = self.span.fresh_queued();
        let prim = self.setup.prim();
        let prim_ready = self.walker.prim_ready(prim, fresh_queued);
        self.setup.show(&Pins { next: prim_ready, state, ..Pins::default() }, &mut out.unit("setup"));
        let pins = Pins { token: prim, fresh_queued, state, ..Pins::default() };
        match self.walker.poly() {
            None => self.walker.edge().show(&pins, &mut out.unit("edge")),
            Some(poly) => poly.show(&pins, &mut out.unit("poly")),
        }
        self.span.show(&Pins { next: wires.span_ready(), state, ..Pins::default() }, &mut out.unit("span"));
        if let Some(term) = self.term() {
            let (token, next, word) = (self.span.span(), wires.pixel_ready, *self.records(inputs));
            let pins = Pins { token, next, word, held, state, ..Pins::default() };
            term.show(&pins, &mut out.unit("term"));
        }
        self.pixel
            .show(&Pins { next: wires.ready(0), held, state, ..Pins::default() }, &mut out.unit("pixel"));
        for (place, stage) in pipe.iter().enumerate() {
            stage.show(&self.links(&wires, made, place), inputs, state, &mut out.unit(stage.name));
        }
        let token = self.given(made, pipe.len()).map(|given| given.frag);
        let word = WordIn { ready: inputs.rd_ready, word: inputs.data.map(u128::from) };
        let next = if self.blend().is_some() { wires.pass_ready } else { inputs.wr_ready };
        let pins = Pins { token, next, write: inputs.wr_ready, word, state, ..Pins::default() };
        self.depth.show(&pins, &mut out.unit("depth"));
        if let Some(blend) = self.blend() {
            let (token, next) = (self.depth.pass(), inputs.blend.cwr_ready);
            let word = WordIn { ready: inputs.blend.crd_ready, word: inputs.blend.cdata.map(u128::from) };
            blend.show(&Pins { token, next, word, state, ..Pins::default() }, &mut out.unit("blend"));
        }
    }
}
