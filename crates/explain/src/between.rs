//! Bilinear colours of POLY at a pixel: from the left edge of its span to the right one, as the model's units have them.

use crate::accumulators::{half, lsb, signed};
use edgewalk_machine::{COLOURS, MAX_CHANNELS, Plan, PortVertex};
use edgewalk_model::Events;
use edgewalk_model::poly::Poly;
use edgewalk_model::setup::Setup;
use edgewalk_numerics::Steps;
use serde::Serialize;
use std::fmt::Write as _;

/// The span over a pixel.
#[derive(Serialize)]
pub(crate) struct Between {
    /// First pixel of the span.
    first: i32,
    /// Red, green and blue.
    colours: Vec<Colour>,
    /// Another edge lies so near to an end of the span that the machine may take it. The bound does not hold then.
    ambiguous: bool,
}

/// A colour, LSB, without the half that the output rounding adds.
#[derive(Serialize)]
struct Colour {
    name: &'static str,
    /// The value on the span's left edge.
    left: f64,
    /// The value on the span's right edge.
    right: f64,
    /// The value at the first pixel of the span.
    start: f64,
    /// The step from a pixel to the next.
    increment: f64,
    /// The value at the pixel.
    value: f64,
    /// The value less the colour between the true edges.
    error: f64,
    /// Largest permitted error: bound 20, and what an edge within its own bound can shift.
    bound: f64,
}

/// What the model had of the span.
struct Span {
    first: i32,
    /// First line of the polygon in this band.
    top: u32,
    /// Words of both edges, of the first pixel, and the increments.
    edges: [[u64; 3]; 2],
    start: [u64; 3],
    increment: [u64; 3],
}

/// An edge on a line: its place, px, its colours, LSB, and the lines that POLY has walked.
struct Crossing {
    x: f64,
    colours: [f64; 3],
    walked: u32,
}

/// The colours at a pixel of a polygon with these contours, sent as these tokens of its bands.
pub(crate) fn between(
    machine: &Plan,
    contours: &[Vec<PortVertex>],
    bands: &[Vec<[PortVertex; 3]>],
    pixel: (u32, u32),
) -> Option<Between> {
    if !machine.polygon.is_bilinear() {
        return None;
    }
    let span = bands.iter().find_map(|tokens| span(machine, tokens, pixel))?;
    let crossings = crossings(machine, contours, pixel.1, span.top);
    let centre = f64::from(pixel.0) + 0.5;
    let beside = |crossing: &Crossing| f64::from(crossing.walked + 1) * lsb(machine.edge_fraction + 1);
    let pair = crossings
        .chunks_exact(2)
        .position(|pair| pair[0].x - beside(&pair[0]) <= centre && centre <= pair[1].x + beside(&pair[1]))?;
    let [left, right] = [&crossings[2 * pair], &crossings[2 * pair + 1]];
    let most = beside(left).max(beside(right));
    let gap =
        |a: usize| crossings.get(a).zip(crossings.get(a + 1)).is_some_and(|(a, b)| b.x - a.x <= 2.0 * most);
    let ambiguous = (2 * pair).checked_sub(1).is_some_and(gap) || gap(2 * pair + 1);
    let columns = (pixel.0 as i32 - span.first) as u32; // the pixel is in the span
    let steps = Steps { lines: left.walked.max(right.walked), columns };
    let share = ((centre - left.x) / (right.x - left.x)).clamp(0.0, 1.0);
    let colour = |k: usize| {
        let channel = &machine.channels()[COLOURS.start + k];
        let number = |word: u64| signed(word, channel.word()) * lsb(channel.fraction);
        // A colour has no sign.
        let value =
            |word: u64| number(word).rem_euclid(f64::from(2u32).powi(channel.bits as i32)) - half(channel);
        let apart = right.colours[k] - left.colours[k];
        let increment = number(span.increment[k]);
        let start = value(span.start[k]);
        let at = start + increment * f64::from(columns);
        Colour {
            name: channel.name,
            left: value(span.edges[0][k]),
            right: value(span.edges[1][k]),
            start,
            increment,
            value: at,
            error: at - (left.colours[k] + share * apart),
            bound: machine.budget_behind(channel, steps).steps.to_f64()
                + apart.abs() * (most / (right.x - left.x)).min(1.0),
        }
    };
    Some(Between { first: span.first, colours: (0..3).map(colour).collect(), ambiguous })
}

/// The span that POLY gives over a pixel.
fn span(machine: &Plan, tokens: &[[PortVertex; 3]], (x, y): (u32, u32)) -> Option<Span> {
    const C: usize = MAX_CHANNELS;
    let (mut setup, mut poly) = (Setup::<C>::new(machine), Poly::<C>::new(machine));
    let events = &mut Events::default();
    let mut top = 0;
    for token in tokens {
        let Some(prim) = setup.run(token, events) else { continue };
        top = prim.start_pixel[1];
        while !poly.prim_ready(&prim, false) {
            poly.step(Some(&prim), false, true, false, events);
        }
        poly.step(Some(&prim), false, true, false, events);
        setup.step(None, true, false, events);
    }
    let over = |first: i32, behind: i32| (first..behind).contains(&(x as i32));
    let mut edges = None;
    while poly.walking() {
        if let Some((line, [left, right], colours)) = poly.pair()
            && line == y
            && over(left, right)
        {
            edges = Some(colours);
        }
        let line = poly.line().copied();
        if let Some((line, edges)) =
            line.zip(edges).filter(|(line, _)| line.y == y && over(line.major, line.minor))
        {
            let words = |from: &[u64; C]| [0, 1, 2].map(|k| from[COLOURS.start + k]);
            let (start, increment) = (words(&line.values), words(poly.gradient()));
            return Some(Span { first: line.major, top, edges, start, increment });
        }
        poly.step(None, false, line.is_some(), false, events);
    }
    None
}

/// The true crossings of a line with the edges of the vertices at the port, from left to right.
fn crossings(machine: &Plan, contours: &[Vec<PortVertex>], line: u32, top: u32) -> Vec<Crossing> {
    let sides = contours
        .iter()
        .flat_map(|contour| (0..contour.len()).map(move |k| [contour[k], contour[(k + 1) % contour.len()]]));
    let place = |at: i32| f64::from(at) * lsb(machine.subpixel_bits);
    let mut all: Vec<Crossing> = sides
        .map(|[a, b]| if a.y() <= b.y() { [a, b] } else { [b, a] })
        .filter_map(|[a, b]| {
            let lines = machine.first_pixel(a.y())..machine.first_pixel(b.y());
            let walked = (line as i32).checked_sub(lines.start.max(top as i32)).filter(|walked| *walked >= 0);
            let walked = walked.filter(|_| lines.contains(&(line as i32)))?;
            let share = (f64::from(line) + 0.5 - place(a.y())) / (place(b.y()) - place(a.y()));
            let between = |a: f64, b: f64| a + share * (b - a);
            let one = |k: usize| lsb(machine.channels()[COLOURS.start + k].vertex_fraction);
            let colour = |k: usize| {
                let value = |of: &PortVertex| of.values()[COLOURS.start + k] as f64 * one(k);
                between(value(&a), value(&b))
            };
            let x = between(place(a.x()), place(b.x()));
            Some(Crossing { x, colours: [0, 1, 2].map(colour), walked: walked as u32 })
        })
        .collect();
    all.sort_by(|a, b| a.x.total_cmp(&b.x));
    all
}

/// As lines of text.
pub(crate) fn text(of: &Between, x: u32) -> String {
    // Writing to a string cannot fail.
    let mut page = format!("colours from edge to edge, LSB; the span begins at pixel {}\n", of.first);
    let pixel = format!("pixel {x}");
    _ = writeln!(
        page,
        "      left edge  right edge  first pixel  increment {pixel:>11}      error      bound"
    );
    for Colour { name, left, right, start, increment, value, error, bound } in &of.colours {
        _ = writeln!(
            page,
            "{name:<3}{left:>12.4}{right:>12.4}{start:>13.4}{increment:>11.5}{value:>12.4}{error:>11.5}{bound:>11.5}"
        );
    }
    if of.ambiguous {
        page += "another edge is near an end of the span: the machine may take that one, and the bound does not hold\n";
    }
    page
}
