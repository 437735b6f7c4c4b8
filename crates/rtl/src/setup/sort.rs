//! The three vertices in centre coordinates, sorted by v.

use edgewalk_machine::{Channel, Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::control::Control;
use crate::wires::{Part, Registers, Token};

/// The edges' ends among the sorted vertices, above and below: major, first minor, second minor.
pub(super) const ENDS: [(usize, usize); 3] = [(0, 2), (0, 1), (1, 2)];

/// The triangle's vertices; after sorting 0 is the top and 2 the bottom.
pub(super) struct Vertices<'m> {
    places: Vec<Registers<'m>>,
    /// v of the lower end less v of the upper one, by edge; unsigned, DW − 1 bits.
    pub heights: Vec<Signal<'m>>,
    /// u1 − u0 and u2 − u0, signed, DW bits.
    pub du1: Signal<'m>,
    /// See `du1`.
    pub du2: Signal<'m>,
}

impl<'m> Vertices<'m> {
    /// Takes a triangle, then compares and swaps (0,1), (1,2), (0,1), a clock each; equals stay as they were.
    pub fn new(m: &'m Module, plan: &Plan, control: &Control<'m>, triangle: &Token<'m>) -> Vertices<'m> {
        m.comment("The vertices, in centre coordinates: pixel centres lie on the multiples of P.");
        let places: Vec<Registers> =
            (0..3).map(|place| Registers::new(m, &format!("p{place}"), vertex(plan))).collect();
        let above = |lower: usize, upper: usize| places[lower]["v"].q().slt(places[upper]["v"]);
        let middle = control.step.eq(1).named("second_clock");
        let swap01 = (control.sorting & !middle & above(1, 0)).named("swap01");
        let swap12 = (control.sorting & middle & above(2, 1)).named("swap12");
        for (place, registers) in places.iter().enumerate() {
            let place_name = place.to_string();
            let port = |name: String| triangle[name.as_str()];
            let take = |f: &str| match plan.channels().iter().find(|channel| channel.name == f) {
                Some(channel) => port(channel.at_vertex(&place_name)),
                None if f == "u" => center(plan, port(format!("x{place}"))),
                None => center(plan, port(format!("y{place}"))),
            };
            let swaps = [(swap01, [1, 0, 2]), (swap12, [0, 2, 1])];
            for (swap, order) in swaps.into_iter().filter(|(_, order)| order[place] != place) {
                registers.load(swap, |f| places[order[place]][f].q());
            }
            registers.load(control.take, take);
        }

        m.comment("Differences of the sorted vertices.");
        let bits = plan.widths().difference;
        let less =
            |f: &str, from: usize, to: usize| places[to][f].q().sext(bits) - places[from][f].q().sext(bits);
        let height = |(from, to): (usize, usize)| {
            less("v", from, to).trunc(bits - 1).named_doc(&format!("dv{from}{to}"), "1/P line")
        };
        let heights = ENDS.into_iter().map(height).collect();
        let du1 = less("u", 0, 1).named_doc("du01", "1/P column, signed");
        let du2 = less("u", 0, 2).named_doc("du02", "1/P column, signed");
        Vertices { places, heights, du1, du2 }
    }

    /// Column of a vertex, 1/P column, signed.
    pub fn u(&self, place: usize) -> Signal<'m> {
        self.places[place]["u"].q()
    }

    /// Line of a vertex, 1/P line, signed.
    pub fn v(&self, place: usize) -> Signal<'m> {
        self.places[place]["v"].q()
    }

    /// A channel's value at a vertex, of the format at the port.
    pub fn value(&self, channel: &Channel, place: usize) -> Signal<'m> {
        self.places[place][channel.name].q()
    }
}

/// What is kept of a vertex: its place in centre coordinates, and a value a channel.
fn vertex(plan: &Plan) -> Vec<Part> {
    let w = plan.widths();
    let center = format!("Q{}.{}, signed", w.center - w.center_fraction, w.center_fraction);
    let place = ["u", "v"].map(|name| Part { name: name.to_owned(), width: w.center, doc: center.clone() });
    let value = |channel: &Channel| Part {
        name: channel.name.to_owned(),
        width: channel.vertex_bits(),
        doc: format!("{} LSB", channel.vertex_format()),
    };
    place.into_iter().chain(plan.channels().iter().map(value)).collect()
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
