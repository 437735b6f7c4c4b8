//! Transparency: order, blending, and the shadows of what lets light through (ch. 7.2, 7.4, 7.5).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use edgewalk_golden::{Rays, Shading, ShadowMaps, Visibility, render};
use edgewalk_scene::Scene;
use glam::DVec3;
use std::path::Path;

const SCENE: &str = include_str!("../../../docs/scenes/glass.toml");

/// Points of the floor: beside the panes, under the red, under the blue, under both.
const PLACES: [[f64; 2]; 4] = [[-2.0, 0.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];

pub(crate) fn glass() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("glass.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let drawn = |visibility: &Visibility| render(&scene, &surface, Shading::Phong, FILL, visibility);
    let by_maps = drawn(&Visibility::Maps(ShadowMaps::draw(&scene, 512)));
    let rays = Rays::new(&scene.mesh);
    let lit = PLACES.map(|[x, z]| rays.transmitted(&scene.lights[0], DVec3::new(x, -1.0, z), 0));
    let by_rays = drawn(&Visibility::Rays(rays));
    let crossing =
        Scene::parse(Path::new("glass.toml"), &SCENE.replace("[1.4, 0.9, -0.9]", "[1.4, -0.9, -0.9]"))?;
    let crossed =
        render(&crossing, &crossing.surface(WIDTH, HEIGHT, GUARD), Shading::Phong, FILL, &Visibility::Full);
    Ok(Exhibit {
        name: "glass",
        title: "Transparency and its shadows (S3, S4)",
        cause: "What transmits light is drawn last, from back to front, each time (1 - k_t) I + k_t of what is there. A depth map \
                knows hidden or not, so glass either blocks a light or, as here, lets all of it pass; a ray multiplies the k_t \
                on its way. Triangles that cut each other have no order: the picture is wrong there, and a warning says so.",
        figures: vec![
            figure("r_l beside the panes, by ray", lit[0], 2),
            figure("under the red one, k_t 0.6", lit[1], 2),
            figure("under the blue one, k_t 0.5", lit[2], 2),
            figure("under both", lit[3], 2),
            figure(
                "panes bent into each other: pairs of triangles without an order",
                crossed.order.intersections.len() as f64,
                0,
            ),
        ],
        views: vec![
            View::colors("maps", "Shadows by maps", by_maps.shaded.picture.rgb),
            View::colors("rays", "Shadows by rays", by_rays.shaded.picture.rgb),
        ],
    })
}
