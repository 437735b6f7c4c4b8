//! T-joint (slides): a vertex on an edge of a neighbour that does not share it.

use crate::exhibit::{Exhibit, FILL, HEIGHT, LSB, View, WIDTH, figure};
use anyhow::Result;
use edgewalk_golden::{Fill, Picture, draw};
use edgewalk_scene::{Face, Frame, Material, Mesh, Triangle, Vertex};
use glam::DVec3;

/// Intensity at the ends of the edge, and at the vertex in its middle: a surface that is rounder than the edge.
const ENDS: f64 = 0.35;
const MIDDLE: f64 = 0.85;

/// Edges tried, each with another slant.
const SLANTED: u32 = 100;

pub(crate) fn t_joint() -> Result<Exhibit> {
    let upright = joint([160.0, 20.0], [160.0, 220.0]);
    let picture = draw(&upright, FILL);
    let faults_of = |subpixel_bits: u32| {
        let frames =
            (0..SLANTED).map(f64::from).map(|k| joint([100.3 + 0.37 * k, 20.7], [219.9 - 0.53 * k, 219.1]));
        frames.fold([0; 2], |[missed, twice], frame| {
            let [m, t] = faults(&draw(&frame, Fill::Exact { subpixel_bits }));
            [missed + m, twice + t]
        })
    };
    let told = |bits: u32| {
        let [missed, twice] = faults_of(bits);
        let quantity = format!("{SLANTED} slanted edges, {bits} sub-pixel bits: pixels missed, drawn twice");
        (quantity, format!("{missed}, {twice}"))
    };
    let row = |x: u32| LSB * picture.rgb[(HEIGHT / 2 * WIDTH + x) as usize][0];
    Ok(Exhibit {
        name: "t-joint",
        title: "T-joint (S16)",
        cause: "The right side has a vertex in the middle of the left side's edge. It is lit by its own normal; the left \
                side knows nothing of it and interpolates from end to end: the shading breaks along the edge. If the edge \
                is slanted, the vertex is moved to the sub-pixel grid and no longer lies on it: pixels are missed or drawn \
                twice, the fewer the finer the grid. Neither is a fault of the fill rule; the neighbours must share the vertex. \
                `edgewalk triangles MESH --out FILE` counts T-joints and names the first.",
        figures: vec![
            figure(
                "step of the intensity across the edge in the middle, LSB",
                (row(160) - row(159)).abs(),
                1,
            ),
            figure("step that the vertex itself has, LSB", LSB * (MIDDLE - ENDS), 1),
            told(8),
            told(4),
            told(0),
            figure(
                "T-joints of that mesh, by `edgewalk triangles`",
                meshed(false)?.t_joints().len() as f64,
                0,
            ),
            figure("T-joints if the left side shares the vertex", meshed(true)?.t_joints().len() as f64, 0),
        ],
        views: vec![View::colors("upright", "The edge in the middle", picture.rgb)],
    })
}

/// The upright joint as a mesh; where the vertex is shared the left side is two triangles.
fn meshed(shared: bool) -> Result<Mesh> {
    let positions = [[40.0, 120.0], [280.0, 120.0], [160.0, 20.0], [160.0, 220.0], [160.0, 120.0]];
    let positions = positions.map(|[x, y]: [f64; 2]| DVec3::new(x, y, 0.0)).to_vec();
    let left: &[[u32; 3]] = if shared { &[[0, 2, 4], [0, 4, 3]] } else { &[[0, 2, 3]] };
    let all = left.iter().chain(&[[2, 1, 4], [4, 1, 3]]);
    let faces = all.map(|corners| Face { corners: *corners, material: 0 }).collect();
    Ok(Mesh::new("t-joint", positions, faces, vec![Material::DEFAULT])?)
}

/// A quad cut by the edge from `top` to `bottom`: one triangle on its left, two on its right.
fn joint(top: [f64; 2], bottom: [f64; 2]) -> Frame {
    let vertex = |[x, y]: [f64; 2], v: f64| Vertex { x, y, z: 0.5, r: v, g: v, b: v, ..Vertex::default() };
    let middle = [(top[0] + bottom[0]) / 2.0, (top[1] + bottom[1]) / 2.0];
    let (left, right) = (vertex([40.0, 120.0], ENDS), vertex([280.0, 120.0], ENDS));
    let (top, bottom, middle) = (vertex(top, ENDS), vertex(bottom, ENDS), vertex(middle, MIDDLE));
    Frame {
        triangles: [[left, top, bottom], [top, right, middle], [middle, right, bottom]]
            .map(Triangle)
            .to_vec(),
        ..Frame::new(WIDTH, HEIGHT)
    }
}

/// Pixels between others of a line that were missed, and pixels drawn more than once.
fn faults(picture: &Picture) -> [usize; 2] {
    let lines = picture.coverage.chunks_exact(WIDTH as usize);
    let missed = lines.map(|line| {
        let first = line.iter().position(|count| *count > 0).unwrap_or(0);
        let last = line.iter().rposition(|count| *count > 0).unwrap_or(0);
        line[first..=last].iter().filter(|count| **count == 0).count()
    });
    // A line with nothing on it counts itself once.
    let empty =
        picture.coverage.chunks_exact(WIDTH as usize).filter(|line| line.iter().all(|c| *c == 0)).count();
    [missed.sum::<usize>() - empty, picture.coverage.iter().filter(|count| **count > 1).count()]
}
