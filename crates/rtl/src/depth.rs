//! DEPTH: reads the old depth of every fragment, compares, and writes a fragment that passes.

use std::sync::Arc;

use edgewalk_machine::units::depth::SPEC;
use edgewalk_machine::{Hazard, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::ports::Interface;
use crate::rmw::{self, Leaves, Rmw, Shape, Way};
use crate::wires::parts;

const DOC: &str = "DEPTH reads the old depth of every fragment, compares, and writes a fragment that passes.

           ┌──────────────── rd (address) ──> depth memory
  frag ────┴─> [in-flight queue] ─┬─ compare ─> [w] ── wr ──> depth and frame memory
           depth memory ── data ──┘

Formats: unsigned depths; depth_func 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal, 6 gequal, 7 always.
Timing: the read leaves in the cycle in which a fragment enters. The compare takes place in the cycle in which the old
depth arrives. The write follows one cycle later.
Rules: depths arrive in the order of the reads. depth_func and depth_write are stable while the machine is busy.
Every fragment reads, whatever the function.";

const FORK_DOC: &str = "With BLEND w has two outputs: zwr takes the depth to its memory, pass takes the fragment to BLEND. Each waits by itself.
A fragment counts as in flight only while it may still write a depth. If a fragment never reaches BLEND, the next one that
does takes over its fence.";

/// The netlist of DEPTH.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn depth(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_depth", DOC);
    let forks = plan.blend.is_there();
    if forks {
        m.doc(FORK_DOC);
    }
    m.doc(&rmw::hazard_doc(plan.hazard, "depth"));
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (depth_func, depth_write) = (ports.constant("depth_func"), ports.constant("depth_write"));
    let color_write = forks.then(|| ports.constant("color_write"));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("depth");
    let ready: Vec<Signal> = ports
        .ports
        .writes
        .iter()
        .map(|link| ports.writes_ready(link.name))
        .chain([ports.gives_ready()])
        .collect();

    m.comment("State: the queue of fragments that wait for their old depths, and the write register w.");
    let flight = Rmw::new(&m, &ports, shape(plan, &ports, depth_write));
    let pend_fence = forks
        .then(|| m.reg("pend_fence", 1).doc("a fence to hand on: its fragment never reaches BLEND").reset(0));

    m.comment(match plan.hazard {
        Hazard::Forward => "A fragment enters while the queue has room: its depth may still be in flight, as it is forwarded.",
        Hazard::Interlock | Hazard::Drain => {
            "A fragment enters while the queue has room and no fragment in flight may change its depth."
        }
    });
    let enter = flight.enter(frag_valid, &frag, None, memory.read_ready);

    m.comment("Compare the head with its old depth when the depth arrives and w is free.");
    let w_free = flight.w_free(&ready);
    let compare = flight.turn(memory.data_valid, w_free, "compare");
    let new = flight.head("z");
    let old = flight.old("z", &memory.data).named_doc("old", "old depth of the head");
    let equal = new.eq(old).named("equal");
    // The three bits of depth_func are the three outcomes that pass: greater, equal, less.
    let [greater_passes, equal_passes, less_passes] = [2, 1, 0].map(|bit| depth_func.bit(bit));
    let unless_less = equal.mux(equal_passes, greater_passes);
    let (if_less, if_not) = match flight.behind_w("z", &frag) {
        None => (less_passes, unless_less),
        Some((after_w, next)) => {
            m.comment("w and the head were compared while w was loaded; here only the outcome is selected.");
            let next_less = next.lt(new).named("next_less");
            let next_equal = next.eq(new).named("next_equal");
            let outcome = next_less.mux(less_passes, next_equal.mux(equal_passes, greater_passes));
            let passes_w = m.reg("passes_w", 1).doc("outcome of the head against w").set(outcome).q();
            (after_w.mux(passes_w, less_passes), after_w.mux(passes_w, unless_less))
        }
    };
    let if_less = if_less.named_doc("if_less", "the head passes if its depth is less");
    let if_not = if_not.named_doc("if_not", "the head passes if its depth is not less");
    m.comment(
        "pass = less ? if_less : if_not. The top bits of the difference make it, so no logic follows the carry.",
    );
    let (may, must) = (if_less | if_not, if_less & if_not);
    let inverts = !if_less | if_not;
    let pass = m.cat(&[inverts, may, new]) - m.cat(&[m.lit(1, 0), !must, old]);
    let pass = pass.named("outcome").msb().named("pass");

    m.comment("Write a fragment that passes.");
    let wanted = match color_write {
        None => vec![pass],
        Some(color_write) => vec![pass & depth_write, pass & color_write],
    };
    let ways: Vec<Leaves> =
        ready.iter().zip(&wanted).map(|(ready, wanted)| Leaves { ready: *ready, wanted: *wanted }).collect();
    let fence = pend_fence.map(|pend| (pend, (flight.head("fence") | pend).named("fence")));
    flight.write(w_free, compare.fires, &ways, |f| match (f, fence) {
        ("z_en", _) => depth_write,
        ("fence", Some((_, fence))) => fence,
        _ => flight.head(f),
    });
    if let (Some((pend, fence)), Some(to_blend)) = (fence, wanted.get(1)) {
        pend.when(compare.fires, fence & !*to_blend);
    }
    flight.move_up(&enter, &compare, |f| frag[f]);

    ports.take_ready(enter.frag_ready);
    ports.read("depth", enter.read_valid, frag["addr"], compare.data_ready);
    for (way, link) in ports.ports.writes.iter().enumerate() {
        ports.write(link.name, flight.valid(way), |f| flight.written(f));
    }
    ports.give(flight.valid(ports.ports.writes.len()), |f| flight.written(f));
    ports.status("hazard", enter.hazard);
    ports.status("full", enter.full);
    ports.status("occupied", flight.any());
    m.finish()
}

/// With BLEND depths and colours leave w each by itself, and fences are handed on.
fn shape<'m>(plan: &Plan, ports: &Interface<'m>, depth_write: Signal<'m>) -> Shape<'static, 'm> {
    let taken = parts(&ports.takes_link().fields);
    let without_fence = taken.iter().filter(|part| part.name != "fence").cloned().collect();
    let (entry, ways, write): (_, &[Way], _) = if plan.blend.is_there() {
        let ways = &[("zwr", "w holds a depth to write"), ("pass", "w holds a fragment for BLEND")];
        (taken.clone(), ways, ("w", taken))
    } else {
        let write = parts(&ports.gives_link().fields);
        (without_fence, &[("wr", "w holds a pixel to write")], ("wr", write))
    };
    let (hazard, places, writes) = (plan.hazard, plan.inflight, Some(depth_write));
    Shape { memory: "depth", hazard, places, entry, writes, stages: Vec::new(), ways, write }
}
