//! What MTL and glTF say of surfaces, and what OBJ says of corners.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::common;
use crate::common::{file, front, read};
use edgewalk_scene::{Material, Mesh, Texture};
use glam::{DVec2, DVec3};
use std::fs;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A mesh of one face a material of the library, in its order.
fn with_library(library: &str, names: &[&str]) -> Result<Mesh, String> {
    let calls: String = names.iter().map(|name| format!("usemtl {name}\nf 1 2 3\n")).collect();
    let (dir, path) = file("a.obj", format!("mtllib a.mtl\n{SQUARE}{calls}"));
    fs::write(dir.path().join("a.mtl"), library).unwrap();
    Mesh::read(&path).map_err(|error| error.to_string())
}

/// Of each face.
fn materials(mesh: &Mesh) -> Vec<Material> {
    mesh.faces().iter().map(|face| mesh.materials()[face.material as usize]).collect()
}

#[test]
fn every_line_of_a_library_becomes_its_coefficient() {
    let library = "newmtl glass\n Ka 0.1 0.2 0.3\n Kd 0.4 0.5 0.6\n Ks 0.7 0.8 0.9\n Ke 17 12 4\n Ns 250\n d 0.25\n illum 2\n\
                   newmtl plain\nKd 0.4 0.5 0.6\nNi 1.5\nnewmtl veil\nTr 0.5 0.5\n";
    let [glass, plain, veil]: [Material; 3] =
        materials(&with_library(library, &["glass", "plain", "veil"]).unwrap()).try_into().unwrap();
    let expected = Material {
        emission: DVec3::new(17.0, 12.0, 4.0),
        ambient: DVec3::new(0.1, 0.2, 0.3),
        diffuse: DVec3::new(0.4, 0.5, 0.6),
        specular: DVec3::new(0.7, 0.8, 0.9),
        exponent: 250.0,
        transmission: 0.75,
        ..Material::DEFAULT
    };
    assert_eq!(glass, expected);
    assert_eq!(plain, Material::matte(DVec3::new(0.4, 0.5, 0.6)), "k_a follows k_d");
    assert_eq!(veil, Material { transmission: 0.5, ..Material::DEFAULT });
}

#[test]
fn maps_are_read_once_and_what_is_not_there_is_named() {
    let library = "newmtl a\nmap_Kd away.png\nmap_Bump -bm 0.25 away.png\nnewmtl b\nmap_Kd -s 1 1 1 away.png\nnewmtl c\nbump other file.png\n";
    let mesh = with_library(library, &["a", "b", "c"]).unwrap();
    let absent = |name: &str| Texture::Absent(name.to_owned());
    assert_eq!(mesh.textures(), [absent("away.png"), absent("other file.png")]);
    let maps: Vec<_> = materials(&mesh).iter().map(|m| (m.texture, m.bump, m.bump_height)).collect();
    assert_eq!(maps, [(Some(0), Some(0), 0.25), (Some(0), None, 0.0), (None, Some(1), 1.0)]);
}

#[test]
fn faults_in_a_library_name_line_key_and_range() {
    for (library, fragments) in [
        ("Ks 1 1 1\n", ["a.mtl:1: Ks: `no material`", "after `newmtl NAME`"]),
        ("newmtl a\nKs 1 2 1\n", ["a.mtl:2: Ks g: `2`", "from 0 to 1"]),
        ("newmtl a\nNs -1\n", ["a.mtl:2: Ns: `-1`", "from 0 to 1000000"]),
        ("newmtl a\nd\n", ["a.mtl:2: d: ``", "from 0 to 1"]),
        ("newmtl a\nTr nan\n", ["a.mtl:2: Tr: `nan`", "from 0 to 1"]),
        ("newmtl a\nKe 1 1 x\n", ["a.mtl:2: Ke b: `x`", "a number"]),
        ("newmtl a\nmap_bump -bm big a.png\n", ["a.mtl:2: -bm: `big`", "a number"]),
    ] {
        let message = with_library(library, &["a"]).unwrap_err();
        assert!(fragments.iter().all(|fragment| message.contains(fragment)), "{library:?}: {message}");
    }
}

#[test]
fn a_map_that_is_no_picture_is_refused() {
    let (dir, path) = file("a.obj", format!("mtllib a.mtl\n{SQUARE}f 1 2 3\n"));
    fs::write(dir.path().join("a.mtl"), "newmtl a\nmap_Kd a.png\n").unwrap();
    fs::write(dir.path().join("a.png"), "no picture").unwrap();
    let message = Mesh::read(&path).unwrap_err().to_string();
    assert!(message.contains("a.png: texture") && message.contains("PNG or JPEG"), "{message}");
}

#[test]
fn obj_corners_bring_texture_normals_and_groups() {
    let text = format!(
        "{SQUARE}vt 0.25 0.5\nvt 1 0 0\nvt 0.5\nvn 0 0 2\nvn 0 0 0\ns 3\nf 1/1/1 2/2/1 3/-1/1\ns off\nf 1//1 2//1 3//2\nf 1/1 2/2 3\n"
    );
    let mesh = read("a.obj", text);
    assert_eq!(front(&mesh, 0), DVec3::Z);
    let [whole, flat, half] = mesh.face_data() else { panic!("three faces") };
    assert_eq!(whole.texture, Some([DVec2::new(0.25, 0.5), DVec2::new(1.0, 0.0), DVec2::new(0.5, 0.0)]));
    assert_eq!((whole.normals, whole.group), (Some([DVec3::Z; 3]), 3));
    assert_eq!((flat.texture, flat.normals, flat.group), (None, None, 0), "one normal has no direction");
    assert_eq!((half.texture, half.normals), (None, None), "one corner has no texture");
    for (text, fragment) in [
        ("f 1/1 2 3", "no texture coordinates come before"),
        ("f 1//4 2 3", "no normals come before"),
        ("vn 0 1", "vn z"),
        ("vt x", "vt u"),
        ("s smooth", "`off` or an integer"),
    ] {
        let message = common::refusal("a.obj", format!("{SQUARE}{text}\n"));
        assert!(message.contains("a.obj:5:") && message.contains(fragment), "{message}");
    }
}
