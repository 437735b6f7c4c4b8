//! Ways of shading by their names on the command line.

use anyhow::{Result, anyhow};
use edgewalk_golden::Shading;
use edgewalk_host::input::Shaded;
use edgewalk_machine::{Machine, ShadeKind, Unknown};
use edgewalk_scene::PixelMethod;

/// What a machine can draw.
pub const SHADINGS: [(&str, Shaded); 5] = [
    ("constant", Shaded::Corners(Shading::Constant)),
    ("constant-averaged", Shaded::Corners(Shading::ConstantAveraged)),
    ("gouraud", Shaded::Corners(Shading::Gouraud)),
    ("phong", Shaded::Pixels(PixelMethod::Phong)),
    ("fast-phong", Shaded::Pixels(PixelMethod::FastPhong)),
];

/// The way of shading of that name, with the name.
///
/// # Errors
/// The machine does not draw so.
pub fn named(name: &str) -> Result<(&'static str, Shaded)> {
    let found = SHADINGS.into_iter().find(|(known, _)| *known == name);
    found.ok_or_else(|| anyhow!(Unknown::new("shading of a machine", name, SHADINGS.map(|(name, _)| name))))
}

/// The name of the way in which a machine shades where nothing else is asked for: `gouraud` without SHADE.
#[must_use]
pub fn of_machine(machine: &Machine) -> &'static str {
    match machine.shade.kind {
        ShadeKind::None => "gouraud",
        ShadeKind::FastPhong => "fast-phong",
        ShadeKind::Phong => "phong",
    }
}
