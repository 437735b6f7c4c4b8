//! From a cosine to its place in SHADE's tables.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use crate::cut::cut;
use crate::wires::Part;

/// 1.0 in cosines is 2^16.
const ONE: u32 = 16;

/// The index `part` of the cosine `c`; with `gloss` so much larger around 1.0; what is beyond its bits is the last that they say.
pub(crate) fn place<'m>(
    m: &'m Module,
    plan: &Plan,
    part: &Part,
    c: Signal<'m>,
    gloss: Option<Signal<'m>>,
) -> Signal<'m> {
    let name = &part.name;
    let placed = match gloss {
        None => c,
        Some(gloss) => {
            let most = plan.shade.gloss_bits;
            let width = c.width() + 1 + most;
            let one = m.lit(width, 1 << ONE);
            let below_one = c.sext(width) - one;
            // A material's gloss is at most the machine's.
            let bits = (most + 1).next_power_of_two().ilog2();
            let scaled = if most == 0 { below_one } else { below_one.shl_by(gloss.trunc(bits)) };
            (scaled + one).named_doc(&format!("scaled_{name}"), "1.0 - 2^gloss * (1.0 - cosine), 2^-16")
        }
    };
    let index = placed.slice(placed.width() - 1, ONE - plan.shade.table_bits);
    let index = index.named_doc(&format!("index_{name}"), "entry of SHADE's table");
    cut(m, name, index, part.width)
}
