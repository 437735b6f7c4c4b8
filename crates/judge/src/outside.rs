//! The picture of another rasterizer beside golden's, by frame: the final depth and colour of each pixel, whatever the
//! architecture and the order of its writes.
//!
//! ```text
//!  golden's picture ─┐              within the tolerance ──────────────────────────────> agrees
//!                    ├─> pixel ─> ? the background where golden draws, or the reverse ─> missing, extra: the deciding half-plane
//!  outside's arrays ─┘              another triangle over the pixel ──────────────────> tie of depth, or wrong winner
//!                                   none ─────────────────────────────────────────────> depth or colour beyond, by how much
//! ```
//! Of a frame of several layers the triangles over a pixel do not tell what shows. There a pixel whose coverage is right may differ
//! where a depth test is open.

pub mod picture;
mod tolerance;
mod rule;
mod edge;
mod finding;
#[cfg(test)]
mod tests;

pub use edge::Edge;
pub use finding::{Cause, Finding, Judgement};
pub use picture::Picture;
pub use rule::Rule;
pub use tolerance::{Asked, Tolerance};

use crate::compare::{Layers, Over, all_over};
use crate::verdict::within;
use anyhow::{Result, bail, ensure};
use edgewalk_golden::{Drawing, Fill, Step};
use edgewalk_host::input::cut_at_band;
use edgewalk_host::raster::{Raster, from_golden, golden_drawing_by, golden_fill};
use edgewalk_machine::Plan;
use edgewalk_scene::{Blending, Frame, Primitive};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Judges `outside` beside golden's picture of `frame`, the input's with its polygons whole, by this rule of coverage.
///
/// # Errors
/// The pictures have different sizes, no array is in both, or golden cannot draw the frame by the rule.
pub fn beside_golden(
    machine: &Plan,
    frame: &Frame,
    outside: &Picture,
    tolerance: &Tolerance,
    rule: Rule,
) -> Result<Judgement> {
    let fill = match rule {
        Rule::Textbook => Fill::Textbook,
        _ => Fill::Exact { subpixel_bits: machine.subpixel_bits },
    };
    let golden =
        |frame: &Frame| from_golden(golden_drawing_by(frame, machine, fill).lines(0..frame.height), machine);
    // The machine rounds the corners of a cut anew, which moves the plane. Both pictures are right.
    let cut = cut_at_band(frame, machine)?;
    let pieces = |turned: &dyn Fn(&Frame) -> Raster| {
        cut.as_ref().map(|(frame, places)| {
            let mut picture = turned(frame);
            // Where nothing is drawn the id is negative.
            for id in picture.id.iter_mut().filter(|id| **id >= 0) {
                *id = places[*id as usize];
            }
            picture
        })
    };
    let tolerance = &match tolerance.is_asked_for {
        true => *tolerance,
        false => tolerance.of_file(outside.color_step),
    };
    if rule.is_plain() {
        let reference = Reference { picture: &golden(frame), pieces: pieces(&golden), may_tie: true };
        return judge(machine, frame, reference, outside, tolerance, fill);
    }
    let mixes = frame.passes().iter().any(|pass| pass.state.blend == Blending::Mix);
    let is_door = mixes && machine.dither.drops();
    let refused = [
        ("shadows", !frame.shadows.is_empty()),
        ("normals", frame.shading.is_some()),
        ("lines", !frame.lines.is_empty()),
        ("glass of a screen door, whose pattern is that of the screen", is_door),
    ];
    if let Some((found, _)) = refused.into_iter().find(|(_, there)| *there) {
        bail!(
            "rule {rule}: the frame has {found}; permitted with this rule: triangles and polygons without shadows, normals and \
             screen door; judge it by top-left or textbook"
        );
    }
    let pieces = pieces(&|frame| golden(&rule.mirrored(frame, machine.subpixel_bits)));
    let frame = rule.mirrored(frame, machine.subpixel_bits);
    let reference = Reference { picture: &golden(&frame), pieces, may_tie: true };
    let judgement = judge(machine, &frame, reference, &rule.turned(outside.clone()), tolerance, fill)?;
    Ok(judgement.turned(rule))
}

/// Judges `outside` beside the picture `drawn` that the machine makes of `frame`, the input's with its polygons whole: every value must
/// be equal.
///
/// # Errors
/// The pictures have different sizes, or no array is in both.
pub fn beside_machine(
    machine: &Plan,
    frame: &Frame,
    drawn: &Raster,
    outside: &Picture,
    tolerance: &Tolerance,
) -> Result<Judgement> {
    let reference = Reference { picture: drawn, pieces: None, may_tie: false };
    let tolerance = tolerance.exact().of_file(outside.color_step);
    judge(machine, frame, reference, outside, &tolerance, golden_fill(machine))
}

/// What a picture is judged by.
struct Reference<'a> {
    /// The picture that is right.
    picture: &'a Raster,
    /// Of a frame with triangles beyond the guard band: the other right picture.
    pieces: Option<Raster>,
    /// Depths that are near to one another may come out in any order.
    may_tie: bool,
}

fn judge(
    machine: &Plan,
    frame: &Frame,
    Reference { picture: reference, pieces, may_tie }: Reference,
    outside: &Picture,
    tolerance: &Tolerance,
    fill: Fill,
) -> Result<Judgement> {
    let (found, permitted) = ((outside.width, outside.height), (reference.width, reference.height));
    ensure!(
        found == permitted,
        "the picture has {}x{} pixels; permitted: {}x{}, the screen of the input; draw it in that size, or set screen.width and \
         screen.height where the input is a scene",
        found.0,
        found.1,
        permitted.0,
        permitted.1
    );
    let drawing = golden_drawing_by(frame, machine, fill);
    let layers = Layers::of(machine, frame, &drawing, None, None, None).filter(|_| !tolerance.is_asked_for);
    let largest = layers.as_ref().map(|of| of.bound.iter().copied().fold(0.0, f64::max) + tolerance.step);
    let color_no_bound = layers.as_ref().and_then(|of| of.no_bound).or(tolerance.color_no_bound);
    let shown = Tolerance { layers: largest, color_no_bound, ..*tolerance };
    let mut judgement = Judgement::new(reference, outside, shown);
    ensure!(
        !judgement.compared.is_empty(),
        "no array can be compared: {}; permitted: one or more of coverage, id, z and rgb{}; add one of these to the picture",
        if outside.lit.is_some() {
            "lit is the only one, and the picture of a machine without SHADOW has none"
        } else {
            "the picture has none"
        },
        if reference.lit.is_some() { ", or lit" } else { "" }
    );
    let stores_color = frame.passes().iter().any(|pass| pass.state.color_write);
    let primitives = frame.primitives();
    let judge = Judge { frame, primitives, stores_color, reference, outside, tolerance, layers };
    let pixels = reference.coverage.len();
    let differ: Vec<usize> = (0..pixels).filter(|pixel| !judge.agrees(*pixel)).collect();
    let has_open = may_tie && !differ.is_empty() && !judge.is_plain();
    let open = if has_open { judge.open(&drawing) } else { Vec::new() };
    let over = match fill {
        Fill::Exact { subpixel_bits } if judge.is_plain() => all_over(machine, frame, subpixel_bits, &differ),
        _ => BTreeMap::new(),
    };
    let mut left = differ.iter().peekable();
    for pixel in 0..pixels {
        if left.next_if_eq(&&pixel).is_some() {
            let mut found = judge.why(pixel, over.get(&pixel).map_or(&[], Vec::as_slice));
            if pieces.as_ref().is_some_and(|pieces| judge.agrees_with(pieces, pixel)) {
                found.cause = Cause::Piece;
            }
            if open.get(pixel) == Some(&true) && judge.covers(pixel) {
                (found.cause, found.shown) = (Cause::Open, None);
            }
            judgement.differs(pixel, found, |found| judge.edge(fill, found));
        } else {
            judgement.agrees(judge.errors(pixel));
        }
    }
    Ok(judgement)
}

/// Two pictures of a frame.
struct Judge<'a> {
    frame: &'a Frame,
    /// By their places in the input.
    primitives: Vec<Primitive<'a>>,
    /// Whether any colour is stored, and the triangle with it.
    stores_color: bool,
    reference: &'a Raster,
    outside: &'a Picture,
    tolerance: &'a Tolerance,
    /// Of a frame that is blended, whose colours have a bound of their own at each pixel, unless the user gave a tolerance.
    layers: Option<Layers>,
}

impl Judge<'_> {
    /// Whether one fragment alone decides what a pixel shows, by its depth.
    fn is_plain(&self) -> bool {
        let passes = self.frame.passes();
        let [pass] = &passes[..] else { return false };
        pass.state.blend == Blending::Off && pass.state.stores_depth() && self.frame.shading.is_none()
    }

    /// The pixels with a depth test that may come out in any way, as far as the tolerance goes.
    fn open(&self, drawing: &Drawing) -> Vec<bool> {
        let (frame, apart) = (self.frame, self.tolerance.apart());
        let mut open = vec![false; self.reference.coverage.len()];
        drawing.watched(0..frame.height, |step| {
            if let Step::Tested { at, id, stored, gap } = step {
                open[at] |= apart.leaves_open(frame, id, stored, gap);
            }
        });
        open
    }

    /// Whether a covered pixel is covered as often as in the reference, as far as the picture says.
    fn covers(&self, pixel: usize) -> bool {
        let covered = self.reference.coverage[pixel];
        covered > 0 && self.outside.coverage.as_ref().is_none_or(|own| own[pixel] == covered)
    }

    /// Whether the picture says that nothing covers a pixel.
    fn is_uncovered(&self, pixel: usize) -> bool {
        let Picture { id, coverage, .. } = self.outside;
        let by_count = || coverage.as_ref().is_some_and(|own| own[pixel] == 0);
        id.as_ref().map_or_else(by_count, |own| own[pixel] == -1)
    }

    /// Errors of depth and colour at a pixel, LSB; 0 of what the outside picture does not have.
    fn errors(&self, pixel: usize) -> [f64; 2] {
        self.beside(pixel, self.reference.z[pixel], self.reference.rgb[pixel])
    }

    fn beside(&self, pixel: usize, z: f64, rgb: [f64; 3]) -> [f64; 2] {
        let Tolerance { z_lsb, color_lsb, .. } = self.tolerance;
        let depth = self.outside.z.as_ref().map_or(0.0, |own| (own[pixel] - z).abs() / z_lsb);
        let channels = |own: &Vec<[f64; 3]>| {
            own[pixel].into_iter().zip(rgb).map(|(own, exact)| (own - exact).abs()).fold(0.0, worse)
        };
        [depth, self.outside.rgb.as_ref().map_or(0.0, channels) / color_lsb]
    }

    /// Largest permitted errors of depth and colour at a pixel, LSB.
    fn permitted(&self, pixel: usize) -> [f64; 2] {
        let Tolerance { z, color, step, .. } = *self.tolerance;
        [z, self.layers.as_ref().map_or(color, |layers| layers.bound[pixel] + step)]
    }

    fn within(&self, pixel: usize, errors: [f64; 2]) -> bool {
        errors.into_iter().zip(self.permitted(pixel)).all(|(error, permitted)| within(error, permitted))
    }

    /// Whether a pixel shows what the reference shows, in all the arrays that there are.
    fn agrees(&self, pixel: usize) -> bool {
        self.agrees_with(self.reference, pixel)
    }

    /// Likewise, of another reference.
    fn agrees_with(&self, reference: &Raster, pixel: usize) -> bool {
        let Picture { coverage, id, lit, .. } = self.outside;
        let same = |own: Option<i64>, reference: i64| own.is_none_or(|own| own == reference);
        self.within(pixel, self.beside(pixel, reference.z[pixel], reference.rgb[pixel]))
            && same(coverage.as_ref().map(|own| i64::from(own[pixel])), i64::from(reference.coverage[pixel]))
            && same(id.as_ref().map(|own| i64::from(own[pixel])), i64::from(reference.id[pixel]))
            && reference.lit.as_ref().is_none_or(|lits| {
                same(lit.as_ref().map(|own| i64::from(own[pixel])), i64::from(lits[pixel]))
            })
    }

    /// Why a pixel differs; `over`: the triangles over it, where one of them decides alone.
    fn why(&self, pixel: usize, over: &[Over]) -> Finding {
        let reference = self.reference;
        let own = self.outside.id.as_ref().map(|ids| ids[pixel]);
        let shows = |id: i32, z: f64, rgb: [f64; 3]| {
            own.is_none_or(|own| own == id) && self.within(pixel, self.beside(pixel, z, rgb))
        };
        let winner = shows(reference.id[pixel], reference.z[pixel], reference.rgb[pixel]);
        let background = shows(-1, 1.0, self.frame.clear);
        let covered = reference.coverage[pixel] > 0;
        let errors = self.errors(pixel);
        let [z, _] = errors;
        let triangle = self.stored(pixel, over);
        // Where no colour is stored, depths alone tell triangles apart.
        let is_shown = |over: &Over| match self.stores_color {
            true => shows(over.id, over.z, over.rgb),
            false => shows(-1, over.z, reference.rgb[pixel]),
        };
        let other = || over.iter().find(|over| over.id != triangle && is_shown(over));
        // Another number of triangles over the pixel explains a wrong value before anything else does.
        let more = self.outside.coverage.as_ref().map(|own| own[pixel].cmp(&reference.coverage[pixel]));
        let cause = match (covered, winner) {
            (_, true) => self.counts(pixel),
            (true, false) if background || more == Some(Ordering::Less) => Cause::Missing,
            (false, false) if !self.is_uncovered(pixel) => Cause::Extra,
            (false, false) if within(z, self.permitted(pixel)[0]) => Cause::Color,
            (false, false) => Cause::Depth,
            (true, false) if more == Some(Ordering::Greater) => Cause::Extra,
            (true, false) => match other() {
                Some(other) if triangle >= 0 && self.ties(pixel, other) => Cause::Tie,
                Some(_) => Cause::WrongWinner,
                None if own.is_some_and(|own| own != reference.id[pixel]) => Cause::WrongWinner,
                None if !within(z, self.permitted(pixel)[0]) => Cause::Depth,
                None => Cause::Color,
            },
        };
        let shown = match cause {
            Cause::Tie | Cause::WrongWinner => {
                own.filter(|_| self.stores_color).or_else(|| other().map(|other| other.id))
            }
            Cause::Extra => own.filter(|id| *id >= 0),
            _ => None,
        };
        Finding {
            x: pixel as u32 % reference.width,
            y: pixel as u32 / reference.width,
            cause,
            triangle,
            shown,
            kinds: [triangle, shown.unwrap_or(-1)].map(|id| self.kind(id)),
            z: self.outside.z.as_ref().map(|own| [reference.z[pixel], own[pixel]]),
            rgb: self.outside.rgb.as_ref().map(|own| [reference.rgb[pixel], own[pixel]]),
            coverage: self.outside.coverage.as_ref().map(|own| [reference.coverage[pixel], own[pixel]]),
            error_lsb: errors,
            edge: None,
        }
    }

    /// The triangle that the reference shows at a pixel; where no colour is stored the one of these over it whose depth is stored; -1 none.
    fn stored(&self, pixel: usize, over: &[Over]) -> i32 {
        let Raster { id, z, .. } = self.reference;
        if self.stores_color {
            return id[pixel];
        }
        let off = |over: &Over| (over.z - z[pixel]).abs();
        let nearest = over.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.map_or(-1, |over| over.id)
    }

    /// Whether the depth of a triangle is so near to the reference's that the tolerance lets either win.
    fn ties(&self, pixel: usize, other: &Over) -> bool {
        (other.z - self.reference.z[pixel]).abs() <= self.tolerance.tie()
    }

    /// The cause at a pixel whose depth and colour are right.
    fn counts(&self, pixel: usize) -> Cause {
        let own = self.outside.coverage.as_ref().map(|own| own[pixel]);
        match own {
            Some(own) if own > self.reference.coverage[pixel] => Cause::Twice,
            Some(own) if own < self.reference.coverage[pixel] => Cause::LayerMissing,
            _ => Cause::Light,
        }
    }

    /// What stands in this place of the input.
    fn kind(&self, id: i32) -> &'static str {
        let primitive = usize::try_from(id).ok().and_then(|place| self.primitives.get(place));
        primitive.map_or("triangle", |primitive| edge::kind(*primitive))
    }

    /// The edge that decides whether the pixel of a finding is covered.
    fn edge(&self, fill: Fill, found: &Finding) -> Option<Edge> {
        let Fill::Exact { subpixel_bits } = fill else { return None };
        let of = |place: usize| {
            Edge::nearest(place, *self.primitives.get(place)?, subpixel_bits, (found.x, found.y))
        };
        match found.cause {
            Cause::Missing => of(usize::try_from(found.triangle).ok()?),
            Cause::Extra => match found.shown.and_then(|id| usize::try_from(id).ok()) {
                Some(place) => of(place),
                // Of what does not cover the pixel the one that comes nearest to it.
                None => (0..self.primitives.len())
                    .filter_map(of)
                    .filter(|edge| edge.distance <= 0.0)
                    .max_by(|a, b| a.distance.total_cmp(&b.distance)),
            },
            _ => None,
        }
    }
}

/// The larger of two errors; not a number is the largest.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
