//! What is to be seen of SHADE.

use super::Shade;
use crate::lit::Given;
use crate::view::{View, fragments};
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

impl<const C: usize> Shade<C> {
    /// Shows the unit in a cycle with these inputs; `next`: who takes what it gives.
    pub fn view(
        &self,
        plan: &Plan,
        frag: Option<Given<C>>,
        tables: &WordIn,
        (next, tinted_ready): (&str, bool),
        view: &mut View,
    ) {
        view.unit(plan, "shade");
        view.kind("fragment", "fragments", || fragments::fields(plan));
        let stages = [
            ("A", self.a.map(|(fragment, _)| fragment)),
            ("B", self.b.map(|(fragment, _)| fragment)),
            ("G", self.g.map(|(fragment, _)| fragment)),
            ("M", self.m.map(|(fragment, _)| fragment)),
            ("C", self.c),
        ];
        let oldest =
            stages.iter().rev().find_map(|(_, stage)| stage.as_ref()).or(frag.map(|given| given.frag));
        view.triangle(oldest.map(|fragment| fragment.source.id));
        view.flag("have", "tables are inside", self.have);
        view.wire(|| "have".to_owned());
        let current = view.number("current", "the material whose tables they are", 9, self.material);
        let loading = self.fetch.loading();
        view.flag("loading", "tables are being read", loading);
        view.wire(|| "loading".to_owned());
        view.table("stages", &["fragment"], false);
        for (name, stage) in &stages {
            if (*name == "M" && !self.multiplies) || (*name == "G" && !self.weakens) {
                continue;
            }
            let values =
                stage.as_ref().map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
            let shown = stage.as_ref().zip(values.as_ref());
            view.row(name);
            let shown = shown.map(|(fragment, values)| (fragment.source.id, &values[..]));
            view.token_cell("a fragment on its way to its colour", "fragment", shown);
        }
        view.lane(current, self.occupied() || loading);

        let fires = frag.is_some() && self.frag_ready(frag, tinted_ready);
        let waits = self.waits(frag);
        view.says(fires, "takes a fragment and looks its cosines up in the tables of material {current}.");
        view.says(loading, "reads the tables of material {current}; the fragment that wants them waits.");
        view.says(waits && !loading && self.occupied(), "waits until no stage needs the old tables.");
        view.says(self.c.is_some() && tinted_ready, "gives pixel {C.addr} its colour.");
        view.says(!self.advance(tinted_ready), "stands still: nobody takes pixel {C.addr}.");
        view.takes("sdata", tables.word.is_some(), loading);
        view.gives("srd", None, self.read().is_some(), tables.ready);
        view.gives("tinted", Some(next), self.c.is_some(), tinted_ready);
    }
}
