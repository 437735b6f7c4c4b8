//! The front as a picture, for readers without scripts: the first two objectives, a mark for each machine.

use super::escaped;
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
        for value in ticks(low, high) {
            let at = place(axis, value);
            _ = if axis == 0 {
                write!(
                    svg,
                    "<text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                    bottom + 18.0,
                    tick(value)
                )
            } else {
                write!(
                    svg,
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
                    left - 6.0,
                    at + 4.0,
                    tick(value)
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

/// Up to seven round values from `low` to `high`, both of them among the possible: 1, 2 or 5 times a power of ten apart.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    if high <= low {
        return vec![low];
    }
    let rough = (high - low) / 5.0;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|times| times * power).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|place| place as f64 * step).collect()
}

/// A round value, with commas between thousands.
fn tick(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    let (whole, fraction) = text.find('.').map_or((text, ""), |point| text.split_at(point));
    let mut grouped = String::new();
    for (place, digit) in whole.chars().enumerate() {
        if place > 0 && digit != '-' && (whole.len() - place).is_multiple_of(3) && !grouped.ends_with('-') {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped + fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(185_525.0, 599_080.0), [200_000.0, 300_000.0, 400_000.0, 500_000.0]);
        assert_eq!(ticks(0.0, 1.0), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(ticks(7.0, 7.0), [7.0]);
        let said = [200_000.0, 1234.5, -4000.0, 0.6000000000000001, 0.0].map(tick);
        assert_eq!(said, ["200,000", "1,234.5", "-4,000", "0.6", "0"]);
    }
}
