//! The ends of a map that the machine draws, beside those of its screen: what lies on one of them and not on the other.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::Plan;

/// Dots and lines of pixels around the ends of map and screen; which of them are drawn is the pass's to say.
pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    let size = f64::from(machine.shadow.size);
    let (w, h) = pen.size();
    let ends = [(w, h), (size, size)];
    let dot = |x: f64, y: f64| pen.dot(x, y, 0.4);
    let row = |x: f64, y: f64| flat(&pen, [x, y], [6.0, 1.5]);
    let column = |x: f64, y: f64| flat(&pen, [x, y], [1.5, 6.0]);
    vec![
        case("the_last_pixel_of_screen_and_map", ends.map(|(x, y)| dot(x - 1.0, y - 1.0))),
        case("beside_each_end", {
            ends.into_iter().flat_map(|(x, y)| {
                [dot(x, 0.0), dot(0.0, y), dot(x, y), dot(x - 1.0, 0.0), dot(0.0, y - 1.0)]
            })
        }),
        case("across_each_end", {
            ends.into_iter()
                .flat_map(|(x, y)| [row(x - 3.0, 0.0), column(0.0, y - 3.0), row(x - 3.0, y - 1.0)])
        }),
        case("across_the_first_column_and_line", [row(-3.0, 0.0), column(0.0, -3.0)]),
        // Spans to the left begin beyond the end, and are stepped over.
        case("leftward_from_beyond_each_end", {
            ends.map(|(x, y)| {
                pen.shaded([(x + 3.0, y - 2.0), (x - 4.0, y - 0.5), (x + 3.0, y)], [0.2, 0.5, 0.9])
            })
        }),
        case("one_pixel_after_the_other", [0.9, 0.5, 0.5, 0.1].map(|z| pen.dot(size - 1.0, size - 1.0, z))),
    ]
}

/// A right-angled triangle with that corner and these legs, its depth from one end of the range to the other.
fn flat(pen: &Pen, [x, y]: [f64; 2], [wide, high]: [f64; 2]) -> Triangle {
    pen.shaded([(x, y), (x + wide, y), (x, y + high)], [0.0, 1.0, 0.5])
}
