//! What the tests of the program's behaviour as a process share.
#![allow(clippy::unwrap_used, dead_code)] // a test that unwraps nothing reports it; no test uses all of it

pub mod browser;
pub mod judging;
pub mod recording;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The folder of the whole project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A triangle on 64 x 48 pixels.
pub const TRIANGLE: &str = "size 64 48\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n";

/// The example of passes in `docs/triangle_file.md`: depths first, then colours, then a pane.
pub const PASSES: &str = "size 64 64
colour_write 0
T  0 0 0.5 1 0 0 0   64 0 0.5 1 0 0 0   0 64 0.5 1 0 0 0
colour_write 1
depth equal
depth_write 0
T  0 0 0.5 1 0 0 0   64 0 0.5 1 0 0 0   0 64 0.5 1 0 0 0
depth less
blend 1
T  0 0 0.4 0 0 1 0.5   64 0 0.4 0 0 1 0.5   0 64 0.4 0 0 1 0.5
";

/// The example of a light's map in `docs/triangle_file.md`: a square that darkens the half of the picture under it.
pub const HALF: &str = "size 4 4
depth lequal
shadow 4 0.001 0.25   1 0 0 0   0 1 0 0   0 0 1 0   0 0 0 1
L  0 0 0.25   2 0 0.25   0 4 0.25
L  2 0 0.25   2 4 0.25   0 4 0.25
T  0 0 0.5 1 1 1 0   8 0 0.5 1 1 1 0   0 8 0.5 1 1 1 0
";

/// The screen of [`TRIANGLE`], for commands that do not take it from the file.
pub const SCREEN: [&str; 4] = ["--set", "screen.width=64", "--set", "screen.height=48"];

/// The program in a folder.
pub fn edgewalk(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command
}

/// Runs it to its end: exit code, standard error.
pub fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    ended(&edgewalk(folder, arguments).output().unwrap())
}

/// How it ended: exit code, standard error, which never tells of a panic or of a temporary folder.
pub fn ended(output: &Output) -> (Option<i32>, String) {
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!error.contains("panicked") && !error.contains(".edgewalk-"), "{error}");
    (output.status.code(), error)
}

/// What `render --json` printed, without the format and version of the document.
pub fn report(output: &Output) -> serde_json::Value {
    let mut report: serde_json::Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)));
    let [format, _] = ["format", "version"].map(|key| report.as_object_mut().unwrap().shift_remove(key));
    assert_eq!(format, Some("edgewalk-report".into()));
    report
}

/// Renders in every engine, which must draw the same picture: the report of each.
pub fn rendered_by_every_engine(folder: &Path, arguments: &[&str]) -> Vec<serde_json::Value> {
    let (mut reports, mut pictures) = (Vec::new(), Vec::new());
    for engine in ["fast", "model", "rtl"] {
        let all = [&["render"], arguments, &["--engine", engine, "--json", "--out", "r"]].concat();
        let output = edgewalk(folder, &all).output().unwrap();
        assert!(output.status.success(), "{all:?}: {}", String::from_utf8_lossy(&output.stderr));
        reports.push(serde_json::from_slice(&output.stdout).unwrap());
        pictures.push(std::fs::read(folder.join("r/image.png")).unwrap());
    }
    assert!(pictures.iter().all(|picture| *picture == pictures[0]), "the same machine");
    reports
}

/// The colours of a picture, line by line.
pub fn colors(path: &Path) -> Vec<[u8; 3]> {
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size()];
    reader.next_frame(&mut bytes).unwrap();
    bytes.chunks_exact(3).map(|color| [color[0], color[1], color[2]]).collect()
}

/// The first value of this key, however deep.
pub fn find<'a>(of: &'a serde_json::Value, key: &str) -> Option<&'a serde_json::Value> {
    let own = of.get(key);
    own.or_else(|| match of {
        serde_json::Value::Object(map) => map.values().find_map(|value| find(value, key)),
        serde_json::Value::Array(list) => list.iter().find_map(|value| find(value, key)),
        _ => None,
    })
}

/// The records of a table in CSV, its header first, by a reader that is not the project's.
pub fn csv(path: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read(path).unwrap();
    let (mut reader, mut rest) = (csv_core::Reader::new(), &text[..]);
    let (mut bytes, mut ends) = (vec![0; text.len() + 1], vec![0; text.len() + 1]);
    let mut records = Vec::new();
    loop {
        let (result, read, _, fields) = reader.read_record(rest, &mut bytes, &mut ends);
        rest = &rest[read..];
        match result {
            csv_core::ReadRecordResult::Record => {
                let from = [0].into_iter().chain(ends.iter().copied());
                let field =
                    |(from, to): (usize, &usize)| String::from_utf8(bytes[from..*to].to_vec()).unwrap();
                records.push(from.zip(&ends[..fields]).map(field).collect());
            }
            csv_core::ReadRecordResult::End => return records,
            result => panic!("{result:?}"),
        }
    }
}

/// What stands in a folder, by name, hidden files too.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// An array as numpy's format says: element type, shape, and the elements' bytes.
pub fn npy(path: &Path) -> (String, Vec<usize>, Vec<u8>) {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00", "magic and version");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
    assert!(header.contains("'fortran_order': False"), "{header}");
    let behind = |key: &str, end: char| {
        let from = header.split_once(key).unwrap().1.trim_start().trim_start_matches(['\'', '(']);
        from.split_once(end).unwrap().0.to_owned()
    };
    let shape = behind("'shape':", ')');
    let shape =
        shape.split(',').map(str::trim).filter(|n| !n.is_empty()).map(|n| n.parse().unwrap()).collect();
    (behind("'descr':", '\''), shape, bytes[10 + length..].to_vec())
}
