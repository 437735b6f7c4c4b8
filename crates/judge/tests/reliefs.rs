//! Reliefs on the machine: random triangles with random reliefs, every colour within its bound of golden's by the same texel, by fast
//! Phong to first order and by Phong exactly.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_host::draw;
use edgewalk_host::port::to_port;
use edgewalk_judge::Verdict;
use edgewalk_judge::compare::{Comparison, compare_shaded};
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::Waits;
use edgewalk_scene::{
    Frame, Image, Light, Material, PixelMethod, PixelShading, PixelTriangle, Specular, Triangle, Vertex,
    Viewer,
};
use glam::{DVec2, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn plan(settings: &[(&str, &str)]) -> Plan {
    let mut machine = Machine { width: 160, height: 120, ..Machine::default() };
    let usual = [
        ("shade.kind", "fast-phong"),
        ("shade.colour", "multiply"),
        ("texture.kind", "nearest"),
        ("texture.bits", "4"),
        ("texture.bump", "yes"),
    ];
    for (key, value) in usual.iter().chain(settings) {
        machine.set(key, value).unwrap();
    }
    machine.plan().unwrap()
}

/// A picture, or heights.
fn picture(random: &mut Pcg64Mcg, side: u32) -> Image {
    Image::of(side, side, (0..side * side).map(|_| [0; 3].map(|_| random.random())).collect()).unwrap()
}

/// Triangles with normals about the way to the viewer, and ways of their reliefs with which the steepest of them turns a normal by up
/// to `steep`; six materials in turn, two of them with a texture too, one with neither.
fn frame(
    random: &mut Pcg64Mcg,
    count: u32,
    (side, steep): (u32, f64),
    lights: usize,
    method: PixelMethod,
) -> Frame {
    let textures: Vec<_> = (0..4).map(|_| picture(random, side).into()).collect();
    let material = |place: u32| Material {
        ambient: DVec3::splat(0.2),
        specular: DVec3::splat(0.3),
        exponent: [12.0, 1.0, 60.0][place as usize % 3],
        texture: [None, Some(0), Some(1), None, Some(1), None][place as usize],
        bump: [Some(2), Some(3), Some(2), Some(3), None, None][place as usize],
        ..Material::matte(DVec3::splat(0.75 / lights as f64))
    };
    let light = |k: usize| Light::Directional {
        toward: DVec3::new(0.3 - k as f64, 0.4, 0.866).normalize(),
        intensity: DVec3::ONE,
    };
    let mut shading = PixelShading {
        method,
        viewer: Viewer::Toward(DVec3::Z),
        ambient: DVec3::ONE,
        lights: (0..lights).map(light).collect(),
        specular: if side % 2 == 0 { Specular::Blinn } else { Specular::Halfway },
        materials: (0..6).map(material).collect(),
        textures,
        triangles: Vec::new(),
    };
    // Half the difference of two heights, a unit's texels times.
    let slope = f64::from(side) / 2.0;
    let mut triangles = Vec::new();
    for number in 0..count {
        let size = 4.0 * 40f64.powf(random.random());
        let at = [random.random_range(-10.0..150.0), random.random_range(-10.0..110.0)];
        let z = random.random();
        triangles.push(Triangle([0; 3].map(|_| Vertex {
            x: at[0] + size * random.random::<f64>(),
            y: at[1] + size * random.random::<f64>(),
            z,
            r: random.random(),
            g: random.random(),
            b: random.random(),
            ..Vertex::default()
        })));
        let mut around = |most: f64| random.random_range(-most..=most);
        let normals = [0; 3].map(|_| DVec3::new(around(0.2), around(0.2), 1.0).normalize());
        let texture = [0; 3].map(|_| DVec2::new(around(1.5), around(1.5)));
        let turns = [0; 2].map(|_| DVec3::new(around(steep), around(steep), around(steep)) / slope);
        shading.triangles.push(PixelTriangle {
            normals,
            positions: [DVec3::ZERO; 3],
            texture,
            turns,
            material: number % 6,
        });
    }
    Frame { triangles, shading: Some(shading), ..Frame::new(160, 120) }
}

fn judged(frame: &Frame, machine: &Plan) -> Comparison {
    let port = to_port(frame, machine).unwrap();
    let golden = draw::golden(frame, machine);
    let drawn = draw::draw_frame(machine, &port, Waits::Never).unwrap().raster(machine);
    let proof = port.shade.unwrap().proof;
    compare_shaded(machine, frame, &golden, &drawn, None, Some(&proof))
}

#[test]
fn every_colour_of_a_relief_is_within_its_bound() {
    let phong = ("shade.kind", "phong");
    // Settings, side of the pictures and steepness, lights, whether some are flattened.
    type Case<'a> = (&'a [(&'a str, &'a str)], (u32, f64), usize, bool);
    let cases: [Case; 10] = [
        (&[], (16, 0.3), 1, false),
        (&[("shade.table_bits", "10"), ("shade.gloss_bits", "8")], (16, 0.3), 1, false),
        (&[("shade.lights", "2")], (8, 0.5), 2, false),
        (&[("texture.slope_bits", "6"), ("term.walk", "memory")], (16, 0.5), 1, false),
        (&[("texture.slope_bits", "16"), ("term.linear_fraction", "4")], (16, 0.1), 1, false),
        (&[("shade.gloss_bits", "0"), ("texture.slope_bits", "4")], (5, 12.0), 1, true),
        (&[phong], (16, 0.3), 1, false),
        (&[phong, ("shade.lights", "2"), ("shade.table_bits", "10")], (8, 0.4), 2, false),
        (&[phong, ("texture.slope_bits", "5"), ("term.walk", "memory")], (16, 0.2), 1, false),
        (&[phong, ("texture.slope_bits", "16")], (7, 6.0), 1, true),
    ];
    let (mut pixels, mut turned) = (0, 0.0);
    for (settings, pictures, lights, steep) in cases {
        let machine = plan(settings);
        let method = if machine.shade.normalises() { PixelMethod::Phong } else { PixelMethod::FastPhong };
        let mut random = Pcg64Mcg::seed_from_u64(2026);
        let frame = frame(&mut random, 240, pictures, lights, method);
        let found = judged(&frame, &machine);
        let shaded = found.shaded.unwrap();
        let texels = shaded.texels.unwrap();
        // What the relief does: the same without.
        let mut flat = frame.clone();
        flat.shading.as_mut().unwrap().triangles.iter_mut().for_each(|own| own.turns = [DVec3::ZERO; 2]);
        let (bumped, smooth) = (draw::golden(&frame, &machine).rgb, draw::golden(&flat, &machine).rgb);
        let changed =
            bumped.iter().zip(&smooth).map(|(a, b)| 255.0 * (a[0] - b[0]).abs()).fold(0.0, f64::max);
        println!(
            "{settings:?}: {} pixels, {} of pictures, {} other than golden's, {} unexplained, {} flattened, {} at the horizon, {} on its \
             other side; largest error {:.3} of {:.3} LSB, {:.3} of a bound; from Phong {:.2}; the relief changes up to {changed:.1} LSB",
            shaded.pixels,
            texels.pixels,
            texels.differ,
            texels.unexplained,
            texels.flattened,
            shaded.at_horizon,
            shaded.other_branch,
            shaded.error,
            shaded.allowed,
            shaded.of_bound,
            shaded.from_phong
        );
        assert_eq!(found.verdict(), Verdict::Pass, "{settings:?}: {found:?}");
        assert_eq!((texels.unexplained, shaded.beyond), (0, 0), "{settings:?}");
        assert_eq!(texels.flattened > 0, steep, "{settings:?}");
        assert!(texels.pixels > 5000 && texels.pixels < shaded.pixels && changed > 10.0, "{texels:?}");
        assert!(shaded.of_bound > 0.4 && shaded.of_bound <= 1.0, "{shaded:?}");
        (pixels, turned) = (pixels + texels.pixels, changed.max(turned));
    }
    println!("{pixels} pixels of pictures");
    assert!(pixels > 100_000, "{pixels}");
}
