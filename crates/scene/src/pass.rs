//! A frame as a list of passes: what is drawn by the same rules, and what changes between.

use crate::frame::{Frame, Shadow};
use crate::polygon::Primitive;
use crate::rules::State;
use std::ops::Range;

/// Primitives that are drawn by the same rules, one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pass {
    /// Places of the pass in the list, [`Frame::primitives`].
    pub primitives: Range<usize>,
    /// The rules.
    pub state: State,
    /// The depth is cleared before it.
    pub clear_depth: bool,
}

impl Frame {
    /// The first triangles, polygons and lines in the order in which they are drawn, at most so many.
    #[must_use]
    pub fn first(mut self, most: usize) -> Self {
        if most >= self.drawn() {
            return self;
        }
        let (mut triangles, mut polygons) = (0, 0);
        for primitive in self.primitives().into_iter().take(most) {
            match primitive {
                Primitive::Triangle(_) => triangles += 1,
                Primitive::Polygon(_) => polygons += 1,
                Primitive::Line(_) => {}
            }
        }
        self.triangles.truncate(triangles);
        self.polygons.truncate(polygons);
        self.lines.truncate(most - triangles - polygons);
        if let Some(shading) = &mut self.shading {
            shading.triangles.truncate(triangles);
        }
        self
    }

    /// How many triangles, polygons and lines it draws.
    pub fn drawn(&self) -> usize {
        self.triangles.len() + self.polygons.len() + self.lines.len()
    }

    /// The rules at the beginning.
    pub fn state(&self) -> State {
        State {
            depth: self.depth,
            depth_write: self.depth_write,
            blend: self.blend,
            color_write: self.color_write,
            light: self.light,
        }
    }

    /// The shadows of the light with this number.
    pub fn shadow(&self, light: usize) -> Option<&Shadow> {
        self.shadows.get(light.checked_sub(1)?)
    }

    /// The passes in order, at least one; those without a primitive are left out unless nothing is drawn at
    /// all. What they clear the next one clears.
    pub fn passes(&self) -> Vec<Pass> {
        let all = self.drawn();
        let mut passes = Vec::new();
        let (mut from, mut state, mut clear_depth) = (0, self.state(), false);
        for change in &self.changes {
            let to = change.after.clamp(from, all);
            if to > from {
                passes.push(Pass {
                    primitives: from..to,
                    state,
                    clear_depth: std::mem::take(&mut clear_depth),
                });
            }
            (from, state) = (to, change.state);
            clear_depth |= change.clear_depth;
        }
        if all > from || passes.is_empty() {
            passes.push(Pass { primitives: from..all, state, clear_depth });
        }
        passes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Line, Polygon};
    use crate::rules::{Blending, Change};
    use crate::vertex::Triangle;

    #[test]
    fn the_first_are_first_in_drawing_order() {
        let mut frame = Frame::new(4, 4);
        frame.triangles = vec![Triangle::default(); 3];
        // t p t l p t
        frame.polygons = [1, 2].map(|after| Polygon { contours: Vec::new(), after }).to_vec();
        frame.lines = vec![Line { ends: Default::default(), after: 3 }];
        let of = |most| {
            let first = frame.clone().first(most);
            [first.triangles.len(), first.polygons.len(), first.lines.len()]
        };
        let counts = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0], [2, 1, 1], [2, 2, 1], [3, 2, 1], [3, 2, 1]];
        counts.iter().enumerate().for_each(|(most, counts)| assert_eq!(of(most), *counts, "{most}"));
    }

    #[test]
    fn every_primitive_has_one_pass() {
        let mut frame = Frame::new(4, 4);
        assert_eq!(frame.passes().len(), 1, "an empty frame has its rules too");
        frame.triangles = vec![Triangle::default(); 5];
        let add = State { blend: Blending::Add, ..frame.state() };
        let off = State { depth: None, ..add };
        let change = |after, state, clear_depth| Change { after, state, clear_depth };
        frame.changes =
            vec![change(2, add, false), change(2, off, true), change(4, add, false), change(5, off, true)];
        let passes: Vec<_> =
            frame.passes().into_iter().map(|p| (p.primitives, p.state, p.clear_depth)).collect();
        assert_eq!(passes, [(0..2, frame.state(), false), (2..4, off, true), (4..5, add, false)]);
    }
}
