//! Every statement of a file that changes a picture, with values that no other statement has.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::common::file;
use edgewalk_scene::{
    Attenuation, Blending, DepthFunc, Frame, Light, Material, Mesh, PixelMethod, Scene, Specular, Texture,
    Vertex, Viewer, triangle_file,
};
use glam::{DMat3, DVec2, DVec3};
use image::{Rgb, RgbImage};
use std::fs;
use std::path::Path;

/// Asserts that two vectors are equal but for rounding.
fn near(found: DVec3, expected: DVec3) {
    assert!(found.distance(expected) < 1e-5, "{found}, not {expected}");
}

/// A picture of one colour.
fn picture(folder: &Path, name: &str, color: [u8; 3]) {
    RgbImage::from_pixel(1, 1, Rgb(color)).save(folder.join(name)).unwrap();
}

/// The mesh of an OBJ with one face and this library.
fn obj(library: &str) -> Mesh {
    let (folder, path) = file(
        "a.obj",
        "mtllib a.mtl\nv 1 2 3\nv 4 2.5 3.5\nv 1.5 7 5\nvt 0.125 0.25\nvt 0.375 0.5\nvt 0.625 0.75\n\
         vn 1 2 2\nvn 2 1 2\nvn 2 2 1\ns 7\nusemtl b\nf 1/2/3 2/3/1 3/1/2\n",
    );
    fs::write(folder.path().join("a.mtl"), library).unwrap();
    picture(folder.path(), "color.png", [255, 0, 51]);
    picture(folder.path(), "height.png", [0, 255, 102]);
    Mesh::read(&path).unwrap()
}

fn material(library: &str) -> Material {
    let mesh = obj(library);
    mesh.materials()[mesh.faces()[0].material as usize]
}

#[test]
fn obj_face_has_its_own_values() {
    let mesh = obj("newmtl b\n");
    let [a, b, c] = mesh.corners(&mesh.faces()[0]);
    assert_eq!(a, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(b, DVec3::new(4.0, 2.5, 3.5));
    assert_eq!(c, DVec3::new(1.5, 7.0, 5.0));
    let data = mesh.face_data()[0];
    let places = [(0.375, 0.5), (0.625, 0.75), (0.125, 0.25)].map(|(u, v)| DVec2::new(u, v));
    assert_eq!((data.texture, data.group), (Some(places), 7));
    let expected = [(2.0, 2.0, 1.0), (1.0, 2.0, 2.0), (2.0, 1.0, 2.0)];
    for (normal, (x, y, z)) in data.normals.unwrap().into_iter().zip(expected) {
        near(normal, DVec3::new(x, y, z) / 3.0);
    }
}

/// Each line alone changes one coefficient.
#[test]
fn mtl_line_changes_its_own_coefficient() {
    let plain = Material::DEFAULT;
    let v = DVec3::new;
    let cases = [
        ("Ke 1 2 3", Material { emission: v(1.0, 2.0, 3.0), ..plain }),
        ("Ka 0.1 0.2 0.3", Material { ambient: v(0.1, 0.2, 0.3), ..plain }),
        ("Kd 0.1 0.2 0.3", Material::matte(v(0.1, 0.2, 0.3))),
        (
            "Ka 0.5 0.6 0.7\nKd 0.1 0.2 0.3",
            Material { ambient: v(0.5, 0.6, 0.7), ..Material::matte(v(0.1, 0.2, 0.3)) },
        ),
        ("Ks 0.1 0.2 0.3", Material { specular: v(0.1, 0.2, 0.3), ..plain }),
        ("Ns 12", Material { exponent: 12.0, ..plain }),
        ("d 0.75", Material { transmission: 0.25, ..plain }),
        ("Tr 0.75", Material { transmission: 0.75, ..plain }),
        ("d 0.75\nTr 0.125", Material { transmission: 0.125, ..plain }),
        ("Tr 0.125\nd 0.75", Material { transmission: 0.25, ..plain }),
        ("Ni 1.5\nTf 1 0 0\nillum 3", plain),
    ];
    for (lines, expected) in cases {
        assert_eq!(material(&format!("newmtl a\nNs 99\nnewmtl b\n{lines}\n")), expected, "{lines}");
    }
}

#[test]
fn mtl_map_line_names_its_own_picture() {
    for (line, texture, bump, height) in [
        ("map_Kd color.png", true, false, 0.0),
        ("map_Kd -o 0.5 0.5 color.png", true, false, 0.0),
        ("map_Bump height.png", false, true, 1.0),
        ("map_bump -bm 0.25 height.png", false, true, 0.25),
        ("bump -bm 3 height.png", false, true, 3.0),
    ] {
        let mesh = obj(&format!("newmtl b\n{line}\n"));
        let found = mesh.materials()[mesh.faces()[0].material as usize];
        assert_eq!(
            (found.texture.is_some(), found.bump.is_some(), found.bump_height),
            (texture, bump, height),
            "{line}"
        );
        let color = if texture { DVec3::new(1.0, 0.0, 0.2) } else { DVec3::new(0.0, 1.0, 0.4) };
        near(mesh.textures()[0].at(DVec2::splat(0.5)), color);
    }
}

/// One triangle with two sets of texture coordinates, and two pictures.
fn gltf(material: &str, node: &str) -> Result<Mesh, String> {
    let floats: [f32; 30] = [
        1., 2., 3., 4., 2.5, 3.5, 1.5, 7., 5., // positions
        0.6, 0., 0.8, 0., 0.6, 0.8, 0.8, 0.6, 0., // normals
        0.125, 0.25, 0.375, 0.5, 0.625, 0.75, // coordinates of set 0
        0.5, 0.0625, 0.75, 0.125, 0.25, 0.875, // and of set 1
    ];
    let bytes: Vec<u8> = floats.iter().flat_map(|number| number.to_le_bytes()).collect();
    let accessor = |view, kind| {
        format!(
            r#"{{"bufferView":{view},"componentType":5126,"count":3,"type":"{kind}","min":[1,2,3],"max":[4,7,5]}}"#
        )
    };
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,{node}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TEXCOORD_1":3}},"material":1}}]}}],
        "materials":[{{}},{{{material}}}],"textures":[{{"source":0}},{{"source":1}}],
        "images":[{{"uri":"color.png"}},{{"uri":"two%20words.png"}}],
        "accessors":[{},{},{},{}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":36}},
        {{"buffer":0,"byteOffset":72,"byteLength":24}},{{"buffer":0,"byteOffset":96,"byteLength":24}}],
        "buffers":[{{"uri":"a.bin","byteLength":120}}]}}"#,
        accessor(0, "VEC3"),
        accessor(1, "VEC3"),
        accessor(2, "VEC2"),
        accessor(3, "VEC2"),
    );
    let (folder, path) = file("a.gltf", json);
    fs::write(folder.path().join("a.bin"), bytes).unwrap();
    picture(folder.path(), "color.png", [255, 0, 51]);
    picture(folder.path(), "two words.png", [0, 255, 102]);
    Mesh::read(&path).map_err(|error| error.to_string())
}

#[test]
fn gltf_node_scales_turns_and_moves() {
    let half = 0.5f64.sqrt();
    let placed = format!(r#""scale":[2,3,4],"rotation":[0,0,{half},{half}],"translation":[10,20,30]"#);
    // A quarter turn about z takes (x, y) to (-y, x). The matrix runs column by column.
    let matrix = r#""matrix":[0,2,0,0, -3,0,0,0, 0,0,4,0, 10,20,30,1]"#;
    for node in [placed.as_str(), matrix] {
        let mesh = gltf("", node).unwrap();
        let [a, b, c] = mesh.corners(&mesh.faces()[0]);
        near(a, DVec3::new(4.0, 22.0, 42.0));
        near(b, DVec3::new(2.5, 28.0, 44.0));
        near(c, DVec3::new(-11.0, 23.0, 50.0));
        let normal = mesh.face_data()[0].normals.unwrap()[2];
        near(normal, DVec3::new(-0.6 / 3.0, 0.8 / 2.0, 0.0).normalize());
    }
}

#[test]
fn gltf_material_value_has_its_own_place() {
    let mesh = gltf(
        r#""pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.75,0.375],"metallicFactor":0.25,"roughnessFactor":0.75,
        "baseColorTexture":{"index":1,"texCoord":1}},"emissiveFactor":[0.125,0.25,0.5],"alphaMode":"BLEND""#,
        r#""name":"node""#,
    )
    .unwrap();
    let material = mesh.materials()[mesh.faces()[0].material as usize];
    let base = DVec3::new(0.5, 0.25, 0.75);
    assert_eq!((material.diffuse, material.ambient), (base, base));
    near(material.specular, (DVec3::splat(0.04) + (base - 0.04) * 0.25) * 0.25);
    assert!((material.exponent - (2.0 / 0.75f64.powi(4) - 2.0)).abs() < 1e-9, "{}", material.exponent);
    assert_eq!((material.emission, material.transmission), (DVec3::new(0.125, 0.25, 0.5), 0.625));
    near(mesh.textures()[material.texture.unwrap() as usize].at(DVec2::ZERO), DVec3::new(0.0, 1.0, 0.4));
    // v runs down in the file.
    let places = [(0.5, 0.9375), (0.75, 0.875), (0.25, 0.125)].map(|(u, v)| DVec2::new(u, v));
    assert_eq!(mesh.face_data()[0].texture, Some(places));
    let opaque =
        gltf(r#""pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.375]}"#, r#""name":"node""#).unwrap();
    assert_eq!(opaque.materials()[0].transmission, 0.0, "alpha counts where the mode is BLEND");
    assert_eq!(opaque.face_data()[0].texture.unwrap()[0], DVec2::new(0.125, 0.75), "set 0 without a picture");
}

#[test]
fn gltf_pictures_that_would_be_others_are_refused() {
    let with = |texture: &str| {
        let material = format!(r#""pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,{texture}}}}}"#);
        gltf(&material, r#""name":"node""#).unwrap_err()
    };
    let absent = with(r#""texCoord":7"#);
    assert!(absent.contains("a.gltf: node 0 primitive 0 texCoord: `7`: permitted: a set"), "{absent}");
    let turned = with(r#""extensions":{"KHR_texture_transform":{"scale":[2,2]}}"#);
    let expected =
        "a.gltf: material 1 baseColorTexture: `KHR_texture_transform`: permitted: texture coordinates as";
    assert!(turned.contains(expected), "{turned}");
}

#[test]
fn scene_key_has_its_own_place() {
    let (_folder, path) = file(
        "a.toml",
        r#"
        ambient = [0.1, 0.2, 0.3]
        background = [0.4, 0.5, 0.6]
        specular = "blinn"
        [camera]
        eye = [1, 2, 3]
        target = [4, 5, 7]
        up = [0, 3, 4]
        angle = 50
        near = 0.5
        far = 70
        [[material]]
        name = "other"
        [[material]]
        name = "own"
        emission = [0.01, 0.02, 0.03]
        ambient = [0.11, 0.12, 0.13]
        diffuse = [0.21, 0.22, 0.23]
        specular = [0.31, 0.32, 0.33]
        exponent = 44
        transmission = 0.55
        checker = 6
        colors = [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]
        bump_height = 0.7
        gloss_checker = 5
        waves = 9
        [[object]]
        positions = [[1, 2, 3], [4, 2.5, 3.5], [1.5, 7, 5]]
        faces = [[0, 1, 2]]
        uv = [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]
        material = "own"
        scale = [2, 3, 4]
        rotate = [30, 40, 50]
        translate = [10, 20, 30]
        [[light]]
        kind = "flood"
        position = [1, 2, 3]
        axis = [0, 3, 4]
        cone = 25
        exponent = 6
        intensity = [0.7, 0.8, 0.9]
        attenuation = [0.1, 0.2, 0.3]
        "#,
    );
    let scene = Scene::open(path.to_str().unwrap()).unwrap();
    assert_eq!((scene.ambient, scene.background), (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.4, 0.5, 0.6)));
    assert_eq!(scene.specular, Specular::Blinn);
    let camera = &scene.camera;
    assert_eq!((camera.eye, camera.target), (DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 7.0)));
    near(camera.up, DVec3::new(0.0, 0.6, 0.8));
    assert_eq!((camera.angle, camera.near, camera.far), (50f64.to_radians(), 0.5, 70.0));
    let material = scene.mesh.materials()[scene.mesh.faces()[0].material as usize];
    let expected = Material {
        emission: DVec3::new(0.01, 0.02, 0.03),
        ambient: DVec3::new(0.11, 0.12, 0.13),
        diffuse: DVec3::new(0.21, 0.22, 0.23),
        specular: DVec3::new(0.31, 0.32, 0.33),
        exponent: 44.0,
        transmission: 0.55,
        texture: Some(0),
        gloss: Some(1),
        bump: Some(2),
        bump_height: 0.7,
    };
    assert_eq!(material, expected);
    let colors = [DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.4, 0.5, 0.6)];
    let gloss = Texture::Checker { squares: 5, colors: [DVec3::ONE, DVec3::splat(0.25)] };
    let pictures = [Texture::Checker { squares: 6, colors }, gloss, Texture::Waves { count: 9 }];
    assert_eq!(scene.mesh.textures(), pictures);
    let places = [(0.1, 0.2), (0.3, 0.4), (0.5, 0.6)].map(|(u, v)| DVec2::new(u, v));
    assert_eq!(scene.mesh.face_data()[0].texture, Some(places));
    let [x, y, z] = [30f64, 40.0, 50.0].map(f64::to_radians);
    // About the fixed z axis, then y, then x.
    let turn = DMat3::from_rotation_x(x) * DMat3::from_rotation_y(y) * DMat3::from_rotation_z(z);
    let expected = turn * DVec3::new(2.0, 6.0, 12.0) + DVec3::new(10.0, 20.0, 30.0);
    near(scene.mesh.corners(&scene.mesh.faces()[0])[0], expected);
    let Light::Flood { position, axis, cone, exponent, intensity, attenuation } = scene.lights[0] else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!((position, intensity), (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.7, 0.8, 0.9)));
    near(axis, DVec3::new(0.0, 0.6, 0.8));
    assert_eq!((cone, exponent), (25f64.to_radians(), 6.0));
    assert_eq!(attenuation, Attenuation { constant: 0.1, linear: 0.2, quadratic: 0.3 });
}

#[test]
fn triangle_vertex_has_seven_values() {
    let text = "size 3 4\nclear 0.1 0.2 0.3\nextra 2\n\
                T 1 2 0.11 0.12 0.13 0.14 0.15  3 4 0.21 0.22 0.23 0.24 0.25  5 7 0.31 0.32 0.33 0.34 0.35\n\
                X 1 2  3 4  5 6\ndepth gequal\ndepth_write 0\nblend add\ncolour_write 0\nlight 0\nclear_depth\n\
                T 1 2 0.11 0.12 0.13 0.14 0.15  3 4 0.21 0.22 0.23 0.24 0.25  5 7 0.31 0.32 0.33 0.34 0.35\nX 1 2 3 4 5 6\n";
    let frame: Frame = triangle_file::parse("a.tri", text.as_bytes()).unwrap();
    assert_eq!((frame.width, frame.height, frame.clear), (3, 4, [0.1, 0.2, 0.3]));
    let vertex = |x, y, tenth: f64, e0, e1| {
        let [z, r, g, b, kt] =
            [0.01, 0.02, 0.03, 0.04, 0.05].map(|part| ((tenth + part) * 100.0).round() / 100.0);
        Vertex { x, y, z, r, g, b, kt, extra: [e0, e1, 0.0, 0.0] }
    };
    let expected =
        [vertex(1.0, 2.0, 0.1, 1.0, 2.0), vertex(3.0, 4.0, 0.2, 3.0, 4.0), vertex(5.0, 7.0, 0.3, 5.0, 6.0)];
    assert_eq!(frame.triangles[0].0, expected);
    let [change] = &frame.changes[..] else { panic!("{:?}", frame.changes) };
    let state = change.state;
    assert_eq!((state.depth, state.depth_write), (Some(DepthFunc::Gequal), false));
    assert_eq!((state.blend, state.color_write, state.light), (Blending::Add, false, 0));
    assert!(change.clear_depth && change.after == 1);
}

#[test]
fn triangle_shading_line_has_its_own_place() {
    let text = "size 3 4\nmode fast-phong\nview 0 3 4\nsun 3 0 4 0.25\nspecular blinn\nmaterial 0.1 0.2 0.3 44\n\
                texture 2 1 123456 789abc\nT 0 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n\
                N 0.6 0 0.8  0 0.6 0.8  0.8 0.6 0\nUV 0.1 0.2  0.3 0.4  0.5 0.6\n";
    let shading = triangle_file::parse("a.tri", text.as_bytes()).unwrap().shading.unwrap();
    assert_eq!((shading.method, shading.specular), (PixelMethod::FastPhong, Specular::Blinn));
    let Viewer::Toward(view) = shading.viewer else { panic!("{:?}", shading.viewer) };
    near(view, DVec3::new(0.0, 0.6, 0.8));
    let Light::Directional { toward, intensity } = shading.lights[0] else { panic!("{:?}", shading.lights) };
    near(toward, DVec3::new(0.6, 0.0, 0.8));
    assert_eq!(intensity, DVec3::splat(0.25));
    let Material { ambient, diffuse, specular, exponent, .. } = shading.materials[0];
    assert_eq!((ambient.x, diffuse.x, specular.x, exponent), (0.1, 0.2, 0.3, 44.0));
    let own = shading.triangles[0];
    let expected = [[0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.8, 0.6, 0.0]];
    own.normals.into_iter().zip(expected).for_each(|(normal, expected)| near(normal, expected.into()));
    assert_eq!(own.texture, [DVec2::new(0.1, 0.2), DVec2::new(0.3, 0.4), DVec2::new(0.5, 0.6)]);
    let image = shading.texture(&own).unwrap();
    let expected = [[0x1212, 0x3434, 0x5656], [0x7878, 0x9a9a, 0xbcbc]];
    assert_eq!((image.sides(), image.texels()), ([2, 1], &expected[..]));
}
