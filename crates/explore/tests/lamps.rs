//! Lights at a point on the machine: random triangles under random lights that weaken with distance and beside their axis, every colour
//! within bound 17 of golden's Phong.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_explore::Verdict;
use edgewalk_explore::compare::{Comparison, compare_shaded};
use edgewalk_explore::draw;
use edgewalk_explore::port::to_port;
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::Waits;
use edgewalk_scene::{
    Attenuation, Frame, Light, Material, PixelMethod, PixelShading, PixelTriangle, Specular, Triangle,
    Vertex, Viewer,
};
use glam::{DVec2, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn plan(settings: &[(&str, &str)]) -> Plan {
    let mut machine = Machine { width: 160, height: 120, ..Machine::default() };
    let usual = [("shade.kind", "phong"), ("shade.light", "positional"), ("shade.gloss_bits", "8")];
    for (key, value) in usual.iter().chain(settings) {
        machine.set(key, value).unwrap();
    }
    machine.plan().unwrap()
}

/// Triangles in a plane of 1.6 by 1.2, or leaning from it, normals about the way to the viewer, under one light at this height.
fn frame(random: &mut Pcg64Mcg, count: u32, flood: Option<f64>, height: f64, attenuation: [f64; 3]) -> Frame {
    let material = |place: u32| Material {
        ambient: DVec3::splat(0.2),
        specular: DVec3::splat(0.5),
        exponent: [12.0, 1.0, 60.0, 150.0][place as usize],
        ..Material::matte(DVec3::splat(0.75))
    };
    let [constant, linear, quadratic] = attenuation;
    let attenuation = Attenuation { constant, linear, quadratic };
    let position = DVec3::new(random.random_range(0.3..1.3), random.random_range(0.3..0.9), height);
    let intensity = DVec3::splat(0.9 / attenuation.factor(0.6 * height));
    let axis = DVec3::new(0.2, 0.1, -1.0).normalize();
    let light = match flood {
        None => Light::Positional { position, intensity, attenuation },
        Some(exponent) => Light::Flood { position, axis, cone: 0.6, exponent, intensity, attenuation },
    };
    let mut shading = PixelShading {
        method: PixelMethod::Phong,
        viewer: Viewer::Toward(DVec3::new(0.1, -0.2, 1.0).normalize()),
        ambient: DVec3::ONE,
        lights: vec![light],
        specular: if count % 2 == 0 { Specular::Blinn } else { Specular::Halfway },
        materials: (0..4).map(material).collect(),
        textures: Vec::new(),
        triangles: Vec::new(),
    };
    let mut triangles = Vec::new();
    for number in 0..count {
        let size = 4.0 * 30f64.powf(random.random());
        let at = [random.random_range(-10.0..150.0), random.random_range(-10.0..110.0)];
        let z = random.random();
        let color: [f64; 3] = [0.25 * f64::from(number % 4) + 0.2, 0.8, 0.5];
        let triangle = Triangle([0; 3].map(|_| Vertex {
            x: at[0] + size * random.random::<f64>(),
            y: at[1] + size * random.random::<f64>(),
            z,
            r: color[0],
            g: color[1],
            b: color[2],
            ..Vertex::default()
        }));
        let mut around = |most: f64| random.random_range(-most..=most);
        let normals = [0; 3].map(|_| DVec3::new(around(0.4), around(0.4), 1.0).normalize());
        let positions =
            triangle.0.map(|vertex| DVec3::new(vertex.x / 100.0, vertex.y / 100.0, around(0.2 * height)));
        triangles.push(triangle);
        shading.triangles.push(PixelTriangle {
            normals,
            positions,
            texture: [DVec2::ZERO; 3],
            turns: [DVec3::ZERO; 2],
            material: number % 4,
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
fn every_colour_under_a_light_at_a_point_is_within_its_bound() {
    let fine = ("shade.table_bits", "10");
    // Settings, exponent of a flood, height of the light, attenuation.
    type Case<'a> = (&'a [(&'a str, &'a str)], Option<f64>, f64, [f64; 3]);
    let cases: [Case; 8] = [
        (&[], None, 1.0, [1.0, 0.0, 0.0]),
        (&[fine], None, 0.5, [1.0, 0.5, 0.25]),
        (&[fine, ("term.walk", "memory")], None, 2.0, [0.0, 0.0, 1.0]),
        (&[], Some(0.0), 1.0, [1.0, 0.0, 0.0]),
        (&[fine], Some(1.0), 1.0, [1.0, 1.0, 0.0]),
        (&[fine], Some(20.0), 0.8, [0.5, 0.0, 1.0]),
        (&[("shade.colour", "multiply")], Some(8.0), 1.0, [1.0, 0.0, 0.5]),
        (&[("shade.gloss_bits", "3")], None, 20.0, [1.0, 0.1, 0.0]),
    ];
    let (mut pixels, mut beside) = (0, 0);
    for (place, (settings, flood, height, attenuation)) in (0..).zip(cases) {
        let machine = plan(settings);
        let mut random = Pcg64Mcg::seed_from_u64(2026 + place);
        let frame = frame(&mut random, 160 + place as u32 % 2, flood, height, attenuation);
        let found = judged(&frame, &machine);
        let shaded = found.shaded.unwrap();
        println!(
            "{settings:?} flood {flood:?} at {height}, {attenuation:?}: {} pixels, {} next to the horizon or a cone's edge, {} on its other \
             side; largest error {:.3} of {:.3} LSB, {:.3} of a bound",
            shaded.pixels,
            shaded.at_horizon,
            shaded.other_branch,
            shaded.error,
            shaded.bound,
            shaded.of_bound,
        );
        assert_eq!(found.verdict(), Verdict::Pass, "{settings:?}: {found:?}");
        assert_eq!(shaded.beyond, 0, "{settings:?}");
        assert!(shaded.of_bound > 0.3 && shaded.of_bound <= 1.0, "{shaded:?}");
        (pixels, beside) = (pixels + shaded.pixels, beside + shaded.at_horizon);
    }
    println!("{pixels} pixels");
    assert!(pixels > 60_000 && beside > 0, "{pixels}");
}
