//! The share of a colour that another word of as many bits says.

use edgewalk_netlist::{Module, Signal};

/// `color * share / (2^b - 1)`, to nearest.
pub(crate) fn share<'m>(m: &'m Module, name: &str, color: Signal<'m>, share: Signal<'m>) -> Signal<'m> {
    let bits = color.width();
    let half = m.lit(2 * bits, 1 << (bits - 1));
    let p = (color * share + half).named_doc(&format!("p_{name}"), "product plus one half");
    // Neither sum is more than (2^b - 1)^2 + 2^b + 2^(b-1), which 2b bits hold.
    let folded = p + p.slice(2 * bits - 1, bits).zext(2 * bits);
    folded.named_doc(&format!("folded_{name}"), "high half of the product").slice(2 * bits - 1, bits)
}
