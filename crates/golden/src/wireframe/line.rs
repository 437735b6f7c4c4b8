//! A line's pixels: one in each column, or in each row of a steep one (DDA).
//!
//! ```text
//!        . . # #       in each column whose centre lies in [from, to), the pixel whose centre is nearest to the line there,
//!        . # . .       of two the upper one (of a steep line, in each row, the left one); neighbouring pixels touch at
//!        # . . .       least at a corner
//! ```
//! Half-open along the main axis: lines that follow each other draw no pixel twice, so blending shows no joint, and depth and colour stay
//! between those of the ends. A line that has no centre along it has no pixel.
//!
//! A classical DDA adds 1/m and rounds; here each point is an exact quotient, and the same whichever end comes first.
//!
//! Units: those of [`Grid`], coordinates below 2^29, differences below 2^30, products below 2^60.

use crate::polygon::Grid;
use edgewalk_scene::Vertex;

/// Calls `draw` with column, row and what each end weighs there, for every pixel of a line on a screen of `width` by
/// `height` pixels. The ends are snapped first.
pub(super) fn pixels(
    ends: [&Vertex; 2],
    grid: Grid,
    (width, height): (u32, u32),
    mut draw: impl FnMut(u32, u32, [f64; 2]),
) {
    let [a, b] = ends.map(|end| grid.place(end));
    let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
    // Along the line's main axis, and across it.
    let (along, across) = if steep { (1, 0) } else { (0, 1) };
    let sides = [width, height];
    let reversed = a[along] > b[along];
    let [from, to] = if reversed { [b, a] } else { [a, b] };
    let length = to[along] - from[along];
    let first = grid.first_pixel(from[along]).max(0);
    let end = grid.first_pixel(to[along]).min(i64::from(sides[along]));
    for pixel in first..end {
        let way = grid.centre(pixel) - from[along];
        let other = grid.nearest_pixel(from[across] * length + way * (to[across] - from[across]), length);
        if (0..i64::from(sides[across])).contains(&other) {
            let far = way as f64 / length as f64;
            let weights = if reversed { [far, 1.0 - far] } else { [1.0 - far, far] };
            let (x, y) = if steep { (other, pixel) } else { (pixel, other) };
            // On the screen, as checked.
            draw(x as u32, y as u32, weights);
        }
    }
}
