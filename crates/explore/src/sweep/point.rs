//! The points of a sweep: a machine, an input, a behaviour of the memory.

use super::axis::Axis;
use super::definition::{Definition, Sample};
use super::objective::Objective;
use anyhow::{Context, Result, anyhow};
use edgewalk_golden::Shading;
use edgewalk_host::input::{Input, Shaded, hex};
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::Waits;
use edgewalk_scene::PixelMethod;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;

/// Most points of a sweep.
pub const MAX_POINTS: u64 = 200_000;

/// A sweep that can be run.
pub struct Sweep {
    /// What was asked for.
    pub definition: Definition,
    /// Varied keys, the slowest first.
    pub axes: Vec<Axis>,
    /// What is drawn, and a hash of each.
    pub inputs: Vec<(Input, String)>,
    /// Behaviours of the memory.
    pub waits: Vec<Waits>,
    /// What is best.
    pub objectives: Vec<Objective>,
    /// In their order: by keys, then stalls, then inputs.
    pub points: Vec<Point>,
}

/// A point.
pub struct Point {
    /// Sixteen hex digits that stand for all that its row depends on.
    pub key: String,
    /// The input's place.
    pub input: usize,
    /// The behaviour's place.
    pub waits: usize,
    /// The machine's keys.
    pub machine: Machine,
    /// The machine, or why it cannot be built.
    pub plan: Result<Plan, String>,
}

/// Ways of shading by their names on the command line.
const SHADINGS: [(&str, Shaded); 5] = [
    ("constant", Shaded::Corners(Shading::Constant)),
    ("constant-averaged", Shaded::Corners(Shading::ConstantAveraged)),
    ("gouraud", Shaded::Corners(Shading::Gouraud)),
    ("phong", Shaded::Pixels(PixelMethod::Phong)),
    ("fast-phong", Shaded::Pixels(PixelMethod::FastPhong)),
];

/// The way of shading of that name.
///
/// # Errors
/// The machine does not draw so.
pub fn shading(name: &str) -> Result<Shaded> {
    let found = SHADINGS.iter().find(|(known, _)| *known == name);
    found
        .map(|(_, shading)| *shading)
        .ok_or_else(|| anyhow!("--shading {name}: the machine draws constant, constant-averaged and gouraud, with shade.kind fast-phong and phong"))
}

impl Sweep {
    /// Everything is looked at before anything runs.
    ///
    /// # Errors
    /// What of the definition cannot be done.
    pub fn new(definition: Definition) -> Result<Sweep> {
        let axes = definition.vary.iter().map(|text| Axis::parse(text)).collect::<Result<Vec<_>>>()?;
        for (place, axis) in axes.iter().enumerate() {
            if axes[..place].iter().any(|before| before.key.name == axis.key.name) {
                return Err(anyhow!("--vary {}: the key is varied twice", axis.key.name));
            }
        }
        let waits = waits(&definition.stalls)?;
        let objectives = Objective::list(&definition.objectives, definition.synth.is_some())?;
        check_bound(definition.bound)?;
        let shading = shading(&definition.shading)?;
        let whole = axes.iter().map(|axis| axis.values.len() as u64);
        let whole = whole.fold(waits.len() as u64, u64::saturating_mul);
        let machines = chosen(whole, definition.sample, definition.inputs.len() as u64)?;
        let base = Machine::from_toml(&definition.machine)?;
        let inputs = inputs(&definition.inputs, shading)?;
        let mut sweep = Sweep { definition, axes, inputs, waits, objectives, points: Vec::new() };
        for index in machines {
            let (waits, machine) = sweep.machine(&base, index);
            for input in 0..sweep.inputs.len() {
                let point = sweep.point(machine.clone(), waits, input);
                sweep.points.push(point);
            }
        }
        Ok(sweep)
    }

    /// The machine with this number, and its memory's behaviour: the last key changes fastest but for the behaviour.
    fn machine(&self, base: &Machine, index: u64) -> (usize, Machine) {
        let mut machine = base.clone();
        let mut rest = index;
        let mut digit = |count: usize| {
            let digit = rest % count as u64;
            rest /= count as u64;
            digit as usize
        };
        let waits = digit(self.waits.len());
        for axis in self.axes.iter().rev() {
            (axis.key.set)(&mut machine, axis.values[digit(axis.values.len())]);
        }
        (waits, machine)
    }

    /// The point of a machine, a behaviour and an input.
    fn point(&self, mut machine: Machine, waits: usize, input: usize) -> Point {
        let (of, input_hash) = &self.inputs[input];
        // A triangle file brings its screen.
        let varied = |name: &str| self.axes.iter().any(|axis| axis.key.name == name);
        if let Some((width, height)) = of.size() {
            if !varied("screen.width") {
                machine.width = width;
            }
            if !varied("screen.height") {
                machine.height = height;
            }
        }
        let identity = Identity {
            machine: machine.hash(),
            input: input_hash.clone(),
            stalls: self.waits[waits].to_string(),
            version: self.definition.version.clone(),
            synth: self.synth_identity(),
            bound: self.definition.bound.map(|bound| bound.to_string()).unwrap_or_default(),
        };
        let plan = machine.plan().map_err(|e| e.to_string());
        Point { key: identity.key(), input, waits, machine, plan }
    }

    /// How machines are synthesised, in words; empty if they are not.
    #[must_use]
    pub fn synth_identity(&self) -> String {
        let of = self.definition.synth.as_ref();
        of.map_or_else(String::new, |s| format!("{} {} seeds {}", s.target, s.unit, s.seeds))
    }
}

/// What a row depends on.
pub struct Identity {
    /// Hash of the machine's keys.
    pub machine: String,
    /// Hash of the input.
    pub input: String,
    /// The memory's behaviour.
    pub stalls: String,
    /// Of the program.
    pub version: String,
    /// How it was synthesised.
    pub synth: String,
    /// The bound asked for.
    pub bound: String,
}

impl Identity {
    /// Each part with its name.
    #[must_use]
    pub fn parts(&self) -> [(&'static str, &str); 6] {
        [
            ("machine", &self.machine),
            ("input_hash", &self.input),
            ("stalls", &self.stalls),
            ("version", &self.version),
            ("synth", &self.synth),
            ("bound", &self.bound),
        ]
    }

    /// Sixteen hex digits.
    #[must_use]
    pub fn key(&self) -> String {
        let mut digest = Sha256::new();
        for (name, part) in self.parts() {
            digest.update(format!("{name}={part}\n"));
        }
        hex(&digest.finalize()[..8])
    }
}

fn waits(list: &[String]) -> Result<Vec<Waits>> {
    let mut all = Vec::new();
    for text in list {
        let waits: Waits = text.parse().map_err(|e| anyhow!("--stalls {text}: {e}"))?;
        if all.contains(&waits) {
            return Err(anyhow!("--stalls {text}: comes twice"));
        }
        all.push(waits);
    }
    if all.is_empty() {
        all.push(Waits::Never);
    }
    Ok(all)
}

fn check_bound(bound: Option<f64>) -> Result<()> {
    match bound {
        Some(bound) if !(bound > 0.5 && bound.is_finite()) => {
            Err(anyhow!("--bound {bound}: permitted: above 0.5 LSB, which the output's rounding takes"))
        }
        _ => Ok(()),
    }
}

/// The numbers of the machines that are looked at.
fn chosen(whole: u64, sample: Option<Sample>, inputs: u64) -> Result<Vec<u64>> {
    let count = sample.map_or(whole, |sample| whole.min(u64::from(sample.points)));
    if sample.is_some_and(|sample| sample.points == 0) {
        return Err(anyhow!("--sample 0: permitted: at least 1"));
    }
    if count.saturating_mul(inputs) > MAX_POINTS {
        return Err(anyhow!(
            "{count} machines on {inputs} inputs: permitted: {MAX_POINTS} points in all; look at some of them with --sample N --seed S"
        ));
    }
    let Some(sample) = sample.filter(|_| count < whole) else { return Ok((0..whole).collect()) };
    let mut random = Pcg64Mcg::seed_from_u64(sample.seed);
    // Distinct ones: on grids of few values a sequence of low discrepancy would repeat itself.
    if whole < 4 * count {
        let drawn = rand::seq::index::sample(&mut random, whole as usize, count as usize);
        return Ok(drawn
            .into_iter()
            .map(|number| number as u64)
            .collect::<BTreeSet<_>>()
            .into_iter()
            .collect());
    }
    let mut numbers = BTreeSet::new();
    while (numbers.len() as u64) < count {
        numbers.insert(random.random_range(0..whole));
    }
    Ok(numbers.into_iter().collect())
}

fn inputs(names: &[String], shading: Shaded) -> Result<Vec<(Input, String)>> {
    let mut all: Vec<(Input, String)> = Vec::new();
    for name in names {
        if all.iter().any(|(before, _)| before.name() == name) {
            return Err(anyhow!("{name}: the input comes twice"));
        }
        let input = Input::open(name, shading)?;
        let hash = input.hash().with_context(|| name.clone())?;
        all.push((input, hash));
    }
    if all.is_empty() {
        return Err(anyhow!("no input: name a scene, a mesh or a triangle file"));
    }
    Ok(all)
}
