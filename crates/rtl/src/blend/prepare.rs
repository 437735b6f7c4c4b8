//! What a fragment takes along into the stages: a base, and the weight of its own colour against it.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

/// The colours, in the order of the word: red, the most significant, first.
pub(super) const COLORS: [&str; 3] = ["r", "g", "b"];

/// The head and what its pixel has.
pub(super) struct Old<'m> {
    pub add: Signal<'m>,
    /// The head takes its pixel's colour.
    pub need: Signal<'m>,
    pub rgb: Signal<'m>,
}

/// What has been made of it.
pub(super) struct Prepared<'m> {
    /// Colours of the fragment.
    pub own: [Signal<'m>; 3],
    /// What its own colour is weighed against.
    pub base: [Signal<'m>; 3],
    /// Of its own colour, 2^-kt_bits.
    pub weight: Signal<'m>,
    /// The weight may be other than 0.
    pub weighs: Signal<'m>,
}

impl<'m> Old<'m> {
    /// For the head, whose fields `head` gives.
    pub fn prepare(&self, m: &'m Module, plan: &Plan, head: impl Fn(&str) -> Signal<'m>) -> Prepared<'m> {
        let bits = plan.color.bits;
        let own = COLORS.map(&head);
        let olds = [2, 1, 0].map(|place| self.rgb.slice((place + 1) * bits - 1, place * bits));
        let base = [0, 1, 2].map(|i| {
            let sum = (own[i].zext(bits + 1) + olds[i].zext(bits + 1)).named(&format!("sum_{}", COLORS[i]));
            // All ones where it is more.
            let sum = sum.trunc(bits) | m.cat(&vec![sum.msb(); bits as usize]);
            self.need.mux(self.add.mux(sum, olds[i]), own[i]).named(&format!("base_{}", COLORS[i]))
        });
        let kt = head("kt");
        // kt = 0 leaves 0 of 2^kt_bits: then base is the fragment's colour.
        let rest = -kt.trunc(plan.blend.kt_bits);
        let none = (self.add | kt.msb()).named_doc("no_weight", "the weight is 0: the result is base");
        let weight = none.mux(0, rest).named_doc("weight", "1 - kt, fraction of 2^kt_bits");
        Prepared { own, base, weight, weighs: (self.need & !self.add).named("weighs") }
    }
}
