//! The active edges of POLY on a line: the registers of each, as the machine has them.

use crate::between::{self, Between, between};
use edgewalk_host::polygon::{is_for_poly, on_port, tokens};
use edgewalk_machine::{MAX_CHANNELS, Plan, PortVertex};
use edgewalk_model::Events;
use edgewalk_model::setup::Setup;
use edgewalk_model::tokens::{EdgeWalk, Prim};
use edgewalk_scene::{Frame, Primitive};
use serde::Serialize;
use std::fmt::Write as _;

/// A polygon whose edges POLY walks over the pixel's line.
#[derive(Serialize)]
pub(crate) struct InPoly {
    /// Place of the polygon among the frame's primitives.
    id: usize,
    /// The line's active edges in the order of their columns.
    active: Vec<Active>,
    /// Of each pair with a pixel its first column, and the first no longer inside.
    pairs: Vec<[i32; 2]>,
    /// First column, and first no longer inside, of the pair around the pixel.
    pair: Option<[i32; 2]>,
    /// With `polygon.values = bilinear`: colours at the pixel, where it lies in the polygon.
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<Between>,
}

/// The record of an edge on the line.
#[derive(Clone, Copy, Serialize)]
struct Active {
    /// First column whose centre lies on or right of the edge.
    c: i32,
    /// From the edge to that column, 1/m column.
    r: i32,
    /// Whole columns a line.
    q: i32,
    /// 1/m column a line.
    f: i32,
    m: i32,
    /// Lines left, this one among them.
    lines_left: u32,
}

/// Every polygon that POLY draws with an edge on line y; `x` chooses the pair.
pub(crate) fn in_poly(frame: &Frame, machine: &Plan, (x, y): (u32, u32)) -> Vec<InPoly> {
    if !is_for_poly(frame, machine) {
        return Vec::new();
    }
    let primitives = frame.primitives();
    let mut found = Vec::new();
    for pass in frame.passes() {
        for id in pass.primitives.clone().take_while(|id| *id < primitives.len()) {
            let Primitive::Polygon(polygon) = primitives[id] else { continue };
            // The frame was taken by the port before.
            let contours = on_port(id, polygon, frame, &pass.state, machine).unwrap_or_default();
            let bands = tokens(id, &contours, machine).unwrap_or_default();
            let mut active: Vec<Active> =
                bands.iter().flatten().flat_map(|token| edges(machine, token, y)).collect();
            active.sort_by_key(|edge| edge.c); // stable
            let pairs = active.chunks_exact(2).map(|pair| [pair[0].c, pair[1].c]);
            let pairs: Vec<[i32; 2]> = pairs.filter(|[left, right]| left < right).collect();
            let pair = pairs.iter().copied().find(|[left, right]| (*left..*right).contains(&(x as i32)));
            if !active.is_empty() {
                let between = between(machine, &contours, &bands, (x, y));
                found.push(InPoly { id, active, pairs, pair, between });
            }
        }
    }
    found
}

/// The edges of a token on a line.
fn edges(machine: &Plan, token: &[PortVertex; 3], line: u32) -> Vec<Active> {
    let mut setup = Setup::<MAX_CHANNELS>::new(machine);
    let Some(prim) = setup.run(token, &mut Events::default()) else { return Vec::new() };
    sides(&prim).into_iter().filter_map(|side| on_line(machine, side, line)).collect()
}

/// First line, lines and registers of the sides that count.
fn sides(prim: &Prim<MAX_CHANNELS>) -> Vec<(u32, u32, EdgeWalk)> {
    let [n1, n2] = prim.lines;
    let all = [
        (prim.line, n1 + n2, prim.major),
        (prim.line, n1, prim.minor[0]),
        (prim.line + n1, n2, prim.minor[1]),
    ];
    all.into_iter()
        .enumerate()
        .filter(|(side, _)| prim.sides >> side & 1 == 1)
        .map(|(_, side)| side)
        .collect()
}

/// The edge on a line, if it is there.
fn on_line(machine: &Plan, (first, lines, mut walk): (u32, u32, EdgeWalk), line: u32) -> Option<Active> {
    let below = line.checked_sub(first).filter(|below| *below < lines)?;
    for _ in 0..below {
        walk.step(machine.widths().column);
    }
    let EdgeWalk { c, r, q, f, m } = walk;
    Some(Active { c, r, q, f, m, lines_left: lines - below })
}

/// As lines of text.
pub(crate) fn text(of: &InPoly, (x, y): (u32, u32)) -> String {
    // Writing to a string cannot fail.
    let mut page = format!("\npolygon {}: POLY's active edges on line {y}\n", of.id);
    _ = writeln!(page, "       C         R       q         f         M  lines left");
    for Active { c, r, q, f, m, lines_left } in &of.active {
        _ = writeln!(page, "{c:>8}{r:>10}{q:>8}{f:>10}{m:>10}  {lines_left:>10}");
    }
    let pairs: Vec<String> = of.pairs.iter().map(|[left, right]| format!("{left} to {right}")).collect();
    _ = writeln!(page, "pairs: {}", if pairs.is_empty() { "none".to_owned() } else { pairs.join(", ") });
    match of.pair {
        Some([left, right]) => _ = writeln!(page, "pixel {x} lies in the pair {left} to {right}"),
        None => _ = writeln!(page, "pixel {x} lies in no pair"),
    }
    of.between.iter().for_each(|colours| page += &between::text(colours, x));
    page
}
