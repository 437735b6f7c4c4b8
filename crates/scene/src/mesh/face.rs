//! Faces of many corners as triangles: convex ones as a fan from the first corner, concave ones so that they keep their shape.

use crate::polygon::cut;
use glam::DVec3;

/// Most corners of a face: cutting a concave one takes time that grows with their square.
pub(crate) const MAX_CORNERS: usize = 16384;

/// The places of the corners of each triangle; they run round as the face does.
///
/// A face is seen along its mean normal (Newell's). One that crosses itself there has no inside, and is cut into a fan.
pub(crate) fn triangles(corners: &[DVec3]) -> Vec<[usize; 3]> {
    let fan = || (1..corners.len().saturating_sub(1)).map(|k| [0, k, k + 1]).collect();
    let next = |k: usize| corners[(k + 1) % corners.len()];
    // From the first corner, as coordinates may be large.
    let normal: DVec3 =
        (1..corners.len()).map(|k| (corners[k] - corners[0]).cross(next(k) - corners[0])).sum();
    let turn = |k: usize| {
        let (before, here) = (corners[(k + corners.len() - 1) % corners.len()], corners[k]);
        (here - before).cross(next(k) - here).dot(normal)
    };
    // Corners on a straight line may turn back by rounding.
    let straight = -1e-9 * normal.length_squared();
    if corners.len() < 4 || (0..corners.len()).all(|k| turn(k) >= straight) {
        return fan();
    }
    let toward = normal.normalize_or_zero();
    let across = toward.any_orthonormal_vector();
    let up = toward.cross(across);
    let seen =
        corners.iter().map(|corner| [(corner - corners[0]).dot(across), (corner - corners[0]).dot(up)]);
    match cut(&[seen.collect()]) {
        Ok(triangles) if !triangles.is_empty() => triangles,
        _ => fan(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec3]) -> DVec3 {
        let sum = |[a, b, c]: [usize; 3]| (corners[b] - corners[a]).cross(corners[c] - corners[a]) / 2.0;
        triangles(corners).into_iter().map(sum).sum()
    }

    /// An arrow head: the fan from its tip would lie outside of it.
    const ARROW: [[f64; 2]; 4] = [[0.0, 4.0], [-3.0, -2.0], [0.0, 0.0], [3.0, -2.0]];

    #[test]
    fn convex_faces_are_fans() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
        assert_eq!(triangles(&square), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles(&square[..3]), [[0, 1, 2]]);
    }

    #[test]
    fn concave_faces_keep_shape_and_side_from_every_corner_on() {
        for first in 0..4 {
            for side in [1.0, -1.0] {
                let mut corners = ARROW.map(|[x, y]| DVec3::new(x, x - y, side * y));
                corners.rotate_left(first);
                let parts = triangles(&corners);
                let whole = area(&corners);
                assert_eq!(parts.len(), 2);
                for part in parts {
                    let triangle = part.map(|k| corners[k]);
                    let own = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
                    assert!(own.dot(whole) > 0.0, "{part:?} is turned over");
                }
                // 12 in x and y, and the slopes of its plane.
                assert!((whole.length() - 12.0 * 3f64.sqrt()).abs() < 1e-12, "{whole}");
            }
        }
    }

    #[test]
    fn a_face_that_crosses_itself_is_a_fan() {
        let bow_tie = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 3.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        assert_eq!(triangles(&bow_tie), [[0, 1, 2], [0, 2, 3]]);
    }

    /// Every edge of it lies on another, so an odd number of them lies nowhere on the way out.
    #[test]
    fn a_concave_face_that_goes_round_twice_is_a_fan_and_not_nothing() {
        let twice = [ARROW, ARROW].concat();
        let corners: Vec<_> = twice.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect();
        let fan: Vec<_> = (1..7).map(|k| [0, k, k + 1]).collect();
        assert_eq!(triangles(&corners), fan);
    }
}
