//! Mach bands (ch. 7, fig. 7.5; the slides): the slope of the intensity jumps at edges, and the eye sees it.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::plot::plot;
use crate::profile::Profile;
use edgewalk_golden::{Shading, shade};
use edgewalk_scene::Scene;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/mach-bands.toml");

pub(crate) fn mach_bands() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("mach-bands.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let [constant, gouraud, phong] = [Shading::Constant, Shading::Gouraud, Shading::Phong]
        .map(|shading| shade(&scene, &surface, shading, FILL).picture);
    let profiles = [&constant, &gouraud, &phong].map(Profile::of);
    let names = ["constant", "Gouraud", "Phong"];
    let intensity: Vec<_> = profiles.iter().zip(names).map(|(of, name)| of.series(name)).collect();
    let slope: Vec<_> =
        profiles[1..].iter().zip(&names[1..]).map(|(of, name)| of.slope_series(name)).collect();
    let perceived: Vec<_> = profiles.iter().zip(names).map(|(of, name)| of.perceived(name)).collect();
    let [gouraud_jumps, phong_jumps] = [&profiles[1], &profiles[2]].map(Profile::slope_jumps);
    let mean = |jumps: &[f64]| jumps.iter().sum::<f64>() / jumps.len() as f64;
    let largest = |jumps: &[f64]| jumps.iter().copied().fold(0.0, f64::max);
    Ok(Exhibit {
        name: "mach-bands",
        title: "Mach bands (S7)",
        cause: "Constant shading steps at every edge. Gouraud shading does not, but its slope still jumps there, as each \
                triangle is a plane of its own; the eye takes the jump for a bright or a dark line. Phong shading \
                interpolates what is lit instead of the light: inside a triangle the intensity bends, and less than half of \
                the jump is left. Not none, as the normals' own slope jumps at edges.",
        figures: vec![
            figure("constant: largest step between neighbours, LSB", profiles[0].largest_step(), 2),
            figure("constant: most perceived beside the intensity, LSB", profiles[0].largest_response(), 2),
            figure("Gouraud: most perceived beside the intensity, LSB", profiles[1].largest_response(), 2),
            figure("Phong: most perceived beside the intensity, LSB", profiles[2].largest_response(), 2),
            figure("edges met on the line", gouraud_jumps.len() as f64, 0),
            figure("Gouraud: mean jump of the slope at an edge, LSB/px", mean(&gouraud_jumps), 3),
            figure("Gouraud: largest jump of the slope at an edge, LSB/px", largest(&gouraud_jumps), 3),
            figure(
                "Gouraud: largest change of the slope inside a triangle, LSB/px",
                profiles[1].largest_bend(),
                3,
            ),
            figure("Phong: mean jump of the slope at an edge, LSB/px", mean(&phong_jumps), 3),
            figure("Phong: largest jump of the slope at an edge, LSB/px", largest(&phong_jumps), 3),
        ],
        views: vec![
            View::colors("constant", "Constant", constant.rgb),
            View::colors("gouraud", "Gouraud", gouraud.rgb),
            View::colors("phong", "Phong", phong.rgb),
            View::drawing(
                "intensity",
                "Intensity along the middle line",
                plot("pixel", "LSB of 8 bits", &intensity),
            ),
            View::drawing(
                "perceived",
                "As an eye perceives it, by a centre-surround filter of 2 and 8 pixels",
                plot("pixel", "LSB of 8 bits", &perceived),
            ),
            View::drawing("slope", "Its slope", plot("pixel", "LSB/px", &slope)),
        ],
    })
}
