//! What DITHER makes of a pixel's colour.

use edgewalk_golden::dither::{Dither, pattern};
use edgewalk_machine::Plan;
use edgewalk_scene::Frame;
use serde::Serialize;

/// The pattern at the pixel, and the colour before and behind it.
#[derive(Serialize)]
pub(crate) struct Dithered {
    /// 0 to 15.
    pattern: u32,
    /// As PIXEL gives them, LSB.
    before: [u64; 3],
    /// Steps of the bits that are left.
    after: [u64; 3],
    /// The largest step, which stands for 1.
    most: u64,
}

/// Of a machine that rounds, where a walk ends in these outputs and nothing else changes colours.
pub(crate) fn dithered(
    machine: &Plan,
    frame: &Frame,
    output: &[i64],
    (x, y): (u32, u32),
) -> Option<Dithered> {
    if !machine.dither.rounds() || frame.shading.is_some() || !frame.shadows.is_empty() {
        return None;
    }
    let before: [u64; 3] = std::array::from_fn(|channel| output[channel + 1] as u64); // colours have no sign
    let most = machine.stored_color();
    let dither = Dither { bits: machine.color.bits, left: most.bits };
    let after = before.map(|color| dither.ordered(color, x, y));
    Some(Dithered { pattern: pattern(x, y), before, after, most: most.max() })
}

/// As a line of text.
pub(crate) fn text(of: &Dithered) -> String {
    let Dithered { pattern, before: [r, g, b], after: [u, v, w], most } = of;
    format!("DITHER: pattern {pattern} of 16, rgb {r} {g} {b} -> {u} {v} {w} of {most}\n")
}
