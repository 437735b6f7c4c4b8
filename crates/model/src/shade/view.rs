//! What is to be seen of SHADE.

use super::{Shade, Shaded};
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
        let oldest = self.stages.iter().rev().flatten().next().map(|shaded| &shaded.frag);
        let oldest = oldest.or(frag.map(|given| given.frag));
        view.triangle(oldest.map(|fragment| fragment.source.id));
        view.flag("have", "tables are inside", self.have);
        view.wire(|| "have".to_owned());
        let current = view.number("current", "the material whose tables they are", 9, self.material);
        let loading = self.fetch.loading();
        view.flag("loading", "tables are being read", loading);
        view.wire(|| "loading".to_owned());
        view.table("stages", &["fragment"], false);
        let names = ["A", "B", "G", "L", "M", "C"].into_iter();
        let names = names.filter(|name| match *name {
            "L" | "M" => self.multiplies,
            "G" => self.weakens,
            _ => true,
        });
        for (name, stage) in names.zip(self.stages.iter()) {
            let values = stage.map(|Shaded { frag, own, product }| {
                let mut values = frag.values;
                match name {
                    "C" => {}
                    "M" => values[1..=3].copy_from_slice(product),
                    _ => values[1..=3].copy_from_slice(own),
                }
                fragments::values(plan, frag.addr, &values)
            });
            view.row(name);
            let shown =
                stage.zip(values.as_ref()).map(|(shaded, values)| (shaded.frag.source.id, &values[..]));
            view.token_cell("a fragment on its way to its colour", "fragment", shown);
        }
        view.lane(current, self.occupied() || loading);

        let fires = frag.is_some() && self.frag_ready(frag, tinted_ready);
        let waits = self.waits(frag);
        view.says(fires, "takes a fragment and looks its cosines up in the tables of material {current}.");
        view.says(loading, "reads the tables of material {current}; the fragment that wants them waits.");
        view.says(waits && !loading && self.occupied(), "waits until no stage needs the old tables.");
        view.says(self.tinted().is_some() && tinted_ready, "gives pixel {C.addr} its colour.");
        view.says(!self.advance(tinted_ready), "stands still: nobody takes pixel {C.addr}.");
        view.takes("sdata", tables.word.is_some(), loading);
        view.gives("srd", None, self.read().is_some(), tables.ready);
        view.gives("tinted", Some(next), self.tinted().is_some(), tinted_ready);
    }
}
