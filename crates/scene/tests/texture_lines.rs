//! The lines `texture` and `UV` of a triangle file: what they say, what is refused with which words, and what pixels of a scene see.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_scene::{Frame, PixelMethod, Scene, triangle_file};
use glam::{DVec2, DVec3};
use std::path::Path;

const T: &str = "T 0 0 0 1 1 1 0  9 0 0.5 1 1 1 0  0 9 1 1 1 1 0";
const N: &str = "N 0 0 1  0.6 0 0.8  0 -0.6 0.8";
const UV: &str = "UV 0 1  2.5 1  -3 -0.25";
const HEADER: &str = "size 9 9\nmode phong\nview 0 0 2\nmaterial 0.1 0.5 0.4 20\n";
const TEXTURE: &str = "texture 2 1 ff8000 0000ffff8000";

fn parse(text: &str) -> Frame {
    triangle_file::parse("a.tri", text.as_bytes()).unwrap()
}

#[test]
fn a_texture_is_of_the_material_before_it() {
    let second = "material 0 1 0 1\n";
    let third = "material 0 1 0 1\ntexture 1 1 010203\n";
    let text = format!(
        "{HEADER}{TEXTURE} # of the first\n{T}\n{UV}\n{N}\n{T}\n{N}\n\n{UV}\n{second}{T}\n{N}\n{third}{T}\n{N}\n{UV}\n"
    );
    let shading = parse(&text).shading.unwrap();
    let textures: Vec<Option<u32>> = shading.materials.iter().map(|material| material.texture).collect();
    assert_eq!(textures, [Some(0), None, Some(1)]);
    assert_eq!((shading.textures[0].sides(), shading.textures[1].sides()), ([2, 1], [1, 1]));
    assert_eq!(shading.textures[0].texels(), [[0xffff, 0x8080, 0], [0, 0xffff, 0x8000]]);
    assert_eq!(shading.textures[1].texels(), [[0x0101, 0x0202, 0x0303]]);
    let places = [DVec2::new(0.0, 1.0), DVec2::new(2.5, 1.0), DVec2::new(-3.0, -0.25)];
    for (triangle, expected) in shading.triangles.iter().zip([places, places, [DVec2::ZERO; 3], places]) {
        assert_eq!(triangle.texture, expected);
    }
    // A texture of a material that no triangle has is none.
    let unused = format!("{HEADER}{TEXTURE}\nmaterial 0 1 0 1\n{T}\n{N}\n");
    let shading = parse(&unused).shading.unwrap();
    assert_eq!((shading.materials[0].texture, shading.textures.len()), (None, 0));
}

#[test]
fn malformed_textures_name_place_and_remedy() {
    let with = |line: &str| format!("{HEADER}{line}\n{T}\n{N}\n{UV}");
    let behind = |lines: &str| format!("{HEADER}{TEXTURE}\n{T}\n{lines}");
    let cases: [(String, &[&str]); 25] = [
        (with("texture"), &["a.tri:5: texture W: ``", "an integer from 1 to 1024"]),
        (with("texture 2"), &["a.tri:5: texture H: ``", "an integer from 1 to 1024"]),
        (with("texture 0 1"), &["texture W: `0`", "from 1 to 1024"]),
        (with("texture 1 1025"), &["texture H: `1025`", "from 1 to 1024"]),
        (with("texture wood.png"), &["texture W: `wood.png`", "an integer"]),
        (
            with("texture 2 1 ff8000"),
            &["a.tri:5: texture: `1 given`", "2 texels behind W and H", "1 lines of 2"],
        ),
        (with("texture 2 1 ff8000 0 0"), &["texture texel 2: `0`", "6 hex digits rrggbb"]),
        (with("texture 1 1 ff8000 ff8000"), &["texture: `2 given`", "1 texels"]),
        (with("texture 1 1 ff80zz"), &["texture texel 1: `ff80zz`", "or 12 of them"]),
        (with("texture 1 1 ff8000f"), &["texture texel 1: `ff8000f`"]),
        (with("texture 1 1 +f8000"), &["texture texel 1: `+f8000`"]),
        (with("txture 1 1 ff8000"), &["did you mean `texture`?"]),
        (with(&format!("{TEXTURE}\n{TEXTURE}")), &["a.tri:6:", "`texture`", "once behind a line `material"]),
        (
            format!("size 9 9\nmode phong\nview 0 0 1\n{TEXTURE}"),
            &["a.tri:4:", "`texture`", "behind a line `material ka kd ks n`"],
        ),
        (behind(&format!("{N}\n{UV}\n{TEXTURE}")), &["a.tri:9:", "`texture`", "before its first triangle"]),
        (
            format!("size 9 9\nmaterial 0 0 0 1\n{TEXTURE}\n{T}"),
            &["a.tri:2:", "`material`", "only with `mode phong`"],
        ),
        (format!("size 9 9\n{T}\n{TEXTURE}"), &["a.tri:3:", "`texture`", "only with `mode phong`"]),
        (format!("size 9 9\n{T}\n{UV}"), &["a.tri:3:", "`UV`", "only with `mode phong`"]),
        (format!("{HEADER}{T}\n{N}\n{UV}"), &["a.tri:7:", "`UV`", "of a material with a `texture`"]),
        (behind(&format!("{N}\n{UV}\n{UV}")), &["a.tri:9:", "`UV`", "once, behind a triangle"]),
        (
            behind(&format!("{N}\n{T}")),
            &["a.tri:8: UV: `T`", "of the triangle in line 6 is missing", "6 values, u v"],
        ),
        (behind(&format!("{N}\nmaterial 0 0 0 1")), &["a.tri:8: UV: `material`", "is missing"]),
        (behind(N), &["a.tri:8: UV: `end of file`", "line 6 is missing"]),
        (behind(&format!("{N}\nUV 0 0 1 0 0")), &["a.tri:8: UV: `5 given`", "6 values"]),
        (behind(&format!("{N}\nUV 0 0 1 0 0 1e7")), &["UV vertex 3 v: `1e7`", "from -1000000 to 1000000"]),
    ];
    for (text, words) in &cases {
        let error = triangle_file::parse("a.tri", text.as_bytes()).unwrap_err().to_string();
        for word in *words {
            assert!(error.contains(word), "{text:?}: {word:?} is not in {error:?}");
        }
    }
}

#[test]
fn a_picture_too_large_for_a_line_is_not_written() {
    let mut frame = parse(&format!("{HEADER}{TEXTURE}\n{T}\n{N}\n{UV}"));
    let image = edgewalk_scene::Image::of(1025, 1, vec![[0; 3]; 1025]).unwrap();
    frame.shading.as_mut().unwrap().textures = vec![image.into()];
    let error = triangle_file::write(&frame, std::io::sink()).unwrap_err().to_string();
    assert!(error.contains("1025 x 1 texels") && error.contains("at most 1024"), "{error}");
}

#[test]
fn pixels_of_a_scene_see_nearest_texels_and_vertices_other_textures() {
    let scene = |texels: &str| {
        let text = format!(
            "[[material]]\nname = \"m\"\ndiffuse = [0.8, 0.4, 0.2]\nchecker = 2\n{texels}\n[[object]]\npositions = [[0, 0, 0], [1, 0, 0], \
             [1, 1, 0]]\nfaces = [[0, 1, 2]]\nuv = [[0, 0], [1, 0], [1, 0.75]]\nmaterial = \"m\"\n"
        );
        Scene::parse(Path::new("a.toml"), &text)
    };
    let frame = |texels: &str| {
        let scene = scene(texels).unwrap();
        scene.pixel_frame(&scene.surface(64, 64, 8191.0), PixelMethod::FastPhong)
    };
    let (near, smooth) = (frame("texels = \"nearest\""), frame(""));
    let [of_near, of_smooth] = [&near, &smooth].map(|frame| frame.shading.as_ref().unwrap());
    assert_eq!((of_near.materials[0].texture, of_smooth.materials[0].texture), (Some(0), None));
    assert_eq!((of_near.textures[0].sides(), of_smooth.textures.len()), ([2, 2], 0));
    let color = |frame: &Frame| frame.triangles[0].0.map(|v| DVec3::new(v.r, v.g, v.b));
    assert!(color(&near).iter().all(|color| color.distance(DVec3::new(1.0, 0.5, 0.25)) < 1e-12));
    assert!(color(&smooth)[0] != color(&smooth)[2], "squares of both colours");
    let mut places = of_near.triangles[0].texture.map(|place| place.to_array());
    places.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(places, [[0.0, 0.0], [1.0, 0.0], [1.0, 0.75]]);
    let many = scene("texels = \"nearest\"\nwaves = 3").unwrap();
    assert_eq!(many.mesh.textures().len(), 2);
    let error = |checker: &str, texels: &str| {
        let text =
            format!("[[material]]\nname = \"m\"\n{checker}\n{texels}\n[[object]]\nbuiltin = \"sphere\"\n");
        Scene::parse(Path::new("a.toml"), &text).unwrap_err().to_string()
    };
    let refused = error("", "texels = \"nearest\"");
    assert!(refused.contains("beside `texture`, `checker`, `gloss`, `bump` or `waves`"), "{refused}");
    let refused = error("checker = 5000", "texels = \"nearest\"");
    assert!(refused.contains("at most 4096"), "{refused}");
}
