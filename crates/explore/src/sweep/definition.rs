//! What a sweep was asked for, as it is kept beside its rows.

use super::judge::Judge;
use serde::{Deserialize, Serialize};

/// Everything that makes a sweep the one it is; `sweep.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// Always [`Definition::FORMAT`].
    pub format: String,
    /// Of the format: [`Definition::FORMAT_VERSION`].
    pub version: [u32; 2],
    /// Version of the program that wrote it.
    pub program: String,
    /// Scenes, meshes and triangle files.
    pub inputs: Vec<String>,
    /// How scenes and meshes are shaded, by a name of [`super::shading`]; none: each machine's input is shaded as its
    /// `shade.kind` says.
    pub shading: Option<String>,
    /// The machine that the varied keys are changed in: TOML of every key, with those of units that it has not. It need not be
    /// one that can be built.
    pub machine: String,
    /// Varied keys, as `--vary` has them.
    pub vary: Vec<String>,
    /// Memories that every machine is run with, as `--stalls` has them.
    pub stalls: Vec<String>,
    /// How several memories count together, as `--judge` has it.
    pub judge: String,
    /// How several inputs count together, as `--judge-inputs` has it.
    pub judge_inputs: String,
    /// Weights of inputs, as `--weight` has them.
    pub weights: Vec<String>,
    /// So many of the machines, by seed.
    pub sample: Option<Sample>,
    /// So many machines of a search through a space that is not run whole, by seed.
    pub search: Option<Sample>,
    /// Points without a proved bound of at most so many LSB are not simulated.
    pub bound: Option<f64>,
    /// What a machine must keep, as `--require` has it.
    pub require: Vec<String>,
    /// Devices that a machine must fit by its estimate.
    pub fits: Vec<String>,
    /// Every row has the estimate of its machine.
    pub estimate: bool,
    /// What is best, by name.
    pub objectives: Vec<String>,
    /// Synthesis of every machine.
    pub synth: Option<Synthesis>,
    /// Parts in which other machines may run it.
    pub chunks: Option<u32>,
}

impl Definition {
    /// Name of the format.
    pub const FORMAT: &str = "edgewalk-sweep-definition";
    /// Version of the definition's format.
    pub const FORMAT_VERSION: [u32; 2] = [1, 3];
}

/// The default machine on no input yet: a starting point.
impl Default for Definition {
    fn default() -> Self {
        Definition {
            format: Definition::FORMAT.to_owned(),
            version: Definition::FORMAT_VERSION,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: Vec::new(),
            shading: None,
            machine: edgewalk_machine::Machine::default().every_key_to_toml(),
            vary: Vec::new(),
            stalls: Vec::new(),
            judge: Judge::WORST.to_owned(),
            judge_inputs: Judge::SUM.to_owned(),
            weights: Vec::new(),
            sample: None,
            search: None,
            bound: None,
            require: Vec::new(),
            fits: Vec::new(),
            estimate: false,
            objectives: Vec::new(),
            synth: None,
            chunks: None,
        }
    }
}

/// Some of the machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sample {
    /// How many.
    pub points: u32,
    /// Which.
    pub seed: u64,
}

/// How machines are synthesised.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Synthesis {
    /// The device.
    pub target: String,
    /// machine, engine, or a unit.
    pub unit: String,
    /// Seeds 1 to this for place and route.
    pub seeds: u32,
}
