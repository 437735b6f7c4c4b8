//! Lights at a point on the machine: random triangles under random lights that weaken with distance and beside their axis, every colour
//! within bound 17 of golden's Phong.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_host::draw;
use edgewalk_host::port::to_port;
use edgewalk_judge::Verdict;
use edgewalk_judge::compare::{Comparison, compare_shaded};
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
            shaded.allowed,
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

/// The words that the host sends, by closed formulae of the frame alone: a bound that is measured from a table says nothing of a wrong one. A place
/// of a triangle must find its own attenuation in table A, and every entry of tables C, T and S lie between the ends of what it stands for.
#[test]
fn the_tables_hold_what_the_light_and_the_materials_say() {
    type Case<'a> = (&'a [(&'a str, &'a str)], Option<f64>, f64, [f64; 3]);
    let cases: [Case; 5] = [
        (&[("shade.table_bits", "10")], None, 0.5, [1.0, 0.5, 0.25]),
        (&[], None, 2.0, [0.0, 0.0, 1.0]),
        (&[], Some(1.0), 1.0, [1.0, 1.0, 0.0]),
        (&[("shade.colour", "multiply")], Some(20.0), 0.3, [0.5, 0.0, 1.0]),
        (&[], Some(0.0), 0.1, [0.1, 0.0, 1.0]),
    ];
    let (mut units, mut places, mut nearest, mut beams, mut entries) = (0, 0, 0, 0, 0);
    for (case, (settings, flood, height, attenuation)) in (0..).zip(cases) {
        let machine = plan(settings);
        let mut random = Pcg64Mcg::seed_from_u64(4 + case);
        let frame = frame(&mut random, 60 + case as u32 % 2, flood, height, attenuation);
        let shading = frame.shading.as_ref().unwrap();
        let port = to_port(&frame, &machine).unwrap();
        let feed = port.shade.as_ref().unwrap();
        let (position, factor, intensity, cone) = match shading.lights[0] {
            Light::Positional { position, attenuation, intensity } => {
                (position, attenuation, intensity.x, None)
            }
            Light::Flood { position, attenuation, intensity, cone, exponent, .. } => {
                (position, attenuation, intensity.x, Some((cone, exponent)))
            }
            Light::Directional { .. } => unreachable!(),
        };
        let at = |d: f64| 1.0 / (factor.constant + factor.linear * d + factor.quadratic * d * d);
        let word = |place: usize| {
            [feed.words.roots[place] >> 16, feed.words.roots[place] & 0xffff].map(|part| part as f64)
        };

        // The unit of l, of each triangle's l·l at its reference pixel.
        let mut found: Vec<f64> = Vec::new();
        for (place, record) in
            feed.words.records.iter().enumerate().filter(|(_, record)| !record.terms.is_empty())
        {
            let corners =
                frame.triangles[place].0.map(|v| DVec2::new(v.x, v.y).map(|x| (x * 256.0).round() / 256.0));
            let pixel = DVec2::new(f64::from(record.x) + 0.5, f64::from(record.y) + 0.5);
            let across = |a: DVec2, b: DVec2| (a - pixel).perp_dot(b - pixel);
            let shares = [
                across(corners[1], corners[2]),
                across(corners[2], corners[0]),
                across(corners[0], corners[1]),
            ];
            let area: f64 = shares.iter().sum();
            let way: DVec3 =
                (0..3).map(|k| (position - shading.triangles[place].positions[k]) * (shares[k] / area)).sum();
            let bits = machine.terms()[0].word();
            let word = (record.terms[0][0] << (64 - bits)) as i64 >> (64 - bits);
            let squared = word as f64 / 2f64.powi(30 + machine.terms()[0].fraction as i32);
            // Where the reference pixel is not far outside of the triangle.
            if squared > 0.01 && way.length() < 20.0 {
                found.push(way.length() / squared.sqrt());
            }
        }
        let unit = found[0];
        assert!(found.len() > 20 && found.iter().all(|other| (other / unit - 1.0).abs() < 1e-5), "{found:?}");
        units += found.len();

        let full = feed.intensities[0].x;
        for own in &shading.triangles {
            for _ in 0..40 {
                let [mut a, mut b] = [0; 2].map(|_| random.random::<f64>());
                if a + b > 1.0 {
                    (a, b) = (1.0 - a, 1.0 - b);
                }
                let [p, q, r] = own.positions;
                let d = (position - (p + a * (q - p) + b * (r - p))).length();
                let x = (d / unit).powi(2);
                assert!(x < 1.0, "ways are less than 1: {x}");
                if x < 4f64.powi(-8) {
                    continue;
                }
                // Section 17: entry 64·k + j at l·l = j/64·4^-k, j from 16.
                let k = (0..8).rev().find(|k| x * 4f64.powi(*k) < 1.0).unwrap();
                let j = x * 4f64.powi(k) * 64.0;
                let [v, slope] = word(512 + 64 * k as usize + j as usize);
                let said = (v - slope * j.fract()) / 65536.0 * full;
                let wanted = intensity * at(d);
                // A chord of a function that is at most as steep as 1/x errs by 1/1024 of it over a 16th of x, and stands in the middle. The
                // one over the nearest place of all begins at full light, and below the function.
                let begins = intensity * at(unit * (j.floor() / 64.0 / 4f64.powi(k)).sqrt());
                let part = if begins > full {
                    nearest += 1;
                    16.0
                } else {
                    2000.0
                };
                assert!(
                    (said - wanted).abs() <= wanted / part + 3.0 / 65536.0 * full,
                    "{d}: {said}, not {wanted}"
                );
                places += 1;
            }
        }

        let edge = cone.map_or((1u32 << 17) - 1, |(cone, _)| ((1.0 - cone.cos()) * 65536.0).floor() as u32);
        assert_eq!(word(0)[0], f64::from(edge));
        for k in 0..=edge.min(65535) / 256 {
            let exponent = cone.map_or(0.0, |(_, exponent)| exponent);
            let wanted = (1.0 - f64::from(k) / 256.0).powf(exponent) * 65536.0;
            let chord = (exponent * (exponent - 1.0)).max(0.0) / 16.0 + 2.0;
            assert!(
                (word(256 + k as usize)[0] - wanted).abs() <= chord,
                "{k}: {:?}, not {wanted}",
                word(256 + k as usize)
            );
            beams += 1;
        }

        let size = 1u32 << machine.shade.table_bits;
        for (place, own) in shading.triangles.iter().enumerate().filter(|(_, own)| own.material < 4) {
            let Some(record) = Some(&feed.words.records[place]).filter(|record| !record.terms.is_empty())
            else {
                continue;
            };
            let (material, gloss) = (shading.materials[own.material as usize], f64::from(1 << record.gloss));
            let color = frame.triangles[place].0[0];
            let multiplies = settings.contains(&("shade.colour", "multiply"));
            let (surface, one) = if multiplies { (1.0, 1024.0) } else { (color.r, 255.0) };
            let diffuse = |cosine: f64| {
                (one * surface * (material.ambient.x + material.diffuse.x * full * cosine.clamp(0.0, 1.0)))
                    .min(one)
            };
            let highlight = |cosine: f64| {
                let cosine = cosine.clamp(0.0, 1.0);
                let doubled = 2.0 * cosine * cosine - 1.0;
                let base = if shading.specular == Specular::Blinn { cosine } else { doubled.max(0.0) };
                255.0 * material.specular.x * full * base.powf(material.exponent)
            };
            for entry in 0..size {
                let word = feed.words.tables[machine.table_place(record.material, 0, entry)];
                let (t, s) = if multiplies { (word >> 8, word & 0xff) } else { (word >> 24, word & 0xff) };
                let share = |place: u32| f64::from(place) / f64::from(size);
                let up = |place: u32| 1.0 - (1.0 - share(place)) / gloss;
                // The first entry of S also stands for all that lies below.
                let lowest = if entry == 0 { 0.0 } else { highlight(up(entry)) };
                let ends = [
                    (t, diffuse(share(entry)), diffuse(share(entry + 1))),
                    (s, lowest, highlight(up(entry + 1))),
                ];
                for (word, low, high) in ends {
                    let within = low - 0.5 - 1e-9..=high + 0.5 + 1e-9;
                    assert!(
                        within.contains(&(word as f64)),
                        "entry {entry}: {word} is not from {low} to {high}"
                    );
                    entries += 1;
                }
            }
        }
    }
    println!(
        "{units} units, {places} places in A, {nearest} next to the nearest, {beams} entries of C, {entries} of T and S"
    );
    assert!(units > 200 && places > 10_000 && nearest < places / 50 && beams > 500 && entries > 100_000);
}
