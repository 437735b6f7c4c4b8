//! A quadratic by second differences: no multiplication, two additions a pixel.
//!
//! ```text
//!     line start ── value, right, down ──>  the next line's start: 3 additions down, 3 for each column to either side
//!         │
//!         └ copy ── value, right ─────────>  the next pixel: 2 additions
//! ```
//! Where the walk goes down from another column than it came to, the difference down has to go along as well; along a
//! span nobody reads it. Generic in the number, so that a test can count the additions.

use std::ops::{AddAssign, SubAssign};

/// A quadratic f at a pixel, and its differences there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Differences<T> {
    /// f(x, y).
    pub value: T,
    /// f(x+1, y) - f(x, y).
    pub right: T,
    /// f(x, y+1) - f(x, y).
    pub down: T,
    /// By how much `right` grows a column: 2 T5.
    pub right_right: T,
    /// By how much `right` grows a line and `down` a column: T4.
    pub right_down: T,
    /// By how much `down` grows a line: 2 T3.
    pub down_down: T,
}

impl<T: Copy + AddAssign + SubAssign> Differences<T> {
    /// To the next pixel of a span: 2 additions; `down` is left behind.
    fn step_along(&mut self) {
        self.value += self.right;
        self.right += self.right_right;
    }

    fn step_right(&mut self) {
        self.step_along();
        self.down += self.right_down;
    }

    fn step_left(&mut self) {
        self.right -= self.right_right;
        self.value -= self.right;
        self.down -= self.right_down;
    }

    fn step_down(&mut self) {
        self.value += self.down;
        self.down += self.down_down;
        self.right += self.right_down;
    }
}

/// A quadratic followed over the pixels of a triangle, line by line from the top, each span from the left.
#[derive(Debug, Clone, Copy)]
pub struct Walk<T> {
    /// Where the span began.
    line: Differences<T>,
    line_at: (u32, u32),
    /// At the pixel.
    pixel: Differences<T>,
    pixel_x: u32,
}

impl<T: Copy + AddAssign + SubAssign> Walk<T> {
    /// Starts at column and row `at` with the quadratic there.
    pub fn new(start: Differences<T>, at: (u32, u32)) -> Self {
        Self { line: start, line_at: at, pixel: start, pixel_x: at.0 }
    }

    /// The value at the pixel.
    pub fn value(&self) -> T {
        self.pixel.value
    }

    /// To column `x`, row `y`, which is not above the last one.
    pub fn step(&mut self, x: u32, y: u32) {
        if y != self.line_at.1 || x < self.pixel_x {
            self.start_span(x, y);
        }
        while self.pixel_x < x {
            self.pixel.step_along();
            self.pixel_x += 1;
        }
    }

    fn start_span(&mut self, x: u32, y: u32) {
        for _ in self.line_at.1..y {
            self.line.step_down();
        }
        for _ in self.line_at.0..x {
            self.line.step_right();
        }
        for _ in x..self.line_at.0 {
            self.line.step_left();
        }
        self.line_at = (x, y);
        (self.pixel, self.pixel_x) = (self.line, x);
    }
}
