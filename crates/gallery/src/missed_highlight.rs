//! A highlight inside a polygon that Gouraud shading misses (slides, notes).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use crate::machine::Beside;
use edgewalk_golden::{Shading, shade};
use edgewalk_scene::{PixelMethod, Scene};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/missed-highlight.toml");

/// The light, and where it stands for its highlight to lie on a vertex of the square.
const LIGHT: &str = "position = [0, 0.7, -0.6]";
const OVER_VERTEX: &str = "position = [1.318, 0.7, 0.618]";

/// Squares along a side of the finer scene.
const FINE: u32 = 16;

pub(crate) fn missed_highlight() -> anyhow::Result<Exhibit> {
    let scene = Scene::parse(Path::new("missed-highlight.toml"), SCENE)?;
    let fine = Scene::parse(Path::new("missed-highlight.toml"), &cut_up(SCENE))?;
    let draw = |scene: &Scene, by| shade(scene, &scene.surface(WIDTH, HEIGHT, GUARD), by, FILL);
    let [gouraud, phong] = [Shading::Gouraud, Shading::Phong].map(|by| draw(&scene, by));
    let fine = draw(&fine, Shading::Phong);
    let green = |rgb: &[[f64; 3]]| LSB * rgb[brightest(rgb)][1];
    let moved = |rgb: &[[f64; 3]], truth: &[[f64; 3]]| {
        let [[x, y], [u, v]] = [rgb, truth].map(|rgb| {
            let at = brightest(rgb) as u32;
            [f64::from(at % WIDTH), f64::from(at / WIDTH)]
        });
        (x - u).hypot(y - v)
    };
    let over_vertex = Scene::parse(Path::new("missed-highlight.toml"), &SCENE.replace(LIGHT, OVER_VERTEX))?;
    let smeared = draw(&over_vertex, Shading::Gouraud);
    let wide = |rgb: &[[f64; 3]]| {
        let most = rgb[brightest(rgb)][1];
        rgb.iter().filter(|rgb| 2.0 * rgb[1] > most).count() as f64
    };
    let machine = Beside::of(&scene, PixelMethod::FastPhong)?;
    let mut exhibit = Exhibit {
        name: "missed-highlight",
        title: "The missed highlight (S16)",
        cause: "Gouraud shading evaluates the equation at the vertices only. A highlight that lies inside a polygon \
                reaches none of them and is lost; one that lies on a vertex is smeared over its polygons. Phong shading \
                finds it, as bright as it is, but not in its place: it interpolates the point that is lit linearly over \
                the screen, where the far half of a square in perspective takes less room than the near one. Highlight \
                against no highlight at the same pixel makes an error nearly as large as Gouraud's, in a picture that \
                looks right. The finer the polygons, the nearer it comes.",
        figures: vec![
            figure("brightest green, Gouraud, LSB", green(&gouraud.picture.rgb), 1),
            figure("brightest green, Phong, LSB", green(&phong.picture.rgb), 1),
            figure("brightest green, truth, LSB", green(&gouraud.truth), 1),
            figure("Gouraud: largest error, LSB", gouraud.error().max, 1),
            figure("Phong: largest error, LSB", phong.error().max, 1),
            figure("Phong: highlight beside its place, pixels", moved(&phong.picture.rgb, &phong.truth), 1),
            figure("Phong, 16 x 16 squares for the one: largest error, LSB", fine.error().max, 1),
            figure(
                "Phong, 16 x 16: highlight beside its place, pixels",
                moved(&fine.picture.rgb, &fine.truth),
                1,
            ),
            figure("light over a vertex: brightest green, Gouraud, LSB", green(&smeared.picture.rgb), 1),
            figure("light over a vertex: brightest green, truth, LSB", green(&smeared.truth), 1),
            figure("light over a vertex: pixels above half of it, Gouraud", wide(&smeared.picture.rgb), 0),
            figure("light over a vertex: pixels above half of it, truth", wide(&smeared.truth), 0),
        ],
        views: vec![
            View::colors(
                "vertex",
                "Gouraud, the highlight on a vertex: smeared over the square",
                smeared.picture.rgb,
            ),
            View::colors("gouraud", "Gouraud", gouraud.picture.rgb),
            View::colors("phong", "Phong: a highlight, but too far down and to the right", phong.picture.rgb),
            View::colors("truth", "Truth", gouraud.truth),
        ],
    };
    exhibit.figures.extend(machine.figures());
    exhibit.views.extend(machine.views());
    Ok(exhibit)
}

/// The pixel with the most green.
fn brightest(rgb: &[[f64; 3]]) -> usize {
    let pixels = rgb.iter().enumerate();
    pixels.max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1])).map_or(0, |(at, _)| at)
}

/// The scene with its square in many.
fn cut_up(scene: &str) -> String {
    let line = |key: &str, items: Vec<String>| format!("{key} = [{}]", items.join(", "));
    let at = |k: u32| 2.0 * f64::from(k) / f64::from(FINE) - 1.0;
    let places = (0..=FINE).flat_map(|j| (0..=FINE).map(move |i| (i, j)));
    let positions = places.map(|(i, j)| format!("[{}, 0, {}]", at(i), at(j))).collect();
    let corner = |i: u32, j: u32| j * (FINE + 1) + i;
    let squares = (0..FINE).flat_map(|j| (0..FINE).map(move |i| (i, j)));
    let face = |(i, j): (u32, u32)| {
        format!("{:?}", [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)])
    };
    let (positions, faces) = (line("positions", positions), line("faces", squares.map(face).collect()));
    let replaced = scene.lines().map(|text| match text.split_once(" = ") {
        Some(("positions", _)) => positions.as_str(),
        Some(("faces", _)) => faces.as_str(),
        _ => text,
    });
    replaced.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::collections::BTreeMap;

    #[test]
    fn a_square_cut_up_is_as_large_and_lies_as_before() {
        let scene = |text: &str| Scene::parse(Path::new("a.toml"), text).expect("a scene");
        let (whole, cut) = (scene(SCENE), scene(&cut_up(SCENE)));
        assert_eq!((whole.mesh.faces().len(), cut.mesh.faces().len()), (2, 512));
        let mut squares = BTreeMap::new();
        for face in cut.mesh.faces() {
            let [a, b, c] = cut.mesh.corners(face);
            // Half of a square with sides of 1/8, facing up.
            assert_eq!((b - a).cross(c - a), DVec3::Y / 64.0, "{a} {b} {c}");
            let [x, z] = [a.x + b.x + c.x, a.z + b.z + c.z].map(|sum| (8.0 * sum / 3.0).floor() as i32);
            *squares.entry([x, z]).or_insert(0) += 1;
        }
        // From -1 to 1 each way.
        assert!(
            squares.len() == 256
                && squares
                    .iter()
                    .all(|([x, z], halves)| { (-8..8).contains(x) && (-8..8).contains(z) && *halves == 2 }),
            "{squares:?}"
        );
        assert_eq!(cut.mesh.materials(), whole.mesh.materials());
        assert_eq!((cut.lights, cut.ambient, cut.camera), (whole.lights, whole.ambient, whole.camera));
    }
}
