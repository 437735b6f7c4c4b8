//! What a mesh file says of a face beyond where its corners are.

use glam::{DVec2, DVec3};

/// Texture coordinates, normals, smoothing group and polygon of a face.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FaceData {
    /// Texture coordinates of the corners: u to the right, v up.
    pub texture: Option<[DVec2; 3]>,
    /// Unit normals of the corners.
    pub normals: Option<[DVec3; 3]>,
    /// Smoothing group: faces of one group look like one surface; group 0 smooths nothing.
    pub group: u32,
    /// Another part of the polygon that the face before is a part of.
    pub continues: bool,
}
