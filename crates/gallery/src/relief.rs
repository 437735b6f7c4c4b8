//! A relief in the machine: normals turned at each pixel, exactly by Phong and to first order by fast Phong.

use crate::exhibit::{Exhibit, figure};
use crate::machine::Beside;
use edgewalk_scene::{PixelMethod, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/relief.toml");

pub(crate) fn relief() -> anyhow::Result<Exhibit> {
    let scene = |text: &str| Scene::parse(Path::new("relief.toml"), text);
    let full = scene(SCENE)?;
    let smooth = scene(&SCENE.replace("bump_height = 0.05", "bump_height = 0"))?;
    let [phong, flat] = [&full, &smooth].map(|scene| Beside::of(scene, PixelMethod::Phong));
    let (phong, fast) = (phong?, Beside::of(&full, PixelMethod::FastPhong)?);
    let (changed, most) = phong.change(&flat?);
    let mut figures = vec![
        figure("pixels that the relief changes by more than 1/2 LSB", changed as f64, 0),
        figure("largest change, LSB", most, 1),
    ];
    let mut views = Vec::new();
    for beside in [phong, fast] {
        figures.extend(beside.figures());
        views.extend(beside.views());
    }
    Ok(Exhibit {
        name: "relief",
        title: "A relief in the machine (S10)",
        cause: "The slopes of a relief stand beside the colour in a texel's word, and turn the normal at each pixel: each cosine grows \
                by two products with terms that are linear over the triangle. By Phong N N grows too, and the result is that of the \
                turned normal; fast Phong leaves that out, and is too bright by up to half the square of the slope.",
        figures,
        views,
    })
}
