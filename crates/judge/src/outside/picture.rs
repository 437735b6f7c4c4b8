//! What another rasterizer left, as arrays: row 0 on top.

use anyhow::{Result, anyhow};
use std::ops::RangeInclusive;

/// The arrays that there are. Each has `width * height` entries.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Triangles, polygons and lines over each pixel, depth test off.
    pub coverage: Option<Vec<u32>>,
    /// Place in the input of the one of these that each pixel shows, -1 none.
    pub id: Option<Vec<i32>>,
    /// Depth in 0 to 1.
    pub z: Option<Vec<f64>>,
    /// Colour in 0 to 1.
    pub rgb: Option<Vec<[f64; 3]>>,
    /// 0 nothing written, 1 in shadow, 2 lit.
    pub lit: Option<Vec<u8>>,
    /// A step of the colours in a file that rounds them to bits of its own, as a PNG does, in 0 to 1; else 0.
    pub color_step: f64,
}

/// What the whole numbers of an array may be.
pub struct Permitted {
    range: RangeInclusive<i128>,
    /// In words.
    text: &'static str,
}

/// Of `coverage`.
pub const COVERAGE: Permitted = Permitted {
    range: 0..=u32::MAX as i128,
    text: "0 to 4294967295, the number of triangles, polygons and lines over the pixel; write them as uint32",
};

/// Of `id`.
pub const ID: Permitted = Permitted {
    range: -1..=i32::MAX as i128,
    text: "-1 for none, or a place in the input, 0 to 2147483647; write them as int32",
};

/// Of `lit`.
pub const LIT: Permitted = Permitted {
    range: 0..=2,
    text: "0 for nothing written, 1 for in shadow, 2 for lit; write them as uint8",
};

/// Floats may be so far outside of 0 to 1: what single precision makes of one that is inside.
const ROUNDING: f64 = 1e-5;

impl Permitted {
    /// The values of a picture with so many columns.
    ///
    /// # Errors
    /// The first that is not permitted, with its pixel.
    pub fn all<T: TryFrom<i128>>(
        &self,
        values: impl IntoIterator<Item = i128>,
        columns: u32,
    ) -> Result<Vec<T>> {
        let of = |(place, value): (usize, i128)| {
            let fits = T::try_from(value).ok().filter(|_| self.range.contains(&value));
            fits.ok_or_else(|| {
                anyhow!("{value} in {}; permitted: {}", pixel(place, columns as usize), self.text)
            })
        };
        values.into_iter().enumerate().map(of).collect()
    }
}

/// What the floats of an array may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Floats {
    /// 0 to 1.
    InUnit,
    /// Any finite number: by the textbook rule a triangle covers centres beside it, where its plane leaves 0 to 1.
    Finite,
}

/// Depths, or with `each` = 3 colours, of a picture with so many columns.
///
/// # Errors
/// The first that is not permitted, with its pixel.
pub fn floats(values: Vec<f64>, of: Floats, columns: u32, each: usize) -> Result<Vec<f64>> {
    let unit = -ROUNDING..=1.0 + ROUNDING;
    let permitted = |value: &f64| match of {
        Floats::InUnit => unit.contains(value),
        Floats::Finite => value.is_finite(),
    };
    match values.iter().position(|value| !permitted(value)) {
        None => Ok(values),
        Some(place) => Err(anyhow!(
            "{} in {}; permitted: {}, or unsigned integers in LSB; divide by the value that stands for 1, or write \
             unsigned integers",
            values[place],
            pixel(place / each, columns as usize),
            match of {
                Floats::InUnit => "floats in 0 to 1",
                Floats::Finite => "finite floats",
            }
        )),
    }
}

/// A pixel in words.
fn pixel(place: usize, columns: usize) -> String {
    format!("pixel ({}, {})", place % columns, place / columns)
}
