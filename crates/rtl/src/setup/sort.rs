//! The three vertices in centre coordinates, sorted by v; their values stay as they came, as a lane asks for
//! one or two at a time.

use edgewalk_machine::{Channel, Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::control::Control;
use crate::wires::{Part, Registers, Token};

/// The edges' ends among the sorted vertices, above and below: major, first minor, second minor.
pub(super) const ENDS: [(usize, usize); 3] = [(0, 2), (0, 1), (1, 2)];

/// The triangle's vertices; after sorting 0 is the top and 2 the bottom.
pub(super) struct Vertices<'m> {
    places: Vec<Registers<'m>>,
    /// By the order at the port.
    values: Vec<Registers<'m>>,
    /// The vertex of the port that is at a place: 0, 1 or 2.
    pub order: Vec<Signal<'m>>,
    /// v of the bottom vertex less v of the top one, a clock before `heights` has it.
    pub tall: Signal<'m>,
    /// v of the lower end less v of the upper one, by edge; unsigned, DW − 1 bits. From the second clock of a
    /// triangle.
    pub heights: [Signal<'m>; 3],
    /// u of the lower end less u of the upper one, by edge; signed, DW bits. From the second clock of a
    /// triangle.
    pub across: [Signal<'m>; 3],
}

impl<'m> Vertices<'m> {
    /// Takes a triangle, sorted by v at the port; of equal v the earlier vertex stays first.
    pub fn new(m: &'m Module, plan: &Plan, control: &Control<'m>, triangle: &Token<'m>) -> Vertices<'m> {
        m.comment("The vertices sorted by line, in centre coordinates: pixel centres lie on whole numbers.");
        let y = |vertex: usize| triangle[format!("y{vertex}").as_str()];
        let above =
            |lower: usize, upper: usize| y(lower).slt(y(upper)).named(&format!("y{lower}_above_y{upper}"));
        let (above10, above20, above21) = (above(1, 0), above(2, 0), above(2, 1));
        // Which vertex is the top one, which the bottom one; the third lies between.
        let top = [!above10 & !above20, above10 & !above21, above20 & above21];
        let bottom = [above10 & above20, !above10 & above21, !above20 & !above21];
        let is_at = |place: usize, vertex: usize| match place {
            0 => top[vertex],
            1 => !top[vertex] & !bottom[vertex],
            _ => bottom[vertex],
        };
        let sorted =
            |place: usize, of: [Signal<'m>; 3]| is_at(place, 1).mux(of[1], is_at(place, 2).mux(of[2], of[0]));
        let places: Vec<Registers> =
            (0..3).map(|place| Registers::new(m, &format!("p{place}"), corner(plan))).collect();
        for (place, registers) in places.iter().enumerate() {
            registers.load(control.sequence.take, |f| {
                let axis = if f == "u" { "x" } else { "y" };
                center(plan, sorted(place, [0, 1, 2].map(|v| triangle[format!("{axis}{v}").as_str()])))
            });
        }
        let order = |place: usize| {
            let vertex = m.reg(&format!("p{place}_vertex"), 2).doc("the vertex at this place: 0, 1 or 2");
            vertex.when(control.sequence.take, m.cat(&[is_at(place, 2), is_at(place, 1)])).q()
        };
        let order = (0..3).map(order).collect();

        m.comment("Values at the vertices, as tri has them.");
        let values: Vec<Registers> =
            (0..3).map(|vertex| Registers::new(m, &format!("vertex{vertex}"), values(plan))).collect();
        for (vertex, registers) in values.iter().enumerate() {
            registers.load(control.sequence.take, |f| {
                let channel = plan.channels().iter().find(|channel| channel.name == f);
                let port = channel.map(|channel| channel.at_vertex(&vertex.to_string()));
                triangle[port.unwrap_or_default().as_str()]
            });
        }

        m.comment("Differences of the sorted vertices, from upper to lower ends of edges.");
        let bits = plan.widths().difference;
        let unit = center_unit(plan);
        let kept = |name: &str, (from, to): (usize, usize), (way, sign): (&str, &str), value: Signal<'m>| {
            let doc = format!("from vertex {from} {way} vertex {to}, {unit}{sign}");
            m.reg(&format!("{name}{from}{to}"), value.width()).doc(&doc).set(value).q()
        };
        let below = |(from, to): (usize, usize)| places[to]["v"].q() - places[from]["v"].q();
        let beside =
            |(from, to): (usize, usize)| places[to]["u"].q().sext(bits) - places[from]["u"].q().sext(bits);
        let tall = below(ENDS[0]).named("tall");
        let heights = ENDS.map(|ends| kept("dv", ends, ("down to", ""), below(ends)));
        let across = ENDS.map(|ends| kept("du", ends, ("right to", ", signed"), beside(ends)));
        Vertices { places, values, order, tall, heights, across }
    }

    /// Centre coordinate of a vertex along the line, in 1/2^t px, signed.
    pub fn u(&self, place: usize) -> Signal<'m> {
        self.places[place]["u"].q()
    }

    /// Centre coordinate of a vertex down the screen, in 1/2^t px, signed.
    pub fn v(&self, place: usize) -> Signal<'m> {
        self.places[place]["v"].q()
    }

    /// A channel's value at a vertex, in the order and of the format at the port.
    pub fn value(&self, channel: &Channel, vertex: usize) -> Signal<'m> {
        self.values[vertex][channel.name].q()
    }
}

/// Where a vertex is, in centre coordinates.
fn corner(plan: &Plan) -> Vec<Part> {
    let w = plan.widths();
    let center = format!("Q{}.{}, signed", w.center - w.center_fraction, w.center_fraction);
    ["u", "v"].map(|name| Part { name: name.to_owned(), width: w.center, doc: center.clone() }).into()
}

/// Values of a vertex, one a channel.
fn values(plan: &Plan) -> Vec<Part> {
    let value = |channel: &Channel| Part {
        name: channel.name.to_owned(),
        width: channel.vertex_bits(),
        doc: format!("{} LSB", channel.vertex_format()),
    };
    plan.channels().iter().map(value).collect()
}

/// The unit of a centre coordinate without its point: 1/256 px of 8 fraction bits.
pub(super) fn center_unit(plan: &Plan) -> String {
    format!("1/{} px", 1 << plan.widths().center_fraction)
}

/// A port's coordinate as a centre coordinate.
fn center<'m>(plan: &Plan, x: Signal<'m>) -> Signal<'m> {
    let m = x.module();
    match (plan.fill, plan.subpixel_bits) {
        (Fill::Textbook, _) => m.cat(&[x, m.lit(1, 0)]),
        // 2x − 1
        (Fill::Exact, 0) => m.cat(&[x - 1, m.lit(1, 1)]),
        (Fill::Exact, s) => x - (1 << (s - 1)),
    }
}
