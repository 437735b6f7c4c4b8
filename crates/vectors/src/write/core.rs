//! A FuseSoC core file (CAPI2) for a directory of vectors, and for a design.

use super::makefile::{self, Sources};
use crate::dut::Dut;
use std::fmt::Write as _;

/// A file of a core: its name from the folder of the core file.
enum Kind {
    /// Compiled, in this order.
    Source,
    /// Included by a source.
    Include,
    /// Read by the simulation, under its own name in the folder of the run.
    Data,
}

/// The core of a directory: `icarus` and `verilator` run the bench as `make` does, `lint` looks at the design alone.
/// `data` are the files that the bench reads.
pub(super) fn of_vectors(stamp: &str, name: &str, sources: &Sources, data: &[String]) -> String {
    let dut = sources.dut;
    let standard = dut.map_or("2001", Dut::standard);
    let kind = if standard == "2001" { "verilogSource-2001" } else { "systemVerilogSource" };
    let mut text = head(stamp, "vectors", name, "test vectors with a self-checking bench");
    let own = |files: &[String]| files.iter().map(|file| (file.clone(), Kind::Source)).collect::<Vec<_>>();
    fileset(&mut text, "design", kind, &own(&sources.hdl));
    let compiled = sources.bench().into_iter().map(|file| (file.to_owned(), Kind::Source));
    let included = ["params.vh", "cases.vh"].map(|file| (file.to_owned(), Kind::Include));
    let read = data.iter().map(|file| (file.clone(), Kind::Data));
    let bench: Vec<_> = included.into_iter().chain(read).chain(compiled).collect();
    fileset(&mut text, "bench", "verilogSource-2001", &bench);
    let include = dut.map(makefile::include).unwrap_or_default();
    let with = |options: &[&str], more: &[String]| {
        options.iter().map(|option| (*option).to_owned()).chain(more.iter().cloned()).collect::<Vec<_>>()
    };
    let icarus = with(&[&format!("-g{standard}")], &include);
    let verilator = with(&["--timing", "-O3", "-Wno-fatal", "--timescale", "1ns/1ps"], &include);
    let lint =
        with(&["-Wall"], &[include.clone(), dut.map(makefile::parameters).unwrap_or_default()].concat());
    text += "\ntargets:\n";
    let both = ["design", "bench"];
    target(&mut text, "default", &["design"], sources.top, None);
    target(&mut text, "icarus", &both, "tb", Some(("icarus", "", ("iverilog_options", &icarus))));
    let binary = "        mode: binary\n";
    target(
        &mut text,
        "verilator",
        &both,
        "tb",
        Some(("verilator", binary, ("verilator_options", &verilator))),
    );
    let only = "        mode: lint-only\n";
    target(
        &mut text,
        "lint",
        &["design"],
        sources.top,
        Some(("verilator", only, ("verilator_options", &lint))),
    );
    text
}

/// The core of a design: its files in compile order; `lint` looks at it.
#[must_use]
pub fn of_design(stamp: &str, name: &str, top: &str, files: &[String]) -> String {
    let mut text = head(stamp, "hdl", name, "a machine of edgewalk as Verilog-2001");
    let files: Vec<_> = files.iter().map(|file| (file.clone(), Kind::Source)).collect();
    fileset(&mut text, "design", "verilogSource-2001", &files);
    text += "\ntargets:\n";
    target(&mut text, "default", &["design"], top, None);
    let (only, all) = ("        mode: lint-only\n", ["-Wall".to_owned()]);
    target(&mut text, "lint", &["design"], top, Some(("verilator", only, ("verilator_options", &all))));
    text
}

/// A text in quotes: what JSON can hold between quotes YAML can too.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A letter that no name of a core may have becomes an underscore.
fn head(stamp: &str, library: &str, name: &str, about: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' };
    let (name, version) = (name.chars().map(plain).collect::<String>(), env!("CARGO_PKG_VERSION"));
    let about = quoted(about);
    format!("CAPI=2:\n{stamp}name: edgewalk:{library}:{name}:{version}\ndescription: {about}\n\nfilesets:\n")
}

fn fileset(text: &mut String, name: &str, kind: &str, files: &[(String, Kind)]) {
    // Writing to a string cannot fail.
    _ = writeln!(text, "  {name}:\n    file_type: {kind}\n    files:");
    for (file, of) in files {
        let file = quoted(file);
        _ = match of {
            Kind::Source => writeln!(text, "      - {file}"),
            Kind::Include => writeln!(text, "      - {file}: {{is_include_file: true}}"),
            Kind::Data => writeln!(text, "      - {file}: {{file_type: user, copyto: {file}}}"),
        };
    }
}

/// A tool, lines of its own, and a list of its options.
type Tool<'a> = (&'a str, &'a str, (&'a str, &'a [String]));

fn target(text: &mut String, name: &str, filesets: &[&str], top: &str, tool: Option<Tool>) {
    _ = writeln!(text, "  {name}:\n    filesets: [{}]\n    toplevel: {}", filesets.join(", "), quoted(top));
    let Some((tool, more, (key, options))) = tool else { return };
    let options: Vec<String> = options.iter().map(|option| quoted(option)).collect();
    _ = writeln!(
        text,
        "    default_tool: {tool}\n    tools:\n      {tool}:\n{more}        {key}: [{}]",
        options.join(", ")
    );
}
