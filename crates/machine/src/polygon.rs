//! Polygons and lines: their keys.

use crate::key::Domain::OneOf;
use crate::key::{Domain, Key, number, word};

/// Whether the port takes lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lines {
    /// Triangles only.
    No,
    /// Lines of one pixel too.
    Yes,
}

/// How colours run over a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Values {
    /// A plane of each channel.
    Plane,
    /// Along the edges, and on a line from one edge to the other; all but colours by planes.
    Bilinear,
}

/// What the port takes besides triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Polygon {
    /// N: places of POLY's table of edges; 0: EDGE walks triangles, there is no POLY.
    pub edges: u32,
    /// With POLY: how colours run over a polygon.
    pub values: Values,
    /// Lines.
    pub lines: Lines,
}

impl Polygon {
    /// POLY stands in EDGE's place: the port takes polygons.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.edges > 0
    }

    /// POLY takes colours along the edges.
    #[must_use]
    pub fn is_bilinear(&self) -> bool {
        self.is_there() && self.values == Values::Bilinear
    }

    /// The port takes lines.
    #[must_use]
    pub fn has_lines(&self) -> bool {
        self.lines == Lines::Yes
    }
}

/// Triangles only.
impl Default for Polygon {
    fn default() -> Self {
        Polygon { edges: 0, values: Values::Plane, lines: Lines::No }
    }
}

/// The keys of polygons and lines.
pub const KEYS: &[Key] = &[
    Key {
        absent: Some(0),
        ..number!(
            "polygon.edges",
            OneOf(&[0, 8, 16, 32, 64, 128]),
            "edges that POLY's table holds, so that the port takes polygons; 0: EDGE, triangles only",
            polygon.edges
        )
    },
    Key {
        absent: Some(Values::Plane as u32),
        ..word!(
            "polygon.values",
            Values { "plane" => Plane, "bilinear" => Bilinear },
            "colours of a polygon: a plane, or along its edges and then from edge to edge (bilinear)",
            polygon.values,
            if |m| m.polygon.is_there()
        )
    },
    Key {
        absent: Some(Lines::No as u32),
        ..word!(
            "polygon.lines",
            Lines { "no" => No, "yes" => Yes },
            "the port takes no lines (no), or lines of one pixel too (yes)",
            polygon.lines
        )
    },
];
