//! SHADE: makes the colour of a fragment of its cosines, by tables that hold the material.

mod tables;

mod index;

mod weaken;

mod colour;

use std::sync::Arc;

use edgewalk_machine::units::{shade::SPEC, tokens};
use edgewalk_machine::{Plan, ShadeColour};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::ports::Interface;
use crate::wires::{Registers, parts};
use colour::{COLOURS, Shone};
use index::Index;
use tables::Tables;
use weaken::{BEAM, weakened};

const DOC: &str = "SHADE makes the colour of a fragment from its cosines, by tables of the material.

  frag ─> index ─> [A] ─> tables T, S ─> [B] ─────────> sum ─> [C] ─> tinted
  material ─ srd (address) ─> tables memory ─ sdata ─┘

Formats: nl* and nh* are signed, in entries of a table, and saturate at its ends. T holds the diffuse light, S the highlight,
in LSB of the colour. Where nl is below 0, the highlight is 0. Sums saturate at the largest colour.
Timing: a fragment a clock, offered three clocks after it was taken, with stages L and M five. All stages advance together.
Rules: the unit holds the tables of one material. A fragment of another material waits until the stages are empty and its
tables have been fetched, a word a clock.";

const WEAKEN_DOC: &str = "Behind LAMP: a fragment also brings beam, 2^16 for all of the light. Behind B stage [G] multiplies the highlight by beam.";

const MULTIPLY_DOC: &str = "Multiplied: T holds the light, 2^(b+2) for 1.0. Between B and C stage [L] sums the lights, and stage [M] multiplies the fragment's colour by the light.";

/// The netlist of SHADE.
///
/// # Errors
/// None for a machine with SHADE that [`edgewalk_machine::Machine::plan`] accepts.
pub fn shade(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_shade", DOC);
    let multiplies = plan.shade.colour == ShadeColour::Multiply;
    if multiplies {
        m.doc(MULTIPLY_DOC);
    }
    let weakens = plan.shade.is_positional();
    if weakens {
        m.doc(WEAKEN_DOC);
    }
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("tables");
    let tinted_ready = ports.gives_ready();

    m.comment("Stages, and the fields that pass through them unchanged.");
    let names: &[&str] = match (weakens, multiplies) {
        (false, false) => &["a", "b", "c"],
        (false, true) => &["a", "b", "l", "m", "c"],
        (true, false) => &["a", "b", "g", "c"],
        (true, true) => &["a", "b", "g", "l", "m", "c"],
    };
    let tinted = parts(&tokens::tinted(plan));
    let beam: Vec<_> = frag.parts().into_iter().filter(|part| part.name == BEAM).collect();
    let stages: Vec<Stage> = names
        .iter()
        .map(|name| {
            // The triangle's colour goes as far as it is multiplied, and so does the beam.
            let colour = multiplies && ["a", "b", "g", "l"].contains(name);
            let of_beam = beam.iter().filter(|_| ["a", "b"].contains(name));
            let is_kept = |part: &str| colour || !COLOURS.contains(&part);
            let kept = tinted.iter().filter(|part| is_kept(&part.name)).chain(of_beam).cloned().collect();
            let valid = m.reg(&format!("{name}_valid"), 1).doc("the stage holds a fragment").reset(0);
            Stage { valid, kept: Registers::new(&m, name, kept) }
        })
        .collect();
    let last = stages[stages.len() - 1].valid.q();
    let advance = (!last | tinted_ready).named_doc("advance", "all stages advance");
    let occupied = stages.iter().map(|stage| stage.valid.q()).reduce(|any, one| any | one);
    let occupied = occupied.expect("there are three stages at least").named("occupied");

    let tables = Tables::new(&m, plan, &memory, frag_valid, frag.get("material"), occupied);
    let frag_ready = (advance & tables.fits).named("frag_ready");
    let take = (frag_valid & frag_ready).named("take");
    let mut valid = take;
    let mut before = frag.clone();
    for Stage { valid: filled, kept } in &stages {
        filled.when(advance, valid);
        kept.load(advance, |f| before[f]);
        (valid, before) = (filled.q(), kept.token());
    }

    m.comment("Stage A: entries of the tables.");
    let indices: Vec<Index> =
        (0..plan.shade.lights).map(|light| Index::new(&m, plan, light, &frag, advance)).collect();
    let lights = tables.look_up(&m, advance, &indices);
    let lights = if weakens { weakened(&m, plan, advance, stages[1].kept[BEAM].q(), lights) } else { lights };
    let shone = Shone { m: &m, plan, advance, lights };
    // Behind B, and G if it is there.
    let beside_light = &stages[if weakens { 3 } else { 2 }].kept;
    let colours = if multiplies { shone.multiplied(beside_light) } else { shone.told() };

    ports.take_ready(frag_ready);
    ports.read("tables", tables.read_valid, tables.read_place, tables.loading);
    ports.give(last, |f| match COLOURS.iter().position(|colour| *colour == f) {
        Some(i) => colours[i].q(),
        None => before[f],
    });
    ports.status("table_wait", frag_valid & !tables.fits);
    ports.status("occupied", occupied);
    m.finish()
}

/// A fragment on its way.
struct Stage<'m> {
    valid: Reg<'m>,
    kept: Registers<'m>,
}

/// The largest number of so many bits.
fn largest(m: &Module, bits: u32) -> Signal<'_> {
    m.lit(bits, u128::MAX >> (128 - bits))
}
