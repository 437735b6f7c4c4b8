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
        let places = [&self.here, &self.there];
        let fragments = places.map(|place| place.as_ref().map(|place| &place.lit.frag));
        let shown = fragments.into_iter().flatten().next().or(frag.map(|given| given.frag));
        view.triangle(shown.map(|fragment| fragment.source.id));
        view.flag("have", "the tables are inside", self.have);
        view.wire(|| "have".to_owned());
        let loading = self.fetch.loading();
        view.flag("loading", "tables are being read", loading);
        view.wire(|| "loading".to_owned());
        let names = ["here", "there"];
        let busy = [0, 1].map(|i| {
            let busy =
                view.flag(&format!("{}_busy", names[i]), "the place holds a fragment", places[i].is_some());
            view.wire(|| format!("{}_busy", names[i]));
            view.live(Some(busy));
            let step = places[i].as_ref().map_or(0, |place| u64::from(place.step));
            view.number(&format!("{}_step", names[i]), "step of the fragment", 5, step);
            view.wire(|| format!("{}_step", names[i]));
            view.live(None);
            busy
        });
        view.table("inside", &["fragment"], false);
        for (name, fragment) in names.iter().zip(fragments) {
            let values = fragment.map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
            let shown = fragment.zip(values.as_ref());
            view.row(name);
            let shown = shown.map(|(fragment, values)| (fragment.source.id, &values[..]));
            view.token_cell("a fragment that the light is found for", "fragment", shown);
        }
        view.note("the products of a step are not modelled, only their clocks and what they give");
        view.lane(busy[0], self.occupied() || loading);

        let fires = frag.is_some() && self.frag_ready(normed_ready);
        view.says(fires, "takes a fragment.");
        view.says(loading, "reads the tables of the light, once.");
        let [here, there] = places.map(|place| place.as_ref().is_some_and(|place| place.step > 0));
        let done = self.normed().is_some();
        view.says(here && !done, "is in the first half of step {here_step} at pixel {here.addr}.");
        view.says(there, "is in the second half of step {there_step} at pixel {there.addr}.");
        view.says(
            done && normed_ready,
            "gives pixel {here.addr} its cosines, and what is left of the light.",
        );
        view.says(done && !normed_ready, "stands still: SHADE does not take pixel {here.addr}.");
        view.takes("rdata", tables.word.is_some(), loading);
        view.gives("rrd", None, self.read().is_some(), tables.ready);
        view.gives("normed", Some("shade"), done, normed_ready);
    }
}
