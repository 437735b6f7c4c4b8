//! A first-in first-out queue of registers.

use std::sync::Arc;

use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::wires::{Part, Registers, Token};

/// The queue's netlist, for tokens of these parts; says of `flags` whether any token in it has one.
pub(crate) fn fifo(
    name: &str,
    depth: u32,
    parts: &[Part],
    flags: &[&str],
) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new(
        name,
        &format!(
            "First in, first out: {depth} places in registers. When the first token leaves, the others move up.

  in ─> [place {}] ─> … ─> [place 0] ─> out

Timing: a token taken in one clock is at the output in the next, if it is the first.
Rules: in_ready does not depend on out_ready. A full queue takes no token, even while its first token leaves.",
            depth - 1
        ),
    );
    let in_valid = m.input("in_valid", 1);
    let token = Token::inputs(&m, "in", parts.to_vec());
    let out_ready = m.input("out_ready", 1);

    m.comment("Count of the places in use; place 0 is the first.");
    let bits = (depth + 1).next_power_of_two().ilog2();
    let count = m.reg("count", bits).doc("tokens").reset(0);
    let in_ready = count.q().lt(depth as i32).named("in_ready");
    let out_valid = count.q().any().named("out_valid");
    let push = (in_valid & in_ready).named("push");
    let pop = (out_valid & out_ready).named("pop");
    count.when(push & !pop, count.q() + 1).when(pop & !push, count.q() - 1);

    // in_valid and out_ready may come late in their cycle: the one leads to no place, the other only to their enables.
    m.comment("Each free place loads the input in every cycle; so does the last used place when its token moves up. A push makes the loaded token count.");
    let places: Vec<_> =
        (0..depth).map(|i| Registers::new(&m, &format!("place{i}"), parts.to_vec())).collect();
    for (i, place) in places.iter().enumerate() {
        let moves = (pop | count.q().le(i as i32)).named(&format!("place{i}_moves"));
        match places.get(i + 1) {
            Some(behind) => {
                let follows = count.q().gt(i as i32 + 1).named(&format!("place{i}_has_next"));
                place.load(moves, |f| follows.mux(behind[f], token[f]));
            }
            None => place.load(moves, |f| token[f]),
        }
    }
    for flag in flags {
        // Kept beside the queue: who asks has it from a register.
        let any = m.reg(&format!("any_{flag}_queued"), 1).doc("a queued token has this flag").reset(0);
        let behind = places.iter().enumerate().skip(1);
        let behind =
            behind.fold(m.lit(1, 0), |any, (i, place)| any | (count.q().gt(i as i32) & place[*flag].q()));
        any.set(pop.mux(behind, any.q()) | (push & token[*flag]));
        m.output_doc(&format!("any_{flag}"), any, "a queued token has this flag");
    }

    m.output("in_ready", in_ready);
    m.output("out_valid", out_valid);
    places[0].token().output(&m, "out");
    m.finish()
}
