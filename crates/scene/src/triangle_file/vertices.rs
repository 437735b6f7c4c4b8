//! The lines `T`, `S`, `P` and `H`: vertices, each of seven numbers.

use crate::error::InputError;
use crate::frame::{DEPTH_ROUNDING, MAX_CONTOUR, MAX_COORDINATE};
use crate::host::Host;
use crate::text::Place;
use crate::vertex::{Triangle, Vertex};

/// The numbers of a vertex, in the order of the file.
const ATTRIBUTES: [&str; 7] = ["x", "y", "z", "r", "g", "b", "kt"];

/// The vertices behind `T`.
pub(super) fn triangle<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    host: &mut Host,
) -> Result<Triangle, InputError> {
    let words: [&[u8]; 3 * ATTRIBUTES.len()] =
        place.values("T", "x y z r g b kt of vertex 1, then of 2, then of 3", words)?;
    let mut triangle = Triangle::default();
    for (index, (slot, words)) in triangle.0.iter_mut().zip(words.chunks_exact(ATTRIBUTES.len())).enumerate()
    {
        *slot = vertex(place, "T", index, words, host)?;
    }
    Ok(triangle)
}

/// The ends behind `S`.
pub(super) fn ends<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    host: &mut Host,
) -> Result<[Vertex; 2], InputError> {
    let words: [&[u8]; 2 * ATTRIBUTES.len()] =
        place.values("S", "x y z r g b kt of the first end, then of the other", words)?;
    let [first, other] = [0, 1].map(|index| &words[index * ATTRIBUTES.len()..][..ATTRIBUTES.len()]);
    Ok([vertex(place, "S", 0, first, host)?, vertex(place, "S", 1, other, host)?])
}

/// The number of vertices and as many vertices.
pub(super) fn contour<'a>(
    place: Place,
    key: &str,
    mut words: impl Iterator<Item = &'a [u8]>,
    host: &mut Host,
) -> Result<Vec<Vertex>, InputError> {
    let count = words.next().unwrap_or_default();
    let count = place.number(format_args!("{key} n"), count, "an integer", 3..=MAX_CONTOUR)?;
    let words: Vec<&[u8]> = words.collect();
    if words.len() != count * ATTRIBUTES.len() {
        let found = format!("{} given", words.len());
        let permitted = format!(
            "permitted: {} values after n, x y z r g b kt of {count} vertices",
            count * ATTRIBUTES.len()
        );
        return Err(place.fault(key, found.as_bytes(), permitted).into());
    }
    let vertices = words.chunks_exact(ATTRIBUTES.len()).enumerate();
    vertices.map(|(i, words)| vertex(place, key, i, words, host)).collect()
}

fn vertex(
    place: Place,
    key: &str,
    index: usize,
    words: &[&[u8]],
    host: &mut Host,
) -> Result<Vertex, InputError> {
    let mut numbers = [0.0; ATTRIBUTES.len()];
    for (a, (number, word)) in numbers.iter_mut().zip(words).enumerate() {
        let key = format_args!("{key} vertex {} {}", index + 1, ATTRIBUTES[a]);
        *number = match a {
            0 | 1 => place.number(key, word, "a number", -MAX_COORDINATE..=MAX_COORDINATE)?,
            2 => place.number(key, word, "a number", -DEPTH_ROUNDING..=1.0 + DEPTH_ROUNDING)?,
            3..6 => place.color(key, word)?,
            _ => place.number(key, word, "a number", 0.0..=1.0)?,
        };
    }
    let [x, y, depth, r, g, b, kt] = numbers;
    let z = depth.clamp(0.0, 1.0);
    host.clamped_depths += u64::from(z != depth);
    Ok(Vertex { x, y, z, r, g, b, kt, ..Vertex::default() })
}
