//! The lines `extra` and `X`: values of the user's own at the vertices.

use crate::error::InputError;
use crate::text::Place;
use crate::vertex::{MAX_EXTRA, MAX_EXTRA_VALUE, Triangle};

/// The number behind `extra`.
pub(super) fn count<'a>(place: Place, words: impl Iterator<Item = &'a [u8]>) -> Result<usize, InputError> {
    let [count] = place.values("extra", "N", words)?;
    place.number("extra N", count, "an integer", 0..=MAX_EXTRA)
}

/// The numbers behind `X`, `count` for each vertex, into the triangle that is open, if one is.
pub(super) fn values<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    count: usize,
    open: Option<&mut Triangle>,
) -> Result<(), InputError> {
    let words: Vec<&[u8]> = words.collect();
    let found = format!("{} given", words.len());
    if count == 0 {
        let nearest = words.len().div_ceil(3).clamp(1, MAX_EXTRA);
        let why = format!(
            "permitted only behind a line `extra N` before the first triangle, here `extra {nearest}`"
        );
        return Err(place.fault("X", found.as_bytes(), why).into());
    }
    let Some(triangle) = open else {
        return Err(place.fault("line starts with", b"X", "permitted once, behind a triangle `T`").into());
    };
    if words.len() != 3 * count {
        return Err(place.fault("X", found.as_bytes(), permitted(count)).into());
    }
    for (vertex, (slots, words)) in triangle.0.iter_mut().zip(words.chunks_exact(count)).enumerate() {
        for (channel, (slot, word)) in slots.extra.iter_mut().zip(words).enumerate() {
            let key = format_args!("X vertex {} e{channel}", vertex + 1);
            *slot = place.number(key, word, "a number", -MAX_EXTRA_VALUE..=MAX_EXTRA_VALUE)?;
        }
    }
    Ok(())
}

/// The triangle of this line has no values, and `before` comes.
pub(super) fn missing(place: Place, before: &[u8], count: usize, line: usize) -> InputError {
    let why = format!("the `X` of the triangle in line {line} is missing; {}", permitted(count));
    place.fault("X", before, why).into()
}

/// A polygon or line in a file that has such values.
pub(super) fn polygon(place: Place, key: &str, count: usize) -> InputError {
    let what = if key == "S" { "lines" } else { "polygons" };
    let why = format!("{what} have no `X`; permitted with `extra {count}`: only triangles");
    place.fault("line starts with", key.as_bytes(), why).into()
}

fn permitted(count: usize) -> String {
    let names: Vec<String> = (0..count).map(|channel| format!("e{channel}")).collect();
    format!("permitted: {} values, {} of vertex 1, then of 2, then of 3", 3 * count, names.join(" "))
}
