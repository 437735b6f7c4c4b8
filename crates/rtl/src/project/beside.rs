//! What goes past a pipeline of division, in memories as long as that is.

use edgewalk_netlist::{Module, Signal};

use crate::wires::{Part, Token};

/// The token as it was `stages` advances ago.
pub(super) fn beside<'m>(m: &'m Module, stages: u32, advance: Signal<'m>, token: &Token<'m>) -> Token<'m> {
    m.comment(
        "The other fields wait in a ring as long as the stages. Each read is at the next write's place, so fields and quotients leave together.",
    );
    let bits = stages.next_power_of_two().ilog2();
    let place = m.reg("place", bits).doc("place in the ring for the next write").reset(0);
    let last = place.q().eq(stages as i32 - 1);
    let next = last.mux(0, place.q() + 1).named_doc("next_place", "oldest entry of the ring");
    place.when(advance, next);
    let mut past = Vec::new();
    for (number, group) in groups(token.parts()).into_iter().enumerate() {
        let word: Vec<Signal<'m>> = group.iter().map(|part| token[part.name.as_str()]).collect();
        let width = group.iter().map(|part| part.width).sum();
        let ring = m.memory(&format!("ring{number}"), bits, stages as usize, width);
        let names: Vec<&str> = group.iter().map(|part| part.name.as_str()).collect();
        let ring = ring.doc(&names.join(", ")).write(advance, place.q(), m.cat(&word));
        let oldest = ring.read(advance, next).named(&format!("oldest{number}"));
        let mut low = width;
        for part in group {
            low -= part.width;
            past.push((part.clone(), oldest.slice(low + part.width - 1, low)));
        }
    }
    past.into_iter().collect()
}

/// Longest word of a memory, bits.
const WORD: u32 = 128;

/// The parts in as few words as they fit in, in their order.
fn groups(parts: Vec<Part>) -> Vec<Vec<Part>> {
    let mut groups: Vec<Vec<Part>> = vec![Vec::new()];
    let mut width = 0;
    for part in parts {
        width += part.width;
        if width > WORD {
            groups.push(Vec::new());
            width = part.width;
        }
        if let Some(group) = groups.last_mut() {
            group.push(part);
        }
    }
    groups
}
