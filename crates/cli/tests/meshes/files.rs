//! The meshes as files of every kind that is read: OBJ with MTL, glTF with its buffer beside it, and in one binary file.

use super::shapes::{self, Shape};
use image::{Rgb, RgbImage};
use serde_json::json;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

/// Triangles of all written meshes.
pub const TRIANGLES: usize = 25_984;
/// Their number.
pub const FILES: usize = 7;
/// Those of them that are closed.
pub const CLOSED: usize = 6;

const MTL: &str = "newmtl m0\nKd .8 .7 .5\nKs .4 .4 .4\nNs 30\nmap_Kd checks.png\n\
                   newmtl m1\nKd .3 .5 .8\nKs .2 .2 .2\nNs 10\n\
                   newmtl m2\nKd .7 .3 .3\n";

/// Writes all of them into `folder`.
pub fn write_all(folder: &Path) {
    let checks = RgbImage::from_fn(64, 64, |x, y| {
        let light = if (x / 8 + y / 8) % 2 == 0 { 255 } else { 90 };
        Rgb([light, 255 - (x * 2) as u8, light])
    });
    checks.save(folder.join("checks.png")).unwrap();
    std::fs::write(folder.join("all.mtl"), MTL).unwrap();
    for (name, shape) in [
        ("torus", shapes::torus()),
        ("sphere", shapes::sphere()),
        ("knot", shapes::knot()),
        ("terrain", shapes::terrain()),
        ("cube", shapes::cube()),
    ] {
        std::fs::write(folder.join(format!("{name}.obj")), obj(&shape)).unwrap();
    }
    let (mut document, buffer) = gltf(&shapes::thread());
    document["buffers"][0]["uri"] = "thread.bin".into();
    std::fs::write(folder.join("thread.bin"), &buffer).unwrap();
    std::fs::write(folder.join("thread.gltf"), document.to_string()).unwrap();
    let (document, buffer) = gltf(&shapes::crescent());
    std::fs::write(folder.join("crescent.glb"), glb(&document.to_string(), &buffer)).unwrap();
}

fn obj(shape: &Shape) -> String {
    let mut text = "mtllib all.mtl\n".to_owned();
    for [x, y, z] in &shape.points {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    for [u, v] in &shape.places {
        writeln!(text, "vt {u} {v}").unwrap();
    }
    for [x, y, z] in shape.normals.iter().flatten() {
        writeln!(text, "vn {x} {y} {z}").unwrap();
    }
    let mut last = None;
    for face in &shape.faces {
        if last != Some((face.material, face.group)) {
            last = Some((face.material, face.group));
            let group = if face.group == 0 { "off".to_owned() } else { face.group.to_string() };
            writeln!(text, "usemtl m{}\ns {group}", face.material).unwrap();
        }
        text += "f";
        for (point, place) in &face.corners {
            match shape.normals {
                Some(_) => write!(text, " {}/{}/{}", point + 1, place + 1, point + 1).unwrap(),
                None => write!(text, " {}/{}", point + 1, place + 1).unwrap(),
            }
        }
        text += "\n";
    }
    text
}

/// The document, and its buffer: places, texture places, corners of triangles.
fn gltf(shape: &Shape) -> (serde_json::Value, Vec<u8>) {
    // A vertex has one texture place: along the seam points are there twice.
    let mut known: HashMap<(usize, usize), u32> = HashMap::new();
    let (mut positions, mut places, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for face in &shape.faces {
        let mut corner = |&(point, place): &(usize, usize)| {
            let fresh = known.len() as u32;
            *known.entry((point, place)).or_insert_with(|| {
                positions.extend(shape.points[point].map(|c| c as f32));
                places.extend(shape.places[place].map(|c| c as f32));
                fresh
            })
        };
        let corners: Vec<u32> = face.corners.iter().map(&mut corner).collect();
        for k in 1..corners.len() - 1 {
            indices.extend([corners[0], corners[k], corners[k + 1]]);
        }
    }
    let floats = |list: &[f32]| list.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let parts =
        [floats(&positions), floats(&places), indices.iter().flat_map(|v: &u32| v.to_le_bytes()).collect()];
    let end = |k: usize| parts[..k].iter().map(Vec::len).sum::<usize>();
    let views: Vec<_> =
        (0..3).map(|k| json!({ "buffer": 0, "byteOffset": end(k), "byteLength": parts[k].len() })).collect();
    let side = |axis: usize, pick: fn(f32, f32) -> f32| {
        positions.iter().skip(axis).step_by(3).copied().reduce(pick).unwrap()
    };
    let [min, max] = [f32::min, f32::max].map(|pick| [0, 1, 2].map(|axis| side(axis, pick)));
    let document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "rotation": [0.0, 0.6, 0.0, 0.8] }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "roughnessFactor": 0.5 } }],
        "textures": [{ "source": 0 }],
        "images": [{ "uri": "checks.png" }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": known.len(), "type": "VEC3", "min": min, "max": max },
            { "bufferView": 1, "componentType": 5126, "count": known.len(), "type": "VEC2" },
            { "bufferView": 2, "componentType": 5125, "count": indices.len(), "type": "SCALAR" },
        ],
        "bufferViews": views,
        "buffers": [{ "byteLength": end(3) }],
    });
    (document, parts.concat())
}

fn glb(document: &str, buffer: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8], fill: u8| {
        let mut padded = data.to_vec();
        padded.resize(data.len().next_multiple_of(4), fill);
        [&(padded.len() as u32).to_le_bytes()[..], kind, &padded].concat()
    };
    let body = [chunk(b"JSON", document.as_bytes(), b' '), chunk(b"BIN\0", buffer, 0)].concat();
    [b"glTF", &2u32.to_le_bytes()[..], &(body.len() as u32 + 12).to_le_bytes(), &body].concat()
}
