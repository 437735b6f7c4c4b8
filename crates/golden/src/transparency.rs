//! The order in which transparent surfaces are drawn: decreasing distance from the eye (ch. 7.2), and where there is none.
//!
//! ```text
//!   opaque triangles, in list order          depth test decides, as ever
//!   transparent ones, farthest first         each adds (1 - k_t) I* + k_t I_back, I_back being all behind it (ch. 7.5)
//! ```
//! One distance a triangle is not enough: of two long ones either may be nearer where they overlap. So pairs that overlap
//! on the screen are compared there, and the list is sorted such that of every pair the farther one comes first; where
//! that leaves a choice, the one whose farthest vertex is farthest. No such order exists if triangles cut each other, or
//! go round: a before b before c before a. Then the picture is wrong somewhere, and [`Order`] says so.

mod overlap;
mod pairs;

use crate::cover::snap;
use edgewalk_scene::{Blending, Change, Frame, State, Triangle};
use overlap::{Side, side};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Most pairs whose rectangles are compared; beyond, triangles are sorted by their farthest vertices alone.
pub const MAX_PAIRS: u64 = 20_000_000;

/// An order of triangles, and whether it is one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Order {
    /// Places in the list: opaque triangles, then transparent ones from back to front.
    pub order: Vec<usize>,
    /// How many of them, at the end, are transparent.
    pub transparent: usize,
    /// Pairs of transparent triangles that cut each other.
    pub intersections: Vec<[usize; 2]>,
    /// Transparent triangles that had to come before one that lies farther away, as they lie in a circle.
    pub cycles: Vec<usize>,
    /// Whether there were more than [`MAX_PAIRS`] pairs, so that nothing above was looked for.
    pub unchecked: bool,
}

impl Order {
    /// Why the picture may be wrong, in words; `None` where it is right.
    pub fn warning(&self) -> Option<String> {
        let mut reasons = Vec::new();
        if let [[a, b], rest @ ..] = &self.intersections[..] {
            reasons.push(format!("triangles {a} and {b} cut each other, and {} more pairs", rest.len()));
        }
        if let [first, rest @ ..] = &self.cycles[..] {
            reasons.push(format!(
                "triangle {first} and {} more lie in circles, each before the next",
                rest.len()
            ));
        }
        if self.unchecked {
            reasons.push(format!("more than {MAX_PAIRS} pairs, sorted by their farthest vertices only"));
        }
        let why = reasons.join("; ");
        (!reasons.is_empty())
            .then(|| format!("transparent triangles without an order from back to front: {why}"))
    }
}

/// Sorts triangles for blending. A triangle is transparent if k_t is positive at a vertex; vertices count as snapped to
/// `subpixel_bits`, 0..=8, as they are drawn.
pub fn back_to_front(triangles: &[Triangle], subpixel_bits: u32) -> Order {
    let (mut clear, opaque): (Vec<usize>, Vec<usize>) =
        (0..triangles.len()).partition(|place| is_transparent(&triangles[*place]));
    // Of equal distances the first in the list comes first.
    clear.sort_by(|a, b| farthest(&triangles[*b]).total_cmp(&farthest(&triangles[*a])));
    let snapped: Vec<_> = clear.iter().map(|place| corners(&triangles[*place], subpixel_bits)).collect();
    let mut order = Order {
        order: opaque,
        transparent: clear.len(),
        intersections: Vec::new(),
        cycles: Vec::new(),
        unchecked: false,
    };
    let Some(pairs) = pairs::overlapping(&snapped, MAX_PAIRS) else {
        order.order.extend(clear);
        return Order { unchecked: true, ..order };
    };
    // From now on triangles go by their places in `clear`.
    let mut graph = Graph::new(clear.len());
    for [a, b] in pairs {
        match side(&snapped[a], &snapped[b]) {
            Side::Apart => {}
            Side::Farther => graph.before(a, b),
            Side::Nearer => graph.before(b, a),
            Side::Both => order.intersections.push([clear[a], clear[b]]),
        }
    }
    let (sorted, cycles) = graph.sort();
    order.order.extend(sorted.into_iter().map(|rank| clear[rank]));
    order.cycles.extend(cycles.into_iter().map(|rank| clear[rank]));
    order
}

/// A frame whose triangles are drawn one after the other as they can be blended: what is opaque by the frame's own rules,
/// then what is not, from back to front, which leaves the depth alone.
pub fn sorted(frame: Frame, subpixel_bits: u32) -> (Frame, Order) {
    let order = back_to_front(&frame.triangles, subpixel_bits);
    let triangles: Vec<_> = order.order.iter().map(|place| frame.triangles[*place]).collect();
    let state = State { blend: Blending::Mix, depth_write: false, ..frame.state() };
    let after = triangles.len() - order.transparent;
    let changes = vec![Change { after, state, clear_depth: false }];
    let shading = frame.shading.map(|shading| shading.picked(order.order.iter().copied()));
    (Frame { triangles, changes, shading, blend: Blending::Off, ..frame }, order)
}

/// Whether something is seen through it.
pub(crate) fn is_transparent(triangle: &Triangle) -> bool {
    triangle.0.iter().any(|vertex| vertex.kt > 0.0)
}

/// Corners in pixels and depth, as they are drawn.
fn corners(triangle: &Triangle, subpixel_bits: u32) -> [[f64; 3]; 3] {
    let pixels = |v: f64| snap(v, subpixel_bits) as f64 / f64::from(1u32 << subpixel_bits);
    triangle.0.map(|v| [pixels(v.x), pixels(v.y), v.z])
}

/// The greatest depth.
fn farthest(triangle: &Triangle) -> f64 {
    triangle.0.iter().map(|vertex| vertex.z).fold(0.0, f64::max)
}

/// What must be drawn before what.
struct Graph {
    after: Vec<Vec<usize>>,
    /// How many come before.
    waits: Vec<usize>,
}

impl Graph {
    fn new(count: usize) -> Self {
        Self { after: vec![Vec::new(); count], waits: vec![0; count] }
    }

    fn before(&mut self, first: usize, then: usize) {
        self.after[first].push(then);
        self.waits[then] += 1;
    }

    /// An order that keeps every rule it can, the least number first where there is a choice; and those that were taken
    /// though something had to come before them.
    fn sort(mut self) -> (Vec<usize>, Vec<usize>) {
        let (mut order, mut cycles) = (Vec::with_capacity(self.waits.len()), Vec::new());
        let mut done = vec![false; self.waits.len()];
        let free = self.waits.iter().enumerate().filter(|(_, waits)| **waits == 0);
        let mut ready: BinaryHeap<Reverse<usize>> = free.map(|(place, _)| Reverse(place)).collect();
        let mut rest = 0..self.waits.len();
        loop {
            let next = match ready.pop() {
                Some(Reverse(place)) => place,
                None => match rest.find(|place| !done[*place]) {
                    Some(place) => {
                        cycles.push(place);
                        place
                    }
                    None => return (order, cycles),
                },
            };
            if std::mem::replace(&mut done[next], true) {
                continue;
            }
            order.push(next);
            for then in std::mem::take(&mut self.after[next]) {
                self.waits[then] -= 1;
                if self.waits[then] == 0 {
                    ready.push(Reverse(then));
                }
            }
        }
    }
}
