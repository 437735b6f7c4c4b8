//! The shading systems side by side, each with its error: constant twice, Gouraud, Phong (ch. 7.6 to 7.12).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::machine::Beside;
use edgewalk_golden::{Shading, draw, shade};
use edgewalk_scene::{PixelMethod, Scene, ShadeMode};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/systems.toml");

/// Error shown as white, LSB.
const WHITE: f64 = 32.0;

pub(crate) fn systems() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("systems.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let systems = [
        (Shading::Constant, "constant", "constant, own normal (S5)"),
        (Shading::ConstantAveraged, "averaged", "constant, averaged normal (S5)"),
        (Shading::Gouraud, "gouraud", "Gouraud (S6)"),
        (Shading::Phong, "phong", "Phong (S8)"),
    ];
    let (mut figures, mut views, mut truth) = (Vec::new(), Vec::new(), Vec::new());
    for (shading, name, title) in systems {
        let shaded = shade(&scene, &surface, shading, FILL);
        let error = shaded.error();
        figures.push(figure(format!("{title}: mean error, LSB"), error.mean, 3));
        figures.push(figure(format!("{title}: largest error, LSB"), error.max, 2));
        if shading == Shading::Phong {
            views.push(View::error(
                "phong-error",
                format!("Error of Phong, white at {WHITE} LSB"),
                &error.map,
                WHITE,
            ));
        } else if shading == Shading::Gouraud {
            views.push(View::error(
                "gouraud-error",
                format!("Error of Gouraud, white at {WHITE} LSB"),
                &error.map,
                WHITE,
            ));
        }
        views.push(View::colors(name, title, shaded.picture.rgb));
        truth = shaded.truth;
    }
    views.push(View::colors("truth", "Truth", truth));
    figures.extend(costs(&scene));
    let machine = Beside::of(&scene, PixelMethod::FastPhong)?;
    figures.extend(machine.figures());
    views.extend(machine.views());
    Ok(Exhibit {
        name: "systems",
        title: "Constant, Gouraud and Phong shading (S5, S6, S8)",
        cause: "One colour a polygon, colours interpolated, or normals interpolated: each is the truth with more of the \
                equation moved from the pixel to the vertex or the polygon. What is left in Phong's error is perspective: \
                normals and positions run linearly over the screen instead of the surface. Gouraud by the closed form (7.8) takes two \
                multiplications, two additions and a division for each value; by increments (7.9) it takes one addition.",
        figures,
        views,
    })
}

/// What Gouraud shading of the scene costs by (7.8) and by (7.9), for z, r, g and b of each fragment.
fn costs(scene: &Scene) -> [(String, String); 4] {
    let picture = draw(&scene.frame(WIDTH, HEIGHT, GUARD, ShadeMode::Gouraud), FILL);
    let values = 4.0 * picture.coverage.iter().map(|count| f64::from(*count)).sum::<f64>();
    [
        figure("values of all fragments: z, r, g, b", values, 0),
        figure("closed form (7.8): multiplications, and as many additions", 2.0 * values, 0),
        figure("closed form (7.8): divisions", values, 0),
        figure("by increments (7.9): additions, no more than", values, 0),
    ]
}
