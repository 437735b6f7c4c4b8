//! No command writes over what it reads.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, ended};
use std::fs;

#[test]
fn inputs_stay_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("a.tri"), "size 32 32\nT 1 1 .3 1 0 0 0  31 2 .5 0 1 0 0  2 30 .7 0 0 1 0\n").unwrap();
    fs::write(at("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let machine = edgewalk(folder.path(), &["config", "print"]).output().unwrap().stdout;
    fs::write(at("m.toml"), &machine).unwrap();
    fs::create_dir(at("under")).unwrap();
    let cases: [(&[&str], &str, &str); 5] = [
        (&["compare", "default", "small", "a.tri", "--page", "a.tri"], "a.tri", "--page a.tri"),
        (
            &["compare", "default", "small", "a.tri", "--page", "under/../a.tri"],
            "a.tri",
            "--page under/../a.tri",
        ),
        (
            &["compare", "default", "m.toml,setup.lanes=1:constant", "a.obj", "--page", "m.toml"],
            "m.toml",
            "--page m.toml",
        ),
        (&["triangles", "a.obj", "--out", "a.obj"], "a.obj", "--out a.obj"),
        (&["triangles", "a.tri", "--out", "./a.tri"], "a.tri", "--out ./a.tri"),
    ];
    for (words, file, option) in cases {
        let before = fs::read(at(file)).unwrap();
        let (code, error) = ended(&edgewalk(folder.path(), words).output().unwrap());
        assert_eq!(code, Some(2), "{words:?}: {error}");
        let said = format!(
            "{option}: this file is the input {file}; permitted: a file that the command does not read; give"
        );
        assert!(error.contains(&said), "{words:?}: {error}");
        assert_eq!(fs::read(at(file)).unwrap(), before, "{words:?}");
    }
    // Another file is written anew.
    fs::write(at("page.html"), "old").unwrap();
    let words = ["compare", "default", "small", "a.tri", "--page", "page.html"];
    assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0));
    assert!(fs::read(at("page.html")).unwrap().len() > 100);
}
