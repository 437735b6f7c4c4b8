//! From the cosines of a light to the entries of its tables.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::largest;
use crate::wires::Token;

/// Stage A, for one light.
pub(super) struct Index<'m> {
    /// The light is not below the horizon.
    pub lit: Signal<'m>,
    /// Of T.
    pub diffuse: Signal<'m>,
    /// Of S.
    pub highlight: Signal<'m>,
}

impl<'m> Index<'m> {
    /// Of the fragment that is offered.
    pub fn new(m: &'m Module, plan: &Plan, light: u32, frag: &Token<'m>, advance: Signal<'m>) -> Index<'m> {
        let register = |name: &str, doc: &str, value: Signal<'m>| {
            m.reg(&format!("a_{name}{light}"), value.width()).doc(doc).when(advance, value).q()
        };
        let cosine = |name: &str| frag[format!("{name}{light}").as_str()];
        let table_bits = plan.shade.table_bits;
        Index {
            lit: register("lit", "the light is above the horizon", !cosine("nl").msb()),
            diffuse: register("diffuse", "entry of T", entry(cosine("nl"), table_bits)),
            highlight: register("highlight", "entry of S", entry(cosine("nh"), table_bits)),
        }
    }
}

/// A signed number as an entry: 0 for one below, the last for one beyond.
fn entry(number: Signal<'_>, table_bits: u32) -> Signal<'_> {
    let beyond = number.slice(number.width() - 2, table_bits).any();
    let last = largest(number.module(), table_bits);
    number.msb().mux(0, beyond.mux(last, number.trunc(table_bits)))
}
