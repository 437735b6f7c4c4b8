//! A torus knot: a tube along a curve on a torus.

use super::surface::closed_net;
use super::{Material, Mesh};
use crate::error::InputError;
use glam::DVec3;

/// Turns of the curve about the axis, and through the hole meanwhile.
const TURNS: (f64, f64) = (2.0, 3.0);
/// Radii: of the torus to the middle of its tube, of that tube, of the tube along the curve.
const RADII: (f64, f64, f64) = (1.0, 0.45, 0.22);

/// The trefoil: `along` rings of `across` corners.
pub(crate) fn torus_knot(along: u32, across: u32) -> Result<Mesh, InputError> {
    let (positions, faces, texture) = closed_net(along, across, |u, v| {
        // The normal of the torus is at right angles to a curve on it, and returns with it: the tube closes.
        let ((s, c), (sin, cos)) = ((TURNS.0 * u).sin_cos(), (TURNS.1 * u).sin_cos());
        let outward = DVec3::new(c, 0.0, s);
        let normal = outward * cos + DVec3::Y * sin;
        let reach = RADII.0 + RADII.1 * cos;
        let tangent = DVec3::new(-s, 0.0, c) * (TURNS.0 * reach)
            + (DVec3::Y * cos - outward * sin) * (TURNS.1 * RADII.1);
        let side = normal.cross(tangent).normalize();
        let centre = outward * RADII.0 + normal * RADII.1;
        let (v_sin, v_cos) = v.sin_cos();
        centre + (normal * v_cos + side * v_sin) * RADII.2
    });
    let jade = Material::matte(DVec3::new(0.3, 0.7, 0.5));
    Ok(Mesh::new("torus-knot", positions, faces, vec![jade])?.with_face_data(texture))
}
