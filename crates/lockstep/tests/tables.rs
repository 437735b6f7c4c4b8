//! The port tables of `docs/machine.md`, section 18, are what the units declare.
//!
//! `EDGEWALK_BLESS=1 cargo test -p edgewalk-lockstep tables::` rewrites them.

use edgewalk_lockstep::{Direction, Interface, Link, Port, StatusPort, Unit};
use edgewalk_machine::{Plan, Scale};
use std::fmt::Write as _;
use std::path::Path;

/// What stands before the tables in the document.
const MARK: &str = "<!-- tables -->\n";

/// What stands behind them.
const END: &str = "\n<!-- end of tables -->\n";

#[test]
fn the_port_tables_are_what_the_units_declare() {
    let plan = Plan::default();
    let tables: String = Unit::all(&plan).into_iter().map(|unit| table(&plan, unit)).collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/machine.md");
    let kept = std::fs::read_to_string(&path).expect("the document");
    let (before, rest) = kept.split_once(MARK).expect("the mark before the tables");
    let (_, behind) = rest.split_once(END).expect("the mark behind the tables");
    let wanted = format!("{before}{MARK}{tables}{END}{behind}");
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        std::fs::write(&path, &wanted).expect("docs can be written");
        return;
    }
    println!("{} lines of tables", tables.lines().count());
    assert!(kept == wanted, "docs/machine.md is out of date: run this test with EDGEWALK_BLESS=1");
}

fn table(plan: &Plan, unit: Unit) -> String {
    let interface = Interface::new(plan, unit);
    let mut text =
        format!("\n**{}**\n\n| port | bits | format | meaning |\n|---|---|---|---|\n", unit.name());
    for link in &interface.links {
        head(&mut text, link);
        link.fields.iter().for_each(|port| line(&mut text, port, ""));
    }
    let of =
        |what: &str, ports: &[Port], text: &mut String| ports.iter().for_each(|port| line(text, port, what));
    of("in, constant: ", &interface.constants, &mut text);
    of("in, any cycle: ", &interface.levels, &mut text);
    for StatusPort { port, during, .. } in &interface.status {
        let what = during.map_or("out: ".to_owned(), |other| format!("out, during `{other}`: "));
        line(&mut text, port, &what);
    }
    text
}

/// The handshake of a link, and which way it goes.
fn head(text: &mut String, link: &Link) {
    let way = if link.direction == Direction::In { "in" } else { "out" };
    let ready = if link.ready_always { "" } else { ", ready for a token" };
    let _ = writeln!(text, "| `{0}_valid`, `{0}_ready` | 1, 1 | | link {way}{ready} |", link.name);
}

fn line(text: &mut String, port: &Port, what: &str) {
    let format = match port.field.scale {
        Scale::Count if port.is_signed() => "signed".to_owned(),
        Scale::Count => String::new(),
        Scale::Of(unit) => format!("{} {unit}", port.field.format),
        Scale::Modular(unit) => format!("{} {unit}, modular", port.field.format),
        Scale::Unorm => format!("unorm{}", port.width()),
    };
    let _ = writeln!(text, "| `{}` | {} | {format} | {what}{} |", port.name, port.width(), port.field.doc);
}
