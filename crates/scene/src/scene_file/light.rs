//! `[[light]]`.

use super::table::Table;
use crate::error::InputError;
use crate::light::{Attenuation, Light};
use crate::mesh::MAX_POSITION;
use glam::DVec3;
use std::f64::consts::FRAC_PI_4;

pub(super) const KEYS: &[&str] =
    &["kind", "toward", "position", "axis", "cone", "exponent", "intensity", "attenuation"];

/// Which keys, beside kind and intensity, each kind has.
const KINDS: [(&str, &[&str]); 3] = [
    ("directional", &["toward"]),
    ("positional", &["position", "attenuation"]),
    ("flood", &["position", "axis", "cone", "exponent", "attenuation"]),
];

/// Largest intensity and coefficient of attenuation.
const MAX_INTENSITY: f64 = 1e6;

pub(super) fn read(table: &Table) -> Result<Light, InputError> {
    let names = KINDS.map(|(name, _)| name);
    let kind = table.choice("kind", &names)?;
    let kind = table.required("kind", kind, "permitted: directional positional flood")?;
    let (name, own) = KINDS[kind];
    table.only(KEYS, &[&["kind", "intensity"], own].concat(), &format!("a {name} light"))?;
    let intensity = table.color("intensity", MAX_INTENSITY)?.unwrap_or(DVec3::ONE);
    let direction = |key: &str| {
        let direction = table.direction(key)?;
        table.required(key, direction, "permitted: [x, y, z]")
    };
    let position = || {
        let position = table.vector("position", MAX_POSITION)?;
        table.required("position", position, "permitted: [x, y, z]")
    };
    Ok(match kind {
        0 => Light::Directional { toward: direction("toward")?, intensity },
        1 => Light::Positional { position: position()?, intensity, attenuation: attenuation(table)? },
        _ => Light::Flood {
            position: position()?,
            axis: direction("axis")?,
            cone: table.number("cone", 0.001..=90.0)?.map_or(FRAC_PI_4, f64::to_radians),
            exponent: table.number("exponent", 0.0..=1000.0)?.unwrap_or(0.0),
            intensity,
            attenuation: attenuation(table)?,
        },
    })
}

/// `[constant, linear, quadratic]`.
fn attenuation(table: &Table) -> Result<Attenuation, InputError> {
    let Some(given) = table.vector("attenuation", MAX_INTENSITY)? else { return Ok(Attenuation::NONE) };
    if given.min_element() < 0.0 || given.max_element() == 0.0 {
        let permitted = "permitted: [constant, linear, quadratic], none negative and not all of them 0";
        return Err(table.fault("attenuation", given, permitted));
    }
    Ok(Attenuation { constant: given.x, linear: given.y, quadratic: given.z })
}
