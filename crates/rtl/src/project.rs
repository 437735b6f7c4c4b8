//! PROJECT: divides a fragment's place in the light's view by its weight.

mod row;

mod beside;
mod pipelined;
mod serial;

use std::sync::Arc;

use edgewalk_machine::units::project::SPEC;
use edgewalk_machine::{LIGHT_SPACE, Plan, Project};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::ports::Interface;
use crate::wires::{Part, Token};

const DOC: &str = "PROJECT divides a fragment's place in the light's view by its weight.

Formats: lx, ly, lz, lw signed.
  frag       lx / lw and ly / lw are the place on the map, 0 to 1; lz / lw is the depth from the light
  projected  lx and ly are the texel, -1 outside the map; lz is the depth in the map's LSB, to nearest, -1 in front of it
Rules: one row of restoring division makes one bit of a quotient. The rest is doubled; the divisor is subtracted where the
difference is not negative.";

/// What is divided, by the names of the registers.
const DIVIDED: [&str; 3] = ["x", "y", "z"];

/// The netlist of PROJECT.
///
/// # Errors
/// None for a machine with PROJECT that [`edgewalk_machine::Machine::plan`] accepts.
pub fn project(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_project", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    match plan.shadow.project {
        Project::Pipelined => pipelined::build(&m, plan, &ports),
        Project::Serial => serial::build(&m, plan, &ports),
    }
    m.finish()
}

/// Rows of the division of x, y and z.
fn rows(plan: &Plan) -> [u32; 3] {
    let side = plan.shadow.side_bits();
    [side, side, plan.shadow.depth_bits + 1]
}

/// What goes past the division: the rest of the fragment, and what is not divided at all.
fn kept<'m>(plan: &Plan, frag: &Token<'m>) -> Token<'m> {
    let m = frag["lw"].module();
    m.comment("Range checks. With signs 0 the dividends are as long as the divisor.");
    let [x, y, z, w] = LIGHT_SPACE.map(|name| frag[name]);
    let before_light =
        (!w.msb() & w.any()).named_doc("before_light", "the weight is above 0: in front of the light");
    let below = |number: Signal<'m>| {
        let bits = plan.shadow.light_bits;
        before_light & !number.msb() & number.trunc(bits).lt(w.trunc(bits))
    };
    let said = |name: &str, doc: &str, signal: Signal<'m>| {
        let part = Part { name: name.to_owned(), width: 1, doc: doc.to_owned() };
        (part, signal.named(name))
    };
    let flags = [
        said("column_on_map", "the column is on the map", below(x)),
        said("line_on_map", "the line is on the map", below(y)),
        said("depth_on_map", "the depth is in the map's range", below(z)),
        said("nearer", "nearer than the map's range, or behind the light", !before_light | z.msb()),
    ];
    let others = frag.parts().into_iter().filter(|part| !LIGHT_SPACE.contains(&part.name.as_str()));
    others.map(|part| (part.clone(), frag[part.name.as_str()])).chain(flags).collect()
}

/// The fragment that is given, of what went past and of the quotients of x, y and z.
fn give<'m>(
    plan: &Plan,
    ports: &Interface<'m>,
    valid: Signal<'m>,
    kept: &Token<'m>,
    quotients: [Signal<'m>; 3],
) {
    let m = valid.module();
    m.comment("Texel, and depth rounded to nearest. Undivided values get fixed codes.");
    let [x, y, z] = quotients;
    let depth_bits = plan.shadow.depth_bits;
    let texel = |on_map: &str, quotient: Signal<'m>| {
        let bits = quotient.width() + 1;
        kept[on_map].mux(quotient.zext(bits), -1)
    };
    // A half more, and without the place behind the point.
    let rounded = (z.zext(depth_bits + 2) + 1).named_doc("rounded", "depth plus half an LSB");
    let depth = rounded.slice(depth_bits + 1, 1).zext(depth_bits + 2);
    let behind = m.lit(depth_bits + 2, 1 << depth_bits);
    let past = kept["nearer"].mux(-1, behind);
    let given = [
        ("lx", texel("column_on_map", x).named("column")),
        ("ly", texel("line_on_map", y).named("line")),
        ("lz", kept["depth_on_map"].mux(depth, past).named("depth")),
    ];
    ports.give(valid, |f| {
        given.iter().find(|(name, _)| *name == f).map_or_else(|| kept[f], |(_, signal)| *signal)
    });
}
