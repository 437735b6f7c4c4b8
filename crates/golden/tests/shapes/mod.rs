//! Random polygons on a grid of sub-pixels, and which pixels belong to them, said without edge tables.
#![allow(dead_code)] // each suite takes what it needs

use edgewalk_golden::polygon::{EdgeTable, Grid, fragments};
use edgewalk_scene::{Polygon, ShadeMode, Vertex};
use rand::Rng;
use rand_pcg::Pcg64;
use std::collections::BTreeSet;

/// Sub-pixels to the right and down.
pub type Point = [i64; 2];
pub type Pixels = BTreeSet<(u32, u32)>;

pub const SCREEN: (u32, u32) = (24, 20);

pub fn polygon(contours: &[Vec<Point>], bits: u32) -> Polygon {
    let vertex = |p: &Point| {
        let [x, y] = p.map(|c| c as f64 / f64::from(1u32 << bits));
        Vertex { x, y, ..Vertex::default() }
    };
    Polygon {
        contours: contours.iter().map(|contour| contour.iter().map(vertex).collect()).collect(),
        after: 0,
    }
}

/// What the edge table covers.
pub fn covered(contours: &[Vec<Point>], bits: u32) -> Pixels {
    let table = EdgeTable::new(&polygon(contours, bits), ShadeMode::Gouraud, Grid::subpixels(bits));
    let mut pixels = Pixels::new();
    fragments(&table, SCREEN, |f| {
        assert!(f.x < SCREEN.0 && f.y < SCREEN.1, "{} {} is off the screen", f.x, f.y);
        assert!(pixels.insert((f.x, f.y)), "pixel {} {} drawn twice by one polygon", f.x, f.y);
    });
    pixels
}

/// Edges of closed contours.
fn edges(contours: &[Vec<Point>]) -> impl Iterator<Item = [Point; 2]> + '_ {
    contours.iter().flat_map(|c| (0..c.len()).map(|i| [c[i], c[(i + 1) % c.len()]]))
}

fn cross(a: Point, b: Point, c: Point) -> i128 {
    let [ab, ac] = [b, c].map(|p| [0, 1].map(|k| i128::from(p[k]) - i128::from(a[k])));
    ab[0] * ac[1] - ab[1] * ac[0]
}

/// Whether a point has an odd number of edges to its left or through it, by a ray to the left; half-open in y.
pub fn inside(contours: &[Vec<Point>], at: Point) -> bool {
    let crossed = edges(contours).filter(|[a, b]| {
        let [top, bottom] = if a[1] < b[1] { [*a, *b] } else { [*b, *a] };
        // y runs down: the point is right of top-bottom if they turn left on the screen.
        top[1] <= at[1] && at[1] < bottom[1] && cross(top, bottom, at) <= 0
    });
    crossed.count() % 2 == 1
}

/// The same by a ray upwards, which meets other edges; `None` on an edge, where the rule is about sides.
pub fn inside_by_a_vertical_ray(contours: &[Vec<Point>], at: Point) -> Option<bool> {
    let mut odd = false;
    for [a, b] in edges(contours) {
        let [left, right] = if a[0] < b[0] { [a, b] } else { [b, a] };
        let within = |k: usize| a[k].min(b[k]) <= at[k] && at[k] <= a[k].max(b[k]);
        if cross(a, b, at) == 0 && within(0) && within(1) {
            return None;
        }
        odd ^= left[0] <= at[0] && at[0] < right[0] && cross(left, right, at) > 0;
    }
    Some(odd)
}

/// Twice the polygon, on a grid where the centres of pixels are integers, and these centres.
pub fn doubled(contours: &[Vec<Point>], bits: u32) -> (Vec<Vec<Point>>, impl Fn(u32, u32) -> Point) {
    let contours = contours.iter().map(|c| c.iter().map(|p| p.map(|v| 2 * v)).collect()).collect();
    (contours, move |x, y| [x, y].map(|c| (2 * i64::from(c) + 1) << bits))
}

/// The pixels by the ray to the left.
pub fn expected(contours: &[Vec<Point>], bits: u32) -> Pixels {
    let (contours, centre) = doubled(contours, bits);
    let all = (0..SCREEN.1).flat_map(|y| (0..SCREEN.0).map(move |x| (x, y)));
    all.filter(|(x, y)| inside(&contours, centre(*x, *y))).collect()
}

pub fn random_point(rng: &mut Pcg64, bits: u32) -> Point {
    // Beyond the screen on all sides.
    [SCREEN.0, SCREEN.1].map(|side| rng.random_range(-(4i64 << bits)..=(i64::from(side) + 4) << bits))
}

pub fn random_points(rng: &mut Pcg64, bits: u32, most: usize) -> Vec<Point> {
    let count = rng.random_range(3..=most);
    (0..count).map(|_| random_point(rng, bits)).collect()
}

/// The convex hull of random points; at least a triangle.
pub fn convex(rng: &mut Pcg64, bits: u32) -> Vec<Point> {
    loop {
        let mut points = random_points(rng, bits, 14);
        points.sort_unstable();
        points.dedup();
        let mut hull: Vec<Point> = Vec::new();
        for _ in 0..2 {
            let start = hull.len();
            for p in &points {
                while hull.len() >= start + 2 && cross(hull[hull.len() - 2], hull[hull.len() - 1], *p) <= 0 {
                    hull.pop();
                }
                hull.push(*p);
            }
            hull.pop();
            points.reverse();
        }
        if hull.len() >= 3 {
            return hull;
        }
    }
}

/// A polygon that does not cross or touch itself, mostly concave: random points, untangled by turning a part of the
/// contour round wherever two edges meet.
pub fn concave(rng: &mut Pcg64, bits: u32) -> Vec<Point> {
    'again: loop {
        let mut points = random_points(rng, bits, 12);
        for _ in 0..200 {
            let Some((i, j)) = meeting_edges(&points) else { return points };
            points[i + 1..=j].reverse();
        }
        continue 'again;
    }
}

/// Two edges i < j that have a point in common which is not the vertex between them.
fn meeting_edges(points: &[Point]) -> Option<(usize, usize)> {
    let n = points.len();
    let edge = |i: usize| [points[i], points[(i + 1) % n]];
    let all = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    all.into_iter().find(|(i, j)| {
        let ([a, b], [c, d]) = (edge(*i), edge(*j));
        if j - i == 1 || n - (j - i) == 1 {
            // Neighbours: do they run back over each other?
            let (shared, one, other) = if j - i == 1 { (b, a, d) } else { (a, b, c) };
            let along = [0, 1].map(|k| i128::from(one[k] - shared[k]) * i128::from(other[k] - shared[k]));
            return cross(shared, one, other) == 0 && along[0] + along[1] >= 0;
        }
        let apart = |p: [Point; 2], q: [Point; 2]| {
            let [s, t] = q.map(|v| cross(p[0], p[1], v).signum());
            s * t > 0
        };
        let boxes =
            [0, 1].into_iter().all(|k| a[k].min(b[k]) <= c[k].max(d[k]) && c[k].min(d[k]) <= a[k].max(b[k]));
        boxes && !apart([a, b], [c, d]) && !apart([c, d], [a, b])
    })
}

/// A simple polygon with a hole: the polygon scaled towards a point that sees all of it, here a star's centre.
pub fn star_with_hole(rng: &mut Pcg64, bits: u32) -> Vec<Vec<Point>> {
    let spikes = rng.random_range(3..10);
    let centre = [SCREEN.0, SCREEN.1].map(|side| i64::from(side) << bits >> 1);
    // On rays in the order of their angles, each length within the first one's halves: the small star fits inside.
    let ray = |k: usize| std::f64::consts::TAU * k as f64 / spikes as f64;
    let star = |length: &mut dyn FnMut() -> f64| -> Vec<Point> {
        let unit = f64::from(1u32 << bits);
        (0..spikes)
            .map(|k| {
                let l = length() * unit;
                [centre[0] + (l * ray(k).cos()) as i64, centre[1] + (l * ray(k).sin()) as i64]
            })
            .collect()
    };
    let outer = star(&mut || rng.random_range(6.0..12.0));
    let hole = star(&mut || rng.random_range(0.5..2.5));
    vec![outer, hole]
}
