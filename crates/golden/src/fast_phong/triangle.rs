//! Fast Phong for a triangle of a scene: which normals and directions the quadratics are made from.
//!
//! L is the same everywhere, H is not quite: it leans with the viewer. The Taylor series takes one H,
//! at the centroid; the six-point fit takes it where it takes its values, so neighbours still agree along their edge. Both
//! take the world position linear over the screen, as ch. 7.12 does.

use crate::cover::snap;
use crate::fast_phong::differences::Walk;
use crate::fast_phong::normal_plane::NormalPlane;
use crate::fast_phong::quadratic::Quadratic;
use crate::fast_phong::six_point::{nodes, six_point};
use crate::fast_phong::table::PowerTable;
use crate::fast_phong::taylor::taylor;
use edgewalk_scene::{Light, Material, SurfaceTriangle};
use glam::{DVec2, DVec3};

/// Where a quadratic comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Fit {
    /// The Taylor series about the centroid.
    Taylor,
    /// Through the values at vertices and midpoints.
    SixPoint,
}

/// Light from a direction, the only kind that fast Phong takes beside ambient light (ch. 7.6).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directional {
    /// Unit vector L towards the light.
    pub toward: DVec3,
    /// I_l for red, green, blue.
    pub intensity: DVec3,
}

impl Directional {
    /// The lights of a scene; the place of the first that is not directional, if there is one.
    ///
    /// # Errors
    /// A positional or flood light.
    pub fn all(lights: &[Light]) -> Result<Vec<Self>, usize> {
        let directional = |(place, light): (usize, &Light)| match *light {
            Light::Directional { toward, intensity } => Ok(Self { toward, intensity }),
            Light::Positional { .. } | Light::Flood { .. } => Err(place),
        };
        lights.iter().enumerate().map(directional).collect()
    }
}

/// N·L and N·H of a light at the pixels of a triangle.
#[derive(Debug, Clone)]
struct Cosines {
    intensity: DVec3,
    diffuse: Walk<f64>,
    halfway: Walk<f64>,
    /// L, and H at the centroid.
    directions: [DVec3; 2],
}

/// A triangle shaded by fast Phong, line by line from the top, each span from the left.
#[derive(Debug, Clone)]
pub struct FastPhong(Vec<Cosines>);

impl FastPhong {
    /// Fits the quadratics of all `lights`, seen from `eye`, and starts at column and row `at`. A triangle that has no
    /// area after its vertices are snapped to `subpixel_bits` has no pixels; it is black.
    pub fn new(
        triangle: &SurfaceTriangle,
        subpixel_bits: u32,
        fit: Fit,
        lights: &[Directional],
        eye: DVec3,
        at: (u32, u32),
    ) -> Self {
        let centre = DVec2::new(f64::from(at.0) + 0.5, f64::from(at.1) + 0.5);
        let middle = triangle.vertices.iter().map(|vertex| vertex.position).sum::<DVec3>() / 3.0;
        let walk = |quadratic: Quadratic| Walk::new(quadratic.differences(centre), at);
        let cosines = |light: &Directional| {
            let [diffuse, halfway] = quadratics(triangle, subpixel_bits, fit, light.toward, eye)?;
            let directions = [light.toward, halfway_at(light.toward, eye, middle)];
            Some(Cosines {
                intensity: light.intensity,
                diffuse: walk(diffuse),
                halfway: walk(halfway),
                directions,
            })
        };
        Self(lights.iter().filter_map(cosines).collect())
    }

    /// To column `x`, row `y`, which is not above the last one: two additions for each of a light's two quadratics if it
    /// is the next pixel of the span.
    pub fn step(&mut self, x: u32, y: u32) {
        for cosines in &mut self.0 {
            cosines.diffuse.step(x, y);
            cosines.halfway.step(x, y);
        }
    }

    /// The colour there, not cut to [0, 1]: I_e + k_a I_a + sum of I_l (k_d N·L + k_s table(N·H)) over the lights with
    /// N·L > 0. `table` has the exponent of the material.
    pub fn color(&self, material: &Material, ambient: DVec3, table: &PowerTable) -> DVec3 {
        self.turned(DVec3::ZERO, material, ambient, table)
    }

    /// Like `color`, where a relief adds `turn` to the normal, which counts to first order: N·L and N·H grow by turn·L and turn·H.
    pub fn turned(&self, turn: DVec3, material: &Material, ambient: DVec3, table: &PowerTable) -> DVec3 {
        let part = |Cosines { intensity, diffuse, halfway, directions: [l, h] }: &Cosines| {
            let cosine = diffuse.value() + turn.dot(*l);
            if cosine <= 0.0 {
                return DVec3::ZERO;
            }
            let highlight = table.read(halfway.value() + turn.dot(*h));
            *intensity * (material.diffuse * cosine + material.specular * highlight)
        };
        material.emission + material.ambient * ambient + self.0.iter().map(part).sum::<DVec3>()
    }
}

/// N·L/|N| and N·H/|N| over the snapped triangle; `None` if that has no area.
pub fn quadratics(
    triangle: &SurfaceTriangle,
    subpixel_bits: u32,
    fit: Fit,
    toward: DVec3,
    eye: DVec3,
) -> Option<[Quadratic; 2]> {
    let unit = f64::from(1u32 << subpixel_bits);
    let points = triangle.vertices.map(|v| {
        DVec2::new(snap(v.screen.x, subpixel_bits) as f64, snap(v.screen.y, subpixel_bits) as f64) / unit
    });
    let normals = triangle.vertices.map(|v| v.normal);
    let positions = triangle.vertices.map(|v| v.position);
    let halfway = |position: DVec3| halfway_at(toward, eye, position);
    match fit {
        Fit::Taylor => {
            let plane = NormalPlane::new(points, normals)?;
            let middle = (positions[0] + positions[1] + positions[2]) / 3.0;
            Some([taylor(&plane, toward), taylor(&plane, halfway(middle))])
        }
        Fit::SixPoint => {
            let through = |[vertices, midpoints]: [[f64; 3]; 2]| six_point(points, vertices, midpoints);
            let light = nodes(normals, positions, |normal, _| normal.dot(toward));
            let highlight = nodes(normals, positions, |normal, position| normal.dot(halfway(position)));
            Some([through(light)?, through(highlight)?])
        }
    }
}

/// H for light from a direction, seen from `eye`.
fn halfway_at(toward: DVec3, eye: DVec3, position: DVec3) -> DVec3 {
    (toward + (eye - position).normalize_or_zero()).normalize_or_zero()
}
