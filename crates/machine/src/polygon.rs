//! Polygons and lines: their keys.

use crate::key::{Domain, Key, word};

/// Whether the port takes lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lines {
    /// Triangles only.
    No,
    /// Lines of one pixel too.
    Yes,
}

/// What the port takes besides triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Polygon {
    /// Lines.
    pub lines: Lines,
}

impl Polygon {
    /// The port takes lines.
    #[must_use]
    pub fn has_lines(&self) -> bool {
        self.lines == Lines::Yes
    }
}

/// Triangles only.
impl Default for Polygon {
    fn default() -> Self {
        Polygon { lines: Lines::No }
    }
}

/// The keys of polygons and lines.
pub const KEYS: &[Key] = &[Key {
    absent: Some(Lines::No as u32),
    ..word!(
        "polygon.lines",
        Lines { "no" => No, "yes" => Yes },
        "the port takes triangles only (no), or lines of one pixel too (yes)",
        polygon.lines
    )
}];
