//! How many additions lie between the first value of a triangle and one of its fragments.

use std::fmt;

/// Additions behind a fragment's value: every one adds the error of its rounded increment once more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Steps {
    /// n_y: from the first drawn line down the major edge.
    pub lines: u32,
    /// n_x: from the major edge along the span, columns off the screen included.
    pub columns: u32,
}

impl Steps {
    /// N = n_y + n_x.
    #[must_use]
    pub fn total(self) -> u64 {
        u64::from(self.lines) + u64::from(self.columns)
    }
}

/// What bounds the steps: the visible pixels, and the columns beside them that a span is walked over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Screen {
    /// Visible columns W.
    pub width: u32,
    /// Visible lines H.
    pub height: u32,
    /// Columns before the screen that a span may start in: 0 if triangles are clipped to the screen,
    /// 2^G - 1 with a guard band of G bits.
    pub guard_columns: u32,
}

impl Screen {
    /// A screen without guard band: triangles end at its border.
    #[must_use]
    pub const fn clipped(width: u32, height: u32) -> Screen {
        Screen { width, height, guard_columns: 0 }
    }

    /// The most steps of a fragment: from line 0 to H - 1 (setup starts at the first visible line) and from the
    /// outermost guard column to W - 1. A span to the left is no longer: it starts at column 2^G - 2 at the most
    /// and ends at 0.
    #[must_use]
    pub const fn max_steps(self) -> Steps {
        Steps {
            lines: self.height.saturating_sub(1),
            columns: self.width.saturating_sub(1).saturating_add(self.guard_columns),
        }
    }
}

impl fmt::Display for Screen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let most = self.max_steps();
        write!(f, "{}x{}: {} lines + ", self.width, self.height, most.lines)?;
        if self.guard_columns > 0 {
            write!(f, "{} guard columns + ", self.guard_columns)?;
        }
        write!(f, "{} columns = {} steps", self.width.saturating_sub(1), most.total())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_steps_is_explained() {
        let default = Screen { width: 640, height: 480, guard_columns: (1 << 13) - 1 };
        assert_eq!(default.to_string(), "640x480: 479 lines + 8191 guard columns + 639 columns = 9309 steps");
        assert_eq!(Screen::clipped(640, 480).to_string(), "640x480: 479 lines + 639 columns = 1118 steps");
        assert_eq!(Screen::clipped(0, 0).max_steps(), Steps::default());
    }
}
