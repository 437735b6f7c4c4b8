//! Triangles drawn at random, with a liking for corners.

use edgewalk_machine::{Plan, PortVertex, Role};
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

/// x, y and values of a vertex at the port.
type Vertex = (i32, i32, Vec<i64>);

/// A triangle around or on the screen: usually small, sometimes out to the guard band, sometimes degenerate.
pub fn random_triangle(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let limit = ((1 << plan.guard_bits) - 1) * unit;
    let [width, height] = sides(plan, rng).map(|side| side as i32 * unit);
    // How far the vertices lie from a point, and where that may be.
    let reach = match rng.random_range(0..8) {
        0..4 => 3 * unit,
        4..6 => width.max(height),
        6 => unit,
        _ => limit,
    };
    let margin = if rng.random_bool(0.2) { reach + 2 * unit } else { 0 };
    let x = rng.random_range(-margin..=width + margin);
    let y = rng.random_range(-margin..=height + margin);
    let mut triangle: [Vertex; 3] = std::array::from_fn(|_| {
        let x = (x + rng.random_range(-reach..=reach)).clamp(-limit, limit);
        let y = (y + rng.random_range(-reach..=reach)).clamp(-limit, limit);
        (x, y, values(plan, rng))
    });
    corner(plan, rng, &mut triangle);
    triangle.map(|(x, y, values)| plan.raw_vertex(x, y, &values))
}

/// A triangle, or where the port takes lines often one of those.
pub fn random_primitive(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    if plan.polygon.has_lines() && rng.random() { random_line(plan, rng) } else { random_triangle(plan, rng) }
}

/// A line around or on the screen: its ends as the host sends them, or now and then those of any triangle.
fn random_line(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let [from, second, to] = random_triangle(plan, rng);
    let flat = rng.random();
    if rng.random_bool(0.1) {
        return plan.with_role([from, second, to], Role::Line { flat });
    }
    let unit = 1 << plan.subpixel_bits;
    // On the screen's own axes a flat line has its columns where others have their lines.
    let turned = |v: &PortVertex| if flat { (v.y(), v.x()) } else { (v.x(), v.y()) };
    let mut ends = [from, to].map(|v| (turned(&v), v));
    ends.sort_by_key(|((_, along), _)| *along);
    let [((x, y), a), ((far_x, far_y), b)] = ends;
    let at = |x: i32, y: i32, like: &PortVertex| {
        let values: Vec<i64> = like.values().iter().copied().take(plan.channels().len()).collect();
        let kt = plan.has_triangle_kt().then(|| i64::from(like.kt()));
        plan.raw_vertex(x - unit / 2, y, &values.into_iter().chain(kt).collect::<Vec<_>>())
    };
    plan.with_role([at(x, y, &a), at(x + unit, y, &a), at(far_x, far_y, &b)], Role::Line { flat })
}

/// Columns and lines of the screen, or of the map if the machine draws it.
pub fn sides(plan: &Plan, rng: &mut Pcg64Mcg) -> [u32; 2] {
    let of_map = plan.shadow.draws_map() && rng.random();
    if of_map { [plan.shadow.size; 2] } else { [plan.width, plan.height] }
}

/// A triangle that covers the pixel (x, y) and little else, if it fits in the guard band.
pub fn one_pixel(plan: &Plan, rng: &mut Pcg64Mcg, x: i32, y: i32) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let limit = ((1 << plan.guard_bits) - 1) * unit;
    [(0, 0), (1, 0), (0, 2)].map(|(dx, dy)| {
        let at = |corner: i32| (corner * unit).clamp(-limit, limit);
        plan.raw_vertex(at(x + dx), at(y + dy), &values(plan, rng))
    })
}

/// A right triangle of four pixels a side: six centres lie in it, those of the first lines and columns; four on its right
/// edge do not count. z in LSB.
pub fn half_square(plan: &Plan, z: i64) -> [PortVertex; 3] {
    let side = 4 << plan.subpixel_bits;
    let mut values: Vec<i64> = vec![0; plan.channels().len()];
    values[0] = z << plan.channels()[0].vertex_fraction;
    [(0, 0), (side, 0), (0, side)].map(|(x, y)| plan.raw_vertex(x, y, &values))
}

/// A triangle of one pixel at the lowest corner of another, where that one ends.
pub fn after_it(plan: &Plan, rng: &mut Pcg64Mcg, triangle: &[PortVertex; 3]) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let end =
        triangle.iter().max_by_key(|vertex| vertex.y()).map_or((0, 0), |vertex| (vertex.x(), vertex.y()));
    one_pixel(plan, rng, end.0.div_euclid(unit), end.1.div_euclid(unit) - 1)
}

/// A value for every channel, and for a k_t of the triangle's: often the largest or the smallest that it holds. Between such vertices the words of a
/// signed channel wrap, as each half of their range lies beside the other.
fn values(plan: &Plan, rng: &mut Pcg64Mcg) -> Vec<i64> {
    let value = |channel: &edgewalk_machine::Channel| {
        let most = (channel.limit() << channel.vertex_fraction) as i64;
        let least = if channel.kind.is_signed() { -most } else { 0 };
        // What the light's map covers is a small part of what its values may be.
        let (side, depth) = (i64::from(plan.shadow.size), 1 << plan.shadow.depth_bits);
        let on_map = match channel.name {
            // Quotients below 1, but for some.
            "lw" if rng.random_bool(0.7) => return rng.random_range(most / 2..=most),
            "lx" | "ly" | "lz" if plan.shadow.projects() => Some(1 << (plan.shadow.light_bits - 1)),
            "lx" | "ly" => Some(side),
            "lz" => Some(depth),
            _ => None,
        };
        if let Some(end) = on_map.filter(|_| rng.random_bool(0.7)) {
            let (unit, end) = (1i64 << channel.vertex_fraction, end << channel.vertex_fraction);
            return rng.random_range(-unit..=end).clamp(least, most);
        }
        match rng.random_range(0..4) {
            0 => most,
            1 => least,
            _ => rng.random_range(least..=most),
        }
    };
    let mut values: Vec<i64> = plan.channels().iter().map(value).collect();
    if plan.has_triangle_kt() {
        let one = 1i64 << plan.blend.kt_bits;
        let kts = [0, one, rng.random_range(0..=one), rng.random_range(0..=one)];
        values.extend(kts.choose(rng));
    }
    values
}

/// Now and then: equal heights, whole pixels, centres, no area, equal corners.
fn corner(plan: &Plan, rng: &mut Pcg64Mcg, triangle: &mut [Vertex; 3]) {
    let unit = 1 << plan.subpixel_bits;
    let same = values(plan, rng);
    let [a, b, c] = triangle;
    match rng.random_range(0..16) {
        0 => a.1 = b.1,
        1 => b.1 = c.1,
        2 => (a.0, b.0) = (c.0, c.0),
        3 => b.1 &= -unit,
        4 => b.1 = (b.1 & -unit) + unit / 2,
        5 => *a = b.clone(),
        6 => triangle.iter_mut().for_each(|v| (v.0, v.1) = (v.0 & -unit, v.1 & -unit)),
        7 => triangle.iter_mut().for_each(|v| v.2.clone_from(&same)),
        _ => {}
    }
}
