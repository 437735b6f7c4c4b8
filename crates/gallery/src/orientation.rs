//! Orientation dependence of a quad (B): bilinear interpolation along edges, then along the line, turns with the screen.

use crate::exhibit::{Exhibit, FILL, HEIGHT, LSB, View, WIDTH, figure};
use crate::plot::{Series, plot};
use edgewalk_golden::{Picture, draw};
use edgewalk_scene::{Frame, Polygon, Vertex};

/// Side of the square, px.
const SIDE: f64 = 150.0;

pub(crate) fn orientation() -> Exhibit {
    let angles = (0..=90).map(f64::from);
    let points: Vec<(f64, f64)> = angles.map(|angle| (angle, middle(&square(angle)))).collect();
    let (low, high) = points.iter().fold((f64::MAX, f64::MIN), |(l, h), (_, v)| (l.min(*v), h.max(*v)));
    Exhibit {
        name: "orientation",
        title: "Orientation dependence of a quad (S15, S16)",
        cause: "A square with corners white, black, white, black. Values run linearly along the edges, then along the scan \
                line (l_a, l_b, l_p of B), so which corners a pixel hears of depends on how the square is turned. Cut into \
                triangles the picture turns with the square, but shows the diagonal.",
        figures: vec![
            figure("middle of the square at 0 degrees, LSB", points[0].1, 1),
            figure("at 45 degrees, LSB", points[45].1, 1),
            figure("range while it turns, LSB", high - low, 1),
        ],
        views: vec![
            View::colors("0", "At 0 degrees", square(0.0).rgb),
            View::colors("30", "At 30 degrees", square(30.0).rgb),
            View::colors("45", "At 45 degrees", square(45.0).rgb),
            View::drawing(
                "turning",
                "The pixel in the middle while the square turns",
                plot("degrees", "LSB of 8 bits", &[Series { label: "middle", points }]),
            ),
        ],
    }
}

fn square(degrees: f64) -> Picture {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let corner = |(x, y, v): (f64, f64, f64)| Vertex {
        x: f64::from(WIDTH / 2) + 0.5 + SIDE / 2.0 * (x * cos - y * sin),
        y: f64::from(HEIGHT / 2) + 0.5 + SIDE / 2.0 * (x * sin + y * cos),
        z: 0.5,
        r: v,
        g: v,
        b: v,
        ..Vertex::default()
    };
    let contour =
        [(-1.0, -1.0, 1.0), (1.0, -1.0, 0.0), (1.0, 1.0, 1.0), (-1.0, 1.0, 0.0)].map(corner).to_vec();
    let frame = Frame {
        clear: [0.2, 0.25, 0.4],
        polygons: vec![Polygon { contours: vec![contour], after: 0 }],
        ..Frame::new(WIDTH, HEIGHT)
    };
    draw(&frame, FILL)
}

fn middle(picture: &Picture) -> f64 {
    LSB * picture.rgb[(HEIGHT / 2 * WIDTH + WIDTH / 2) as usize][0]
}
