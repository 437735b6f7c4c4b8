//! How long SETUP takes: serial lanes, k bits a clock.

use edgewalk_machine::{EdgeKind, Fill, Plan};

/// Clocks of a triangle in SETUP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetupClocks {
    /// S1: sorting, edges, area, cull.
    pub phase1: u32,
    /// S2: the channels.
    pub phase2: u32,
}

/// S1 and S2 of a machine (`docs/machine.md`, section 2).
#[must_use]
pub fn setup_clocks(plan: &Plan) -> SetupClocks {
    let w = plan.widths();
    let (d, t, g) = (w.difference, w.center_fraction, plan.guard_bits);
    let k = 2;
    let mul = 1 + d.div_ceil(k);
    let div = |bits: u32| 1 + bits.div_ceil(k);
    let word = plan.channels().iter().map(|c| c.word()).max().unwrap_or(0); // there are four at least
    let (div_q, div_c) = match plan.edge_kind {
        EdgeKind::Exact => (div(d - 1), div(2 * d - 1 - t)),
        EdgeKind::Slope => (div(d - 1 + plan.edge_fraction), div(2 * d - 1 + plan.edge_fraction)),
    };
    let t1 = div_q + mul + div_c;
    let t2 = match plan.fill {
        Fill::Exact => 4 * mul + div(d + word + t) + div(d + word + g + 2 + t) + div(2 * d + word),
        Fill::Textbook => 3 * mul + 5 * div(d + word + t),
    };
    let channels = plan.channels().len() as u32; // at most 8
    SetupClocks { phase1: 3 + 4 / plan.lanes * t1, phase2: 1 + channels.div_ceil(plan.lanes) * t2 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edgewalk_machine::Machine;

    #[test]
    fn worked_by_hand() {
        // DW = 23, k = 2: MUL 13, DIVq 12, DIVc 20; DIV(69) 36, DIV(84) 43, DIV(84) 43.
        assert_eq!(
            setup_clocks(&Plan::default()),
            SetupClocks { phase1: 3 + 45, phase2: 1 + 4 * 13 + 36 + 43 + 43 }
        );
        // T2 is 174, and five channels take two turns of four lanes, three of two and five of one.
        for (lanes, turns) in [(4, 2), (2, 3), (1, 5)] {
            let plan = Machine { extra: 1, lanes, ..Machine::default() }.plan().expect("can be built");
            assert_eq!(setup_clocks(&plan).phase2, 1 + turns * 174);
        }
        // DW = 16, k = 1, one lane, F = 16: MUL 17, DIVq 32, DIVc 48; DIV(16 + 30 + 1) 48.
        let textbook = Plan::preset("textbook").expect("a preset");
        assert_eq!(
            setup_clocks(&textbook),
            SetupClocks { phase1: 3 + 4 * (32 + 17 + 48), phase2: 1 + 4 * (3 * 17 + 5 * 48) }
        );
    }
}
