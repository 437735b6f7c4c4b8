//! A light at a point in the machine: the shading equation at each pixel, with the way to the light, its attenuation and its cone.

use crate::exhibit::Exhibit;
use crate::machine::Beside;
use edgewalk_scene::{PixelMethod, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/lamp.toml");

pub(crate) fn lamp() -> anyhow::Result<Exhibit> {
    let beside = Beside::of(&Scene::parse(Path::new("lamp.toml"), SCENE)?, PixelMethod::Phong)?;
    Ok(Exhibit {
        name: "lamp",
        title: "A light at a point in the machine (S8)",
        cause: "With the normal and the place both linear over a triangle, the products of the normal, the way to the light and the way \
                to the viewer are quadratics of the screen. The machine follows six of them, takes three roots a pixel and multiplies \
                thirteen times on one multiplier; attenuation and cone come from tables.",
        figures: beside.figures(),
        views: beside.views(),
    })
}
