//! The highlight as far as the light comes: stage G.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::largest;
use super::tables::Light;
use crate::wires::moved;

/// How much of the light comes, 2^16 for all of it.
pub(super) const BEAM: &str = "beam";

/// The lights of stage B, with highlights weakened by `beam`, in stage G.
pub(super) fn weakened<'m>(
    m: &'m Module,
    plan: &Plan,
    advance: Signal<'m>,
    beam: Signal<'m>,
    lights: Vec<Light<'m>>,
) -> Vec<Light<'m>> {
    m.comment("Stage G: highlights times the share of the light.");
    let bits = plan.color.bits;
    let weaken = |(i, Light { lit, diffuse, highlight }): (usize, Light<'m>)| {
        let product = (highlight * beam).named_doc(&format!("weakened{i}"), "2^-16");
        let sum = product.zext(bits + 18) + m.lit(bits + 18, 1 << 15);
        let rounded = sum.slice(bits + 17, 16).named(&format!("rounded{i}"));
        let beyond = rounded.slice(bits + 1, bits).any();
        let cut = beyond.mux(largest(m, bits), rounded.trunc(bits));
        Light {
            lit: moved(m, advance, &format!("g_lit{i}"), "lit, from stage B", lit),
            diffuse: moved(m, advance, &format!("g_diffuse{i}"), "diffuse light, from stage B", diffuse),
            highlight: moved(
                m,
                advance,
                &format!("g_highlight{i}"),
                "highlight times share of the light",
                cut,
            ),
        }
    };
    lights.into_iter().enumerate().map(weaken).collect()
}
