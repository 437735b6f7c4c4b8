//! A quadratic over the screen.

use crate::fast_phong::differences::Differences;
use glam::DVec2;

/// `T5 x² + T4 xy + T3 y² + T2 x + T1 y + T0`, x and y in pixels from `origin`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadratic {
    /// Where x and y are 0, pixels.
    pub origin: DVec2,
    /// T0 to T5, in the order and with the names of BW86.
    pub t: [f64; 6],
}

impl Quadratic {
    /// The value at a point of the screen, pixels.
    pub fn at(&self, point: DVec2) -> f64 {
        let (DVec2 { x, y }, [t0, t1, t2, t3, t4, t5]) = (point - self.origin, self.t);
        (t5 * x + t4 * y + t2) * x + (t3 * y + t1) * y + t0
    }

    /// What the incremental algorithm starts with at a point of the screen, pixels.
    pub fn differences(&self, point: DVec2) -> Differences<f64> {
        let (DVec2 { x, y }, [_, t1, t2, t3, t4, t5]) = (point - self.origin, self.t);
        Differences {
            value: self.at(point),
            right: t5 * (2.0 * x + 1.0) + t4 * y + t2,
            down: t3 * (2.0 * y + 1.0) + t4 * x + t1,
            right_right: 2.0 * t5,
            right_down: t4,
            down_down: 2.0 * t3,
        }
    }
}
