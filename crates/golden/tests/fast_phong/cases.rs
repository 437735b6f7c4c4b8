//! Triangles with normals, and what is true of them.

use edgewalk_golden::fast_phong::{NormalPlane, Quadratic, six_point, taylor};
use edgewalk_numerics::normal_cone::normal_spread;
use glam::{DVec2, DVec3};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// A triangle on the screen, its vertex normals and a light.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    pub points: [DVec2; 3],
    pub normals: [DVec3; 3],
    pub light: DVec3,
}

pub fn direction(random: &mut Pcg64Mcg) -> DVec3 {
    loop {
        let v = DVec3::from_array(std::array::from_fn(|_| random.random_range(-1.0..1.0)));
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// Unit normals within about `width` radians of each other.
pub fn cone(random: &mut Pcg64Mcg, width: f64) -> [DVec3; 3] {
    let axis = direction(random);
    std::array::from_fn(|_| (axis + width * direction(random)).normalize())
}

/// Weights of the vertices on a triangular grid of `side` steps.
pub fn grid(side: u32) -> impl Iterator<Item = DVec3> {
    let weights = move |i: u32, j: u32| DVec3::new(f64::from(i), f64::from(j), f64::from(side - i - j));
    (0..=side).flat_map(move |i| (0..=side - i).map(move |j| weights(i, j) / f64::from(side)))
}

impl Case {
    pub fn plane(&self) -> NormalPlane {
        NormalPlane::new(self.points, self.normals).unwrap()
    }

    pub fn taylor(&self) -> Quadratic {
        taylor(&self.plane(), self.light)
    }

    pub fn six_point(&self) -> Quadratic {
        let [a, b, c] = self.normals;
        let cosine = |normal: DVec3| self.light.dot(normal.normalize());
        six_point(self.points, self.normals.map(cosine), [b + c, c + a, a + b].map(cosine)).unwrap()
    }

    /// rho of bound 10.
    pub fn spread(&self) -> f64 {
        normal_spread(&self.normals.map(|n| n.to_array()))
    }

    pub fn point(&self, weights: DVec3) -> DVec2 {
        let [a, b, c] = self.points;
        a * weights.x + b * weights.y + c * weights.z
    }

    /// The cosine that the quadratics stand for.
    pub fn truth(&self, weights: DVec3) -> f64 {
        let [a, b, c] = self.normals;
        self.light.dot((a * weights.x + b * weights.y + c * weights.z).normalize())
    }

    /// Largest error of a quadratic on a grid of the triangle.
    pub fn error(&self, quadratic: &Quadratic) -> f64 {
        grid(12).map(|w| (quadratic.at(self.point(w)) - self.truth(w)).abs()).fold(0.0, f64::max)
    }

    /// The four triangles between vertices and midpoints, on the same linear normals.
    pub fn halves(&self) -> [Self; 4] {
        let Self { points: [p, q, r], normals: [a, b, c], light } = *self;
        let (pq, qr, rp) = ((p + q) / 2.0, (q + r) / 2.0, (r + p) / 2.0);
        let (ab, bc, ca) = ((a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0);
        let case = |points, normals| Self { points, normals, light };
        [
            case([p, pq, rp], [a, ab, ca]),
            case([pq, q, qr], [ab, b, bc]),
            case([rp, qr, r], [ca, bc, c]),
            case([pq, qr, rp], [ab, bc, ca]),
        ]
    }
}

/// The value below which a share of `values` lies; sorts them.
pub fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share).round() as usize]
}
