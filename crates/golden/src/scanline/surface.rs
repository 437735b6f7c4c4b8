//! A triangle or polygon on a line: its edges, and depth and colour at a pixel.

use crate::cover::Cover;
use crate::depth::compare;
use crate::drawing::CLEARED;
use crate::fill::Fill;
use crate::fragment::{Fragment, Weight};
use crate::polygon::{EdgeTable, Grid, Span};
use edgewalk_scene::{Polygon, Primitive, ShadeMode};
use std::cmp::Ordering;

/// A triangle or polygon with its edges.
pub(super) struct Surface {
    pub table: EdgeTable,
    /// Of a triangle, which has one plane.
    plane: Option<Cover>,
    doubt: f64,
}

impl Surface {
    /// A primitive with its edges snapped to so many bits; none for a line, which has no area.
    pub fn new(primitive: Primitive, mode: ShadeMode, subpixel_bits: u32) -> Option<Self> {
        let table = |polygon: &Polygon| EdgeTable::new(polygon, mode, Grid::subpixels(subpixel_bits));
        let doubt = Fill::Exact { subpixel_bits }.doubt();
        Some(match primitive {
            Primitive::Triangle(triangle) => Self {
                table: table(&Polygon { contours: vec![triangle.0.to_vec()], after: 0 }),
                plane: Cover::new(triangle, mode, subpixel_bits),
                doubt,
            },
            Primitive::Polygon(polygon) => Self { table: table(polygon), plane: None, doubt },
            Primitive::Line(_) => return None,
        })
    }
}

/// A span of a surface on a line.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a> {
    /// Place in the list.
    pub id: usize,
    /// First pixel of the span on the screen.
    pub start: u32,
    pub span: Span<'a>,
    pub surface: &'a Surface,
}

/// Runs the body with the fragment of a span at a pixel, of a triangle or of a polygon.
macro_rules! with_fragment {
    ($seen:expr, $x:expr, $y:expr, $fragment:ident => $body:expr) => {
        match &$seen.surface.plane {
            Some(plane) => {
                let $fragment = plane.fragment($x, $y);
                $body
            }
            None => {
                let $fragment = $seen.span.fragment($x);
                $body
            }
        }
    };
}

impl Seen<'_> {
    /// Depth and colour.
    pub fn values(&self, x: u32, y: u32) -> (f64, [f64; 3]) {
        with_fragment!(self, x, y, fragment => (fragment.z(), fragment.rgb()))
    }

    /// A value of the user's own.
    pub fn extra(&self, x: u32, y: u32, channel: usize) -> f64 {
        with_fragment!(self, x, y, fragment => fragment.extra(channel))
    }

    /// The order of its depth and another's, exact.
    pub fn order(&self, other: &Seen, x: u32, y: u32) -> Ordering {
        with_fragment!(self, x, y, own => with_fragment!(other, x, y, other => order(&own, &other, self.surface.doubt)))
    }

    /// The order of its depth and the cleared one.
    pub fn order_of_cleared(&self, x: u32, y: u32) -> Ordering {
        with_fragment!(self, x, y, fragment => order(&fragment, &CLEARED, self.surface.doubt))
    }
}

fn order<const N: usize, const M: usize, V: Weight, W: Weight>(
    a: &Fragment<N, V>,
    b: &Fragment<M, W>,
    doubt: f64,
) -> Ordering {
    compare(a.z(), b.z(), doubt).unwrap_or_else(|| a.compare_exact_z(b))
}
