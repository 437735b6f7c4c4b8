//! Shadows and blending of a frame: hand cases at texel borders, and random frames against a second rasterizer.
//!
//! The second rasterizer asks for every pixel whether the centre, moved right by an infinitely small amount and down by an
//! infinitely smaller one, lies strictly inside; it keeps a list of fragments a pixel and composes it afterwards.

use edgewalk_golden::{Fill, Lit, Picture, draw};
use edgewalk_scene::{Blending, DepthFunc, Frame, Pane, ShadeMode, Shadow, Triangle, Vertex, triangle_file};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const EXACT: Fill = Fill::Exact { subpixel_bits: 8 };
const IDENTITY: &str = "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1";
/// White, depth 1/2, over all of a screen of 4 x 4.
const WHITE: &str = "T 0 0 .5 1 1 1 0  8 0 .5 1 1 1 0  0 8 .5 1 1 1 0";

fn picture(text: &str, fill: Fill) -> Picture {
    draw(&triangle_file::parse("a.tri", text.as_bytes()).expect("a good file"), fill)
}

/// The numbers of `lit`, a line a word.
fn lit(text: &str) -> String {
    let picture = picture(text, EXACT);
    let digits: Vec<String> = picture.lit.iter().map(|lit| (*lit as u8).to_string()).collect();
    digits.chunks(picture.width as usize).map(|line| line.concat()).collect::<Vec<_>>().join(" ")
}

/// An occluder that covers texels 0..width of every line of a map of 4 x 4, at depth z.
fn occluder(width: f64, z: f64) -> String {
    format!("L 0 0 {z}  {width} 0 {z}  0 4 {z}\nL {width} 0 {z}  {width} 4 {z}  0 4 {z}")
}

#[test]
fn the_page_of_the_format_shows_a_shadow_on_the_left_half() {
    let page = include_str!("../../../docs/triangle_file.md");
    let example = page.rsplit("```").nth(1).expect("an example at the end");
    assert_eq!(lit(example), "1122 1122 1122 1122");
    let picture = picture(example, EXACT);
    assert_eq!((picture.rgb[0], picture.rgb[3]), ([0.25; 3], [1.0; 3]));
}

#[test]
fn nothing_shadow_lit_by_the_last_fragment_written() {
    let half = "T 0 0 .5 1 1 1 0  2 0 .5 1 1 1 0  0 8 .5 1 1 1 0";
    assert_eq!(
        lit(&format!("size 4 2\n{half}")),
        "2200 2200",
        "without a light that casts shadows all are lit"
    );
    let shadow = format!("size 4 2\nshadow 4 0 .5 {IDENTITY}\n{}\n", occluder(1.0, 0.25));
    assert_eq!(lit(&format!("{shadow}{half}")), "1200 1200");
    let in_front = half.replace(".5", ".125");
    assert_eq!(lit(&format!("{shadow}{half}\n{in_front}")), "2200 2200", "a lit fragment in front");
    assert_eq!(
        lit(&format!("{shadow}{in_front}\n{half}")),
        "2200 2200",
        "the farther one fails and leaves lit alone"
    );
    assert_eq!(lit(&format!("{shadow}depth never\n{half}")), "0000 0000");
}

#[test]
fn texel_borders() {
    // A pixel's centre 0.5 moved to the border 1 of texels 0 | 1: the right texel has it, as floor says.
    for (offset, row) in [("0.5", "2222"), ("0.499999", "1222"), ("-0.5", "1222"), ("-0.500001", "2122")] {
        let matrix = format!("1 0 0 {offset}  0 1 0 0  0 0 1 0  0 0 0 1");
        let text = format!("size 4 4\nshadow 4 0 0 {matrix}\n{}\n{WHITE}", occluder(1.0, 0.25));
        assert_eq!(lit(&text).split(' ').next(), Some(row), "offset {offset}");
    }
    // The map's far border: x = SIZE is outside.
    for (offset, row) in [("0.5", "1112"), ("0.499999", "1111")] {
        let matrix = format!("1 0 0 {offset}  0 1 0 0  0 0 1 0  0 0 0 1");
        let text = format!("size 4 4\nshadow 4 0 0 {matrix}\n{}\n{WHITE}", occluder(4.0, 0.25));
        assert_eq!(lit(&text).split(' ').next(), Some(row), "offset {offset}");
    }
}

#[test]
fn depth_as_far_as_map_and_bias_is_lit() {
    let with = |bias: &str, z: f64| {
        lit(&format!("size 4 4\nshadow 4 {bias} 0 {IDENTITY}\n{}\n{WHITE}", occluder(4.0, z)))
    };
    assert_eq!(with("0", 0.5), "2222 2222 2222 2222");
    assert_eq!(with("0", 0.5 - f64::EPSILON), "1111 1111 1111 1111");
    assert_eq!(with("0.25", 0.25), "2222 2222 2222 2222");
    assert_eq!(with("0.25", 0.25 - f64::EPSILON), "1111 1111 1111 1111");
    assert_eq!(with("-0.125", 0.5), "1111 1111 1111 1111", "a negative bias");
}

#[test]
fn the_empty_map_holds_depth_one() {
    let with = |depth: &str| {
        lit(&format!("size 4 4\nshadow 4 0 0 1 0 0 0  0 1 0 0  0 0 0 {depth}  0 0 0 1\n{WHITE}"))
    };
    assert_eq!(with("1"), "2222 2222 2222 2222");
    assert_eq!(with("1.5"), "1111 1111 1111 1111");
}

#[test]
fn perspective_divides_and_nothing_is_behind_the_light() {
    // q = x/2 + 1/4 at pixel i is 1/2, 1, 3/2, 2: X = 3 x^2 is no plane, so X = 3 q, one texel everywhere; depth z / q.
    let matrix = ["1.5 0 0 .75", "0 1 0 0", "0 0 1 0", ".5 0 0 .25"];
    // Y = y must be y/q: texel lines differ, so the occluder covers all lines.
    let text = |m: &str, z: f64| format!("size 4 1\nshadow 4 0 0 {m}\n{}\n{WHITE}", occluder(4.0, z));
    // Depths 1, 1/2, 1/3, 1/4.
    assert_eq!(lit(&text(&matrix.join(" "), 0.4)), "1122");
    assert_eq!(lit(&text(&matrix.join(" "), 0.3)), "1112");
    let negative = "-1.5 0 0 -.75  0 -1 0 0  0 0 -1 0  -.5 0 0 -.25";
    assert_eq!(lit(&text(negative, 0.4)), "2222", "q < 0 is behind the light");
    // q = x - 2 is negative in the left half; divided, all of it would be texel (1, 1) at depth 1.
    let behind = ["1 0 0 -2"; 4].join("  ");
    assert_eq!(lit(&text(&behind, 0.3)), "2211", "only what lies before the light is looked up");
    assert_eq!(lit(&text("1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 0", 0.1)), "2222", "q = 0 is outside the map");
    assert_eq!(lit(&text("0 0 0 0  0 0 0 0  0 0 1 0  0 0 0 0", 0.1)), "2222", "0 / 0 too");
}

#[test]
fn the_map_is_snapped_and_filled_as_the_picture_is() {
    // 0.501 snaps to 0.5: the centre of texel 0 is on the left edge, thus in.
    let text = format!("size 4 1\nshadow 4 0 0 {IDENTITY}\nL .501 0 .1  3 0 .1  .501 4 .1\n{WHITE}");
    assert_eq!(lit(&text), "1112");
    let textbook = picture(&text.replace(".501", "0"), Fill::Textbook);
    assert_eq!(textbook.lit[..4], [Lit::Shadow; 4], "the listing draws texels 0 to 3 inclusive");
}

#[test]
fn shadow_before_blending() {
    // Back 0.8 lit, front 0.5 kt 0.25 in shadow of ambient 0.5: 0.75 * 0.25 + 0.25 * 0.8.
    let t = |z: f64, shade: f64, kt: f64| {
        WHITE.replace(".5 1 1 1 0", &format!("{z} {shade} {shade} {shade} {kt}"))
    };
    let text = format!(
        "size 4 4\nblend 1\nshadow 4 0 .5 1 0 0 0  0 1 0 0  0 0 -1 1  0 0 0 1\n{}\n{}\n{}",
        occluder(2.0, 0.25),
        t(0.75, 0.8, 0.0),
        t(0.5, 0.5, 0.25)
    );
    for fill in [EXACT, Fill::Textbook] {
        let picture = picture(&text, fill);
        // The triangles have no upper half, so that the listing too draws every line once.
        assert!(
            (picture.rgb[4][0] - (0.75 * 0.25 + 0.25 * 0.8)).abs() < 1e-15,
            "{fill:?}: {:?}",
            picture.rgb[4]
        );
        assert_eq!(picture.lit[4], Lit::Shadow);
        assert_eq!(picture.lit[7], Lit::Lit);
    }
}

#[test]
fn flat_takes_kt_of_the_first_vertex() {
    let text = |mode: &str| {
        format!(
            "size 4 4\nmode {mode}\nblend 1\nclear 1 1 1\nT 0 0 .5 0 0 0 .25  8 0 .5 1 1 1 1  0 8 .5 1 1 1 1"
        )
    };
    assert_eq!(picture(&text("flat"), EXACT).rgb[5], [0.25; 3]);
    // At (1.5, 1.5): weight of the first vertex 5/8, kt = 0.625 * 0.25 + 0.375, I = 0.375.
    let kt = 0.625 * 0.25 + 0.375;
    assert!((picture(&text("gouraud"), EXACT).rgb[5][0] - ((1.0 - kt) * 0.375 + kt)).abs() < 1e-15);
}

/// x, y in 1/256 pixel and the rest as it is.
fn corners(triangle: &Triangle, subpixel_bits: u32) -> [[i128; 2]; 3] {
    let scale = f64::from(1 << subpixel_bits);
    let snap = |v: f64| ((v * scale).round_ties_even() as i128) << (8 - subpixel_bits);
    triangle.0.map(|v| [snap(v.x), snap(v.y)])
}

/// The weights of the corners at a pixel, if its centre is inside.
fn weights(corners: &[[i128; 2]; 3], x: u32, y: u32) -> Option<[f64; 3]> {
    // A centre in 1/2^60 of 1/256 px, moved by 2^20 and 1 of these.
    let centre = [i128::from(x) * 256 + 128, i128::from(y) * 256 + 128];
    let area = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let total = area(corners[0], corners[1], corners[2]);
    let mut found = [0.0; 3];
    for k in 0..3 {
        let (a, b) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let weight = area(a, b, centre) * total.signum();
        let moved = (weight << 60) + ((b[0] - a[0]) - ((b[1] - a[1]) << 20)) * total.signum();
        if moved <= 0 {
            return None;
        }
        found[k] = weight as f64 / total.abs() as f64;
    }
    Some(found)
}

/// What the second rasterizer says of a pixel; `None` where a decision is too near for f64.
fn expected(
    frame: &Frame,
    subpixel_bits: u32,
    map: &[(f64, f64)],
    x: u32,
    y: u32,
) -> Option<(f64, [f64; 3], u8)> {
    let (mut z, mut rgb, mut lit) = (1.0, frame.clear, 0);
    for triangle in &frame.triangles {
        let Some(w) = weights(&corners(triangle, subpixel_bits), x, y) else { continue };
        let plane = |a: fn(&Vertex) -> f64| (0..3).map(|k| w[k] * a(&triangle.0[k])).sum::<f64>();
        let new = plane(|v| v.z);
        if let Some(func) = frame.depth {
            let same = (new - z).abs() < 1e-12;
            let passes = match func {
                DepthFunc::Never => false,
                DepthFunc::Always => true,
                _ if same => return None,
                DepthFunc::Less | DepthFunc::Lequal => new < z,
                DepthFunc::Greater | DepthFunc::Gequal => new > z,
                DepthFunc::Equal => false,
                DepthFunc::Notequal => true,
            };
            if !passes {
                continue;
            }
        }
        let mut front = match frame.mode {
            ShadeMode::Gouraud => [plane(|v| v.r), plane(|v| v.g), plane(|v| v.b), plane(|v| v.kt)],
            ShadeMode::Flat => [triangle.0[0].r, triangle.0[0].g, triangle.0[0].b, triangle.0[0].kt],
        };
        lit = 2;
        if let Some(shadow) = frame.shadow(1) {
            let m = |r: usize| {
                let [a, b, c, d] = shadow.matrix[r];
                d + c * new + b * (f64::from(y) + 0.5) + a * (f64::from(x) + 0.5)
            };
            let [tx, ty, depth] = [0, 1, 2].map(|r| m(r) / m(3));
            if (tx - tx.round()).abs() < 1e-9 || (ty - ty.round()).abs() < 1e-9 {
                return None;
            }
            let side = f64::from(shadow.size);
            if m(3) > 0.0 && tx > 0.0 && tx < side && ty > 0.0 && ty < side {
                let (stored, left) = map[ty as usize * shadow.size as usize + tx as usize];
                if (depth - stored - shadow.bias).abs() < 1e-9 || (depth - shadow.bias).abs() < 1e-9 {
                    return None;
                }
                let lights = shadow.ambient..1.0; // what is left is between these two
                let share = match depth > stored + shadow.bias {
                    true => lights.start,
                    false if depth < shadow.bias => lights.end,
                    false => lights.start * (1.0 - left) + lights.end * left,
                };
                lit = if depth > stored + shadow.bias { 1 } else { 2 };
                (0..3).for_each(|c| front[c] *= share);
            }
        }
        let kt = if frame.blend == Blending::Mix { front[3] } else { 0.0 };
        rgb = [0, 1, 2].map(|c| front[c] - kt * front[c] + kt * rgb[c]);
        if frame.depth_write {
            z = new;
        }
    }
    Some((z, rgb, lit))
}

fn random(random: &mut Pcg64Mcg) -> Frame {
    let side = random.random_range(1..=24);
    let mut frame = Frame::new(side, random.random_range(1..=24));
    frame.mode = ShadeMode::ALL[random.random_range(0..2)];
    frame.depth = [
        None,
        Some(DepthFunc::Less),
        Some(DepthFunc::Lequal),
        Some(DepthFunc::Notequal),
        Some(DepthFunc::Always),
    ][random.random_range(0..5)];
    frame.depth_write = frame.depth.is_some() && random.random_bool(0.7);
    frame.blend = if random.random_bool(0.7) { Blending::Mix } else { Blending::Off };
    frame.clear = random.random();
    let point = |random: &mut Pcg64Mcg| {
        // Half of them on multiples of a quarter pixel, so that centres meet edges.
        let grid = if random.random_bool(0.5) { 4.0 } else { 1e6 };
        let mut at = || (random.random_range(-8.0..32.0f64) * grid).round() / grid;
        [at(), at(), random.random()]
    };
    for _ in 0..random.random_range(1..12) {
        frame.triangles.push(Triangle([0; 3].map(|_| {
            let ([x, y, z], [r, g, b, kt]) = (point(random), random.random::<[f64; 4]>());
            Vertex { x, y, z, r, g, b, kt, ..Vertex::default() }
        })));
    }
    if random.random_bool(0.8) {
        let mut near = |centre: f64, spread: f64| centre + spread * random.random_range(-1.0..1.0);
        let perspective = near(0.0, 1.0) > 0.0;
        let tilt = if perspective { 0.02 } else { 0.0 };
        let matrix = [
            [near(1.0, 0.5), near(0.0, 0.5), near(0.0, 6.0), near(0.0, 6.0)],
            [near(0.0, 0.5), near(1.0, 0.5), near(0.0, 6.0), near(0.0, 6.0)],
            [near(0.0, 0.01), near(0.0, 0.01), near(0.5, 0.5), near(0.25, 0.2)],
            [near(0.0, tilt), near(0.0, tilt), near(0.0, tilt * 10.0), 1.0],
        ];
        let (bias, ambient) = (near(0.0, 0.05), near(0.5, 0.5));
        let size = random.random_range(1..=32);
        let triangles = (0..random.random_range(0..8)).map(|_| [0; 3].map(|_| point(random))).collect();
        let pane =
            |random: &mut Pcg64Mcg| Pane { corners: [0; 3].map(|_| point(random)), kt: random.random() };
        let panes = (0..random.random_range(0..6)).map(|_| pane(random)).collect();
        frame.shadows = vec![Shadow { size, bias, slopes: Vec::new(), ambient, matrix, triangles, panes }];
    }
    frame
}

#[test]
fn random_frames_against_a_second_rasterizer() {
    let mut source = Pcg64Mcg::seed_from_u64(31);
    let (mut checked, mut skipped, mut kinds) = (0, 0, [0; 3]);
    for _ in 0..400 {
        let frame = random(&mut source);
        let subpixel_bits = source.random_range(0..=8);
        let picture = draw(&frame, Fill::Exact { subpixel_bits });
        let map = frame.shadow(1).map_or(Vec::new(), |shadow| {
            let on_map =
                |t: &[[f64; 3]; 3]| Triangle(t.map(|[x, y, z]| Vertex { x, y, z, ..Vertex::default() }));
            let triangles: Vec<Triangle> = shadow.triangles.iter().map(on_map).collect();
            let panes: Vec<Triangle> = shadow.panes.iter().map(|pane| on_map(&pane.corners)).collect();
            let depth = |t: &Triangle, i: u32| {
                let w = weights(&corners(t, subpixel_bits), i % shadow.size, i / shadow.size)?;
                Some((0..3).map(|k| w[k] * t.0[k].z).sum::<f64>())
            };
            let texel = |i: u32| {
                let nearest = triangles.iter().filter_map(|t| depth(t, i)).fold(1.0, f64::min);
                let before =
                    shadow.panes.iter().zip(&panes).filter(|(_, t)| depth(t, i).is_some_and(|z| z < nearest));
                (nearest, before.map(|(pane, _)| pane.kt).product::<f64>())
            };
            (0..shadow.size * shadow.size).map(texel).collect()
        });
        for (at, place) in (0..frame.width * frame.height).enumerate() {
            let (x, y) = (place % frame.width, place / frame.width);
            let Some((z, rgb, lit)) = expected(&frame, subpixel_bits, &map, x, y) else {
                skipped += 1;
                continue;
            };
            assert_eq!(picture.lit[at] as u8, lit, "pixel {x}, {y} of {frame:?}");
            assert!((picture.z[at] - z).abs() < 1e-12, "pixel {x}, {y}: {} {z}", picture.z[at]);
            for c in 0..3 {
                assert!(
                    (picture.rgb[at][c] - rgb[c]).abs() < 1e-12,
                    "pixel {x}, {y}: {:?} {rgb:?}",
                    picture.rgb[at]
                );
            }
            checked += 1;
            kinds[usize::from(lit)] += 1;
        }
    }
    println!(
        "checked {checked} pixels (nothing, shadow, lit: {kinds:?}), {skipped} too near to decide, 0 differ"
    );
    assert!(checked > 10_000 && skipped * 100 < checked && kinds.iter().all(|count| *count > 1000));
}
