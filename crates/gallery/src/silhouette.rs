//! Polygonal silhouette (slides, notes): smooth shading does not round an outline.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::plot::{Series, plot};
use edgewalk_golden::{Shading, shade};
use edgewalk_scene::Scene;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/silhouette.toml");

pub(crate) fn silhouette() -> anyhow::Result<Exhibit> {
    let (mut points, mut pictures) = (Vec::new(), Vec::new());
    for (columns, rows) in [(8, 4), (12, 6), (16, 8), (24, 12), (48, 24), (96, 48)] {
        let text = SCENE
            .replace("columns = 12", &format!("columns = {columns}"))
            .replace("rows = 6", &format!("rows = {rows}"));
        let scene = Scene::parse(Path::new("silhouette.toml"), &text)?;
        let shaded = shade(&scene, &scene.surface(WIDTH, HEIGHT, GUARD), Shading::Phong, FILL);
        let missing = missing(&scene, &shaded.picture.id);
        points.push((f64::from(columns).log2(), missing.log2()));
        pictures.push(shaded.picture.rgb);
    }
    let percent = |k: usize| points[k].1.exp2();
    Ok(Exhibit {
        name: "silhouette",
        title: "Polygonal silhouette (S16)",
        cause: "Shading changes colours, not coverage: the outline remains that of the polygons, however smooth the inside. \
                Each segment of an outline of n segments stays inside the circle by r (1 - cos(pi / n)), so the pixels missed \
                fall with the square of n.",
        figures: vec![
            figure("8 by 4: pixels of the sphere missed, %", percent(0), 2),
            figure("16 by 8", percent(2), 2),
            figure("48 by 24", percent(4), 2),
            figure("96 by 48", percent(5), 3),
        ],
        views: vec![
            View::colors("8", "8 by 4, Phong", pictures.swap_remove(0)),
            View::colors("48", "48 by 24, Phong", pictures.swap_remove(4)),
            View::drawing(
                "missed",
                "Pixels missed against the columns of the sphere",
                plot("log2 columns", "log2 %", &[Series { label: "missed", points }]),
            ),
        ],
    })
}

/// Pixels of the unit sphere's true outline that no triangle drew, percent of all of it.
fn missing(scene: &Scene, id: &[i32]) -> f64 {
    // The lines of sight that touch the sphere make a cone of this half-angle, a circle about the middle of the screen.
    let half_angle = (1.0 / scene.camera.eye.length()).asin();
    let radius = f64::from(HEIGHT) / 2.0 * half_angle.tan() / (scene.camera.angle / 2.0).tan();
    let (mut inside, mut missed) = (0u32, 0u32);
    for (at, id) in (0u32..).zip(id) {
        let [x, y] = [at % WIDTH, at / WIDTH].map(|c| f64::from(c) + 0.5);
        if (x - f64::from(WIDTH) / 2.0).hypot(y - f64::from(HEIGHT) / 2.0) < radius {
            inside += 1;
            missed += u32::from(*id < 0);
        }
    }
    100.0 * f64::from(missed) / f64::from(inside)
}
