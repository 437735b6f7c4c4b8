//! What is to be seen of BUMP.

use super::Bump;
use crate::lit::Given;
use crate::tokens::Fragment;
use crate::view::{View, fragments};
use edgewalk_machine::Plan;

impl<const C: usize> Bump<C> {
    /// Shows the unit in a cycle with this fragment offered; `next`: who takes what it gives.
    pub fn view(
        &self,
        plan: &Plan,
        frag: Option<Given<C>>,
        (next, bumped_ready): (&str, bool),
        view: &mut View,
    ) {
        view.unit(plan, "bump");
        view.kind("fragment", "fragments", || fragments::fields(plan));
        let stages: Vec<Option<&Fragment<C>>> =
            self.stages.iter().map(|stage| stage.map(|lit| &lit.frag)).collect();
        let oldest = stages.iter().rev().flatten().next().copied().or(frag.map(|given| given.frag));
        view.triangle(oldest.map(|fragment| fragment.source.id));
        view.flag("first", "a fragment is in K1", stages[0].is_some());
        view.wire(|| "k1_valid".to_owned());
        view.flag("second", "a fragment is in K2", stages[1].is_some());
        view.wire(|| "k2_valid".to_owned());
        let held = view.number("held", "fragments in the stages", 2, self.stages.held() as u64);
        view.table("stages", &["fragment"], false);
        for (place, stage) in stages.iter().enumerate() {
            let values = stage.map(|fragment| fragments::values(plan, fragment.addr, &fragment.values));
            let shown = stage.zip(values.as_ref());
            view.row(&format!("K{}", place + 1));
            let shown = shown.map(|(fragment, values)| (fragment.source.id, &values[..]));
            view.token_cell("a fragment whose normal the relief turns", "fragment", shown);
        }
        view.note("what a stage holds beside its fragment is not modelled, only the clocks");
        view.lane(held, self.occupied());

        let ready = self.frag_ready(bumped_ready);
        let last = if stages.len() == 2 { "{K2.addr}" } else { "{K3.addr}" };
        let gives = self.bumped().is_some();
        view.says(frag.is_some() && ready, "takes a fragment; {held} are on their way.");
        view.says(gives && bumped_ready, &format!("gives pixel {last} the cosines of its turned normal."));
        view.says(!ready, "stands still: nobody takes what it offers.");
        view.gives("bumped", Some(next), gives, bumped_ready);
    }
}
