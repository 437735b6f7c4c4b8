//! Files changed at random places: whatever they say, they are read or refused, and no reader panics.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::common::file;
use edgewalk_scene::{Mesh, Scene, triangle_file};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};

const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0.5\nv 1 1 0\nv 0 1 0\nvt 0 1\nvt 0.5 0.25\nvn 0 0 1\ns 2\nusemtl b\n\
    f 1/1/1 2/2/1 3//1 4\nf -4 -3 -1\ng x\ns off\nf 1 2 \\\n3\n";
const MTL: &str = "newmtl b\nKe 1 2 3\nKa 0.1 0.2 0.3\nKd 0.4 0.5 0.6\nKs 0.7 0.8 0.9\nNs 20\nd 0.5\nTr 0.25\n\
    map_Kd away.png\nmap_Bump -bm 0.5 a.obj\nnewmtl c\nbump away.png\n";
const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"children":[1],"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{"mesh":0,"rotation":[0,0,0,1],"scale":[1,1,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":1},"indices":2,"material":0,"mode":4}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"baseColorTexture":{"index":0,"texCoord":0}},"alphaMode":"BLEND"}],
"textures":[{"source":0}],"images":[{"uri":"away.png"},{"bufferView":0,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2","byteOffset":0},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR","byteOffset":0}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
"buffers":[{"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC","byteLength":39}]}"#;
const TRI: &str = "size 9 8\nmode fast-phong\nview 0 0 1\nsun 0 1 1 0.5\nspecular blinn\nextra 1\nclear 0 0.5 1\nlight 1\n\
    shadow 8 0.01 0.25  1 2 3 4  5 6 7 8  9 10 11 12  13 14 15 16\nL 1 2 0 4 5 1 7 8 0.5 0.5\nmaterial 0.1 0.2 0.3 4\n\
    texture 2 1 123456 789abc\nT 0 0 0 1 1 1 0  9 0 0.5 1 1 1 0  0 9 1 1 1 1 0\nN 0 0 1 0 0 1 0 0 1\nUV 0 0 1 0 0 1\nX 1 2 3\n\
    depth less\nblend add\ncolour_write 0\nclear_depth\n";
const POLYGONS: &str = "size 9 8\nmode flat\nP 4 0 0 0 1 1 1 0  9 0 0.5 1 1 1 0  0 9 1 1 1 1 0 1 1 1 1 1 1 1\n\
    H 3 0 0 0 1 1 1 0  9 0 0.5 1 1 1 0  0 9 1 1 1 1 0\ndepth off\ndepth_write 0\n";
const TOML: &str = "ambient = [0.1, 0.2, 0.3]\nspecular = \"halfway\"\n[camera]\neye = [0, 0, 5]\nangle = 60\n\
    [[material]]\nname = \"m\"\ntexels = \"nearest\"\nchecker = 2\nwaves = 3\n[[object]]\npositions = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]\n\
    faces = [[0, 1, 2]]\nuv = [[0, 0], [1, 0], [1, 1]]\nmaterial = \"m\"\nscale = 2\n[[light]]\nkind = \"flood\"\nposition = [0, 1, 2]\n\
    axis = [0, 0, 1]\ncone = 30\n";

/// What is put in place of a word.
const WORDS: [&str; 16] = [
    "",
    "0",
    "-1",
    "1",
    "65536",
    "4294967295",
    "1e308",
    "-1e-300",
    "nan",
    "inf",
    "\"",
    "{}",
    "[",
    "/",
    "é\u{0}",
    "T",
];

/// Repeatable numbers (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % count.max(1) as u64) as usize
    }

    /// The text with one to three changes: a byte, a word, a line left out or twice, a cut end.
    fn changed(&mut self, text: &[u8]) -> Vec<u8> {
        let mut text = text.to_vec();
        for _ in 0..=self.below(3) {
            if text.is_empty() {
                break;
            }
            let at = self.below(text.len());
            let ends = |byte: &u8, within: &[u8]| within.contains(byte);
            let part = |within: &[u8]| {
                let from =
                    text[..at].iter().rposition(|byte| ends(byte, within)).map_or(0, |place| place + 1);
                let to = text[at..]
                    .iter()
                    .position(|byte| ends(byte, within))
                    .map_or(text.len(), |place| at + place);
                from..to.max(from)
            };
            let (word, line) = (part(b" \n,:[]{}/"), part(b"\n"));
            match self.below(6) {
                0 => text[at] = self.below(256) as u8,
                1 | 2 => drop(text.splice(word, WORDS[self.below(WORDS.len())].bytes())),
                3 => drop(text.drain(line)),
                4 => {
                    let again = text[line.clone()].to_vec();
                    text.splice(line.end..line.end, [b"\n", &again[..]].concat());
                }
                _ => text.truncate(at),
            }
        }
        text
    }
}

/// A GLB of the glTF above: its buffer stays in the text.
fn glb(json: &[u8]) -> Vec<u8> {
    let mut json = json.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = |bytes: usize| (bytes as u32).to_le_bytes();
    [b"glTF\x02\0\0\0", &length(20 + json.len())[..], &length(json.len()), b"JSON", &json].concat()
}

#[test]
fn no_changed_file_panics() {
    const ROUNDS: usize = 800;
    let (folder, path) = file("a.obj", "");
    let beside = |name: &str| folder.path().join(name);
    let mesh = |name: &str, bytes: &[u8]| {
        fs::write(beside(name), bytes).unwrap();
        Mesh::read(&beside(name)).is_ok()
    };
    let triangles = |bytes: &[u8]| triangle_file::parse("a.tri", bytes).is_ok();
    let kinds: [(&str, &[u8], &dyn Fn(&[u8]) -> bool); 7] = [
        ("obj", OBJ.as_bytes(), &|bytes| mesh("a.obj", bytes)),
        ("mtl", MTL.as_bytes(), &|bytes| {
            fs::write(beside("a.mtl"), bytes).unwrap();
            mesh("b.obj", OBJ.as_bytes())
        }),
        ("gltf", GLTF.as_bytes(), &|bytes| mesh("a.gltf", bytes)),
        ("glb", &glb(GLTF.as_bytes()), &|bytes| mesh("a.glb", bytes)),
        ("tri", TRI.as_bytes(), &triangles),
        ("polygons", POLYGONS.as_bytes(), &triangles),
        ("toml", TOML.as_bytes(), &|bytes| {
            String::from_utf8(bytes.to_vec()).is_ok_and(|text| Scene::parse(&path, &text).is_ok())
        }),
    ];
    let mut checked = 0;
    for (name, text, read) in kinds {
        let (mut random, mut accepted) = (Random(0x9e37_79b9_7f4a_7c15), 0);
        for round in 0..ROUNDS {
            let changed = random.changed(text);
            match catch_unwind(AssertUnwindSafe(|| read(&changed))) {
                Ok(taken) => accepted += usize::from(taken),
                Err(_) => panic!("{name}, round {round}: {:?}", String::from_utf8_lossy(&changed)),
            }
            checked += 1;
        }
        println!("{name}: {accepted} of {ROUNDS} changed files accepted, none panics");
        assert!((1..ROUNDS).contains(&accepted), "{name}: {accepted} accepted");
    }
    assert_eq!(checked, kinds.len() * ROUNDS);
}
