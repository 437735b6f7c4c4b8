//! The triangles of an input as a suite, with what the memories behind the units hold for them.

use super::{Suite, Triangle, Words};
use edgewalk_machine::{Plan, Shading, wholes};
use edgewalk_model::DrawState;
use std::path::Path;

/// What an input sends to the machine.
#[derive(Clone, Copy)]
pub struct Sent<'a> {
    /// Triangles, polygons and lines in drawing order, as tokens.
    pub triangles: &'a [Triangle],
    /// Of each whole of these tokens the place in the input of what it is or is a part of.
    pub ids: &'a [i32],
    /// The rules that all of them are drawn by.
    pub state: DrawState,
    /// Words of the light's map, if there is one.
    pub map: Option<&'a [u32]>,
    /// What the memories behind TERM and SHADE hold.
    pub shading: &'a Shading,
}

/// More triangles than the memory of the terms has records.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{triangles} triangles with a record each, and the memory of the terms has {records}; add --triangles {records}, or --set \
     term.record_bits={needed}"
)]
pub struct TooManyRecords {
    /// Triangles with a record.
    pub triangles: usize,
    /// Records that the memory has.
    pub records: u64,
    /// `term.record_bits` that would do.
    pub needed: u32,
}

impl Suite {
    /// The triangles, polygons and lines of an input, `wanted` of them, spread evenly, each whole; all of them if none is said. The
    /// last part of `input`, without its extension, is the suite's name.
    ///
    /// # Errors
    /// More triangles than there are records.
    pub fn of_input(
        machine: &Plan,
        input: &str,
        sent: &Sent,
        wanted: Option<u64>,
    ) -> Result<Suite, TooManyRecords> {
        let name = Path::new(input).file_stem().map_or_else(|| input.into(), |stem| stem.to_string_lossy());
        // It becomes the name of a directory.
        let name: String =
            name.chars().map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect();
        let wanted = wanted.map_or(usize::MAX, |n| usize::try_from(n).unwrap_or(usize::MAX));
        let parts: Vec<(i32, &[Triangle])> = sent.ids.iter().copied().zip(wholes(sent.triangles)).collect();
        let drawn: Vec<_> = parts.chunk_by(|(one, _), (next, _)| one == next).collect();
        let every = drawn.len().div_ceil(wanted).max(1);
        let taken = drawn.into_iter().step_by(every).flatten();
        let triangles: Vec<Triangle> = taken.flat_map(|(_, tokens)| *tokens).copied().collect();
        Ok(Suite {
            state: sent.state,
            words: words(machine, sent, every)?,
            ..Suite::of_triangles(&name, input, triangles)
        })
    }
}

/// Memory words of a sample: every n-th of the triangles, which are all that a shaded frame has.
fn words(machine: &Plan, sent: &Sent, every: usize) -> Result<Words, TooManyRecords> {
    let mut words = Words::new();
    if let Some(map) = sent.map {
        words.insert("map", map.iter().copied().map(u128::from).collect());
    }
    let shading = sent.shading;
    let (taken, records) = (shading.records.len().div_ceil(every), 1u64 << machine.shade.record_bits);
    if machine.shade.is_there() && taken as u64 > records {
        let needed = taken.next_power_of_two().ilog2();
        return Err(TooManyRecords { triangles: taken, records, needed });
    }
    let records = shading.records.iter().step_by(every).flat_map(|record| machine.record_words(record));
    let filled = [("tables", &shading.tables), ("roots", &shading.roots), ("textures", &shading.textures)];
    words.insert("terms", records.map(u128::from).collect());
    words.extend(filled.map(|(memory, words)| (memory, words.as_slice().into())));
    Ok(words)
}
