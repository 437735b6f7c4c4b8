//! Which of two triangles has a pixel whose centre lies on the edge between them.

use super::Picture;
use edgewalk_golden::snap;
use edgewalk_scene::{Frame, Polygon, Vertex};
use std::fmt;

/// The rule of coverage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Centres on left and top edges are inside.
    TopLeft,
    /// Centres on right and top edges are inside.
    TopRight,
    /// Centres on left and bottom edges are inside.
    BottomLeft,
    /// Centres on right and bottom edges are inside.
    BottomRight,
    /// The listing of ch. 7.9: lines and columns from the rounded start to the rounded end, both inside.
    Textbook,
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Rule::TopLeft => "top-left",
            Rule::TopRight => "top-right",
            Rule::BottomLeft => "bottom-left",
            Rule::BottomRight => "bottom-right",
            Rule::Textbook => "textbook",
        })
    }
}

impl Rule {
    /// Whether columns and lines are counted from the other side, so that golden's rule of left and top becomes this one.
    fn mirrors(self) -> [bool; 2] {
        match self {
            Rule::TopLeft | Rule::Textbook => [false, false],
            Rule::TopRight => [true, false],
            Rule::BottomLeft => [false, true],
            Rule::BottomRight => [true, true],
        }
    }

    /// Whether golden draws the frame as it is.
    #[must_use]
    pub fn is_plain(self) -> bool {
        self.mirrors() == [false, false]
    }

    /// The frame as golden draws it by this rule: vertices snapped to sub-pixels, then counted from the other side.
    #[must_use]
    pub fn mirrored(self, frame: &Frame, subpixel_bits: u32) -> Frame {
        let mut frame = frame.clone();
        let unit = f64::from(1u32 << subpixel_bits);
        let [columns, lines] = self.mirrors();
        let (width, height) = (f64::from(frame.width), f64::from(frame.height));
        let turn = |vertex: &mut Vertex| {
            if columns {
                vertex.x = width - snap(vertex.x, subpixel_bits) as f64 / unit;
            }
            if lines {
                vertex.y = height - snap(vertex.y, subpixel_bits) as f64 / unit;
            }
        };
        let of_polygon = |polygon: &mut Polygon| polygon.contours.iter_mut().flatten().for_each(turn);
        frame.triangles.iter_mut().flat_map(|triangle| &mut triangle.0).for_each(turn);
        frame.polygons.iter_mut().for_each(of_polygon);
        frame
    }

    /// The arrays of the screen, as the mirrored frame has them.
    #[must_use]
    pub fn turned(self, mut picture: Picture) -> Picture {
        let size = (picture.width as usize, picture.height as usize);
        let Picture { coverage, id, z, rgb, lit, .. } = &mut picture;
        coverage.iter_mut().for_each(|values| self.turn(size, values));
        id.iter_mut().for_each(|values| self.turn(size, values));
        z.iter_mut().for_each(|values| self.turn(size, values));
        rgb.iter_mut().for_each(|values| self.turn(size, values));
        lit.iter_mut().for_each(|values| self.turn(size, values));
        picture
    }

    /// A place of the mirrored frame, as the screen has it.
    #[must_use]
    pub fn place(self, (width, height): (u32, u32), (x, y): (u32, u32)) -> (u32, u32) {
        let [columns, lines] = self.mirrors();
        (if columns { width - 1 - x } else { x }, if lines { height - 1 - y } else { y })
    }

    /// Values by pixel, from the mirrored frame to the screen or back.
    pub(super) fn turn<T>(self, (width, height): (usize, usize), values: &mut [T]) {
        let [columns, lines] = self.mirrors();
        if columns {
            values.chunks_exact_mut(width).for_each(<[T]>::reverse);
        }
        if lines {
            for y in 0..height / 2 {
                let (above, below) = values.split_at_mut((height - 1 - y) * width);
                above[y * width..(y + 1) * width].swap_with_slice(&mut below[..width]);
            }
        }
    }
}
