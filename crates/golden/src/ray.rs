//! r_l by rays: which faces lie between a point and a light (ch. 7.2, all three cases).
//!
//! "The more general case can be solved by ray-tracing": a ray from the point to the light; r_l is the product of k_t of
//! all faces it meets, so 1 where there is none and 0 behind an opaque one. Each face counts, so a body of glass counts
//! twice, where the ray enters and where it leaves. Directions are those of ch. 7: nothing is bent.

mod hit;
mod tree;

use edgewalk_scene::{Light, Mesh};
use glam::DVec3;
use hit::Ray;
use tree::Tree;

/// Nearer than this to its start, as a part of the diagonal of the box around the mesh, a ray meets nothing: rounding puts
/// a point on one side of its own polygon or the other.
const LEAST: f64 = 1e-9;

/// All faces of a mesh, sorted for rays.
pub struct Rays<'a> {
    mesh: &'a Mesh,
    tree: Tree,
    least: f64,
}

impl<'a> Rays<'a> {
    /// Sorts the faces of a mesh.
    pub fn new(mesh: &'a Mesh) -> Self {
        let [low, high] = mesh.bounds();
        Self { mesh, tree: Tree::new(mesh), least: LEAST * (high - low).length() }
    }

    /// r_l of a light at a point of the face `own`, which hides nothing itself.
    pub fn transmitted(&self, light: &Light, point: DVec3, own: u32) -> f64 {
        let mut product = 1.0;
        self.between(light, point, own, |face, _| {
            let material = self.mesh.faces()[face as usize].material;
            product *= self.mesh.materials()[material as usize].transmission;
            product > 0.0
        });
        product
    }

    /// The distance along the ray from a point of the face `own` to the nearest opaque face before the light.
    pub fn nearest_opaque(&self, light: &Light, point: DVec3, own: u32) -> Option<f64> {
        let mut nearest = f64::INFINITY;
        self.between(light, point, own, |face, distance| {
            let material = self.mesh.faces()[face as usize].material;
            if self.mesh.materials()[material as usize].transmission == 0.0 {
                nearest = nearest.min(distance);
            }
            true
        });
        nearest.is_finite().then_some(nearest)
    }

    /// Calls `take` with each face between a point and a light and its distance, in any order, until it returns false.
    fn between(&self, light: &Light, point: DVec3, own: u32, mut take: impl FnMut(u32, f64) -> bool) {
        let (toward, reach) = match *light {
            Light::Directional { toward, .. } => (toward, f64::INFINITY),
            Light::Positional { position, .. } | Light::Flood { position, .. } => {
                ((position - point).normalize_or_zero(), position.distance(point))
            }
        };
        let ray = Ray::new(point, toward);
        self.tree.walk(&ray, |face| {
            let corners = self.mesh.corners(&self.mesh.faces()[face as usize]);
            let distance = if face == own { None } else { ray.hit(corners) };
            let between = distance.filter(|distance| (self.least..reach - self.least).contains(distance));
            between.is_none_or(|distance| take(face, distance))
        });
    }
}
