//! The book's fill beside the exact one: pixels that two triangles of one surface draw (ch. 7.5).

use crate::exhibit::{Exhibit, FILL, HEIGHT, View, WIDTH, figure};
use edgewalk_golden::{Fill, Picture, draw};
use edgewalk_scene::{Blending, Frame, Triangle, Vertex};
use std::f64::consts::TAU;

/// Triangles around the middle.
const SIDES: u32 = 11;

pub(crate) fn textbook_fill() -> Exhibit {
    let [exact, textbook] = [FILL, Fill::Textbook].map(|fill| draw(&fan(), fill));
    let pixels = |picture: &Picture, least: u32| {
        picture.coverage.iter().filter(|count| **count >= least).count() as f64
    };
    Exhibit {
        name: "textbook-fill",
        title: "The book's fill beside the exact one",
        cause: "The listing draws from Trunc(X_start) to Trunc(X_end), both ends and the knee line twice: triangles that share an \
                edge share its pixels, too. A fan of one colour that transmits half of the light shows each of them as a darker seam. \
                Half-open spans draw every pixel once.",
        figures: vec![
            figure("exact: pixels drawn", pixels(&exact, 1), 0),
            figure("exact: of them more than once", pixels(&exact, 2), 0),
            figure("textbook: pixels drawn", pixels(&textbook, 1), 0),
            figure("textbook: of them more than once", pixels(&textbook, 2), 0),
        ],
        views: vec![
            View::colors("exact", "Exact fill", exact.rgb),
            View::colors("textbook", "Textbook fill", textbook.rgb),
        ],
    }
}

/// A fan of whole vertices that is mixed with a white screen.
fn fan() -> Frame {
    let vertex =
        |x: f64, y: f64| Vertex { x, y, z: 0.5, r: 0.0, g: 0.3, b: 0.6, kt: 0.5, ..Vertex::default() };
    let [x, y] = [WIDTH, HEIGHT].map(|side| f64::from(side / 2));
    let rim = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
        vertex((x + 110.0 * sin).round(), (y - 110.0 * cos).round())
    };
    let triangles = (0..SIDES).map(|k| Triangle([vertex(x, y), rim(k), rim((k + 1) % SIDES)])).collect();
    Frame {
        triangles,
        depth: None,
        depth_write: false,
        blend: Blending::Mix,
        clear: [1.0; 3],
        ..Frame::new(WIDTH, HEIGHT)
    }
}
