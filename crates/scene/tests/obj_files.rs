//! OBJ files and the choice of reader: what is taken, and what is refused with which words.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::common::{file, front, read, refusal};
use edgewalk_scene::{Mesh, Scene};
use glam::DVec3;
use proptest::prelude::*;
use std::fs;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn obj_polygons_become_fans_and_equal_positions_one() {
    let text = format!(
        "# comment\no part\n{SQUARE}vt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1 4\r\nv -0 0 0 1.0\ng more\nf -5 -3 -1\n"
    );
    let mesh = read("a.obj", text);
    let corners: Vec<_> = mesh.faces().iter().map(|face| face.corners).collect();
    assert_eq!(corners, [[0, 1, 2], [0, 2, 3], [0, 2, 0]], "the fifth position is the first again");
    assert_eq!(mesh.positions().len(), 4);
    assert_eq!(front(&mesh, 0), DVec3::Z);
}

#[test]
fn obj_materials_come_from_the_library() {
    let text = format!(
        "mtllib some colours.mtl\n{SQUARE}f 1 2 3\nusemtl deep red\nf 1 3 4\nusemtl nowhere\nf 2 3 4\n"
    );
    let (dir, path) = file("a.obj", text);
    let without = Mesh::read(&path).unwrap();
    fs::write(dir.path().join("some colours.mtl"), "newmtl deep red\nKa 1 1 1\nKd 0.5 0.1 0\nNs 10\n")
        .unwrap();
    let with = Mesh::read(&path).unwrap();
    let colors = |mesh: &Mesh| -> Vec<[f64; 3]> {
        mesh.faces().iter().map(|face| mesh.materials()[face.material as usize].diffuse.to_array()).collect()
    };
    assert_eq!(colors(&without), [[0.8; 3]; 3]);
    assert_eq!(colors(&with), [[0.8; 3], [0.5, 0.1, 0.0], [0.8; 3]]);
    fs::write(dir.path().join("some colours.mtl"), "newmtl deep red\n\nKd 0.5 0.1\n").unwrap();
    let message = Mesh::read(&path).unwrap_err().to_string();
    assert!(message.contains("some colours.mtl:3: Kd b") && message.contains("from 0 to 1"), "{message}");
}

#[test]
fn malformed_obj_files_name_line_and_remedy() {
    let cases: [(String, &[&str]); 12] = [
        ("".into(), &["a.obj: faces: `0 triangles`", "at least one"]),
        (SQUARE.into(), &["0 triangles"]),
        (format!("{SQUARE}f 1 2 5"), &["a.obj:5: f corner: `5`", "1 to 4 or -4 to -1"]),
        (format!("{SQUARE}f 0 1 2"), &["a.obj:5: f corner: `0`"]),
        (format!("{SQUARE}f -5 1 2"), &["f corner: `-5`"]),
        (format!("{SQUARE}f 1 2"), &["a.obj:5: f: `2 corners`", "3 to 16384 corners"]),
        (format!("{SQUARE}f 1 two 3"), &["f corner: `two`"]),
        (format!("{SQUARE}f 1 2 99999999999999999999"), &["f corner: `99999999999999999999`"]),
        ("\nv 0 nan 0".into(), &["a.obj:2: v y: `nan`", "a number from"]),
        ("v 0 0".into(), &["a.obj:1: v z: ``", "a number"]),
        ("v 0 0 1e13".into(), &["v z: `1e13`", "1000000000000"]),
        ("v 1 1 1\nv 1 1 1\nf 1 2 1".into(), &["a.obj: size: `0`", "at least"]),
    ];
    for (text, fragments) in cases {
        let message = refusal("a.obj", &text);
        for fragment in fragments {
            assert!(message.contains(fragment), "{text:?}: {message:?} lacks {fragment:?}");
        }
    }
}

#[test]
fn other_kinds_of_files_are_refused() {
    for (name, fragments) in [
        ("mesh.ob", ["kind of mesh file: `ob`", "did you mean `obj`?"]),
        ("mesh.gltff", ["obj gltf glb", "did you mean `gltf`?"]),
        ("mesh.stl", ["kind of mesh file: `stl`", "permitted: obj gltf glb"]),
        ("mesh", ["kind of mesh file: ``", "permitted: obj gltf glb"]),
    ] {
        let message = refusal(name, "solid");
        assert!(fragments.iter().all(|fragment| message.contains(fragment)), "{message}");
    }
    for name in ["nowhere.obj", "nowhere.glb"] {
        let message = Scene::open(name).unwrap_err().to_string();
        assert!(message.starts_with(&format!("{name}: cannot be read")), "{message}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_obj_panics(text in "(v|f|usemtl|mtllib|#|/|-|[0-9 .e-]|\\PC|\n){0,60}") {
        let (_dir, path) = file("a.obj", format!("{SQUARE}{text}\nf 1 2 3"));
        let _ = Mesh::read(&path);
    }
}
