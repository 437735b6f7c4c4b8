//! The front as a picture, for readers without scripts: the first two objectives.

use super::{escaped, number};
use crate::sweep::table::Table;
use std::fmt::Write as _;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 420.0;
const MARGIN: [f64; 2] = [70.0, 40.0];

/// SVG; nothing where fewer than two objectives are known of any machine.
pub fn front(table: &Table) -> String {
    let [x, y, ..] = &table.sweep.objectives[..] else { return String::new() };
    let machines = || table.machines.iter().filter_map(|machine| Some((machine, machine.values.as_ref()?)));
    let range = |place: usize| {
        let values = machines().map(|(_, values)| values[place]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let ranges = [range(0), range(1)];
    if ranges[0].0 > ranges[0].1 {
        return "<p>No machine has all objectives.</p>".to_owned();
    }
    let place = |axis: usize, value: f64| {
        let (low, high) = ranges[axis];
        let share = if high > low { (value - low) / (high - low) } else { 0.5 };
        let length = [WIDTH, HEIGHT][axis] - 2.0 * MARGIN[axis];
        MARGIN[axis] + if axis == 0 { share * length } else { (1.0 - share) * length }
    };
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{} over {}\" class=\"chart\">",
        escaped(y.name),
        escaped(x.name)
    );
    // Writing to a string cannot fail.
    let [left, top] = MARGIN;
    let (right, bottom) = (WIDTH - left, HEIGHT - top);
    _ = write!(svg, "<path d=\"M{left} {top}V{bottom}H{right}\" class=\"axis\"/>");
    for (axis, (low, high)) in ranges.into_iter().enumerate() {
        for value in [low, high] {
            let at = place(axis, value);
            _ = if axis == 0 {
                write!(
                    svg,
                    "<text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                    bottom + 18.0,
                    number(value)
                )
            } else {
                write!(
                    svg,
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
                    left - 6.0,
                    at + 4.0,
                    number(value)
                )
            };
        }
    }
    _ = write!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
        WIDTH / 2.0,
        HEIGHT - 4.0,
        escaped(x.name)
    );
    _ = write!(svg, "<text x=\"{left}\" y=\"{}\">{}</text>", top - 14.0, escaped(y.name));
    let mut rest = String::new();
    for (machine, values) in machines() {
        let (x, y) = (place(0, values[0]), place(1, values[1]));
        if machine.front == Some(1) {
            _ = write!(svg, "<path d=\"M{x:.1} {:.1}l6 6l-6 6l-6 -6z\" class=\"front\"/>", y - 6.0);
        } else {
            _ = write!(rest, "M{x:.1} {y:.1}h0");
        }
    }
    _ = write!(svg, "<path d=\"{rest}\" class=\"rest\"/>");
    svg + "</svg><p class=\"key\">◆ no other machine is at least as good in every objective; • others.</p>"
}
