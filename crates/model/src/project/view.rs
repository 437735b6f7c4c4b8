//! What is to be seen of PROJECT.

use super::{Project, Rows};
use crate::tokens::Fragment;
use crate::view::{View, fragments};
use edgewalk_machine::Plan;

impl<const C: usize> Project<C> {
    /// Shows the unit in a cycle with this fragment offered; `projected_ready`: SHADOW takes what is offered to it.
    pub fn view(&self, plan: &Plan, frag: Option<&Fragment<C>>, projected_ready: bool, view: &mut View) {
        view.unit(plan, "project");
        let kind = fragments::looked_up(plan);
        view.kind(kind.0, kind.1, || fragments::looked_up_fields(plan));
        let stages = self.stages();
        view.triangle(stages.iter().rev().flatten().next().copied().or(frag).map(|frag| frag.source.id));
        let ready = self.frag_ready(projected_ready);
        let offers = view.flag("offers", "a divided fragment is offered", self.projected().is_some());
        view.wire(|| "projected_valid".to_owned());
        let held = view.number("held", "fragments inside", 5, stages.iter().flatten().count() as u64);
        if let Rows::Serial { row, .. } = &self.rows {
            view.number("row", "rows that are done", 5, *row);
            view.flag("dividing", "rows are left to be done", self.dividing());
            view.wire(|| "dividing".to_owned());
        }
        view.table("stages", &["fragment"], false);
        for (place, stage) in stages.iter().enumerate() {
            let values =
                stage.map(|fragment| fragments::looked_up_values(plan, fragment.addr, &fragment.values));
            let shown = stage.zip(values.as_ref());
            view.row(&format!("P{place}"));
            let shown = shown.map(|(fragment, values)| (fragment.source.id, &values[..]));
            view.token_cell("a fragment, with what its division will give", kind.0, shown);
        }
        view.note("the rows of a division are not modelled, only their clocks and what they give");
        view.lane(if stages.len() == 1 { offers } else { held }, self.occupied());

        let last = format!("P{}", stages.len() - 1);
        view.says(frag.is_some() && ready, "takes a fragment; {held} were on their way.");
        view.says(self.dividing(), "divides: pixel {P0.addr} lies in texel ({P0.lx}, {P0.ly}) at {P0.lz}.");
        let goes = self.projected().is_some() && projected_ready;
        let gives = format!(
            "gives pixel {{{last}.addr}} its texel ({{{last}.lx}}, {{{last}.ly}}) and depth {{{last}.lz}}."
        );
        view.says(goes, &gives);
        let stands = self.projected().is_some() && !projected_ready;
        view.says(stands, &format!("stands still: SHADOW does not take pixel {{{last}.addr}}."));
        view.gives("projected", Some("shadow"), self.projected().is_some(), projected_ready);
    }

    /// Stage 0 first; serial there is one.
    fn stages(&self) -> Vec<Option<&Fragment<C>>> {
        match &self.rows {
            Rows::Pipelined(stages) => stages.iter().collect(),
            Rows::Serial { fragment, .. } => vec![fragment.as_ref()],
        }
    }
}
