//! What is best: a figure of a row, and which way it should go.

use anyhow::{Result, anyhow};
use edgewalk_machine::Unknown;
use serde_json::Value;

/// A figure that is to be small or large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Objective {
    /// Name on the command line.
    pub name: &'static str,
    /// Where a row has it.
    pub pointer: &'static str,
    /// Larger is better.
    pub most: bool,
    /// Only synthesis gives it.
    pub synth: bool,
    /// The estimate gives it.
    pub estimate: bool,
    /// Of several inputs the sum counts where [`super::Judge`] sums; else the worst.
    pub sums: bool,
    /// With its unit, in words.
    pub doc: &'static str,
}

const fn least(name: &'static str, pointer: &'static str, doc: &'static str) -> Objective {
    Objective { name, pointer, most: false, synth: false, estimate: false, sums: false, doc }
}

const fn cells(name: &'static str, pointer: &'static str, doc: &'static str) -> Objective {
    Objective { synth: true, ..least(name, pointer, doc) }
}

const fn rate(name: &'static str, pointer: &'static str, doc: &'static str) -> Objective {
    Objective { most: true, ..cells(name, pointer, doc) }
}

const fn estimated(name: &'static str, pointer: &'static str, doc: &'static str) -> Objective {
    Objective { estimate: true, ..least(name, pointer, doc) }
}

/// All of them.
pub const OBJECTIVES: &[Objective] = &[
    Objective { sums: true, ..least("cycles", "/report/cycles/total", "cycles of the frame, simulated") },
    Objective {
        sums: true,
        ..least("bytes", "/report/traffic/bytes", "bytes at the ports of the memories, simulated")
    },
    least("z_error", "/report/comparison/z_error", "largest depth error, LSB, simulated"),
    least("color_error", "/report/comparison/color_error", "largest colour error, LSB, simulated"),
    least(
        "z_bound",
        "/report/comparison/z_bound_for_input",
        "bound of it at pixels inside these triangles, LSB, proved",
    ),
    least(
        "color_bound",
        "/report/comparison/color_bound_for_input",
        "bound of it at pixels inside these triangles, LSB, proved",
    ),
    least(
        "shading_error",
        "/equation/largest",
        "largest distance of a pixel from the shading equation, LSB of 8 bits, simulated",
    ),
    least(
        "shading_mean",
        "/equation/mean",
        "mean distance of a pixel from the shading equation, LSB of 8 bits, simulated",
    ),
    least("word_bits", "/derived/word_bits", "bits of the interpolator's words, all channels"),
    estimated("est_lut4", "/estimate/est_lut4/value", "look-up tables, estimated"),
    estimated("est_ff", "/estimate/est_ff", "flip-flops, as synthesis counts them"),
    estimated("est_carry", "/estimate/est_carry", "cells of the carry chain, as synthesis counts them"),
    estimated("est_ram", "/estimate/est_ram", "memories, as synthesis counts them"),
    estimated("est_cells", "/estimate/est_cells/value", "packed cells of an iCE40, estimated"),
    Objective {
        most: true,
        ..estimated("est_mhz", "/estimate/est_mhz/value", "clock on an HX8K, MHz, estimated")
    },
    cells("lut4", "/synth/cells/lut4", "look-up tables, synthesised"),
    cells("ff", "/synth/cells/ff", "flip-flops, synthesised"),
    cells("carry", "/synth/cells/carry", "cells of the carry chain, synthesised"),
    cells("ram", "/synth/cells/ram", "memories, synthesised"),
    rate("mhz", "/synth/mhz/median", "clock, MHz, placed; median of the seeds"),
    rate("frames_per_s", "/derived/frames_per_s", "frames a second at that clock"),
    rate("mpixels_per_s", "/derived/mpixels_per_s", "million fragments a second at that clock"),
    rate("mtriangles_per_s", "/derived/mtriangles_per_s", "million triangles a second at that clock"),
    rate("mpixels_per_s_per_lut", "/derived/mpixels_per_s_per_lut", "the same a look-up table"),
    rate("mtriangles_per_s_per_lut", "/derived/mtriangles_per_s_per_lut", "the same a look-up table"),
];

/// What is best where nothing is said.
const USUAL: [&str; 4] = ["cycles", "z_error", "color_error", "word_bits"];
const USUAL_WITH_SYNTH: [&str; 4] = ["frames_per_s", "lut4", "z_error", "color_error"];
/// What stands for `color_error` where machines shade differently: each of them is right by an equation of its own.
const ACROSS_SHADINGS: &str = "shading_mean";

impl Objective {
    /// The objectives of these names; the usual ones if there is none. `shadings`: the machines shade differently.
    ///
    /// # Errors
    /// An unknown name, one that comes twice, one that needs synthesis where there is none.
    pub fn list(names: &[String], synth: bool, shadings: bool) -> Result<Vec<Objective>> {
        let usual = if synth { USUAL_WITH_SYNTH } else { USUAL };
        let usual = usual.map(|name| if shadings && name == "color_error" { ACROSS_SHADINGS } else { name });
        let names: Vec<&str> =
            if names.is_empty() { usual.to_vec() } else { names.iter().map(String::as_str).collect() };
        let mut list: Vec<Objective> = Vec::new();
        for name in names {
            let all = OBJECTIVES.iter().map(|objective| objective.name);
            let found = OBJECTIVES
                .iter()
                .find(|objective| objective.name == name)
                .ok_or_else(|| anyhow!("--objective {name}: {}", Unknown::new("figure", name, all)))?;
            if list.contains(found) {
                return Err(anyhow!("--objective {name}: is given twice; give it once"));
            }
            if found.synth && !synth {
                return Err(anyhow!("--objective {name}: only synthesis gives it; add --synth TARGET"));
            }
            list.push(*found);
        }
        Ok(list)
    }

    /// Whether it is a distance from the shading equation, which is worked out only where it is asked for.
    #[must_use]
    pub fn is_of_equation(&self) -> bool {
        self.pointer.starts_with("/equation/")
    }

    /// What an estimated figure of a row may be off by.
    #[must_use]
    pub fn error_of(&self, row: &Value) -> f64 {
        let error = self.pointer.strip_suffix("/value").map(|figure| format!("{figure}/error"));
        error.and_then(|error| row.pointer(&error)?.as_f64()).unwrap_or(0.0)
    }

    /// What a row says of it.
    #[must_use]
    pub fn of(&self, row: &Value) -> Option<f64> {
        row.pointer(self.pointer)?.as_f64()
    }

    /// The worst of several values; none of no value.
    #[must_use]
    pub fn worst(&self, values: Vec<f64>) -> Option<f64> {
        values.into_iter().reduce(|a, b| if self.most { a.min(b) } else { a.max(b) })
    }

    /// The value with its sign such that less is better.
    #[must_use]
    pub fn cost(&self, value: f64) -> f64 {
        if self.most { -value } else { value }
    }
}
