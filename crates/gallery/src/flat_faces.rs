//! When constant shading is reasonable (the slides): a polyhedron, its light far away, its viewer far away.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use anyhow::Result;
use edgewalk_golden::{Shaded, Shading, shade};
use edgewalk_scene::{Light, Scene, Surface};
use glam::DVec3;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/polyhedron.toml");

/// Distances of light and viewer, in those of the scene.
const TIMES: [u32; 5] = [1, 2, 4, 8, 64];

/// k_s of the scenes in which the viewer moves.
const GLOSSY: &str = "specular = 0.6";

pub(crate) fn flat_faces() -> Result<Exhibit> {
    let (mut figures, mut views) = (Vec::new(), Vec::new());
    for times in TIMES {
        let scene = lit_from(f64::from(times))?;
        let shaded = drawn(&scene, &scene.surface(WIDTH, HEIGHT, GUARD));
        figures.push(figure(
            format!("light {times} times as far: largest error of constant shading, LSB"),
            shaded.error().max,
            2,
        ));
        if times == 1 {
            views.push(View::colors("near", "Constant shading, the light near", shaded.picture.rgb));
            views.push(View::colors("near-truth", "The truth beside it", shaded.truth));
        }
    }
    for times in TIMES {
        let scene = seen_from(f64::from(times))?;
        let surface = scene.surface(WIDTH, HEIGHT, GUARD);
        let shaded = drawn(&scene, &surface);
        figures.push(figure(
            format!("viewer {times} times as far: the truth's range over one face, LSB"),
            range(&shaded, &surface),
            2,
        ));
        if times == 1 {
            views.push(View::colors("viewer", "The truth, glossy, the viewer near", shaded.truth));
        }
    }
    Ok(Exhibit {
        name: "flat-faces",
        title: "When constant shading is reasonable (S5)",
        cause: "Three conditions: the surface is a polyhedron, the light is far away, and so is the viewer. A cube meets the first. \
                The farther its light, the less N·L varies over a face, and the nearer constant shading comes to the truth. Constant \
                shading has no highlight (7.6), so its own error tells nothing of the viewer: counted is by how much the truth of a \
                glossy cube varies over one face, under parallel light. Half of that no single colour can mend; it goes to 0 as the \
                viewer goes away.",
        figures,
        views,
    })
}

fn drawn(scene: &Scene, surface: &Surface) -> Shaded {
    shade(scene, surface, Shading::Constant, FILL)
}

/// The matte cube, its light so many times as far away, and as bright.
fn lit_from(times: f64) -> Result<Scene> {
    let mut scene = Scene::parse(Path::new("polyhedron.toml"), SCENE)?;
    for light in &mut scene.lights {
        if let Light::Positional { position, .. } = light {
            *position *= times;
        }
    }
    Ok(scene)
}

/// The glossy cube in parallel light that its top mirrors to the viewer, who is so many times as far and sees it at the same size.
fn seen_from(times: f64) -> Result<Scene> {
    let mut scene =
        Scene::parse(Path::new("polyhedron.toml"), &SCENE.replace("specular = 0\n", &format!("{GLOSSY}\n")))?;
    let camera = &mut scene.camera;
    let toward = (camera.eye * DVec3::new(-1.0, 1.0, -1.0)).normalize_or(DVec3::Y);
    scene.lights = vec![Light::Directional { toward, intensity: DVec3::splat(0.5) }];
    let away = (camera.eye - camera.target).length();
    camera.eye = camera.target + (camera.eye - camera.target) * times;
    camera.angle = 2.0 * ((camera.angle / 2.0).tan() / times).atan();
    (camera.near, camera.far) = (away * times - 2.0, away * times + 2.0);
    Ok(scene)
}

/// The largest range of the truth's green over the pixels of a face, LSB.
fn range(shaded: &Shaded, surface: &Surface) -> f64 {
    let mut faces: Vec<(DVec3, f64, f64)> = Vec::new();
    let seen = shaded.picture.id.iter().zip(&shaded.truth).filter(|(id, _)| **id >= 0);
    for (id, rgb) in seen {
        // The two triangles of a face have one normal.
        let normal = surface.triangles[*id as usize].own_normal;
        match faces.iter_mut().find(|(other, ..)| other.abs_diff_eq(normal, 1e-9)) {
            Some((_, low, high)) => (*low, *high) = (low.min(rgb[1]), high.max(rgb[1])),
            None => faces.push((normal, rgb[1], rgb[1])),
        }
    }
    LSB * faces.iter().map(|(_, low, high)| high - low).fold(0.0, f64::max)
}
