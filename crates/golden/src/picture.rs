//! What is on the screen after a frame.

use crate::depth::{compare, passes};
use crate::draw_list::{DrawList, Item};
use crate::fill::Fill;
use crate::fragment::{Fragment, Weight};
use crate::polygon;
use edgewalk_scene::{Frame, MAX_EXTRA, Vertex};
use std::cmp::Ordering;
use std::ops::Range;

/// In [`Picture::id`]: no triangle or polygon wrote here.
pub const NO_TRIANGLE: i32 = -1;

/// What a light does to a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Lit {
    /// No fragment was written.
    Nothing = 0,
    /// The last fragment written is in shadow.
    Shadow = 1,
    /// The last fragment written is lit, or no light casts shadows.
    Lit = 2,
}

/// A drawn frame; every list runs line by line from the top, pixel by pixel from the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Pixels a line.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Fragments over the pixel, whether they pass the depth test or not.
    pub coverage: Vec<u32>,
    /// Fragments that passed the depth test.
    pub writes: Vec<u32>,
    /// Place among the frame's primitives of the last one that passed, or [`NO_TRIANGLE`].
    pub id: Vec<i32>,
    /// Depth, cleared to 1.
    pub z: Vec<f64>,
    /// Red, green, blue.
    pub rgb: Vec<[f64; 3]>,
    /// Values of the user's own, by channel, exact like depth: those of the last fragment that passed, 0 for none.
    pub extra: Vec<Vec<f64>>,
    /// What the light does.
    pub lit: Vec<Lit>,
}

/// Draws the triangles and polygons of `frame` in their order.
pub fn draw(frame: &Frame, fill: Fill) -> Picture {
    Drawing::new(frame, fill).lines(0..frame.height)
}

/// A frame ready to be drawn, also a part at a time: no pixel depends on another.
pub struct Drawing<'a>(DrawList<'a>);

impl<'a> Drawing<'a> {
    /// Of the triangles and polygons of `frame`.
    pub fn new(frame: &'a Frame, fill: Fill) -> Self {
        Self(DrawList::new(frame, fill))
    }

    /// Some lines of the picture, as a picture.
    pub fn lines(&self, lines: Range<u32>) -> Picture {
        let list = &self.0;
        let (frame, width) = (list.frame(), list.frame().width);
        let mut picture = Picture::cleared(frame, lines.len());
        let at = |x: u32, y: u32| (y - lines.start) as usize * width as usize + x as usize;
        for (item, id) in list.items().iter().zip(0..) {
            match item {
                Item::Triangle(triangle) => {
                    let plot = |f: &Fragment| picture.plot(list, id, at(f.x, f.y), f);
                    list.fill().fragments_of_lines(triangle, frame.mode, width, lines.clone(), plot);
                }
                Item::Polygon(table) => polygon::fragments_of_lines(table, width, lines.clone(), |f| {
                    picture.plot(list, id, at(f.x, f.y), f);
                }),
            }
        }
        picture
    }
}

impl Picture {
    /// Nothing drawn yet.
    pub(crate) fn cleared(frame: &Frame, lines: usize) -> Self {
        let size = frame.width as usize * lines;
        Self {
            width: frame.width,
            height: lines as u32,
            coverage: vec![0; size],
            writes: vec![0; size],
            id: vec![NO_TRIANGLE; size],
            z: vec![1.0; size],
            rgb: vec![frame.clear; size],
            extra: vec![vec![0.0; size]; frame.extra],
            lit: vec![Lit::Nothing; size],
        }
    }

    fn plot<const N: usize, W: Weight>(
        &mut self,
        list: &DrawList,
        id: i32,
        at: usize,
        fragment: &Fragment<N, W>,
    ) {
        let frame = list.frame();
        self.coverage[at] += 1;
        let z = fragment.z();
        if let Some(func) = frame.depth {
            let order =
                compare(z, self.z[at], list.fill().doubt()).unwrap_or_else(|| self.order(list, at, fragment));
            if !passes(func, order) {
                return;
            }
        }
        if frame.depth_write {
            self.z[at] = z;
        }
        let mut front = fragment.rgb();
        self.lit[at] = Lit::Lit;
        if let Some(map) = list.shadow()
            && !map.lit(fragment.x, fragment.y, z)
        {
            front = front.map(|channel| channel * map.ambient());
            self.lit[at] = Lit::Shadow;
        }
        self.rgb[at] = if frame.blend { mix(front, fragment.kt(), self.rgb[at]) } else { front };
        for (channel, values) in self.extra.iter_mut().enumerate() {
            values[at] = fragment.extra(channel);
        }
        self.writes[at] += 1;
        self.id[at] = id;
    }

    /// The exact order of a fragment's depth and the stored one.
    fn order<const N: usize, W: Weight>(
        &self,
        list: &DrawList,
        at: usize,
        fragment: &Fragment<N, W>,
    ) -> Ordering {
        // Without depth writes the stored depth is still the cleared one.
        let stored = if list.frame().depth_write { usize::try_from(self.id[at]).ok() } else { None };
        match stored {
            Some(stored) => list.order(fragment, stored),
            None => fragment.compare_exact_z(&CLEARED),
        }
    }
}

/// What the cleared depth is: one vertex at depth 1, whatever the pixel.
const CLEARED: Fragment<1> = Fragment {
    x: 0,
    y: 0,
    vertices: &[Vertex { x: 0.0, y: 0.0, z: 1.0, r: 0.0, g: 0.0, b: 0.0, kt: 0.0, extra: [0.0; MAX_EXTRA] }],
    weights: [1],
    total: 1,
};

/// (1 - k_t) I + k_t I_back (A 7.5).
pub(crate) fn mix(front: [f64; 3], kt: f64, back: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|channel| (1.0 - kt) * front[channel] + kt * back[channel])
}
