//! Which triangles a machine may show at a pixel, given how near depths are to each other.
//!
//! A depth test whose two depths are at least E1 + E2 + 1 LSB apart comes out as in golden (bound 7; E bounds an error before the
//! output rounding, 0 for the cleared depth). Nearer ones may come out as less, equal or greater. Playing the depth test at
//! a pixel through, with every outcome of every test that is open, gives all that the machine may leave there.

use edgewalk_golden::polygon::{self, EdgeTable, Grid};
use edgewalk_golden::{Fill, Fragment, Weight, fragments, line_fragments};
use edgewalk_host::extra;
use edgewalk_host::polygon::defects;
use edgewalk_host::raster::{Raster, golden_fill};
use edgewalk_host::reach::Reach;
use edgewalk_machine::Plan;
use edgewalk_numerics::Dyadic;
use edgewalk_numerics::bounds::surely_ordered_difference;
use edgewalk_scene::{DepthFunc, Frame, MAX_EXTRA, Primitive};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// A triangle over a pixel: its place in the frame, its exact values there, depth and colour in 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    /// Place in the frame.
    pub id: i32,
    /// Depth.
    pub z: f64,
    /// Colour.
    pub rgb: [f64; 3],
    /// The user's own channels, LSB; behind the last 0.
    pub extra: [f64; MAX_EXTRA],
}

/// The pixels where the pictures show different triangles, or different numbers of writes.
pub struct Orders<'a> {
    frame: &'a Frame,
    apart: Option<Apart>,
    over: BTreeMap<usize, Vec<Over>>,
}

/// How far depths must be apart to come out in the right order, in 0 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// Two triangles.
    pub triangles: f64,
    /// A triangle and the cleared depth.
    pub cleared: f64,
}

impl Over {
    /// What golden shows at a pixel.
    pub fn golden(golden: &Raster, pixel: usize) -> Self {
        let own = |channel: usize| golden.extra.get(channel).map_or(0.0, |values| values.at(pixel));
        let (z, rgb) = (golden.z[pixel], golden.rgb[pixel]);
        Over { id: golden.id[pixel], z, rgb, extra: std::array::from_fn(own) }
    }

    /// A fragment of the triangle with this id.
    fn fragment<const N: usize, W: Weight>(machine: &Plan, fragment: &Fragment<N, W>, id: i32) -> Self {
        let channels = extra::channels(machine);
        let own =
            |channel: usize| channels.get(channel).map_or(0.0, |of| fragment.extra(channel) * of.host_unit());
        Over { id, z: fragment.z(), rgb: fragment.rgb(), extra: std::array::from_fn(own) }
    }
}

impl<'a> Orders<'a> {
    /// Of these pixels.
    pub fn new(machine: &Plan, frame: &'a Frame, pixels: &[usize], reach: Option<&Reach>) -> Self {
        let apart = apart(machine, frame, reach);
        let over = match (apart, golden_fill(machine)) {
            (Some(_), Fill::Exact { subpixel_bits }) => all_over(machine, frame, subpixel_bits, pixels),
            _ => BTreeMap::new(),
        };
        Orders { frame, apart, over }
    }

    /// The triangle with this id there, or `None` within for the background, if the bound lets the machine show it after so
    /// many writes. Without a depth test, or without a bound, it lets nothing but golden's.
    pub fn explain(&self, pixel: usize, id: i32, writes: u32) -> Option<Option<Over>> {
        let (func, apart) = (self.frame.depth?, self.apart?);
        let over = self.over.get(&pixel)?;
        if !outcomes(func, self.frame.depth_write, over, apart).contains(&(id, writes)) {
            return None;
        }
        Some(over.iter().find(|over| over.id == id).copied())
    }
}

impl Apart {
    /// Whether the test of a fragment beside the stored depth, of the triangle `stored` or the cleared one (below 0), may come out in any
    /// way. `gap`: how far the exact depths are apart.
    pub fn leaves_open(&self, frame: &Frame, id: i32, stored: i32, gap: f64) -> bool {
        gap < (if stored < 0 { self.cleared } else { self.triangles }) && !same_depth(frame, id, stored)
    }
}

/// Triangles between the same points have the same depths in any machine, bit by bit.
fn same_depth(frame: &Frame, id: i32, stored: i32) -> bool {
    let points = |id: i32| {
        let triangle = usize::try_from(id).ok().and_then(|id| frame.triangle_at(id));
        triangle.map(|triangle| triangle.0.map(|v| [v.x, v.y, v.z]))
    };
    points(id).is_some_and(|own| points(stored) == Some(own))
}

/// Bound 7 for any two fragments of the machine, or of triangles that reach so far.
pub fn apart(machine: &Plan, frame: &Frame, reach: Option<&Reach>) -> Option<Apart> {
    let depth = &machine.channels()[0];
    let budget = reach.and_then(|reach| reach.budget(machine, depth));
    let error = budget.or_else(|| machine.proved_budget(depth).ok())?.before_rounding();
    // Each of two polygons may be off its plane.
    let defect = defects(frame, machine)[0];
    let lsb = |other, defect: f64| {
        Some((surely_ordered_difference(error, other)?.to_f64() + defect) / machine.z.max() as f64)
    };
    Some(Apart { triangles: lsb(error, 2.0 * defect)?, cleared: lsb(Dyadic::ZERO, defect)? })
}

/// What lies over these pixels, in drawing order.
pub fn all_over(
    machine: &Plan,
    frame: &Frame,
    subpixel_bits: u32,
    pixels: &[usize],
) -> BTreeMap<usize, Vec<Over>> {
    let mut over: BTreeMap<usize, Vec<Over>> = pixels.iter().map(|pixel| (*pixel, Vec::new())).collect();
    if over.is_empty() {
        return over;
    }
    let screen = (frame.width, frame.height);
    let mut put = |x: u32, y: u32, one: &dyn Fn() -> Over| {
        let pixel = y as usize * frame.width as usize + x as usize;
        over.get_mut(&pixel).into_iter().for_each(|list| list.push(one()));
    };
    for (primitive, id) in frame.primitives().into_iter().zip(0..) {
        match primitive {
            Primitive::Triangle(triangle) => {
                fragments(triangle, frame.mode, subpixel_bits, screen, |f| {
                    put(f.x, f.y, &|| Over::fragment(machine, f, id));
                });
            }
            Primitive::Line(line) => line_fragments(line, frame.mode, subpixel_bits, screen, |f| {
                put(f.x, f.y, &|| Over::fragment(machine, f, id));
            }),
            Primitive::Polygon(polygon) => {
                let table = EdgeTable::new(polygon, frame.mode, Grid::subpixels(subpixel_bits));
                polygon::fragments(&table, screen, |f| put(f.x, f.y, &|| Over::fragment(machine, f, id)));
            }
        }
    }
    over
}

/// Every (id, number of writes) that may be left where these lie over a pixel; id -1 is the background.
fn outcomes(func: DepthFunc, depth_write: bool, over: &[Over], apart: Apart) -> BTreeSet<(i32, u32)> {
    // Of every way so far: whose depth is stored (`None` the cleared one), who is seen, how many wrote.
    let mut ways: BTreeSet<(Option<usize>, i32, u32)> = BTreeSet::from([(None, -1, 0)]);
    for (place, new) in over.iter().enumerate() {
        let mut next = BTreeSet::new();
        for (stored, id, writes) in ways {
            let (old, sure) = match stored {
                Some(stored) => (over[stored].z, apart.triangles),
                None => (1.0, apart.cleared),
            };
            let open = [Ordering::Less, Ordering::Equal, Ordering::Greater];
            let order = new.z.total_cmp(&old);
            let orders = if (new.z - old).abs() < sure { &open[..] } else { std::slice::from_ref(&order) };
            for order in orders {
                next.insert(if passes(func, *order) {
                    (if depth_write { Some(place) } else { None }, new.id, writes + 1)
                } else {
                    (stored, id, writes)
                });
            }
        }
        ways = next;
    }
    ways.into_iter().map(|(_, id, writes)| (id, writes)).collect()
}

fn passes(func: DepthFunc, new_to_old: Ordering) -> bool {
    match func {
        DepthFunc::Never => false,
        DepthFunc::Less => new_to_old.is_lt(),
        DepthFunc::Equal => new_to_old.is_eq(),
        DepthFunc::Lequal => new_to_old.is_le(),
        DepthFunc::Greater => new_to_old.is_gt(),
        DepthFunc::Notequal => new_to_old.is_ne(),
        DepthFunc::Gequal => new_to_old.is_ge(),
        DepthFunc::Always => true,
    }
}
