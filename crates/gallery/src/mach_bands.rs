//! Mach bands (A fig. 7.5, B): the slope of the intensity jumps at edges, and the eye sees it.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::plot::plot;
use crate::profile::Profile;
use edgewalk_golden::{Shading, shade};
use edgewalk_scene::{InputError, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../../../docs/scenes/mach-bands.toml");

pub(crate) fn mach_bands() -> Result<Exhibit, InputError> {
    let scene = Scene::parse(Path::new("mach-bands.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let [constant, gouraud, phong] = [Shading::Constant, Shading::Gouraud, Shading::Phong]
        .map(|shading| shade(&scene, &surface, shading, FILL).picture);
    let profiles = [&constant, &gouraud, &phong].map(Profile::of);
    let names = ["constant", "Gouraud", "Phong"];
    let intensity: Vec<_> = profiles.iter().zip(names).map(|(of, name)| of.series(name)).collect();
    let slope: Vec<_> = profiles[1..].iter().zip(&names[1..]).map(|(of, name)| of.slope_series(name)).collect();
    let [[gouraud_edge, gouraud_inside], [phong_edge, _]] = [&profiles[1], &profiles[2]].map(Profile::slope_jumps);
    Ok(Exhibit {
        name: "mach-bands",
        title: "Mach bands (S7)",
        cause: "Constant shading steps at every edge. Gouraud shading does not, but its slope still jumps there, as each \
                triangle is a plane of its own; the eye takes the jump for a bright or a dark line. Phong shading \
                interpolates what is lit instead of the light, and nearly all of the jump goes.",
        figures: vec![
            figure("constant: largest step between neighbours, LSB", profiles[0].largest_step(), 2),
            figure("Gouraud: largest jump of the slope at an edge, LSB/px", gouraud_edge, 3),
            figure("Gouraud: largest change of the slope inside a triangle, LSB/px", gouraud_inside, 3),
            figure("Phong: largest jump of the slope at an edge, LSB/px", phong_edge, 3),
        ],
        views: vec![
            View::colors("constant", "Constant", constant.rgb),
            View::colors("gouraud", "Gouraud", gouraud.rgb),
            View::colors("phong", "Phong", phong.rgb),
            View::drawing("intensity", "Intensity along the middle line", plot("pixel", "LSB of 8 bits", &intensity)),
            View::drawing("slope", "Its slope", plot("pixel", "LSB/px", &slope)),
        ],
    })
}
