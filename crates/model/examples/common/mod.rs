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
