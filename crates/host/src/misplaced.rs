//! What slope edges that lie a little beside the true ones make of bilinear colours.

use edgewalk_machine::{COLOURS, Plan};
use edgewalk_scene::Vertex;

/// An edge on a line: where it is, px, its colours, LSB, and how far POLY may have it beside, px.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    x: f64,
    colours: [f64; 3],
    beside: f64,
}

/// An edge from its upper to its lower end: x and y, px, and colours, LSB.
type End = ([f64; 2], [f64; 3]);

/// The most that this makes of a colour of a polygon or triangle, LSB (`docs/numerics.md`, bound 20).
#[must_use]
pub fn misplaced(contours: &[Vec<Vertex>], machine: &Plan) -> f64 {
    let contours: Vec<Vec<End>> =
        contours.iter().map(|contour| contour.iter().map(|v| end(v, machine)).collect()).collect();
    of_contours(&contours, machine)
}

/// A vertex as the port has it.
fn end(vertex: &Vertex, machine: &Plan) -> End {
    let unit = f64::from(1u32 << machine.subpixel_bits);
    let snapped = |at: f64| (at * unit).round_ties_even() / unit;
    let one = machine.channels()[COLOURS.start].max() as f64;
    ([vertex.x, vertex.y].map(snapped), [vertex.r, vertex.g, vertex.b].map(|colour| colour * one))
}

/// The most on any line of a polygon.
fn of_contours(contours: &[Vec<End>], machine: &Plan) -> f64 {
    let sides = contours
        .iter()
        .flat_map(|contour| (0..contour.len()).map(move |k| [contour[k], contour[(k + 1) % contour.len()]]));
    let edges: Vec<[End; 2]> = sides.map(|[a, b]| if a.0[1] <= b.0[1] { [a, b] } else { [b, a] }).collect();
    let on_screen = |y: f64| (y - 0.5).ceil().clamp(0.0, f64::from(machine.height)) as u32;
    let first = edges.iter().map(|[upper, _]| on_screen(upper.0[1])).min().unwrap_or(0);
    let end = edges.iter().map(|[_, lower]| on_screen(lower.0[1])).max().unwrap_or(0);
    let mut most = 0.0f64;
    for line in first..end {
        let meets =
            |[upper, lower]: &&[End; 2]| (on_screen(upper.0[1])..on_screen(lower.0[1])).contains(&line);
        let mut crossings: Vec<Crossing> = edges
            .iter()
            .filter(meets)
            .map(|[upper, lower]| {
                let share = (f64::from(line) + 0.5 - upper.0[1]) / (lower.0[1] - upper.0[1]);
                let between = |a: f64, b: f64| a + share * (b - a);
                let walked = line - on_screen(upper.0[1]);
                let beside = f64::from(walked + 1) * 0.5f64.powi(machine.edge_fraction as i32 + 1);
                let colours = [0, 1, 2].map(|k| between(upper.1[k], lower.1[k]));
                Crossing { x: between(upper.0[0], lower.0[0]), colours, beside }
            })
            .collect();
        crossings.sort_by(|a, b| a.x.total_cmp(&b.x));
        most = most.max(of_line(&crossings));
    }
    most
}

/// The most on a line: what misplaced ends make of a span's colours, and what other edges do that may be taken for the ends.
fn of_line(crossings: &[Crossing]) -> f64 {
    let apart = |a: &Crossing, b: &Crossing| {
        let differences = a.colours.iter().zip(b.colours).map(|(a, b)| (a - b).abs());
        (b.x - a.x, a.beside.max(b.beside), differences.fold(0.0, f64::max))
    };
    let of_pair = |pair: &[Crossing]| {
        let (width, beside, difference) = apart(&pair[0], &pair[1]);
        let has_pixel = (pair[0].x - 0.5 - pair[0].beside).ceil() < (pair[1].x - 0.5 + pair[1].beside).ceil();
        if has_pixel { difference * (beside / width.max(f64::MIN_POSITIVE)).min(1.0) } else { 0.0 }
    };
    let spans = crossings.chunks_exact(2).map(of_pair).fold(0.0, f64::max);
    // Edges within twice of how far they may lie beside: any of them may be the end.
    let (mut ties, mut tie) = (0.0f64, 0.0);
    for pair in crossings.windows(2) {
        let (width, beside, difference) = apart(&pair[0], &pair[1]);
        tie = if width <= 2.0 * beside { tie + difference } else { 0.0 };
        ties = ties.max(tie);
    }
    spans + ties
}
