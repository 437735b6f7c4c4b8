//! Fast Phong shading: quadratics by additions instead of a division and a square root (BW86).

use crate::exhibit::{Exhibit, GUARD, HEIGHT, View, WIDTH, figure};
use crate::machine::Beside;
use edgewalk_golden::fast_phong::{Directional, Fit, Settings, shade};
use edgewalk_scene::{PixelMethod, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/fast-phong.toml");

/// Error shown as white, LSB.
const WHITE: f64 = 16.0;

pub(crate) fn fast_phong() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("fast-phong.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    // The scene has no other kind.
    let lights = Directional::all(&scene.lights).unwrap_or_default();
    let (mut figures, mut views, mut phong) = (Vec::new(), Vec::new(), Vec::new());
    for (fit, name, title) in [(Fit::Taylor, "taylor", "Taylor"), (Fit::SixPoint, "six-point", "six points")]
    {
        let settings = Settings { fit, table_size: 4096, subpixel_bits: 8 };
        let drawn = shade(&scene, &surface, &lights, settings);
        let [to_phong, to_truth] = [drawn.error_to_phong(), drawn.shaded.error()];
        figures.push(figure(format!("{title}: largest difference from Phong, LSB"), to_phong.max, 2));
        figures.push(figure(format!("{title}: mean difference from Phong, LSB"), to_phong.mean, 3));
        figures.push(figure(format!("{title}: mean error against the truth, LSB"), to_truth.mean, 3));
        views.push(View::colors(name, title, drawn.shaded.picture.rgb));
        let map = if fit == Fit::Taylor { "taylor-error" } else { "six-point-error" };
        views.push(View::error(
            map,
            format!("Its difference from Phong, white at {WHITE} LSB"),
            &to_phong.map,
            WHITE,
        ));
        phong = drawn.phong;
    }
    views.push(View::colors("phong", "Phong", phong));
    let machine = Beside::of(&scene, PixelMethod::FastPhong)?;
    figures.extend(machine.figures());
    views.extend(machine.views());
    Ok(Exhibit {
        name: "fast-phong",
        title: "Fast Phong (S9)",
        cause: "N L / |N| and N H / |N| become quadratics, stepped by two additions a pixel each, and a table raises the \
                second to its power. The series is right in the middle of a triangle and worst at its corners, where \
                neighbours disagree; six points agree along common edges. Bound 10 says by how much.",
        figures,
        views,
    })
}
