//! How many triangles, polygons and lines, and how a report says so.

use crate::role::{Role, wholes};
use crate::vertex::PortVertex;
use std::fmt;

/// Numbers of what is drawn, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counted {
    /// Triangles.
    pub triangles: usize,
    /// Polygons, each of one token or more at the port.
    pub polygons: usize,
    /// Lines.
    pub lines: usize,
}

impl Counted {
    /// Numbers of what these tokens of the port draw.
    #[must_use]
    pub fn of(tokens: &[[PortVertex; 3]]) -> Counted {
        let mut counted = Counted::default();
        for last in wholes(tokens).filter_map(<[_]>::last) {
            match Role::of(last) {
                Role::Triangle => counted.triangles += 1,
                Role::Edges(_) | Role::Plane(_) => counted.polygons += 1,
                Role::Line { .. } => counted.lines += 1,
            }
        }
        counted
    }

    /// Triangles, polygons and lines together.
    #[must_use]
    pub fn total(self) -> usize {
        self.triangles + self.polygons + self.lines
    }

    /// A part of `all` in words: `2 of 5 polygons`, or `1 triangle and 2 polygons of 1 triangle and 8 polygons`.
    #[must_use]
    pub fn part_of(self, all: Counted) -> String {
        if all.kinds().count() > 1 {
            format!("{self} of {all}")
        } else {
            format!("{} of {all}", self.total())
        }
    }

    /// The kinds that there are.
    fn kinds(self) -> impl Iterator<Item = (usize, &'static str)> {
        let all = [(self.triangles, "triangle"), (self.polygons, "polygon"), (self.lines, "line")];
        all.into_iter().filter(|(count, _)| *count > 0)
    }
}

/// `2 triangles and 5 polygons`.
impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let kinds: Vec<String> = self.kinds().map(|(count, kind)| number(count as u64, kind)).collect();
        if kinds.is_empty() { f.write_str("0 triangles") } else { f.write_str(&kinds.join(" and ")) }
    }
}

/// So many of a noun, with an s where they are not one: `1 cycle`, `20 cycles`.
#[must_use]
pub fn number(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_that_there_are_have_words() {
        let of = |triangles, polygons, lines| Counted { triangles, polygons, lines };
        for (counted, words) in [
            (of(0, 0, 0), "0 triangles"),
            (of(1, 0, 0), "1 triangle"),
            (of(6, 5, 0), "6 triangles and 5 polygons"),
            (of(0, 3, 1), "3 polygons and 1 line"),
        ] {
            assert_eq!(counted.to_string(), words);
        }
        assert_eq!(of(0, 1, 0).part_of(of(0, 3, 0)), "1 of 3 polygons");
        assert_eq!(of(0, 0, 0).part_of(of(1, 0, 0)), "0 of 1 triangle");
        assert_eq!(of(1, 0, 0).part_of(of(1, 2, 0)), "1 triangle of 1 triangle and 2 polygons");
    }
}
