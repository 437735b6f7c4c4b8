//! Pictures for people: the frame, and the error as a heat map.

mod scale;

use crate::staging::Staging;
use anyhow::{Context, Result};
use png::StreamWriter;
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, BufWriter, Write as _};
use std::rc::Rc;

/// Writes colours in 0 to 1 as an 8-bit PNG.
pub fn write_rgb(out: &Staging, name: &str, width: u32, height: u32, rgb: &[[f64; 3]]) -> Result<()> {
    write(out, name, width, height, |i| bytes(rgb[i]))
}

/// Writes an error in LSB as a heat map: black none, blue to yellow up to `full` LSB, red above.
pub fn write_heat(
    out: &Staging,
    name: &str,
    (width, height): (u32, u32),
    lsb: &[f64],
    full: f64,
) -> Result<()> {
    write(out, name, width, height, |i| heat(lsb[i] / full))
}

/// The colour of an error, 1 being the largest that is expected.
pub fn heat(error: f64) -> [u8; 3] {
    match error {
        0.0 => [0, 0, 0],
        e if e <= 1.0 => [(e * 255.0) as u8, (e * 220.0) as u8, ((1.0 - e) * 160.0) as u8],
        // What is no number is too much as well.
        _ => [255, 0, 0],
    }
}

/// Writes numbers from -1 to 1 as blue over black to orange, with the scale underneath.
pub fn write_signed(out: &Staging, name: &str, (width, height): (u32, u32), map: &[f64]) -> Result<()> {
    let below = scale::of(width);
    write(out, name, width, height + scale::HEIGHT, |i| match map.get(i) {
        Some(value) => signed(*value),
        None => below[i - map.len()],
    })
}

/// The colour of a number from -1 to 1.
fn signed(value: f64) -> [u8; 3] {
    let strength = value.abs().min(1.0).sqrt();
    let full = if value < 0.0 { [70.0, 150.0, 255.0] } else { [255.0, 150.0, 30.0] };
    full.map(|channel| (channel * strength) as u8)
}

/// The heat map of a shading system, yellow at its largest error.
pub fn write_shading_error(
    out: &Staging,
    name: &str,
    size: (u32, u32),
    error: &edgewalk_golden::ShadingError,
) -> Result<()> {
    // Without an error any scale does.
    let full = if error.max > 0.0 { error.max } else { 1.0 };
    write_heat(out, name, size, &error.map, full)
}

/// Writes an 8-bit PNG, pixel by pixel.
pub fn write(
    out: &Staging,
    name: &str,
    width: u32,
    height: u32,
    pixel: impl Fn(usize) -> [u8; 3],
) -> Result<()> {
    let mut picture = Png::create(out, name, width, height)?;
    let line = width as usize;
    for y in 0..height as usize {
        picture.extend((y * line..(y + 1) * line).map(&pixel))?;
    }
    picture.finish()
}

/// An 8-bit picture on its way into a file or into memory, line by line.
pub struct Png<W: io::Write + 'static = BufWriter<File>> {
    /// For messages.
    name: String,
    file: Shared<W>,
    stream: StreamWriter<'static, Shared<W>>,
}

impl Png {
    /// A picture of that size in a file, still empty.
    pub fn create(out: &Staging, name: &str, width: u32, height: u32) -> Result<Self> {
        Png::begin(out.create(name)?, out.name(name), (width, height), png::Compression::Fast)
    }
}

impl Png<Vec<u8>> {
    /// A picture of that size in memory, still empty.
    pub fn in_memory(size: (u32, u32)) -> Result<Self> {
        Png::begin(Vec::new(), "a picture".to_owned(), size, png::Compression::Default)
    }

    /// The bytes of its file, if all pixels are there.
    pub fn bytes(self) -> Result<Vec<u8>> {
        let file = Rc::clone(&self.file.0);
        self.finish()?;
        Ok(file.take())
    }
}

impl<W: io::Write + 'static> Png<W> {
    fn begin(to: W, name: String, (width, height): (u32, u32), how: png::Compression) -> Result<Self> {
        let file = Shared(Rc::new(RefCell::new(to)));
        let mut encoder = png::Encoder::new(file.clone(), width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(how);
        let stream = encoder.write_header().and_then(png::Writer::into_stream_writer);
        Ok(Png { stream: stream.with_context(|| name.clone())?, name, file })
    }

    /// The next pixels, colours in 0 to 1.
    pub fn extend_rgb(&mut self, rgb: &[[f64; 3]]) -> Result<()> {
        self.extend(rgb.iter().map(|color| bytes(*color)))
    }

    /// The next pixels of a heat map of errors in LSB, as [`write_heat`] colours them.
    pub fn extend_heat(&mut self, lsb: &[f64], full: f64) -> Result<()> {
        self.extend(lsb.iter().map(|error| heat(error / full)))
    }

    /// The next pixels.
    fn extend(&mut self, pixels: impl Iterator<Item = [u8; 3]>) -> Result<()> {
        let bytes: Vec<u8> = pixels.flatten().collect();
        self.stream.write_all(&bytes).with_context(|| self.name.clone())
    }

    /// To the disk, if all pixels are there.
    pub fn finish(self) -> Result<()> {
        let Png { name, mut file, stream } = self;
        // The encoder says nothing of an error in its last bytes: flushing meets it again.
        let finished = stream.finish().map_err(io::Error::from);
        finished.and_then(|()| file.flush()).context(name)
    }
}

/// The file, which has to be flushed when the encoder is done with it.
struct Shared<W>(Rc<RefCell<W>>);

impl<W> Clone for Shared<W> {
    fn clone(&self) -> Self {
        Shared(Rc::clone(&self.0))
    }
}

impl<W: io::Write> io::Write for Shared<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

/// A colour in 0 to 1 in 8 bits.
pub fn bytes(color: [f64; 3]) -> [u8; 3] {
    color.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::heat;

    #[test]
    fn heat_runs_from_black_over_blue_and_yellow_to_red() {
        let table = [
            (0.0, [0, 0, 0]),
            (1e-9, [0, 0, 159]),
            (0.5, [127, 110, 80]),
            (1.0, [255, 220, 0]),
            (1.0001, [255, 0, 0]),
            (f64::NAN, [255, 0, 0]),
        ];
        for (error, color) in table {
            assert_eq!(heat(error), color, "{error}");
        }
    }
}
