//! `--shadows`: where the shadow factor r_l of a light comes from.

use edgewalk_golden::{Rays, ShadowMaps, Visibility};
use edgewalk_scene::Scene;

/// Where the shadow factor of a light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Shadows {
    /// No light casts shadows
    Off,
    /// Depth maps of 1024 x 1024 texels: glass weakens the light by its k_t
    Map,
    /// Rays: glass weakens the light
    Ray,
}

/// Texels a side of a depth map.
const SIZE: u32 = 1024;

impl Shadows {
    /// The shadows of the golden picture.
    pub fn golden(self, scene: &Scene) -> Visibility<'_> {
        match self {
            Self::Off => Visibility::Full,
            Self::Map => Visibility::Maps(ShadowMaps::draw(scene, SIZE)),
            Self::Ray => Visibility::Rays(Rays::new(&scene.mesh)),
        }
    }
}
