//! What the examples draw.

use edgewalk_machine::{Plan, PortVertex};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// Random triangles of `area` pixels each, wholly on the screen, any shape but needles, z and colours at random; of a
/// machine with these four channels.
pub fn triangles(plan: &Plan, count: usize, area: f64) -> Vec<[PortVertex; 3]> {
    let mut rng = StdRng::seed_from_u64(1);
    let mut triangles = Vec::new();
    while triangles.len() < count {
        let shape: [[f64; 2]; 3] =
            std::array::from_fn(|_| [rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0)]);
        let [a, b, c] = shape;
        let size = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs() / 2.0;
        if size < 0.2 {
            continue;
        }
        let scale = (area / size).sqrt();
        let sides = [f64::from(plan.width), f64::from(plan.height)];
        let middle = sides.map(|side| rng.random_range(0.0..side));
        let corners = shape.map(|p| [middle[0] + scale * p[0], middle[1] + scale * p[1]]);
        if corners.iter().any(|p| (0..2).any(|i| p[i] < 0.0 || p[i] > sides[i])) {
            continue;
        }
        let vertex =
            |p: [f64; 2]| plan.port_vertex(p[0], p[1], &[(); 4].map(|()| rng.random_range(0.0..=1.0)));
        let corners: Result<Vec<_>, _> = corners.into_iter().map(vertex).collect();
        if let Ok(Ok(triangle)) = corners.map(<[PortVertex; 3]>::try_from) {
            triangles.push(triangle);
        }
    }
    triangles
}

/// A torus of 5,928 triangles, front and back, of `area` pixels each in the middle, in the middle of the screen.
#[allow(dead_code)] // not every example draws it
pub fn torus(plan: &Plan, area: f64) -> Vec<[PortVertex; 3]> {
    let corners = torus_corners();
    let size = |[a, b, c]: &[[f64; 3]; 3]| {
        ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs() / 2.0
    };
    let mean = corners.iter().map(size).sum::<f64>() / corners.len() as f64;
    let scale = (area / mean).sqrt();
    let middle = [f64::from(plan.width) / 2.0, f64::from(plan.height) / 2.0];
    let vertex = |[x, y, z]: [f64; 3]| {
        let values = [z, x, y, 0.0].map(|value| 0.5 + value / 4.0);
        plan.port_vertex(middle[0] + scale * x, middle[1] + scale * y, &values)
    };
    let triangle = |corners: [[f64; 3]; 3]| {
        let corners: Result<Vec<_>, _> = corners.into_iter().map(vertex).collect();
        corners.ok().and_then(|corners| corners.try_into().ok())
    };
    corners.into_iter().filter_map(triangle).collect()
}

/// Its corners, seen from above and somewhat to the side; radii 1 and 0.4.
fn torus_corners() -> Vec<[[f64; 3]; 3]> {
    const AROUND: u32 = 76;
    const ACROSS: u32 = 39;
    let (sin, cos) = 0.6f64.sin_cos();
    let at = |i: u32, j: u32| {
        let [around, across] =
            [(i, AROUND), (j, ACROSS)].map(|(k, n)| f64::from(k) / f64::from(n) * std::f64::consts::TAU);
        let radius = 1.0 + 0.4 * across.cos();
        let (x, y, z) = (radius * around.cos(), radius * around.sin(), 0.4 * across.sin());
        [x, y * cos - z * sin, y * sin + z * cos]
    };
    let quads = (0..AROUND).flat_map(|i| (0..ACROSS).map(move |j| (i, j)));
    let two = |(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    quads.flat_map(two).collect()
}
