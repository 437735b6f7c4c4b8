//! What the products make, and where it stands in SHADE's tables.

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens;
use edgewalk_netlist::{Module, Signal};

use super::multiply::Multiplier;
use super::turns::{Made, Turns};
use crate::cut::cut;
use crate::place::place;
use crate::wires::parts;

/// The registers that products go to.
pub(super) struct Results<'m> {
    /// 1 over the root, 2^-16.
    pub y: Made<'m>,
    pub attenuation: Made<'m>,
    /// N.L of the normal as it is, 2^-16.
    pub toward: Made<'m>,
    /// L.V, 2^-16.
    pub way: Made<'m>,
    /// Cosine to the axis, 2^-16.
    pub axis: Made<'m>,
    /// What the cone lets through, 2^-16.
    pub cone: Made<'m>,
    /// N.L, 2^-16.
    pub diffuse: Made<'m>,
    /// N.V, 2^-16.
    pub viewed: Made<'m>,
    /// What is left of the light, 2^-16.
    pub beam: Made<'m>,
}

impl<'m> Results<'m> {
    /// The registers, without updates.
    pub fn new(m: &'m Module, turns: &Turns<'m>) -> Results<'m> {
        m.comment("Results of the products, of both fragments.");
        let result = |name: &str, bits: u32, doc: &str| turns.result(m, name, bits, doc);
        Results {
            y: result("y", 17, "1/root, 2^-16"),
            attenuation: result("attenuation", 17, "2^-16"),
            toward: result("toward", 18, "N.L before division by the normal's length, 2^-16"),
            way: result("way", 18, "L.V, 2^-16"),
            axis: result("axis", 18, "cosine to the axis, 2^-16"),
            cone: result("cone", 17, "share of the light inside the cone, 2^-16"),
            diffuse: result("diffuse", 18, "N.L, 2^-16"),
            viewed: result("viewed", 18, "N.V, 2^-16"),
            beam: result("beam", 17, "light after attenuation, 2^-16"),
        }
    }

    /// Takes the products: the operands of step s are multiplied in step s + 1. `dark`: the point lies outside the cone.
    pub fn update(&self, turns: &Turns<'m>, product: &Multiplier<'m>, dark: Signal<'m>) {
        let at = |step: i32| turns.second(step);
        let (looked, times) = (product.looked, product.times);
        self.y.when(at(3) | at(8) | at(13), looked);
        self.attenuation.when(at(4), looked);
        self.toward.when(at(5), times);
        self.way.when(at(6), times);
        self.axis.when(at(7), times);
        self.cone.when(at(10), dark.mux(0, looked));
        self.diffuse.when(at(11), times);
        self.viewed.when(at(12), times);
        self.beam.when(at(14), times.trunc(17));
    }
}

/// The places in SHADE's tables, by their fields. N.H is the product of step 15, N.L that of step 16.
pub(super) fn indices<'m>(
    m: &'m Module,
    plan: &Plan,
    turns: &Turns<'m>,
    product: &Multiplier<'m>,
) -> Vec<(String, Signal<'m>)> {
    m.comment("Step 16: entries in SHADE's tables.");
    let cosines = parts(&tokens::cosines(plan));
    let found = cosines.iter().filter(|part| ["nl0", "nh0"].contains(&part.name.as_str()));
    let index = found.map(|part| {
        let index = if part.name == "nl0" {
            let exact = product.exact;
            let index = exact.slice(exact.width() - 1, 32 - plan.shade.table_bits).named("index_nl0");
            cut(m, "nl0", index, part.width)
        } else {
            let halfway = turns.between("halfway", "N.H, 2^-16", product.times);
            let index = place(m, plan, part, halfway, Some(turns.of("gloss")));
            turns.between("halfway_index", "entry for N.H", index)
        };
        (part.name.clone(), turns.between(&part.name, &part.doc, index))
    });
    index.collect()
}
