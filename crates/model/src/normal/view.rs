//! What is to be seen of NORMAL.

use super::Normal;
use crate::lit::Given;
use crate::view::{View, fragments};
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

impl<const C: usize> Normal<C> {
    /// Shows the unit in a cycle with these inputs; `normed_ready`: SHADE takes a fragment.
    pub fn view(
        &self,
        plan: &Plan,
        frag: Option<Given<C>>,
        roots: &WordIn,
        normed_ready: bool,
        view: &mut View,
    ) {
        view.unit(plan, "normal");
        view.kind("fragment", "fragments", || fragments::fields(plan));
        let stages = || self.stages.iter().map(|stage| stage.map(|lit| &lit.frag));
        let oldest = stages().rev().flatten().next().or(frag.map(|given| given.frag));
        view.triangle(oldest.map(|fragment| fragment.source.id));
        view.flag("have", "the roots are inside", self.have);
        view.wire(|| "have".to_owned());
        let loading = self.fetch.loading();
        view.flag("loading", "roots are being read", loading);
        view.wire(|| "loading".to_owned());
        let held = view.number("held", "fragments in the stages", 3, self.stages.held() as u64);
        view.table("stages", &["fragment"], false);
        for (place, stage) in stages().enumerate() {
            let values = stage.map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
            let shown = stage.zip(values.as_ref());
            view.row(&format!("N{}", place + 1));
            let shown = shown.map(|(fragment, values)| (fragment.source.id, &values[..]));
            view.token_cell("a fragment whose normal is made a unit normal", "fragment", shown);
        }
        view.note("what a stage holds beside its fragment is not modelled, only the clocks");
        view.lane(held, self.occupied() || loading);

        let fires = frag.is_some() && self.frag_ready(normed_ready);
        view.says(fires, "takes a fragment; {held} are on their way.");
        view.says(loading, "reads the table of roots, once.");
        view.says(self.normed().is_some() && normed_ready, "gives pixel {N7.addr} two cosines a light.");
        view.says(!self.advance(normed_ready), "stands still: SHADE takes no fragment.");
        view.takes("rdata", roots.word.is_some(), loading);
        view.gives("rrd", None, self.read().is_some(), roots.ready);
        view.gives("normed", Some("shade"), self.normed().is_some(), normed_ready);
    }
}
