//! Random polygons, and which pixels golden gives them.

use edgewalk_golden::polygon::{EdgeTable, Grid, fragments};
use edgewalk_machine::{MAX_CHANNELS, Plan, PortVertex};
use edgewalk_model::Events;
use edgewalk_model::poly::Poly;
use edgewalk_model::setup::Setup;
use edgewalk_scene::{Polygon, ShadeMode, Vertex};
use rand::Rng;
use std::collections::BTreeSet;

/// x and y, 2^-s px.
pub type Point = [i32; 2];
pub type Contours = Vec<Vec<Point>>;

/// The pixels of golden's edge table.
pub fn golden(plan: &Plan, contours: &Contours) -> BTreeSet<(i64, i64)> {
    let unit = f64::from(1u32 << plan.subpixel_bits);
    let vertex = |p: &Point| {
        let [x, y] = p.map(|at| f64::from(at) / unit);
        Vertex { x, y, ..Vertex::default() }
    };
    let contours = contours.iter().map(|contour| contour.iter().map(vertex).collect()).collect();
    let grid = Grid::subpixels(plan.subpixel_bits);
    let table = EdgeTable::new(&Polygon { contours, after: 0 }, ShadeMode::Gouraud, grid);
    let mut pixels = BTreeSet::new();
    fragments(&table, (plan.width, plan.height), |f| {
        assert!(pixels.insert((f.x.into(), f.y.into())), "drawn twice");
    });
    pixels
}

/// POLY with the last of these tokens taken, from where on it walks.
pub fn loaded(plan: &Plan, tokens: &[[PortVertex; 3]]) -> Poly<MAX_CHANNELS> {
    let (mut setup, mut poly, mut events) = (Setup::new(plan), Poly::new(plan), Events::default());
    for token in tokens {
        let Some(prim) = setup.run(token, &mut events) else { continue };
        while !poly.prim_ready(&prim, false) {
            poly.step(Some(&prim), false, true, false, &mut events);
        }
        poly.step(Some(&prim), false, true, false, &mut events);
        setup.step(None, true, false, &mut events);
    }
    poly
}

/// The contours as vertices whose values lie in a plane, as far as they can.
pub fn vertices(
    plan: &Plan,
    contours: &Contours,
    value: impl Fn(usize, Point) -> i64,
) -> Vec<Vec<PortVertex>> {
    let channels = plan.channels().len();
    let vertex = |p: &Point| {
        let values: Vec<i64> = (0..channels).map(|channel| value(channel, *p)).collect();
        plan.raw_vertex(p[0], p[1], &values)
    };
    contours.iter().map(|contour| contour.iter().map(vertex).collect()).collect()
}

/// A polygon around or on the screen: what a kind of shapes has in common is in its name.
pub fn shape(plan: &Plan, kind: &str, rng: &mut impl Rng) -> Contours {
    let unit = 1i32 << plan.subpixel_bits;
    let sides = [plan.width, plan.height].map(|side| side as i32 * unit);
    let limit = ((1 << plan.guard_bits) - 1) * unit;
    let centre = sides.map(|side| rng.random_range(0..=side));
    let reach = f64::from(sides[0].max(sides[1])) * rng.random_range(0.05..0.9);
    let mut on_ring = |count: usize, low: f64, high: f64| -> Vec<Point> {
        let start = rng.random_range(0.0..1.0);
        let ray = |k: usize| std::f64::consts::TAU * (k as f64 + start) / count as f64;
        (0..count)
            .map(|k| {
                let length = reach * if low < high { rng.random_range(low..high) } else { low };
                let at = [length * ray(k).cos(), length * ray(k).sin()];
                [0, 1].map(|axis| (centre[axis] + at[axis] as i32).clamp(-limit, limit))
            })
            .collect()
    };
    let mut contours = match kind {
        "convex" => vec![on_ring(7, 1.0, 1.0)],
        "star" => vec![on_ring(12, 0.1, 1.0)],
        "hole" => vec![on_ring(8, 0.7, 1.0), on_ring(6, 0.1, 0.6)],
        "two" => vec![on_ring(3, 0.2, 1.0), on_ring(5, 0.1, 1.0)],
        _ => {
            let count = rng.random_range(3..13);
            let far = kind == "far";
            let point = |axis: usize, rng: &mut dyn rand::RngCore| {
                let margin = if far { limit - sides[axis] } else { 3 * unit };
                rng.random_range(-margin.max(0)..=sides[axis] + margin.max(0)).clamp(-limit, limit)
            };
            vec![(0..count).map(|_| [point(0, rng), point(1, rng)]).collect()]
        }
    };
    let last = contours.len() - 1;
    match (kind, rng.random_range(0..6)) {
        ("comb", _) => {
            // Teeth between the lines 2 and H - 2: many edges side by side.
            let teeth = 5;
            let (top, bottom) = (2 * unit, sides[1] - 2 * unit);
            let step = sides[0] / (2 * teeth + 1);
            contours[last] =
                (0..2 * teeth + 1).map(|k| [k * step, if k % 2 == 0 { bottom } else { top }]).collect();
            contours[last].push([2 * teeth * step, sides[1] - unit]);
            contours[last].push([0, sides[1] - unit]);
        }
        (_, 0) => contours.iter_mut().flatten().for_each(|p| *p = p.map(|at| at & -unit)),
        (_, 1) => contours.iter_mut().flatten().for_each(|p| *p = p.map(|at| (at & -unit) + unit / 2)),
        (_, 2) => {
            let again = contours[last][0];
            contours[last].push(again);
        }
        (_, 3) if contours[last].len() > 3 => contours[last][1][1] = contours[last][0][1],
        _ => {}
    }
    contours.iter_mut().flatten().for_each(|p| *p = p.map(|at| at.clamp(-limit, limit)));
    contours
}

/// All kinds of shapes.
pub const KINDS: [&str; 7] = ["convex", "star", "hole", "two", "crossing", "far", "comb"];
