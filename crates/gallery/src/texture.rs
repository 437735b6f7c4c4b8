//! Coefficients that vary over the surface, and perturbed normals (end of ch. 7).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::machine::Beside;
use edgewalk_golden::{Shaded, Shading, shade};
use edgewalk_scene::{PixelMethod, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/texture-and-relief.toml");

pub(crate) fn texture() -> anyhow::Result<Exhibit> {
    let smooth = SCENE.replace("bump_height = 0.05", "bump_height = 0");
    let scene = |text: &str| Scene::parse(Path::new("texture-and-relief.toml"), text);
    let drawn = |scene: &Scene, by| shade(scene, &scene.surface(WIDTH, HEIGHT, GUARD), by, FILL);
    let full = scene(SCENE)?;
    let [phong, gouraud] = [Shading::Phong, Shading::Gouraud].map(|by| drawn(&full, by));
    let flat =
        Shaded { picture: phong.picture.clone(), truth: drawn(&scene(&smooth)?, Shading::Phong).picture.rgb };
    let relief = flat.error();
    // The machine's squares are texels, and it knows no relief.
    let texels = smooth.replace("checker = 16", "checker = 16\ntexels = \"nearest\"");
    let machine = Beside::of(&scene(&texels)?, PixelMethod::FastPhong)?;
    let turned = relief.map.iter().filter(|error| **error > 0.5).count();
    let mut figures = vec![
        figure("pixels that the relief changes by more than 1/2 LSB", turned as f64, 0),
        figure("largest change, LSB", relief.max, 1),
        figure("Phong: mean error against the truth, LSB", phong.error().mean, 3),
        figure("Gouraud: mean error against the truth, LSB", gouraud.error().mean, 3),
    ];
    figures.extend(machine.figures());
    let mut views = vec![
        View::colors("phong", "Phong", phong.picture.rgb),
        View::colors("smooth", "Without the relief", flat.truth),
        View::colors("gouraud", "Gouraud", gouraud.picture.rgb),
    ];
    views.extend(machine.views());
    Ok(Exhibit {
        name: "texture",
        title: "Texture and relief (S10)",
        cause: "k_d and k_a are read from a picture, the normal is turned by the slopes of a relief before the equation. Both \
                vary faster than the vertices stand: Gouraud shading, which knows the vertices only, loses them. The machine \
                shades by fast Phong and looks up the nearest texel at each pixel; it draws the scene without the relief.",
        figures,
        views,
    })
}
