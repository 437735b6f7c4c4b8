//! The edge table of each polygon on a line, and its active edges there.

use edgewalk_golden::polygon::EdgeTable;
use edgewalk_machine::{Fill, Plan};
use edgewalk_scene::{Frame, Primitive};
use serde::Serialize;
use std::fmt::Write as _;

/// A polygon whose edges cross the pixel's line, or end on it.
#[derive(Serialize)]
pub(crate) struct OnLine {
    /// Place of the polygon among triangles and polygons.
    id: usize,
    /// The edge table of the line, as the lecture prints it.
    table: String,
    /// The edges that cross the line, from left to right.
    active: Vec<Active>,
    /// Names of the edges that enter on this line, and of those whose Ymax it is, which are no longer there.
    enters: Vec<String>,
    left: Vec<String>,
    /// First pixel, and first pixel no longer inside, of the pair of edges around the pixel.
    span: Option<[i64; 2]>,
}

/// An edge on the line.
#[derive(Serialize)]
struct Active {
    /// Names of its ends, Ymin first.
    edge: String,
    /// Where it crosses, pixels.
    x: f64,
    /// The first pixel that is not left of it.
    column: i64,
    /// Lines left to it, this one among them.
    lines_left: i64,
}

/// Every polygon of the frame with an edge on line y; `x` chooses the span.
pub(crate) fn on_line(frame: &Frame, machine: &Plan, (x, y): (u32, u32)) -> Vec<OnLine> {
    let grid = match machine.fill {
        Fill::Exact => edgewalk_golden::polygon::Grid::subpixels(machine.subpixel_bits),
        Fill::Textbook => edgewalk_golden::polygon::Grid::whole(),
    };
    let (x, line) = (i64::from(x), i64::from(y));
    let polygons = frame.primitives().into_iter().enumerate();
    polygons
        .filter_map(|(id, primitive)| {
            let Primitive::Polygon(polygon) = primitive else { return None };
            let table = EdgeTable::new(polygon, frame.mode, grid);
            let names = |on: &dyn Fn(&std::ops::Range<i64>) -> bool| {
                let edges = table.edges().iter().filter(|edge| on(&edge.lines()));
                edges.map(|edge| edge.ends().join("-")).collect::<Vec<_>>()
            };
            let (enters, left) = (names(&|lines| lines.start == line), names(&|lines| lines.end == line));
            let (mut active, mut span) = (Vec::new(), None);
            table.scan(line..line + 1, |_, crossings| {
                active = crossings
                    .iter()
                    .map(|crossing| Active {
                        edge: crossing.edge().ends().join("-"),
                        x: crossing.x(),
                        column: crossing.column(),
                        lines_left: crossing.edge().lines().end - line,
                    })
                    .collect();
                let mut pairs = crossings.chunks_exact(2).map(|pair| [pair[0].column(), pair[1].column()]);
                span = pairs.find(|[start, end]| (*start..*end).contains(&x));
            });
            let there = !active.is_empty() || !left.is_empty();
            there.then(|| OnLine { id, table: table.to_string(), active, enters, left, span })
        })
        .collect()
}

/// As lines of text.
pub(crate) fn text(of: &OnLine, (x, y): (u32, u32)) -> String {
    // Writing to a string cannot fail.
    let mut page = format!("\npolygon {}: its edge table\n{}", of.id, of.table);
    _ = writeln!(page, "active edges on line {y}");
    _ = writeln!(page, "edge             x   first pixel  lines left");
    for Active { edge, x, column, lines_left } in &of.active {
        _ = writeln!(page, "{edge:<6}{x:>12.4}  {column:>12}  {lines_left:>10}");
    }
    for (what, edges) in [("enter", &of.enters), ("have left: the line is their Ymax", &of.left)] {
        if !edges.is_empty() {
            _ = writeln!(page, "{}: {what}", edges.join(", "));
        }
    }
    match of.span {
        Some([start, end]) => _ = writeln!(page, "pixel {x} lies in the span {start}..{end}"),
        None => _ = writeln!(page, "pixel {x} lies in no span: an even number of edges on its left"),
    }
    page
}
