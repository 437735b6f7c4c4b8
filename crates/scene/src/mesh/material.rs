//! How a surface answers light: the coefficients of ch. 7.1.

use glam::DVec3;

/// The coefficients of the shading equation (ch. 7.1) for red, green, blue.
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
    /// Transmission coefficient k_t in [0, 1]: 0 for an opaque surface. The others are then the corrected ones of ch. 7.5,
    /// (1 - k_t) times which the surface reflects.
    pub transmission: f64,
    /// Place in the list of textures: the picture that k_d and k_a are multiplied with.
    pub texture: Option<u32>,
    /// Place in the list of textures: the picture that k_s is multiplied with, and n with the mean of its colours.
    pub gloss: Option<u32>,
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
            gloss: None,
            bump: None,
            bump_height: 0.0,
        }
    }

    /// The same from coefficients that are not corrected: divided by (1 - k_t), so that (1 - k_t) I* + k_t I_back (ch. 7.5) is
    /// I_ref + k_t I_back (ch. 7.4). `None` if a surface would reflect and transmit more than it receives: k_a, k_d or k_s
    /// with k_t over 1. A surface with k_t = 1 emits nothing.
    pub fn corrected(self) -> Option<Self> {
        let part = 1.0 - self.transmission;
        let corrected = |k: DVec3| if part > 0.0 { k / part } else { k };
        let most = self.ambient.max(self.diffuse).max(self.specular).max_element();
        let emission = if part > 0.0 { self.emission / part } else { DVec3::ZERO };
        // Division may round a sum of 1 up.
        let within = |k: DVec3| corrected(k).min(DVec3::ONE);
        (most <= part).then(|| Self {
            emission,
            ambient: within(self.ambient),
            diffuse: within(self.diffuse),
            specular: within(self.specular),
            ..self
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corrected_coefficients_give_the_same_surface() {
        let plain = Material {
            emission: DVec3::new(0.2, 0.0, 0.1),
            specular: DVec3::splat(0.3),
            transmission: 0.6,
            ..Material::matte(DVec3::new(0.1, 0.2, 0.4))
        };
        let corrected = plain.corrected().expect("0.4 and 0.6 are 1");
        for (k, star) in [
            (plain.emission, corrected.emission),
            (plain.ambient, corrected.ambient),
            (plain.diffuse, corrected.diffuse),
            (plain.specular, corrected.specular),
        ] {
            // ch. 7.4 and ch. 7.5 with I_back = 0.5.
            assert!((k + 0.6 * 0.5 - (0.4 * star + 0.6 * 0.5)).abs().max_element() < 1e-15);
        }
        assert_eq!(Material { transmission: 0.7, ..plain }.corrected(), None, "0.4 and 0.7");
        let clear = Material { transmission: 1.0, ..Material::matte(DVec3::ZERO) };
        assert_eq!(clear.corrected(), Some(clear));
        assert_eq!(Material::DEFAULT.corrected(), Some(Material::DEFAULT), "an opaque one");
    }
}
