//! BLEND: weighs the colour of a fragment against that of its pixel, or adds it.

mod prepare;

mod step;

mod stages;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{blend::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::ports::Interface;
use crate::rmw::{self, Leaves, Rmw, Shape};
use crate::wires::{Part, parts};
use prepare::Old;
use stages::Stages;

const DOC: &str = "BLEND mixes the colour of a fragment with the colour of its pixel, or adds the two.

            ┌────────────── crd (address) ──> colour memory
  pass ─────┴─> [queue] ── base, weight ─> [stage] ─> [w] ── cwr ──> colour memory
           colour memory ── cdata ──┘

Formats: colours unsigned; kt from 0 to 2^kt_bits, which is exactly 1.
Mixing: with old colour B and own colour I the result is base + (I - base) * weight, to nearest.
  mix           base = B, weight = 1 - kt, from 0 to below 1
  mix, kt = 0   base = I
  add           base = I + B, saturated, weight = 0
Rules: a fragment that is mixed with kt = 0 reads no old colour. Colours arrive in the order of the reads. blend_add is
stable while the machine is busy.";

/// The netlist of BLEND.
///
/// # Errors
/// None for a machine with BLEND that [`edgewalk_machine::Machine::plan`] accepts.
pub fn blend(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_blend", DOC);
    m.doc(step::doc(plan.blend.multipliers));
    m.doc(&rmw::hazard_doc(plan.blend.hazard, "colour"));
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let blend_add = ports.constant("blend_add");
    let (pass_valid, pass) = ports.takes();
    let memory = ports.memory("color");
    let cwr_ready = ports.gives_ready();

    m.comment("State: the stages, the queue of fragments that wait for their old colours, and the write register w.");
    let mut carried = parts(&tokens::color_write(plan));
    carried.retain(|part| part.name != "rgb");
    let stages = Stages::new(&m, plan, carried);
    let mut entry = pass.parts();
    entry.retain(|part| part.name != "fence");
    entry.push(Part {
        name: "need".to_owned(),
        width: 1,
        doc: "the fragment needs the old colour".to_owned(),
    });
    let shape = Shape {
        memory: "color",
        hazard: plan.blend.hazard,
        places: plan.blend.queue,
        entry,
        writes: None,
        stages: stages.in_flight(),
        ways: &[("cwr", "w holds a pixel to write")],
        write: ("cwr", parts(&ports.gives_link().fields)),
    };
    let flight = Rmw::new(&m, &ports, shape);

    m.comment(
        "A fragment enters when the queue has room and no fragment in flight may change the colour that it needs.",
    );
    let need = (blend_add | pass["kt"].any()).named_doc("need", "the fragment needs the old colour");
    let enter = flight.enter(pass_valid, &pass, Some(need), memory.read_ready);

    m.comment("The head leaves when its old colour arrives and the first stage is free.");
    let w_free = flight.w_free(&[cwr_ready]);
    let flow = stages.flow(w_free);
    let take = flight.turn(memory.data_valid, flow.room, "take");
    let old = Old { add: blend_add, need: flight.head("need"), rgb: flight.old("rgb", &memory.data) };
    let prepared = old.prepare(&m, plan, |f| flight.head(f));
    let rgb = stages.step(&flow, take.fires, &prepared, |f| flight.head(f)).named("rgb");

    m.comment("Write the blended colour.");
    let leaves = Leaves { ready: cwr_ready, wanted: m.lit(1, 1) };
    let leaving = |f: &str| if f == "rgb" { rgb } else { stages.leaving(f) };
    flight.write(w_free, flow.leaves, &[leaves], leaving);
    flight.move_up(&enter, &take, |f| if f == "need" { need } else { pass[f] });

    ports.take_ready(enter.frag_ready);
    ports.read("color", enter.read_valid, pass["addr"], take.data_ready);
    ports.give(flight.valid(0), |f| flight.written(f));
    ports.status("color_hazard", enter.hazard);
    ports.status("color_full", enter.full);
    ports.status("occupied", flight.any());
    m.finish()
}
