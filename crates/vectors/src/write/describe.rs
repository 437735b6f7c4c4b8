//! The manifest of a trace.

use super::dut;
use super::kept;
use super::{
    Files, Tables, cycle_file, is_served, known, params, patterns, start_file, status_fields, table_file,
    token_file, triangle_file, willing_file,
};
use crate::capture::Trace;
use crate::dut::Wiring;
use crate::manifest::{
    CaseInfo, Channel, Compare, FORMAT, Field, File, Handshake, HeldValues, MachineInfo, Manifest, Memory,
    MemoryWrite, Radix, SideInput, Stalls, Status, SuiteInfo, VERSION,
};
use crate::reach::{not_covered, reached};
use crate::suites::Suite;
use edgewalk_lockstep::{Direction, Interface, Link, Port, StatusPort};
use edgewalk_machine::Plan;
use edgewalk_machine::keys::KEYS;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// The manifest of a directory with these other files.
pub(super) fn manifest(
    suite: &Suite,
    trace: &Trace,
    wiring: Option<&Wiring>,
    files: &Files,
    tables: Tables,
) -> Manifest {
    let interface = &trace.interface;
    let constants = interface.constants.iter().zip(&trace.setting.constants);
    let reached = reached(trace);
    let by_order = wiring.is_some_and(|wiring| wiring.dut.compare == crate::dut::Compare::Order);
    let table = |name: &str| (tables == Tables::Written).then(|| table_file(name));
    Manifest {
        format: FORMAT.to_owned(),
        format_version: VERSION,
        generator: format!("edgewalk {}", env!("CARGO_PKG_VERSION")),
        suite: suite_info(suite),
        machine: MachineInfo {
            hash: trace.plan.hash(),
            settings: KEYS.iter().map(|key| (key.name.to_owned(), key.show(&trace.plan))).collect(),
        },
        unit: interface.unit.name().to_owned(),
        module: interface.unit.module(),
        dut: wiring.map(|wiring| dut::info(interface, wiring)),
        handshake: handshake(interface, wiring),
        rounding: rounding(&trace.plan),
        constants: constants.map(|(field, value)| (field.name.clone(), *value as u64)).collect(), // a few bits
        stalls: stalls(trace),
        memories: memories(trace),
        side_inputs: side_inputs(interface),
        limits: params::limits(trace, wiring),
        radix: Radix { mem: 16, patterns: 2 },
        channels: channels(trace, by_order, table),
        held: held(interface),
        status: Status {
            fields: packed(&status_fields(interface)),
            optional: interface.status.iter().map(|status| status.port.name.clone()).collect(),
            during: interface.status.iter().filter_map(during).collect(),
            count: trace.status.len() as u64,
            tokens: token_file("status", Direction::Out),
            moved: cycle_file("status"),
            table: table("status"),
        },
        cycles: trace.cycles,
        expected: if by_order { trace.tokens_out() } else { trace.expected() },
        not_covered: not_covered([&reached]).into_iter().map(str::to_owned).collect(),
        coverage: reached.into_iter().map(|(name, count)| (name.to_owned(), count)).collect(),
        files: files.iter().map(|(name, bytes)| file(name, bytes)).collect(),
    }
}

/// Length and hash of a file.
pub(crate) fn file(name: &str, bytes: &[u8]) -> File {
    let sha256 = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    File { name: name.to_owned(), bytes: bytes.len() as u64, sha256 }
}

fn suite_info(suite: &Suite) -> SuiteInfo {
    let mut first = 0;
    let case = |case: &crate::suites::Case| {
        let count = case.triangles.len() as u64;
        first += count;
        CaseInfo { name: case.name.clone(), first: first - count, count }
    };
    SuiteInfo {
        name: suite.name.clone(),
        about: suite.about.clone(),
        seed: suite.seed,
        triangles: suite.triangles().count() as u64,
        cases: suite.cases.iter().map(case).collect(),
    }
}

/// Where numbers are rounded, and how.
fn rounding(plan: &Plan) -> Vec<String> {
    let formats = if plan.is_sequenced() { "the words of in_data" } else { "tri" };
    let vertices =
        format!("vertices: half to even to the formats of {formats}, by whoever made the triangles");
    let others = [
        "setup: floor(x + 1/2) for increments and first values, floor and remainder for exact edges",
        "interpolation: none, words are modular",
        "outputs: floor to b bits; first values already hold half an LSB",
    ];
    std::iter::once(vertices).chain(others.map(str::to_owned)).collect()
}

/// Clock and reset of our own design.
fn ours() -> (String, String) {
    ("clk, rising edge".to_owned(), "rst, synchronous, active high".to_owned())
}

fn handshake(interface: &Interface, wiring: Option<&Wiring>) -> Handshake {
    let (clock, reset) = wiring.map_or_else(ours, dut::clock_and_reset);
    Handshake {
        kind: "valid/ready: a token moves in a cycle where both are high".to_owned(),
        clock,
        reset,
        cycle_zero: "the first cycle with rst low".to_owned(),
        rules: [
            "a valid does not wait for its ready: tb.v has a first run, its cycles not compared, in which ready follows valid".to_owned(),
            "the bench first offers a token in a cycle whose pattern is 1, and holds it until it is taken".to_owned(),
            "the bench takes a token in the cycles whose pattern is 1".to_owned(),
            "fields count only while valid is high".to_owned(),
            "with the cycles not compared (make CHECK_CYCLES=0) order and values of the tokens count, and no status"
                .to_owned(),
        ].into_iter().chain(rules_of_held(interface)).collect(),
    }
}

/// Values held beside the channels out.
fn held(interface: &Interface) -> Vec<HeldValues> {
    let values = kept::all(interface).map(|kept| HeldValues {
        channel: kept.link.name.to_owned(),
        ports: kept.link.held().iter().map(|port| port.name.clone()).collect(),
        fresh: kept.fresh.name.clone(),
        taken: kept.taken.name.to_owned(),
        taken_with: kept.ends.map(|port| port.name.clone()),
    });
    values.collect()
}

/// When values held beside a channel count.
fn rules_of_held(interface: &Interface) -> Vec<String> {
    let names = |link: &Link| {
        let names: Vec<&str> = link.held().iter().map(|port| port.name.as_str()).collect();
        names.join(", ")
    };
    let given = kept::all(interface).map(|kept| {
        let (values, fresh, taken) = (names(kept.link), &kept.fresh.name, kept.taken.name);
        let ends = kept.ends.map(|ends| format!(" with {}", ends.name)).unwrap_or_default();
        format!("{values} stay from a token with {fresh} until the next token of {taken}{ends} moves")
    });
    let taken = interface.links_of(Direction::In).filter(|link| !link.held().is_empty());
    let taken = taken.map(|link| format!("{} count only with a token with {}_fresh", names(link), link.name));
    given.chain(taken).collect()
}

fn stalls(trace: &Trace) -> Stalls {
    let file = |(name, _): (&str, _)| (name.to_owned(), willing_file(name));
    Stalls { kind: trace.stalls.name().to_owned(), patterns: patterns(trace).map(file).collect() }
}

fn during(status: &StatusPort) -> Option<(String, String)> {
    Some((status.port.name.clone(), status.during?.to_owned()))
}

fn side_inputs(interface: &Interface) -> Vec<SideInput> {
    let source = interface.links.first().map_or("", |link| link.name);
    let side_input = |level: &Port| SideInput {
        port: level.name.clone(),
        format: level.field.to_string(),
        while_tokens_of: source.to_owned(),
        pattern: willing_file(&level.name),
        rule: format!(
            "1 in a cycle before which tokens of {source} are left to move and whose pattern is 0, else 0"
        ),
    };
    interface.levels.iter().map(side_input).collect()
}

fn channels(trace: &Trace, by_order: bool, table: impl Fn(&str) -> Option<String>) -> Vec<Channel> {
    let known: Vec<&str> = known(trace).collect();
    let entered: BTreeMap<u32, u64> = trace.links.first().map(first_of_each).unwrap_or_default();
    let interface = trace.interface.links.iter().zip(&trace.links);
    interface
        .map(|(channel, moved)| {
            let from_memory = is_served(&trace.interface, channel.name);
            let waits = first_of_each(moved).into_iter().filter_map(|(triangle, cycle)| {
                (channel.direction == Direction::Out).then_some(())?;
                // EDGE behind a sequenced SETUP takes a triangle behind its last line.
                cycle.checked_sub(*entered.get(&triangle)?)
            });
            let waits: Vec<u64> = waits.collect();
            Channel {
                name: channel.name.to_owned(),
                direction: if channel.direction == Direction::In { "in" } else { "out" }.to_owned(),
                compare: match channel.direction {
                    Direction::In => Compare::Driven,
                    Direction::Out if by_order => Compare::Exact,
                    Direction::Out => Compare::Cycle,
                },
                order: if from_memory { "of the reads" } else { "of the tokens" }.to_owned(),
                width: channel.width(),
                fields: packed(&channel.fields),
                count: moved.tokens.len() as u64,
                cycles: range(&moved.cycles),
                latency: range(&waits),
                tokens: (!from_memory).then(|| token_file(channel.name, channel.direction)),
                moved: (!from_memory).then(|| cycle_file(channel.name)),
                triangles: known.contains(&channel.name).then(|| triangle_file(channel.name)),
                table: table(channel.name),
            }
        })
        .collect()
}

fn memories(trace: &Trace) -> Vec<Memory> {
    let interface = &trace.interface;
    let port = |link: usize, field: usize| interface.links[link].fields[field].name.clone();
    let memories = interface.memories.iter().zip(&trace.setting.memories);
    let memories = memories.map(|(memory, setting)| Memory {
        name: memory.name.to_owned(),
        read: interface.links[memory.read].name.to_owned(),
        data: interface.links[memory.data].name.to_owned(),
        write: memory.write.map(|write| MemoryWrite {
            channel: interface.links[write.link].name.to_owned(),
            address: port(write.link, write.address),
            word: port(write.link, write.word),
            enable: write.enable.map(|enable| port(write.link, enable)),
        }),
        latency: setting.latency,
        words: setting.words as u64,
        clear: format!("{:x}", setting.clear),
        start: memory.write.is_none().then(|| start_file(memory.name)),
        read_during_write: "old word".to_owned(),
    });
    memories.collect()
}

/// The cycle of the first token of each triangle.
fn first_of_each(moved: &crate::capture::LinkTrace) -> BTreeMap<u32, u64> {
    let mut first = BTreeMap::new();
    for (triangle, cycle) in moved.triangles.iter().zip(&moved.cycles) {
        first.entry(*triangle).or_insert(*cycle);
    }
    first
}

fn range(values: &[u64]) -> Option<[u64; 2]> {
    Some([*values.iter().min()?, *values.iter().max()?])
}

/// Fields with their place in the packed token.
fn packed(fields: &[Port]) -> Vec<Field> {
    let mut lsb = fields.iter().map(Port::width).sum();
    let place = |field: &Port| {
        lsb -= field.width();
        Field {
            port: field.name.clone(),
            width: field.width(),
            lsb,
            signed: field.is_signed(),
            format: field.field.to_string(),
        }
    };
    fields.iter().map(place).collect()
}
