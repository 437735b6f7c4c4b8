//! The half-plane that decides whether a triangle covers a pixel, or the edge that decides whether a polygon does.

use edgewalk_golden::snap;
use edgewalk_scene::Primitive;
use serde::Serialize;

/// Of the edges of a triangle the one that the centre of a pixel is least inside of, or of those of a polygon the nearest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Edge {
    /// Place of the triangle or polygon in the input.
    pub triangle: usize,
    /// Which of both it is.
    #[serde(skip)]
    pub kind: &'static str,
    /// The vertices that the edge joins, counted from 1; those of a polygon's further contours go on from the contour before.
    pub vertices: [usize; 2],
    /// How far the centre is inside of the edge, pixels; negative outside, 0 on the edge, where the rule decides.
    pub distance: f64,
}

/// A point, half sub-pixels, so that centres are whole numbers: below 2^30, products below 2^62.
type Point = [i64; 2];

impl Edge {
    /// Of what stands in this place, its vertices snapped to sub-pixels; none of a line, and where a triangle has no area.
    #[must_use]
    pub fn nearest(place: usize, of: Primitive, subpixel_bits: u32, (x, y): (u32, u32)) -> Option<Edge> {
        let snapped = |coordinate: f64| 2 * snap(coordinate, subpixel_bits);
        let contours: Vec<Vec<Point>> = of
            .contours()
            .into_iter()
            .map(|contour| contour.iter().map(|v| [snapped(v.x), snapped(v.y)]).collect())
            .collect();
        let centre = [x, y].map(|at| (2 * i64::from(at) + 1) << subpixel_bits);
        let (vertices, distance) = match of {
            Primitive::Triangle(_) => of_triangle(&contours[0], centre)?,
            Primitive::Polygon(_) => of_polygon(&contours, centre)?,
            Primitive::Line(_) => return None,
        };
        let distance = distance / f64::from(2u32 << subpixel_bits);
        Some(Edge { triangle: place, kind: kind(of), vertices, distance })
    }
}

/// What a primitive is called.
pub(super) fn kind(of: Primitive) -> &'static str {
    match of {
        Primitive::Triangle(_) => "triangle",
        Primitive::Polygon(_) => "polygon",
        Primitive::Line(_) => "line",
    }
}

/// Twice the area of a triangle, positive if its points run clockwise on the screen.
fn cross(a: Point, b: Point, c: Point) -> i128 {
    i128::from(b[0] - a[0]) * i128::from(c[1] - a[1]) - i128::from(b[1] - a[1]) * i128::from(c[0] - a[0])
}

fn length(a: Point, b: Point) -> f64 {
    ((b[0] - a[0]) as f64).hypot((b[1] - a[1]) as f64)
}

/// The edge that the centre is least inside of, and by how much.
fn of_triangle(points: &[Point], centre: Point) -> Option<([usize; 2], f64)> {
    let area = cross(points[0], points[1], points[2]);
    if area == 0 {
        return None;
    }
    let edges = [[0, 1], [1, 2], [2, 0]].map(|[from, to]| {
        let (a, b) = (points[from], points[to]);
        ([from + 1, to + 1], (cross(a, b, centre) * area.signum()) as f64 / length(a, b))
    });
    edges.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The edge nearest to the centre, and how far it is: positive where an odd number of edges lies left of the centre.
fn of_polygon(contours: &[Vec<Point>], centre: Point) -> Option<([usize; 2], f64)> {
    let (mut nearest, mut first, mut left) = (None::<([usize; 2], f64)>, 1, 0);
    for contour in contours {
        for (from, a) in contour.iter().enumerate() {
            let to = (from + 1) % contour.len();
            let b = contour[to];
            let upper = if a[1] <= b[1] { [*a, b] } else { [b, *a] };
            let crosses = upper[0][1] <= centre[1] && centre[1] < upper[1][1];
            left += usize::from(crosses && cross(upper[0], upper[1], centre) <= 0);
            let distance = beside(*a, b, centre);
            if nearest.is_none_or(|(_, least)| distance < least) {
                nearest = Some(([first + from, first + to], distance));
            }
        }
        first += contour.len();
    }
    nearest.map(|(vertices, distance)| (vertices, if left % 2 == 1 { distance } else { -distance }))
}

/// The distance of a point from the line between two others.
fn beside(a: Point, b: Point, point: Point) -> f64 {
    let along = |from: Point, to: Point| {
        i128::from(to[0] - from[0]) * i128::from(point[0] - from[0])
            + i128::from(to[1] - from[1]) * i128::from(point[1] - from[1])
    };
    match (along(a, b) > 0, along(b, a) > 0) {
        (true, true) => cross(a, b, point).unsigned_abs() as f64 / length(a, b),
        (false, _) => length(a, point),
        (_, false) => length(b, point),
    }
}
