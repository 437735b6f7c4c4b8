//! The lines `shadow` and `L`: a light's map and what stands in it.

use crate::error::InputError;
use crate::frame::{MAX_COORDINATE, MAX_SIDE, Pane, Shadow};
use crate::text::Place;

/// The values behind `shadow`.
pub(super) fn shadow<'a>(place: Place, words: impl Iterator<Item = &'a [u8]>) -> Result<Shadow, InputError> {
    let words: [&[u8]; 19] =
        place.values("shadow", "SIZE BIAS AMBIENT, then m00 to m33 row by row", words)?;
    let [size, bias, ambient, elements @ ..] = words;
    let mut matrix = [[0.0; 4]; 4];
    for (index, (slot, word)) in matrix.as_flattened_mut().iter_mut().zip(elements).enumerate() {
        *slot = place.finite(format_args!("shadow m{}{}", index / 4, index % 4), word)?;
    }
    Ok(Shadow {
        size: place.number("shadow SIZE", size, "an integer", 1..=MAX_SIDE)?,
        bias: place.number("shadow BIAS", bias, "a number", -1.0..=1.0)?,
        slopes: Vec::new(),
        ambient: place.number("shadow AMBIENT", ambient, "a number", 0.0..=1.0)?,
        matrix,
        triangles: Vec::new(),
        panes: Vec::new(),
    })
}

/// What stands behind `L`.
const VALUES: &str = "x y z of vertex 1, then of 2, then of 3; a tenth one is kt";

/// The values behind `L`, into the light: nine, and k_t behind them if there is one.
pub(super) fn occluder<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    shadow: &mut Shadow,
) -> Result<(), InputError> {
    let all: Vec<&[u8]> = words.take(11).collect();
    let given = all.iter().copied();
    let (words, kt): ([&[u8]; 9], f64) = match all.len() {
        10 => {
            let [words @ .., kt]: [&[u8]; 10] = place.values("L", VALUES, given)?;
            (words, place.number("L kt", kt, "a number", 0.0..=1.0)?)
        }
        _ => (place.values("L", VALUES, given)?, 0.0),
    };
    let mut triangle = [[0.0; 3]; 3];
    for (index, (slot, word)) in triangle.as_flattened_mut().iter_mut().zip(words).enumerate() {
        let range = if index % 3 < 2 { -MAX_COORDINATE..=MAX_COORDINATE } else { 0.0..=1.0 };
        let key = format_args!("L vertex {} {}", index / 3 + 1, ["x", "y", "z"][index % 3]);
        *slot = place.number(key, word, "a number", range)?;
    }
    match kt > 0.0 {
        true => shadow.panes.push(Pane { corners: triangle, kt }),
        false => shadow.triangles.push(triangle),
    }
    Ok(())
}
