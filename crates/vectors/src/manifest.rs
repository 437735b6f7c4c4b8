//! `manifest.json`: what a directory of vectors holds and how it is to be compared. The schema is
//! `manifest.schema.json`, written beside it.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of the file.
pub const FILE: &str = "manifest.json";
/// Name of the schema's file.
pub const SCHEMA_FILE: &str = "manifest.schema.json";
/// The schema (JSON Schema 2020-12).
pub const SCHEMA: &str = include_str!("../manifest.schema.json");
/// Value of [`Manifest::format`].
pub const FORMAT: &str = "edgewalk-vectors";
/// The newest format there is; a reader refuses what is newer.
pub const VERSION: u32 = 1;

/// All of `manifest.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`] of the writer.
    pub format_version: u32,
    /// Program and version that wrote it.
    pub generator: String,
    /// The stimuli.
    pub suite: SuiteInfo,
    /// The machine.
    pub machine: MachineInfo,
    /// What is tested: `machine`, or a unit.
    pub unit: String,
    /// Its Verilog module.
    pub module: String,
    /// How tokens move and what a cycle is.
    pub handshake: Handshake,
    /// Where numbers are rounded, and how.
    pub rounding: Vec<String>,
    /// Inputs that hold one value over the whole run.
    pub constants: BTreeMap<String, u64>,
    /// How the bench makes the design wait.
    pub stalls: Stalls,
    /// The depth memory that the bench is, if the unit needs one.
    pub memory: Option<Memory>,
    /// The channels.
    pub channels: Vec<Channel>,
    /// Outputs compared in every cycle.
    pub status: Status,
    /// Cycles until nothing more happens.
    pub cycles: u64,
    /// Things that the bench compares: tokens out, and changes of the status.
    pub expected: u64,
    /// How often the model met each hazard and corner.
    pub coverage: BTreeMap<String, u64>,
    /// The hazards and corners it did not meet.
    pub not_covered: Vec<String>,
    /// Every other file of the directory.
    pub files: Vec<File>,
}

/// The stimuli.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SuiteInfo {
    /// Name of the suite.
    pub name: String,
    /// What it is for.
    pub about: String,
    /// Seed; triangle k of a random suite depends only on (seed, suite, k), the stalls only on the seed.
    pub seed: u64,
    /// Triangles in all.
    pub triangles: u64,
    /// The cases, in order.
    pub cases: Vec<CaseInfo>,
}

/// A case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseInfo {
    /// Its name.
    pub name: String,
    /// Number of its first triangle.
    pub first: u64,
    /// Triangles.
    pub count: u64,
}

/// The machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MachineInfo {
    /// The hash that everything made from this machine carries.
    pub hash: String,
    /// Every key of a machine file and its value, as text.
    pub settings: BTreeMap<String, String>,
}

/// How tokens move.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Handshake {
    /// The rule.
    pub kind: String,
    /// Clock port and its edge.
    pub clock: String,
    /// Reset port and its kind.
    pub reset: String,
    /// Which cycle is cycle 0.
    pub cycle_zero: String,
    /// What a bench may rely on.
    pub rules: Vec<String>,
}

/// How the bench makes the design wait.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stalls {
    /// `none`, `mixed` or `late`.
    pub kind: String,
    /// For each channel (and each level input) ones and zeros that repeat, cycle 0 first; 1: the bench is willing to
    /// offer a new token or to take one. A level is the opposite of its pattern while there are tokens to come, then 0.
    pub patterns: BTreeMap<String, String>,
}

/// The depth memory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// Cycles from a read to its data, at the least.
    pub latency: u64,
    /// Words.
    pub words: u64,
    /// Every word at the start.
    pub clear: u64,
    /// What a read sees that fires together with a write.
    pub read_during_write: String,
}

/// How tokens are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compare {
    /// Every bit.
    Exact,
    /// Every bit, and the cycle.
    Cycle,
    /// It is driven, not compared.
    Driven,
}

/// A channel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    /// Prefix of its ports.
    pub name: String,
    /// `in` or `out`, seen from the design.
    pub direction: String,
    /// How it is compared by the test bench as it is.
    pub compare: Compare,
    /// The order of tokens.
    pub order: String,
    /// Bits of a packed token.
    pub width: u32,
    /// The fields, the most significant first.
    pub fields: Vec<Field>,
    /// Tokens.
    pub count: u64,
    /// First and last cycle in which one moved; null if none did.
    pub cycles: Option<[u64; 2]>,
    /// Fewest and most cycles from the entry of a triangle to its first token here; null where that is not known.
    pub latency: Option<[u64; 2]>,
    /// Memory file of the tokens.
    pub tokens: String,
    /// Memory file of their cycles.
    pub moved: String,
    /// Table for eyes.
    pub table: String,
}

/// A field of a token, or a port.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Port.
    pub port: String,
    /// Bits.
    pub width: u32,
    /// Place of its lowest bit in the packed token.
    pub lsb: u32,
    /// Two's complement.
    pub signed: bool,
    /// Format and unit.
    pub format: String,
}

/// Outputs compared in every cycle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Status {
    /// The ports, the most significant first.
    pub fields: Vec<Field>,
    /// Changes; the values of cycle 0 are the first.
    pub count: u64,
    /// Memory file of the values.
    pub tokens: String,
    /// Memory file of the cycles from which on they hold.
    pub moved: String,
    /// Table for eyes.
    pub table: String,
}

/// A file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Name, relative to the directory.
    pub name: String,
    /// Length.
    pub bytes: u64,
    /// SHA-256, lower-case hex.
    pub sha256: String,
}
