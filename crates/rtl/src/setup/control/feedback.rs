//! Wires from the rest of SETUP back to control.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Wire};

use crate::setup::steps::most_scale;

/// What the rest of SETUP drives.
pub(in crate::setup) struct Feedback<'m> {
    /// The lines are known and there are none, or no columns.
    pub nothing: Wire<'m>,
    /// The area is known.
    pub area_known: Wire<'m>,
    /// The area is 0.
    pub no_area: Wire<'m>,
    /// How often the modulus of the round of channels is fourfold.
    pub scale: Wire<'m>,
    /// A number that is needed did not fit.
    pub unfit: Wire<'m>,
    /// Place of the first digit of the next sum.
    pub top_digit: Wire<'m>,
    /// With POLY.
    pub polygon: Option<PolygonFeedback<'m>>,
}

/// The token's part in a polygon, from the clock after it is taken.
pub(in crate::setup) struct PolygonFeedback<'m> {
    /// Sides that count: major, first, second minor edge.
    pub sides: Wire<'m>,
    /// Edges without values.
    pub edges: Wire<'m>,
    /// The token has a plane that is not culled.
    pub plane: Wire<'m>,
}

impl<'m> Feedback<'m> {
    /// The wires, to be driven; a place of a digit has `digit_bits` bits.
    pub fn new(m: &'m Module, plan: &Plan, digit_bits: u32) -> Feedback<'m> {
        let wire = |name: &str, bits: u32| m.wire(name, bits);
        Feedback {
            nothing: wire("nothing", 1).doc("no line, or no column, of the screen"),
            area_known: wire("area_known", 1).doc("and scaled for the next round of channels"),
            no_area: wire("no_area", 1),
            scale: wire("scale", most_scale(plan).ilog2() + 1).doc("the modulus is the area 4^scale times"),
            unfit: wire("unfit", 1).doc("a number was taken in that is not between -M and M"),
            top_digit: wire("top_digit", digit_bits).doc("place of the first digit of a sum"),
            polygon: plan.polygon.is_there().then(|| PolygonFeedback {
                sides: wire("sides_counted", 3),
                edges: wire("only_edges", 1),
                plane: wire("with_plane", 1),
            }),
        }
    }
}
