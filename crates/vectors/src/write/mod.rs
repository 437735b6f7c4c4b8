//! A trace as a directory of files that any simulator, or any other program, can take from there.
//!
//! ```text
//!  manifest.json  manifest.schema.json      what is what, with hashes
//!  <channel>.in.mem                         tokens into the design
//!  <channel>.exp.mem  <channel>.cyc.mem     tokens out of it, and the cycles
//!  status.exp.mem     status.cyc.mem        outputs compared in every cycle, where they change
//!  *.csv                                    all of this for eyes
//!  params.vh  tb.v  bench_*.v               the test bench
//!  hdl/*.v  filelist.f  Makefile            the design, and how to run it
//! ```

mod describe;
mod makefile;
pub mod mem;
mod params;
mod table;
mod testbench;

pub(crate) use describe::file;

use crate::capture::Trace;
use crate::manifest;
use crate::ports::{Direction, Field};
use crate::status::{StatusPort, status_ports};
use crate::suites::Suite;

/// Files to be written: name relative to the directory, contents.
pub type Files = Vec<(String, Vec<u8>)>;

/// The whole directory. `design` are the Verilog files of the unit, name and text; they go to `hdl/`.
#[must_use]
pub fn directory(suite: &Suite, trace: &Trace, design: &[(String, String)]) -> Files {
    let mut files: Vec<(String, String)> = Vec::new();
    let mut add = |name: String, text: String| files.push((name, text));
    for (channel, moved) in trace.interface.channels.iter().zip(&trace.channels) {
        let name = channel.name;
        add(token_file(name, channel.direction), mem::tokens(&channel.fields, &moved.tokens));
        add(format!("{name}.cyc.mem"), mem::numbers(32, &moved.cycles));
        add(format!("{name}.csv"), table::channel(suite, channel, moved));
    }
    let fields = status_fields(trace);
    let (cycles, values): (Vec<u64>, Vec<_>) = trace.status.iter().cloned().unzip();
    add(token_file("status", Direction::Out), mem::tokens(&fields, &values));
    add("status.cyc.mem".to_owned(), mem::numbers(32, &cycles));
    add("status.csv".to_owned(), table::status(&fields, trace));

    let hdl: Vec<String> = design.iter().map(|(name, _)| format!("hdl/{name}")).collect();
    for (name, (_, text)) in hdl.iter().zip(design) {
        add(name.clone(), text.clone());
    }
    for (name, text) in testbench::MODULES {
        add(name.to_owned(), text.to_owned());
    }
    add("params.vh".to_owned(), params::params(trace));
    add("tb.v".to_owned(), testbench::testbench(&trace.interface));
    add("filelist.f".to_owned(), makefile::filelist(&hdl));
    add("Makefile".to_owned(), makefile::makefile(&trace.interface.unit.module(), &hdl));
    add(manifest::SCHEMA_FILE.to_owned(), manifest::SCHEMA.to_owned());

    let mut files: Files = files.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    let manifest = describe::manifest(suite, trace, &files);
    // A manifest is plain data with text keys: it always becomes JSON.
    let mut json = serde_json::to_string_pretty(&manifest).unwrap_or_default();
    json.push('\n');
    files.insert(0, (manifest::FILE.to_owned(), json.into_bytes()));
    files
}

fn token_file(channel: &str, direction: Direction) -> String {
    match direction {
        Direction::In => format!("{channel}.in.mem"),
        Direction::Out => format!("{channel}.exp.mem"),
    }
}

/// The outputs compared in every cycle, as the fields of one token.
fn status_fields(trace: &Trace) -> Vec<Field> {
    let known: Vec<&Field> = trace.interface.status.iter().map(|status| &status.field).collect();
    let field = |status: StatusPort| {
        let known = known.iter().find(|field| field.port == status.port);
        let format = known.map_or("handshake", |field| &field.format).to_owned();
        Field { format, port: status.port, width: status.width, signed: false }
    };
    status_ports(&trace.interface).into_iter().map(field).collect()
}
