//! What the host sends to TERM and SHADE, read as `docs/machine.md`, sections 11 and 12, says: the colours that come of it
//! against golden's fast Phong, within the proved bound at every pixel.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod clocks;

use edgewalk_golden::{PixelBrush, fragments};
use edgewalk_host::draw;
use edgewalk_host::port::to_port;
use edgewalk_host::raster::from_machine;
use edgewalk_judge::Verdict;
use edgewalk_judge::compare::compare_shaded;
use edgewalk_machine::{Machine, Plan, Record};
use edgewalk_model::{Shading, Waits, render_passes};
use edgewalk_scene::{
    Attenuation, Frame, Light, Material, PixelMethod, PixelShading, PixelTriangle, Specular, Triangle,
    Vertex, Viewer,
};
use glam::{DVec2, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn plan(settings: &[(&str, &str)]) -> Plan {
    let mut machine = Machine::default();
    for (key, value) in settings {
        machine.set(key, value).unwrap();
    }
    machine.plan().unwrap()
}

/// The output of a term at a pixel: formula (1) of section 11, then the floor.
fn output(words: &[u64; 6], (i, n): (i64, i64), bits: u32, fraction: u32) -> i64 {
    let [v, x, y, xx, xy, yy] = words.map(i128::from);
    let (i, n) = (i128::from(i), i128::from(n));
    let word = v + i * x + n * y + i * (i - 1) / 2 * xx + n * (n - 1) / 2 * yy + i * n * xy;
    let unused = 128 - bits - fraction;
    (((word << unused) >> unused) >> fraction) as i64
}

/// What SHADE takes for a light: the outputs of its terms, or with NORMAL (section 13) what that makes of them.
fn cosines(machine: &Plan, roots: &[u128], record: &Record, place: (i64, i64), l: usize) -> [i64; 2] {
    let at = |k: usize| {
        let term = machine.terms()[k];
        output(&record.terms[k], place, term.bits, term.fraction)
    };
    let products = [at(2 * l), at(2 * l + 1)];
    if !machine.shade.normalises() {
        return products;
    }
    let s = at(machine.terms().len() - 1).clamp(1 << 14, (1 << 16) - 1);
    let (entry, low) = (roots[(s >> 8) as usize], s & 255);
    let (v, slope) = ((entry >> 10) as i64, (entry & 1023) as i64);
    let y = v - ((slope * low + 128) >> 8);
    let [n, h] = products.map(|p| (p * y + (1 << 15)) >> 16);
    let t = machine.shade.table_bits;
    [n >> (16 - t), (((h - (1 << 16)) << record.gloss) + (1 << 16)) >> (16 - t)]
}

/// A fragment's colour as SHADE makes it of its terms; and whether a cosine N·L or N·H was beyond the end, or N·L below 0.
fn tinted(
    machine: &Plan,
    Shading { tables, roots, .. }: &Shading,
    record: &Record,
    place: (i64, i64),
    own: [u64; 3],
) -> ([u64; 3], [bool; 3]) {
    let (t, b) = (machine.shade.table_bits, machine.color.bits);
    let (last, max) = ((1i64 << t) - 1, (1u64 << b) - 1);
    let multiply = machine.shade.diffuse_bits(b) != 3 * b;
    let (mut sum, mut light, mut highlights, mut met) = ([0u64; 3], 0, 0, [false; 3]);
    for l in 0..machine.shade.lights {
        let [d, h] = cosines(machine, roots, record, place, l as usize);
        met = [met[0] || d > last, met[1] || h > last, met[2] || d < 0];
        let read = |index: i64| tables[machine.table_place(record.material, l, index.clamp(0, last) as u32)];
        let (diffuse, highlight) = (read(d) >> b, read(h) as u64 & max);
        for (k, sum) in sum.iter_mut().enumerate() {
            *sum += (diffuse >> (b * (2 - k as u32))) as u64 & max;
        }
        light += diffuse as u64;
        highlights += if d >= 0 { highlight } else { 0 };
    }
    let color = if multiply {
        let one = b + 2;
        own.map(|c| ((c * light.min(1 << one) + (1 << (one - 1))) >> one) + highlights.min(max))
    } else {
        sum.map(|c| c + highlights)
    };
    (color.map(|c| c.min(max)), met)
}

#[derive(Default)]
struct Found {
    triangles: u64,
    pixels: u64,
    /// Largest error, and the bound of its triangle.
    error: (f64, f64),
    bound: f64,
    /// Of a bound that was reached.
    share: f64,
    horizon: u64,
    other: u64,
    met: [u64; 3],
}

/// Compares all pixels of the frame.
fn compare(frame: &Frame, machine: &Plan, found: &mut Found) {
    let port = to_port(frame, machine).unwrap();
    let feed = port.shade.as_ref().unwrap();
    let shading = frame.shading.as_ref().unwrap();
    for (id, (triangle, record)) in frame.triangles.iter().zip(&feed.words.records).enumerate() {
        let brush = PixelBrush::new(shading, id).unwrap();
        let (bound, doubt) = (feed.proof.bounds[id], feed.proof.doubts[id]);
        let leftward = leftward(machine, &port.triangles[id].map(|v| [v.x().into(), v.y().into()]));
        let mut any = false;
        let screen = (frame.width, frame.height);
        fragments(triangle, frame.mode, machine.subpixel_bits, screen, |fragment| {
            let right = i64::from(fragment.x) - i64::from(record.x);
            let line = i64::from(fragment.y) - i64::from(record.y);
            assert!(line >= 0, "the reference lies below a line that is drawn");
            let max = machine.color.max() as f64;
            // Of a surface of one colour PIXEL hands on the vertex's.
            let own = fragment.rgb().map(|c| (c * max).round() as u64);
            let place = (if leftward { -right } else { right }, line);
            let (color, met) = tinted(machine, &feed.words, record, place, own);
            let off = |golden: &[f64; 3]| {
                let far = |(a, b): (u64, &f64)| (a as f64 - b * max).abs();
                color.into_iter().zip(golden).map(far).fold(0.0, f64::max)
            };
            let errors: Vec<f64> =
                brush.branches(fragment, &brush.texel(fragment), doubt, 0.0).iter().map(off).collect();
            let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
            let (x, y) = (fragment.x, fragment.y);
            assert!(least <= bound, "triangle {id}, pixel {x} {y}: {errors:?} over {bound}");
            found.horizon += u64::from(errors.len() > 1);
            found.other += u64::from(errors[0] > bound);
            found.pixels += 1;
            found.error = if least > found.error.0 { (least, bound) } else { found.error };
            found.share = found.share.max(least / bound);
            for (count, met) in found.met.iter_mut().zip(met) {
                *count += u64::from(met);
            }
            any = true;
        });
        found.bound = if any { found.bound.max(bound) } else { found.bound };
        found.triangles += u64::from(any);
    }
}

/// Section 2: spans run to the left if the major edge is the right one.
fn leftward(machine: &Plan, corners: &[[i64; 2]; 3]) -> bool {
    assert_eq!(machine.subpixel_bits, 8, "corners in sub-pixels differ from centres by a constant");
    let mut sorted = *corners;
    sorted.sort_by_key(|[_, y]| *y);
    let [a, b, c] = sorted;
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) < 0
}

fn unit(random: &mut Pcg64Mcg) -> DVec3 {
    loop {
        let v = DVec3::from_array(std::array::from_fn(|_| random.random_range(-1.0..=1.0)));
        if (0.1..=1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

/// A unit vector within `cone` radians of an axis.
fn near(random: &mut Pcg64Mcg, axis: DVec3, cone: f64) -> DVec3 {
    let aside = axis.cross(unit(random)).try_normalize().unwrap_or(axis.any_orthonormal_vector());
    let angle = random.random_range(0.0..=cone);
    (axis * angle.cos() + aside * angle.sin()).normalize()
}

/// A triangle of 2 to 450 pixels, normals in a cone, and lights: anywhere, in front, at the horizon, or with the highlight
/// inside.
fn case(random: &mut Pcg64Mcg, number: u32, lights: usize, gloss: f64) -> Frame {
    let size = 2.0 * 200f64.powf(random.random());
    let at = [random.random_range(0.0..=200.0), random.random_range(0.0..=100.0)];
    let color: [f64; 3] = random.random();
    let vertex = |random: &mut Pcg64Mcg| Vertex {
        x: at[0] + size * random.random_range(-0.1..=1.0),
        y: at[1] + size * random.random_range(-0.1..=1.0),
        r: color[0],
        g: color[1],
        b: color[2],
        ..Vertex::default()
    };
    let triangle = Triangle([vertex(random), vertex(random), vertex(random)]);
    let (axis, cone) = (unit(random), random.random_range(0.2f64..=30.0).to_radians());
    let normals = [0; 3].map(|_| near(random, axis, cone));
    let view = near(random, axis, 1.0);
    let middle = (normals[0] + normals[1] + normals[2]).normalize();
    let light = |random: &mut Pcg64Mcg| {
        let toward = match number % 4 {
            0 => unit(random),
            1 => near(random, middle, 0.8),
            2 => middle.cross(unit(random)).normalize(),
            // Mirrored.
            _ => (2.0 * middle.dot(view) * middle - view).normalize(),
        };
        let intensity = DVec3::splat(random.random_range(0.2..=1.0) / lights as f64);
        Light::Directional { toward, intensity }
    };
    let grey = |random: &mut Pcg64Mcg| DVec3::splat(random.random());
    let material = Material {
        ambient: grey(random) * 0.3,
        diffuse: grey(random) * 0.7,
        specular: grey(random),
        exponent: gloss.powf(random.random()),
        ..Material::matte(DVec3::ZERO)
    };
    let shading = PixelShading {
        method: PixelMethod::FastPhong,
        viewer: Viewer::Toward(view),
        ambient: DVec3::ONE,
        lights: (0..lights).map(|_| light(random)).collect(),
        specular: if random.random() { Specular::Halfway } else { Specular::Blinn },
        materials: vec![material],
        textures: Vec::new(),
        triangles: vec![PixelTriangle {
            normals,
            positions: [DVec3::ZERO; 3],
            texture: [DVec2::ZERO; 3],
            turns: [DVec3::ZERO; 2],
            material: 0,
        }],
    };
    Frame { triangles: vec![triangle], shading: Some(shading), ..Frame::new(640, 480) }
}

/// Settings of a machine, how many triangles, how many lights, and the sharpest highlight's exponent.
type Case<'a> = (&'a [(&'a str, &'a str)], u32, usize, f64);

/// The same frame by the method of the machine.
fn by(mut frame: Frame, machine: &Plan) -> Frame {
    if let Some(shading) = frame.shading.as_mut().filter(|_| machine.shade.normalises()) {
        shading.method = PixelMethod::Phong;
    }
    frame
}

#[test]
fn colours_of_random_triangles_are_within_the_bound() {
    let kind = ("shade.kind", "fast-phong");
    let glossy = ("shade.gloss_bits", "8");
    let phong = ("shade.kind", "phong");
    let machines: [Case; 7] = [
        (&[phong, glossy], 800, 1, 200.0),
        (&[phong, glossy, ("shade.table_bits", "10"), ("shade.lights", "2")], 600, 2, 200.0),
        (&[kind, glossy], 2200, 1, 200.0),
        (&[kind, glossy, ("shade.table_bits", "10")], 1200, 1, 200.0),
        (&[kind, glossy, ("shade.lights", "2")], 800, 2, 200.0),
        (&[kind, glossy, ("shade.colour", "multiply")], 800, 1, 200.0),
        (&[kind, ("term.fraction", "13")], 700, 1, 25.0),
    ];
    let mut triangles = 0;
    for (settings, count, lights, gloss) in machines {
        let machine = plan(settings);
        let mut random = Pcg64Mcg::seed_from_u64(2022);
        let mut found = Found::default();
        for number in 0..count {
            let frame = by(case(&mut random, number, lights, gloss), &machine);
            compare(&frame, &machine, &mut found);
        }
        let Found { error: (error, its), bound, share, horizon, other, met, .. } = found;
        println!(
            "{:?}: {} triangles, {} pixels: largest error {error:.3} LSB where the bound is {its:.3}, largest bound {bound:.3}, \
             {share:.3} of a bound reached; at the horizon {horizon}, on its other side {other}; beyond the end N·L {}, N·H {}; N·L \
             below 0 {}",
            &settings[1..],
            found.triangles,
            found.pixels,
            met[0],
            met[1],
            met[2]
        );
        // The bound of a multiplied colour is that of the brightest, and of one that was stepped.
        let enough = if settings.contains(&("shade.colour", "multiply")) { 0.65 } else { 0.85 };
        assert!(found.triangles > u64::from(count) * 8 / 10 && found.pixels > 100_000 && share > enough);
        assert!(horizon > 0 && met[1] > 0 && met[2] > 0);
        triangles += found.triangles;
    }
    assert!(triangles > 5000, "{triangles}");
}

#[test]
fn what_the_machine_cannot_take_is_named_with_a_remedy() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let frame = case(&mut random, 1, 1, 20.0);
    let fast =
        |more: &[(&'static str, &'static str)]| plan(&[&[("shade.kind", "fast-phong")], more].concat());
    let with = |change: &dyn Fn(&mut Frame, &mut PixelShading)| {
        let mut frame = frame.clone();
        let mut shading = frame.shading.take().unwrap();
        change(&mut frame, &mut shading);
        Frame { shading: Some(shading), ..frame }
    };
    let lamp = |attenuation| Light::Positional { position: DVec3::ONE, intensity: DVec3::ONE, attenuation };
    let weak = Attenuation { constant: 1.0, linear: 1.0, quadratic: 0.0 };
    let many = |f: &mut Frame, s: &mut PixelShading| {
        let colored = |k: u32| Vertex { r: f64::from(k) / 255.0, ..f.triangles[0].0[0] };
        f.triangles = (0..3).map(|k| Triangle([colored(k); 3])).collect();
        s.triangles = vec![s.triangles[0]; 3];
    };
    let phong = |_: &mut Frame, s: &mut PixelShading| s.method = PixelMethod::Phong;
    let cases: [(Frame, Plan, &[&str]); 14] = [
        (
            frame.clone(),
            Plan::default(),
            &["mode fast-phong", "--set shade.kind=fast-phong", "--engine golden"],
        ),
        (
            Frame { shading: None, ..frame.clone() },
            fast(&[]),
            &["the input has none", "--set shade.kind=none"],
        ),
        (with(&phong), fast(&[]), &["mode phong", "shade.kind is fast-phong", "shade.kind=phong"]),
        (with(&phong), Plan::default(), &["mode phong", "--set shade.kind=phong"]),
        (with(&|_, s| s.lights = vec![s.lights[0]; 2]), fast(&[]), &["2 lights", "shade.lights=2"]),
        (
            with(&|_, s| s.lights = vec![s.lights[0]; 3]),
            fast(&[("shade.lights", "2")]),
            &["3 lights", "permitted: 1 or 2"],
        ),
        (with(&|_, s| s.lights = vec![lamp(weak)]), fast(&[]), &["light 1", "does not weaken"]),
        (frame.clone(), plan(&[("shade.kind", "phong")]), &["mode fast-phong", "shade.kind is phong"]),
        (
            with(&|f, s| {
                phong(f, s);
                s.viewer = Viewer::At(DVec3::ONE);
            }),
            plan(&[("shade.kind", "phong")]),
            &["a viewer at a point", "shade.kind = fast-phong"],
        ),
        (
            with(&|f, s| {
                phong(f, s);
                s.lights = vec![lamp(Attenuation::NONE)];
            }),
            plan(&[("shade.kind", "phong")]),
            &["light 1", "every light is directional"],
        ),
        (with(&|f, _| f.triangles[0].0[1].g = 0.123), fast(&[]), &["triangle 0", "shade.colour=multiply"]),
        (
            with(&|_, s| s.materials[0].ambient = DVec3::splat(1.0)),
            fast(&[("shade.colour", "multiply")]),
            &["come to 1.", "at most 1", "shade.colour = tables"],
        ),
        (with(&many), fast(&[("shade.material_bits", "1")]), &["3 surfaces", "shade.material_bits=2"]),
        (
            with(&|_, s| s.materials[0].specular = DVec3::new(0.1, 0.2, 0.1)),
            fast(&[]),
            &["highlight", "must be grey"],
        ),
    ];
    for (frame, machine, words) in &cases {
        let error = to_port(frame, machine).err().unwrap().to_string();
        for word in *words {
            assert!(error.contains(word), "{word:?} is not in {error:?}");
        }
    }
    let still = with(&|_, s| s.lights = vec![lamp(Attenuation::NONE)]);
    assert!(to_port(&still, &fast(&[])).is_ok());
}

/// Some cases on one screen, under the lights of the first.
fn scene(random: &mut Pcg64Mcg, count: u32, lights: usize) -> Frame {
    let mut frame = case(random, 1, lights, 60.0);
    for number in 1..count {
        let next = case(random, number, lights, 60.0);
        let (own, other) = (frame.shading.as_mut().unwrap(), next.shading.unwrap());
        own.triangles.push(PixelTriangle { material: number % 5, ..other.triangles[0] });
        if number < 5 {
            own.materials.extend(other.materials);
        }
        let depth = f64::from(number * 7 % 11) / 11.0;
        frame.triangles.push(Triangle(next.triangles[0].0.map(|v| Vertex { z: depth, ..v })));
    }
    if lights == 1 {
        return frame;
    }
    // Of colours that vary too.
    for (k, vertex) in frame.triangles.iter_mut().flat_map(|triangle| &mut triangle.0).enumerate() {
        vertex.r = f64::from(k as u32 % 3) / 2.0;
    }
    frame
}

#[test]
fn the_model_draws_what_the_words_say_and_the_comparison_passes() {
    let kind = ("shade.kind", "fast-phong");
    let machines: [(&[(&str, &str)], usize); 5] = [
        (&[("shade.kind", "phong"), ("shade.material_bits", "8")], 1),
        (&[kind, ("shade.material_bits", "8")], 1),
        (&[kind, ("shade.material_bits", "8"), ("term.walk", "memory"), ("term.record_bits", "3")], 1),
        (&[kind, ("shade.lights", "2"), ("shade.colour", "multiply"), ("shade.table_bits", "8")], 2),
        (
            &[
                kind,
                ("shade.material_bits", "6"),
                ("memory.hazard", "interlock"),
                ("interpolator.segments", "2"),
            ],
            1,
        ),
    ];
    let mut checked = 0;
    for (settings, lights) in machines {
        let machine = plan(settings);
        let mut random = Pcg64Mcg::seed_from_u64(5);
        let frame = by(scene(&mut random, 40, lights), &machine);
        let port = to_port(&frame, &machine).unwrap();
        let feed = port.shade.as_ref().unwrap();
        let drawn = draw::fast(&frame, &machine, Waits::Never).unwrap();
        let golden = draw::golden(&frame, &machine);
        for (id, (triangle, record)) in frame.triangles.iter().zip(&feed.words.records).enumerate() {
            let leftward = leftward(&machine, &port.triangles[id].map(|v| [v.x().into(), v.y().into()]));
            fragments(triangle, frame.mode, machine.subpixel_bits, (frame.width, frame.height), |fragment| {
                let at = (fragment.y * frame.width + fragment.x) as usize;
                if drawn.id[at] != id as i32 || lights == 2 {
                    return; // with two lights colours vary, and what PIXEL hands on is its own matter
                }
                let right = i64::from(fragment.x) - i64::from(record.x);
                let place =
                    (if leftward { -right } else { right }, i64::from(fragment.y) - i64::from(record.y));
                let (color, _) = tinted(&machine, &feed.words, record, place, [0; 3]);
                assert_eq!(
                    drawn.rgb[at].map(|c| (c * 255.0).round() as u64),
                    color,
                    "{settings:?} triangle {id}"
                );
                checked += 1;
            });
        }
        let found = compare_shaded(&machine, &frame, &golden, &drawn, None, Some(&feed.proof));
        let shaded = found.shaded.unwrap();
        println!("{settings:?}: {shaded:?}");
        assert!(
            found.verdict() == Verdict::Pass && shaded.beyond == 0 && shaded.pixels > 20_000,
            "{found:?}"
        );
        assert!(shaded.of_bound > 0.5 && shaded.of_bound <= 1.0 && shaded.from_phong > 0.1, "{shaded:?}");
        // One table entry off, and it does not pass.
        let mut wrong = feed.words.clone();
        for word in &mut wrong.tables {
            *word = word.wrapping_add(4 << 8);
        }
        let passes = &port.passes;
        let off = render_passes(&machine, port.triangles.iter().copied(), passes, &[], Waits::Never, &wrong);
        let off = from_machine(&machine, off.unwrap());
        let found = compare_shaded(&machine, &frame, &golden, &off, None, Some(&feed.proof));
        assert!(found.verdict() != Verdict::Pass || lights == 2, "four LSB more");
    }
    println!("{checked} pixels as the words say");
    assert!(checked > 100_000);
}
