//! What the products make, and where it stands in SHADE's tables.

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens;
use edgewalk_netlist::{Module, Reg, Signal};

use super::multiply::Multiplier;
use super::steps::Steps;
use crate::cut::cut;
use crate::place::place;
use crate::wires::parts;

/// The registers that products go to.
pub(super) struct Made<'m> {
    /// 1 over the root, 2^-16.
    pub y: Reg<'m>,
    pub attenuation: Reg<'m>,
    /// N.L of the normal as it is, 2^-16.
    pub toward: Reg<'m>,
    /// L.V, 2^-16.
    pub way: Reg<'m>,
    /// Cosine to the axis, 2^-16.
    pub axis: Reg<'m>,
    /// What the cone lets through, 2^-16.
    pub cone: Reg<'m>,
    /// N.L, 2^-16.
    pub diffuse: Reg<'m>,
    /// N.V, 2^-16.
    pub viewed: Reg<'m>,
    /// What is left of the light, 2^-16.
    pub beam: Reg<'m>,
    /// N.H, 2^-16.
    halfway: Reg<'m>,
}

impl<'m> Made<'m> {
    /// The registers, without updates.
    pub fn new(m: &'m Module) -> Made<'m> {
        m.comment("Results of the products.");
        let register = |name: &str, bits: u32, doc: &str| m.reg(name, bits).doc(doc);
        Made {
            y: register("y", 17, "1/root, 2^-16"),
            attenuation: register("attenuation", 17, "2^-16"),
            toward: register("toward", 18, "N.L before division by the normal's length, 2^-16"),
            way: register("way", 18, "L.V, 2^-16"),
            axis: register("axis", 18, "cosine to the axis, 2^-16"),
            cone: register("cone", 17, "share of the light inside the cone, 2^-16"),
            diffuse: register("diffuse", 18, "N.L, 2^-16"),
            viewed: register("viewed", 18, "N.V, 2^-16"),
            beam: register("beam", 17, "light after attenuation, 2^-16"),
            halfway: register("halfway", 18, "N.H, 2^-16"),
        }
    }

    /// Takes the products: what step s multiplies is there in step s + 2. `dark`: the point lies outside the
    /// cone.
    pub fn update(&self, steps: &Steps<'m>, product: &Multiplier<'m>, dark: Signal<'m>) {
        let at = |step: i32| steps.at(step);
        let (looked, times) = (product.looked, product.times);
        self.y.when(at(2) | at(7) | at(12), looked);
        self.attenuation.when(at(3), looked);
        self.toward.when(at(4), times);
        self.way.when(at(5), times);
        self.axis.when(at(6), times);
        self.cone.when(at(9), dark.mux(0, looked));
        self.diffuse.when(at(10), times);
        self.viewed.when(at(11), times);
        self.beam.when(at(13), times.trunc(17));
        // Looked up in the step that follows, and no more.
        self.halfway.set(times);
    }

    /// The places in SHADE's tables, by their fields; `exact` is the product as it is.
    pub fn indices(
        &self,
        m: &'m Module,
        plan: &Plan,
        steps: &Steps<'m>,
        exact: Signal<'m>,
    ) -> Vec<(String, Signal<'m>)> {
        m.comment("Step 15: entries in SHADE's tables.");
        let cosines = parts(&tokens::cosines(plan));
        let found = cosines.iter().filter(|part| ["nl0", "nh0"].contains(&part.name.as_str()));
        let index = found.map(|part| {
            let index = if part.name == "nl0" {
                let index = exact.slice(exact.width() - 1, 32 - plan.shade.table_bits).named("index_nl0");
                cut(m, "nl0", index, part.width)
            } else {
                place(m, plan, part, self.halfway.q(), Some(steps.of("gloss")))
            };
            let register = m.reg(&part.name, part.width).doc(&part.doc).when(steps.at(15), index);
            (part.name.clone(), register.q())
        });
        index.collect()
    }
}
