//! Polygons by edge table and active edges, and wireframe (slides).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use edgewalk_golden::polygon::{EdgeTable, Grid};
use edgewalk_golden::{HiddenLines, Picture, draw as picture, wireframe};
use edgewalk_host::draw;
use edgewalk_judge::compare::{Comparison, compare};
use edgewalk_machine::Machine;
use edgewalk_model::Waits;
use edgewalk_scene::{Frame, Polygon, Scene, ShadeMode, Vertex};
use std::f64::consts::TAU;

/// The lecture's polygon A to F.
const SAMPLE: [[f64; 2]; 6] = [[2.0, 3.0], [7.0, 1.0], [13.0, 5.0], [13.0, 11.0], [7.0, 7.0], [2.0, 9.0]];

/// Pixels of the picture to one of the lecture's.
const SCALE: f64 = 18.0;

pub(crate) fn polygons() -> anyhow::Result<Exhibit> {
    let sample = SAMPLE.map(|[x, y]| [SCALE * x + 20.0, SCALE * y + 8.0]).to_vec();
    let ring = |radius: f64, sides: u32, step: u32| -> Vec<[f64; 2]> {
        let corner = |k: u32| {
            let (sin, cos) = (TAU * f64::from(k * step % sides) / f64::from(sides)).sin_cos();
            [f64::from(WIDTH) / 2.0 + radius * sin, f64::from(HEIGHT) / 2.0 - radius * cos]
        };
        (0..sides).map(corner).collect()
    };
    let shapes = [vec![sample.clone()], vec![ring(110.0, 7, 3)], vec![ring(110.0, 9, 1), ring(60.0, 4, 1)]];
    let [filled, star, holed] = shapes.clone().map(drawn);
    let by_poly = shapes.iter().map(|shape| by_poly(shape)).collect::<anyhow::Result<Vec<_>>>()?;
    let differ: u64 = by_poly.iter().map(|found| found.counts.coverage_mismatches).sum();
    let error = by_poly.iter().map(|found| found.errors.color.error).fold(0.0, f64::max);
    let scene = Scene::builtin("torus")?;
    let frame = scene.frame(WIDTH, HEIGHT, GUARD, ShadeMode::Gouraud);
    let table = EdgeTable::new(&polygon(vec![sample.clone()]), ShadeMode::Gouraud, Grid::subpixels(8));
    let pixels = |picture: &Picture| picture.coverage.iter().filter(|count| **count > 0).count() as f64;
    Ok(Exhibit {
        name: "polygons",
        title: "Polygons by active edges, and wireframe (S11, S12, S13)",
        cause: "Edges enter at their Ymin, are kept in the order of x, and leave before their Ymax; between an odd crossing and \
                the next is inside. Concave corners, holes and crossings need nothing more, and pixels are those whose centres \
                lie inside: their number is the area but for the border.",
        figures: vec![
            figure("the lecture's polygon: edges in its table", table.edges().len() as f64, 0),
            figure("pixels drawn", pixels(&filled), 0),
            figure("its area, pixels", area(&sample), 1),
            figure("nonagon with a square hole: pixels drawn", pixels(&holed), 0),
            figure("its area, pixels", area(&ring(110.0, 9, 1)) - area(&ring(60.0, 4, 1)), 1),
            figure("seven-pointed star: pixels drawn by the odd-even rule", pixels(&star), 0),
            figure("all three by the machine's POLY: pixels that differ", differ as f64, 0),
            figure("their largest colour error, LSB", error, 3),
        ],
        views: vec![
            View::colors("sample", "The lecture's polygon", filled.rgb),
            View::colors("star", "A star that crosses itself", star.rgb),
            View::colors("hole", "A hole", holed.rgb),
            View::colors(
                "wireframe",
                "Wireframe, hidden lines removed",
                wireframe(&frame, FILL, HiddenLines::Removed).rgb,
            ),
        ],
    })
}

/// Coloured by where its vertices stand.
fn polygon(contours: Vec<Vec<[f64; 2]>>) -> Polygon {
    let vertex = |[x, y]: [f64; 2]| Vertex {
        x,
        y,
        r: x / f64::from(WIDTH),
        g: 1.0 - y / f64::from(HEIGHT),
        b: 0.6,
        ..Vertex::default()
    };
    let contours = contours.into_iter().map(|contour| contour.into_iter().map(vertex).collect()).collect();
    Polygon { contours, after: 0 }
}

fn drawn(contours: Vec<Vec<[f64; 2]>>) -> Picture {
    picture(&Frame { polygons: vec![polygon(contours)], ..Frame::new(WIDTH, HEIGHT) }, FILL)
}

/// The same shapes by a machine with POLY, beside golden.
fn by_poly(contours: &[Vec<[f64; 2]>]) -> anyhow::Result<Comparison> {
    let frame = Frame { polygons: vec![polygon(contours.to_vec())], ..Frame::new(WIDTH, HEIGHT) };
    let keys = |machine: &mut Machine| {
        (machine.width, machine.height, machine.polygon.edges) = (WIDTH, HEIGHT, 16);
    };
    let plan = Machine::default().with(keys).plan()?;
    let drawn = draw::fast(&frame, &plan, Waits::Never)?;
    Ok(compare(&plan, &frame, &draw::golden(&frame, &plan), &drawn))
}

/// Of a polygon that does not cross itself.
fn area(contour: &[[f64; 2]]) -> f64 {
    let next = contour.iter().cycle().skip(1);
    (contour.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0).abs()
}
