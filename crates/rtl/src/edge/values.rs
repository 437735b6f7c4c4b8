//! The values of the channels from line to line.

use edgewalk_machine::units::tokens;
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::walk::Walk;
use crate::wires::{Registers, Token, parts};

/// What the edges tell the channels.
pub(super) struct Choices<'m> {
    /// The major edge carries in its next step.
    pub carry: Signal<'m>,
    /// The triangle that is offered has an upper part.
    pub has_upper: Signal<'m>,
}

/// The updates of the channels in `line`, and the increments for PIXEL.
pub(super) fn values<'m>(
    m: &'m Module,
    plan: &Plan,
    walk: &Walk<'m>,
    prim: &Token<'m>,
    line: &Registers<'m>,
    choices: &Choices<'m>,
) -> Token<'m> {
    if let Some(walked) = walk.walked {
        return values_at_port(m, plan, walk, walked, prim, line, choices);
    }
    m.comment("The channels at the start of the span, their steps, and the increments for PIXEL.");
    let increments = Registers::new(m, "inc", parts(&tokens::held_by_edge(plan)));
    for name in ["kt", "record"] {
        if let (Some(register), Some(value)) = (increments.get(name), prim.get(name)) {
            register.when(walk.load, value);
        }
    }
    if plan.fill == Fill::Exact {
        m.comment("While idle, the addend is the start value. `running ? a + b : b` costs no multiplexer: the selection fits the adder's own LUT.");
    }
    for channel in plan.channels().iter().map(|channel| channel.name) {
        let of_prim = |result: &str| prim[format!("{channel}_{result}").as_str()];
        let held = |result: &str| {
            let register = m.reg(&format!("{channel}_{result}"), of_prim(result).width());
            register.doc("as in the triangle").when(walk.offered, of_prim(result)).q()
        };
        let value = line[channel];
        increments[channel].when(walk.load, of_prim("g"));
        match plan.fill {
            Fill::Exact => {
                let (d0, d1) = (held("d0"), held("d1"));
                let added = walk.idle.mux(of_prim("start"), choices.carry.mux(d1, d0));
                let added = added.named(&format!("{channel}_added"));
                value.when(walk.moves, walk.running.mux(value.q() + added, added));
            }
            Fill::Textbook => {
                let steps = [held("d_a"), held("start_b"), held("d_b")];
                let first = choices.has_upper.mux(of_prim("start_a"), of_prim("start_b"));
                by_parts(walk, line, channel, steps, first);
            }
        }
    }
    increments.token()
}

/// A channel in textbook fill: a step down the left edge of each part, and its first value.
fn by_parts<'m>(
    walk: &Walk<'m>,
    line: &Registers<'m>,
    channel: &str,
    [d_a, start_b, d_b]: [Signal<'m>; 3],
    first: Signal<'m>,
) {
    let at_knee = walk.step & walk.exchanges;
    let value = line[channel];
    value
        .when(walk.line_done, value.q() + walk.upper.mux(d_a, d_b))
        // Where the left edge is the major one, the knee line begins where it did.
        .when(at_knee & line["major_right"].q(), start_b)
        .when(walk.offered, first);
}

/// The same where the triangle stays at the port, and with it what does not step.
fn values_at_port<'m>(
    m: &'m Module,
    plan: &Plan,
    walk: &Walk<'m>,
    walked: Signal<'m>,
    prim: &Token<'m>,
    line: &Registers<'m>,
    choices: &Choices<'m>,
) -> Token<'m> {
    match plan.fill {
        Fill::Exact => m.comment("The channels at the start of the span. Between triangles a value is 0, and the addend is the start value."),
        Fill::Textbook => m.comment("The channels at the start of the span."),
    }
    for channel in plan.channels().iter().map(|channel| channel.name) {
        let of_prim = |result: &str| prim[format!("{channel}_{result}").as_str()];
        let at_port = |result: &str| of_prim(result).named(&format!("{channel}_{result}"));
        let value = line[channel];
        match plan.fill {
            Fill::Exact => {
                let (d0, d1) = (at_port("d0"), at_port("d1"));
                let added = walk.idle.mux(of_prim("start"), choices.carry.mux(d1, d0));
                let sum = value.q() + added.named(&format!("{channel}_added"));
                value.reset(0).when(walk.moves, sum).when(walked, 0);
            }
            Fill::Textbook => {
                let steps = [at_port("d_a"), at_port("start_b"), at_port("d_b")];
                let first = choices.has_upper.mux(of_prim("start_a"), steps[1]);
                by_parts(walk, line, channel, steps, first);
            }
        }
    }
    Token::new(parts(&tokens::held_by_edge(plan)), |name| {
        prim.get(name).unwrap_or_else(|| prim[format!("{name}_g").as_str()])
    })
}
