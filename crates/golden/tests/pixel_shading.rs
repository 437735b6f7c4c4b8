//! Frames with normals: Phong and fast Phong against numbers by hand and against the equation written once more.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_golden::{Fill, Picture, PixelBrush, Texel, draw, fragments};
use edgewalk_scene::{
    Attenuation, Light, Material, PixelMethod, PixelShading, PixelTriangle, Scene, ShadeMode, Specular,
    Triangle, Vertex, Viewer, triangle_file,
};
use glam::{DVec2, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const EXACT: Fill = Fill::Exact { subpixel_bits: 8 };

fn picture(text: &str) -> Picture {
    draw(&triangle_file::parse("a.tri", text.as_bytes()).unwrap(), EXACT)
}

/// The equation of one colour: surface c, normal, coefficients, suns (direction, intensity), viewer, form.
fn equation(
    c: f64,
    n: DVec3,
    [ka, kd, ks, exponent]: [f64; 4],
    suns: &[(DVec3, f64)],
    v: DVec3,
    blinn: bool,
) -> f64 {
    let n = n / n.dot(n).sqrt();
    let mut sum = c * ka;
    for (l, i) in suns {
        let cosine = n.dot(*l);
        if cosine > 0.0 {
            let h = (*l + v) / (*l + v).length();
            let f = if blinn { n.dot(h) } else { 2.0 * n.dot(h).max(0.0).powi(2) - 1.0 };
            sum += c * kd * i * cosine + ks * i * f.max(0.0).powf(exponent);
        }
    }
    sum.clamp(0.0, 1.0)
}

#[test]
fn a_flat_normal_by_hand() {
    // N·L = 0.8, N·H: H = (0.6, 0, 1.8)/sqrt 3.6, so N·H = sqrt 0.9 and 2 (N·H)² - 1 = 0.8.
    for (mode, blinn) in [("phong", false), ("fast-phong", false), ("phong", true), ("fast-phong", true)] {
        let form = if blinn { "blinn" } else { "halfway" };
        let text = format!(
            "size 4 4\nmode {mode}\nview 0 0 1\nsun 0.6 0 0.8 0.5\nspecular {form}\nmaterial 0.1 0.5 0.4 2\n\
             T 0 0 0 1 0.5 0 0  9 0 0 1 0.5 0 0  0 9 0 1 0.5 0 0\nN 0 0 1  0 0 1  0 0 1"
        );
        let highlight = 0.4 * 0.5 * if blinn { 0.9 } else { 0.64 };
        let wanted = [1.0, 0.5, 0.0].map(|c| c * (0.1 + 0.5 * 0.5 * 0.8) + highlight);
        let found = picture(&text).rgb[0];
        for (a, b) in found.into_iter().zip(wanted) {
            assert!((a - b).abs() < 1e-12, "{mode} {form}: {found:?} {wanted:?}");
        }
    }
}

#[test]
fn below_the_surface_there_is_ambient_light_alone_and_too_much_is_cut() {
    for mode in ["phong", "fast-phong"] {
        let text = |z: f64, n: &str| {
            format!(
                "size 4 4\nmode {mode}\nview 0 0 1\nsun 0 0 {z} 3\nmaterial 0.25 0.5 1 1\n\
                 T 0 0 0 1 0.5 0 0  9 0 0 1 0.5 0 0  0 9 0 1 0.5 0 0\nN {n} {n} {n}"
            )
        };
        assert_eq!(picture(&text(-1.0, "0 0 1")).rgb[0], [0.25, 0.125, 0.0], "{mode}");
        assert_eq!(picture(&text(1.0, "0 0 1")).rgb[0], [1.0; 3], "{mode}");
        // N·L = 0 is not above the surface.
        assert_eq!(picture(&text(1.0, "1 0 0")).rgb[0], [0.25, 0.125, 0.0], "{mode}");
    }
}

const CURVED: &str = "view 0.2 -0.1 1\nsun 0.3 0.4 0.5 0.7\nsun -0.6 0.1 0.4 0.4\nmaterial 0.1 0.6 0.5 12\n\
    T 1.25 0.5 0.1 1 0 0.3 0  60 7 0.2 0.2 1 0.6 0  11 50.5 0.9 0.6 0.4 0 0\nN 0.2 0.1 0.9747  -0.1 0.5 0.8602  0.4 -0.5 0.7681";

/// What `CURVED` says once more: normals of length 1, suns, viewer.
fn curved() -> ([DVec3; 3], Vec<(DVec3, f64)>, DVec3) {
    let normals = [[0.2, 0.1, 0.9747], [-0.1, 0.5, 0.8602], [0.4, -0.5, 0.7681]];
    let suns =
        vec![(DVec3::new(0.3, 0.4, 0.5).normalize(), 0.7), (DVec3::new(-0.6, 0.1, 0.4).normalize(), 0.4)];
    (normals.map(|n| DVec3::from(n).normalize()), suns, DVec3::new(0.2, -0.1, 1.0).normalize())
}

/// What the vertices weigh, by solving for them.
fn shares(x: u32, y: u32) -> [f64; 3] {
    let [p, q, r] = [(1.25, 0.5), (60.0, 7.0), (11.0, 50.5)];
    let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
    let cross = |a: (f64, f64), b: (f64, f64)| (a.0 - x) * (b.1 - y) - (a.1 - y) * (b.0 - x);
    let parts = [cross(q, r), cross(r, p), cross(p, q)];
    let sum: f64 = parts.iter().sum();
    parts.map(|part| part / sum)
}

#[test]
fn phong_is_the_equation_at_each_pixel() {
    let (normals, suns, view) = curved();
    for blinn in [false, true] {
        let form = if blinn { "blinn" } else { "halfway" };
        let text = format!("size 64 64\nmode phong\nspecular {form}\n{CURVED}");
        let drawn = picture(&text);
        let (mut checked, mut worst) = (0, 0f64);
        for (at, _) in drawn.id.iter().enumerate().filter(|(_, id)| **id == 0) {
            let [a, b, c] = shares(at as u32 % 64, at as u32 / 64);
            let normal = normals[0] * a + normals[1] * b + normals[2] * c;
            for (channel, colors) in
                [[1.0, 0.2, 0.6], [0.0, 1.0, 0.4], [0.3, 0.6, 0.0]].into_iter().enumerate()
            {
                let surface = colors[0] * a + colors[1] * b + colors[2] * c;
                let wanted = equation(surface, normal, [0.1, 0.6, 0.5, 12.0], &suns, view, blinn);
                worst = worst.max((drawn.rgb[at][channel] - wanted).abs());
                checked += 1;
            }
        }
        println!("{form}: {checked} colours, {worst:e} from the equation");
        assert!(checked > 3000 && worst < 1e-12);
    }
}

#[test]
fn fast_phong_goes_through_six_points() {
    let (normals, suns, view) = curved();
    let text = format!("size 64 64\nmode fast-phong\nspecular blinn\n{CURVED}");
    let (drawn, phong) = (picture(&text), picture(&text.replace("fast-phong", "phong")));
    let unit = |n: DVec3| n / n.length();
    // The quadratic through the six values, by Lagrange's functions.
    let quadratic = |direction: DVec3, [a, b, c]: [f64; 3]| {
        let corner = |k: usize| unit(normals[k]).dot(direction);
        let middle = |i: usize, j: usize| unit(normals[i] + normals[j]).dot(direction);
        corner(0) * a * (2.0 * a - 1.0)
            + corner(1) * b * (2.0 * b - 1.0)
            + corner(2) * c * (2.0 * c - 1.0)
            + 4.0 * (middle(0, 1) * a * b + middle(1, 2) * b * c + middle(2, 0) * c * a)
    };
    let (mut checked, mut worst, mut from_phong) = (0, 0f64, 0f64);
    let triangle = triangle_file::parse("a.tri", text.as_bytes()).unwrap().triangles[0];
    fragments(&triangle, ShadeMode::Gouraud, 8, (64, 64), |fragment| {
        let at = (fragment.y * 64 + fragment.x) as usize;
        let shares = shares(fragment.x, fragment.y);
        let surface = fragment.rgb()[0];
        let mut wanted = surface * 0.1;
        for (l, i) in &suns {
            let (d, h) = (quadratic(*l, shares), quadratic(unit(*l + view), shares));
            if d > 0.0 {
                wanted += surface * 0.6 * i * d + 0.5 * i * h.clamp(0.0, 1.0).powf(12.0);
            }
        }
        worst = worst.max((drawn.rgb[at][0] - wanted.clamp(0.0, 1.0)).abs());
        from_phong = from_phong.max((drawn.rgb[at][0] - phong.rgb[at][0]).abs());
        checked += 1;
    });
    println!("{checked} pixels: {worst:e} from the six points, {from_phong} from Phong");
    assert!(checked > 1000 && worst < 1e-12 && from_phong > 1e-4);
}

#[test]
fn shadow_and_blending_take_the_shaded_colour() {
    let text = "size 4 4\nmode phong\nview 0 0 1\nsun 0 0 1 0.5\nblend 1\nclear 1 1 1\nmaterial 0.25 0.5 0 1\n\
        shadow 4 0 0.5  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.1 2 0 0.1 0 4 0.1\nL 2 0 0.1 2 4 0.1 0 4 0.1\n\
        T 0 0 0.5 1 1 1 0.25  9 0 0.5 1 1 1 0.25  0 9 0.5 1 1 1 0.25\nN 0 0 1  0 0 1  0 0 1";
    let drawn = picture(text);
    assert!((drawn.rgb[0][0] - (0.75 * 0.25 + 0.25)).abs() < 1e-12, "in shadow: {:?}", drawn.rgb[0]);
    assert!((drawn.rgb[3][0] - (0.75 * 0.5 + 0.25)).abs() < 1e-12, "lit: {:?}", drawn.rgb[3]);
}

/// A positional light by the fit: there is no bound, so it is measured. d is its distance in longest edges; 300 triangles
/// each, half-cones to 8.5 degrees, cosines times 255.
#[test]
fn a_light_at_a_point_is_sampled_by_the_six_points() {
    let mut random = Pcg64Mcg::seed_from_u64(34);
    let mut worst = Vec::new();
    for distance in [1.0, 2.0, 4.0, 8.0, 16.0] {
        let (mut largest, mut checked) = (0f64, 0u64);
        for _ in 0..300 {
            let mut corner = |side: f64| [0; 2].map(|_| random.random_range(0.0..=side));
            let points = [corner(60.0), corner(60.0), corner(60.0)];
            let positions = points.map(|[x, y]| DVec3::new(x, y, 0.0));
            let edge = (0..3).map(|k| positions[k].distance(positions[(k + 1) % 3])).fold(0.0, f64::max);
            let mut around = |most: f64| {
                let v = DVec3::from_array([0; 3].map(|_| random.random_range(-1.0..=1.0)));
                v.normalize_or_zero() * most
            };
            let axis = (DVec3::Z + around(0.5)).normalize();
            let normals = [0; 3].map(|_| (axis + around(8.5f64.to_radians().tan() / 1.3)).normalize());
            let middle = (positions[0] + positions[1] + positions[2]) / 3.0;
            let position = middle + (axis + around(0.4)).normalize() * edge * distance;
            let light = Light::Positional { position, intensity: DVec3::ONE, attenuation: Attenuation::NONE };
            let shading = PixelShading {
                method: PixelMethod::FastPhong,
                viewer: Viewer::Toward(DVec3::Z),
                ambient: DVec3::ZERO,
                lights: vec![light],
                specular: Specular::Halfway,
                materials: vec![Material::matte(DVec3::ONE)],
                textures: Vec::new(),
                triangles: vec![PixelTriangle {
                    normals,
                    positions,
                    texture: [DVec2::ZERO; 3],
                    turns: [DVec3::ZERO; 2],
                    material: 0,
                }],
            };
            let exact = PixelShading { method: PixelMethod::Phong, ..shading.clone() };
            let brushes = [&shading, &exact].map(|shading| PixelBrush::new(shading, 0).unwrap());
            let vertex = |[x, y]: [f64; 2]| Vertex { x, y, r: 1.0, g: 1.0, b: 1.0, ..Vertex::default() };
            fragments(&Triangle(points.map(vertex)), ShadeMode::Gouraud, 8, (64, 64), |fragment| {
                let [a, b] = [&brushes[0], &brushes[1]].map(|brush| brush.color(fragment)[0]);
                largest = largest.max(255.0 * (a - b).abs());
                checked += 1;
            });
        }
        println!("light {distance} longest edges away: {largest:.3} LSB of a cosine, {checked} pixels");
        assert!(checked > 50_000);
        worst.push(largest);
    }
    // Halving what the light turns by divides what is left out by up to eight, down to what the normals leave.
    assert!(worst[0] > 4.0 * worst[2] && worst[2] < 2.0 && worst[4] < 0.5, "{worst:?}");
}

/// Two lights near the horizon: whoever knows the cosines only so far allows each to stand on either side.
#[test]
fn lights_within_doubt_of_the_horizon_may_stand_on_either_side() {
    let text = "size 4 4\nmode phong\nview 0 0 1\nsun 1 0 0.001 0.5\nsun 0 1 0.002 0.25\nmaterial 0.125 0.5 0 1\n\
                T 0 0 0 1 1 1 0  9 0 0 1 1 1 0  0 9 0 1 1 1 0\nN 0 0 1  0 0 1  0 0 1";
    let frame = triangle_file::parse("a.tri", text.as_bytes()).unwrap();
    let brush = PixelBrush::new(frame.shading.as_ref().unwrap(), 0).unwrap();
    let mut checked = 0;
    fragments(&frame.triangles[0], ShadeMode::Gouraud, 8, (4, 4), |fragment| {
        let of = |doubt: f64| brush.branches(fragment, &Texel::BLANK, doubt, 0.0);
        let own = brush.color(fragment);
        // As it is: both lights shine, a little.
        let lit = 0.125 + 0.5 * (0.5 * 0.001 + 0.25 * 0.002);
        assert!((own[0] - lit).abs() < 1e-5, "{own:?}");
        assert_eq!(of(0.0), [own]);
        let one = of(0.0015);
        assert_eq!((one.len(), one[0]), (2, own));
        assert!((one[1][0] - (0.125 + 0.5 * 0.25 * 0.002)).abs() < 1e-5, "{one:?}");
        let both = of(0.01);
        assert_eq!((both.len(), both[0]), (4, own));
        assert!(both.iter().any(|color| (color[0] - 0.125).abs() < 1e-12), "{both:?}");
        checked += 1;
    });
    assert_eq!(checked, 16);
}

/// Two floods, one just inside the edge of its cone and one just outside: each may be on either side by itself.
#[test]
fn lights_within_doubt_of_their_cones_may_be_inside_or_outside() {
    let text = "size 4 4\nmode phong\nview 0 0 1\nmaterial 0.125 0.5 0 1\n\
                T 0 0 0 1 1 1 0  9 0 0 1 1 1 0  0 9 0 1 1 1 0\nN 0 0 1  0 0 1  0 0 1";
    let mut frame = triangle_file::parse("a.tri", text.as_bytes()).unwrap();
    let flood = |intensity: f64, beside: f64| Light::Flood {
        position: DVec3::Z,
        axis: DVec3::new(0.6, 0.0, -0.8),
        cone: (0.8 + beside).acos(),
        exponent: 0.0,
        intensity: DVec3::splat(intensity),
        attenuation: Attenuation::NONE,
    };
    frame.shading.as_mut().unwrap().lights = vec![flood(0.5, -1e-4), flood(0.25, 1e-4)];
    let brush = PixelBrush::new(frame.shading.as_ref().unwrap(), 0).unwrap();
    let mut checked = 0;
    fragments(&frame.triangles[0], ShadeMode::Gouraud, 8, (4, 4), |fragment| {
        let of = |doubt: f64| {
            let list = brush.branches(fragment, &Texel::BLANK, 0.0, doubt);
            let mut list: Vec<i64> = list.iter().map(|color| (color[0] * 1e6).round() as i64).collect();
            list[1..].sort_unstable();
            list
        };
        // 0.125 + 0.5 of the lights that shine; at first the one.
        assert_eq!(of(0.0), [375_000]);
        assert_eq!(of(1e-5), [375_000]);
        assert_eq!(of(1e-3), [375_000, 125_000, 250_000, 500_000]);
        assert_eq!(brush.intensities(fragment), [DVec3::splat(0.5), DVec3::ZERO]);
        checked += 1;
    });
    assert_eq!(checked, 16);
}

/// Phong of a frame with a relief is the equation by the normal that the mesh turns; fast Phong is that to first order: halving the
/// height divides the difference of the cosines by four.
#[test]
fn a_relief_turns_the_normal_of_a_frame_as_that_of_the_mesh() {
    let text = |height: f64, kind: &str| {
        format!(
            "ambient = 0.2\n[camera]\neye = [0, 0, 900]\ntarget = [0, 0, 0]\nangle = 0.2\n[[material]]\nname = \"m\"\ndiffuse = 0.8\nspecular = {kind}\n\
             exponent = 3\nwaves = 2\ntexels = \"nearest\"\nbump_height = {height}\n[[object]]\npositions = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n\
             faces = [[0, 1, 2, 3]]\nuv = [[0, 0], [1, 0], [1, 1], [0, 1]]\nmaterial = \"m\"\n[[light]]\nkind = \"directional\"\ntoward = [0.3, 0.4, 1]\n"
        )
    };
    let mut differences = Vec::new();
    let mut checked = 0;
    for (height, kind) in [(0.04, "0"), (0.02, "0"), (0.04, "0.4")] {
        let scene = Scene::parse(std::path::Path::new("r.toml"), &text(height, kind)).unwrap();
        let surface = scene.surface(64, 64, 8191.0);
        let [phong, fast] =
            [PixelMethod::Phong, PixelMethod::FastPhong].map(|method| scene.pixel_frame(&surface, method));
        let mut apart = 0f64;
        for (place, triangle) in phong.triangles.iter().enumerate() {
            let [exact, first] =
                [&phong, &fast].map(|frame| PixelBrush::new(frame.shading.as_ref().unwrap(), place).unwrap());
            let own = &phong.shading.as_ref().unwrap().triangles[place];
            fragments(triangle, phong.mode, 8, (64, 64), |fragment| {
                let texel = exact.texel(fragment);
                let normal = scene.mesh.bumped_normal(
                    surface.triangles[place].face,
                    exact.place(fragment).unwrap(),
                    DVec3::Z,
                );
                let shading = phong.shading.as_ref().unwrap();
                let color = DVec3::from(fragment.rgb());
                let wanted = shading.color(own, DVec3::ZERO, normal, color).to_array();
                let drawn = exact.color(fragment);
                assert!((0..3).all(|k| (drawn[k] - wanted[k]).abs() < 1e-9), "{drawn:?} {wanted:?}");
                assert!(texel.slopes.length() < 7.0 && texel.color == DVec3::ONE);
                let cosines = [&exact, &first].map(|brush| brush.cosines(fragment, &texel)[0][0]);
                let turned = normal.z.recip();
                // The first order leaves the length out, and nothing else: N is the same everywhere.
                assert!((cosines[1] - cosines[0] * turned).abs() < 1e-5, "{cosines:?} {turned}");
                apart = apart.max((cosines[1] - cosines[0]).abs());
                checked += 1;
            });
        }
        differences.push(apart);
    }
    println!("{checked} pixels; first order off by {differences:?}");
    assert!(checked > 4000 && differences[0] > 0.005);
    assert!((differences[0] / differences[1] / 4.0 - 1.0).abs() < 0.1, "{differences:?}");
}
