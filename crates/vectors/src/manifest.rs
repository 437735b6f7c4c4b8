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
/// The version of the format that is written, and the only one that is read.
pub const VERSION: u32 = 5;

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
    /// Verilog module of the unit.
    pub module: String,
    /// The user's design that stands for it; none: ours, in `hdl`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dut: Option<DutInfo>,
    /// How tokens move and what a cycle is.
    pub handshake: Handshake,
    /// Where numbers are rounded, and how.
    pub rounding: Vec<String>,
    /// Inputs that hold one value over the whole run.
    pub constants: BTreeMap<String, u64>,
    /// How the bench makes the design wait.
    pub stalls: Stalls,
    /// The memories that the bench is.
    pub memories: Vec<Memory>,
    /// Inputs beside the channels that may change in any cycle.
    pub side_inputs: Vec<SideInput>,
    /// When a run ends.
    pub limits: Limits,
    /// The base of the numbers in the memory files.
    pub radix: Radix,
    /// The channels.
    pub channels: Vec<Channel>,
    /// Values that the design holds beside channels.
    pub held: Vec<HeldValues>,
    /// Outputs compared in every cycle.
    pub status: Status,
    /// Cycles until nothing more happens.
    pub cycles: u64,
    /// Things that the bench compares: tokens out, and changes of the status.
    pub expected: u64,
    /// How often the model met each hazard and corner that it can meet in this unit of this machine.
    pub coverage: BTreeMap<String, u64>,
    /// Events that this run did not meet.
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
    /// Name of the case.
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

/// A user's design.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DutInfo {
    /// The top module.
    pub top: String,
    /// The design's files, absolute.
    pub files: Vec<String>,
    /// Folders for its include lines, absolute.
    pub include: Vec<String>,
    /// The clock port, of which the rising edge counts.
    pub clock: String,
    /// The reset.
    pub reset: ResetInfo,
    /// `order`: values and their order count; `cycle`: cycles and status ports too.
    pub compare: String,
    /// Parameters of the top module, their values in Verilog.
    pub parameters: BTreeMap<String, String>,
    /// Inputs that hold one value.
    pub tie: BTreeMap<String, u64>,
    /// For each port of the unit, valid and ready too, its place in a port of the design.
    pub ports: BTreeMap<String, Place>,
    /// Ports of the unit that the design has not, and that are not compared.
    pub absent: Vec<String>,
    /// Memories of the unit that are inside the design, with the paths of their arrays: the bench fills them before the
    /// first clock, with the words that `memories` tells.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub memories: BTreeMap<String, String>,
}

/// The reset of a user's design.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResetInfo {
    /// The port.
    pub port: String,
    /// `high` or `low`.
    pub active: String,
    /// `synchronous` or `asynchronous`.
    pub kind: String,
    /// Clocks for which it is held.
    pub cycles: u32,
}

/// Where a value stands in a port.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The port.
    pub port: String,
    /// The value's lowest bit in the port.
    pub lsb: u32,
    /// The value's bits in the port, with those of the extension.
    pub width: u32,
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
    /// For each channel and each side input the file of its pattern: a bit a line, that of cycle 0 first, again from the
    /// start after the last. 1: the bench is willing to offer a new token or to take one.
    pub patterns: BTreeMap<String, String>,
}

/// A one-bit input that may change in any cycle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SideInput {
    /// The port.
    pub port: String,
    /// Format of the input.
    pub format: String,
    /// The channel in whose tokens count: after the last of them has moved it is 0.
    pub while_tokens_of: String,
    /// File of the input among the patterns.
    pub pattern: String,
    /// How the bench comes by its value.
    pub rule: String,
}

/// When the run of a design ends, whether or not all has come.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Cycles in which no token moves and no status port changes.
    pub idle: u64,
    /// Cycles in all.
    pub cycles: u64,
}

/// Bases of numbers, and how they are written: a number a line, in as few digits as it has. A file *in steps* holds the
/// first number, then by how much each is larger than the one before, modulo 2^32.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Radix {
    /// Of tokens, cycles and triangles.
    pub mem: u32,
    /// Of the patterns.
    pub patterns: u32,
}

/// A memory behind the unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// What is stored there.
    pub name: String,
    /// The channel of its addresses.
    pub read: String,
    /// The channel of its words, in the order of the reads.
    pub data: String,
    /// The link that writes it; null if another unit's does.
    pub write: Option<MemoryWrite>,
    /// Cycles from a read to its data, at the least.
    pub latency: u64,
    /// Words.
    pub words: u64,
    /// Every word at the start, but for those of `start`: lower-case hex, as in a memory file.
    pub clear: String,
    /// Memory file of the first words at the start, from address 0 on; none: all are `clear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<String>,
    /// What a read sees that fires together with a write.
    pub read_during_write: String,
}

/// What writes a memory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MemoryWrite {
    /// The channel; every token of it that moves writes, if there is no `enable` or it is 1.
    pub channel: String,
    /// The field with the address.
    pub address: String,
    /// The field that is stored.
    pub word: String,
    /// The field that permits it; none: every token of the channel is a write.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enable: Option<String>,
}

/// How tokens are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compare {
    /// Every bit.
    Exact,
    /// Every bit, and the cycle.
    Cycle,
    /// The port is driven, not compared.
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
    /// Fewest and most cycles from the entry of a triangle to its first token here; null where that is not known, or
    /// where tokens leave before the triangle has entered.
    pub latency: Option<[u64; 2]>,
    /// Memory file of the tokens; null where they are the words of one of `memories`.
    pub tokens: Option<String>,
    /// Memory file of the cycles in which they move, in steps (see [`Radix`]): valid and ready are both high in them; null
    /// where there is none of the tokens.
    pub moved: Option<String>,
    /// Memory file of the triangles that they belong to, in steps; null where that is not known.
    pub triangles: Option<String>,
    /// Table for people; null where none is written.
    pub table: Option<String>,
}

/// Values that the design holds beside a channel out. They stay from the first token of a triangle until the next triangle
/// is taken.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeldValues {
    /// The channel.
    pub channel: String,
    /// The ports with the values.
    pub ports: Vec<String>,
    /// The port that is 1 with the first token of a triangle.
    pub fresh: String,
    /// The channel in. Its token brings the next triangle.
    pub taken: String,
    /// The port that is 1 with such a token; null if each token of `taken` is one.
    pub taken_with: Option<String>,
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
    /// Ports that a design compared without its cycles need not have.
    pub optional: Vec<String>,
    /// For a port that means something only while another is 1 that other port: it counts as 0 while not.
    pub during: BTreeMap<String, String>,
    /// Changes; the values of cycle 0 are the first.
    pub count: u64,
    /// Memory file of the values.
    pub tokens: String,
    /// Memory file of the cycles from which on they hold, in steps.
    pub moved: String,
    /// Table for people; null where none is written.
    pub table: Option<String>,
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
