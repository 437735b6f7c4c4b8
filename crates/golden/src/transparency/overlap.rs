//! Which of two triangles is farther away where they overlap on the screen.
//!
//! What they share is a convex polygon, one triangle cut by the three edges of the other. Depth is linear over the screen,
//! so the difference of their depths is greatest and least at corners of it.

/// Less of the screen than this is no overlap, square pixels: neighbours in a mesh share an edge, and rounding a little more.
const LEAST_AREA: f64 = 1e-9;

/// Depths nearer than this are the same: neighbours in a mesh have the same depth along their edge.
const LEAST_DEPTH: f64 = 1e-12;

/// Where the first of two triangles lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// The triangles do not overlap, or are at the same depth.
    Apart,
    /// Farther than the second.
    Farther,
    /// Nearer.
    Nearer,
    /// Farther here and nearer there: they cut each other.
    Both,
}

/// Compares two triangles, corners in pixels and depth.
pub(super) fn side(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> Side {
    let (Some(plane_a), Some(plane_b)) = (Plane::new(a), Plane::new(b)) else { return Side::Apart };
    let shared = intersection(a, b);
    if area(&shared).abs() < 2.0 * LEAST_AREA {
        return Side::Apart;
    }
    let differences = shared.iter().map(|point| plane_a.at(*point) - plane_b.at(*point));
    let (mut farther, mut nearer) = (false, false);
    for difference in differences {
        farther |= difference > LEAST_DEPTH;
        nearer |= difference < -LEAST_DEPTH;
    }
    match (farther, nearer) {
        (false, false) => Side::Apart,
        (true, false) => Side::Farther,
        (false, true) => Side::Nearer,
        (true, true) => Side::Both,
    }
}

/// Depth over the screen, from the first corner.
struct Plane {
    corner: [f64; 3],
    per_x: f64,
    per_y: f64,
}

impl Plane {
    /// `None` if the triangle has no area.
    fn new([a, b, c]: &[[f64; 3]; 3]) -> Option<Self> {
        let [u, v] = [b, c].map(|corner| [0, 1, 2].map(|k| corner[k] - a[k]));
        let area = u[0] * v[1] - u[1] * v[0];
        (area != 0.0).then(|| Self {
            corner: *a,
            per_x: (u[2] * v[1] - v[2] * u[1]) / area,
            per_y: (u[0] * v[2] - v[0] * u[2]) / area,
        })
    }

    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.corner[2] + (x - self.corner[0]) * self.per_x + (y - self.corner[1]) * self.per_y
    }
}

/// What two triangles share of the screen, by its corners.
fn intersection(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> Vec<[f64; 2]> {
    let [a, b] = [a, b].map(|triangle| triangle.map(|[x, y, _]| [x, y]));
    let winding = area(&b).signum();
    let mut polygon = a.to_vec();
    for k in 0..3 {
        let (from, to) = (b[k], b[(k + 1) % 3]);
        let inside = |p: [f64; 2]| {
            winding * ((to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]))
        };
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (index, end) in polygon.iter().enumerate() {
            let start = polygon[(index + polygon.len() - 1) % polygon.len()];
            let (before, here) = (inside(start), inside(*end));
            if (before < 0.0) != (here < 0.0) {
                let t = before / (before - here);
                kept.push([0, 1].map(|axis| start[axis] + t * (end[axis] - start[axis])));
            }
            if here >= 0.0 {
                kept.push(*end);
            }
        }
        polygon = kept;
    }
    polygon
}

/// Twice the area of a polygon, with its sign.
fn area(polygon: &[[f64; 2]]) -> f64 {
    let cross = |(index, a): (usize, &[f64; 2])| {
        let b = polygon[(index + 1) % polygon.len()];
        a[0] * b[1] - a[1] * b[0]
    };
    polygon.iter().enumerate().map(cross).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 0.5], [8.0, 0.0, 0.5], [0.0, 8.0, 0.5]];

    fn at_depths([a, b, c]: [f64; 3]) -> [[f64; 3]; 3] {
        [[8.0, 8.0, a], [1.0, 1.0, b], [1.0, 5.0, c]]
    }

    #[test]
    fn the_four_cases() {
        assert_eq!(side(&FLAT, &at_depths([0.4; 3])), Side::Farther);
        assert_eq!(side(&at_depths([0.4; 3]), &FLAT), Side::Nearer);
        assert_eq!(side(&FLAT, &at_depths([0.5; 3])), Side::Apart);
        assert_eq!(side(&FLAT, &at_depths([0.5, 0.4, 0.6])), Side::Both);
        // Farther only where they do not overlap: at the corner 8, 8.
        assert_eq!(side(&FLAT, &at_depths([0.6, 0.4, 0.4])), Side::Farther);
        let beside = FLAT.map(|[x, y, z]| [x + 5.0, y + 5.0, z / 2.0]);
        assert_eq!(side(&FLAT, &beside), Side::Apart);
    }

    #[test]
    fn neighbours_and_folds_share_an_edge_and_no_more() {
        let beyond = [FLAT[1], FLAT[2], [8.0, 8.0, 0.1]];
        assert_eq!(side(&FLAT, &beyond), Side::Apart);
        let folded = [FLAT[1], FLAT[2], [1.0, 1.0, 0.1]];
        assert_eq!(side(&FLAT, &folded), Side::Farther);
    }
}
