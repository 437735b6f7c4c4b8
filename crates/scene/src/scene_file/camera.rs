//! `[camera]`.

use super::table::Table;
use crate::camera::Camera;
use crate::error::InputError;
use crate::mesh::MAX_POSITION;
use glam::DVec3;

pub(super) const KEYS: &[&str] = &["eye", "target", "up", "angle", "near", "far"];

/// What is not said is as in `around`, the camera that sees everything.
pub(super) fn read(table: &Table, around: Camera) -> Result<Camera, InputError> {
    let eye = table.vector("eye", MAX_POSITION)?.unwrap_or(around.eye);
    let target = table.vector("target", MAX_POSITION)?.unwrap_or(around.target);
    let Some(sight) = (target - eye).try_normalize() else {
        return Err(table.fault("target", target, "permitted: another place than the eye"));
    };
    let up = table.direction("up")?.unwrap_or(DVec3::Y);
    if sight.cross(up).length() < 1e-6 {
        return Err(table.fault("up", up, "permitted: a direction not along the line of sight"));
    }
    let distance = eye.distance(target);
    // The planes of `around` hold for its own eye.
    let (near, far) = if eye == around.eye && target == around.target {
        (around.near, around.far)
    } else {
        (distance / 100.0, distance * 100.0)
    };
    let near = table.number("near", 1e-9..=MAX_POSITION)?.unwrap_or(near);
    let far = table.number("far", 1e-9..=1e3 * MAX_POSITION)?.unwrap_or(far);
    if far <= near {
        return Err(table.fault("far", far, format!("permitted: beyond the near plane at {near}")));
    }
    let angle = table.number("angle", 0.001..=179.0)?.map_or(around.angle, f64::to_radians);
    Ok(Camera { eye, target, up, angle, near, far })
}
