//! Transparency: order, blending, and the shadows of what lets light through (ch. 7.2, 7.4, 7.5).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use crate::shadows::on_the_machine;
use edgewalk_golden::{Rays, Shading, ShadowMaps, Visibility, render};
use edgewalk_scene::Scene;
use glam::DVec3;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/glass.toml");

/// Points of the floor: beside the panes, under the red, under the blue, under both.
const PLACES: [[f64; 2]; 4] = [[-2.0, 0.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];

pub(crate) fn glass() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("glass.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let drawn = |visibility: &Visibility| render(&scene, &surface, Shading::Phong, FILL, visibility);
    let by_maps = drawn(&Visibility::Maps(ShadowMaps::draw(&scene, 512)));
    let rays = Rays::new(&scene.mesh);
    let transmitted = PLACES.map(|[x, z]| rays.transmitted(&scene.lights[0], DVec3::new(x, -1.0, z), 0));
    let by_rays = drawn(&Visibility::Rays(rays));
    let crossing =
        Scene::parse(Path::new("glass.toml"), &SCENE.replace("[1.4, 0.9, -0.9]", "[1.4, -0.9, -0.9]"))?;
    let crossed =
        render(&crossing, &crossing.surface(WIDTH, HEIGHT, GUARD), Shading::Phong, FILL, &Visibility::Full);
    let (machine, golden, found) = on_the_machine(&scene, &[("shadow.transmits", "yes")])?;
    let lit = || found.parts.iter().filter_map(|part| part.lit);
    let [corrected, plain, weighed] = [("corrected", 1.0), ("plain", 1.0), ("plain", 0.5)]
        .map(|(coefficients, share)| pane(coefficients, share).map(|scene| on_screen(&scene)));
    let (corrected, plain, weighed) = (corrected?, plain?, weighed?);
    let beyond =
        found.parts.iter().filter_map(|part| part.blended).map(|blended| blended.beyond).sum::<u64>();
    Ok(Exhibit {
        name: "glass",
        title: "Transparency and its shadows (S3, S4)",
        cause: "What transmits light is drawn last, from back to front, each time (1 - k_t) I + k_t of what is there. Triangles that \
                cut each other have no order: the picture is wrong there, and a warning says so. A depth map knows hidden or not; its \
                second plane holds the product of the k_t before what hides the light, as a ray finds it on its way, in any order. For \
                the panes themselves it counts too much, their own k_t and what lies behind them: they are too dark. \
                Plain coefficients (7.4) already tell what is left of the reflected light; corrected ones (7.5) are weighed by \
                1 - k_t, so a material needs no other k_d for another k_t.",
        figures: vec![
            figure("r_l beside the panes, by ray", transmitted[0], 2),
            figure("under the red one, k_t 0.6", transmitted[1], 2),
            figure("under the blue one, k_t 0.5", transmitted[2], 2),
            figure("under both", transmitted[3], 2),
            figure(
                "a pane of k_d 0.4, k_t 0.5: plain coefficients (7.4) beside corrected ones (7.5), largest difference, LSB",
                apart(&corrected, &plain),
                1,
            ),
            figure(
                "the same with k_d (1 - k_t), read as plain, beside corrected ones, LSB",
                apart(&corrected, &weighed),
                1,
            ),
            figure(
                "panes bent into each other: pairs of triangles without an order",
                crossed.order.intersections.len() as f64,
                0,
            ),
            figure("machine: decisions under its light", lit().map(|lit| lit.pixels).sum::<u64>() as f64, 0),
            figure(
                "machine: not explained by the errors of texel and depth",
                lit().map(|lit| lit.unexplained).sum::<u64>() as f64,
                0,
            ),
            figure("machine: colours beyond the bound of their layers and shares", beyond as f64, 0),
            figure("machine: largest colour error, LSB", found.color_error, 2),
        ],
        views: vec![
            View::colors("maps", "Shadows by maps", by_maps.shaded.picture.rgb),
            View::colors("rays", "Shadows by rays", by_rays.shaded.picture.rgb),
            View::colors("corrected", "A pane of k_d 0.4, k_t 0.5: corrected coefficients", corrected),
            View::colors("plain", "The same numbers as plain coefficients", plain),
            View::colors("machine", "The machine: map and shares, Gouraud shaded", machine.rgb),
            View::colors("machine-golden", "Golden beside it: the same in f64", golden.rgb),
        ],
    })
}

/// The scene with a red pane of k_d 0.4 times `share` and k_t 0.5.
fn pane(coefficients: &str, share: f64) -> anyhow::Result<Scene> {
    let own = format!("diffuse = {}\ncoefficients = \"{coefficients}\"", 0.4 * share);
    let text =
        SCENE.replace("diffuse = [0.9, 0.2, 0.15]", &own).replace("transmission = 0.6", "transmission = 0.5");
    Ok(Scene::parse(Path::new("glass.toml"), &text)?)
}

fn on_screen(scene: &Scene) -> Vec<[f64; 3]> {
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    render(scene, &surface, Shading::Gouraud, FILL, &Visibility::Full).shaded.picture.rgb
}

/// Largest difference of a colour, LSB.
fn apart(one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
    let pixels = one.iter().zip(other);
    pixels.flat_map(|(a, b)| (0..3).map(|k| LSB * (a[k] - b[k]).abs())).fold(0.0, f64::max)
}
