//! glTF files: what is taken, and what is refused with which words.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::common::{file, front, read, refusal};
use edgewalk_scene::{Mesh, Texture};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::fs;

/// A square of two triangles in a `.gltf` whose buffer is a file beside it.
struct Gltf {
    json: String,
    buffer: Vec<u8>,
}

impl Gltf {
    fn square() -> Self {
        let positions: [f32; 12] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
        let indices: [u16; 6] = [0, 1, 2, 0, 2, 3];
        let mut buffer: Vec<u8> = positions.iter().flat_map(|p| p.to_le_bytes()).collect();
        buffer.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
        let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
            "nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
            "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,1,1]}}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                         {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
            "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
            "buffers":[{"uri":"a.bin","byteLength":60}]}"#;
        Self { json: json.into(), buffer }
    }

    fn with(mut self, from: &str, to: &str) -> Self {
        assert!(self.json.contains(from), "{from}");
        self.json = self.json.replace(from, to);
        self
    }

    fn read(&self) -> Result<Mesh, String> {
        let (dir, path) = file("a.gltf", &self.json);
        fs::write(dir.path().join("a.bin"), &self.buffer).unwrap();
        Mesh::read(&path).map_err(|error| error.to_string())
    }

    /// The same as one binary file.
    fn binary(&self) -> Vec<u8> {
        let padded = |mut bytes: Vec<u8>, with: u8| {
            bytes.resize(bytes.len().next_multiple_of(4), with);
            bytes
        };
        let json = padded(self.json.replace(r#""uri":"a.bin","#, "").into_bytes(), b' ');
        let buffer = padded(self.buffer.clone(), 0);
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend((28 + json.len() as u32 + buffer.len() as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", json), (b"BIN\0", buffer)] {
            bytes.extend((chunk.len() as u32).to_le_bytes());
            bytes.extend(kind);
            bytes.extend(chunk);
        }
        bytes
    }
}

#[test]
fn gltf_nodes_place_their_meshes() {
    let text = Gltf::square().read().unwrap();
    assert_eq!(text, read("a.glb", Gltf::square().binary()));
    assert_eq!(text.bounds(), [DVec3::new(10.0, 0.0, 0.0), DVec3::new(12.0, 2.0, 0.0)]);
    assert_eq!(text.faces().len(), 2);
    assert_eq!(text.materials()[0].diffuse, DVec3::new(0.25, 0.5, 1.0));
    let nested = r#""translation":[0,0,5],"children":[1]},{"mesh":0,"#;
    let nested = Gltf::square().with(r#""mesh":0,"#, nested).read().unwrap();
    assert_eq!(nested.bounds(), [DVec3::new(10.0, 0.0, 5.0), DVec3::new(12.0, 2.0, 5.0)]);
    let mirrored = Gltf::square().with("[2,2,2]", "[-2,2,2]").read().unwrap();
    assert_eq!(mirrored.bounds()[0].x, 8.0);
    for face in 0..2 {
        assert_eq!((front(&text, face), front(&mirrored, face)), (DVec3::Z, DVec3::Z));
    }
}

#[test]
fn gltf_materials_normals_and_texture_coordinates() {
    let mut gltf = Gltf::square()
        .with(r#"{"POSITION":0}"#, r#"{"POSITION":0,"NORMAL":2,"TEXCOORD_0":3}"#)
        .with(
            r#""bufferViews":["#,
            r#""images":[{"uri":"away.png"}],"textures":[{"source":0}],
            "bufferViews":[{"buffer":0,"byteOffset":60,"byteLength":48},{"buffer":0,"byteLength":48},"#,
        )
        .with(r#""bufferView":1,"#, r#""bufferView":3,"#)
        .with(r#"{"bufferView":0,"#, r#"{"bufferView":2,"#)
        .with(
            r#""type":"SCALAR"}"#,
            r#""type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
            {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}"#,
        )
        .with(
            r#"{"baseColorFactor":[0.25,0.5,1,1]}}"#,
            r#"{"baseColorFactor":[0.25,0.5,1,0.25],"metallicFactor":0.5,"roughnessFactor":0.5,
            "baseColorTexture":{"index":0}},"emissiveFactor":[0,1,0.5],"alphaMode":"BLEND"}"#,
        )
        .with("\"byteLength\":60", "\"byteLength\":108")
        .with("[2,2,2]", "[2,2,4]");
    for _ in 0..4 {
        gltf.buffer.extend([0.6f32, 0.0, 0.8].into_iter().flat_map(f32::to_le_bytes));
    }
    let mesh = gltf.read().unwrap();
    let material = mesh.materials()[0];
    assert_eq!(
        (material.diffuse, material.ambient),
        (DVec3::new(0.25, 0.5, 1.0), DVec3::new(0.25, 0.5, 1.0))
    );
    assert!(material.specular.distance(DVec3::new(0.145, 0.27, 0.52) / 2.0) < 1e-12, "{}", material.specular);
    assert_eq!((material.exponent, material.transmission), (30.0, 0.75));
    assert_eq!(material.emission, DVec3::new(0.0, 1.0, 0.5));
    assert_eq!((material.texture, mesh.textures()), (Some(0), &[Texture::Absent("away.png".into())][..]));
    let data = mesh.face_data()[0];
    // Twice as far along z as along x, a normal leans the other way.
    let leaning = DVec3::new(0.3, 0.0, 0.2).normalize();
    assert!(data.normals.unwrap().iter().all(|normal| normal.distance(leaning) < 1e-7), "{:?}", data.normals);
    // The first numbers of the positions, two by two; v runs down in the file.
    let places = [(0.0, 0.0), (0.0, 1.0), (0.0, 0.0)].map(|(u, v)| DVec2::new(u, 1.0 - v));
    assert_eq!(data.texture, Some(places));
    let short = Gltf { buffer: gltf.buffer, ..Gltf::square() };
    let short = short.with(r#"{"POSITION":0}"#, r#"{"POSITION":0,"NORMAL":1}"#);
    assert!(short.read().unwrap_err().contains("NORMAL"), "an index is no normal");
}

/// The greatest integer is 1, not a little less: a texture ends where it ends.
#[test]
fn gltf_texture_coordinates_in_integers() {
    for (kind, bytes) in [
        (5121, [0u8, 255, 51, 204, 255, 0, 0, 0].to_vec()),
        (5123, {
            let parts = [0u16, 65535, 13107, 52428, 65535, 0, 0, 0];
            parts.iter().flat_map(|part| part.to_le_bytes()).collect()
        }),
    ] {
        let length = bytes.len();
        let mut gltf = Gltf::square()
            .with(r#"{"POSITION":0}"#, r#"{"POSITION":0,"TEXCOORD_0":2}"#)
            .with(
                r#""type":"SCALAR"}"#,
                &format!(
                    r#""type":"SCALAR"}},
                    {{"bufferView":2,"componentType":{kind},"normalized":true,"count":4,"type":"VEC2"}}"#
                ),
            )
            .with(
                r#""byteOffset":48,"byteLength":12}"#,
                &format!(r#""byteOffset":48,"byteLength":12}},{{"buffer":0,"byteOffset":60,"byteLength":{length}}}"#),
            )
            .with("\"byteLength\":60", &format!("\"byteLength\":{}", 60 + length));
        gltf.buffer.extend(bytes);
        let places = gltf.read().unwrap().face_data()[0].texture.unwrap();
        // v runs down in the file.
        let expected = [(0.0, 1.0), (0.2, 0.8), (1.0, 0.0)].map(|(u, v)| DVec2::new(u, 1.0 - v));
        for (place, expected) in places.into_iter().zip(expected) {
            assert!(place.distance(expected) < 1e-15, "{kind}: {place}, not {expected}");
        }
    }
}

#[test]
fn gltf_strips_and_fans_keep_their_fronts() {
    for (mode, triangles) in [(5, 4), (6, 4), (4, 2)] {
        let mode = format!(r#""mode":{mode},"indices""#);
        let mut gltf = Gltf::square().with(r#""indices""#, &mode);
        // As a strip: 0 1 3 2 is the square; the rest has no area.
        let strip: [u16; 6] =
            if triangles == 4 && mode.contains('5') { [0, 1, 3, 2, 2, 2] } else { [0, 1, 2, 0, 2, 3] };
        gltf.buffer.splice(48.., strip.iter().flat_map(|i| i.to_le_bytes()));
        let mesh = gltf.read().unwrap();
        assert_eq!(mesh.faces().len(), triangles);
        for face in 0..triangles {
            let normal = front(&mesh, face);
            assert!(normal.is_nan() || normal == DVec3::Z, "{mode} {face} {normal}");
        }
    }
}

#[test]
fn malformed_gltf_files_name_the_part_and_the_remedy() {
    let square = Gltf::square;
    let cases: [(Gltf, &[&str]); 14] = [
        (Gltf { json: "{".into(), ..square() }, &["a.gltf:1: JSON", "line 1 column"]),
        (Gltf { json: "{\n\"asset\" 3}".into(), ..square() }, &["a.gltf:2: JSON", "expected `:`"]),
        (
            Gltf { buffer: vec![0; 10], ..square() },
            &["buffer 0: `10 bytes`", "the 60 bytes that its byteLength"],
        ),
        (square().with("a.bin", "b.bin"), &["b.bin: cannot be read"]),
        (square().with(r#""mesh":0"#, r#""mesh":7"#), &["nodes[0].mesh", "ndex"]),
        (square().with(r#"{"POSITION":0}"#, "{}"), &["meshes[0].primitives[0].attributes", "Missing data"]),
        (square().with("5126", "5123"), &["node 0 primitive 0 POSITION: `(Vec3, U16)`", "three f32"]),
        (
            square().with(r#""indices":1"#, r#""indices":0"#),
            &["primitive 0 indices", "Vec3", "unsigned integers"],
        ),
        (square().with(r#""count":4"#, r#""count":3"#), &["primitive 0 indices: `3`", "below 3"]),
        (
            square().with(r#""count":4"#, r#""count":5"#),
            &["POSITION: `accessor 0: 5 of 12 bytes", "within the buffer view"],
        ),
        (
            square().with(r#""count":6"#, r#""count":0"#),
            &["primitive 0 indices: `accessor 1: 0 of 2", "at least one element"],
        ),
        (
            square().with(r#""count":6"#, r#""count":5"#),
            &["primitive 0: `5 corners`", "three for each triangle"],
        ),
        (square().with(r#""mesh":0"#, r#""mesh":0,"children":[0]"#), &["node 0: `two parents`", "tree"]),
        (square().with(r#""scene":0,"scenes":[{"nodes":[0]}],"#, ""), &["scenes: `none`"]),
    ];
    for (gltf, fragments) in cases {
        let message = gltf.read().unwrap_err();
        for fragment in fragments {
            assert!(message.contains(fragment), "{message:?} lacks {fragment:?}");
        }
    }
    let mut nan = square();
    nan.buffer.splice(0..4, f32::NAN.to_le_bytes());
    assert!(nan.read().unwrap_err().contains("position: `[NaN"), "{:?}", nan.read());
    let cut = &square().binary()[..100];
    assert!(refusal("a.glb", cut).contains("a.glb: glTF"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_glb_panics(at in 0usize..1000, byte in any::<u8>(), length in 0usize..1100) {
        let mut bytes = Gltf::square().binary();
        let at = at % bytes.len();
        bytes[at] = byte;
        bytes.truncate(length);
        let (_dir, path) = file("a.glb", bytes);
        let _ = Mesh::read(&path);
    }

    #[test]
    fn no_digit_of_a_gltf_panics(which in 0usize..80, digits in "[0-9]{1,19}") {
        let mut gltf = Gltf::square();
        let place = gltf.json.char_indices().filter(|(_, c)| c.is_ascii_digit()).nth(which).map(|(at, _)| at);
        if let Some(at) = place {
            gltf.json.replace_range(at..at + 1, &digits);
        }
        let _ = gltf.read();
    }
}
