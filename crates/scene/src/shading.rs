//! The shading equation, at a point, in world space.
//!
//! ```text
//!        N   H  V            I = I_e + k_a I_a + sum over the lights l of
//!    R   |  /  /                     r_l I_l k_d max(N L, 0) + r_l I_l k_s cos^n       (ch. 7.1, 7.12)
//!     \  | /  /  L
//!      \ |/  / ,'            N normal, L to the light, V to the viewer: unit vectors
//!   ----------------         R = 2 (N L) N - L, H = (L + V) / |L + V|
//! ```
//! Facing: N points to the side of the polygon that is seen. A polygon seen from behind is lit there, with its normals
//! turned over; which side is seen is a matter of the polygon's plane, so a vertex normal may still point away from the
//! viewer near a silhouette. What light comes from below the surface (N L <= 0) gives neither a diffuse nor a specular
//! part. Ambient light and emission come from everywhere.
//!
//! r_l (ch. 7.2) is left to the caller: the parts stand apart in [`Terms`]. The transmitted part k_t I_t is blending (ch. 7.5).

use crate::light::Light;
use crate::mesh::Material;
use glam::DVec3;

/// The form of the specular part: what stands for cos psi, whose n-th power is taken. All are 1 where the viewer looks
/// straight into the mirrored beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Specular {
    /// R V, the angle between the viewer and the mirrored beam (ch. 7.1).
    #[default]
    Mirror,
    /// 2 (N H)² - 1, the cosine of twice the angle between N and H (ch. 7.12): the mirror form where N lies in the plane
    /// of L and V.
    Halfway,
    /// N H, of half that angle: a highlight about twice as wide, the form that fast Phong shading tabulates.
    Blinn,
}

impl Specular {
    /// All three, in the order of [`Self::NAMES`].
    pub const ALL: [Self; 3] = [Self::Mirror, Self::Halfway, Self::Blinn];
    /// The names in files and on the command line.
    pub const NAMES: [&'static str; 3] = ["mirror", "halfway", "blinn"];

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// The cosine, cut to [0, 1]: beyond a right angle there is no highlight, whatever the exponent.
    fn cosine(self, normal: DVec3, toward: DVec3, viewer: DVec3) -> f64 {
        let halfway = || normal.dot((toward + viewer).normalize_or_zero()).max(0.0);
        let cosine = match self {
            Self::Mirror => (2.0 * normal.dot(toward) * normal - toward).dot(viewer),
            Self::Halfway => 2.0 * halfway().powi(2) - 1.0,
            Self::Blinn => halfway(),
        };
        cosine.clamp(0.0, 1.0)
    }
}

/// A point of a surface, in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Where it is.
    pub position: DVec3,
    /// Unit normal N on the side that is seen.
    pub normal: DVec3,
    /// Unit vector V to the viewer.
    pub viewer: DVec3,
}

/// What one light adds while nothing hides it (r_l = 1).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LightTerms {
    /// I_l k_d max(N L, 0).
    pub diffuse: DVec3,
    /// I_l k_s cos^n.
    pub specular: DVec3,
}

/// The parts of the equation, apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Terms {
    /// I_e.
    pub emission: DVec3,
    /// k_a I_a.
    pub ambient: DVec3,
    /// In the order of the lights.
    pub lights: Vec<LightTerms>,
}

impl Terms {
    /// The sum, each light's part times its r_l in [0, 1] (ch. 7.2); not cut to [0, 1].
    pub fn total(&self, r: impl Fn(usize) -> f64) -> DVec3 {
        let parts = self.lights.iter().enumerate();
        let lights: DVec3 = parts.map(|(l, part)| r(l) * (part.diffuse + part.specular)).sum();
        self.emission + self.ambient + lights
    }
}

/// All the light of a scene, and how highlights are reckoned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lighting<'a> {
    /// Intensity I_a of ambient light.
    pub ambient: DVec3,
    /// The other lights.
    pub lights: &'a [Light],
    /// Form of the specular part.
    pub specular: Specular,
}

impl Lighting<'_> {
    /// The parts of the equation at a point, each for itself.
    pub fn terms(&self, material: &Material, point: &Point) -> Terms {
        Terms {
            emission: material.emission,
            ambient: material.ambient * self.ambient,
            lights: self.lights.iter().map(|light| self.light_terms(light, material, point)).collect(),
        }
    }

    /// The whole equation with no light hidden; not cut to [0, 1].
    pub fn shade(&self, material: &Material, point: &Point) -> DVec3 {
        let parts = self.lights.iter().map(|light| self.light_terms(light, material, point));
        let lights: DVec3 = parts.map(|part| part.diffuse + part.specular).sum();
        material.emission + material.ambient * self.ambient + lights
    }

    /// The equation of constant shading (ch. 7.6): neither highlights nor shadows; not cut to [0, 1].
    pub fn constant(&self, material: &Material, position: DVec3, normal: DVec3) -> DVec3 {
        let diffuse = self.lights.iter().map(|light| {
            let incident = light.incident(position);
            incident.intensity * material.diffuse * normal.dot(incident.toward).max(0.0)
        });
        material.emission + material.ambient * self.ambient + diffuse.sum::<DVec3>()
    }

    /// What one light adds while nothing hides it.
    pub fn light_terms(&self, light: &Light, material: &Material, point: &Point) -> LightTerms {
        let incident = light.incident(point.position);
        let cosine = point.normal.dot(incident.toward);
        if cosine <= 0.0 {
            return LightTerms::default();
        }
        let diffuse = incident.intensity * material.diffuse * cosine;
        if material.specular == DVec3::ZERO {
            return LightTerms { diffuse, specular: DVec3::ZERO };
        }
        let highlight =
            self.specular.cosine(point.normal, incident.toward, point.viewer).powf(material.exponent);
        LightTerms { diffuse, specular: incident.intensity * material.specular * highlight }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Attenuation;

    fn light(toward: DVec3) -> Light {
        Light::Directional { toward, intensity: DVec3::splat(0.8) }
    }

    fn under<'a>(lights: &'a [Light], specular: Specular) -> Lighting<'a> {
        Lighting { ambient: DVec3::splat(0.1), lights, specular }
    }

    fn seen_along(normal: DVec3, viewer: DVec3) -> Point {
        Point { position: DVec3::ZERO, normal, viewer }
    }

    #[test]
    fn lambert_by_the_cosine_and_no_light_from_behind() {
        let material = Material::matte(DVec3::new(0.5, 1.0, 0.0));
        let lights = [light(DVec3::Y)];
        let at = |normal| under(&lights, Specular::Mirror).shade(&material, &seen_along(normal, normal));
        assert!(at(DVec3::Y).distance(DVec3::new(0.45, 0.9, 0.0)) < 1e-15);
        assert!(at(DVec3::new(0.0, 0.5, 0.75f64.sqrt())).distance(DVec3::new(0.25, 0.5, 0.0)) < 1e-15);
        assert_eq!(at(DVec3::NEG_Y), DVec3::new(0.05, 0.1, 0.0));
    }

    /// The angle of the viewer from the mirrored beam, and the cosine each form has for it by hand: light 20 degrees to
    /// one side of the normal, viewer in the same plane.
    #[test]
    fn highlight_forms_by_hand() {
        let tilted = |degrees: f64| DVec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0);
        let cosine = |form: Specular, viewer: f64| form.cosine(DVec3::Y, tilted(-20.0), tilted(viewer));
        for off in [0.0, 10.0, 35.0, 60.0] {
            let expected =
                [f64::to_radians(off).cos(), f64::to_radians(off).cos(), f64::to_radians(off / 2.0).cos()];
            for (form, expected) in Specular::ALL.into_iter().zip(expected) {
                assert!((cosine(form, 20.0 + off) - expected).abs() < 1e-12, "{form:?} {off}");
            }
        }
        // Out of that plane the two forms part.
        let aside = DVec3::new(0.3, 0.8, 0.5).normalize();
        let [mirror, halfway] =
            [Specular::Mirror, Specular::Halfway].map(|form| form.cosine(DVec3::Y, tilted(-20.0), aside));
        assert!((mirror - halfway).abs() > 0.01, "{mirror} {halfway}");
    }

    #[test]
    fn forms_agree_at_the_peak_and_end_at_a_right_angle() {
        let (normal, toward) =
            (DVec3::new(0.2, 0.9, -0.1).normalize(), DVec3::new(-0.5, 0.7, 0.3).normalize());
        let mirrored = 2.0 * normal.dot(toward) * normal - toward;
        for form in Specular::ALL {
            assert!((form.cosine(normal, toward, mirrored) - 1.0).abs() < 1e-12, "{form:?}");
        }
        // An even exponent must not light the far side.
        let material = Material { specular: DVec3::ONE, exponent: 2.0, ..Material::matte(DVec3::ZERO) };
        let lights = [light(DVec3::Y)];
        for form in [Specular::Mirror, Specular::Halfway] {
            let point = seen_along(DVec3::Y, DVec3::new(0.999, -0.05, 0.0).normalize());
            assert_eq!(
                under(&lights, form).terms(&material, &point).lights[0].specular,
                DVec3::ZERO,
                "{form:?}"
            );
        }
    }

    #[test]
    fn terms_add_up_and_each_light_is_gated_alone() {
        let material = Material {
            emission: DVec3::new(0.01, 0.02, 0.03),
            ambient: DVec3::splat(0.5),
            specular: DVec3::splat(0.4),
            exponent: 12.0,
            ..Material::matte(DVec3::new(0.3, 0.2, 0.1))
        };
        let lamp = Light::Positional {
            position: DVec3::new(1.0, 2.0, 0.0),
            intensity: DVec3::splat(0.7),
            attenuation: Attenuation::NONE,
        };
        let lights = [light(DVec3::Y), lamp];
        let lighting = under(&lights, Specular::Halfway);
        let point = seen_along(DVec3::Y, DVec3::new(0.1, 1.0, 0.1).normalize());
        let terms = lighting.terms(&material, &point);
        assert_eq!((terms.emission, terms.ambient), (material.emission, DVec3::splat(0.05)));
        assert!(terms.lights.iter().all(|part| part.diffuse.x > 0.0 && part.specular.x > 0.0));
        assert!(terms.total(|_| 1.0).distance(lighting.shade(&material, &point)) < 1e-15);
        let second = terms.lights[1];
        let without = terms.total(|l| if l == 1 { 0.0 } else { 1.0 });
        assert!((terms.total(|_| 1.0) - without).distance(second.diffuse + second.specular) < 1e-15);
        let flat = lighting.constant(&material, point.position, point.normal);
        let diffuse: DVec3 = terms.lights.iter().map(|part| part.diffuse).sum();
        assert!(flat.distance(terms.emission + terms.ambient + diffuse) < 1e-15, "ch. 7.6 has no highlight");
    }
}
