//! A highlight inside a polygon that Gouraud shading misses (B, C).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use edgewalk_golden::{Shading, shade};
use edgewalk_scene::{InputError, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../../../docs/scenes/missed-highlight.toml");

pub(crate) fn missed_highlight() -> Result<Exhibit, InputError> {
    let scene = Scene::parse(Path::new("missed-highlight.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let [gouraud, phong] = [Shading::Gouraud, Shading::Phong].map(|by| shade(&scene, &surface, by, FILL));
    let brightest = |rgb: &[[f64; 3]]| LSB * rgb.iter().map(|c| c[1]).fold(0.0, f64::max);
    Ok(Exhibit {
        name: "missed-highlight",
        title: "The missed highlight (S16)",
        cause: "Gouraud shading evaluates the equation at the vertices only. A highlight that lies inside a polygon \
                reaches none of them and is lost; one that lies on a vertex is smeared over its polygons.",
        figures: vec![
            figure("brightest green, Gouraud, LSB", brightest(&gouraud.picture.rgb), 1),
            figure("brightest green, Phong, LSB", brightest(&phong.picture.rgb), 1),
            figure("brightest green, truth, LSB", brightest(&gouraud.truth), 1),
            figure("Gouraud: largest error, LSB", gouraud.error().max, 1),
            figure("Phong: largest error, LSB", phong.error().max, 1),
        ],
        views: vec![
            View::colors("gouraud", "Gouraud", gouraud.picture.rgb),
            View::colors("phong", "Phong", phong.picture.rgb),
            View::colors("truth", "Truth", gouraud.truth),
        ],
    })
}
