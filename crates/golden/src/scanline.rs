//! Hidden surfaces by scan lines: one active list of the edges of all polygons, no depth buffer and no frame memory.
//!
//! ```text
//!  edges of all ──> those that cross this line, from left to right ──> a flag a polygon: inside or not
//!                                                                        │
//!       ...│  a   │  a b  │  b  │...      between two crossings the same polygons are inside:
//!                                         the nearest is shown, and each pixel is shaded once
//! ```
//! "Steps 4 and 5 fit neatly into the scan-line hidden surface removal algorithm" (the notes). On a line the depth of a polygon runs linearly
//! from its left edge to its right one. So where one polygon is the nearest at both ends of a stretch, it is nearest throughout, and
//! no depth between is asked for; where two change places, as they cut each other, the stretch is halved.
//!
//! The picture is that of a depth buffer, ties too: of equal depths the first in the list stays with `less`, the last with `lequal`.

mod surface;
mod sweep;

use crate::depth::passes;
use crate::picture::{Lit, Picture};
use edgewalk_scene::{Blending, DepthFunc, Frame};
use std::cmp::Ordering;
use surface::{Seen, Surface};
use sweep::Sweep;

/// Why a frame has no order that a line could decide by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotOpaque {
    /// The depth function is another than `less` or `lequal`, or it stores no depths.
    Depth,
    /// The frame blends, or does not store all colours.
    Blend,
    /// The rules change between its triangles.
    Passes,
    /// A light casts shadows, or each pixel is shaded.
    Light,
    /// The frame has lines, which have no edges to be inside of.
    Lines,
}

impl std::fmt::Display for NotOpaque {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(match self {
            Self::Depth => "the depth function is not less or lequal with depths stored",
            Self::Blend => "the frame blends, or leaves colours out",
            Self::Passes => "the rules change between its triangles",
            Self::Lines => "the frame has lines",
            Self::Light => "the frame has a light's map, or is shaded at each pixel",
        })
    }
}

/// What the algorithm did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Pixels that a polygon covers, whose colour was found: each once.
    pub shaded: u64,
    /// Fragments of all polygons, which a depth buffer compares one by one: `shaded` times the depth complexity.
    pub fragments: u64,
    /// Depths that were asked for.
    pub depths: u64,
    /// Stretches of pixels between two crossings, or halves of one.
    pub stretches: u64,
    /// Most edges on a line.
    pub active: usize,
    /// Most polygons over a pixel.
    pub deepest: usize,
}

/// Draws the triangles and polygons of `frame` by exact fill, line by line.
///
/// # Errors
/// What a frame has that a line cannot decide by itself.
pub fn scan_lines(frame: &Frame, subpixel_bits: u32) -> Result<(Picture, Work), NotOpaque> {
    let func = opaque(frame)?;
    let surfaces: Vec<Surface> = frame
        .primitives()
        .into_iter()
        .filter_map(|primitive| Surface::new(primitive, frame.mode, subpixel_bits))
        .collect();
    let mut picture = Picture::cleared(frame, frame.height as usize);
    let mut line = Line { func, width: frame.width, picture: &mut picture, work: Work::default() };
    let mut sweep = Sweep::new(&surfaces);
    for y in 0..frame.height {
        sweep.line(&surfaces, [frame.width, y], |active, crossings| {
            line.work.active = line.work.active.max(active);
            line.draw(y, crossings);
        });
    }
    let work = line.work;
    Ok((picture, work))
}

fn opaque(frame: &Frame) -> Result<DepthFunc, NotOpaque> {
    let passes = frame.passes();
    let [pass] = &passes[..] else { return Err(NotOpaque::Passes) };
    if pass.state.blend != Blending::Off || !pass.state.color_write {
        return Err(NotOpaque::Blend);
    }
    if !frame.shadows.is_empty() || frame.shading.is_some() {
        return Err(NotOpaque::Light);
    }
    if !frame.lines.is_empty() {
        return Err(NotOpaque::Lines);
    }
    match pass.state.depth {
        Some(func @ (DepthFunc::Less | DepthFunc::Lequal)) if pass.state.stores_depth() => Ok(func),
        _ => Err(NotOpaque::Depth),
    }
}

/// Where a span of a polygon begins or ends on a line.
struct Crossing<'a> {
    column: u32,
    /// The span begins here.
    begins: bool,
    seen: Seen<'a>,
}

/// What a line is drawn with.
struct Line<'p> {
    func: DepthFunc,
    width: u32,
    picture: &'p mut Picture,
    work: Work,
}

impl Line<'_> {
    /// Goes over the crossings from left to right, and shows what is nearest between each two.
    fn draw(&mut self, y: u32, crossings: &[Crossing]) {
        let mut inside: Vec<&Seen> = Vec::new();
        for (place, crossing) in crossings.iter().enumerate() {
            if crossing.begins {
                inside.push(&crossing.seen);
            } else {
                inside.retain(|seen| seen.id != crossing.seen.id || seen.start != crossing.seen.start);
            }
            let end = crossings.get(place + 1).map_or(self.width, |next| next.column);
            if end > crossing.column && !inside.is_empty() {
                let covered = u64::from(end - crossing.column);
                self.work.fragments += covered * inside.len() as u64;
                self.work.deepest = self.work.deepest.max(inside.len());
                let pixels = self.at(crossing.column, y)..self.at(end, y);
                self.picture.coverage[pixels].fill(inside.len() as u32);
                let ends = [crossing.column, end - 1];
                let nearest = ends.map(|x| self.nearest(&inside, x, y));
                self.stretch(&inside, ends, nearest, y);
            }
        }
    }

    fn at(&self, x: u32, y: u32) -> usize {
        y as usize * self.width as usize + x as usize
    }

    /// Shows a stretch of pixels, first and last given with what is nearest there.
    fn stretch(&mut self, inside: &[&Seen], [first, last]: [u32; 2], nearest: [Option<usize>; 2], y: u32) {
        self.work.stretches += 1;
        if nearest[0] == nearest[1] {
            if let Some(seen) = nearest[0].map(|place| inside[place]) {
                (first..=last).for_each(|x| self.show(seen, x, y));
            }
            return;
        }
        let middle = first.midpoint(last);
        let halves = [[first, middle], [middle + 1, last]];
        let [before, after] = [middle, middle + 1].map(|x| match x {
            x if x == first => nearest[0],
            x if x == last => nearest[1],
            x => self.nearest(inside, x, y),
        });
        self.stretch(inside, halves[0], [nearest[0], before], y);
        self.stretch(inside, halves[1], [after, nearest[1]], y);
    }

    /// Which of those inside a depth buffer would show at a pixel, if any: nothing that is no nearer than the cleared depth.
    fn nearest(&mut self, inside: &[&Seen], x: u32, y: u32) -> Option<usize> {
        self.work.depths += inside.len() as u64;
        let mut nearest: Option<usize> = None;
        for place in 0..inside.len() {
            let passes = match nearest {
                None => passes(self.func, inside[place].order_of_cleared(x, y)),
                Some(before) => {
                    let order = inside[place].order(inside[before], x, y);
                    // As if they came in the order of the list.
                    let later = inside[place].id > inside[before].id;
                    let ties = (self.func == DepthFunc::Lequal) == later;
                    order == Ordering::Less || (order == Ordering::Equal && ties)
                }
            };
            if passes {
                nearest = Some(place);
            }
        }
        nearest
    }

    /// Shades a pixel.
    fn show(&mut self, seen: &Seen, x: u32, y: u32) {
        let at = self.at(x, y);
        let picture = &mut *self.picture;
        (picture.z[at], picture.rgb[at]) = seen.values(x, y);
        for (channel, values) in picture.extra.iter_mut().enumerate() {
            values[at] = seen.extra(x, y, channel);
        }
        (picture.writes[at], picture.id[at], picture.lit[at]) = (1, seen.id as i32, Lit::Lit);
        self.work.shaded += 1;
    }
}
