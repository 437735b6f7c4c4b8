//! Pictures for eyes: the frame, and the error as a heat map.

use crate::staging::Staging;
use anyhow::{Context, Result};
use image::{Rgb, RgbImage};

/// Writes colours in [0,1] as an 8-bit PNG.
pub fn write_rgb(out: &Staging, name: &str, width: u32, height: u32, rgb: &[[f64; 3]]) -> Result<()> {
    let byte = |v: f64| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
    write(out, name, width, height, |i| rgb[i].map(byte))
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

fn write(out: &Staging, name: &str, width: u32, height: u32, pixel: impl Fn(usize) -> [u8; 3]) -> Result<()> {
    let picture = RgbImage::from_fn(width, height, |x, y| Rgb(pixel((y * width + x) as usize)));
    let path = out.path(name)?;
    picture.save(&path).with_context(|| format!("{}", path.display()))
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
