//! The pixels in which two pictures differ. Two large pictures do not fit into memory: each comes from the top in bands, and the first waits
//! on the disk for the second. So do the differences, whose largest is known only at the end.

use crate::Png;
use crate::Staging;
use anyhow::{Context, Result, anyhow};
use edgewalk_host::raster::Raster;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read as _, Seek as _, Write};

/// Pixels that differ.
#[derive(Default)]
pub struct Pixels {
    /// All that were compared.
    pub all: u64,
    /// By colour.
    pub color: u64,
    /// By depth.
    pub depth: u64,
    /// By how many triangles cover them.
    pub coverage: u64,
    /// By the triangle that they show.
    pub shown: u64,
    /// The largest difference of a colour, in 0 to 1.
    pub largest: f64,
}

/// The first picture, on its way to the disk.
pub struct First(BufWriter<File>);

/// Two pictures, as far as the second has come.
pub struct Differences {
    first: BufReader<File>,
    /// Of every pixel the largest difference of a colour.
    colors: BufWriter<File>,
    pixels: Pixels,
}

/// What is kept of a pixel: red, green, blue and depth in 0 to 1, coverage and triangle, 8 bytes each.
type Kept = [[u8; 8]; 6];

fn kept(picture: &Raster, i: usize) -> Kept {
    let ([r, g, b], z) = (picture.rgb[i], picture.z[i]);
    let [coverage, id] = [picture.coverage[i].into(), i64::from(picture.id[i])].map(i64::to_le_bytes);
    let [r, g, b, z] = [r, g, b, z].map(f64::to_le_bytes);
    [r, g, b, z, coverage, id]
}

/// Bytes that are written or read at a time.
const PIECE: usize = 1 << 16;

impl First {
    /// Nothing of it yet; its file is on the disk of `out`.
    pub fn new(out: &Staging) -> Result<First> {
        Ok(First(BufWriter::with_capacity(PIECE, out.nameless()?)))
    }

    /// Compares the next lines of both pictures.
    pub fn add(&mut self, picture: &Raster) -> Result<()> {
        let mut pixels = 0..picture.rgb.len();
        pixels.try_for_each(|i| self.0.write_all(kept(picture, i).as_flattened())).context(WAITS)
    }

    /// All of it is there; the second may come.
    pub fn beside(self, out: &Staging) -> Result<Differences> {
        let colors = BufWriter::with_capacity(PIECE, out.nameless()?);
        Ok(Differences { first: from_the_top(self.0)?, colors, pixels: Pixels::default() })
    }
}

/// What messages call the files.
const WAITS: &str = "a picture that waits on the disk of --out";

fn from_the_top(written: BufWriter<File>) -> Result<BufReader<File>> {
    let mut file = written.into_inner().map_err(|error| anyhow!(error.into_error())).context(WAITS)?;
    file.rewind().context(WAITS)?;
    Ok(BufReader::with_capacity(PIECE, file))
}

impl Differences {
    /// The next lines of the second picture.
    pub fn add(&mut self, picture: &Raster) -> Result<()> {
        let Differences { first, colors, pixels } = self;
        for i in 0..picture.rgb.len() {
            let (mut a, b): (Kept, Kept) = (Kept::default(), kept(picture, i));
            first.read_exact(a.as_flattened_mut()).context(WAITS)?;
            let [a_rgb, b_rgb] = [a, b].map(|[r, g, b, ..]| [r, g, b].map(f64::from_le_bytes));
            let pairs = a_rgb.iter().zip(b_rgb);
            let difference = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            colors.write_all(&difference.to_le_bytes()).context(WAITS)?;
            let [_, _, _, depth, coverage, shown] = std::array::from_fn(|part| u64::from(a[part] != b[part]));
            pixels.all += 1;
            pixels.color += u64::from(difference > 0.0);
            pixels.depth += depth;
            pixels.coverage += coverage;
            pixels.shown += shown;
            pixels.largest = pixels.largest.max(difference);
        }
        Ok(())
    }

    /// All is there: writes the differences of colours, yellow at the largest.
    pub fn write(self, out: &Staging, name: &str, (width, height): (u32, u32)) -> Result<Pixels> {
        let full = self.pixels.largest.max(f64::MIN_POSITIVE);
        let (mut colors, mut picture) = (from_the_top(self.colors)?, Png::create(out, name, width, height)?);
        let mut line = vec![[0; 8]; width as usize];
        for _ in 0..height {
            colors.read_exact(line.as_flattened_mut()).context(WAITS)?;
            let differences: Vec<f64> = line.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
            picture.extend_heat(&differences, full)?;
        }
        picture.finish()?;
        Ok(self.pixels)
    }
}
