//! From a product with a normal of any length to the place of the cosine in SHADE's tables.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use crate::place::place;
use crate::wires::Part;

/// 1.0 in products and cosines is 2^16.
const ONE: u32 = 16;

/// The index `part`: `product`, signed, times `y`, unsigned, 2^-16; with `gloss` so much larger around 1.0; what is beyond its
/// bits is the last that they say.
pub(super) fn cosine<'m>(
    m: &'m Module,
    plan: &Plan,
    part: &Part,
    product: Signal<'m>,
    y: Signal<'m>,
    gloss: Option<Signal<'m>>,
) -> Signal<'m> {
    let name = &part.name;
    // As many bits as both have hold their product, and with the half too.
    let exact = product.smul(y.zext(y.width() + 1)).trunc(product.width() + y.width());
    let rounded = exact + m.lit(exact.width(), 1 << (ONE - 1));
    let c = rounded.slice(rounded.width() - 1, ONE).named_doc(&format!("c_{name}"), "the cosine, 2^-16");
    place(m, plan, part, c, gloss)
}
