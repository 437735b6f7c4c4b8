//! What is to be seen of DITHER.

use super::Dither;
use crate::tokens::Fragment;
use crate::view::{View, fragments};
use edgewalk_machine::Plan;

impl Dither {
    /// Shows the unit in a cycle with this fragment offered; `dithered_ready`: DEPTH takes what is offered to it.
    pub fn view<const C: usize>(
        &self,
        plan: &Plan,
        frag: Option<&Fragment<C>>,
        dithered_ready: bool,
        view: &mut View,
    ) {
        view.unit(plan, "dither");
        view.triangle(frag.map(|frag| frag.source.id));
        let (kind, title) = fragments::seen(plan);
        view.kind(kind, title, || fragments::seen_fields(plan));
        let offers = view.flag("offered", "a fragment is offered", frag.is_some());
        view.wire(|| "frag_valid".to_owned());
        view.live(Some(offers));
        let pattern = frag.map_or(0, |frag| self.cut.pattern(frag.addr));
        view.number("pattern", "number of the pattern at its pixel", 4, pattern);
        view.wire(|| "pattern".to_owned());
        let drops = frag.is_some_and(|frag| self.drops(frag));
        if self.kt_bits.is_some() {
            view.flag("dropped", "the pattern is below its k_t", drops);
            view.wire(|| "dropped".to_owned());
        }
        view.live(None);
        if self.kt_bits.is_some() {
            view.flag("pend_fence", "of fragments that were dropped", self.pend_fence);
            view.wire(|| "pend_fence".to_owned());
        }
        let given = self.dithered(frag);
        let values = given.map(|frag| fragments::seen_values(plan, frag.addr, &frag.values, frag.lit));
        let token = given.as_ref().zip(values.as_ref()).map(|(frag, values)| (frag.source.id, &values[..]));
        view.table("given", &["fragment"], false);
        view.row("out");
        view.token_cell("the fragment with the colours that are stored", kind, token);
        view.note("it holds no fragment, and takes no clock");
        view.lane(offers, frag.is_some());

        let taken = given.is_some() && dithered_ready;
        view.says(drops, "drops the fragment: pattern {pattern} is below its k_t.");
        if plan.dither.rounds() {
            view.says(taken, "rounds the colours of pixel {out.addr} by pattern {pattern}.");
        } else {
            view.says(taken, "lets pixel {out.addr} pass: pattern {pattern}.");
        }
        view.says(given.is_some() && !dithered_ready, "stands still: DEPTH does not take pixel {out.addr}.");
        view.gives("dithered", Some("depth"), given.is_some(), dithered_ready);
    }
}
