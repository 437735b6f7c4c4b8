//! The prim: its registers take A and W of the lanes two clocks behind the word that gives them.

use edgewalk_machine::Field;
use edgewalk_machine::sequencer::edges_are_beside;
use edgewalk_machine::sequencer::word::Give;
use edgewalk_machine::units::tokens::EDGES;
use edgewalk_netlist::Signal;

use super::Parts;
use super::code::number_of;
use super::control::Control;
use crate::wires::{Registers, parts as parts_of};

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
    let number = behind("number", control.number);
    let gives = |what: Give| give.eq(number_of(what));
    let t = parts.plan.widths().center_fraction;
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
            if beside { gives(what) } else { gives(what) & number.eq(edge as u128) }
        };
        let whole = parts.of_lane(lane, "whole");
        for (part, what) in [("m", Give::M), ("q", Give::Qf), ("f", Give::Qf), ("r", Give::R), ("c", Give::C)]
        {
            let register = prim[format!("{name}_{part}").as_str()];
            let bits = register.q().width();
            let value = match part {
                "m" => rest(lane).trunc(bits),
                "q" => whole.trunc(bits),
                _ => rest(lane).slice(t + bits - 1, t),
            };
            register.when(gives(what), value);
            if let Some(part) = edge.checked_sub(1) {
                // Of an edge that is not walked all is 0.
                register.when(gives(what) & !control.walked[part], 0);
            }
        }
    }
    for (place, channel) in parts.plan.channels().iter().enumerate() {
        let (lane, round) = (place % parts.lanes.len(), place / parts.lanes.len());
        let whole = parts.of_lane(lane, "whole");
        for (part, what, below) in
            [("start", Give::Start, t), ("d0", Give::D0, 1), ("d1", Give::D1, 1), ("g", Give::G, 1)]
        {
            let register = prim[format!("{}_{part}", channel.name).as_str()];
            let value = whole.slice(below + register.q().width() - 1, below);
            register.when(gives(what) & number.eq(round as u128), value);
        }
    }
    prim
}
