//! An exhibit: a system or a fault, with its cause, its pictures and its figures.

use edgewalk_golden::Fill;

/// One entry of the gallery.
#[derive(Debug, Clone, PartialEq)]
pub struct Exhibit {
    /// Of its files: `mach-bands`.
    pub name: &'static str,
    /// For a heading.
    pub title: &'static str,
    /// What is seen and why, with the source.
    pub cause: &'static str,
    /// What was measured: the quantity with its unit, and the value.
    pub figures: Vec<(String, String)>,
    /// In the order they are shown.
    pub views: Vec<View>,
}

/// A picture of an exhibit.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Told apart from the others of the exhibit: `gouraud`.
    pub name: &'static str,
    /// What is to be seen.
    pub caption: String,
    /// The picture.
    pub image: Image,
}

/// Pixels line by line from the top, or a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Image {
    /// Colours in [0, 1].
    Colors {
        /// Pixels a line.
        width: u32,
        /// Lines.
        height: u32,
        /// Red, green, blue.
        rgb: Vec<[f64; 3]>,
    },
    /// An SVG file.
    Drawing(String),
    /// Lines of text, as a command prints them.
    Text(String),
}

/// Pixels a line of the pictures.
pub(crate) const WIDTH: u32 = 320;
/// Lines of the pictures.
pub(crate) const HEIGHT: u32 = 240;
/// Guard band, pixels: that of the default machine.
pub(crate) const GUARD: f64 = 8191.0;
/// Sub-pixel bits of the default machine.
pub(crate) const SUBPIXEL_BITS: u32 = 8;
/// Exact, with these sub-pixel bits.
pub(crate) const FILL: Fill = Fill::Exact { subpixel_bits: SUBPIXEL_BITS };
/// LSB of 8 bits in 1.
pub(crate) const LSB: f64 = 255.0;

impl View {
    /// Of a picture of the usual size.
    pub(crate) fn colors(name: &'static str, caption: impl Into<String>, rgb: Vec<[f64; 3]>) -> Self {
        Self { name, caption: caption.into(), image: Image::Colors { width: WIDTH, height: HEIGHT, rgb } }
    }

    /// Of an error at every pixel: black none, white `most` and more.
    pub(crate) fn error(name: &'static str, caption: impl Into<String>, map: &[f64], most: f64) -> Self {
        let rgb = map.iter().map(|error| [(error / most).min(1.0); 3]).collect();
        Self::colors(name, caption, rgb)
    }

    /// Of a drawing.
    pub(crate) fn drawing(name: &'static str, caption: impl Into<String>, svg: String) -> Self {
        Self { name, caption: caption.into(), image: Image::Drawing(svg) }
    }

    /// Of what a command prints.
    pub(crate) fn text(name: &'static str, caption: impl Into<String>, text: String) -> Self {
        Self { name, caption: caption.into(), image: Image::Text(text) }
    }
}

/// A figure with so many decimals.
pub(crate) fn figure(quantity: impl Into<String>, value: f64, decimals: usize) -> (String, String) {
    (quantity.into(), format!("{value:.decimals$}"))
}
