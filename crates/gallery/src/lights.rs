//! The shading equation and its three kinds of light (ch. 7.1).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use edgewalk_golden::{Shading, shade};
use edgewalk_scene::{Light, Scene};
use glam::DVec3;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/lights.toml");

pub(crate) fn lights() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("lights.toml"), SCENE)?;
    let lit = |lights: Vec<Light>| {
        let scene = Scene { lights, ..scene.clone() };
        shade(&scene, &scene.surface(WIDTH, HEIGHT, GUARD), Shading::Phong, FILL).picture
    };
    let [all, dark] = [lit(scene.lights.clone()), lit(Vec::new())];
    let alone: Vec<_> = scene.lights.iter().map(|light| lit(vec![*light])).collect();
    // Light adds: what each light adds to the dark scene, added up, is the whole picture where nothing was cut at 1.
    let mut worst = 0.0f64;
    let mut compared = 0;
    for (at, whole) in all.rgb.iter().enumerate() {
        let dark = DVec3::from(dark.rgb[at]);
        let sum: DVec3 =
            alone.iter().map(|picture| DVec3::from(picture.rgb[at]) - dark).sum::<DVec3>() + dark;
        if all.id[at] >= 0 && whole.iter().all(|channel| *channel < 1.0) {
            worst = worst.max((DVec3::from(*whole) - sum).abs().max_element());
            compared += 1;
        }
    }
    let names = ["directional", "positional", "flood"];
    let mut views = vec![
        View::colors("all", "All", all.rgb),
        View::colors("none", "Emission and ambient light alone", dark.rgb),
    ];
    views.extend(alone.into_iter().zip(names).map(|(picture, name)| View::colors(name, name, picture.rgb)));
    Ok(Exhibit {
        name: "lights",
        title: "The shading equation and its lights (S1)",
        cause: "I = I_e + k_a I_a + the sum over the lights of r_l I_l (k_d N L + k_s cos^n). A directional light has one \
                direction everywhere, a positional one has a place, a flood a place, an axis and a cone. Their parts add, \
                so each can be drawn, or put into shadow, by itself.",
        figures: vec![
            ("pixels where the parts of the lights were added up".into(), compared.to_string()),
            figure("largest difference from the whole, LSB", worst * LSB, 9),
        ],
        views,
    })
}
