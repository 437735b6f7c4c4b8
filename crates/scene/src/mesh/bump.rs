//! Bump mapping: a relief over texture coordinates turns the normal (end of ch. 7; Blinn's construction).
//!
//! ```text
//!   surface moved along N by B(u, v):   N' = N + (B_u N x P_v - B_v N x P_u) / |P_u x P_v|, to length 1
//!   P_u, P_v   how far the point moves in the world for a unit of u, of v: constant over a face
//! ```
//! Seen from behind, the relief is the same one from its other side. A face whose texture coordinates span no area has
//! no direction to turn the normal in and keeps it.

use super::Mesh;
use glam::{DVec2, DVec3};

impl Mesh {
    /// The normal of a face, by its place, at texture coordinates, `normal` (a unit vector) turned by the relief of its
    /// material; unchanged where there is none.
    pub fn bumped_normal(&self, face: u32, texture: DVec2, normal: DVec3) -> DVec3 {
        (normal + self.turn(face, texture, normal)).try_normalize().unwrap_or(normal)
    }

    /// What the relief of its material adds to a normal of a face: linear in the normal, 0 where there is no relief.
    pub fn turn(&self, face: u32, texture: DVec2, normal: DVec3) -> DVec3 {
        let corners = &self.faces[face as usize];
        let material = &self.materials[corners.material as usize];
        let relief = material.bump.and_then(|place| self.textures.get(place as usize));
        let (Some(relief), Some(places)) = (relief, self.face_data[face as usize].texture) else {
            return DVec3::ZERO;
        };
        let Some([along_u, along_v]) = tangents(self.corners(corners), places) else { return DVec3::ZERO };
        let slope = relief.slope(texture) * material.bump_height;
        let turned = slope.x * normal.cross(along_v) - slope.y * normal.cross(along_u);
        turned / along_u.cross(along_v).length()
    }

    /// T_u and T_v of a face: for each unit that the relief of its material, of this height, rises by a unit of u a normal grows
    /// by N x T_u, of v by N x T_v; 0 where it has no direction to turn in.
    pub(crate) fn turns(&self, face: u32, height: f64) -> [DVec3; 2] {
        let places = self.face_data[face as usize].texture;
        let spanned = places.and_then(|places| tangents(self.corners(&self.faces[face as usize]), places));
        spanned.map_or([DVec3::ZERO; 2], |[along_u, along_v]| {
            let scale = height / along_u.cross(along_v).length();
            [along_v * scale, -along_u * scale]
        })
    }
}

/// P_u and P_v; `None` where they span no area.
fn tangents([p, q, r]: [DVec3; 3], [at_p, at_q, at_r]: [DVec2; 3]) -> Option<[DVec3; 2]> {
    let (to_q, to_r, q, r) = (at_q - at_p, at_r - at_p, q - p, r - p);
    let area = to_q.perp_dot(to_r);
    let tangents = [(q * to_r.y - r * to_q.y) / area, (r * to_q.x - q * to_r.x) / area];
    let spanned = tangents[0].cross(tangents[1]).length();
    (spanned.is_finite() && spanned > 0.0).then_some(tangents)
}
