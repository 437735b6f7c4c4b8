//! How a surface answers light: the coefficients of A 7.1.

use glam::DVec3;

/// The coefficients of the shading equation (A 7.1) for red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Own emission I_e, not negative.
    pub emission: DVec3,
    /// Ambient coefficient k_a in [0, 1].
    pub ambient: DVec3,
    /// Diffuse coefficient k_d in [0, 1].
    pub diffuse: DVec3,
    /// Specular coefficient k_s in [0, 1].
    pub specular: DVec3,
    /// Specular exponent n, 0 and more.
    pub exponent: f64,
    /// Transmission coefficient k_t in [0, 1]: 0 for an opaque surface. The others are then the corrected ones of A 7.5,
    /// (1 - k_t) times which the surface reflects.
    pub transmission: f64,
    /// Place in the list of textures: the picture that k_d and k_a are multiplied with.
    pub texture: Option<u32>,
    /// Place in the list of textures: the relief whose slopes turn the normal.
    pub bump: Option<u32>,
    /// Height of white in `bump` above black, units of length.
    pub bump_height: f64,
}

impl Material {
    /// What a surface without a material is made of: light grey, matte.
    pub const DEFAULT: Self = Self::matte(DVec3::splat(0.8));

    /// Diffuse and ambient alike, no highlight.
    pub const fn matte(diffuse: DVec3) -> Self {
        Self {
            emission: DVec3::ZERO,
            ambient: diffuse,
            diffuse,
            specular: DVec3::ZERO,
            exponent: 1.0,
            transmission: 0.0,
            texture: None,
            bump: None,
            bump_height: 0.0,
        }
    }
}
