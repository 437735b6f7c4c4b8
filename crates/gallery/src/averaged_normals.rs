//! Averaged normals (slides, notes): where they hide what they should show, and how a crease brings it back.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use edgewalk_golden::{Picture, Shading, shade};
use edgewalk_scene::{Crease, InputError, NormalRule, Scene, Weight};
use glam::DVec3;
use std::path::Path;

const SCENE: &str = include_str!("../scenes/averaged-normals.toml");

pub(crate) fn averaged_normals() -> anyhow::Result<Exhibit> {
    let folds = |crease: f64, weight: Weight| -> Result<Scene, InputError> {
        let scene = Scene::parse(Path::new("averaged-normals.toml"), SCENE)?;
        let normals = NormalRule { crease: Crease::Angle(crease.to_radians()), weight, ..scene.normals };
        Ok(Scene { normals, ..scene })
    };
    let picture = |scene: &Scene, by| shade(scene, &scene.surface(WIDTH, HEIGHT, GUARD), by, FILL).picture;
    // Angle weights, as a fold is cut into triangles that meet a vertex once or twice.
    let (smooth, creased) = (folds(180.0, Weight::Angle)?, folds(30.0, Weight::Angle)?);
    let gouraud = picture(&smooth, Shading::Gouraud);
    let constant = picture(&smooth, Shading::Constant);
    let sharp = picture(&creased, Shading::Gouraud);
    let plain = picture(&folds(180.0, Weight::Plain)?, Shading::Gouraud);
    let [one, other] = [0, 2].map(|face| normal(&smooth, face));
    Ok(Exhibit {
        name: "averaged-normals",
        title: "Averaged normals and creases (S14, S16)",
        cause: "At every ridge and valley the faces around lean as much to one side as to the other, so the averages all \
                point straight up and the folds are shaded like a plain sheet. A crease angle below that of the folds keeps \
                their normals apart. A plain average counts each triangle once: where two triangles of one fold and one of \
                the other meet, it leans, and the way a quad is cut shows.",
        figures: vec![
            figure("angle between two folds, degrees", one.angle_between(other).to_degrees(), 1),
            figure("range of intensity in the middle, constant, LSB", range(&constant), 1),
            figure("Gouraud, normals averaged by angle, LSB", range(&gouraud), 1),
            figure("Gouraud, normals averaged plainly, LSB", range(&plain), 1),
            figure("Gouraud, crease at 30 degrees, LSB", range(&sharp), 1),
        ],
        views: vec![
            View::colors("constant", "Constant", constant.rgb),
            View::colors("gouraud", "Gouraud, averaged by angle", gouraud.rgb),
            View::colors("plain", "Gouraud, averaged plainly", plain.rgb),
            View::colors("crease", "Gouraud with a crease", sharp.rgb),
        ],
    })
}

fn normal(scene: &Scene, face: usize) -> DVec3 {
    let [a, b, c] = scene.mesh.corners(&scene.mesh.faces()[face]);
    (b - a).cross(c - a)
}

/// Over the middle half of the middle line, where no border of the sheet is near.
fn range(picture: &Picture) -> f64 {
    let line = (HEIGHT / 2 * WIDTH) as usize;
    let middle = &picture.rgb[line + (WIDTH / 3) as usize..line + (2 * WIDTH / 3) as usize];
    let (low, high) = middle.iter().fold((f64::MAX, f64::MIN), |(l, h), c| (l.min(c[1]), h.max(c[1])));
    LSB * (high - low)
}
