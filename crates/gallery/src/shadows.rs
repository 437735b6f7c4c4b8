//! Shadow maps, against rays (ch. 7.2, 7.3).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use edgewalk_golden::{Rays, Shaded, Shading, ShadowMaps, Visibility, render};
use edgewalk_scene::Scene;
use std::path::Path;

const SCENE: &str = include_str!("../../../docs/scenes/shadows.toml");

pub(crate) fn shadows() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("shadows.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let drawn = |visibility| render(&scene, &surface, Shading::Phong, FILL, &visibility).shaded.picture;
    let rays = drawn(Visibility::Rays(Rays::new(&scene.mesh)));
    let [coarse, fine] = [128, 1024].map(|size| drawn(Visibility::Maps(ShadowMaps::draw(&scene, size))));
    let unlike = |picture: &edgewalk_golden::Picture| {
        let difference = Shaded { picture: picture.clone(), truth: rays.rgb.clone() }.error();
        difference.map.iter().filter(|error| **error > 0.5).count() as f64
    };
    Ok(Exhibit {
        name: "shadows",
        title: "Shadow maps (S2)",
        cause: "From each light a depth map is drawn; a point is in shadow if the map has something nearer, by more than a bias. \
                Each light's part is gated by its own r_l, so a shadow of one light is lit by the others. A texel decides for all \
                that it covers: borders are ragged, the less the finer the map. Rays say what is right.",
        figures: vec![
            figure("pixels that show a surface", rays.id.iter().filter(|id| **id >= 0).count() as f64, 0),
            figure("of them other than by rays, maps of 128 x 128 texels", unlike(&coarse), 0),
            figure("of them other than by rays, maps of 1024 x 1024 texels", unlike(&fine), 0),
        ],
        views: vec![
            View::colors("map-128", "Maps of 128 x 128", coarse.rgb),
            View::colors("map-1024", "Maps of 1024 x 1024", fine.rgb),
            View::colors("rays", "Rays", rays.rgb),
        ],
    })
}
