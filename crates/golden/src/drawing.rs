//! A frame drawn: every fragment of every primitive, in order, tested, coloured and stored.

use crate::depth::{compare, passes};
use crate::dither::left_out;
use crate::draw_list::{DrawList, Item};
use crate::fill::Fill;
use crate::fragment::{Fragment, Weight};
use crate::picture::{Lit, NO_TRIANGLE, Picture};
use crate::pixel_shading::PixelBrush;
use crate::polygon;
use edgewalk_scene::{Blending, Frame, MAX_EXTRA, Pass, State, Vertex};
use std::cmp::Ordering;
use std::ops::Range;

/// Draws the triangles, polygons and lines of `frame` in their order.
pub fn draw(frame: &Frame, fill: Fill) -> Picture {
    Drawing::new(frame, fill).lines(0..frame.height)
}

/// A frame ready to be drawn, also a part at a time: no pixel depends on another.
pub struct Drawing<'a> {
    list: DrawList<'a>,
    /// What is blended is left out by a pattern instead; bits of k_t below 1.
    screen_door: Option<u32>,
}

impl<'a> Drawing<'a> {
    /// Of the triangles, polygons and lines of `frame`.
    pub fn new(frame: &'a Frame, fill: Fill) -> Self {
        Self { list: DrawList::new(frame, fill), screen_door: None }
    }

    /// Like `new`, with a screen door: a triangle that is mixed by its k_t, rounded to so many bits, is drawn opaque, and left out where the
    /// [pattern](crate::dither::left_out) says so.
    #[must_use]
    pub fn with_screen_door(self, kt_bits: u32) -> Self {
        Self { screen_door: Some(kt_bits), ..self }
    }

    /// Some lines of the picture, as a picture.
    pub fn lines(&self, lines: Range<u32>) -> Picture {
        self.watched(lines, |_| {})
    }

    /// Like `lines`; `watch` sees every depth test and every colour stored, in order.
    pub fn watched(&self, lines: Range<u32>, mut watch: impl FnMut(Step)) -> Picture {
        let list = &self.list;
        let (frame, width) = (list.frame(), list.frame().width);
        let mut picture = Picture::cleared(frame, lines.len());
        let mut nearest = vec![NO_TRIANGLE; picture.z.len()];
        let at = |x: u32, y: u32| (y - lines.start) as usize * width as usize + x as usize;
        for Pass { primitives, state, clear_depth } in frame.passes() {
            if clear_depth {
                picture.z.fill(1.0);
                nearest.fill(NO_TRIANGLE);
            }
            for (item, id) in list.items()[primitives.clone()].iter().zip(primitives.start as i32..) {
                let (picture, nearest, watch) = (&mut picture, &mut nearest[..], &mut watch);
                let shading = frame.shading.as_ref();
                let brush = shading.and_then(|shading| PixelBrush::new(shading, id as usize));
                let screen_door = self.screen_door.filter(|_| state.blend == Blending::Mix);
                let state =
                    if screen_door.is_some() { State { blend: Blending::Off, ..state } } else { state };
                let mut pen = Pen { list, state, screen_door, id, brush, picture, nearest, watch };
                match item {
                    Item::Triangle(triangle) => {
                        let plot = |f: &Fragment| pen.plot(at(f.x, f.y), f);
                        list.fill().fragments_of_lines(triangle, frame.mode, width, lines.clone(), plot);
                    }
                    Item::Line(line) => {
                        line.fragments_of_lines(width, lines.clone(), |f| pen.plot(at(f.x, f.y), f));
                    }
                    Item::Polygon(table) => polygon::fragments_of_lines(table, width, lines.clone(), |f| {
                        pen.plot(at(f.x, f.y), f);
                    }),
                }
            }
        }
        picture
    }
}

/// What happens at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// A fragment's depth is compared with the stored one.
    Tested {
        /// Place of the pixel, from the first of the lines.
        at: usize,
        /// Place of the primitive in the list.
        id: i32,
        /// The triangle whose depth is stored, or [`NO_TRIANGLE`]: the cleared one.
        stored: i32,
        /// How far they are apart.
        gap: f64,
    },
    /// A colour is stored: `own` times `share`, put together with what the pixel had.
    Stored {
        /// Place of the pixel, from the first of the lines.
        at: usize,
        /// Place of the primitive in the list.
        id: i32,
        /// The fragment's depth.
        z: f64,
        /// Colour of the fragment, before a light's map.
        own: [f64; 3],
        /// What the map does.
        lit: Lit,
        /// The share of the colour that it leaves.
        share: f64,
        /// The number of the light, as the rules have it.
        light: usize,
        /// k_t of the fragment.
        kt: f64,
        /// What the pixel had.
        back: [f64; 3],
        /// How they are put together.
        blend: Blending,
    },
}

/// A primitive while it is drawn.
struct Pen<'a, F> {
    list: &'a DrawList<'a>,
    state: State,
    screen_door: Option<u32>,
    id: i32,
    /// Where the equation holds at each pixel.
    brush: Option<PixelBrush<'a>>,
    picture: &'a mut Picture,
    /// The primitive whose depth is stored at each pixel, or [`NO_TRIANGLE`]: the cleared one.
    nearest: &'a mut [i32],
    watch: &'a mut F,
}

impl<F: FnMut(Step)> Pen<'_, F> {
    fn plot<const N: usize, W: Weight>(&mut self, at: usize, fragment: &Fragment<N, W>) {
        let (list, state) = (self.list, self.state);
        if let Some(bits) = self.screen_door {
            let one = f64::from(1u32 << bits);
            // A triangle has one, that of its first vertex.
            let kt = (fragment.vertices[0].kt * one).round_ties_even() / one;
            if left_out(kt, fragment.x, fragment.y) {
                return;
            }
        }
        self.picture.coverage[at] += 1;
        let z = fragment.z();
        if let Some(func) = state.depth {
            let gap = (z - self.picture.z[at]).abs();
            (self.watch)(Step::Tested { at, id: self.id, stored: self.nearest[at], gap });
            let order = compare(z, self.picture.z[at], list.fill().doubt());
            if !passes(func, order.unwrap_or_else(|| self.order(at, fragment))) {
                return;
            }
        }
        let picture = &mut *self.picture;
        if state.stores_depth() {
            picture.z[at] = z;
            self.nearest[at] = self.id;
        }
        if !state.color_write {
            return;
        }
        let own = self.brush.as_ref().map_or_else(|| fragment.rgb(), |brush| brush.color(fragment));
        let map = list.map(state.light);
        let (lit, share) =
            map.map_or((Lit::Lit, 1.0), |map| map.share(fragment.x, fragment.y, z, self.id as usize));
        picture.lit[at] = lit;
        let front = own.map(|channel| channel * share);
        let (back, kt, blend, light) = (picture.rgb[at], fragment.kt(), state.blend, state.light);
        (self.watch)(Step::Stored { at, id: self.id, z, own, light, lit, share, kt, back, blend });
        picture.rgb[at] = match state.blend {
            Blending::Off => front,
            Blending::Mix => mix(front, fragment.kt(), back),
            Blending::Add => std::array::from_fn(|channel| (front[channel] + back[channel]).min(1.0)),
        };
        for (channel, values) in picture.extra.iter_mut().enumerate() {
            values[at] = fragment.extra(channel);
        }
        picture.writes[at] += 1;
        picture.id[at] = self.id;
    }

    /// The exact order of a fragment's depth and the stored one.
    fn order<const N: usize, W: Weight>(&self, at: usize, fragment: &Fragment<N, W>) -> Ordering {
        match usize::try_from(self.nearest[at]) {
            Ok(stored) => self.list.order(fragment, stored),
            Err(_) => fragment.compare_exact_z(&CLEARED),
        }
    }
}

/// What the cleared depth is: one vertex at depth 1, whatever the pixel.
pub(crate) const CLEARED: Fragment<1> = Fragment {
    x: 0,
    y: 0,
    vertices: &[Vertex { x: 0.0, y: 0.0, z: 1.0, r: 0.0, g: 0.0, b: 0.0, kt: 0.0, extra: [0.0; MAX_EXTRA] }],
    weights: [1],
    total: 1,
};

/// (1 - k_t) I + k_t I_back (ch. 7.5).
pub(crate) fn mix(front: [f64; 3], kt: f64, back: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|channel| (1.0 - kt) * front[channel] + kt * back[channel])
}
