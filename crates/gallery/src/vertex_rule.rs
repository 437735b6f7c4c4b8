//! What becomes of the odd-even rule where an edge's last line counts, too (the slides: the problem at the vertices).

use crate::exhibit::{Exhibit, HEIGHT, View, WIDTH, figure};

/// The lecture's polygon A to F.
const SAMPLE: [[i32; 2]; 6] = [[2, 3], [7, 1], [13, 5], [13, 11], [7, 7], [2, 9]];

/// Columns and lines of the lecture's drawing, and pixels of the picture to one of its own.
const SIZE: [i32; 2] = [16, 12];
const SCALE: u32 = 20;

pub(crate) fn vertex_rule() -> Exhibit {
    let (right, wrong) = (filled(false), filled(true));
    let odd = (0..SIZE[1]).filter(|y| crossings(*y, true).len() % 2 == 1);
    let lines: Vec<String> = odd.map(|line| line.to_string()).collect();
    let differ = right.iter().zip(&wrong).filter(|(a, b)| a != b).count();
    let count = |pixels: &[bool]| pixels.iter().filter(|inside| **inside).count() as f64;
    let picture = |pixels: &[bool], other: &[bool]| {
        let place = |at: u32| (at / WIDTH / SCALE * SIZE[0] as u32 + at % WIDTH / SCALE) as usize;
        (0..WIDTH * HEIGHT)
            .map(|at| match (pixels[place(at)], other[place(at)]) {
                (true, true) => [0.30, 0.55, 0.75],
                (true, false) => [0.85, 0.37, 0.0],
                (false, true) => [0.95, 0.75, 0.55],
                (false, false) => [1.0, 1.0, 1.0],
            })
            .collect()
    };
    Exhibit {
        name: "vertex-rule",
        title: "The odd-even rule at vertices (S11)",
        cause: "Where an edge is counted on its line Ymax, a vertex at which one edge ends and the next begins is two crossings. \
                So lines 3 and 5 have an odd number of crossings. On line 3 at A there are three in all: the pixels are filled up to A, not filled where they should be, and filled behind \
                the last crossing to the end of the line. Where both edges end, or both begin, as at F or B, two crossings are right. Shorten each \
                edge by its last line and all vertices are.",
        figures: vec![
            ("lines with an odd number of crossings, Ymax counted".to_owned(), lines.join(" ")),
            figure("pixels filled, Ymin counted and Ymax not", count(&right), 0),
            figure("pixels filled, both counted", count(&wrong), 0),
            figure("pixels that differ", differ as f64, 0),
        ],
        views: vec![
            View::colors("right", "Ymin counted, Ymax not", picture(&right, &right)),
            View::colors(
                "wrong",
                "Both counted: orange is filled and should not be, pale should be and is not",
                picture(&wrong, &right),
            ),
        ],
    }
}

/// Where edges cross a line of pixels at whole coordinates, from left to right.
fn crossings(y: i32, last_line: bool) -> Vec<f64> {
    let next = SAMPLE.iter().cycle().skip(1);
    let mut all: Vec<f64> = SAMPLE
        .iter()
        .zip(next)
        .filter_map(|(a, b)| {
            let [up, down] = if a[1] < b[1] { [a, b] } else { [b, a] };
            let counts = up[1] <= y && (y < down[1] || last_line && y == down[1]) && up[1] < down[1];
            let part = f64::from(y - up[1]) / f64::from(down[1] - up[1]);
            counts.then(|| f64::from(up[0]) + part * f64::from(down[0] - up[0]))
        })
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Pixels from an odd crossing, rounded up, to the next, rounded down: to the end of the line where there is none.
fn filled(last_line: bool) -> Vec<bool> {
    let mut pixels = Vec::new();
    for y in 0..SIZE[1] {
        let crossings = crossings(y, last_line);
        let spans = crossings.chunks(2).map(|pair| pair[0]..=pair.get(1).copied().unwrap_or(f64::INFINITY));
        let spans: Vec<_> = spans.collect();
        pixels.extend((0..SIZE[0]).map(|x| spans.iter().any(|span| span.contains(&f64::from(x)))));
    }
    pixels
}
