//! Objects of a scene file in their places: what comes with each mesh goes with it.
#![allow(clippy::unwrap_used)] // files written here

use edgewalk_scene::Scene;
use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};
use std::fs;
use std::path::Path;

/// A triangle, and its normal at each corner.
const LEANING: &str = "\
mtllib NAME.mtl
v 1 0 0
v 0 1 0
v 0 0 1
vt 0.5 0.5
vn 1 1 1
usemtl skin
f 1/1/1 2/1/1 3/1/1
";

/// An OBJ file whose material has a picture of one colour and a relief.
fn mesh(folder: &Path, name: &str, color: [u8; 3]) {
    let write = |end: &str, text: String| fs::write(folder.join(format!("{name}.{end}")), text).unwrap();
    write("obj", LEANING.replace("NAME", name));
    write("mtl", format!("newmtl skin\nKd 1 1 1\nmap_Kd {name}.png\nmap_Bump -bm 0.25 {name}_relief.png\n"));
    let save = |file: String, color| RgbImage::from_pixel(2, 2, Rgb(color)).save(folder.join(file)).unwrap();
    save(format!("{name}.png"), color);
    save(format!("{name}_relief.png"), color.map(|part| 255 - part));
}

fn open(folder: &Path, text: &str) -> Scene {
    let path = folder.join("scene.toml");
    fs::write(&path, text).unwrap();
    Scene::open(path.to_str().unwrap()).unwrap()
}

#[test]
fn each_object_wears_its_own_pictures() {
    let folder = tempfile::tempdir().unwrap();
    mesh(folder.path(), "red", [255, 0, 0]);
    mesh(folder.path(), "green", [0, 255, 0]);
    // A material of the scene, with a texture of its own, stands between meshes that bring theirs.
    let scene = open(
        folder.path(),
        "[[material]]\nname = \"own\"\ndiffuse = [0, 0, 1]\nchecker = 1\ncolors = [[1, 1, 1], [1, 1, 1]]\n
        [[object]]\nmesh = \"red.obj\"\n
        [[object]]\nmesh = \"red.obj\"\nmaterial = \"own\"\ntranslate = [2, 0, 0]\n
        [[object]]\nmesh = \"green.obj\"\ntranslate = [4, 0, 0]",
    );
    let seen: Vec<_> =
        (0..3).map(|face| scene.mesh.material_at(face, DVec2::splat(0.5)).diffuse.to_array()).collect();
    assert_eq!(seen, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    for (face, expected) in [(0, Some([0.0, 1.0, 1.0])), (1, None), (2, Some([1.0, 0.0, 1.0]))] {
        let material = scene.mesh.materials()[scene.mesh.faces()[face].material as usize];
        let relief = material.bump.map(|place| &scene.mesh.textures()[place as usize]);
        assert_eq!(relief.map(|relief| relief.at(DVec2::splat(0.5)).to_array()), expected, "face {face}");
    }
}

#[test]
fn normals_stay_at_right_angles_however_an_object_is_scaled() {
    let folder = tempfile::tempdir().unwrap();
    mesh(folder.path(), "red", [255, 0, 0]);
    let mut checked = 0;
    for scale in ["1", "2", "[1, 2, 1]", "[3, 0.5, 0.01]"] {
        for rotate in ["[0, 0, 0]", "[30, -75, 200]"] {
            let object = format!("[[object]]\nmesh = \"red.obj\"\nscale = {scale}\nrotate = {rotate}\n");
            let scene = open(folder.path(), &format!("{object}translate = [5, -1, 3]"));
            let [a, b, c] = scene.mesh.corners(&scene.mesh.faces()[0]);
            let normal = (b - a).cross(c - a).normalize();
            let given = scene.mesh.face_data()[0].normals.unwrap();
            for given in given {
                assert!(given.distance(normal) < 1e-12, "scale {scale}: {given}, not {normal}");
                checked += 1;
            }
        }
    }
    // By hand: the plane x + y/2 + z = 1 of a triangle twice as high.
    let scene = open(folder.path(), "[[object]]\nmesh = \"red.obj\"\nscale = [1, 2, 1]");
    let expected = DVec3::new(1.0, 0.5, 1.0).normalize();
    assert!(scene.mesh.face_data()[0].normals.unwrap()[0].distance(expected) < 1e-15);
    assert_eq!(checked, 24);
}
