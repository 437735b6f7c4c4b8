//! The worked example of the notes: Gouraud shading by hand.

use crate::exhibit::{Exhibit, FILL, HEIGHT, View, WIDTH, figure};
use crate::plot::{Series, plot};
use anyhow::{Result, anyhow};
use edgewalk_explain::active_edges;
use edgewalk_golden::draw;
use edgewalk_machine::Machine;
use edgewalk_scene::{Frame, Polygon, Triangle, Vertex};

/// x, y and intensity: the edges cross line 15 at x = 10.5 and x = 20.
const CORNERS: [[f64; 3]; 3] = [[15.25, 10.0, 0.9], [5.75, 20.0, 0.2], [34.25, 30.0, 0.3]];

pub(crate) fn worked_example() -> Result<Exhibit> {
    // Pixels stand at whole coordinates in the example, at halves here.
    let vertex = |[x, y, v]: [f64; 3]| Vertex {
        x: x + 0.5,
        y: y + 0.5,
        z: 0.5,
        r: v,
        g: v,
        b: v,
        ..Vertex::default()
    };
    let frame = Frame { triangles: vec![Triangle(CORNERS.map(vertex))], ..Frame::new(WIDTH, HEIGHT) };
    let picture = draw(&frame, FILL);
    let at = |x: u32, y: u32| picture.rgb[(y * WIDTH + x) as usize][0];
    let step = |a: usize, b: usize| (CORNERS[b][2] - CORNERS[a][2]) / (CORNERS[b][1] - CORNERS[a][1]);
    let ends = [CORNERS[0][2] + 5.0 * step(0, 1), CORNERS[0][2] + 5.0 * step(0, 2)];
    let drawn: Vec<(f64, f64)> = (11..20).map(|x| (f64::from(x), at(x, 15))).collect();
    let by_hand = (0..=10).map(|k| (10.5 + f64::from(k), ends[0] + 0.02 * f64::from(k))).collect();
    let slope = at(12, 15) - at(11, 15);
    let polygon = Polygon { contours: vec![CORNERS.map(vertex).to_vec()], after: 0 };
    let machine = Machine::preset("polygon").ok_or_else(|| anyhow!("no preset is called polygon"))?;
    let plan = machine.with(|machine| (machine.width, machine.height) = (WIDTH, HEIGHT)).plan()?;
    let walked = Frame { polygons: vec![polygon], ..Frame::new(WIDTH, HEIGHT) };
    Ok(Exhibit {
        name: "worked-example",
        title: "The worked example (S17)",
        cause: "Intensities 0.9, 0.2, 0.3 at the lines 10, 20, 30. On line 15 the edges have 0.55 at x = 10.5 and 0.75 at \
                x = 20. The lecture takes 20 - 10.5 for ten steps of 0.02; they are 9.5, and the step is 0.2 / 9.5. It also \
                prints 0.15 for the last value: a misprint, as it interpolates to 0.75. A machine with POLY keeps the x of each active \
                edge as C - R/M.",
        figures: vec![
            figure("step a line from 10 to 20", step(0, 1), 2),
            figure("step a line from 10 to 30", step(0, 2), 2),
            figure("step a line from 20 to 30", step(1, 2), 2),
            figure("line 15, left end", ends[0], 2),
            figure("line 15, right end", ends[1], 2),
            figure("step a pixel, in ten steps", (ends[1] - ends[0]) / 10.0, 3),
            figure("step a pixel, as drawn", slope, 6),
        ],
        views: vec![
            View::drawing(
                "line-15",
                "Line 15",
                plot(
                    "x",
                    "intensity",
                    &[
                        Series { label: "drawn", points: drawn },
                        Series { label: "the lecture", points: by_hand },
                    ],
                ),
            ),
            View::text(
                "active-edges",
                "The active edges of the machine on line 15, as `edgewalk explain` prints them:",
                active_edges(&walked, &plan, (12, 15)),
            ),
        ],
    })
}
