//! The lesson: one triangle walked through every section of `docs/machine.md` with its numbers, or one polygon through POLY.
//!
//! ```text
//!  lesson.txt ─> blocks ─┐
//!  corners of a triangle ┴─> formulae, evaluated exactly ─> numbers ─┬─> steps of the page, docs/lesson.md
//!                                           recording of the machine ┴─> the register beside each number
//! ```
//! The numbers come from the corners alone, by the formulae of the text in rationals; nothing of the model is asked for
//! them. The recording says what the machine's registers held: a third reading of the specification.

mod course;
pub mod expression;
pub mod markdown;
pub mod source;
pub mod polygon;
mod teacher;
mod triangle;

pub use triangle::{SCREEN, triangle};

use crate::recording::Recording;
use edgewalk_machine::{Plan, PortVertex};

/// A part of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// Words.
    Text(String),
    /// A number and where it comes from.
    Number {
        /// `name = formula = numbers`.
        formula: String,
        /// Value of the number.
        value: i128,
        /// What holds it.
        check: Option<Check>,
    },
}

/// A number beside what the machine holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// Unit and register in words.
    pub name: String,
    /// Number of the register; `None`: the figure stands in none.
    pub register: Option<usize>,
    /// Place of the field in its token.
    pub field: Option<usize>,
    /// The cycle of the recording.
    pub cycle: u32,
    /// What it must hold, modulo its bits.
    pub expected: u64,
    /// What it holds.
    pub found: u64,
    /// Like `found`, read with its sign.
    pub shown: i128,
}

/// A step of the lesson.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// What it is about.
    pub title: String,
    /// Sections of `docs/machine.md`.
    pub sections: Vec<u32>,
    /// Where to look, a cycle of the recording.
    pub cycle: u32,
    /// What is said.
    pub parts: Vec<Part>,
}

/// The whole of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lesson {
    /// Steps of the lesson: of the channels one is shown.
    pub steps: Vec<Step>,
    /// Every number that has a register, of all channels.
    pub checks: Vec<Check>,
}

/// Whether the lesson goes through all units of the machine: asked before anything is recorded.
///
/// # Errors
/// The key of a unit that it does not go through.
pub fn permitted(plan: &Plan) -> Result<(), String> {
    let of_triangle = !plan.polygon.is_there();
    let left_out = [
        ("blend.kind", "BLEND", of_triangle && plan.blend.is_there()),
        ("shadow.light", "SHADOW", of_triangle && plan.shadow.is_there()),
        ("shade.kind", "the units that shade each pixel", plan.shade.is_there()),
    ];
    left_out.iter().find(|(_, _, there)| *there).map_or(Ok(()), |(key, unit, _)| {
        Err(format!("{key}: the lesson does not go through {unit}; permitted: none"))
    })
}

/// Walks a triangle, alone on an empty screen, through the text; `channel` is the one that is shown.
///
/// # Errors
/// What the text asks for and the recording does not have, in words; a triangle that is culled.
pub fn lesson(
    plan: &Plan,
    corners: &[PortVertex; 3],
    recording: &Recording,
    channel: usize,
) -> Result<Lesson, String> {
    course::Course::new(plan, corners, recording, channel)?.walk()
}
