//! What is drawn, how, and in which order: triangles, the edge tables of polygons, lines, the light's map.

use crate::cover::Cover;
use crate::fill::Fill;
use crate::fragment::{Fragment, Weight};
use crate::line::Line;
use crate::polygon::{EdgeTable, Span};
use crate::shadow::ShadowMap;
use crate::textbook::Walk;
use edgewalk_scene::{Frame, Primitive, Triangle};
use std::cmp::Ordering;

/// A frame ready to be drawn.
pub(crate) struct DrawList<'a> {
    frame: &'a Frame,
    fill: Fill,
    items: Vec<Item<'a>>,
    /// By the lights' numbers, from 1.
    maps: Vec<ShadowMap<'a>>,
}

/// A primitive ready to be drawn.
pub(crate) enum Item<'a> {
    Triangle(&'a Triangle),
    Polygon(EdgeTable),
    Line(Line),
}

impl<'a> DrawList<'a> {
    pub(crate) fn new(frame: &'a Frame, fill: Fill) -> Self {
        let item = |primitive| match primitive {
            Primitive::Triangle(triangle) => Item::Triangle(triangle),
            Primitive::Polygon(polygon) => Item::Polygon(EdgeTable::new(polygon, frame.mode, fill.grid())),
            Primitive::Line(line) => Item::Line(Line::new(&line.ends, frame.mode, fill.grid())),
        };
        let items = frame.primitives().into_iter().map(item).collect();
        let maps = frame.shadows.iter().map(|shadow| ShadowMap::draw(shadow, fill)).collect();
        Self { frame, fill, items, maps }
    }

    pub(crate) fn frame(&self) -> &'a Frame {
        self.frame
    }

    pub(crate) fn fill(&self) -> Fill {
        self.fill
    }

    /// By id.
    pub(crate) fn items(&self) -> &[Item<'a>] {
        &self.items
    }

    /// The map of the light with this number.
    pub(crate) fn map(&self, light: usize) -> Option<&ShadowMap<'a>> {
        self.maps.get(light.checked_sub(1)?)
    }

    /// The exact order of a fragment's depth and that of the primitive with this id at the same pixel.
    pub(crate) fn order<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>, id: usize) -> Ordering {
        let (x, y) = (fragment.x, fragment.y);
        let order = match &self.items[id] {
            Item::Triangle(triangle) => match self.fill {
                Fill::Exact { subpixel_bits } => Cover::new(triangle, self.frame.mode, subpixel_bits)
                    .map(|cover| fragment.compare_exact_z(&cover.fragment(x, y))),
                Fill::Textbook => {
                    let walk = Walk::new(triangle, self.frame.mode);
                    walk.and_then(|walk| walk.fragment(x, y).map(|stored| fragment.compare_exact_z(&stored)))
                }
            },
            Item::Line(line) => line.fragment(x, y).map(|stored| fragment.compare_exact_z(&stored)),
            Item::Polygon(table) => {
                Span::over(table, x, y).map(|span| fragment.compare_exact_z(&span.fragment(x)))
            }
        };
        // What does not cover the pixel stores nothing there.
        order.unwrap_or(Ordering::Equal)
    }
}
