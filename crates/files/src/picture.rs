//! Pictures for people: the frame, and the error as a heat map.

mod scale;

use crate::Staging;
use anyhow::{Context, Result};
use png::StreamWriter;
use std::cell::RefCell;
use std::io::{self, Write as _};
use std::rc::Rc;

/// Writes colours in 0 to 1 as an 8-bit PNG.
pub fn write_rgb(out: &Staging, name: &str, width: u32, height: u32, rgb: &[[f64; 3]]) -> Result<()> {
    let mut picture = Png::create(out, name, width, height)?;
    rgb.chunks(width as usize).try_for_each(|line| picture.extend_rgb(line))?;
    picture.finish()
}

/// Writes errors as a heat map: black none, blue to yellow up to the largest, `max`.
pub fn write_heat(
    out: &Staging,
    name: &str,
    (width, height): (u32, u32),
    errors: &[f64],
    max: f64,
) -> Result<()> {
    // Without an error any scale does.
    let full = if max > 0.0 { max } else { 1.0 };
    let mut picture = Png::create(out, name, width, height)?;
    errors.chunks(width as usize).try_for_each(|line| picture.extend_heat(line, full))?;
    picture.finish()
}

/// The colour of an error, 1 being the largest that is expected.
fn heat(error: f64) -> [u8; 3] {
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
    write(out, name, width, height + scale::HEIGHT, &|i| match map.get(i) {
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

/// Writes an 8-bit PNG, pixel by pixel.
pub fn write(
    out: &Staging,
    name: &str,
    width: u32,
    height: u32,
    pixel: &dyn Fn(usize) -> [u8; 3],
) -> Result<()> {
    let mut picture = Png::create(out, name, width, height)?;
    let line = width as usize;
    for y in 0..height as usize {
        let bytes: Vec<u8> = (y * line..(y + 1) * line).flat_map(pixel).collect();
        picture.extend(&bytes)?;
    }
    picture.finish()
}

/// An 8-bit picture on its way into a file or into memory, line by line.
pub struct Png {
    /// For messages.
    name: String,
    file: Shared,
    stream: StreamWriter<'static, Shared>,
}

/// The bytes of a PNG file that is made in memory.
pub struct InMemory(Rc<RefCell<Vec<u8>>>);

impl InMemory {
    /// The whole file, once its picture is finished.
    pub fn take(self) -> Vec<u8> {
        self.0.take()
    }
}

impl Png {
    /// A picture of that size in a file, still empty.
    pub fn create(out: &Staging, name: &str, width: u32, height: u32) -> Result<Self> {
        let file = Rc::new(RefCell::new(out.create(name)?));
        Png::begin(file, out.name(name), (width, height), png::Compression::Fast)
    }

    /// A picture of that size, still empty, and its file in memory.
    pub fn in_memory(size: (u32, u32)) -> Result<(Self, InMemory)> {
        let file = Rc::new(RefCell::new(Vec::new()));
        let picture = Png::begin(file.clone(), "a picture".to_owned(), size, png::Compression::Default)?;
        Ok((picture, InMemory(file)))
    }

    fn begin(
        file: Rc<RefCell<dyn io::Write>>,
        name: String,
        (width, height): (u32, u32),
        how: png::Compression,
    ) -> Result<Self> {
        let file = Shared(file);
        let mut encoder = png::Encoder::new(file.clone(), width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(how);
        let stream = encoder.write_header().and_then(png::Writer::into_stream_writer);
        Ok(Png { stream: stream.with_context(|| name.clone())?, name, file })
    }

    /// The next pixels, colours in 0 to 1.
    pub fn extend_rgb(&mut self, rgb: &[[f64; 3]]) -> Result<()> {
        self.extend(&rgb_bytes(rgb))
    }

    /// The next pixels of a heat map of errors in LSB, black none, blue to yellow up to `full`, red above.
    pub fn extend_heat(&mut self, lsb: &[f64], full: f64) -> Result<()> {
        self.extend(&heat_bytes(lsb, full))
    }

    /// The next pixels, three bytes each.
    fn extend(&mut self, bytes: &[u8]) -> Result<()> {
        self.stream.write_all(bytes).with_context(|| self.name.clone())
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
#[derive(Clone)]
struct Shared(Rc<RefCell<dyn io::Write>>);

impl io::Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

/// Colours in 0 to 1 in 8 bits.
fn rgb_bytes(rgb: &[[f64; 3]]) -> Vec<u8> {
    rgb.as_flattened().iter().map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8).collect()
}

/// Errors in LSB in the colours of a heat map: black none, blue to yellow up to `full`, red above.
fn heat_bytes(lsb: &[f64], full: f64) -> Vec<u8> {
    lsb.iter().flat_map(|error| heat(error / full)).collect()
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
