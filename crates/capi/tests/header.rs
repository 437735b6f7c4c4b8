//! `edgewalk.h` and `edgewalk_dpi.sv` are what the crate's files say.

use crate::support::CRATE;
use cbindgen::{Builder, Config};
use std::collections::BTreeSet;
use std::path::Path;

/// In the order in which a caller meets them.
const FILES: [&str; 5] = ["code", "machine", "frame", "draw", "run"];

fn generated() -> String {
    let root = Path::new(CRATE);
    let config = Config::from_file(root.join("cbindgen.toml")).expect("a configuration");
    let builder = FILES.iter().fold(Builder::new().with_config(config), |builder, file| {
        builder.with_src(root.join(format!("src/{file}.rs")))
    });
    let mut text = Vec::new();
    builder.generate().expect("the crate is read").write(&mut text);
    String::from_utf8(text).expect("text")
}

#[test]
fn header_is_what_the_crate_says() {
    let (path, text) = (Path::new(CRATE).join("edgewalk.h"), generated());
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        std::fs::write(&path, &text).expect("written");
    }
    assert_eq!(std::fs::read_to_string(path).expect("a file"), text, "EDGEWALK_BLESS=1 writes it anew");
    assert!(text.lines().all(|line| line.chars().count() <= 120));
}

/// Names in a text that begin with the library's prefix and are followed by a bracket.
fn calls(text: &str) -> BTreeSet<&str> {
    let names = text.match_indices("edgewalk_").map(|(at, _)| {
        let rest = &text[at..];
        rest.split_once(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .map_or((rest, ""), |(name, _)| (name, &rest[name.len()..]))
    });
    names.filter(|(_, behind)| behind.starts_with('(')).map(|(name, _)| name).collect()
}

/// All but the picture, whose arrays SystemVerilog has no plain pointers for.
#[test]
fn imports_are_the_calls_of_the_header() {
    let header = generated();
    let imports = std::fs::read_to_string(Path::new(CRATE).join("edgewalk_dpi.sv")).expect("a file");
    let code: String =
        header.lines().filter(|line| !line.starts_with("//") && !line.starts_with(" *")).collect();
    let mut wanted = calls(&code);
    assert!(wanted.remove("edgewalk_draw") && wanted.len() >= 15, "{wanted:?}");
    assert_eq!(calls(&imports), wanted);
}
