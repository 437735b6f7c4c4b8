//! What is to be seen of TEXEL.

use super::Texel;
use crate::lit::Given;
use crate::view::{View, fragments};
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

impl<const C: usize> Texel<C> {
    /// Shows the unit in a cycle with these inputs; `next`: who takes what it gives.
    pub fn view(
        &self,
        plan: &Plan,
        frag: Option<Given<C>>,
        textures: &WordIn,
        (next, textured_ready): (&str, bool),
        view: &mut View,
    ) {
        view.unit(plan, "texel");
        view.kind("fragment", "fragments", || fragments::fields(plan));
        let waiting = (!self.queue.is_empty()).then(|| &self.queue.head().frag);
        view.triangle(waiting.or(frag.map(|given| given.frag)).map(|fragment| fragment.source.id));
        let bits = (self.places as u32 + 1).next_power_of_two().ilog2();
        let queued =
            view.number("queued", "fragments that wait for their texel", bits, self.queue.len() as u64);
        view.wire(|| "queue.count".to_owned());
        let address = plan.shade.material_bits + 2 * plan.shade.texture_bits;
        let read = self.read(frag);
        view.number(
            "texel",
            "of the fragment that is offered: material, line, column",
            address,
            read.unwrap_or(0),
        );
        view.table(&format!("queue of {}", self.places), &["fragment"], false);
        for place in 0..self.places {
            let entry = (place < self.queue.len()).then(|| self.queue.at(place).frag);
            let values =
                entry.as_ref().map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
            let shown = entry.as_ref().zip(values.as_ref());
            view.row(&if place == 0 { "head".to_owned() } else { place.to_string() });
            let shown = shown.map(|(fragment, values)| (fragment.source.id, &values[..]));
            view.token_cell("a fragment that waits", "fragment", shown);
        }
        view.lane(queued, self.occupied());

        let offers = self.offers(textures);
        view.says(read.is_some() && textures.ready, "takes a fragment and reads its texel, {texel}.");
        view.says(read.is_some() && !textures.ready, "waits: the memory of the textures takes no read.");
        view.says(frag.is_some() && self.full(), "is full: {queued} fragments wait.");
        view.says(offers && textured_ready, "multiplies the colour of pixel {head.addr} by its texel's.");
        view.says(offers && !textured_ready, "stands still: nobody takes pixel {head.addr}.");
        view.takes("xdata", textures.word.is_some(), self.xdata_ready(textured_ready));
        view.gives("xrd", None, read.is_some(), textures.ready);
        view.gives("textured", Some(next), offers, textured_ready);
    }
}
