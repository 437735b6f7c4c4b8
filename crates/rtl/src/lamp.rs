//! LAMP: finds the cosines of a light at a point, and how much of it comes.

mod root;

mod multiply;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{lamp::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::cut::cut;
use crate::place::place;
use crate::ports::Interface;
use crate::roots::Roots;
use crate::wires::{Registers, parts};
use multiply::Multiplier;
use root::Root;

const DOC: &str = "LAMP finds the cosines of a light at a point, and how much of it comes.

  frag ─> [kept] ─> root of dd, of nn, of 1 + L.V ─> [k, m] ─> tables ─> [a] * [b] ─> [registers] ─> normed
                                    roots memory ─ rdata ─┘

Formats: dd signed, 2^30 for 1.0; pl, dv, da, pv signed, 2^23; nn signed, 2^16; cosines signed, attenuation and beam, 2^16. Tables hold
{v, slope}: R 1/sqrt(k/256), C the beam beside the axis, A the attenuation; slope is how much less it is one entry on.
Timing: a step a clock, 17 for a fragment. What step s multiplies is there, rounded, in step s + 2.
  step   0    1    2    3    4    5    6    7    8    9    10   11   12   13   14   15
  root   dd                       nn                       LV
  table       R    A                   R         C              R
  a * b       y    att  pl   dv   da   y         cone L    pv   y    beam H    nl
Rules: the tables are fetched once after a reset, when the first fragment comes, a word a clock; until then none is taken.";

/// The step in which a fragment is done.
const LAST: i32 = 16;

/// The netlist of LAMP.
///
/// # Errors
/// None for a machine with LAMP that [`edgewalk_machine::Machine::plan`] accepts.
pub fn lamp(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_lamp", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("roots");
    let normed_ready = ports.gives_ready();
    let roots = Roots::new(&m, plan, "tables R, C, A", frag_valid, &memory);

    m.comment("Which step it is.");
    let busy = m.reg("busy", 1).doc("a fragment is inside").reset(0);
    let step = m.reg("step", 5).doc("steps that are done");
    let done = step.q().eq(LAST).named("done");
    let normed_valid = (busy.q() & done).named("normed_valid");
    let working = (busy.q() & !done).named("working");
    let goes = (normed_valid & normed_ready).named("goes");
    let frag_ready = (roots.have & (!busy.q() | goes)).named("frag_ready");
    let take = (frag_valid & frag_ready).named("take");
    busy.when(goes, 0).when(take, 1);
    step.when(working, step.q() + 1).when(take, 0);
    let at = |number: i32| step.q().eq(number);
    let kept = Registers::new(&m, "kept", frag.parts());
    kept.load(take, |f| frag[f]);
    let of = |name: &str| kept[name].q();

    m.comment("What the products make.");
    let register = |name: &str, bits: u32, doc: &str| m.reg(name, bits).doc(doc);
    let y = register("y", 17, "1/root, 2^-16");
    let attenuation = register("attenuation", 17, "2^-16");
    let toward = register("toward", 18, "N.L of the normal as it is, 2^-16");
    let way = register("way", 18, "L.V, 2^-16");
    let axis = register("axis", 18, "cosine to the axis, 2^-16");
    let cone = register("cone", 17, "what the cone lets through, 2^-16");
    let diffuse = register("diffuse", 18, "N.L, 2^-16");
    let viewed = register("viewed", 18, "N.V, 2^-16");
    let beam = register("beam", 17, "what is left of the light, 2^-16");
    let halfway = register("halfway", 18, "N.H, 2^-16");

    m.comment("The numbers that roots are taken of, 2^-30, signed.");
    let [first, second, third] = [0, 5, 10].map(at);
    let rooting = (first | second | third).named_doc("rooting", "a root is begun");
    let one = m.lit(19, 1 << 16);
    let of_normal = zeros_behind(of("nn"), 14);
    let of_way = zeros_behind(way.q().sext(19) + one, 13);
    let x = first.mux(of("dd"), second.mux(of_normal, of_way)).named_doc("x", "2^-30");
    let root = Root::new(&m, rooting, x);

    m.comment("Beside the axis.");
    let beside = (one - axis.q().sext(19)).named_doc("beside", "1 - cosine to the axis, 2^-16");
    // Set below 0, and from 2.0 on, which no EDGE lights: there any place will do.
    let other = beside.bit(17);
    let place_beside = other.mux(0, beside.bit(16).mux(m.lit(16, 0xffff), beside.trunc(16)));
    let place_beside = place_beside.named_doc("place_beside", "of it, in table C");
    let edge = m.reg("cone_edge", 17).doc("EDGE: light falls where beside is no more");
    edge.when(roots.comes & !roots.taken.any(), memory.data["word"].slice(32, 16));
    let dark = (!beside.msb() & edge.q().zext(18).lt(beside.trunc(18))).named("dark");

    m.comment("The tables: of R an entry for the root begun, of A one for its exponent, of C one for the place beside the axis.");
    let (in_a, in_c) = (at(1), at(7));
    let of_a = m.cat(&[m.lit(1, 1), root.k, root.m.slice(15, 10)]);
    let of_c = m.cat(&[m.lit(2, 1), place_beside.slice(15, 8)]);
    let of_r = m.cat(&[m.lit(2, 0), root.entry]);
    let entry = in_a.mux(of_a, in_c.mux(of_c, of_r)).named("entry");
    let word = roots.read(rooting | in_a | in_c, entry);
    let (v, slope) = (word.slice(32, 16), word.slice(15, 0));

    m.comment("The operands: a slope and how far behind its entry, or a number in 2^-23 over the root, or what is made already.");
    let (low_a, low_c) = (root.m.trunc(10), zeros_behind(place_beside.trunc(8), 2));
    let low = at(2)
        .mux(low_a, at(8).mux(low_c, zeros_behind(root.m.trunc(8), 2)))
        .named_doc("low", "2^-10 of an entry");
    let both = diffuse.q().sext(19) + viewed.q().sext(19);
    let both = zeros_behind(both, 6);
    let numbers =
        [(3, of("pl")), (4, of("dv")), (5, of("da")), (9, zeros_behind(toward.q(), 7)), (10, of("pv"))];
    let number = numbers.into_iter().rev().fold(both, |other, (step, number)| at(step).mux(number, other));
    let number = number.named_doc("number", "2^-23");
    // Of 25 bits, shifted by 7 at most: a half more overflows nothing.
    let shifted = number.sext(32).shl_by(root.k) + m.lit(32, 1 << 6);
    let near = cut(&m, "near", shifted.slice(31, 7).named_doc("shifted", "2^-16"), 18);
    let looks = [1, 2, 6, 8, 11].map(at).into_iter().reduce(|any, one| any | one);
    let looks = looks.expect("five").named_doc("looks", "a slope is multiplied");
    let (of_beam, of_light) = (at(12), at(14));
    let others = of_beam.mux(attenuation.q().zext(18), of_light.mux(diffuse.q(), near));
    let a = looks.mux(slope.zext(18), others);
    let others = of_beam.mux(cone.q(), of_light.mux(beam.q(), y.q()));
    let b = looks.mux(low.zext(17), others);
    let Multiplier { exact, looked, times } = Multiplier::new(&m, a, b, v);

    y.when(at(2) | at(7) | at(12), looked);
    attenuation.when(at(3), looked);
    toward.when(at(4), times);
    way.when(at(5), times);
    axis.when(at(6), times);
    cone.when(at(9), dark.mux(0, looked));
    diffuse.when(at(10), times);
    viewed.when(at(11), times);
    beam.when(at(13), times.trunc(17));
    // Looked up in the step that follows, and no more.
    halfway.set(times);

    m.comment("Step 15: where they stand in SHADE's tables.");
    let cosines = parts(&tokens::cosines(plan));
    let indices: Vec<(String, Signal<'_>)> = cosines
        .iter()
        .filter(|part| ["nl0", "nh0"].contains(&part.name.as_str()))
        .map(|part| {
            let index = if part.name == "nl0" {
                let index = exact.slice(exact.width() - 1, 32 - plan.shade.table_bits).named("index_nl0");
                cut(&m, "nl0", index, part.width)
            } else {
                place(&m, plan, part, halfway.q(), Some(of("gloss")))
            };
            let register = m.reg(&part.name, part.width).doc(&part.doc).when(at(15), index);
            (part.name.clone(), register.q())
        })
        .collect();

    ports.take_ready(frag_ready);
    ports.read("roots", roots.read_valid, roots.read_place, roots.loading);
    ports.give(normed_valid, |f| match indices.iter().find(|(name, _)| name == f) {
        Some((_, index)) => *index,
        None if f == "beam" => beam.q(),
        None => of(f),
    });
    ports.status("table_wait", frag_valid & !roots.have);
    ports.status("working", working);
    ports.status("occupied", busy.q());
    m.finish()
}

/// The number times 2^count, of so many bits more.
fn zeros_behind(number: Signal<'_>, count: u32) -> Signal<'_> {
    let m = number.module();
    m.cat(&[number, m.lit(count, 0)])
}
