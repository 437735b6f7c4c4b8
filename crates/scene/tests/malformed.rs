//! Malformed OBJ, MTL and glTF files: each is refused with file, line or key, value and what is permitted.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::common::file;
use edgewalk_scene::{Mesh, Scene};
use std::fs;
use std::path::Path;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Checks that each message names its file, quotes the value and says what is permitted.
fn refused(cases: &[(String, &str)], name: &str, read: impl Fn(&str) -> Result<Mesh, String>) {
    let mut count = 0;
    for (text, expected) in cases {
        let message = read(text).map(|_| "accepted").expect_err(text);
        for part in [name, expected, "`", ": permitted: "] {
            assert!(message.contains(part), "{text:?}: {message:?} lacks {part:?}");
        }
        count += 1;
    }
    println!("{name}: refused {count} / {}", cases.len());
    assert!(count >= 25, "{count}");
}

#[test]
fn obj_fault_names_line_and_range() {
    let square = |line: &str| format!("{SQUARE}{line}\n");
    let cases: Vec<(String, &str)> = [
        (square("f 1 2 5"), "a.obj:5: f corner: `5`: permitted: 1 to 4 or -4 to -1, the positions"),
        (square("f 0 1 2"), "a.obj:5: f corner: `0`"),
        (square("f -5 1 2"), "a.obj:5: f corner: `-5`"),
        (
            square("f 1 2"),
            "a.obj:5: f: `2 corners`: permitted: 3 to 16384 corners; cut the face into smaller ones",
        ),
        (square("f"), "a.obj:5: f: `0 corners`"),
        (square("f 1 2 3.5"), "a.obj:5: f corner: `3.5`"),
        (square("f 1 2 1e2"), "a.obj:5: f corner: `1e2`"),
        (square("f 1/ 2/ /3"), "a.obj:5: f corner: `/3`"),
        (square("f 1/1 2 3"), "a.obj:5: f corner: `1/1`: permitted: none, as no texture coordinates come"),
        (square("f 1//1 2 3"), "a.obj:5: f corner: `1//1`: permitted: none, as no normals come before"),
        (
            square("vn 0 0 1\nf 1//2 2 3"),
            "a.obj:6: f corner: `1//2`: permitted: 1 to 1 or -1 to -1, the normals",
        ),
        (square("f 1 2 99999999999999999999"), "a.obj:5: f corner: `99999999999999999999`"),
        ("f 1 2 3\n".into(), "a.obj:1: f corner: `1`: permitted: none, as no positions come before"),
        ("v 0 0\n".into(), "a.obj:1: v z: ``: permitted: a number from -1000000000000 to 1000000000000"),
        ("v\n".into(), "a.obj:1: v x: ``"),
        ("\nv 0 nan 0".into(), "a.obj:2: v y: `nan`"),
        ("v inf 0 0".into(), "a.obj:1: v x: `inf`"),
        ("v 0 0 1e13".into(), "a.obj:1: v z: `1e13`"),
        ("v 0,5 0 0".into(), "a.obj:1: v x: `0,5`"),
        ("v 1 \\\n2 \\\n x\n".into(), "a.obj:1: v z: `x`"),
        (square("v 1 \\\n2 3\nv 1 2"), "a.obj:7: v z: ``"),
        ("vt x\n".into(), "a.obj:1: vt u: `x`: permitted: a number from -1000000 to 1000000"),
        ("vt 0 1e7\n".into(), "a.obj:1: vt v: `1e7`"),
        ("vn 0 1\n".into(), "a.obj:1: vn z: ``"),
        (square("s smooth"), "a.obj:5: s: `smooth`: permitted: `off` or an integer"),
        (square("s -1"), "a.obj:5: s: `-1`"),
        (square("mtllib"), "a.obj:5: mtllib: ``: permitted: the name of a file"),
        (String::new(), "a.obj: faces: `0 triangles`: permitted: at least one"),
        (SQUARE.into(), "a.obj: faces: `0 triangles`"),
        ("v 1 1 1\nv 1 1 1\nf 1 2 1".into(), "a.obj: size: `0`: permitted: at least"),
    ]
    .into();
    refused(&cases, "a.obj", |text| {
        let (_folder, path) = file("a.obj", text);
        Mesh::read(&path).map_err(|error| error.to_string())
    });
}

#[test]
fn mtl_fault_names_line_and_range() {
    let own = |line: &str| format!("newmtl a\n{line}\n");
    let cases: Vec<(String, &str)> = [
        ("Ks 1 1 1\n".into(), "a.mtl:1: Ks: `no material`: permitted: after `newmtl NAME`"),
        ("# c\nmap_Kd a.png\n".into(), "a.mtl:2: map_Kd: `no material`"),
        (own("Ke -1 0 0"), "a.mtl:2: Ke r: `-1`: permitted: a number from 0 to 1000000"),
        (own("Ke 0 1e7 0"), "a.mtl:2: Ke g: `1e7`"),
        (own("Ke 1 1 x"), "a.mtl:2: Ke b: `x`"),
        (own("Ka 1 1"), "a.mtl:2: Ka b: ``: permitted: a number from 0 to 1"),
        (own("Ka"), "a.mtl:2: Ka r: ``"),
        (own("Ka spectral file.rfl"), "a.mtl:2: Ka r: `spectral`"),
        (own("Kd 1.5 0 0"), "a.mtl:2: Kd r: `1.5`"),
        (own("Kd 0 nan 0"), "a.mtl:2: Kd g: `nan`"),
        (own("Kd xyz 1 1 1"), "a.mtl:2: Kd r: `xyz`"),
        (own("Kd 0.5 \\\n 0.5 \\\n 2"), "a.mtl:2: Kd b: `2`"),
        (own("Ks 1 2 1"), "a.mtl:2: Ks g: `2`"),
        (own("Ks 0 0 -0.1"), "a.mtl:2: Ks b: `-0.1`"),
        (own("Ns -1"), "a.mtl:2: Ns: `-1`: permitted: a number from 0 to 1000000"),
        (own("Ns inf"), "a.mtl:2: Ns: `inf`"),
        (own("Ns"), "a.mtl:2: Ns: ``"),
        (own("d"), "a.mtl:2: d: ``: permitted: a number from 0 to 1"),
        (own("d -halo 0.5"), "a.mtl:2: d: `-halo`"),
        (own("d 1.1"), "a.mtl:2: d: `1.1`"),
        (own("Tr nan"), "a.mtl:2: Tr: `nan`"),
        (own("Tr -0.5"), "a.mtl:2: Tr: `-0.5`"),
        (own("map_Kd"), "a.mtl:2: map_Kd: ``: permitted: the name of a file"),
        (own("map_Kd folder"), "folder: kind of file: `a folder`: permitted: a regular file"),
        (own("map_Kd text.png"), "text.png: texture: `"),
        (own("map_bump -bm big a.png"), "a.mtl:2: -bm: `big`: permitted: a number from -1000000 to 1000000"),
        (own("bump -bm"), "a.mtl:2: -bm: ``"),
    ]
    .into();
    refused(&cases, "", |text| {
        let (folder, path) = file("a.obj", format!("mtllib a.mtl\n{SQUARE}f 1 2 3\n"));
        fs::create_dir(folder.path().join("folder")).unwrap();
        fs::write(folder.path().join("text.png"), "no picture").unwrap();
        fs::write(folder.path().join("a.mtl"), text).unwrap();
        Mesh::read(&path).map_err(|error| error.to_string())
    });
}

/// A triangle in base64, with a picture that is missing in the file as it stands.
const TRIANGLE: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":"away.png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA","byteLength":36}]}"#;

#[test]
fn gltf_fault_names_part_and_range() {
    let data = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let image = r#"{"uri":"away.png"}"#;
    let changes = [
        (r#""version":"2.0""#, r#""version":"1.0""#, "asset.version: `1.0`: permitted: 2.0; export"),
        (r#""version":"2.0""#, r#""version":"""#, "asset.version: ``: permitted: 2.0"),
        (r#""version":"2.0""#, r#""version":"2.1","minVersion":"2.1""#, "asset.minVersion: `2.1`"),
        (r#""version":"2.0""#, r#""version":2"#, "a.gltf:1: JSON: `"),
        (image, "{}", "image 0: `no source`: permitted: `uri` or `bufferView`"),
        (image, r#"{"bufferView":0}"#, "image 0: texture: `"),
        (image, r#"{"bufferView":5}"#, "images[0].bufferView: `Index out of bounds`"),
        (image, r#"{"uri":"%zz.png"}"#, "image 0: `%zz.png`: permitted: UTF-8, with % only before"),
        (image, r#"{"uri":"http://x.org/a.png"}"#, "image 0: `http://x.org/a.png`: permitted: the name"),
        (image, r#"{"uri":"data:image/png;base64,!!"}"#, "image 0: `data:image/png;base64,!!`"),
        (image, r#"{"uri":"data:image/png;base64,AAAA"}"#, "image 0: texture: `"),
        (image, r#"{"uri":""}"#, "image 0: ``: permitted: the name of a file"),
        (r#""source":0"#, r#""source":1"#, "textures[0].source: `Index out of bounds`"),
        (r#""index":0"#, r#""index":0,"texCoord":7"#, "primitive 0 texCoord: `7`"),
        (data, "/dev/zero", "/dev/zero: kind of file: `a device or a socket`"),
        (data, "folder", "folder: kind of file: `a folder`: permitted: a regular file"),
        (data, "short.bin", "buffer 0: `10 bytes`: permitted: the 36 bytes that its byteLength declares"),
        (data, "%ff.bin", "buffer 0: `%ff.bin`: permitted: UTF-8"),
        (data, "ftp:a.bin", "buffer 0: `ftp:a.bin`: permitted: the name of a file beside this one"),
        (data, "data:,abc", "buffer 0: `data:,abc`: permitted: `data:` TYPE `;base64,`"),
        (data, "data:;base64,AAAA", "buffer 0: `3 bytes`: permitted: the 36 bytes"),
        (r#","byteLength":36}]}"#, r#","byteLength":9e99}]}"#, "JSON: `"),
        (r#","byteLength":36}]}"#, r#","byteLength":99999999999}]}"#, "buffer 0: `byteLength 99999999999`"),
        (r#""count":3"#, r#""count":4"#, "POSITION: `accessor 0: 4 of 12 bytes"),
        (r#""count":3"#, r#""count":0"#, "POSITION: `accessor 0: 0 of 12 bytes"),
        (
            r#""POSITION":0"#,
            r#""POSITION":1"#,
            "attribute of a primitive: `1`: permitted: an accessor from 0 to 0",
        ),
        (r#""mesh":0"#, r#""mesh":0,"children":[0]"#, "node 0: `two parents`: permitted: a tree of nodes"),
        (r#""mesh":0"#, r#""mesh":1"#, "nodes[0].mesh: `Index out of bounds`"),
        (r#""material":0"#, r#""material":-1"#, "JSON: `"),
        (
            r#""asset""#,
            r#""extensionsRequired":["KHR_draco_mesh_compression"],"asset""#,
            "extensionsRequired[0]",
        ),
    ];
    let cases: Vec<(String, &str)> = changes
        .into_iter()
        .map(|(from, to, expected)| {
            assert_eq!(TRIANGLE.matches(from).count(), 1, "{from}");
            (TRIANGLE.replace(from, to), expected)
        })
        .collect();
    let read = |text: &str| {
        let (folder, path) = file("a.gltf", text);
        fs::create_dir(folder.path().join("folder")).unwrap();
        fs::write(folder.path().join("short.bin"), [0; 10]).unwrap();
        Mesh::read(&path).map_err(|error| error.to_string())
    };
    assert_eq!(read(TRIANGLE).unwrap().faces().len(), 1);
    refused(&cases, "", read);
}

/// Nothing of a pipe or a device is read: it need not end.
#[test]
fn only_regular_files_are_read() {
    let (folder, path) = file("a.obj", format!("mtllib lib.mtl\n{SQUARE}f 1 2 3\n"));
    let beside = |name: &str| folder.path().join(name);
    let link = |name: &str| std::os::unix::fs::symlink("/dev/zero", beside(name)).unwrap();
    let pipe = std::process::Command::new("mkfifo").arg(beside("lib.mtl")).status().unwrap();
    assert!(pipe.success());
    let refusal = |path: &Path| Mesh::read(path).unwrap_err().to_string();
    assert!(
        refusal(&path).contains("lib.mtl: kind of file: `a pipe`: permitted: a regular file"),
        "{}",
        refusal(&path)
    );
    for name in ["zero.glb", "zero.gltf", "zero.obj"] {
        link(name);
        assert!(
            refusal(&beside(name)).contains(&format!("{name}: kind of file")),
            "{}",
            refusal(&beside(name))
        );
    }
    link("zero.toml");
    let scene = Scene::open(beside("zero.toml").to_str().unwrap()).unwrap_err().to_string();
    assert!(scene.contains("zero.toml: kind of file"), "{scene}");
    fs::write(beside("a.toml"), "[[object]]\nmesh = \"pipe.obj\"\n").unwrap();
    fs::rename(beside("lib.mtl"), beside("pipe.obj")).unwrap();
    let mesh = Scene::open(beside("a.toml").to_str().unwrap()).unwrap_err().to_string();
    assert!(mesh.contains("pipe.obj: kind of file: `a pipe`"), "{mesh}");
}

/// A view lies in the bytes that its buffer declares, however long the file is.
#[test]
fn gltf_buffer_ends_where_it_says() {
    let data = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let text = TRIANGLE
        .replace(data, "long.bin")
        .replace("\"buffer\":0,\"byteLength\":36", "\"buffer\":0,\"byteLength\":48");
    let (folder, path) = file("a.gltf", text.replace("\"count\":3", "\"count\":4"));
    fs::write(folder.path().join("long.bin"), [1; 100]).unwrap();
    let message = Mesh::read(&path).unwrap_err().to_string();
    assert!(message.contains("POSITION: `accessor 0: 4 of 12 bytes"), "{message}");
}

/// A comment ends with its line, though a backslash ends it.
#[test]
fn obj_backslash_joins_lines_of_statements() {
    let joined = "# C:\\\nv 0 0 0\nv 1 \\\n0 0\r\nv 1 1 \\\r\n 0\nf 1 \\\n2 \\\n3\n";
    let (_folder, path) = file("a.obj", joined);
    let mesh = Mesh::read(&path).unwrap();
    assert_eq!((mesh.positions().len(), mesh.faces().len()), (3, 1));
    assert_eq!(mesh.positions()[2], glam::DVec3::new(1.0, 1.0, 0.0));
}

/// A view without `mimeType`, as many programs write it, is a picture all the same.
#[test]
fn gltf_picture_in_a_view_needs_no_type() {
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_pixel(1, 1, image::Rgb([255, 0, 51]))
        .write_to(&mut png, image::ImageFormat::Png)
        .unwrap();
    let png = png.into_inner();
    let (folder, path) = file(
        "a.gltf",
        TRIANGLE
            .replace(r#"{"uri":"away.png"}"#, r#"{"bufferView":1}"#)
            .replace(
                "36}],\n\"buffers\":[",
                &format!("36}},{{\"buffer\":1,\"byteLength\":{}}}],\n\"buffers\":[", png.len()),
            )
            .replace("36}]}", &format!("36}},{{\"uri\":\"b%20c.png\",\"byteLength\":{}}}]}}", png.len())),
    );
    fs::write(folder.path().join("b c.png"), png).unwrap();
    let mesh = Mesh::read(&path).unwrap();
    let color = mesh.textures()[0].at(glam::DVec2::ZERO);
    assert!(color.distance(glam::DVec3::new(1.0, 0.0, 0.2)) < 1e-6, "{color}");
}
