//! Pictures over texture coordinates: coefficients that vary over the surface, and reliefs (A, end of chapter 7).

use glam::{DVec2, DVec3};
use std::sync::Arc;

/// A picture over texture coordinates, u to the right and v up, that repeats beyond [0, 1].
#[derive(Debug, Clone, PartialEq)]
pub enum Texture {
    /// Squares of two colours, built in.
    Checker {
        /// Squares along u and along v over [0, 1].
        squares: u32,
        /// Of the square at the origin, and of its neighbours.
        colors: [DVec3; 2],
    },
    /// From a file.
    Image(Arc<Image>),
    /// A file that is named and is not there: white.
    Absent(String),
}

/// A picture in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    /// Line by line from the top, [0, 1] each.
    texels: Vec<[f32; 3]>,
}

impl Texture {
    /// The colour at texture coordinates, [0, 1] each: bilinear between the centres of the texels.
    pub fn at(&self, place: DVec2) -> DVec3 {
        match self {
            Self::Checker { squares, colors } => {
                let square = (place * f64::from(*squares)).floor();
                colors[(square.x + square.y).rem_euclid(2.0) as usize]
            }
            Self::Image(image) => image.at(place),
            Self::Absent(_) => DVec3::ONE,
        }
    }
}

impl Image {
    fn at(&self, place: DVec2) -> DVec3 {
        let size = DVec2::new(self.width.into(), self.height.into());
        let texel = DVec2::new(place.x, 1.0 - place.y) * size - 0.5;
        let low = texel.floor();
        let part = texel - low;
        let [left, top] = [low.x, low.y];
        let line = |y: f64| self.texel(left, y).lerp(self.texel(left + 1.0, y), part.x);
        line(top).lerp(line(top + 1.0), part.y)
    }

    /// One texel of the endless repetition.
    fn texel(&self, x: f64, y: f64) -> DVec3 {
        let wrap = |place: f64, count: u32| place.rem_euclid(f64::from(count)) as usize;
        let texel = self.texels[wrap(y, self.height) * self.width as usize + wrap(x, self.width)];
        DVec3::from(texel.map(f64::from))
    }
}
