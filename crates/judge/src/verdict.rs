//! What a check found, and when that is a pass.

use anyhow::{Result, anyhow};
use edgewalk_machine::{EdgeKind, Machine, NoBound};
use serde::{Serialize, Serializer};

/// Errors and bounds are computed in f64, and a bound can be reached. An error exceeds it by more than this, LSB.
pub const ROUNDING: f64 = 1e-9;

/// Whether an error lies within its bound, both in LSB. Not a number never does.
#[must_use]
pub fn within(error: f64, bound: f64) -> bool {
    error <= bound + ROUNDING
}

/// Where the walk of the edges is exact.
pub const EVERY_PIXEL: &str = "every pixel";

/// The pixels for which the bounds of a machine hold: a slope edge also draws pixels outside the triangle.
#[must_use]
pub fn holds(machine: &Machine) -> &'static str {
    match machine.edge_kind {
        EdgeKind::Exact => EVERY_PIXEL,
        EdgeKind::Slope => "pixels inside the triangle",
    }
}

/// Why there is no bound, as text in a report.
pub(crate) fn in_words<S: Serializer>(why: &Option<NoBound>, serializer: S) -> Result<S::Ok, S::Error> {
    why.map(|why| why.to_string()).serialize(serializer)
}

/// What a command found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All that was asked for was done, all that was compared agrees.
    Pass,
    /// Something compared differs.
    Mismatch,
    /// A check compared nothing at all.
    Vacuous,
    /// A picture with a depth test at each covered pixel whose depths are too near to decide it: nothing was compared.
    Open,
}

impl Verdict {
    /// The verdict of a comparison: `expected` things should have been checked, `checked` were, `wrong` of them differ.
    pub fn of(checked: u64, expected: u64, wrong: u64) -> Self {
        match (checked, wrong) {
            (0, 0) => Verdict::Vacuous,
            (n, 0) if n == expected => Verdict::Pass,
            _ => Verdict::Mismatch,
        }
    }

    /// The verdict of a picture in which `covered` pixels were drawn.
    pub fn drew(covered: u64) -> Self {
        Verdict::of(covered, covered, 0)
    }

    /// The verdict on a picture of these triangles and polygons, or the reason why there was nothing to judge.
    ///
    /// # Errors
    /// No pixel is covered.
    pub fn or_nothing(self, input: &str, primitives: u64, (width, height): (u32, u32)) -> Result<Self> {
        if self != Verdict::Vacuous {
            return Ok(self);
        }
        let why = match primitives {
            0 => "it has no triangle in view".to_owned(),
            n => {
                format!("none of its {n} triangles or polygons covers a pixel of the {width}x{height} screen")
            }
        };
        Err(anyhow!("{input}: nothing was drawn: {why}"))
    }

    /// The word in reports.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Mismatch => "mismatch",
            Verdict::Vacuous => "vacuous",
            Verdict::Open => "open",
        }
    }

    /// The worse of two.
    pub fn and(self, other: Verdict) -> Self {
        match (self, other) {
            (Verdict::Pass, v) | (v, Verdict::Pass) => v,
            (Verdict::Mismatch, _) | (_, Verdict::Mismatch) => Verdict::Mismatch,
            (Verdict::Open, _) | (_, Verdict::Open) => Verdict::Open,
            _ => Verdict::Vacuous,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict::{self, Mismatch, Open, Pass, Vacuous};

    #[test]
    fn what_was_not_checked_is_no_pass() {
        let table = [
            ((0, 0, 0), Vacuous),
            ((0, 7, 0), Vacuous),
            ((0, 0, 1), Mismatch),
            ((7, 7, 0), Pass),
            ((6, 7, 0), Mismatch),
            ((8, 7, 0), Mismatch),
            ((7, 7, 1), Mismatch),
        ];
        for ((checked, expected, wrong), verdict) in table {
            assert_eq!(Verdict::of(checked, expected, wrong), verdict, "{checked} {expected} {wrong}");
        }
        let worse = [
            (Pass, Pass, Pass),
            (Pass, Vacuous, Vacuous),
            (Pass, Mismatch, Mismatch),
            (Vacuous, Mismatch, Mismatch),
            (Open, Pass, Open),
            (Open, Mismatch, Mismatch),
        ];
        for (a, b, both) in worse {
            assert_eq!((a.and(b), b.and(a)), (both, both));
        }
    }

    #[test]
    fn nothing_drawn_is_named() {
        assert_eq!(Verdict::drew(3).or_nothing("a.tri", 1, (8, 8)).ok(), Some(Pass));
        for (primitives, why) in [(0, "no triangle in view"), (2, "none of its 2 triangles")] {
            let error = Verdict::drew(0).or_nothing("a.tri", primitives, (8, 8)).map_err(|e| e.to_string());
            assert!(error.as_ref().is_err_and(|e| e.contains("a.tri") && e.contains(why)), "{error:?}");
        }
    }
}
