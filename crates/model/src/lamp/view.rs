//! What is to be seen of LAMP.

use super::Lamp;
use crate::lit::Given;
use crate::view::{View, fragments};
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

impl<const C: usize> Lamp<C> {
    /// Shows the unit in a cycle with these inputs; `normed_ready`: SHADE takes a fragment.
    pub fn view(
        &self,
        plan: &Plan,
        frag: Option<Given<C>>,
        tables: &WordIn,
        normed_ready: bool,
        view: &mut View,
    ) {
        view.unit(plan, "lamp");
        view.kind("fragment", "fragments", || fragments::fields(plan));
        let fragment = self.inside.as_ref().map(|lit| &lit.frag);
        view.triangle(fragment.or(frag.map(|given| given.frag)).map(|fragment| fragment.source.id));
        view.flag("have", "the tables are inside", self.have);
        view.wire(|| "have".to_owned());
        let loading = self.fetch.loading();
        view.flag("loading", "tables are being read", loading);
        view.wire(|| "loading".to_owned());
        let busy = view.flag("busy", "a fragment is inside", self.occupied());
        view.wire(|| "busy".to_owned());
        view.number("step", "steps that are done", 5, if self.occupied() { self.step } else { 0 });
        view.table("inside", &["fragment"], false);
        view.row("P");
        let values = fragment.map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
        let shown = fragment.zip(values.as_ref()).map(|(fragment, values)| (fragment.source.id, &values[..]));
        view.token_cell("a fragment that the light is found for", "fragment", shown);
        view.note("the products of a step are not modelled, only their clocks and what they give");
        view.lane(busy, self.occupied() || loading);

        let fires = frag.is_some() && self.frag_ready(normed_ready);
        view.says(fires, "takes a fragment.");
        view.says(loading, "reads the tables of the light, once.");
        view.says(self.working(), "works at pixel {P.addr}: {step} of 16 steps are done.");
        let done = self.normed().is_some();
        view.says(done && normed_ready, "gives pixel {P.addr} its cosines, and what is left of the light.");
        view.says(done && !normed_ready, "stands still: SHADE does not take pixel {P.addr}.");
        view.takes("rdata", tables.word.is_some(), loading);
        view.gives("rrd", None, self.read().is_some(), tables.ready);
        view.gives("normed", Some("shade"), done, normed_ready);
    }
}
