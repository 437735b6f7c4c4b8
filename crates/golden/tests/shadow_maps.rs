//! Shadow maps against rays: they disagree only within the bias, or within one texel of an edge. Edges are told apart: the
//! contour, where the light sees the mesh end or turn away, and folds, the other edges of the mesh, where the next polygon
//! may be so much steeper than the point's own that the bias does not cover it.

use edgewalk_golden::{Fill, Rays, ShadowMaps, Weights, draw, fragments};
use edgewalk_scene::{Attenuation, Light, LightView, Scene, ShadeMode};
use glam::{DVec2, DVec3, DVec4};
use std::collections::HashMap;
use std::path::Path;

const SCREEN: (u32, u32) = (240, 180);
const TEXELS: u32 = 512;
const SIDE: f64 = TEXELS as f64;
const SUBPIXEL_BITS: u32 = 8;

/// A visible point: where, on which face, and the unit normal of that face towards the viewer.
struct Seen {
    position: DVec3,
    face: u32,
    normal: DVec3,
}

fn visible(scene: &Scene) -> Vec<Seen> {
    let surface = scene.surface(SCREEN.0, SCREEN.1, 8191.0);
    let frame = scene.frame(SCREEN.0, SCREEN.1, 8191.0, ShadeMode::Gouraud);
    let picture = draw(&frame, Fill::Exact { subpixel_bits: SUBPIXEL_BITS });
    let mut seen = Vec::new();
    for (triangle, id) in surface.triangles.iter().zip(0..) {
        fragments(&triangle.on_screen(), ShadeMode::Gouraud, SUBPIXEL_BITS, SCREEN, |fragment| {
            if picture.id[(fragment.y * SCREEN.0 + fragment.x) as usize] == id {
                let weights = Weights::perspective(fragment, triangle);
                let position = weights.of(triangle.vertices.map(|vertex| vertex.position));
                seen.push(Seen { position, face: triangle.face, normal: triangle.own_normal });
            }
        });
    }
    seen
}

/// One light of each kind, and one with six maps inside the box around the mesh.
fn lights(scene: &Scene) -> Vec<(&'static str, Light)> {
    let [low, high] = scene.mesh.bounds();
    let (middle, size) = ((low + high) / 2.0, (high - low).length());
    let (intensity, attenuation) = (DVec3::ONE, Attenuation::NONE);
    let above = middle + DVec3::new(0.31, 0.8, 0.37) * size;
    vec![
        ("directional", Light::Directional { toward: DVec3::new(-0.45, 0.8, 0.75).normalize(), intensity }),
        ("positional", Light::Positional { position: above, intensity, attenuation }),
        (
            "inside",
            Light::Positional {
                position: middle + DVec3::new(0.03, 0.17, 0.02) * size,
                intensity,
                attenuation,
            },
        ),
        (
            "flood",
            Light::Flood {
                position: above,
                axis: (middle - above).normalize(),
                cone: 0.6,
                exponent: 1.0,
                intensity,
                attenuation,
            },
        ),
    ]
}

/// Places in the lists of [`edges`].
const CONTOUR: usize = 0;
const FOLD: usize = 1;

/// Edges where the mesh ends, or turns from the light's side to the other; and all others.
fn edges(scene: &Scene, light: &Light) -> [Vec<[DVec3; 2]>; 2] {
    let mut sides: HashMap<[u32; 2], Vec<bool>> = HashMap::new();
    for face in scene.mesh.faces() {
        let [a, b, c] = scene.mesh.corners(face);
        let lit = (b - a).cross(c - a).dot(light.incident(a).toward) > 0.0;
        for k in 0..3 {
            let (from, to) = (face.corners[k], face.corners[(k + 1) % 3]);
            sides.entry([from.min(to), from.max(to)]).or_default().push(lit);
        }
    }
    let mut found = [Vec::new(), Vec::new()];
    for ([a, b], lit) in sides {
        let fold = lit.len() == 2 && lit[0] == lit[1];
        found[if fold { FOLD } else { CONTOUR }]
            .push([a, b].map(|place| scene.mesh.positions()[place as usize]));
    }
    found
}

/// Points a quarter of a texel apart on edges, by texel.
fn by_texel(view: &LightView, edges: &[[DVec3; 2]]) -> HashMap<[i64; 2], Vec<DVec2>> {
    let mut found: HashMap<[i64; 2], Vec<DVec2>> = HashMap::new();
    for [a, b] in edges {
        // Both ends beyond one side of the map: so is all between them.
        let ends = [*a, *b].map(|end| view.texels(end));
        let sides: [fn(DVec4) -> f64; 4] = [|p| -p.x, |p| p.x - SIDE * p.w, |p| -p.y, |p| p.y - SIDE * p.w];
        if sides.iter().any(|beyond| ends.iter().all(|end| beyond(*end) > 0.0)) {
            continue;
        }
        let length = match [view.place(*a), view.place(*b)] {
            [Some(a), Some(b)] => a.texel.distance(b.texel),
            // An edge that leaves the map may be long in it.
            _ => 8.0 * SIDE,
        };
        let steps = (length * 4.0).ceil().max(1.0) as u32;
        for k in 0..=steps {
            let point = a.lerp(*b, f64::from(k) / f64::from(steps));
            if let Some(place) = view.place(point) {
                found.entry(place.texel.floor().as_i64vec2().to_array()).or_default().push(place.texel);
            }
        }
    }
    found
}

/// Whether one of the points is at most a texel away, to the sides and up or down.
fn near(points: &HashMap<[i64; 2], Vec<DVec2>>, texel: DVec2) -> bool {
    let [x, y] = texel.floor().as_i64vec2().to_array();
    let around = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| [x + dx, y + dy]));
    // Points are up to an eighth of a texel from the nearest one of their edge.
    around.filter_map(|place| points.get(&place)).flatten().any(|p| (*p - texel).abs().max_element() <= 1.125)
}

/// Scenes with panes, over a floor and beside a sphere.
fn with_glass() -> [(&'static str, Scene); 2] {
    [
        ("glass", include_str!("../../../docs/scenes/glass.toml")),
        ("both", include_str!("../../../docs/scenes/glass-and-shadows.toml")),
    ]
    .map(|(name, text)| (name, Scene::parse(Path::new(name), text).expect("a scene")))
}

/// r_l at faces that hide the light; at those that transmit it the map also counts their own k_t and what lies behind them.
#[test]
fn behind_glass_maps_and_rays_agree_but_within_a_texel_of_an_edge() {
    let (mut total, mut between, mut panes) = ([0; 3], 0, [0; 2]);
    for (name, mut scene) in with_glass() {
        let seen = visible(&scene);
        let (kinds, lights): (Vec<_>, Vec<_>) = lights(&scene).into_iter().unzip();
        scene.lights = lights;
        let (maps, rays) = (ShadowMaps::draw(&scene, TEXELS), Rays::new(&scene.mesh));
        for (l, light) in scene.lights.iter().enumerate() {
            let all = edges(&scene, light).concat();
            let mut by_view: Vec<(LightView, HashMap<_, _>)> = Vec::new();
            let mut count = [0; 3];
            for at in seen.iter().filter(|at| light.incident(at.position).intensity != DVec3::ZERO) {
                let by_map = maps.transmitted(l, at.position, at.normal);
                let by_ray = rays.transmitted(light, at.position, at.face);
                let material = scene.mesh.faces()[at.face as usize].material;
                if scene.mesh.materials()[material as usize].transmission > 0.0 {
                    panes[0] += 1;
                    panes[1] += u64::from(by_map > 0.0 && by_map < by_ray);
                    continue;
                }
                count[0] += 1;
                between += u64::from(by_ray > 0.0 && by_ray < 1.0);
                if (by_map - by_ray).abs() < 1e-12 {
                    continue;
                }
                let (view, _) = maps.bias(l, at.position, at.normal).expect("a lit point has a texel");
                let texel = view.place(at.position).expect("in this view").texel;
                let place = by_view.iter().position(|(other, _)| other == view).unwrap_or_else(|| {
                    by_view.push((*view, by_texel(view, &all)));
                    by_view.len() - 1
                });
                count[if near(&by_view[place].1, texel) { 1 } else { 2 }] += 1;
            }
            println!(
                "{name:6} {:11} {:6} points, {:4} differ within a texel of an edge, elsewhere {}",
                kinds[l], count[0], count[1], count[2]
            );
            total.iter_mut().zip(count).for_each(|(sum, count)| *sum += count);
        }
    }
    let [points, edge, other] = total;
    println!(
        "checked {points} values of r_l, {between} of them between 0 and 1: {edge} differ within a texel of an edge, {other} elsewhere; \
         of {} points of panes {} are darker by the map",
        panes[0], panes[1]
    );
    assert!(points > 50_000 && between > 5_000 && other == 0 && edge * 50 < points);
    assert!(panes[1] * 2 > panes[0], "a pane counts itself");
}

#[test]
fn maps_and_rays_agree_but_within_the_bias_and_a_texel_of_an_edge() {
    let mut total = [0; 5];
    for name in Scene::BUILTIN {
        let mut scene = Scene::builtin(name).expect("a built-in scene");
        let seen = visible(&scene);
        let (kinds, lights): (Vec<_>, Vec<_>) = lights(&scene).into_iter().unzip();
        scene.lights = lights;
        let (maps, rays) = (ShadowMaps::draw(&scene, TEXELS), Rays::new(&scene.mesh));
        for (l, light) in scene.lights.iter().enumerate() {
            let edges = edges(&scene, light);
            let mut by_view: [Vec<(LightView, HashMap<_, _>)>; 2] = [Vec::new(), Vec::new()];
            // Whether an edge of this kind is near: of most views and kinds nobody asks.
            let mut near_edge = |view: &LightView, kind: usize, texel| {
                let known = &mut by_view[kind];
                let place = known.iter().position(|(other, _)| other == view).unwrap_or_else(|| {
                    known.push((*view, by_texel(view, &edges[kind])));
                    known.len() - 1
                });
                near(&known[place].1, texel)
            };
            let (mut points, mut shadow, mut bias, mut contour, mut fold, mut other) = (0, 0, 0, 0, 0, 0);
            for at in &seen {
                if light.incident(at.position).intensity == DVec3::ZERO {
                    continue;
                }
                points += 1;
                let by_map = maps.transmitted(l, at.position, at.normal) == 1.0;
                let hidden = rays.nearest_opaque(light, at.position, at.face);
                shadow += u64::from(hidden.is_some());
                assert_eq!(hidden.is_none(), rays.transmitted(light, at.position, at.face) == 1.0);
                if by_map == hidden.is_none() {
                    continue;
                }
                let (view, allowed) = maps.bias(l, at.position, at.normal).expect("a lit point has a texel");
                let place = view.place(at.position).expect("in this view");
                let gap = hidden.map_or(f64::INFINITY, |distance| {
                    let occluder = at.position + light.incident(at.position).toward * distance;
                    view.place(occluder).map_or(f64::INFINITY, |there| place.distance - there.distance)
                });
                let count = if near_edge(view, CONTOUR, place.texel) {
                    &mut contour
                } else if gap <= allowed {
                    &mut bias
                } else if near_edge(view, FOLD, place.texel) {
                    &mut fold
                } else {
                    &mut other
                };
                *count += 1;
            }
            println!(
                "{name:10} {:11} {points:6} points, {shadow:6} in shadow; disagree within a texel of the contour {contour:4}, \
                 else within the bias {bias:3}, within a texel of a fold {fold:2}, elsewhere {other}",
                kinds[l]
            );
            for (sum, count) in total.iter_mut().zip([points, bias, contour, fold, other]) {
                *sum += count;
            }
        }
    }
    let [points, bias, contour, fold, other] = total;
    println!(
        "checked {points} decisions: {contour} differ within a texel of the contour, else {bias} within the bias, {fold} \
         within a texel of a fold, {other} elsewhere"
    );
    assert!(points > 400_000 && other == 0 && (bias + fold) * 1000 < points);
}
