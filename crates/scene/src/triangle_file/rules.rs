//! The lines `depth`, `depth_write`, `blend`, `colour_write`, `light` and `clear_depth`: the rules of the
//! primitives behind them.

use crate::error::InputError;
use crate::frame::{Frame, MAX_LIGHTS};
use crate::rules::DepthFunc;
use crate::rules::{Blending, Change, State};
use crate::text::Place;

/// `off` behind the eight functions.
const DEPTH_NAMES: [&str; 9] = {
    let mut names = ["off"; 9];
    let mut i = 0;
    while i < DepthFunc::NAMES.len() {
        names[i] = DepthFunc::NAMES[i];
        i += 1;
    }
    names
};

/// Reads a line into the rules; `clear_depth`, which is none, says true.
pub(super) fn read<'a>(
    place: Place,
    name: &str,
    words: impl Iterator<Item = &'a [u8]>,
    rules: &mut State,
) -> Result<bool, InputError> {
    if name == "clear_depth" {
        let [] = place.values(name, "", words)?;
        return Ok(true);
    }
    let value = match name {
        "depth" => "F",
        "light" => "N",
        _ => "B",
    };
    let [word] = place.values(name, value, words)?;
    match name {
        "depth" => rules.depth = DepthFunc::ALL.get(place.choice(name, word, &DEPTH_NAMES)?).copied(),
        "depth_write" => rules.depth_write = place.choice(name, word, &["0", "1"])? == 1,
        "light" => rules.light = place.number(name, word, "an integer", 0..=MAX_LIGHTS)?,
        "blend" => rules.blend = Blending::ALL[place.choice(name, word, &Blending::NAMES)?],
        _ => rules.color_write = place.choice(name, word, &["0", "1"])? == 1,
    }
    Ok(false)
}

/// The rules before the first primitive.
pub(super) fn begin(rules: State, frame: &mut Frame) {
    let State { depth, blend, color_write, light, .. } = rules;
    (frame.depth, frame.depth_write) = (depth, rules.stores_depth());
    (frame.blend, frame.color_write, frame.light) = (blend, color_write, light);
}

/// Reads a line behind a primitive.
pub(super) fn change<'a>(
    place: Place,
    name: &str,
    words: impl Iterator<Item = &'a [u8]>,
    rules: &mut State,
    frame: &mut Frame,
) -> Result<(), InputError> {
    let clear_depth = read(place, name, words, rules)?;
    let after = frame.drawn();
    let state = State { depth_write: rules.stores_depth(), ..*rules };
    match frame.changes.last_mut().filter(|change| change.after == after) {
        Some(change) => *change = Change { state, clear_depth: change.clear_depth || clear_depth, ..*change },
        None => frame.changes.push(Change { after, state, clear_depth }),
    }
    Ok(())
}
