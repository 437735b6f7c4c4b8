//! Textures on the machine: random triangles with random pictures, each texel the one that the words name, within the error of the
//! words of golden's, and every colour within its bound.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_host::draw;
use edgewalk_host::port::to_port;
use edgewalk_host::raster::Raster;
use edgewalk_host::shade::Proof;
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
    let usual = [("shade.colour", "multiply"), ("texture.kind", "nearest"), ("texture.bits", "4")];
    for (key, value) in [("shade.kind", "fast-phong")].iter().chain(&usual).chain(settings) {
        machine.set(key, value).unwrap();
    }
    machine.plan().unwrap()
}

/// Texels of 8 bits a colour, or of 16.
fn picture(random: &mut Pcg64Mcg, [width, height]: [u32; 2]) -> Image {
    let unit = if random.random() { 257 } else { 1 };
    let mut texel = || [0; 3].map(|_| random.random::<u16>() / unit * unit);
    Image::of(width, height, (0..width * height).map(|_| texel()).collect()).unwrap()
}

/// Triangles with normals about the way to the viewer, five materials in turn, the last without a picture; places up to `far`.
fn frame(random: &mut Pcg64Mcg, count: u32, sides: &[[u32; 2]], far: f64, method: PixelMethod) -> Frame {
    let material = |place: u32| Material {
        ambient: DVec3::splat(0.2),
        specular: DVec3::splat(0.3),
        exponent: 12.0,
        texture: (place < 4).then_some(place),
        ..Material::matte(DVec3::splat(0.75))
    };
    let mut shading = PixelShading {
        method,
        viewer: Viewer::Toward(DVec3::Z),
        ambient: DVec3::ONE,
        lights: vec![Light::Directional {
            toward: DVec3::new(0.3, 0.4, 0.866).normalize(),
            intensity: DVec3::ONE,
        }],
        specular: Specular::Blinn,
        materials: (0..5).map(material).collect(),
        textures: (0..4).map(|k| picture(random, sides[k % sides.len()]).into()).collect(),
        triangles: Vec::new(),
    };
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
        let texture = [0; 3].map(|_| DVec2::new(around(far), around(far)));
        shading.triangles.push(PixelTriangle {
            normals,
            positions: [DVec3::ZERO; 3],
            texture,
            turns: [DVec3::ZERO; 2],
            material: number % 5,
        });
    }
    Frame { triangles, shading: Some(shading), ..Frame::new(160, 120) }
}

fn judged(frame: &Frame, machine: &Plan) -> (Comparison, Raster, Proof) {
    let port = to_port(frame, machine).unwrap();
    let golden = draw::golden(frame, machine);
    let drawn = draw::draw_frame(machine, &port, Waits::Never).unwrap().raster(machine);
    let proof = port.shade.unwrap().proof;
    (compare_shaded(machine, frame, &golden, &drawn, None, Some(&proof)), drawn, proof)
}

#[test]
fn every_texel_is_explained_and_every_colour_within_its_bound() {
    let phong = ("shade.kind", "phong");
    let whole: &[[u32; 2]] = &[[16, 16], [4, 8], [1, 2], [16, 1]];
    let odd: &[[u32; 2]] = &[[5, 7], [16, 16], [33, 3], [640, 2]];
    // Settings, pictures, how far places reach, and whether pictures are resampled.
    type Case<'a> = (&'a [(&'a str, &'a str)], &'a [[u32; 2]], f64, bool);
    let cases: [Case; 7] = [
        (&[], whole, 1.5, false),
        (&[phong], whole, 1.5, false),
        (&[("term.linear_fraction", "4")], whole, 3.0, false),
        (&[("term.walk", "memory"), ("term.linear_fraction", "30")], whole, 1000.0, false),
        (&[phong, ("texture.bits", "6"), ("shade.lights", "2")], odd, 0.5, true),
        (&[("texture.bits", "2"), ("formats.color_bits", "6")], odd, 2.0, true),
        (&[("texture.bits", "9"), ("shade.material_bits", "3")], whole, 0.2, false),
    ];
    let (mut pixels, mut differ) = (0, 0);
    for (settings, sides, far, resampled) in cases {
        let machine = plan(settings);
        let method = if machine.shade.normalises() { PixelMethod::Phong } else { PixelMethod::FastPhong };
        let mut random = Pcg64Mcg::seed_from_u64(2023);
        let frame = frame(&mut random, 200, sides, far, method);
        let (found, drawn, proof) = judged(&frame, &machine);
        let shaded = found.shaded.unwrap();
        let texels = shaded.texels.unwrap();
        println!(
            "{settings:?}: {} pixels, {} of textures, {} other than golden's within {:.4}, {} unexplained, {} resampled; largest error \
             {:.3} of {:.3} LSB, {:.3} of a bound",
            shaded.pixels,
            texels.pixels,
            texels.differ,
            texels.bound,
            texels.unexplained,
            texels.resampled,
            shaded.error,
            shaded.allowed,
            shaded.of_bound
        );
        assert_eq!(found.verdict(), Verdict::Pass, "{settings:?}: {found:?}");
        assert_eq!((texels.unexplained, shaded.beyond), (0, 0), "{settings:?}");
        assert!(texels.pixels > 5000 && texels.pixels < shaded.pixels, "{texels:?}");
        assert_eq!(texels.resampled > 0, resampled, "{texels:?}");
        assert!(shaded.of_bound > 0.5 && shaded.of_bound <= 1.0, "{shaded:?}");
        (pixels, differ) = (pixels + texels.pixels, differ + texels.differ);

        // Another texel than the one that is named is another colour, and is found.
        let mut other = proof.clone();
        for own in other.textured.iter_mut().flatten() {
            own.error = 0.0;
        }
        let golden = draw::golden(&frame, &machine);
        let strict = compare_shaded(&machine, &frame, &golden, &drawn, None, Some(&other));
        assert_eq!(strict.shaded.unwrap().texels.unwrap().unexplained, texels.differ, "no error is allowed");
        assert_eq!(strict.verdict() == Verdict::Pass, texels.differ == 0);
    }
    println!("{pixels} pixels of textures, {differ} other than golden's");
    assert!(pixels > 50_000 && differ > 500);
}

/// Every fifteenth line and column of pixels has its centres on the border of two texels: only rounding says which it is.
#[test]
fn borders_on_the_centres_of_pixels_are_taken_either_way() {
    let machine = plan(&[]);
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let mut one = frame(&mut random, 1, &[[16, 16]], 1.0, PixelMethod::FastPhong);
    let (x, y) = (8.5, 8.5);
    let corners = [(x, y), (x + 90.0, y), (x, y + 60.0)];
    for (vertex, (x, y)) in one.triangles[0].0.iter_mut().zip(corners) {
        (vertex.x, vertex.y) = (x, y);
    }
    let own = &mut one.shading.as_mut().unwrap().triangles[0];
    own.texture = corners.map(|(px, py)| DVec2::new((px - x) / 30.0, 1.0 - (py - y) / 30.0));
    let (found, ..) = judged(&one, &machine);
    let texels = found.shaded.unwrap().texels.unwrap();
    println!("{texels:?}");
    assert_eq!((found.verdict(), texels.unexplained), (Verdict::Pass, 0));
    assert!(texels.pixels > 2000 && texels.differ > 0);
}

#[test]
fn what_the_machine_cannot_take_is_named_with_a_remedy() {
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let good = frame(&mut random, 5, &[[2, 2]], 1.0, PixelMethod::FastPhong);
    let mut far = good.clone();
    far.shading.as_mut().unwrap().triangles[3].texture[1].y = f64::NAN;
    far.triangles[3] = Triangle([(10.0, 10.0), (90.0, 12.0), (20.0, 80.0)].map(|(x, y)| Vertex {
        x,
        y,
        ..Vertex::default()
    }));
    let mut many = frame(&mut random, 200, &[[2, 2]], 1.0, PixelMethod::FastPhong);
    let shading = many.shading.as_mut().unwrap();
    shading.materials = (0..200).map(|_| shading.materials[0]).collect();
    for (material, own) in (0..).zip(&mut shading.triangles) {
        own.material = material;
    }
    let cases: [(&Frame, Plan, &[&str]); 3] = [
        (&good, plan(&[("texture.kind", "none")]), &["no TEXEL", "texture.kind=nearest", "--adapt"]),
        (&far, plan(&[]), &["triangle 3", "texture coordinate NaN", "-1000000 to 1000000"]),
        (
            &many,
            plan(&[("shade.material_bits", "8"), ("texture.bits", "9")]),
            &["texture.bits = 9", "200 surfaces", "take fewer bits"],
        ),
    ];
    for (frame, machine, words) in &cases {
        let error = format!("{:#}", to_port(frame, machine).err().unwrap());
        for word in *words {
            assert!(error.contains(word), "{word:?} is not in {error:?}");
        }
    }
    // A machine with TEXEL draws what has no texture.
    let mut plain = good;
    let shading = plain.shading.as_mut().unwrap();
    shading.textures.clear();
    shading.materials.iter_mut().for_each(|material| material.texture = None);
    let (found, ..) = judged(&plain, &plan(&[]));
    assert_eq!((found.verdict(), found.shaded.unwrap().texels), (Verdict::Pass, None));
}
