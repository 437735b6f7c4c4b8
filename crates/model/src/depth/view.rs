//! What is to be seen of DEPTH.

use super::{Block, Depth, DepthInputs};
use crate::tokens::Fragment;
use crate::view::{Id, Shape, View, fragments, output};
use edgewalk_machine::{Hazard, Plan};

impl<const C: usize> Depth<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(&self, plan: &Plan, frag: Option<&Fragment<C>>, inputs: &DepthInputs, view: &mut View) {
        view.unit(plan, "depth");
        let block = self.block(frag, inputs.depth_write);
        let read = frag.filter(|_| block.is_none() && inputs.rd_ready);
        let bits = (plan.inflight + 1).next_power_of_two().ilog2();
        view.triangle(self.triangle(frag));
        let (kind, title) = fragments::seen(plan);
        view.kind(kind, title, || fragments::seen_fields(plan));
        let queued = view.number("queued", "fragments in flight", bits, self.rmw.len() as u64);
        view.wire(|| "count".to_owned());
        let head = self.view_queue(plan, view);
        let compared = inputs.data.filter(|_| self.data_ready(inputs.wr_ready, inputs.pass_ready));
        let tells = self.view_compare(plan, compared, inputs.depth_func, view);
        let written = self.view_write(plan, view);
        view.lane(queued, self.occupied());
        self.say(frag, block, inputs, compared.is_some(), view);

        let offered = frag
            .map(|frag| (frag.source.id, fragments::seen_values(plan, frag.addr, &frag.values, frag.lit)));
        let offered = view.aside(
            "offered",
            "the fragment at the door",
            kind,
            offered.as_ref().map(|(id, values)| (*id, &values[..])),
        );
        let fires = self.rmw.write().is_some() && inputs.wr_ready;
        view.moment("fragment", read.is_some(), offered, &[]);
        view.moment("compare", compared.is_some(), head, &tells);
        let when = view.moment(if self.forks() { "depth" } else { "written" }, fires, written.0, &[]);
        view.stores_depth(when, written.0, written.1);
        view.takes("data", inputs.data.is_some(), self.data_ready(inputs.wr_ready, inputs.pass_ready));
        view.gives("rd", None, frag.is_some() && block.is_none(), inputs.rd_ready);
        if self.forks() {
            view.gives("zwr", None, self.rmw.write().is_some(), inputs.wr_ready);
            view.gives("pass", Some("blend"), self.pass().is_some(), inputs.pass_ready);
        } else {
            view.stores_color(when, written.0);
            view.gives("wr", None, self.rmw.write().is_some(), inputs.wr_ready);
            view.step("write", 'w');
        }
    }

    /// Gives the fragment in w, and the flag that says whether its depth is written.
    fn view_write(&self, plan: &Plan, view: &mut View) -> (Id, Option<Id>) {
        let (forks, (kind, _)) = (self.forks(), fragments::seen(plan));
        let waiting = view.guard("w_valid", "a pixel is being written", self.rmw.write().is_some());
        view.wire(|| if forks { "zwr_valid" } else { "wr_valid" }.to_owned());
        let w = self.rmw.write();
        let values = w.map(|w| fragments::seen_values(plan, w.addr, &w.side.values, w.side.lit));
        let token = w.zip(values.as_ref()).map(|(w, values)| (w.side.source.id, &values[..]));
        view.table("write register", if forks { &["fragment"] } else { &["fragment", "z_en"] }, false);
        view.row("w");
        view.live(Some(waiting));
        let written = view.token_cell("the pixel being written", kind, token);
        let mut with_depth = None;
        if forks {
            let passes = self.pass();
            let values = passes.map(|pass| fragments::seen_values(plan, pass.addr, &pass.values, pass.lit));
            let token = passes.zip(values.as_ref()).map(|(pass, values)| (pass.source.id, &values[..]));
            view.live(None);
            view.row("pass");
            view.token_cell("the fragment on its way to BLEND", kind, token);
        } else {
            view.wire(|| "wr".to_owned());
            let stored = w.is_some_and(|w| w.stored);
            with_depth = Some(view.cell("its depth is written too", || Shape::Flag, stored.into()));
            view.wire(|| "wr_z_en".to_owned());
        }
        view.live(None);
        (written, with_depth)
    }

    /// Of the oldest token.
    fn triangle(&self, frag: Option<&Fragment<C>>) -> Option<u32> {
        let written = self.rmw.write().map(|w| w.side.source.id);
        let queued = self.rmw.flight(0).map(|flight| flight.side.source.id);
        written.or(queued).or(frag.map(|frag| frag.source.id))
    }

    /// Gives the head.
    fn view_queue(&self, plan: &Plan, view: &mut View) -> Id {
        let (kind, _) = fragments::seen(plan);
        let forwards = plan.hazard == Hazard::Forward;
        let columns: &[&str] = if forwards { &["fragment", "fwd", "from"] } else { &["fragment"] };
        view.table(&format!("in flight, {} places", self.rmw.places()), columns, false);
        let mut head = 0;
        for place in 0..self.rmw.places() {
            let flight = self.rmw.flight(place);
            let values =
                flight.as_ref().map(|f| fragments::seen_values(plan, f.addr, &f.side.values, f.side.lit));
            let token = flight.as_ref().zip(values.as_ref());
            view.row(&if place == 0 { "head".to_owned() } else { place.to_string() });
            let cell = view.token_cell(
                "a fragment that waits for its old depth",
                kind,
                token.map(|(flight, values)| (flight.side.source.id, &values[..])),
            );
            view.wire(|| format!("place{place}"));
            head = if place == 0 { cell } else { head };
            if forwards {
                let forward = flight.and_then(|flight| flight.forward);
                let live =
                    view.cell("an older fragment wrote this pixel", || Shape::Flag, forward.is_some().into());
                view.live(Some(live));
                let z = || output(&plan.channels()[0]);
                view.cell("the depth it wrote", z, forward.unwrap_or(0).into());
                view.live(None);
            }
        }
        head
    }

    /// Gives what is told of a compare.
    fn view_compare(&self, plan: &Plan, data: Option<u64>, depth_func: u8, view: &mut View) -> [Id; 2] {
        let head = self.rmw.flight(0).filter(|_| data.is_some());
        let new = head.as_ref().map_or(0, |head| u64::from(head.side.values[0]));
        let old = head.and_then(|head| head.forward.map(u64::from)).or(data).unwrap_or(0);
        let relation = u8::from(new > old) + u8::from(new >= old);
        let passes = data.is_some() && depth_func >> relation & 1 != 0;
        let compares = view.guard("compares", "the head and its old depth", data.is_some());
        view.wire(|| "compare".to_owned());
        view.live(Some(compares));
        let z = plan.channels()[0].bits;
        view.number("new", "depth of the head", z, new);
        let stored = view.number("stored", "old depth", z, old);
        let pass = view.flag("passes", "the new one wins", passes);
        view.wire(|| "pass".to_owned());
        view.live(None);
        [stored, pass]
    }

    fn say(
        &self,
        frag: Option<&Fragment<C>>,
        block: Option<Block>,
        inputs: &DepthInputs,
        compares: bool,
        view: &mut View,
    ) {
        let offered = frag.is_some();
        view.says(
            offered && block.is_none() && inputs.rd_ready,
            "reads the stored depth of pixel {offered.addr}.",
        );
        view.says(
            offered && block == Some(Block::Hazard),
            "holds pixel {offered.addr} back: it may still be in flight.",
        );
        view.says(
            offered && block == Some(Block::Full),
            "is full: {queued} fragments wait for their depths.",
        );
        view.says(offered && block.is_none() && !inputs.rd_ready, "waits: the memory takes no read.");
        let forwarded = self.rmw.flight(0).is_some_and(|head| head.forward.is_some());
        view.says(compares, "compares pixel {head.addr}: new {new}, stored {stored}; passes: {passes}.");
        view.says(compares && forwarded, "the stored depth is that of an older fragment in flight.");
        let (writes, passes) = (self.rmw.write().is_some(), self.pass().is_some());
        view.says(
            writes && inputs.wr_ready,
            "writes pixel {w.addr}; memory shows it from the next cycle on.",
        );
        if self.forks() {
            view.says(passes && inputs.pass_ready, "hands pixel {pass.addr} on to BLEND.");
            view.says(passes && !inputs.pass_ready, "waits with pixel {pass.addr}: BLEND takes none.");
        }
        view.says(writes && !inputs.wr_ready, "waits: the memory takes no write.");
    }
}
