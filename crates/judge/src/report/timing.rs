//! Where the cycles of a picture went.

use super::drawn::counts;
use crate::occupancy::ratio;
use edgewalk_host::raster::{Cycles, Raster};
use edgewalk_machine::Plan;
use edgewalk_model::{Activity, Waits};
use serde::Serialize;
use std::fmt::Write as _;

/// The cycles, each with its cause.
#[derive(Clone, Serialize)]
pub struct Timing {
    /// All of them, counted apart from their causes.
    pub total: u64,
    #[serde(serialize_with = "counts")]
    by_cause: Vec<(&'static str, u64)>,
    pixels_per_clock: f64,
    /// How the fast engine came to them.
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<String>,
    /// How the memory made the machine wait.
    #[serde(skip_serializing_if = "Option::is_none")]
    stalls: Option<String>,
    /// Cycles of each light's map, drawn before the picture and not counted in it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    maps: Vec<u64>,
    /// Cycles of each pass, where there is more than one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    passes: Vec<u64>,
}

impl Timing {
    /// Of a picture with so many fragments.
    #[must_use]
    pub fn new(machine: &Plan, cycles: &Cycles, waits: Waits, fragments: u64) -> Self {
        Timing {
            total: cycles.total,
            by_cause: Activity::of(machine).map(|cause| (cause.name(), cycles.spent(cause))).collect(),
            pixels_per_clock: ratio(fragments, cycles.total),
            path: cycles.path.map(|path| path.to_string()),
            stalls: (waits != Waits::Never).then(|| waits.to_string()),
            maps: Vec::new(),
            passes: Vec::new(),
        }
    }

    /// With the cycles of the maps and passes of what was drawn.
    #[must_use]
    pub fn with_parts(self, drawn: &Raster) -> Self {
        let maps = drawn.lights.iter().map(|light| light.cycles.total).collect();
        Timing { maps, passes: drawn.passes.iter().map(|pass| pass.total).collect(), ..self }
    }

    /// The picture has so many fragments.
    pub(super) fn of_fragments(&mut self, fragments: u64) {
        self.pixels_per_clock = ratio(fragments, self.total);
    }

    /// As lines of text.
    pub(super) fn lines(&self) -> String {
        let total = self.total;
        let path = self.path.as_ref().map_or_else(String::new, |path| format!(" ({path})"));
        let stalls =
            self.stalls.as_ref().map_or_else(String::new, |waits| format!("memory stalls {waits}\n"));
        let mut t = format!("{stalls}cycles {total}{path}, {:.4} pixels a clock\n", self.pixels_per_clock);
        // Writing to a string cannot fail.
        for (name, spent) in &self.by_cause {
            _ = writeln!(t, "    {name:<10} {spent:>12}  {:>5.1} %", 100.0 * ratio(*spent, total));
        }
        for (place, pass) in self.passes.iter().enumerate() {
            _ = writeln!(t, "    pass {place:<5} {pass:>12}");
        }
        for (place, map) in self.maps.iter().enumerate() {
            _ = writeln!(t, "    map {place:<6} {map:>12}  before, not among these");
        }
        let sum: u64 = self.by_cause.iter().map(|(_, spent)| spent).sum();
        _ = writeln!(t, "    {:<10} {sum:>12}  of {total} cycles", "sum");
        t
    }
}
