//! DEPTH: reads the old depth of every fragment, compares, and writes what passes.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::depth::SPEC;
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::ports::Interface;
use crate::rmw::{self, Rmw};

const DOC: &str = "DEPTH reads the old depth of every fragment, compares, and writes what passes.

           ┌──────────────── rd (address) ──> depth memory
  frag ────┴─> [in-flight queue] ─┬─ compare ─> [w] ── wr ──> depth and frame memory
           depth memory ── data ──┘

Formats: unsigned depths; depth_func 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal, 6 gequal, 7 always.
Timing: a fragment is read in the cycle it comes, compared in the cycle its old depth comes, written in the next.
Rules: depths come in the order of the reads. depth_func and depth_write stay as they are while the machine is busy.
The depth is read whatever the function.";

/// The netlist of DEPTH.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn depth(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    crate::blend::refuse(plan)?;
    let m = Module::new("edgewalk_depth", DOC);
    m.doc(&rmw::hazard_doc(plan, "depth"));
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (depth_func, depth_write) = (ports.constant("depth_func"), ports.constant("depth_write"));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("depth");
    let wr_ready = ports.gives_ready();

    m.comment("State: the queue of what waits for its old depth, and the pixel being written.");
    let flight = Rmw::new(&m, plan, &ports, "depth", depth_write);

    m.comment("A fragment enters when the queue has room and nothing in flight may change its depth.");
    let enter = flight.enter(frag_valid, &frag, memory.read_ready);

    m.comment("Compare the head with its old depth when that comes and w is free.");
    let compare = flight.turn(memory.data_valid, wr_ready, "compare");
    let new = flight.head("z");
    let old = flight.old("z", &memory.data).named_doc("old", "depth to compare with");
    let less = new.lt(old).named("less");
    let equal = new.eq(old).named("equal");
    // The three bits of depth_func are the three outcomes that pass: greater, equal, less.
    let pass =
        ((depth_func.bit(0) & less) | (depth_func.bit(1) & equal) | (depth_func.bit(2) & !less & !equal))
            .named("pass");
    flight.finish(&frag, &enter, &compare, wr_ready, pass, |f| flight.head(f));

    let (wr_valid, wr) = flight.write();
    ports.take_ready(enter.frag_ready);
    ports.read("depth", enter.read_valid, frag["addr"], compare.data_ready);
    ports.give(wr_valid, |f| wr[f]);
    ports.status("hazard", enter.hazard);
    ports.status("full", enter.full);
    ports.status("occupied", flight.any());
    m.finish()
}
