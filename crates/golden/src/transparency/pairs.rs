//! Pairs of triangles whose rectangles on the screen overlap.

/// The pairs, the lesser place first; `None` if more than `limit` would have to be compared.
///
/// Triangles are taken from left to right; each is compared with those that begin before it ends.
pub(super) fn overlapping(triangles: &[[[f64; 3]; 3]], limit: u64) -> Option<Vec<[usize; 2]>> {
    let range = |triangle: &[[f64; 3]; 3], axis: usize| {
        let [a, b, c] = triangle.map(|corner| corner[axis]);
        [a.min(b).min(c), a.max(b).max(c)]
    };
    let mut from_left: Vec<_> =
        triangles.iter().enumerate().map(|(place, t)| (range(t, 0), range(t, 1), place)).collect();
    from_left.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let (mut pairs, mut compared) = (Vec::new(), 0);
    for (index, ([_, right], [top, bottom], place)) in from_left.iter().enumerate() {
        let beside = from_left[index + 1..].iter().take_while(|other| other.0[0] < *right);
        for (_, [other_top, other_bottom], other) in beside {
            compared += 1;
            if compared > limit {
                return None;
            }
            if other_top < bottom && top < other_bottom {
                pairs.push([*place.min(other), *place.max(other)]);
            }
        }
    }
    // The order of the pairs must not depend on where they are on the screen.
    pairs.sort_unstable();
    Some(pairs)
}
