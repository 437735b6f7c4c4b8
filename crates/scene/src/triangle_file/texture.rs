//! The lines `texture` and `UV`: the texels of a material, and where in them the vertices lie.

use super::shading::NEEDS_MODE;
use crate::error::InputError;
use crate::frame::MAX_COORDINATE;
use crate::pixel_shading::PixelShading;
use crate::text::Place;
use crate::texture::Image;
use std::io::{self, Write};

/// Texels a line and lines, at most: all of them fit a line of the file.
const MAX_SIDE: u32 = 1024;

/// Sides and texels behind `texture`.
pub(super) fn texels<'a>(
    place: Place,
    mut words: impl Iterator<Item = &'a [u8]>,
) -> Result<Image, InputError> {
    let mut side = |key: &str| {
        let word = words.next().unwrap_or_default();
        place.number(format_args!("texture {key}"), word, "an integer", 1..=MAX_SIDE)
    };
    let (width, height) = (side("W")?, side("H")?);
    let mut texels = Vec::new();
    for (at, word) in words.enumerate() {
        let texel = colors(word).ok_or_else(|| {
            let why = "permitted: 6 hex digits rrggbb, or 12 of them, rrrrggggbbbb";
            place.fault(format_args!("texture texel {}", at + 1), word, why)
        })?;
        texels.push(texel);
    }
    let found = format!("{} given", texels.len());
    Image::of(width, height, texels).ok_or_else(|| {
        let why = format!("permitted: {} texels behind W and H, {height} lines of {width}", width * height);
        place.fault("texture", found.as_bytes(), why).into()
    })
}

/// Red, green, blue of 8 or 16 bits each; 65535 is 1.
fn colors(word: &[u8]) -> Option<[u16; 3]> {
    let digits = match word.len() {
        6 => 2,
        12 => 4,
        _ => return None,
    };
    let mut colors = [0; 3];
    for (color, word) in colors.iter_mut().zip(word.chunks_exact(digits)) {
        let digit = |byte: &u8| char::from(*byte).to_digit(16);
        let number = word.iter().try_fold(0, |number, byte| Some(number << 4 | digit(byte)?))?;
        *color = if digits == 2 { number * 0x101 } else { number } as u16; // of 4 digits
    }
    Some(colors)
}

/// What stands behind `UV`.
const VALUES: &str = "u v of vertex 1, then of 2, then of 3";

/// The numbers behind `UV` into the triangle that is open, if one is.
pub(super) fn coordinates<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    open: bool,
    shading: Option<&mut PixelShading>,
) -> Result<(), InputError> {
    let Some(shading) = shading else {
        return Err(place.fault("line starts with", b"UV", NEEDS_MODE).into());
    };
    let Some(triangle) = shading.triangles.last_mut().filter(|_| open) else {
        let why = "permitted once, behind a triangle `T` of a material with a `texture`";
        return Err(place.fault("line starts with", b"UV", why).into());
    };
    let words: [&[u8]; 6] = place.values("UV", VALUES, words)?;
    for (vertex, (slot, words)) in triangle.texture.iter_mut().zip(words.chunks_exact(2)).enumerate() {
        for (axis, word) in words.iter().enumerate() {
            let key = format_args!("UV vertex {} {}", vertex + 1, ["u", "v"][axis]);
            slot[axis] = place.number(key, word, "a number", -MAX_COORDINATE..=MAX_COORDINATE)?;
        }
    }
    Ok(())
}

/// The triangle of this line has no texture coordinates, and `before` comes.
pub(super) fn missing(place: Place, before: &[u8], line: usize) -> InputError {
    let why = format!(
        "the `UV` of the triangle in line {line} is missing, as its material has a `texture`; permitted: 6 values, {VALUES}"
    );
    place.fault("UV", before, why).into()
}

/// Writes the line `texture`.
pub(super) fn write(image: &Image, out: &mut impl Write) -> io::Result<()> {
    let [width, height] = image.sides();
    if width.max(height) > MAX_SIDE {
        let what = format!(
            "a texture of {width} x {height} texels; a triangle file has at most {MAX_SIDE} each way"
        );
        return Err(io::Error::new(io::ErrorKind::Unsupported, what));
    }
    write!(out, "texture {width} {height} ")?;
    for [r, g, b] in image.texels() {
        match [r, g, b].map(|color| (color / 0x101, color % 0x101)) {
            [(r, 0), (g, 0), (b, 0)] => write!(out, " {r:02x}{g:02x}{b:02x}")?,
            _ => write!(out, " {r:04x}{g:04x}{b:04x}")?,
        }
    }
    writeln!(out)
}
