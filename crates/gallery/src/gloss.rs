//! k_s and n as functions of the point (end of ch. 7): a surface that is glossy in places.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use anyhow::Result;
use edgewalk_golden::{Shaded, Shading, shade};
use edgewalk_scene::Scene;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/components.toml");

/// The exponent of the scene, alone and with a gloss.
const EVEN: &str = "exponent = 20\n";
const GLOSS: &str = "exponent = 20\ngloss_checker = 8\n";

pub(crate) fn gloss() -> Result<Exhibit> {
    let drawn = |instead: &str, shading| -> Result<Shaded> {
        let scene = Scene::parse(Path::new("gloss.toml"), &SCENE.replace(EVEN, instead))?;
        Ok(shade(&scene, &scene.surface(WIDTH, HEIGHT, GUARD), shading, FILL))
    };
    let (even, phong) = (drawn(EVEN, Shading::Phong)?, drawn(GLOSS, Shading::Phong)?);
    let gouraud = drawn(GLOSS, Shading::Gouraud)?;
    let (phong_error, gouraud_error) = (phong.error(), gouraud.error());
    let change = Shaded { picture: phong.picture.clone(), truth: even.picture.rgb.clone() }.error();
    let changed = change.map.iter().filter(|error| **error > 0.5).count();
    Ok(Exhibit {
        name: "gloss",
        title: "k_s and n from a picture",
        cause: "Chapter 7 has k_a, k_d, k_s and n as functions of the point. A texture multiplies k_a and k_d. A gloss multiplies \
                k_s, and n by the mean of its colours: here by 1 and 1/4 in a chequer over the ball. A duller square has a weaker and \
                wider highlight. Gouraud shading, which asks at the vertices only, loses the squares. Golden draws it; the machine's \
                tables hold k_s and n of a whole material.",
        figures: vec![
            figure("pixels that the gloss changes by more than 1/2 LSB", changed as f64, 0),
            figure("largest change, LSB", change.max, 1),
            figure("Phong: mean error against the truth, LSB", phong_error.mean, 3),
            figure("Gouraud: mean error against the truth, LSB", gouraud_error.mean, 3),
            figure("Gouraud: largest error against the truth, LSB", gouraud_error.max, 1),
        ],
        views: vec![
            View::colors("phong", "Phong, k_s and n from a chequer", phong.picture.rgb),
            View::colors("even", "The same k_s and n all over the ball", even.picture.rgb),
            View::colors("gouraud", "Gouraud, with the chequer", gouraud.picture.rgb),
        ],
    })
}
