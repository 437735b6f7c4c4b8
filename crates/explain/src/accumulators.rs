//! The accumulators of the channels before their outputs are rounded: how far they are from the exact plane.

use crate::unseen_way;
use edgewalk_host::port::PortFrame;
use edgewalk_machine::{Channel, Plan, PortVertex, Role};
use edgewalk_model::Events;
use edgewalk_model::edge::Edge;
use edgewalk_model::setup::Setup;
use edgewalk_model::span::Span;
use edgewalk_model::tokens::{MAX_CHANNELS, Prim, Words, add, word_masks};
use edgewalk_numerics::Steps;

/// What SETUP makes of a triangle; `None` if it is culled. A token of most channels serves any machine.
pub fn prim(machine: &Plan, triangle: &[PortVertex; 3]) -> Option<Prim<MAX_CHANNELS>> {
    Setup::new(machine).run(triangle, &mut Events::default())
}

/// The depth's accumulator at every pixel that shows a triangle, minus the exact depth there, over the largest error that its
/// additions can have made (bound 2): -1 to 1. A pixel without a triangle has 0, and so has one that shows a line. `ids` names for
/// each pixel what it shows, as `port.ids` does. `None` where the way to a pixel is not that of exact edges.
pub fn depth_error_over_bound(machine: &Plan, port: &PortFrame, ids: &[i32]) -> Option<Vec<f64>> {
    if unseen_way(machine).is_some() {
        return None;
    }
    let mut map = vec![0.0; ids.len()];
    for (triangle, id) in port.triangles.iter().zip(&port.ids) {
        // EDGE walks a line with its axes exchanged, or a pixel wide: its depths are not those of a plane.
        if matches!(Role::of(triangle), Role::Line { .. }) {
            continue;
        }
        let plane = Plane { machine, triangle };
        each_fragment(machine, triangle, |x, y, steps, words| {
            let at = y as usize * machine.width as usize + x as usize;
            if ids[at] == *id {
                let bound = machine.channels()[0].error_budget(steps).steps.to_f64();
                map[at] = plane.error(plane.weights(i64::from(x), y), words[0], 0) / bound;
            }
        });
    }
    Some(map)
}

/// Calls `seen` with every visible pixel of a triangle, the additions behind it and the accumulators there.
fn each_fragment(
    machine: &Plan,
    triangle: &[PortVertex; 3],
    mut seen: impl FnMut(u32, u32, Steps, &Words<MAX_CHANNELS>),
) {
    let Some(prim) = prim(machine, triangle) else { return };
    let masks = word_masks(machine);
    let events = &mut Events::default();
    let mut edge = Edge::new(machine);
    edge.step(Some(&prim), false, true, events);
    let mut lines = 0;
    while let Some(line) = edge.line().copied() {
        let mut spans = Span::new(machine);
        spans.step(Some(&line), false, false, events);
        spans.step(None, false, false, events); // from its register into the queue
        if let Some(span) = spans.span() {
            let direction = if span.leftward { -1 } else { 1 };
            let mut values = span.values;
            for columns in 0..span.count {
                let x = i64::from(span.x) + direction * i64::from(columns);
                if let Some(x) = u32::try_from(x).ok().filter(|x| *x < machine.width) {
                    seen(x, line.y, Steps { lines, columns }, &values);
                }
                values = add(&values, edge.gradient(), &masks);
            }
        }
        lines += 1;
        edge.step(None, false, true, events);
    }
}

/// The planes through the values of the vertices at the port.
pub struct Plane<'a> {
    /// Exact fill.
    pub machine: &'a Plan,
    /// Not culled.
    pub triangle: &'a [PortVertex; 3],
}

impl Plane<'_> {
    /// What the vertices weigh at the centre of a pixel; they add up to 1.
    pub fn weights(&self, x: i64, y: u32) -> [f64; 3] {
        let unit = f64::from(1u32 << self.machine.subpixel_bits);
        let place = |v: &PortVertex| [f64::from(v.x()) / unit, f64::from(v.y()) / unit];
        let [a, b, c] = self.triangle.each_ref().map(place);
        let p = [x as f64 + 0.5, f64::from(y) + 0.5];
        let cross = |from: [f64; 2], to: [f64; 2], at: [f64; 2]| {
            (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
        };
        [cross(b, c, p), cross(c, a, p), cross(a, b, p)].map(|weight| weight / cross(a, b, c))
    }

    /// Channel `i` where the vertices weigh so much, LSB.
    pub fn at(&self, weights: [f64; 3], i: usize) -> f64 {
        let scale = lsb(self.machine.channels()[i].vertex_fraction);
        self.triangle.iter().zip(weights).map(|(v, weight)| weight * v.values()[i] as f64 * scale).sum()
    }

    /// The accumulator of channel `i` minus the plane there, LSB; without the half that the output rounding adds.
    pub fn error(&self, weights: [f64; 3], word: u64, i: usize) -> f64 {
        let channel = &self.machine.channels()[i];
        let turn = 2f64.powi(channel.bits as i32);
        let value = signed(word, channel.word()) * lsb(channel.fraction);
        let off = value - half(channel) - self.at(weights, i);
        // The words are modular: whole turns are no error.
        off - turn * (off / turn).round()
    }
}

/// What the start carries for the output rounding, LSB: nothing where the output is the floor, or there are no fraction bits to
/// round away.
pub fn half(channel: &Channel) -> f64 {
    if channel.kind.is_rounded() && channel.fraction > 0 { 0.5 } else { 0.0 }
}

/// The last of so many fraction bits.
pub fn lsb(fraction: u32) -> f64 {
    0.5f64.powi(fraction as i32)
}

/// A word as a signed number: values just below 0 and increments.
pub fn signed(word: u64, bits: u32) -> f64 {
    let shift = 64 - bits;
    ((word << shift) as i64 >> shift) as f64
}
