//! Arrays for numpy: row 0 on top, C order.

use crate::staging::Staging;
use anyhow::{Context, Result};
use npyz::{AutoSerialize, WriterBuilder};
use std::fs::File;
use std::io::{BufWriter, Write as _};

/// Writes `values` as an array of that shape.
pub fn write<T: AutoSerialize + Copy>(out: &Staging, name: &str, shape: &[u64], values: &[T]) -> Result<()> {
    let path = out.path(name)?;
    let place = || format!("{}", path.display());
    let mut file = BufWriter::new(File::create(&path).with_context(place)?);
    let mut array = npyz::WriteOptions::new()
        .default_dtype()
        .shape(shape)
        .writer(&mut file)
        .begin_nd()
        .with_context(place)?;
    array.extend(values.iter().copied()).with_context(place)?;
    array.finish().with_context(place)?;
    file.flush().with_context(place)
}
