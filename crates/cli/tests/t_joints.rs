//! `edgewalk triangles` counts the T-joints of a mesh.

use crate::support::edgewalk;

/// A square beside two, whose common corner lies in the middle of its side.
const JOINED: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 2 1 0\nv 3 0 0\nv 3 1 0\nv 3 2 0\n\
                      f 1 2 3 4\nf 2 6 7 5\nf 5 7 8 3\n";

#[test]
fn t_joints_are_counted_and_the_first_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let told = |mesh: &str, json: bool| {
        std::fs::write(folder.path().join("a.obj"), mesh).expect("a file");
        let options: &[&str] = if json { &["--json"] } else { &[] };
        let arguments = ["triangles", "a.obj", "--out", "a.tri"];
        let output = edgewalk(folder.path(), &[&arguments, options].concat()).output().expect("runs");
        assert!(output.status.success());
        output
    };
    let text = |mesh: &str| String::from_utf8(told(mesh, false).stdout).expect("text");
    let counted = |mesh: &str| {
        let found: serde_json::Value = serde_json::from_slice(&told(mesh, true).stdout).expect("JSON");
        found["t_joints"].clone()
    };
    assert_eq!(counted(JOINED), 1);
    let named = text(JOINED);
    assert!(
        named.contains("T-joints: 1, the first at (2 1 0) on the edge from (2 0 0) to (2 2 0)"),
        "{named}"
    );
    let shared = JOINED.replace("f 1 2 3 4", "f 1 2 5 3 4");
    assert_eq!(counted(&shared), 0);
    assert!(!text(&shared).contains("T-joints"));
}
