//! What is to be seen of SHADOW.

use super::{Place, Shadow, ShadowInputs};
use crate::tokens::Fragment;
use crate::view::{Shape, View, fragments, modulo};
use crate::word_memory::WordIn;
use edgewalk_machine::Plan;

impl<const C: usize> Shadow<C> {
    /// Shows the unit in a cycle with these inputs; `next`: who takes what it gives, and whether it is taken.
    pub fn view(
        &self,
        plan: &Plan,
        frag: Option<&Fragment<C>>,
        (inputs, map): (&ShadowInputs, &WordIn),
        (next, shaded_ready): (&str, bool),
        view: &mut View,
    ) {
        view.unit(plan, "shadow");
        let kind = fragments::looked_up(plan);
        view.kind(kind.0, kind.1, || fragments::looked_up_fields(plan));
        let head = (!self.queue.is_empty()).then(|| *self.queue.head());
        view.triangle(head.as_ref().map(|head| &head.fragment).or(frag).map(|frag| frag.source.id));
        let bits = (self.places as u32 + 1).next_power_of_two().ilog2();
        let queued =
            view.number("queued", "fragments that wait for their texel", bits, self.queue.len() as u64);
        view.wire(|| "queue.count".to_owned());
        view.flag("map_on", "the map counts; else all is lit", inputs.on);
        view.wire(|| "shadow_on".to_owned());
        self.view_queue(plan, view);
        view.lane(queued, self.occupied());

        let place = frag.map(|frag| self.place(frag, inputs));
        let read = self.read(frag, inputs);
        let texel = frag.filter(|_| read.is_some());
        let [tx, ty, d] = [0, 1, 2].map(|axis| texel.map_or(0, |frag| self.coordinate(frag, axis)));
        let side = self.side + 1;
        let mut made = Fragment::default();
        let seen = self.shaded(inputs, map, &mut made).then_some(made);
        let compares = seen.is_some() && head.is_some_and(|head| !head.known);
        view.table("looked up in this cycle", &["tx", "ty", "d"], false);
        view.row("frag");
        view.cell("column of its texel", || Shape::signed(side), modulo(tx, side));
        view.cell("line of its texel", || Shape::signed(side), modulo(ty, side));
        view.cell("its depth from the light", || Shape::whole(self.depth_bits), modulo(d, self.depth_bits));
        let stored = map.word.filter(|_| compares).map(|word| self.texel(word));
        let depth = stored.as_ref().map_or(0, |texel| texel.depth as u64); // not below 0
        view.number("stored", "depth that the map has at the head's texel", self.depth_bits, depth);
        if self.transmits {
            let left = stored.map_or(self.all(), |texel| texel.left);
            view.number("left", "what is left of the light there", self.color_bits, left);
        }
        view.flag("lit", "the light reaches the head", seen.as_ref().is_some_and(|frag| frag.lit));
        self.say(place, read.is_some(), map, (seen.as_ref(), shaded_ready), view);

        view.takes("mdata", map.word.is_some(), self.mdata_ready(shaded_ready));
        view.gives("mrd", None, read.is_some(), map.ready);
        view.gives("shaded", Some(next), seen.is_some(), shaded_ready);
    }

    fn view_queue(&self, plan: &Plan, view: &mut View) {
        view.table(&format!("queue of {}", self.places), &["fragment", "known", "value", "d"], false);
        for number in 0..self.places {
            let entry = (number < self.queue.len()).then(|| *self.queue.at(number));
            let values = entry
                .map(|entry| fragments::looked_up_values(plan, entry.fragment.addr, &entry.fragment.values));
            let shown = entry.as_ref().zip(values.as_ref());
            let shown = shown.map(|(entry, values)| (entry.fragment.source.id, &values[..]));
            let wire = |part: &str| format!("queue.place{number}_{part}");
            let entry = entry.unwrap_or_default();
            view.row(&if number == 0 { "head".to_owned() } else { number.to_string() });
            let there = view.token_cell("a fragment that waits", fragments::looked_up(plan).0, shown);
            view.live(Some(there));
            let known = view.cell("lit or not without a texel", || Shape::Flag, entry.known.into());
            view.wire(|| wire("known"));
            view.live(Some(known));
            view.cell("lit, if that is known", || Shape::Flag, entry.value.into());
            view.wire(|| wire("value"));
            view.live(Some(there));
            let bits = self.depth_bits;
            view.cell("depth from the light", || Shape::whole(bits), modulo(entry.d, bits));
            view.wire(|| wire("d"));
            view.live(None);
        }
    }

    fn say(
        &self,
        place: Option<Place>,
        reads: bool,
        map: &WordIn,
        (seen, shaded_ready): (Option<&Fragment<C>>, bool),
        view: &mut View,
    ) {
        let room = !self.full();
        view.says(
            reads && map.ready,
            "takes a fragment and reads texel ({frag.tx}, {frag.ty}); it lies at {frag.d}.",
        );
        view.says(reads && !map.ready, "waits: the map takes no read.");
        view.says(room && place == Some(Place::Own), "takes a fragment of the map itself: it is lit.");
        view.says(room && place == Some(Place::Off), "takes a fragment: no map counts, it is lit.");
        view.says(room && place == Some(Place::Outside), "takes a fragment outside the map: it is lit.");
        view.says(room && place == Some(Place::Before), "takes a fragment nearer than the map: it is lit.");
        view.says(room && place == Some(Place::Behind), "takes a fragment behind the map: it is in shadow.");
        view.says(place.is_some() && !room, "is full: {queued} fragments wait.");
        let (goes, lit) = (seen.is_some() && shaded_ready, seen.is_some_and(|frag| frag.lit));
        let known = !self.queue.is_empty() && self.queue.head().known;
        let texel_lit = goes && !known && lit;
        if self.transmits {
            view.says(
                texel_lit,
                "{head.d} is not beyond {stored}: pixel {head.addr} is lit, by {left} of the light.",
            );
        } else {
            view.says(texel_lit, "{head.d} is not beyond {stored}: pixel {head.addr} is lit.");
        }
        view.says(goes && !known && !lit, "{head.d} is beyond {stored}: pixel {head.addr} is in shadow.");
        view.says(goes && known, "hands pixel {head.addr} on; lit: {lit}.");
        view.says(seen.is_some() && !shaded_ready, "stands still: DEPTH does not take pixel {head.addr}.");
    }
}
