//! DEPTH: reads the old depth of every fragment, compares, and writes what passes.

use std::sync::Arc;

use edgewalk_machine::{Hazard, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::token::{self, Registers, Token};

const DOC: &str = "DEPTH reads the old depth of every fragment, compares, and writes what passes.

           ┌──────────────── rd (address) ──> depth memory
  frag ────┴─> [in-flight queue] ─┬─ compare ─> [w] ── wr ──> depth and frame memory
           depth memory ── data ──┘

Formats: unsigned depths; depth_func 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal, 6 gequal, 7 always.
Timing: a fragment is read in the cycle it comes, compared in the cycle its old depth comes, written in the next.
Rules: depths come in the order of the reads. depth_func and depth_write stay as they are while the machine is busy.
The depth is read whatever the function.";

/// What is in flight.
struct InFlight<'m> {
    places: Vec<Place<'m>>,
    /// Entries taken, from place 0.
    count: Reg<'m>,
    w_valid: Reg<'m>,
    w: Registers<'m>,
}

/// One place of the queue.
struct Place<'m> {
    entry: Registers<'m>,
    forwarded: Option<Forwarded<'m>>,
}

/// The depth that an older fragment writes to an entry's pixel; only in machines that forward.
struct Forwarded<'m> {
    valid: Reg<'m>,
    z: Reg<'m>,
}

/// How the queue moves in this cycle.
struct Moves<'m> {
    /// The head leaves.
    compare: Signal<'m>,
    /// The head leaves, and writes its depth.
    passed_z: Signal<'m>,
    /// For each place: what enters goes there.
    enters: Vec<Signal<'m>>,
}

/// The netlist of DEPTH.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn depth(machine: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_depth", DOC);
    m.doc(match machine.hazard {
        Hazard::Drain => "Hazard: a fragment with fence waits until nothing is in flight.",
        Hazard::Interlock => {
            "Hazard: a fragment waits while one of its own address is in flight and may change its depth."
        }
        Hazard::Forward => {
            "Hazard: a fragment takes the depth from the last older fragment that writes its pixel."
        }
    });
    let depth_func = m.input_doc("depth_func", 3, "new ? old");
    let depth_write = m.input_doc("depth_write", 1, "depths of passing fragments are written");
    let frag_valid = m.input("frag_valid", 1);
    let frag = Token::inputs(&m, "frag", token::fragment(machine));
    let rd_ready = m.input("rd_ready", 1);
    let data_valid = m.input("data_valid", 1);
    let data_z = m.input_doc("data_z", machine.z.bits, "old depth");
    let wr_ready = m.input("wr_ready", 1);

    m.comment("State: the queue of what waits for its old depth, and the pixel being written.");
    let flight = InFlight::new(&m, machine);
    let InFlight { places, count, w_valid, w } = &flight;
    let head = &places[0];

    m.comment("A fragment enters when the queue has room and nothing in flight may change its depth.");
    let full = count.q().eq(machine.inflight as i32).named("full");
    let hazard = flight.hazard(machine, &frag, depth_write).named("hazard");
    let clear = (!full & !hazard).named("clear_to_read");
    let rd_valid = (frag_valid & clear).named("rd_valid");
    let frag_ready = (rd_ready & clear).named("frag_ready");
    let push = (rd_valid & rd_ready).named("push");

    m.comment("Compare the head with its old depth when that comes and w is free.");
    let w_free = (!w_valid.q() | wr_ready).named("w_free");
    let data_ready = (count.q().any() & w_free).named("data_ready");
    let compare = (data_valid & data_ready).named("compare");
    let new = head.entry["z"].q();
    let old =
        head.forwarded.as_ref().map_or(data_z, |forwarded| forwarded.valid.q().mux(forwarded.z, data_z));
    let old = old.named_doc("old", "depth to compare with");
    let less = new.lt(old).named("less");
    let equal = new.eq(old).named("equal");
    // The three bits of depth_func are the three outcomes that pass: greater, equal, less.
    let pass =
        ((depth_func.bit(0) & less) | (depth_func.bit(1) & equal) | (depth_func.bit(2) & !less & !equal))
            .named("pass");

    m.comment("Write what passes.");
    w_valid.when(wr_ready, 0).when(compare, pass);
    let passed = (compare & pass).named("passed");
    w.load(passed, |f| if f == "z_en" { depth_write } else { head.entry[f].q() });

    m.comment("The queue moves up at a compare; what enters goes behind the last.");
    count.when(push & !compare, count.q() + 1).when(compare & !push, count.q() - 1);
    let end = compare.mux(count.q() - 1, *count).named("end_place");
    let enters = |i| (push & end.eq(i as i32)).named(&format!("enters{i}"));
    let enters: Vec<Signal> = (0..places.len()).map(enters).collect();
    for (i, place) in places.iter().enumerate() {
        if let Some(behind) = places.get(i + 1) {
            place.entry.load(compare, |f| behind.entry[f].q());
        }
        place.entry.load(enters[i], |f| frag[f]);
    }
    let passed_z = passed & depth_write;
    flight.forward(&m, &frag, &Moves { compare, passed_z, enters });

    m.output("frag_ready", frag_ready);
    m.output("rd_valid", rd_valid);
    m.output("rd_addr", frag["addr"]);
    m.output("data_ready", data_ready);
    m.output("wr_valid", *w_valid);
    w.token().output(&m, "wr");
    m.output_doc("hazard", hazard, "the fragment must wait for one in flight");
    m.output_doc("full", full, "the in-flight queue is full");
    m.output_doc("occupied", flight.any(), "something is in flight");
    m.finish()
}

impl<'m> InFlight<'m> {
    fn new(m: &'m Module, machine: &Plan) -> InFlight<'m> {
        let bits = (machine.inflight + 1).next_power_of_two().ilog2();
        let count = m.reg("count", bits).doc("fragments in flight").reset(0);
        let place = |i| Place {
            entry: Registers::new(m, &format!("place{i}"), token::entry(machine)),
            forwarded: (machine.hazard == Hazard::Forward).then(|| Forwarded {
                valid: m.reg(&format!("place{i}_fwd_valid"), 1).doc("an older fragment wrote this pixel"),
                z: m.reg(&format!("place{i}_fwd_z"), machine.z.bits).doc("the depth it wrote"),
            }),
        };
        let places = (0..machine.inflight).map(place).collect();
        let w_valid = m.reg("wr_valid", 1).doc("a pixel is being written").reset(0);
        InFlight { places, count, w_valid, w: Registers::new(m, "wr", token::write(machine)) }
    }

    fn any(&self) -> Signal<'m> {
        self.count.q().any() | self.w_valid
    }

    /// The depth of `addr` is being written.
    fn in_write(&self, addr: Signal<'m>) -> Signal<'m> {
        self.w_valid.q() & self.w["z_en"] & self.w["addr"].q().eq(addr)
    }

    /// The fragment must wait.
    fn hazard(&self, machine: &Plan, frag: &Token<'m>, depth_write: Signal<'m>) -> Signal<'m> {
        let addr = frag["addr"];
        let m = addr.module();
        match machine.hazard {
            Hazard::Drain => frag["fence"] & self.any(),
            Hazard::Interlock => {
                let same = |(i, place): (usize, &Place<'m>)| {
                    let same = self.count.q().gt(i as i32) & place.entry["addr"].q().eq(addr);
                    same.named(&format!("same{i}"))
                };
                let in_queue = self.places.iter().enumerate().map(same);
                depth_write & in_queue.fold(self.in_write(addr), |any, one| any | one)
            }
            Hazard::Forward => m.lit(1, 0),
        }
    }

    /// Younger fragments take the depth of the one that passes; one that enters, also the depth being written.
    fn forward(&self, m: &'m Module, frag: &Token<'m>, moves: &Moves<'m>) {
        let Some(head) = self.places.first().filter(|head| head.forwarded.is_some()) else { return };
        m.comment("Forward: a depth that passes goes to every younger fragment of its pixel.");
        let (addr, z) = (head.entry["addr"].q(), head.entry["z"].q());
        let passes = |other: Signal<'m>| moves.passed_z & other.eq(addr);
        let from_head = passes(frag["addr"]).named("enters_after_head");
        let from_w = self.in_write(frag["addr"]).named("enters_after_w");
        let behind = self.places.iter().skip(1).map(Some).chain([None]);
        for ((i, place), behind) in self.places.iter().enumerate().zip(behind) {
            let Some(own) = &place.forwarded else { continue };
            if let Some(Place { entry, forwarded: Some(from), .. }) = behind {
                let same = passes(entry["addr"].q()).named(&format!("place{}_after_head", i + 1));
                own.valid.when(moves.compare, from.valid.q() | same);
                own.z.when(moves.compare, same.mux(z, from.z));
            }
            own.valid.when(moves.enters[i], from_head | from_w);
            own.z.when(moves.enters[i], from_head.mux(z, self.w["z"]));
        }
    }
}
