//! Which pixels a triangle or polygon has: one of two rules.

use crate::cover::fragments_of_lines;
use crate::fragment::Fragment;
use crate::polygon::Grid;
use crate::textbook::half_triangles_of_lines;
use edgewalk_scene::{MAX_COORDINATE, ShadeMode, Triangle};
use std::ops::Range;

/// Which pixels a triangle or polygon has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// Half-open in both axes, exact.
    Exact {
        /// Vertices are snapped to this many sub-pixel bits, 0..=8.
        subpixel_bits: u32,
    },
    /// The books': integer vertices, pixels at integer coordinates. Triangles by the listing of ch. 7.5: both ends of a span
    /// inclusive, the knee line drawn twice; polygons by the rule of the slides: the start rounded up, the end down.
    Textbook,
}

impl Fill {
    /// Calls `draw` for every fragment of `triangle` on a screen of width by height pixels. A pixel of the textbook's knee
    /// line comes twice.
    pub fn fragments(
        self,
        triangle: &Triangle,
        mode: ShadeMode,
        (width, height): (u32, u32),
        draw: impl FnMut(&Fragment),
    ) {
        self.fragments_of_lines(triangle, mode, width, 0..height, draw);
    }

    /// Like `fragments`, for some lines of the screen.
    pub(crate) fn fragments_of_lines(
        self,
        triangle: &Triangle,
        mode: ShadeMode,
        width: u32,
        lines: Range<u32>,
        mut draw: impl FnMut(&Fragment),
    ) {
        match self {
            Self::Exact { subpixel_bits } => {
                fragments_of_lines(triangle, mode, subpixel_bits, width, lines, draw);
            }
            Self::Textbook => {
                half_triangles_of_lines(triangle, mode, width, lines, |_, fragment| draw(fragment));
            }
        }
    }

    /// Fraction bits of a vertex.
    pub(crate) fn subpixel_bits(self) -> u32 {
        match self {
            Self::Exact { subpixel_bits } => subpixel_bits,
            Self::Textbook => 0,
        }
    }

    /// Where a polygon's vertices and pixels lie.
    #[must_use]
    pub fn grid(self) -> Grid {
        match self {
            Self::Exact { subpixel_bits } => Grid::subpixels(subpixel_bits),
            Self::Textbook => Grid::whole(),
        }
    }

    /// The errors of two depths together.
    pub(crate) fn doubt(self) -> f64 {
        match self {
            Self::Exact { .. } => 2.0 * Fragment::UNCERTAINTY,
            // Up to a pixel beyond the right edge weights are negative, and terms cancel that are larger than the sum: for
            // each vertex by as much as the height of an edge over twice the area, at most 2 * 10^6 over 1.
            Self::Textbook => 2.0 * Fragment::UNCERTAINTY * (1.0 + 4.0 * MAX_COORDINATE),
        }
    }
}
