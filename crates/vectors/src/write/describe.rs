//! The manifest of a trace.

use super::{Files, status_fields, token_file};
use crate::capture::Trace;
use crate::manifest::{
    CaseInfo, Channel, Compare, FORMAT, Field, File, Handshake, MachineInfo, Manifest, Memory, Stalls,
    Status, SuiteInfo, VERSION,
};
use crate::ports::{self, Direction};
use crate::suites::Suite;
use edgewalk_machine::keys::KEYS;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// The manifest of a directory with these other files.
pub(super) fn manifest(suite: &Suite, trace: &Trace, files: &Files) -> Manifest {
    let interface = &trace.interface;
    let constants = interface.constants.iter().zip(&trace.setting.constants);
    let coverage = trace.coverage.counts().into_iter();
    Manifest {
        format: FORMAT.to_owned(),
        format_version: VERSION,
        generator: format!("edgewalk {}", env!("CARGO_PKG_VERSION")),
        suite: suite_info(suite),
        machine: MachineInfo {
            hash: trace.machine.hash(),
            settings: KEYS.iter().map(|key| (key.name.to_owned(), key.show(&trace.machine))).collect(),
        },
        unit: interface.unit.name().to_owned(),
        module: interface.unit.module(),
        handshake: handshake(),
        rounding: ROUNDING.map(str::to_owned).to_vec(),
        constants: constants.map(|(field, value)| (field.port.clone(), *value as u64)).collect(), // a few bits
        stalls: stalls(trace),
        memory: interface.memory.then(|| Memory {
            latency: trace.setting.latency,
            words: trace.setting.words as u64,
            clear: trace.setting.clear_z as u64, // at most 32 bits
            read_during_write: "old word".to_owned(),
        }),
        channels: channels(trace),
        status: Status {
            fields: packed(&status_fields(trace)),
            count: trace.status.len() as u64,
            tokens: token_file("status", Direction::Out),
            moved: "status.cyc.mem".to_owned(),
            table: "status.csv".to_owned(),
        },
        cycles: trace.cycles,
        expected: trace.expected(),
        coverage: coverage.map(|(name, count)| (name.to_owned(), count)).collect(),
        not_covered: trace.coverage.missing().into_iter().map(str::to_owned).collect(),
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

const ROUNDING: [&str; 4] = [
    "vertices: half to even to the formats of tri, by whoever made the triangles",
    "setup: floor(x + 1/2) for increments and first values, floor and remainder for exact edges",
    "interpolation: none, words are modular",
    "outputs: floor to b bits; first values already hold half an LSB",
];

fn handshake() -> Handshake {
    Handshake {
        kind: "valid/ready: a token moves in a cycle where both are high".to_owned(),
        clock: "clk, rising edge".to_owned(),
        reset: "rst, synchronous, active high".to_owned(),
        cycle_zero: "the first cycle with rst low".to_owned(),
        rules: vec![
            "a valid does not wait for its ready".to_owned(),
            "the bench holds a token that it offers until it is taken".to_owned(),
            "fields count only while valid is high".to_owned(),
        ],
    }
}

fn stalls(trace: &Trace) -> Stalls {
    let interface = &trace.interface;
    let names =
        interface.channels.iter().map(|c| c.name).chain(interface.levels.iter().map(|f| f.port.as_str()));
    let bits = |bits: &[bool]| bits.iter().map(|willing| if *willing { '1' } else { '0' }).collect();
    let patterns = names.zip(&trace.setting.patterns);
    Stalls {
        kind: trace.stalls.name().to_owned(),
        patterns: patterns.map(|(name, pattern)| (name.to_owned(), bits(pattern.bits()))).collect(),
    }
}

fn channels(trace: &Trace) -> Vec<Channel> {
    let entered: BTreeMap<u32, u64> = trace.channels.first().map(first_of_each).unwrap_or_default();
    let interface = trace.interface.channels.iter().zip(&trace.channels);
    interface
        .map(|(channel, moved)| {
            let from_memory = trace.interface.memory && channel.name == "data";
            let waits = first_of_each(moved).into_iter().filter_map(|(triangle, cycle)| {
                (channel.direction == Direction::Out).then_some(())?;
                Some(cycle - entered.get(&triangle)?)
            });
            let waits: Vec<u64> = waits.collect();
            Channel {
                name: channel.name.to_owned(),
                direction: if channel.direction == Direction::In { "in" } else { "out" }.to_owned(),
                compare: if channel.direction == Direction::In { Compare::Driven } else { Compare::Cycle },
                order: if from_memory { "of the reads" } else { "of the tokens" }.to_owned(),
                width: channel.width(),
                fields: packed(&channel.fields),
                count: moved.tokens.len() as u64,
                cycles: range(&moved.cycles),
                latency: range(&waits),
                tokens: token_file(channel.name, channel.direction),
                moved: format!("{}.cyc.mem", channel.name),
                table: format!("{}.csv", channel.name),
            }
        })
        .collect()
}

/// The cycle of the first token of each triangle.
fn first_of_each(moved: &crate::capture::ChannelTrace) -> BTreeMap<u32, u64> {
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
fn packed(fields: &[ports::Field]) -> Vec<Field> {
    let mut lsb = fields.iter().map(|field| field.width).sum();
    let place = |field: &ports::Field| {
        lsb -= field.width;
        Field {
            port: field.port.clone(),
            width: field.width,
            lsb,
            signed: field.signed,
            format: field.format.clone(),
        }
    };
    fields.iter().map(place).collect()
}
