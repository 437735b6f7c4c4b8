//! Triangles drawn at random, with a liking for corners.

use edgewalk_machine::{Plan, PortVertex};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// A triangle around or on the screen: usually small, sometimes out to the guard band, sometimes degenerate.
pub fn random_triangle(machine: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << machine.subpixel_bits;
    let limit = ((1 << machine.guard_bits) - 1) * unit;
    let (width, height) = (machine.width as i32 * unit, machine.height as i32 * unit);
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
    let mut triangle = [PortVertex::default(); 3];
    for vertex in &mut triangle {
        vertex.x = (x + rng.random_range(-reach..=reach)).clamp(-limit, limit);
        vertex.y = (y + rng.random_range(-reach..=reach)).clamp(-limit, limit);
        vertex.value = values(machine, rng);
    }
    corner(machine, rng, &mut triangle);
    triangle
}

/// A triangle that covers the pixel (x, y) and little else, if it fits in the guard band.
pub fn one_pixel(machine: &Plan, rng: &mut Pcg64Mcg, x: i32, y: i32) -> [PortVertex; 3] {
    let unit = 1 << machine.subpixel_bits;
    let limit = ((1 << machine.guard_bits) - 1) * unit;
    let at = |dx: i32, dy: i32| {
        ((x * unit + dx * unit).clamp(-limit, limit), (y * unit + dy * unit).clamp(-limit, limit))
    };
    let corners = [at(0, 0), at(1, 0), at(0, 2)];
    corners.map(|(x, y)| PortVertex { x, y, value: values(machine, rng) })
}

/// A triangle of one pixel at the lowest corner of another, where that one ends.
pub fn after_it(machine: &Plan, rng: &mut Pcg64Mcg, triangle: &[PortVertex; 3]) -> [PortVertex; 3] {
    let unit = 1 << machine.subpixel_bits;
    let end = triangle.iter().max_by_key(|vertex| vertex.y).map_or((0, 0), |vertex| (vertex.x, vertex.y));
    one_pixel(machine, rng, end.0.div_euclid(unit), end.1.div_euclid(unit) - 1)
}

fn values(machine: &Plan, rng: &mut Pcg64Mcg) -> [u64; 4] {
    std::array::from_fn(|i| {
        let channel = machine.channels()[i];
        let most = channel.max() << channel.vertex_fraction;
        match rng.random_range(0..4) {
            0 => most,
            1 => 0,
            _ => rng.random_range(0..=most),
        }
    })
}

/// Now and then: equal heights, whole pixels, centres, no area, equal corners.
fn corner(machine: &Plan, rng: &mut Pcg64Mcg, triangle: &mut [PortVertex; 3]) {
    let unit = 1 << machine.subpixel_bits;
    let same = values(machine, rng);
    let [a, b, c] = triangle;
    match rng.random_range(0..16) {
        0 => a.y = b.y,
        1 => b.y = c.y,
        2 => (a.x, b.x) = (c.x, c.x),
        3 => b.y &= -unit,
        4 => b.y = (b.y & -unit) + unit / 2,
        5 => *a = *b,
        6 => triangle.iter_mut().for_each(|v| (v.x, v.y) = (v.x & -unit, v.y & -unit)),
        7 => triangle.iter_mut().for_each(|v| v.value = same),
        _ => {}
    }
}
