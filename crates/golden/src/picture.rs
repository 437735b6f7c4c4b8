//! What is on the screen after a frame.

use crate::cover::Cover;
use crate::depth::{compare, passes};
use crate::fill::Fill;
use crate::fragment::Fragment;
use crate::shadow::ShadowMap;
use crate::textbook::Walk;
use edgewalk_scene::{Frame, Vertex};
use std::cmp::Ordering;

/// In [`Picture::id`]: no triangle wrote here.
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
    /// Place in the frame's list of the last triangle that passed, or [`NO_TRIANGLE`].
    pub id: Vec<i32>,
    /// Depth, cleared to 1.
    pub z: Vec<f64>,
    /// Red, green, blue.
    pub rgb: Vec<[f64; 3]>,
    /// What the light does.
    pub lit: Vec<Lit>,
}

/// Draws the triangles of `frame` in their order.
pub fn draw(frame: &Frame, fill: Fill) -> Picture {
    let size = frame.width as usize * frame.height as usize;
    let mut picture = Picture {
        width: frame.width,
        height: frame.height,
        coverage: vec![0; size],
        writes: vec![0; size],
        id: vec![NO_TRIANGLE; size],
        z: vec![1.0; size],
        rgb: vec![frame.clear; size],
        lit: vec![Lit::Nothing; size],
    };
    let shadow = frame.shadow.as_ref().map(|shadow| ShadowMap::draw(shadow, fill));
    let screen = (frame.width, frame.height);
    for (triangle, id) in frame.triangles.iter().zip(0..) {
        fill.fragments(triangle, frame.mode, screen, |f| picture.plot(frame, fill, shadow.as_ref(), id, f));
    }
    picture
}

impl Picture {
    fn plot(&mut self, frame: &Frame, fill: Fill, shadow: Option<&ShadowMap>, id: i32, fragment: &Fragment) {
        let at = fragment.y as usize * self.width as usize + fragment.x as usize;
        self.coverage[at] += 1;
        let z = fragment.z();
        if let Some(func) = frame.depth {
            let order =
                compare(z, self.z[at], fill.doubt()).unwrap_or_else(|| self.order(frame, fill, at, fragment));
            if !passes(func, order) {
                return;
            }
        }
        if frame.depth_write {
            self.z[at] = z;
        }
        let mut front = fragment.rgb();
        self.lit[at] = Lit::Lit;
        if let Some(map) = shadow
            && !map.lit(fragment.x, fragment.y, z)
        {
            front = front.map(|channel| channel * map.ambient());
            self.lit[at] = Lit::Shadow;
        }
        self.rgb[at] = if frame.blend { mix(front, fragment.kt(), self.rgb[at]) } else { front };
        self.writes[at] += 1;
        self.id[at] = id;
    }

    /// The exact order of a fragment's depth and the stored one.
    fn order(&self, frame: &Frame, fill: Fill, at: usize, fragment: &Fragment) -> Ordering {
        // Without depth writes the stored depth is still the cleared one.
        let stored = if frame.depth_write { usize::try_from(self.id[at]).ok() } else { None };
        let Some(triangle) = stored.map(|id| &frame.triangles[id]) else {
            return fragment.compare_exact_z(&Fragment { vertices: &FARTHEST, ..fragment.clone() });
        };
        let (x, y) = (fragment.x, fragment.y);
        let order = match fill {
            Fill::Exact { subpixel_bits } => Cover::new(triangle, frame.mode, subpixel_bits)
                .map(|cover| fragment.compare_exact_z(&cover.fragment(x, y))),
            Fill::Textbook => {
                let walk = Walk::new(triangle, frame.mode);
                walk.and_then(|walk| walk.fragment(x, y).map(|stored| fragment.compare_exact_z(&stored)))
            }
        };
        // A triangle without area stores nothing.
        order.unwrap_or(Ordering::Equal)
    }
}

/// What the cleared depth is: a triangle at depth 1.
const FARTHEST: [Vertex; 3] = [Vertex { x: 0.0, y: 0.0, z: 1.0, r: 0.0, g: 0.0, b: 0.0, kt: 0.0 }; 3];

/// (1 - k_t) I + k_t I_back (A 7.5).
fn mix(front: [f64; 3], kt: f64, back: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|channel| (1.0 - kt) * front[channel] + kt * back[channel])
}
