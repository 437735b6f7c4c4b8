//! Pictures over texture coordinates: coefficients that vary over the surface, and reliefs (end of ch. 7).
//!
//! Values are taken as they are stored, 0 black and 1 white: no gamma, as pictures are written without one.

use crate::error::{Fault, InputError};
use crate::file;
use glam::{DVec2, DVec3};
use image::{DynamicImage, ImageReader, Limits};
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;
use std::sync::Arc;

/// Largest side of a picture, texels.
pub const MAX_TEXTURE_SIDE: u32 = 4096;

/// A picture over texture coordinates, u to the right and v up, that repeats beyond [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub enum Texture {
    /// Squares of two colours, built in.
    Checker {
        /// Squares along u and along v over [0, 1]; even, or they do not fit together where the picture repeats.
        squares: u32,
        /// Of the square at the origin, and of its neighbours.
        colors: [DVec3; 2],
    },
    /// Smooth hills and hollows, (1 + sin 2 pi n u sin 2 pi n v) / 2, built in.
    Waves {
        /// Waves n along u and along v over [0, 1].
        count: u32,
    },
    /// From a file.
    Image(Arc<Image>),
    /// Like `Image`, with one colour in each texel.
    Texels(Arc<Image>),
    /// A file that is named and is not there: white.
    Absent(String),
}

/// A picture in memory.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Image {
    width: u32,
    height: u32,
    /// Line by line from the top; 65535 is 1.
    texels: Vec<[u16; 3]>,
}

impl Texture {
    /// Reads a PNG or JPEG file of at most [`MAX_TEXTURE_SIDE`] texels each way.
    ///
    /// # Errors
    /// The file cannot be read, is no such picture, or is too large.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        let file = path.display().to_string();
        Self::decode(&file, BufReader::new(file::open(path)?))
    }

    /// The picture that a mesh file names, beside it; white where there is none.
    pub(crate) fn named(name: &str, path: &Path) -> Result<Self, InputError> {
        match file::open_if_there(path)? {
            Some(opened) => Self::decode(&path.display().to_string(), BufReader::new(opened)),
            None => Ok(Self::Absent(name.to_owned())),
        }
    }

    /// The same from memory; messages call it `file`.
    pub(crate) fn decode(file: &str, input: impl BufRead + Seek) -> Result<Self, InputError> {
        let fault = |what: String| {
            let permitted = format!("permitted: PNG or JPEG, at most {MAX_TEXTURE_SIDE} texels each way");
            InputError::from(Fault::new(file, None, "texture", what, permitted))
        };
        let reader = ImageReader::new(input).with_guessed_format();
        let mut reader = reader.map_err(|source| InputError::Read { file: file.into(), source })?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_TEXTURE_SIDE);
        limits.max_image_height = Some(MAX_TEXTURE_SIDE);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| fault(error.to_string()))?;
        Image::new(&picture).map(|image| Self::Image(Arc::new(image))).ok_or_else(|| fault("empty".into()))
    }

    /// Like `decode`, with one colour in each texel, as hardware without a filter reads it; of a checker a square is a texel, of waves
    /// there are [`WAVE_TEXELS`] a wave.
    #[must_use]
    pub fn nearest(self) -> Self {
        match self {
            Self::Image(image) => Self::Texels(image),
            Self::Checker { squares, colors } if squares <= MAX_TEXTURE_SIDE => {
                let stored = colors.map(|color| color.to_array().map(|part| (part * ONE).round() as u16));
                // Lines run from the top, and the square at the origin is the first of the last line.
                let square = |k: u32| stored[((k % squares + squares - 1 - k / squares) % 2) as usize];
                let texels = (0..squares * squares).map(square).collect();
                Image::of(squares, squares, texels)
                    .map_or(Self::Checker { squares, colors }, |image| Self::Texels(Arc::new(image)))
            }
            Self::Waves { count } if count <= MAX_TEXTURE_SIDE / WAVE_TEXELS => {
                let side = count * WAVE_TEXELS;
                let height = |k: u32| {
                    // Lines run from the top.
                    let middle = DVec2::new(f64::from(k % side) + 0.5, f64::from(side - 1 - k / side) + 0.5);
                    [(self.at(middle / f64::from(side)).x * ONE).round() as u16; 3]
                };
                let texels = (0..side * side).map(height).collect();
                Image::of(side, side, texels).map_or(self, |image| Self::Texels(Arc::new(image)))
            }
            other => other,
        }
    }

    /// The colour at texture coordinates, [0, 1] each; pictures of files bilinear between the centres of the texels.
    pub fn at(&self, place: DVec2) -> DVec3 {
        match self {
            Self::Checker { squares, colors } => {
                let square = (place * f64::from(*squares)).floor();
                // Of what is no number, or too large to be even or odd, the first.
                colors[usize::from((square.x + square.y).rem_euclid(2.0) == 1.0)]
            }
            Self::Waves { count } => {
                let wave = |at: f64| (std::f64::consts::TAU * f64::from(*count) * at).sin();
                DVec3::splat((1.0 + wave(place.x) * wave(place.y)) / 2.0)
            }
            Self::Image(image) => image.at(place),
            Self::Texels(image) => image.nearest(place),
            Self::Absent(_) => DVec3::ONE,
        }
    }

    /// How steeply the mean of the colours rises along u and v, per unit of each: half the difference of the neighbours
    /// a texel away.
    pub(crate) fn slope(&self, place: DVec2) -> DVec2 {
        let texel = match self {
            Self::Checker { squares: count, .. } | Self::Waves { count } => {
                DVec2::splat(1.0 / (FINE * f64::from((*count).max(1))))
            }
            Self::Image(image) => 1.0 / image.size(),
            Self::Texels(image) => return image.slope(place),
            Self::Absent(_) => return DVec2::ZERO,
        };
        let height = |place: DVec2| self.at(place).element_sum() / 3.0;
        let rise = |way: DVec2| (height(place + way) - height(place - way)) / (2.0 * way.element_sum());
        DVec2::new(rise(texel.with_y(0.0)), rise(texel.with_x(0.0)))
    }
}

/// Texels of a wave in a picture of nearest texels.
pub const WAVE_TEXELS: u32 = 32;

/// What counts as texels in a square or a wave of what is built in.
const FINE: f64 = 64.0;

/// A stored 1.
const ONE: f64 = u16::MAX as f64;

impl Image {
    /// Texels line by line from the top, 65535 for 1; `None` if they are not as many, or none.
    pub fn of(width: u32, height: u32, texels: Vec<[u16; 3]>) -> Option<Self> {
        let count = u64::from(width) * u64::from(height);
        (count > 0 && texels.len() as u64 == count).then_some(Self { width, height, texels })
    }

    /// Texels a line, and lines.
    pub fn sides(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The texels, line by line from the top; 65535 is 1.
    pub fn texels(&self) -> &[[u16; 3]] {
        &self.texels
    }

    /// `None` of no texels.
    fn new(picture: &DynamicImage) -> Option<Self> {
        let picture = picture.to_rgb16();
        let (width, height) = picture.dimensions();
        Self::of(width, height, picture.pixels().map(|texel| texel.0).collect())
    }

    fn size(&self) -> DVec2 {
        DVec2::new(self.width.into(), self.height.into())
    }

    fn at(&self, place: DVec2) -> DVec3 {
        let texel = DVec2::new(place.x, 1.0 - place.y) * self.size() - 0.5;
        let low = texel.floor();
        let part = texel - low;
        let line = |y: f64| self.texel(low.x, y).lerp(self.texel(low.x + 1.0, y), part.x);
        line(low.y).lerp(line(low.y + 1.0), part.y)
    }

    /// The texel that a place lies in, u to the right and v up.
    pub fn nearest(&self, place: DVec2) -> DVec3 {
        let texel = (DVec2::new(place.x, 1.0 - place.y) * self.size()).floor();
        self.texel(texel.x, texel.y)
    }

    /// How steeply the mean of the colours rises along u and v at the texel that a place lies in, per unit of each: half the
    /// difference of its neighbours.
    pub fn slope(&self, place: DVec2) -> DVec2 {
        let texel = (DVec2::new(place.x, 1.0 - place.y) * self.size()).floor();
        let height = |x: f64, y: f64| self.texel(texel.x + x, texel.y + y).element_sum() / 3.0;
        let rise = DVec2::new(height(1.0, 0.0) - height(-1.0, 0.0), height(0.0, -1.0) - height(0.0, 1.0));
        rise * self.size() / 2.0
    }

    /// One texel of the endless repetition.
    fn texel(&self, x: f64, y: f64) -> DVec3 {
        // A remainder may round up to its divisor.
        let wrap =
            |place: f64, count: u32| (place.rem_euclid(f64::from(count)) as usize).min(count as usize - 1);
        let texel = self.texels[wrap(y, self.height) * self.width as usize + wrap(x, self.width)];
        DVec3::from(texel.map(f64::from)) / ONE
    }
}
