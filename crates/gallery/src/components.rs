//! The components of one light over a surface, and which systems suffice for them (ch. 7, fig. 7.2; the slides: when constant shading is
//! reasonable).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::plot::{Series, plot};
use crate::profile::Profile;
use anyhow::Result;
use edgewalk_golden::{Shaded, Shading, shade};
use edgewalk_scene::Scene;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/components.toml");

/// k_s of the sweep, in tenths; k_d is what is left of 0.9.
const SWEEP: [u32; 5] = [0, 2, 4, 6, 8];

pub(crate) fn components() -> Result<Exhibit> {
    let parts = [("ambient", [2, 0, 0]), ("diffuse", [0, 6, 0]), ("specular", [0, 0, 6])];
    let (mut figures, mut series) = (Vec::new(), Vec::new());
    for (name, tenths) in parts {
        let shaded = drawn(tenths, Shading::Phong)?;
        let truth = Profile::of(&edgewalk_golden::Picture { rgb: shaded.truth, ..shaded.picture });
        let line: Series = truth.series(name);
        figures.push(figure(
            format!("{name}: largest change of the slope on the middle line, LSB/px"),
            bend(&line),
            3,
        ));
        series.push(line);
    }
    let mut views = vec![View::drawing(
        "parts",
        "Components along the middle line",
        plot("pixel", "LSB of 8 bits", &series),
    )];
    for tenths in SWEEP {
        for (shading, name) in [(Shading::Constant, "constant"), (Shading::Gouraud, "Gouraud")] {
            let shaded = drawn([1, 9 - tenths, tenths], shading)?;
            let error = shaded.error();
            figures.push(figure(format!("k_s = 0.{tenths}, {name}: mean error, LSB"), error.mean, 2));
            figures.push(figure(format!("k_s = 0.{tenths}, {name}: largest error, LSB"), error.max, 1));
            if [0, 8].contains(&tenths) && shading == Shading::Gouraud {
                let (file, caption) = if tenths == 0 {
                    ("matte", "Gouraud, k_s = 0: it suffices")
                } else {
                    ("glossy", "Gouraud, k_s = 0.8: the highlight is lost")
                };
                views.push(View::colors(file, caption, shaded.picture.rgb));
            }
        }
    }
    let (printed, cut) = (highlight(|cosine| cosine), highlight(|cosine| cosine.max(0.0)));
    for (name, curve) in [("as printed", &printed), ("cut first", &cut)] {
        let last = curve.points.last().map_or(0.0, |(_, value)| *value);
        figures.push(figure(
            format!("highlight of (7.12), n = 20, N at a right angle to H, {name}"),
            last,
            3,
        ));
    }
    views.push(View::drawing(
        "highlight",
        "max{[2(N·H)² - 1]^20, 0} as printed, and with the cosine cut first",
        plot("degrees between N and H", "part of k_s I", &[printed, cut]),
    ));
    Ok(Exhibit {
        name: "components",
        title: "The components of a light, and k_s",
        cause: "Ambient light is the same everywhere, diffuse light bends little over a polygon, a highlight much (fig. 7.2). So \
                what can be interpolated linearly depends on k_s beside k_d and k_a: matte, Gouraud shading errs least, in the \
                mean and at most, and both errors grow with k_s. Constant shading is far off whatever k_s is: the sphere is no \
                polyhedron, which is the first of its conditions. The highlight of (7.12) is max{[2(N·H)² - 1]^n, 0}: as printed, an \
                even n makes a second highlight where N is nearly at a right angle to H. Here the cosine is cut to 0 before the \
                power.",
        figures,
        views,
    })
}

/// The scene with k_a, k_d and k_s in tenths.
fn drawn([ambient, diffuse, specular]: [u32; 3], shading: Shading) -> Result<Shaded> {
    let text = SCENE
        .replace("ambient = 0.1 ", &format!("ambient = 0.{ambient} "))
        .replace("diffuse = 0.6", &format!("diffuse = 0.{diffuse}"))
        .replace("specular = 0.3", &format!("specular = 0.{specular}"));
    let scene = Scene::parse(Path::new("components.toml"), &text)?;
    Ok(shade(&scene, &scene.surface(WIDTH, HEIGHT, GUARD), shading, FILL))
}

/// Largest change of the slope from pixel to pixel, where a sphere's border is far.
fn bend(line: &Series) -> f64 {
    let margin = line.points.len() / 8;
    let inner = &line.points[margin..line.points.len() - margin];
    inner.windows(3).map(|w| (w[2].1 - 2.0 * w[1].1 + w[0].1).abs()).fold(0.0, f64::max)
}

/// The highlight by (7.12) for n = 20; what becomes of 2(N·H)² - 1 before the power.
fn highlight(before: fn(f64) -> f64) -> Series {
    let at = |angle: u32| {
        let cosine = f64::from(angle).to_radians().cos();
        (f64::from(angle), before(2.0 * cosine * cosine - 1.0).powi(20).max(0.0))
    };
    let label = if before(-1.0) < 0.0 { "as printed" } else { "cut first" };
    // Behind 90 degrees N·H itself is below 0, and nothing is lit.
    Series { label, points: (0..=90).map(at).collect() }
}
