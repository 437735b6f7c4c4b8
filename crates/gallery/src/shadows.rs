//! Shadow maps, against rays (ch. 7.2, 7.3).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use edgewalk_golden::{Rays, Shaded, Shading, ShadowMaps, Visibility, render};
use edgewalk_host::raster::{Cycles, Raster};
use edgewalk_judge::passes::{Passes, beside_golden};
use edgewalk_machine::Machine;
use edgewalk_scene::Scene;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/shadows.toml");

/// The scene drawn by a machine with PROJECT, golden's picture of the same passes, and what was found.
pub(crate) fn on_the_machine(
    scene: &Scene,
    also: &[(&str, &str)],
) -> anyhow::Result<(Raster, Raster, Passes)> {
    let mut keys = Machine { width: WIDTH, height: HEIGHT, ..Machine::default() };
    for (key, value) in [("shadow.light", "perspective"), ("blend.kind", "constant")].iter().chain(also) {
        keys.set(key, value)?;
    }
    let plan = keys.plan()?;
    beside_golden(scene, &scene.surface(WIDTH, HEIGHT, GUARD), &plan)
}

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
    let (machine, golden, found) = on_the_machine(&scene, &[])?;
    let lit = || found.parts.iter().filter_map(|part| part.lit);
    let cycles =
        |cycles: &[u64]| cycles.iter().map(|cycles| cycles.to_string()).collect::<Vec<_>>().join(" + ");
    let of = |passes: &[Cycles]| passes.iter().map(|pass| pass.total).collect::<Vec<_>>();
    let maps: Vec<u64> = machine.lights.iter().map(|light| light.cycles.total).collect();
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
            figure(
                "machine: decisions of its three lights",
                lit().map(|lit| lit.pixels).sum::<u64>() as f64,
                0,
            ),
            figure(
                "machine: of them other than golden's",
                lit().map(|lit| lit.differ).sum::<u64>() as f64,
                0,
            ),
            figure(
                "machine: not explained by the errors of texel and depth",
                lit().map(|lit| lit.unexplained).sum::<u64>() as f64,
                0,
            ),
            figure("machine: pixels that are not the sum of the passes", found.wrong as f64, 0),
            figure("machine: largest colour error where decided alike, LSB", found.color_error, 2),
            figure("machine: proved bound of that, LSB", found.color_bound().unwrap_or(f64::NAN), 2),
            ("machine: clocks of the maps of 512 x 512 texels".to_owned(), cycles(&maps)),
            ("machine: clocks of the passes, ambient light first".to_owned(), cycles(&of(&machine.passes))),
        ],
        views: vec![
            View::colors("map-128", "Maps of 128 x 128", coarse.rgb),
            View::colors("map-1024", "Maps of 1024 x 1024", fine.rgb),
            View::colors("rays", "Rays", rays.rgb),
            View::colors(
                "machine",
                "The machine: ambient light and a pass for each light, Gouraud shaded",
                machine.rgb,
            ),
            View::colors("machine-golden", "Golden beside it: the same in f64", golden.rgb),
        ],
    })
}
