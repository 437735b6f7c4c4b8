//! SETUP: from three vertices to edges and increments.

use super::tokens;
use crate::field::Field;
use crate::link::Link;
use crate::machine::{Fill, Machine};
use crate::plan::Plan;
use crate::unit::{Ports, UnitSpec, always, events, light_pass};

/// What SETUP declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "setup",
    purpose: "turns three vertices into edges and increments",
    section: 2,
    present: always,
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn ports(plan: &Plan) -> Ports {
    Ports {
        takes: Some(if plan.is_sequenced() { words(plan) } else { Link::new("tri", tokens::triangle(plan)) }),
        gives: Some(Link::new("prim", tokens::prim(plan))),
        constants: light_pass(plan).into_iter().collect(),
        ..Ports::default()
    }
}

/// A triangle or line word by word. Its role and the tag are no words: they take no cycle of their own.
fn words(plan: &Plan) -> Link {
    let (beside, words): (Vec<Field>, Vec<Field>) = tokens::triangle(plan)
        .into_iter()
        .partition(|field| ["thin", "flat", "tag"].contains(&field.name.as_str()));
    let bits = words.iter().map(Field::width).max().unwrap_or(1); // never empty
    let data = Field::count("data", bits, listed(plan, &words));
    Link { words, ..Link::new("in", std::iter::once(data).chain(beside).collect()) }
}

/// How many words a triangle has, and which, with their formats. Words side by side of one format share it.
fn listed(plan: &Plan, words: &[Field]) -> String {
    let names: Vec<&str> = ["x", "y"].into_iter().chain(plan.channels().iter().map(|c| c.name)).collect();
    let mut runs: Vec<(String, Vec<&str>)> = Vec::new();
    for (name, word) in names.iter().copied().zip(words) {
        match runs.last_mut() {
            Some((format, names)) if *format == word.bits() => names.push(name),
            _ => runs.push((word.bits(), vec![name])),
        }
    }
    let runs: Vec<_> = runs.iter().map(|(format, names)| format!("{} ({format})", names.join(" "))).collect();
    let behind: Vec<_> = words[3 * names.len()..].iter().map(|w| format!(". Then {w}")).collect();
    let (count, each, behind) = (words.len(), runs.join(", "), behind.concat());
    format!("{count} words a triangle, each in the low bits. Of vertex 0, 1, 2 in turn: {each}{behind}")
}

events! {
    culled_lines = "triangles without a line on the screen" if always;
    culled_columns = "triangles with lines, but without a column on the screen" if |plan| plan.fill == Fill::Exact;
    culled_area = "triangles with lines and columns, but without area" if always;
    major_left = "triangles whose major edge lies left" if always;
    major_right = "triangles whose major edge lies right" if always;
    no_upper_part = "triangles without an upper part on the screen, n1 = 0" if always;
    no_lower_part = "triangles without a lower part on the screen, n2 = 0" if always;
    line_flat = "lines along a row of pixels, with x and y exchanged, that have one on the screen" if |plan| plan.polygon.has_lines();
    line_steep = "lines along a column of pixels that have one on the screen" if |plan| plan.polygon.has_lines();
    window_top = "triangles and parts of polygons that the first line of the window cuts, on the screen" if |plan| plan.polygon.is_there();
    window_bottom = "triangles and parts of polygons that the end of the window cuts, above the screen's" if |plan| plan.polygon.is_there();
    knee_on_line = "triangles of two parts whose knee lies on a line of pixel centres" if always;
}
