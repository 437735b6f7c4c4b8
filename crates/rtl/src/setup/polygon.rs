//! What the three vertices are to a polygon, in a machine with POLY, and the window of lines that is drawn.

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens;
use edgewalk_netlist::{Module, Signal};

use super::control::Control;
use crate::light_pass::LightPass;
use crate::wires::{Registers, Token};

/// The field `kind` of the port, where it is not 0, a triangle.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Edges = 1,
    Plane = 2,
    Line = 3,
}

/// The token's part in a polygon.
#[derive(Clone, Copy)]
pub(super) struct Polygon<'m> {
    /// The last edges of a polygon, and its plane.
    pub plane: Signal<'m>,
    /// A triangle by itself.
    pub triangle: Signal<'m>,
    /// First line that is drawn.
    pub first: Signal<'m>,
    /// The line behind the last that is drawn, or the first if there is none.
    pub end: Signal<'m>,
}

impl<'m> Polygon<'m> {
    /// Takes it with the vertices; none where the machine has no POLY. `order` is the vertex at each place.
    pub fn take(
        m: &'m Module,
        plan: &Plan,
        control: &Control<'m>,
        light_pass: LightPass<'m>,
        triangle: &Token<'m>,
        prim: &Registers<'m>,
        order: &[Signal<'m>],
    ) -> Option<Polygon<'m>> {
        let feedback = control.feedback.polygon.as_ref()?;
        m.comment("The token's part in a polygon: which sides count, by the sorted vertices; and the lines of the window.");
        let take = control.sequence.take;
        let kind = m.reg("kind", 2).doc(tokens::kinds(plan)).when(take, triangle["kind"]).q();
        let is = |kind_of: Kind| kind.eq(kind_of as i32);
        let (edges, plane) = (is(Kind::Edges).named("is_edges"), is(Kind::Plane).named("is_plane"));
        let sides = m.reg("sides", 3).doc("that count, as at the port").when(take, triangle["sides"]).q();
        // The side opposite vertex 0 is that from vertex 1 to 2.
        let opposite = |vertex: Signal<'m>| {
            vertex.bit(1).mux(sides.bit(0), vertex.bit(0).mux(sides.bit(2), sides.bit(1)))
        };
        // Between the top and the bottom vertex lies the major edge, opposite the middle one.
        let sorted = m.cat(&[opposite(order[0]), opposite(order[2]), opposite(order[1])]);
        let alone = if plan.polygon.has_lines() {
            is(Kind::Line).mux(0b001, m.lit(3, 0b111))
        } else {
            m.lit(3, 0b111)
        };
        let counted = (edges | plane)
            .mux(sorted, alone)
            .named_doc("counted", "sides that count, by the sorted vertices");
        feedback.sides.drive(counted);
        feedback.edges.drive(edges);
        feedback.plane.drive(plane);
        prim["sides"].set(counted);
        prim["ends"].when(take, triangle["kind"].ne(Kind::Edges as i32));
        for name in ["start_x", "start_y"] {
            prim[name].when(take, triangle[name]);
        }

        let bits = triangle["end_y"].width();
        let height = m.lit(bits, plan.height.into());
        let height = match triangle.get("flat") {
            Some(flat) => (flat & triangle["kind"].eq(Kind::Line as i32)).mux(plan.width as i32, height),
            None => height,
        };
        let height = light_pass.choose(height, || m.lit(bits, plan.shadow.size.into()));
        let first = triangle["start_y"].zext(bits);
        let end = triangle["end_y"].lt(height).mux(triangle["end_y"], height).named("window_end");
        let end = end.lt(first).mux(first, end);
        let end = m.reg("behind_window", bits).doc("behind the last line of the window").when(take, end).q();
        let triangle = (!edges & !plane).named("is_triangle");
        Some(Polygon { plane, triangle, first: prim["start_y"].q(), end })
    }
}
