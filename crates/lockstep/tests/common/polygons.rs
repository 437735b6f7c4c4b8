//! Polygons drawn at random, token by token, with a liking for corners.

use super::triangles::{random_primitive, random_triangle, sides};
use edgewalk_machine::{Plan, PortVertex, Role, Sides, Window};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// A token at the port.
pub type Triangle = [PortVertex; 3];

/// So many tokens or a few more: triangles and lines, and where the port takes them polygons, each with its plane at the end.
pub fn primitives(plan: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<Triangle> {
    if !plan.polygon.is_there() {
        return (0..count).map(|_| random_primitive(plan, rng)).collect();
    }
    let mut tokens = Vec::new();
    while tokens.len() < count {
        if rng.random_bool(0.6) {
            tokens.extend(random_polygon(plan, rng));
        } else {
            let primitive = random_primitive(plan, rng);
            let window = random_window(plan, &primitive, rng);
            tokens.push(plan.with_window(primitive, window));
        }
    }
    tokens
}

/// A polygon whose contours are closed, or now and then any sides between any vertices.
pub fn random_polygon(plan: &Plan, rng: &mut Pcg64Mcg) -> Vec<Triangle> {
    let places = plan.polygon.edges as usize;
    let contours: Vec<Vec<PortVertex>> = match rng.random_range(0..8) {
        0 => return loose(plan, rng),
        1 => vec![contour(plan, places, rng)],
        2 => vec![contour(plan, places + 1, rng)],
        3 => (0..3).map(|_| contour(plan, 4, rng)).collect(),
        4 => vec![comb(plan, rng)],
        _ => vec![contour(plan, 6, rng)],
    };
    let all: Vec<PortVertex> = contours.concat();
    let window = random_window(plan, &[all[0], all[1], all[2]], rng);
    let tokens = plan.polygon(&contours, window);
    if tokens.is_empty() || rng.random_bool(0.05) {
        // An end alone, or a plane without area.
        let vertices = [all[0], if rng.random() { all[0] } else { all[1] }, all[2]];
        return vec![plan.with_window(plan.with_role(vertices, Role::Plane(Sides::default())), window)];
    }
    tokens
}

/// About so many vertices, at random or as those of a triangle.
fn contour(plan: &Plan, most: usize, rng: &mut Pcg64Mcg) -> Vec<PortVertex> {
    let count = if rng.random() { most.max(3) } else { rng.random_range(3..=most.max(4)) };
    let mut vertices: Vec<PortVertex> = Vec::new();
    while vertices.len() < count {
        vertices.extend(random_triangle(plan, rng));
    }
    vertices.truncate(count);
    vertices
}

/// Edges that are all active side by side.
fn comb(plan: &Plan, rng: &mut Pcg64Mcg) -> Vec<PortVertex> {
    let unit = 1i32 << plan.subpixel_bits;
    let limit = ((1 << plan.guard_bits) - 1) * unit;
    let [width, height] = sides(plan, rng).map(|side| side as i32 * unit);
    let teeth = rng.random_range(2..=plan.polygon.edges as i32 / 2);
    let [same, ..] = random_triangle(plan, rng);
    let values: Vec<i64> = same.values()[..plan.channels().len()].to_vec();
    let at = |x: i32, y: i32| plan.raw_vertex(x.clamp(-limit, limit), y.clamp(-limit, limit), &values);
    (0..2 * teeth).map(|k| at(k * width / (2 * teeth), if k % 2 == 0 { 0 } else { height })).collect()
}

/// Any sides of any vertices: what no host sends, and what draws something all the same.
fn loose(plan: &Plan, rng: &mut Pcg64Mcg) -> Vec<Triangle> {
    let count = rng.random_range(1..6);
    (0..count)
        .map(|k| {
            let sides = Sides::of_bits(rng.random_range(0..8));
            let role = if k + 1 == count { Role::Plane(sides) } else { Role::Edges(sides) };
            let vertices = random_triangle(plan, rng);
            let window = random_window(plan, &vertices, rng);
            plan.with_window(plan.with_role(vertices, role), window)
        })
        .collect()
}

/// That of the host, a band, or anything.
pub fn random_window(plan: &Plan, vertices: &Triangle, rng: &mut Pcg64Mcg) -> Window {
    let [x, y] = plan.window_bits();
    let (column, line) = (rng.random_range(0..1u32 << x), rng.random_range(0..1u32 << y));
    match rng.random_range(0..8) {
        0 => Window { x0: column, y0: line, y1: rng.random_range(0..2 << y) },
        1 | 2 => Window { x0: column, y0: line / 2, y1: line / 2 + rng.random_range(0..5) },
        3 => Window { x0: column, ..Window::default() },
        _ => plan.window_from(vertices),
    }
}
