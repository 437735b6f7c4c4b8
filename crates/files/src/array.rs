//! Arrays for numpy: row 0 on top, C order.

use crate::Staging;
use anyhow::{Context, Result};
use npyz::{AutoSerialize, NpyWriter, WriterBuilder};
use std::fs::File;
use std::io::{self, BufWriter};

/// A type of values that [`Array`] writes.
pub trait Element: AutoSerialize + Copy {
    /// Writes values behind those that are written.
    fn write(writer: &mut NpyWriter<Self, BufWriter<File>>, values: &[Self]) -> io::Result<()>;
}

macro_rules! elements {
    ($($element:ty)*) => {$(
        impl Element for $element {
            fn write(writer: &mut NpyWriter<Self, BufWriter<File>>, values: &[Self]) -> io::Result<()> {
                writer.extend(values.iter().copied())
            }
        }
    )*};
}

elements!(u8 u32 i32 i64 f64);

/// An array on its way into a file.
pub struct Array<T: Element> {
    /// For messages.
    name: String,
    writer: NpyWriter<T, BufWriter<File>>,
}

impl<T: Element> Array<T> {
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
        T::write(&mut self.writer, values).with_context(|| self.name.clone())
    }

    /// To the disk, if all values are there.
    pub fn finish(self) -> Result<()> {
        self.writer.finish().context(self.name)
    }
}
