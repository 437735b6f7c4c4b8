//! From a product with a normal of any length to the place of the cosine in SHADE's tables.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use crate::place::place;
use crate::wires::Part;

/// 1.0 in products and cosines is 2^16.
const ONE: u32 = 16;

/// A product with the normal, signed, times the root `y`, unsigned, 2^-16: as many bits as both have hold it.
pub(super) fn product<'m>(product: Signal<'m>, y: Signal<'m>) -> Signal<'m> {
    product.smul(y.zext(y.width() + 1)).trunc(product.width() + y.width())
}

/// The index `part` of such a product; with `gloss` so much larger around 1.0; what is beyond its bits is the last that they
/// say.
pub(super) fn cosine<'m>(
    m: &'m Module,
    plan: &Plan,
    part: &Part,
    product: Signal<'m>,
    gloss: Option<Signal<'m>>,
) -> Signal<'m> {
    let name = &part.name;
    // The product has room for the half.
    let rounded = product + m.lit(product.width(), 1 << (ONE - 1));
    let c = rounded.slice(rounded.width() - 1, ONE).named_doc(&format!("c_{name}"), "the cosine, 2^-16");
    place(m, plan, part, c, gloss)
}
