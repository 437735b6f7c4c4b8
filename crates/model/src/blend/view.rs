//! What is to be seen of BLEND.

use super::{Blend, BlendInputs, Block, Colour, Side};
use crate::rmw::Outcome;
use crate::tokens::Fragment;
use crate::view::{Id, Shape, View, fragments};
use edgewalk_machine::Plan;

impl<const C: usize> Blend<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(&self, plan: &Plan, pass: Option<&Fragment<C>>, inputs: &BlendInputs, view: &mut View) {
        view.unit(plan, "blend");
        let bits = (plan.blend.queue + 1).next_power_of_two().ilog2();
        let (kind, title) = fragments::seen(plan);
        view.kind(kind, title, || fragments::seen_fields(plan));
        view.triangle(self.triangle(pass));
        let queued =
            view.number("queued", "fragments that wait for their old colour", bits, self.rmw.len() as u64);
        view.wire(|| "count".to_owned());
        self.view_queue(plan, view);
        self.view_stages(plan, view);
        let w = self.rmw.write();
        let waiting = view.guard("w_valid", "a colour is being written", w.is_some());
        view.wire(|| "cwr_valid".to_owned());
        view.live(Some(waiting));
        view.table("write register", &["fragment", "rgb"], false);
        view.row("w");
        let written = token(plan, w, view, "the colour being written");
        let rgb = w.map_or(0, |w| w.word.rgb);
        view.cell("red, green and blue in one word", || Shape::whole(3 * self.bits), rgb);
        view.wire(|| "cwr_rgb".to_owned());
        view.live(None);
        view.lane(queued, self.occupied());
        self.say(pass, inputs, view);
        let fires = w.is_some() && inputs.cwr_ready;
        let when = view.moment("written", fires, written, &[]);
        view.stores_color(when, written);
        view.takes("cdata", inputs.cdata.is_some(), self.cdata_ready(inputs.cwr_ready));
        view.gives("crd", None, self.read(pass, inputs.add).is_some(), inputs.crd_ready);
        view.gives("cwr", None, w.is_some(), inputs.cwr_ready);
        view.step("write", 'w');
    }

    /// Of the oldest token.
    fn triangle(&self, pass: Option<&Fragment<C>>) -> Option<u32> {
        let staged = self.stages.iter().rev().flatten().next();
        let done = self.rmw.write().or(staged).map(|result| result.side.frag.source.id);
        done.or(self.rmw.flight(0).map(|flight| flight.side.frag.source.id))
            .or(pass.map(|pass| pass.source.id))
    }

    fn view_queue(&self, plan: &Plan, view: &mut View) {
        let (kind, _) = fragments::seen(plan);
        view.table(&format!("queue of {}", self.rmw.places()), &["fragment", "k", "need", "fwd"], false);
        for place in 0..self.rmw.places() {
            let flight = self.rmw.flight(place);
            let values = flight
                .as_ref()
                .map(|f| fragments::seen_values(plan, f.addr, &f.side.frag.values, f.side.frag.lit));
            let shown = flight.as_ref().zip(values.as_ref());
            view.row(&if place == 0 { "head".to_owned() } else { place.to_string() });
            let shown = shown.map(|(flight, values)| (flight.side.frag.source.id, &values[..]));
            let fragment = view.token_cell("a fragment that waits", kind, shown);
            view.live(Some(fragment));
            let side = flight.as_ref().map(|flight| flight.side);
            let k = side.map_or(0, |side| side.k);
            view.cell("k_t, times 2^kt_bits", || Shape::whole(self.kt_bits + 1), k.into());
            view.cell("the colour of its pixel counts", || Shape::Flag, side.is_some_and(|s| s.need).into());
            view.wire(|| format!("place{place}_need"));
            let forwarded = flight.is_some_and(|flight| flight.forward.is_some());
            view.cell("an older fragment left that colour", || Shape::Flag, forwarded.into());
            view.live(None);
        }
    }

    fn view_stages(&self, plan: &Plan, view: &mut View) {
        view.table("stages", &["fragment"], false);
        for (number, stage) in self.stages[..=self.last].iter().enumerate() {
            view.row(&format!("stage{number}"));
            token(plan, stage.as_ref(), view, "a fragment that is weighed, its colour as it will be");
        }
        let works = view.guard("stage0_valid", "a fragment is weighed", self.stages[0].is_some());
        view.wire(|| "stage0_valid".to_owned());
        view.live(Some(works));
        view.number("work", "clocks that stage 0 still needs", 4, self.work);
        view.live(None);
    }

    fn say(&self, pass: Option<&Fragment<C>>, inputs: &BlendInputs, view: &mut View) {
        let block = self.block(pass, inputs.add);
        let (there, reads) = (pass.is_some(), self.read(pass, inputs.add).is_some());
        view.says(reads && inputs.crd_ready, "takes a fragment and reads the colour of its pixel.");
        view.says(reads && !inputs.crd_ready, "waits: the memory takes no read.");
        let opaque = there && block.is_none() && !reads;
        view.says(opaque, "takes a fragment that is opaque: no colour is read.");
        view.says(there && block == Some(Block::Hazard), "holds a fragment back: its pixel is in flight.");
        view.says(there && block == Some(Block::Full), "is full: {queued} fragments wait.");
        view.says(self.head_waits(), "the oldest waits for a result of its own pixel.");
        let weighs = self.stages[0].is_some();
        view.says(weighs && !self.done(), "weighs pixel {stage0.addr}: {work} clocks more.");
        view.says(weighs && self.done(), "has weighed pixel {stage0.addr}.");
        let writes = self.rmw.write().is_some();
        view.says(
            writes && inputs.cwr_ready,
            "writes the colour of pixel {w.addr}; the picture shows it from the next cycle on.",
        );
        view.says(writes && !inputs.cwr_ready, "waits: the memory takes no write.");
    }
}

/// A result as a cell.
fn token<const C: usize>(
    plan: &Plan,
    result: Option<&Outcome<Colour, Side<C>>>,
    view: &mut View,
    doc: &str,
) -> Id {
    let of = |result: &Outcome<Colour, Side<C>>| {
        fragments::seen_values(plan, result.addr, &result.side.frag.values, result.side.frag.lit)
    };
    let (values, (kind, _)) = (result.map(of), fragments::seen(plan));
    let shown = result.zip(values.as_ref());
    view.token_cell(doc, kind, shown.map(|(result, values)| (result.side.frag.source.id, &values[..])))
}
