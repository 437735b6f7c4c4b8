//! What POLY makes colours along edges of: lengths of the edges, and the colours at the vertices.

use edgewalk_machine::{COLOURS, Channel, Plan};
use edgewalk_netlist::Signal;

use super::lines::Lines;
use super::sort::{ENDS, Vertices};

/// The fields of the prim that are there with bilinear colours.
pub(super) struct Along<'a> {
    /// None without them.
    colours: &'a [Channel],
}

impl<'a> Along<'a> {
    /// Of this machine.
    pub fn new(plan: &'a Plan) -> Along<'a> {
        Along { colours: if plan.polygon.is_bilinear() { &plan.channels()[COLOURS] } else { &[] } }
    }

    /// The field is one of them.
    pub fn has(&self, name: &str) -> bool {
        let of_colour = |(name, place): (&str, &str)| {
            place.len() == 1 && self.colours.iter().any(|channel| channel.name == name)
        };
        let length = |name: &str| name.starts_with("height") || name.starts_with("down");
        !self.colours.is_empty() && (length(name) || name.split_once("_at").is_some_and(of_colour))
    }

    /// The value of one of them. Its name ends with the places of the vertices.
    pub fn field<'m>(&self, name: &str, vertices: &Vertices<'m>, lines: &Lines<'m>) -> Signal<'m> {
        let place = |at: &str| at.bytes().next().map_or(0, |digit| usize::from(digit - b'0'));
        if let Some(ends) = name.strip_prefix("height") {
            let edge = ENDS.iter().position(|(from, to)| ends == format!("{from}{to}"));
            return vertices.heights[edge.unwrap_or(0)];
        }
        if let Some(vertex) = name.strip_prefix("down") {
            return [lines.h0, lines.h1][place(vertex)];
        }
        let (name, at) = name.split_once("_at").unwrap_or((name, "0"));
        let channel = self.colours.iter().find(|channel| channel.name == name).unwrap_or(&self.colours[0]);
        let order = vertices.order[place(at)];
        let value = |vertex: usize| vertices.value(channel, vertex);
        order.bit(1).mux(value(2), order.bit(0).mux(value(1), value(0)))
    }
}
