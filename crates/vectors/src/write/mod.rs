//! A trace as a directory of files that any simulator, or any other program, can take from there.
//!
//! ```text
//!  manifest.json  manifest.schema.json      what is what, with hashes
//!  <channel>.in.mem                         tokens into the design, but for the words that a memory gives
//!  <channel>.exp.mem                        tokens out of it
//!  <channel>.cyc.mem                        cycles from the token before to each of them
//!  <channel>.triangle.mem                   triangles from that of the token before to its own, where that is known
//!  status.exp.mem     status.cyc.mem        outputs compared in every cycle, where they change
//!  <memory>.start.mem                       the words of a memory that nobody writes
//!  <channel>.willing.mem                    when the bench offers and takes
//!  *.csv                                    all of this as tables for people, unless left out
//!  params.vh  cases.vh  tb.v  bench_*.v     the test bench
//!  rules.v  rules_bind.sv  rules_icarus.v   what holds on each channel, to be bound to the design in any test bench
//!  hdl/*.v  filelist.f  Makefile            the design, and how to run it
//!  edgewalk.core                            the same for FuseSoC
//!  SHA256SUMS                               of what the bench reads; `make` looks at it first
//! ```

mod describe;
pub mod core;
mod device;
mod dut;
mod faults;
mod kept;
mod makefile;
pub mod mem;
mod params;
mod rules;
mod table;
mod testbench;

pub(crate) use describe::file;

use crate::capture::Trace;
use crate::dut::Wiring;
use crate::manifest;
use crate::suites::Suite;
use edgewalk_lockstep::{Direction, Interface, Pattern, Port, status_ports};
use std::borrow::Cow;

/// Files to be written: name relative to the directory, contents.
pub type Files = Vec<(String, Vec<u8>)>;

/// The tables for people: more than half of a directory's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tables {
    /// A CSV file for each channel, and one for the status.
    Written,
    /// None.
    LeftOut,
}

/// The design that a directory is for.
#[derive(Clone, Copy)]
enum Design<'a> {
    /// Verilog files of the unit, name and text; they go to `hdl/`.
    Ours(&'a [(String, String)]),
    /// A user's, which stays where it is.
    Own(&'a Wiring),
}

/// The whole directory. `design` are the Verilog files of the unit, name and text; they go to `hdl/`.
#[must_use]
pub fn directory(suite: &Suite, trace: &Trace, design: &[(String, String)], tables: Tables) -> Files {
    all(suite, trace, Design::Ours(design), tables)
}

/// The whole directory for a user's design, which is wired to the unit of the trace and stays where it is.
#[must_use]
pub fn directory_for(suite: &Suite, trace: &Trace, wiring: &Wiring, tables: Tables) -> Files {
    all(suite, trace, Design::Own(wiring), tables)
}

fn all(suite: &Suite, trace: &Trace, design: Design, tables: Tables) -> Files {
    let trace = match design {
        Design::Ours(_) => Cow::Borrowed(trace),
        Design::Own(wiring) => wiring.outside(trace),
    };
    let (trace, interface) = (&*trace, &trace.interface);
    let (ours, wiring) = match design {
        Design::Ours(files) => (files, None),
        Design::Own(wiring) => (&[][..], Some(wiring)),
    };
    let mut files: Vec<(String, String)> = Vec::new();
    let mut add = |name: String, text: String| files.push((name, text));
    let with_triangles: Vec<&str> = known(trace).collect();
    for (link, moved) in interface.links.iter().zip(&trace.links) {
        let name = link.name;
        if !is_served(interface, name) {
            add(token_file(name, link.direction), mem::tokens(&link.fields, &moved.tokens));
            add(cycle_file(name), mem::steps(moved.cycles.iter().map(|cycle| *cycle as u32)));
        }
        if with_triangles.contains(&name) {
            add(triangle_file(name), mem::steps(moved.triangles.iter().copied()));
        }
        if tables == Tables::Written {
            add(table_file(name), table::link(suite, link, moved));
        }
    }
    let fields = status_fields(interface);
    let (cycles, values): (Vec<u32>, Vec<_>) =
        trace.status.iter().map(|(cycle, token)| (*cycle as u32, token.clone())).unzip();
    add(token_file("status", Direction::Out), mem::tokens(&fields, &values));
    add(cycle_file("status"), mem::steps(cycles.into_iter()));
    if tables == Tables::Written {
        add(table_file("status"), table::status(&fields, trace));
    }
    for (name, pattern) in patterns(trace) {
        add(willing_file(name), mem::bits(pattern.bits()));
    }
    for (memory, setting) in interface.memories.iter().zip(&trace.setting.memories) {
        if memory.write.is_none() {
            add(start_file(memory.name), mem::words(&setting.start));
        }
    }
    let stamp = trace.plan.stamp("//");
    add("params.vh".to_owned(), format!("{stamp}\n{}", params::params(trace, wiring)));
    add("cases.vh".to_owned(), format!("{stamp}\n{}", faults::cases(suite)));
    // All that the bench reads is there.
    let data =
        files.iter().map(|(name, _)| name).filter(|name| name.ends_with(".mem")).cloned().collect::<Vec<_>>();
    let sums = sums(&files);
    let mut add = |name: String, text: String| files.push((name, text));
    add("SHA256SUMS".to_owned(), sums);

    let module = interface.unit.module();
    let modules = testbench::modules(interface, wiring.is_some());
    let names = modules.iter().map(|(name, _)| *name).collect();
    let sources = match wiring {
        None => {
            let hdl = ours.iter().map(|(name, _)| format!("hdl/{name}")).collect();
            makefile::Sources { module: &module, top: &module, hdl, dut: None, modules: names }
        }
        Some(Wiring { dut, .. }) => {
            let hdl = dut.files.iter().map(|file| file.display().to_string()).collect();
            makefile::Sources { module: &module, top: &dut.top, hdl, dut: Some(dut), modules: names }
        }
    };
    for (name, text) in ours {
        add(format!("hdl/{name}"), text.clone());
    }
    let mark = mark(&trace.plan.hash());
    let marked =
        |text: &str| format!("{stamp}\n{}", text.replace("$display(\"", &format!("$display(\"{mark} ")));
    for (name, text) in modules {
        add(name.to_owned(), marked(text));
    }
    let bench = testbench::testbench(&trace.plan, interface, &with_triangles, wiring);
    add("tb.v".to_owned(), marked(&bench));
    for (name, text) in rules::files(interface, wiring) {
        add(name.to_owned(), marked(&text));
    }
    add("filelist.f".to_owned(), format!("{stamp}{}", sources.filelist()));
    add("Makefile".to_owned(), trace.plan.stamp("#") + &sources.makefile(&mark));
    let name = format!("{}_{}", suite.name, interface.unit.name());
    add("edgewalk.core".to_owned(), core::of_vectors(&trace.plan.stamp("#"), &name, &sources, &data));
    add(manifest::SCHEMA_FILE.to_owned(), manifest::SCHEMA.to_owned());

    let mut files: Files = files.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    let manifest = describe::manifest(suite, trace, wiring, &files, tables);
    // A manifest is plain data with text keys: it always becomes JSON.
    let mut json = serde_json::to_string_pretty(&manifest).unwrap_or_default();
    json.push('\n');
    files.insert(0, (manifest::FILE.to_owned(), json.into_bytes()));
    files
}

/// What each line of the bench and of the rules begins with, so that nothing is taken for it that the design prints.
pub(crate) fn mark(hash: &str) -> String {
    format!("edgewalk {hash}:")
}

fn token_file(channel: &str, direction: Direction) -> String {
    match direction {
        Direction::In => format!("{channel}.in.mem"),
        Direction::Out => format!("{channel}.exp.mem"),
    }
}

fn cycle_file(channel: &str) -> String {
    format!("{channel}.cyc.mem")
}

fn triangle_file(channel: &str) -> String {
    format!("{channel}.triangle.mem")
}

fn willing_file(channel: &str) -> String {
    format!("{channel}.willing.mem")
}

fn start_file(memory: &str) -> String {
    format!("{memory}.start.mem")
}

fn table_file(channel: &str) -> String {
    format!("{channel}.csv")
}

/// The tokens of this channel are the words of a memory: they follow from what is read and written, so they have no files.
fn is_served(interface: &Interface, channel: &str) -> bool {
    interface.memories.iter().any(|memory| interface.links[memory.data].name == channel)
}

/// The channels out whose tokens know their triangle.
fn known(trace: &Trace) -> impl Iterator<Item = &'static str> {
    let out = trace.interface.links.iter().zip(&trace.links);
    let out = out.filter(|(channel, moved)| {
        channel.direction == Direction::Out && moved.triangles.len() == moved.tokens.len()
    });
    out.map(|(channel, _)| channel.name)
}

/// When the bench is willing, for every channel and level.
fn patterns(trace: &Trace) -> impl Iterator<Item = (&str, &Pattern)> {
    let interface = &trace.interface;
    let levels = interface.levels.iter().map(|level| level.name.as_str());
    interface.links.iter().map(|channel| channel.name).chain(levels).zip(&trace.setting.patterns)
}

/// The lines that `sha256sum -c` takes. The design is not among them: a user may put another in its place.
fn sums(files: &[(String, String)]) -> String {
    let line = |(name, text): &(String, String)| format!("{}  {name}\n", file(name, text.as_bytes()).sha256);
    files.iter().filter(|(name, _)| !name.ends_with(".csv")).map(line).collect()
}

/// The outputs compared in every cycle, as the fields of one token.
fn status_fields(interface: &Interface) -> Vec<Port> {
    status_ports(interface).into_iter().map(|status| status.port).collect()
}
