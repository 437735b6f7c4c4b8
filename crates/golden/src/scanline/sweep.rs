//! The active list of all polygons, from line to line.

use super::Crossing;
use super::surface::{Seen, Surface};
use crate::polygon::{ActiveEdge, Edge, Span};
use std::iter::Peekable;
use std::vec::IntoIter;

/// An edge and the place of its polygon in the list.
type Owned<'a> = (&'a Edge, usize);

/// The edges that cross a line.
pub(super) struct Sweep<'a> {
    /// Surfaces that enter later, by their first lines.
    waiting: Peekable<IntoIter<Owned<'a>>>,
    active: Vec<Owned<'a>>,
}

impl<'a> Sweep<'a> {
    /// Before the first line.
    pub fn new(surfaces: &'a [Surface]) -> Self {
        let edges =
            |(id, surface): (usize, &'a Surface)| surface.table.edges().iter().map(move |edge| (edge, id));
        let mut all: Vec<Owned> = surfaces.iter().enumerate().flat_map(edges).collect();
        all.sort_by_key(|(edge, _)| edge.lines().start);
        Self { waiting: all.into_iter().peekable(), active: Vec::new() }
    }

    /// Goes on to line y of a screen so wide; lines come in their order. Calls `visit` with the number of active edges and where spans begin and end on the
    /// screen, from left to right, if there are any.
    pub fn line(
        &mut self,
        surfaces: &'a [Surface],
        [width, y]: [u32; 2],
        visit: impl FnOnce(usize, &[Crossing]),
    ) {
        let line = i64::from(y);
        while let Some(edge) = self.waiting.next_if(|(edge, _)| edge.lines().start <= line) {
            self.active.push(edge);
        }
        // Ymax is not counted.
        self.active.retain(|(edge, _)| edge.lines().contains(&line));
        let mut crossings: Vec<(ActiveEdge, usize)> =
            self.active.iter().map(|(edge, id)| (ActiveEdge::on(edge, line), *id)).collect();
        crossings.sort_by(|(a, own), (b, other)| a.order(b).then(own.cmp(other)));
        let ends = ends(surfaces, width, line, &crossings);
        if !ends.is_empty() {
            visit(self.active.len(), &ends);
        }
    }
}

/// Turns the flags of polygons: the first crossing of a polygon begins a span, the next one ends it.
fn ends<'a>(
    surfaces: &'a [Surface],
    width: u32,
    line: i64,
    crossings: &[(ActiveEdge<'a>, usize)],
) -> Vec<Crossing<'a>> {
    let mut inside: Vec<(usize, ActiveEdge)> = Vec::new();
    let mut ends = Vec::new();
    for (edge, id) in crossings {
        let Some(open) = inside.iter().position(|(other, _)| other == id) else {
            inside.push((*id, *edge));
            continue;
        };
        let (_, left) = inside.swap_remove(open);
        let span = Span::new(left, *edge, line);
        let columns = span.columns(width);
        let seen = Seen { id: *id, start: columns.start, span, surface: &surfaces[*id] };
        if !columns.is_empty() {
            ends.push(Crossing { column: columns.start, begins: true, seen });
            ends.push(Crossing { column: columns.end, begins: false, seen });
        }
    }
    ends.sort_by_key(|end| end.column);
    ends
}
