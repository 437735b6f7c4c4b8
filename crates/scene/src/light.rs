//! Lights.

use glam::DVec3;

/// A light so far away that its rays are parallel (A 7.1, directional).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionalLight {
    /// Unit vector from the surface towards the light, L in A 7.6.
    pub toward: DVec3,
    /// Intensity I_l for red, green, blue.
    pub intensity: DVec3,
}
