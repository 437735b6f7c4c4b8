//! Meshes by formula: closed ones but for the terrain, with texture places, materials and smoothing groups.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// A mesh of polygons on its way into a file.
#[derive(Default)]
pub struct Shape {
    /// Places.
    pub points: Vec<[f64; 3]>,
    /// Texture places.
    pub places: Vec<[f64; 2]>,
    /// Unit vectors, one a point, if the file is to have them.
    pub normals: Option<Vec<[f64; 3]>>,
    /// Polygons.
    pub faces: Vec<Face>,
}

/// A polygon.
pub struct Face {
    /// Point and texture place of each corner, counter-clockwise from outside.
    pub corners: Vec<(usize, usize)>,
    /// Number of its material.
    pub material: usize,
    /// Number of its smoothing group, 0 for none.
    pub group: usize,
}

/// Whether a grid closes upon itself along u and along v.
type Wraps = [bool; 2];

/// A grid of `columns` times `rows` quads over u and v in [0, 1].
fn grid(columns: usize, rows: usize, wraps: Wraps, at: impl Fn(f64, f64) -> [f64; 3]) -> Shape {
    let across = columns + usize::from(!wraps[0]);
    let down = rows + usize::from(!wraps[1]);
    let share = |k: usize, of: usize| k as f64 / of as f64;
    let mut shape = Shape::default();
    for j in 0..down {
        shape.points.extend((0..across).map(|i| at(share(i, columns), share(j, rows))));
    }
    for j in 0..=rows {
        shape.places.extend((0..=columns).map(|i| [share(i, columns), share(j, rows)]));
    }
    let corner = |i: usize, j: usize| ((j % down) * across + i % across, j * (columns + 1) + i);
    for (j, i) in (0..rows).flat_map(|j| (0..columns).map(move |i| (j, i))) {
        let corners = vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        shape.faces.push(Face { corners, material: 0, group: 0 });
    }
    shape
}

/// A tube of the given radius around a closed curve; `bend` shapes the radius by u and v.
fn tube(
    columns: usize,
    rows: usize,
    curve: impl Fn(f64) -> [f64; 3],
    radius: impl Fn(f64, f64) -> f64,
) -> Shape {
    grid(columns, rows, [true, true], |u, v| {
        let [here, ahead] = [curve(u), curve(u + 1e-4)];
        let along = unit(sub(ahead, here));
        let side = unit(cross(along, [0.0, 0.3, 1.0]));
        let up = cross(side, along);
        let (sin, cos) = (TAU * v).sin_cos();
        let r = radius(u, v);
        std::array::from_fn(|k| here[k] + r * (cos * side[k] + sin * up[k]))
    })
}

/// A ring: 4,096 triangles, normals in the file, texture.
pub fn torus() -> Shape {
    let place = |u: f64, v: f64| {
        let ((su, cu), (sv, cv)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
        [(1.0 + 0.4 * cv) * cu, 0.4 * sv, -(1.0 + 0.4 * cv) * su]
    };
    let mut shape = grid(64, 32, [true, true], place);
    let centre = |p: [f64; 3]| {
        let length = p[0].hypot(p[2]);
        [p[0] / length, 0.0, p[2] / length]
    };
    shape.normals = Some(shape.points.iter().map(|p| unit(sub(*p, centre(*p)))).collect());
    shape
}

/// A ball with caps of triangles: 3,968 triangles, one smoothing group, no normals.
pub fn sphere() -> Shape {
    let (columns, rows) = (64, 32);
    let ring = |u: f64, v: f64| {
        // Without the poles.
        let (latitude, longitude) = (PI * (1.0 + v * (rows - 2) as f64) / rows as f64, TAU * u);
        [latitude.sin() * longitude.cos(), latitude.cos(), -latitude.sin() * longitude.sin()]
    };
    let mut shape = grid(columns, rows - 2, [true, false], ring);
    // The grid runs down, which turns its quads.
    shape.faces.iter_mut().for_each(|face| face.corners.reverse());
    let (top, bottom) = (shape.points.len(), shape.points.len() + 1);
    shape.points.extend([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]);
    let last = (rows - 2) * columns;
    for i in 0..columns {
        let next = (i + 1) % columns;
        let places = [i, i + 1, i];
        let cap = |a: usize, b: usize, c: usize| Face {
            corners: [a, b, c].into_iter().zip(places).collect(),
            material: 0,
            group: 0,
        };
        shape.faces.push(cap(i, next, top));
        shape.faces.push(cap(last + next, last + i, bottom));
    }
    shape.faces.iter_mut().for_each(|face| face.group = 1);
    shape
}

/// A trefoil: 4,096 triangles, two materials, smooth in one half and not in the other.
pub fn knot() -> Shape {
    let curve = |u: f64| {
        let t = TAU * u;
        [t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos(), -(3.0 * t).sin()]
    };
    let mut shape = tube(128, 16, curve, |_, _| 0.45);
    for (place, face) in shape.faces.iter_mut().enumerate() {
        let half = usize::from(place % 128 < 64);
        (face.material, face.group) = (half, half);
    }
    shape
}

/// Hills: 4,608 triangles, open, texture.
pub fn terrain() -> Shape {
    let mut shape = grid(48, 48, [false, false], |u, v| {
        [4.0 * u - 2.0, 0.3 * ((7.0 * u).sin() + (5.0 * v + u).cos()), 2.0 - 4.0 * v]
    });
    shape.faces.iter_mut().for_each(|face| face.group = 1);
    shape
}

/// A box of 6 times 16 x 16 quads: 3,072 triangles, sides share their edges, each has its own group and material.
pub fn cube() -> Shape {
    let sides: [[[f64; 3]; 3]; 6] = [
        [[-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
        [[1.0, -1.0, -1.0], [-2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
        [[1.0, -1.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]],
        [[-1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]],
        [[-1.0, 1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]],
        [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
    ];
    let mut shape = Shape::default();
    let mut known: HashMap<[u64; 3], usize> = HashMap::new();
    for (number, [from, along, up]) in sides.into_iter().enumerate() {
        // Sixteenths are exact, so that points of two sides are the same number.
        let side =
            grid(16, 16, [false, false], |u, v| std::array::from_fn(|k| from[k] + u * along[k] + v * up[k]));
        let points: Vec<usize> = side
            .points
            .iter()
            .map(|point| {
                let key = point.map(|c| (c + 0.0).to_bits());
                *known.entry(key).or_insert_with(|| {
                    shape.points.push(*point);
                    shape.points.len() - 1
                })
            })
            .collect();
        let places = shape.places.len();
        shape.places.extend(&side.places);
        for face in side.faces {
            let corners = face.corners.iter().map(|(p, t)| (points[*p], places + t)).collect();
            shape.faces.push(Face { corners, material: number % 3, group: number + 1 });
        }
    }
    shape
}

/// A ring with a thread: 3,072 triangles.
pub fn thread() -> Shape {
    let curve = |u: f64| [(TAU * u).cos(), 0.2 * (2.0 * TAU * u).sin(), -(TAU * u).sin()];
    tube(64, 24, curve, |u, v| 0.3 + 0.06 * (TAU * (3.0 * u + 2.0 * v)).sin())
}

/// A ring that is thin at one side: 3,072 triangles.
pub fn crescent() -> Shape {
    let curve = |u: f64| [1.2 * (TAU * u).cos(), (TAU * u).sin(), 0.0];
    tube(96, 16, curve, |u, _| 0.1 + 0.25 * (PI * u).sin().powi(2))
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|c| c * c).sum::<f64>().sqrt();
    a.map(|c| c / length)
}
