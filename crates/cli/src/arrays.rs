//! Arrays for numpy: row 0 on top, C order.

use crate::staging::Staging;
use anyhow::{Context, Result};
use npyz::{AutoSerialize, NpyWriter, WriterBuilder};
use std::fs::File;
use std::io::BufWriter;

/// An array on its way into a file.
pub struct Array<T: AutoSerialize> {
    /// For messages.
    name: String,
    writer: NpyWriter<T, BufWriter<File>>,
}

impl<T: AutoSerialize + Copy> Array<T> {
    /// An array of that shape, still empty.
    pub fn create(out: &Staging, name: &str, shape: &[u64]) -> Result<Self> {
        let file = out.create(name)?;
        let name = out.name(name);
        let options = npyz::WriteOptions::new().default_dtype().shape(shape);
        let writer = options.writer(file).begin_nd().with_context(|| name.clone())?;
        Ok(Array { name, writer })
    }

    /// Writes the next values.
    pub fn extend(&mut self, values: &[T]) -> Result<()> {
        self.writer.extend(values.iter().copied()).with_context(|| self.name.clone())
    }

    /// To the disk, if all values are there.
    pub fn finish(self) -> Result<()> {
        self.writer.finish().context(self.name)
    }
}
