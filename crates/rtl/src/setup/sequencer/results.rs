//! The prim: its registers take A and W of the lanes two clocks behind the word that gives them.

use edgewalk_machine::sequencer::edges_are_beside;
use edgewalk_machine::sequencer::word::Give;
use edgewalk_machine::units::tokens::EDGES;
use edgewalk_machine::{Field, Fill};
use edgewalk_netlist::Signal;

use super::Parts;
use super::control::Control;
use super::shape::below_column;
use crate::wires::{Registers, parts as parts_of};

/// What a channel gives: the field, the result, whether it is W / P or W / 2, and the part whose lines it is for.
fn channel_results(fill: Fill) -> &'static [(&'static str, Give, bool, Option<usize>)] {
    match fill {
        Fill::Exact => &[
            ("start", Give::Start, true, None),
            ("d0", Give::D0, false, None),
            ("d1", Give::D1, false, None),
            ("g", Give::G, false, None),
        ],
        Fill::Textbook => &[
            ("start_a", Give::Start, true, Some(0)),
            ("d_a", Give::D0, false, Some(0)),
            ("start_b", Give::StartB, true, Some(1)),
            ("d_b", Give::D1, false, Some(1)),
            ("g", Give::G, false, None),
        ],
    }
}

/// The registers.
pub(super) fn results<'m>(parts: &Parts<'_, 'm>, control: &Control<'m>, fields: &[Field]) -> Registers<'m> {
    let m = parts.m;
    m.comment("The prim.");
    let prim = Registers::new(m, "prim", parts_of(fields));
    prim["major_right"].when(control.done, control.right);
    let behind = |name: &str, signal: Signal<'m>| {
        parts.later(&format!("{name}_given"), parts.later(&format!("{name}_giving"), signal))
    };
    let give = behind("result", parts.word.get("give"));
    let number = control.number.map(|number| behind("number", number));
    let gives = |what: Give| give.eq(parts.word.result(what));
    let numbered = |what: Give, place: usize| {
        number.map_or(gives(what), |number| gives(what) & number.eq(place as u128))
    };
    let t = parts.plan.widths().center_fraction;
    let below_column = below_column(parts.plan);
    let rest = |lane: usize| parts.of_lane(lane, "rest");
    // A / P, as many bits as the register has.
    let lines = |name: &str, what: Give| {
        let register = prim[name];
        register.when(gives(what), rest(0).slice(t + register.q().width() - 1, t));
    };
    for (name, what) in [("jm", Give::Jm), ("n1", Give::N1), ("n2", Give::N2)] {
        lines(name, what);
    }
    for (edge, name) in EDGES.iter().enumerate() {
        let beside = edges_are_beside(parts.plan);
        let lane = if beside { edge } else { 0 };
        let gives = |what: Give| {
            if beside { gives(what) } else { numbered(what, edge) }
        };
        let whole = parts.of_lane(lane, "whole");
        for (part, what) in
            [("m", Give::M), ("q", Give::Qf), ("f", Give::Qf), ("dist", Give::R), ("c", Give::C)]
        {
            // M of a slope edge is a constant.
            let Some(register) = prim.get(&format!("{name}_{part}")) else { continue };
            let bits = register.q().width();
            let value = match part {
                "m" => rest(lane).trunc(bits),
                "q" => whole.slice(below_column + bits - 1, below_column),
                "f" | "dist" if below_column > 0 => whole.slice(bits, 1),
                _ => rest(lane).slice(t + bits - 1, t),
            };
            register.when(gives(what), value);
            if let Some(part) = edge.checked_sub(1) {
                // Of an edge that is not walked all is 0.
                register.when(gives(what) & !control.walked[part], 0);
            }
        }
    }
    let channel_results = channel_results(parts.plan.fill);
    for (place, channel) in parts.plan.channels().iter().enumerate() {
        let (lane, round) = (place % parts.lanes.len(), place / parts.lanes.len());
        let whole = parts.of_lane(lane, "whole");
        for &(part, what, below, of_part) in channel_results {
            let register = prim[format!("{}_{part}", channel.name).as_str()];
            let below = if below { t } else { 1 };
            let value = whole.slice(below + register.q().width() - 1, below);
            register.when(numbered(what, round), value);
            if let Some(part) = of_part {
                // A part without lines has no values.
                register.when(numbered(what, round) & !control.walked[part], 0);
            }
        }
    }
    prim
}
