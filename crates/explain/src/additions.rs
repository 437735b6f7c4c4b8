//! The machine's way to a pixel: start, increments down the major edge, increments along the span.

use crate::accumulators::{Plane, lsb, prim, signed};
use edgewalk_host::extra::Label;
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::Events;
use edgewalk_model::edge::Edge;
use edgewalk_model::span::Span;
use edgewalk_model::tokens::{MAX_CHANNELS, Words, add, output, word_masks};
use edgewalk_numerics::Steps;
use serde::Serialize;

/// The accumulators on their way.
#[derive(Debug, Serialize)]
pub struct Walk {
    /// The channels whose accumulators follow: z, r, g, b, then the user's own. All lists below are in this order.
    pub channels: Vec<Label>,
    /// From the start on.
    pub additions: Vec<Addition>,
    /// What PIXEL hands on at the pixel, LSB.
    pub output: Vec<i64>,
}

/// One value of the accumulators.
#[derive(Debug, Serialize)]
pub struct Addition {
    /// `start`, `line` or `pixel`.
    pub step: &'static str,
    /// Column that the values belong to.
    pub x: i64,
    /// Line.
    pub y: u32,
    /// What was added, LSB; the start itself in the first.
    pub added: Vec<f64>,
    /// The values, LSB, without the half that the output rounding adds.
    pub value: Vec<f64>,
    /// Values minus those of the plane through the vertices at the port, LSB.
    pub error: Vec<f64>,
    /// No error can be larger here (bound 2), LSB.
    pub bound: Vec<f64>,
}

/// The way to pixel (x, y); `None` if the triangle does not draw it. The machine has exact fill and exact edges.
pub fn walk(machine: &Plan, triangle: &[PortVertex; 3], x: u32, y: u32) -> Option<Walk> {
    let prim = prim(machine, triangle)?;
    let plane = Plane { machine, triangle };
    let masks = word_masks(machine);
    let events = &mut Events::default();
    let mut edge = Edge::new(machine);
    edge.step(Some(&prim), false, true, events);
    let mut additions = Vec::new();
    let mut lines = 0;
    let mut before = [0; MAX_CHANNELS];
    while let Some(line) = edge.line() {
        // The span begins right of the major edge, or left of it.
        let first = i64::from(line.major) - i64::from(line.major_right);
        let step = if lines == 0 { "start" } else { "line" };
        additions.push(plane.addition(step, (first, line.y), (&before, &line.values), (lines, 0)));
        if line.y == y {
            break;
        }
        before = line.values;
        lines += 1;
        edge.step(None, false, true, events);
    }
    let line = *edge.line()?;
    let mut spans = Span::new(machine);
    spans.step(Some(&line), false, false, events);
    spans.step(None, false, false, events); // from its register into the queue
    let span = spans.span()?;
    let direction = if span.leftward { -1 } else { 1 };
    let columns = (i64::from(x) - i64::from(span.x)) * direction;
    if !(0..i64::from(span.count)).contains(&columns) {
        return None;
    }
    let mut values = span.values;
    for step in 1..=columns {
        let next = add(&values, edge.gradient(), &masks);
        let column = i64::from(span.x) + direction * step;
        additions.push(plane.addition("pixel", (column, y), (&values, &next), (lines, step as u32)));
        values = next;
    }
    let channels = machine.channels();
    let outputs = channels.iter().zip(values).map(|(of, word)| output(of, (word >> of.fraction) as u32));
    Some(Walk { channels: channels.iter().map(Label::of).collect(), additions, output: outputs.collect() })
}

impl Plane<'_> {
    fn addition(
        &self,
        step: &'static str,
        (x, y): (i64, u32),
        (before, after): (&Words<MAX_CHANNELS>, &Words<MAX_CHANNELS>),
        (lines, columns): (u32, u32),
    ) -> Addition {
        let weights = self.weights(x, y);
        let channels = self.machine.channels();
        let each = |of: &dyn Fn(usize) -> f64| (0..channels.len()).map(of).collect();
        let error = |i: usize| self.error(weights, after[i], i);
        let value = |i: usize| self.at(weights, i) + error(i);
        let steps = Steps { lines, columns };
        Addition {
            step,
            x,
            y,
            added: each(&|i| {
                let word = channels[i].word();
                let mask = (1u64 << word) - 1;
                match step {
                    "start" => value(i),
                    _ => signed(after[i].wrapping_sub(before[i]) & mask, word) * lsb(channels[i].fraction),
                }
            }),
            value: each(&value),
            error: each(&error),
            bound: each(&|i| channels[i].error_budget(steps).steps.to_f64()),
        }
    }
}
