//! The one cause of every cycle (`docs/machine.md`, section 8), from what the units tell.

use edgewalk_machine::Activity;
use edgewalk_netlist::{Module, Signal};

use super::joined::{Joined, port};

/// The first cause that holds.
pub(super) fn activity<'m>(m: &'m Module, units: &Joined<'m>) -> Signal<'m> {
    let cause = |a: Activity| m.constant(&a.name().to_uppercase(), Activity::BITS, a as u128);
    let (draw, offscreen) = (cause(Activity::Draw), cause(Activity::Offscreen));
    let (hazard, queue, memory) = (cause(Activity::Hazard), cause(Activity::Queue), cause(Activity::Memory));
    let (edge, setup) = (cause(Activity::Edge), cause(Activity::Setup));
    let (flush, idle) = (cause(Activity::Flush), cause(Activity::Idle));

    let advance = units.any("advance");
    let in_flight = units.any("occupied");
    // DEPTH is full because BLEND takes nothing.
    let queue = units.keeps_waiting("pass").map_or(queue, |waits| waits.mux(cause(Activity::Blend), queue));
    let waits = units.any("hazard").mux(hazard, units.any("full").mux(queue, memory));
    // The own doing of a unit that reads a memory, if it takes nothing for want of a read, or of the word of one.
    let own_doing = |full: &str, gives: &str| units.find(full).map(|full| !full | !units.valid(gives));
    let light = own_doing("shadow_full", "shaded");
    let waits = light.map_or(waits, |light| light.mux(cause(Activity::Light), waits));
    let waits = units.find("dividing").map_or(waits, |no| no.mux(cause(Activity::Project), waits));
    let shading = ["table_wait", "working"]
        .into_iter()
        .filter_map(|told| units.find(told))
        .reduce(|any, one| any | one);
    let waits = shading.map_or(waits, |no| no.mux(cause(Activity::Shade), waits));
    let texel = own_doing("texel_full", "textured");
    let waits = texel.map_or(waits, |texel| texel.mux(cause(Activity::Texel), waits));
    let lower = in_flight.mux(flush, idle);
    let source = units.source();
    let lower = (!units.ready_for(source)).mux(setup, lower);
    let lines = units.valid("span") | units.any("line_held") | units.valid("line");
    let lower = lines.mux(edge, lower);
    let lower = units.find("term_wait").map_or(lower, |no| no.mux(cause(Activity::Term), lower));
    let draws = units.any("visible").mux(draw, offscreen);
    advance.mux(units.any("active").mux(draws, lower), waits)
}

impl<'m> Joined<'m> {
    /// One of the units tells this.
    fn any(&self, name: &str) -> Signal<'m> {
        self.find(name).expect("SPAN, PIXEL and DEPTH are in every machine")
    }

    /// The status of this name, from any unit; `None` if the machine has no unit that tells it.
    fn find(&self, name: &str) -> Option<Signal<'m>> {
        let told = (0..self.0.len()).filter_map(|place| self.told(place, name));
        told.reduce(|any, one| any | one)
    }

    /// A unit's status, 0 while it is don't care; `None` if the unit has no such status.
    fn told(&self, place: usize, name: &str) -> Option<Signal<'m>> {
        let unit = &self.0[place];
        let status = unit.status(name)?;
        let told = unit.instance.output(name);
        let Some(during) = status.during else { return Some(told) };
        let is_pixel = |place: usize| self.0[place].status("advance").is_some();
        let waits_for_token = during == port(unit.outside.takes_link(), "valid");
        match place.checked_sub(1) {
            // `visible` is asked only while PIXEL is active.
            _ if is_pixel(place) => Some(told),
            // A wait is asked only while PIXEL does not advance: then its fragment is there.
            Some(before) if waits_for_token && is_pixel(before) => Some(told),
            Some(before) if waits_for_token => {
                let Joined(units) = self;
                let given = port(units[before].outside.gives_link(), "valid");
                Some(told & units[before].instance.output(&given))
            }
            _ => Some(told & unit.instance.output(during)),
        }
    }
}
