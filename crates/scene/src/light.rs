//! Lights: the abstract light sources of ch. 7.1, in world space.
//!
//! The source names three kinds and leaves open how intensity falls with distance and direction; the two
//! functions here, [`Attenuation`] and the power of the cosine of a flood, are the usual ones. Both are 1 by
//! default.

use glam::DVec3;

/// A light source; its intensity is I_l for red, green, blue, not negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// So far away that its rays are parallel.
    Directional {
        /// Unit vector L from every surface towards the light.
        toward: DVec3,
        /// I_l.
        intensity: DVec3,
    },
    /// A point that shines alike in all directions.
    Positional {
        /// Where it stands.
        position: DVec3,
        /// I_l where the attenuation is 1.
        intensity: DVec3,
        /// How it weakens with distance.
        attenuation: Attenuation,
    },
    /// A point that shines along an axis, weaker beside it: I_l cos^exponent of the angle to the axis inside
    /// the cone, 0 outside.
    Flood {
        /// Where it stands.
        position: DVec3,
        /// Unit vector from the light to the middle of what it lights.
        axis: DVec3,
        /// Half the opening angle of the cone, radians in (0, pi/2].
        cone: f64,
        /// Power of the cosine, 0 and more; 0 is alike all over the cone.
        exponent: f64,
        /// I_l on the axis where the attenuation is 1.
        intensity: DVec3,
        /// How it weakens with distance.
        attenuation: Attenuation,
    },
}

/// 1 / (constant + linear d + quadratic d²) at the distance d; no coefficient is negative and their sum is
/// not 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attenuation {
    /// Without unit.
    pub constant: f64,
    /// Per unit of length.
    pub linear: f64,
    /// Per unit of length squared.
    pub quadratic: f64,
}

impl Attenuation {
    /// As strong at any distance: the equations of ch. 7.1 as they stand.
    pub const NONE: Self = Self { constant: 1.0, linear: 0.0, quadratic: 0.0 };

    /// The factor at a distance; at most 1 / [`Self::NEAREST`], so that a light on a surface stays finite.
    pub fn factor(&self, distance: f64) -> f64 {
        1.0 / (self.constant + distance * (self.linear + distance * self.quadratic)).max(Self::NEAREST)
    }

    /// Least divisor.
    pub const NEAREST: f64 = 1e-6;
}

/// What arrives at a point from a light that nothing hides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incident {
    /// Unit vector L towards the light; zero at the very place of the light.
    pub toward: DVec3,
    /// I_l at the point.
    pub intensity: DVec3,
}

impl Light {
    /// I_l where nothing weakens it.
    pub fn intensity(&self) -> DVec3 {
        match *self {
            Self::Directional { intensity, .. }
            | Self::Positional { intensity, .. }
            | Self::Flood { intensity, .. } => intensity,
        }
    }

    /// The same light with a cone wider by so much of the cosine of half its angle, or narrower; another than
    /// a flood as it is.
    #[must_use]
    pub fn opened(self, by: f64) -> Self {
        match self {
            Self::Flood { position, axis, cone, exponent, intensity, attenuation } => {
                let cone = (cone.cos() - by).clamp(-1.0, 1.0).acos();
                Self::Flood { position, axis, cone, exponent, intensity, attenuation }
            }
            other => other,
        }
    }

    /// What arrives at a point in world space.
    pub fn incident(&self, point: DVec3) -> Incident {
        match *self {
            Self::Directional { toward, intensity } => Incident { toward, intensity },
            Self::Positional { position, intensity, attenuation } => {
                from_point(position - point, intensity, attenuation)
            }
            Self::Flood { position, axis, cone, exponent, intensity, attenuation } => {
                let incident = from_point(position - point, intensity, attenuation);
                let cosine = axis.dot(-incident.toward);
                let beam = if cosine >= cone.cos() { cosine.max(0.0).powf(exponent) } else { 0.0 };
                Incident { intensity: incident.intensity * beam, ..incident }
            }
        }
    }
}

fn from_point(way: DVec3, intensity: DVec3, attenuation: Attenuation) -> Incident {
    Incident { toward: way.normalize_or_zero(), intensity: intensity * attenuation.factor(way.length()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_weakens_with_distance_and_shines_from_where_it_stands() {
        let attenuation = Attenuation { constant: 1.0, linear: 0.5, quadratic: 0.25 };
        let light =
            Light::Positional { position: DVec3::new(0.0, 4.0, 0.0), intensity: DVec3::ONE, attenuation };
        let below = light.incident(DVec3::new(0.0, 2.0, 0.0));
        assert_eq!((below.toward, below.intensity), (DVec3::Y, DVec3::splat(1.0 / 3.0)));
        assert_eq!(light.incident(DVec3::new(3.0, 4.0, 0.0)).toward, DVec3::NEG_X);
        let inside = Light::Positional {
            position: DVec3::ZERO,
            intensity: DVec3::ONE,
            attenuation: Attenuation { constant: 0.0, linear: 0.0, quadratic: 1.0 },
        };
        assert!(inside.incident(DVec3::ZERO).intensity.is_finite());
    }

    #[test]
    fn a_flood_ends_at_its_cone() {
        let flood = |cone: f64, exponent: f64| Light::Flood {
            position: DVec3::Y,
            axis: DVec3::NEG_Y,
            cone,
            exponent,
            intensity: DVec3::ONE,
            attenuation: Attenuation::NONE,
        };
        let at =
            |light: Light, degrees: f64| light.incident(DVec3::X * degrees.to_radians().tan()).intensity.x;
        assert_eq!(
            [0.0, 29.999_999, 30.000_001, 80.0].map(|degrees| at(flood(30f64.to_radians(), 0.0), degrees)),
            [1.0, 1.0, 0.0, 0.0]
        );
        assert!((at(flood(1.5, 3.0), 60.0) - 0.125).abs() < 1e-12, "the cube of the cosine");
        let behind = flood(1.5, 3.0).incident(DVec3::new(0.0, 2.0, 0.0));
        assert_eq!(behind.intensity, DVec3::ZERO);
    }
}
