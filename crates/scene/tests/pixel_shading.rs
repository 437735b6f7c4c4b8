//! Triangle files with normals: every item, round trip, and what is refused with which words.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_scene::{
    Frame, Image, Light, Material, PixelMethod, PixelShading, PixelTriangle, ShadeMode, Specular, Triangle,
    Vertex, Viewer, triangle_file,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::sync::Arc;

const T: &str = "T 0 0 0 1 1 1 0  9 0 0.5 1 1 1 0  0 9 1 1 1 1 0";
const N: &str = "N 0 0 1  0.6 0 0.8  0 -0.6 0.8";

/// A header with all that `mode phong` needs.
const HEADER: &str = "size 9 9\nmode phong\nview 0 0 2\nmaterial 0.1 0.5 0.4 20\n";

fn parse(text: &str) -> Frame {
    triangle_file::parse("a.tri", text.as_bytes()).unwrap()
}

#[test]
fn every_item_is_taken_in_any_order() {
    let text = format!(
        "material 0.2 0.5 0.4 20\nsun 0 3 4 0.75 # second\nspecular blinn\nambient 0.3\nsize 9 9\nextra 1\nsun 1 0 0 2\nview 0 0 -2\nmode \
         fast-phong\n{T}\n{N}\nX 1 2 3\nmaterial 0 1 0 1\nmaterial 1 0 0.5 7.5\n{T}\n\nX 4 5 6 # before N\n{N}\n{T}\nN \
         1.001 0 0 0 1 0 0 0 1\nX 7 8 9\n"
    );
    let frame = parse(&text);
    let shading = frame.shading.unwrap();
    assert_eq!((frame.mode, shading.method), (ShadeMode::Gouraud, PixelMethod::FastPhong));
    assert_eq!(shading.viewer, Viewer::Toward(DVec3::NEG_Z));
    assert_eq!((shading.ambient, shading.specular), (DVec3::splat(0.3), Specular::Blinn));
    let sun = |x, y, z, i| Light::Directional { toward: DVec3::new(x, y, z), intensity: DVec3::splat(i) };
    assert_eq!(shading.lights, [sun(0.0, 0.6, 0.8, 0.75), sun(1.0, 0.0, 0.0, 2.0)]);
    let coefficients =
        |m: &Material| [m.ambient, m.diffuse, m.specular].map(|k| k.x).into_iter().chain([m.exponent]);
    let materials: Vec<Vec<f64>> = shading.materials.iter().map(|m| coefficients(m).collect()).collect();
    assert_eq!(materials, [[0.2, 0.5, 0.4, 20.0], [1.0, 0.0, 0.5, 7.5]], "the second was never used");
    let used: Vec<u32> = shading.triangles.iter().map(|triangle| triangle.material).collect();
    assert_eq!(used, [0, 1, 1]);
    let first = [DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, -0.6, 0.8)];
    assert_eq!(shading.triangles[0].normals, first);
    assert_eq!(shading.triangles[2].normals, [DVec3::X, DVec3::Y, DVec3::Z], "brought to length 1");
    assert_eq!(frame.triangles[1].0[2].extra[0], 6.0);
}

#[test]
fn without_such_a_mode_nothing_changes_and_halfway_is_usual() {
    assert_eq!(parse(&format!("size 9 9\n{T}")).shading, None);
    let shading = parse(&format!("{HEADER}{T}\n{N}")).shading.unwrap();
    assert_eq!((shading.specular, shading.lights.len()), (Specular::Halfway, 0));
    assert_eq!(shading.ambient, DVec3::ONE);
    let empty = parse("size 9 9\nmode phong\nview 0 0 1").shading.unwrap();
    assert_eq!((empty.materials.len(), empty.triangles.len()), (0, 0));
}

/// A machine has tables for few materials, and a mesh may change between them often.
#[test]
fn lines_of_one_material_are_one_material() {
    let lines = ["material 0 1 0 1", "material 0 1 0 2", "material 0.0 1.0 0 1", "material 0 1 0 2"];
    let text: String = lines.map(|line| format!("{line}\n{T}\n{N}\n")).concat();
    let shading = parse(&format!("size 9 9\nmode phong\nview 0 0 1\n{text}")).shading.unwrap();
    let places: Vec<u32> = shading.triangles.iter().map(|triangle| triangle.material).collect();
    assert_eq!((shading.materials.len(), &places[..]), (2, &[0, 1, 0, 1][..]));
    let picture = |color: &str| format!("material 0 1 0 1\ntexture 1 1 {color}\n{T}\n{N}\nUV 0 0 1 0 0 1\n");
    let text = ["ff8000", "ff8001", "ff8000"].map(picture).concat();
    let shading = parse(&format!("size 9 9\nmode phong\nview 0 0 1\n{text}")).shading.unwrap();
    let places: Vec<u32> = shading.triangles.iter().map(|triangle| triangle.material).collect();
    assert_eq!((shading.materials.len(), shading.textures.len(), &places[..]), (2, 2, &[0, 1, 0][..]));
}

#[test]
fn normals_that_are_not_unit_vectors_are_not_written() {
    let mut frame = parse(&format!("{HEADER}{T}\n{N}"));
    frame.shading.as_mut().unwrap().triangles[0].normals[1] *= 0.995;
    let error = triangle_file::write(&frame, std::io::sink()).unwrap_err().to_string();
    assert!(
        error.starts_with("triangle 0 has the normal ") && error.ends_with("normals of length 1"),
        "{error}"
    );
}

#[test]
fn malformed_shading_names_place_and_remedy() {
    let with = |line: &str| format!("{HEADER}{line}\n{T}\n{N}");
    let behind = |line: &str| format!("{HEADER}{T}\n{line}");
    let without = |line: &str| format!("{HEADER}{T}\n{N}").replace(line, "");
    let cases: [(String, &[&str]); 44] = [
        (
            "size 9 9\nmode fong".into(),
            &["a.tri:2: mode: `fong`", "gouraud flat phong fast-phong", "did you mean `phong`?"],
        ),
        ("size 9 9\nmode fastphong".into(), &["did you mean `fast-phong`?"]),
        (with("ambient 101"), &["a.tri:5: ambient: `101`", "from 0 to 100"]),
        (with("ambient 0.2\nambient 0.2"), &["a.tri:6: ambient: `ambient`", "permitted once"]),
        (format!("size 9 9\nambient 1\n{T}"), &["a.tri:2:", "`ambient`", "only with `mode phong`"]),
        ("size 9 9\nmode phong 2".into(), &["a.tri:2: mode: `2 given`", "1 value"]),
        (
            without("view 0 0 2\n"),
            &["a.tri:4: view: `T`", "`view x y z`", "is missing", "`mode phong` needs it"],
        ),
        ("size 9 9\nmode fast-phong".into(), &["a.tri:3: view: `end of file`", "missing"]),
        (
            without("material 0.1 0.5 0.4 20\n"),
            &["a.tri:4: material: `T`", "`material ka kd ks n` is missing"],
        ),
        (with("view 0 0 1"), &["a.tri:5: view", "once"]),
        (with("veiw 0 0 1"), &["a.tri:5:", "did you mean `view`?"]),
        (
            without("view 0 0 2").replace("mode phong", "mode phong\nview 0 0"),
            &["a.tri:3: view: `2 given`", "3 values"],
        ),
        (
            without("view 0 0 2").replace("mode phong", "mode phong\nview 0 0 0"),
            &["view: `0 0 0`", "a vector with a direction"],
        ),
        (
            without("view 0 0 2").replace("mode phong", "mode phong\nview 0 up 0"),
            &["view y: `up`", "a finite number"],
        ),
        (
            without("view 0 0 2").replace("mode phong", "mode phong\nview 1e308 1e308 0"),
            &["view: `1e308 1e308 0`", "a direction"],
        ),
        (with("sun 0 0 1"), &["a.tri:5: sun: `3 given`", "4 values"]),
        (with("sun 0 0 1 1 1 1"), &["sun: `6 given`", "4 values"]),
        (with("sun 0 0 inf 1"), &["sun z: `inf`", "a finite number"]),
        (with("sun 0 0 0 1"), &["sun: `0 0 0`", "a vector with a direction"]),
        (with("sun 0 0 1 -0.5"), &["sun i: `-0.5`", "a number from 0 to 100"]),
        (with("sun 0 0 1 101"), &["sun i: `101`", "from 0 to 100"]),
        (with("son 0 0 1 1"), &["did you mean `sun`?"]),
        (with("specular mirror"), &["a.tri:5: specular: `mirror`", "permitted: halfway blinn"]),
        (with("specular half-way"), &["did you mean `halfway`?"]),
        (with("specular blinn\nspecular blinn"), &["a.tri:6: specular", "once"]),
        (with("material 0.1 0.5 0.4"), &["a.tri:5: material: `3 given`", "4 values"]),
        (with("material 1.5 0.5 0.4 20"), &["material ka: `1.5`", "a number from 0 to 1"]),
        (with("material 0.1 -1 0.4 20"), &["material kd: `-1`", "from 0 to 1"]),
        (with("material 0.1 0.5 nan 20"), &["material ks: `nan`"]),
        (with("material 0.1 0.5 0.4 0.5"), &["material n: `0.5`", "a number from 1 to 1024"]),
        (with("materiel 0 0 0 1"), &["did you mean `material`?"]),
        (
            "size 9 9\nsun 0 0 1 1\nview 0 0 1".into(),
            &["a.tri:2: line starts with: `sun`", "only with `mode phong` or `mode fast-phong`"],
        ),
        (format!("size 9 9\n{T}\nmaterial 0 0 0 1"), &["a.tri:3:", "`material`", "only with `mode phong`"]),
        (format!("size 9 9\n{T}\n{N}"), &["a.tri:3:", "`N`", "only with `mode phong`"]),
        (behind("sun 0 0 1 1"), &["a.tri:6: N: `sun`", "the `N` of the triangle in line 5 is missing"]),
        (format!("{HEADER}{T}\n{N}\nsun 0 0 1 1"), &["a.tri:7: sun", "only before the first triangle"]),
        (
            behind(T),
            &["a.tri:6: N: `T`", "of the triangle in line 5 is missing", "9 values, nx ny nz of vertex 1"],
        ),
        (behind(""), &["a.tri:6: N: `end of file`", "line 5 is missing"]),
        (behind("N 0 0 1 0 0 1 0 0"), &["a.tri:6: N: `8 given`", "9 values"]),
        (behind("N 0 0 1 0 0 1 0 0 one"), &["N vertex 3 z: `one`", "a finite number"]),
        (
            behind("N 0 0 1 3 0 4 0 0 1"),
            &["N vertex 2: `3 0 4`", "of length 1, to within 0.01", "the nearest is 0.6 0 0.8"],
        ),
        (behind("N 0 0 1 0 0 0 0 0 1"), &["N vertex 2: `0 0 0`", "of length 1, to within 0.01"]),
        (behind(&format!("{N}\n{N}")), &["a.tri:7:", "`N`", "once, behind a triangle `T`"]),
        (
            format!("{HEADER}{}", T.replace('T', "P 3")),
            &["a.tri:5:", "`P`", "no `N`", "`mode phong`: only triangles"],
        ),
    ];
    for (text, words) in &cases {
        let error = triangle_file::parse("a.tri", text.as_bytes()).unwrap_err().to_string();
        for word in *words {
            assert!(error.contains(word), "{text:?}: {word:?} is not in {error:?}");
        }
    }
}

#[test]
fn what_is_drawn_while_it_is_read_has_no_normals() {
    let text = format!("{HEADER}{T}\n{N}");
    let mut reader = triangle_file::Reader::new("a.tri", text.as_bytes()).unwrap();
    assert!(reader.header().shading.is_some());
    let error = reader.next().unwrap().unwrap_err().to_string();
    assert!(error.contains("`phong`") && error.contains("only triangles from here on"), "{error}");
}

fn direction() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..=1.0f64)
        .prop_map(DVec3::from)
        .prop_filter("a direction", |v| v.length() > 1e-3)
        .prop_map(DVec3::normalize)
}

prop_compose! {
    /// Of 8 bits a colour, or of 16.
    fn picture()(width in 1..5u32, height in 1..5u32, eight in any::<bool>())(
        texels in prop::collection::vec(any::<[u16; 3]>(), (width * height) as usize),
        (width, height, eight) in Just((width, height, eight)),
    ) -> Image {
        let part = |part: u16| if eight { part / 257 * 257 } else { part };
        Image::of(width, height, texels.into_iter().map(|texel| texel.map(part)).collect()).unwrap()
    }
}

prop_compose! {
    fn shading()(
        method in prop::sample::select(PixelMethod::ALL.to_vec()),
        viewer in direction().prop_map(Viewer::Toward),
        ambient in prop_oneof![Just(1.0), 0.0..=100.0f64],
        lights in prop::collection::vec((direction(), 0.0..=100.0f64), 0..4),
        specular in prop::sample::select(PixelShading::FORMS.to_vec()),
        materials in prop::collection::vec((prop::array::uniform3(0.0..=1.0f64), 1.0..=1024.0f64), 1..4),
        normals in prop::collection::vec(prop::array::uniform3(direction()), 1..5),
        pictures in prop::collection::vec(prop::option::of(picture()), 4),
    ) -> PixelShading {
        let mut textures = Vec::new();
        let of_material: Vec<Option<u32>> = pictures.into_iter().take(materials.len()).map(|picture| {
            textures.push(Arc::new(picture?));
            Some(textures.len() as u32 - 1)
        }).collect();
        let light = |(toward, i)| Light::Directional { toward, intensity: DVec3::splat(i) };
        let material = |(([a, d, s], exponent), texture): (([f64; 3], f64), &Option<u32>)| {
            let [ambient, specular] = [a, s].map(DVec3::splat);
            Material { ambient, specular, exponent, texture: *texture, ..Material::matte(DVec3::splat(d)) }
        };
        let textured = |material: u32| of_material[material as usize].is_some();
        // Each material has a triangle.
        let triangles = (0..materials.len() as u32).flat_map(|material| {
            let own = |normals: &[DVec3; 3]| {
                // Any numbers that a file can say.
                let place = |k: usize| DVec2::new(normals[k].x * 1e3, normals[k].y / 3.0);
                let texture = if textured(material) { [0, 1, 2].map(place) } else { [DVec2::ZERO; 3] };
                PixelTriangle { normals: *normals, positions: [DVec3::ZERO; 3], texture, turns: [DVec3::ZERO; 2], material }
            };
            normals.iter().map(own).collect::<Vec<_>>()
        });
        PixelShading {
            method, viewer, ambient: DVec3::splat(ambient), specular,
            lights: lights.into_iter().map(light).collect(),
            triangles: triangles.collect(),
            materials: materials.into_iter().zip(&of_material).map(material).collect(),
            textures,
        }
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read_back(shading in shading()) {
        let corner = |x, y| Vertex { x, y, ..Vertex::default() };
        let triangle = Triangle([corner(0.0, 0.5), corner(9.0, 1.0), corner(3.0, 8.0)]);
        let triangles = vec![triangle; shading.triangles.len()];
        let frame = Frame { triangles, shading: Some(shading), ..Frame::new(9, 9) };
        let mut text = Vec::new();
        triangle_file::write(&frame, &mut text).unwrap();
        prop_assert_eq!(triangle_file::parse("a.tri", &text[..]).unwrap(), frame);
    }

    #[test]
    fn no_text_panics(text in "(size 9 9\n|mode phong\n|view|ambient|sun|specular|material|texture 1 1|T|N|UV|X|P 3|[0-9 .e-]|\n){0,40}") {
        let _ = triangle_file::parse("a.tri", text.as_bytes());
    }
}
