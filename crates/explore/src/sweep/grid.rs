//! A sweep before anything runs: its machines, memories and inputs, all of them looked at.

use super::axis::Axis;
use super::definition::{Definition, Sample, Synthesis};
use super::judge::{Judge, Memory, OverInputs, OverMemories};
use super::objective::Objective;
use super::point::{Identity, Point};
use super::require::Requirement;
use super::shading;
use super::space::{self, Space};
use super::subject::{Subject, Way};
use anyhow::{Result, anyhow};
use edgewalk_machine::Machine;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Most points of a sweep.
pub const MAX_POINTS: u64 = 200_000;

/// Most seeds of place and route.
pub const MAX_SEEDS: u32 = 1000;

/// The machines and inputs that a round of a search runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Round {
    /// How many inputs the machines are run on, the first of all.
    pub inputs: usize,
    /// How many machines.
    pub machines: usize,
}

/// A sweep that can be run.
pub struct Sweep {
    /// What was asked for.
    pub definition: Definition,
    /// Varied keys, the slowest first.
    pub axes: Vec<Axis>,
    /// What is drawn.
    pub inputs: Vec<Subject>,
    /// The memories that every machine is run with.
    pub memories: Vec<Memory>,
    /// How the rows of a machine count together.
    pub judge: Judge,
    /// What is best.
    pub objectives: Vec<Objective>,
    /// What a machine must keep.
    pub requirements: Vec<Requirement>,
    /// All machines that the values of the keys make.
    pub space: Space,
    /// How many these are.
    pub whole: u64,
    /// How many machines there are points of.
    pub machines: usize,
    /// In their order: by machines, then memories, then inputs.
    pub points: Vec<Point>,
    /// Rounds of a search that have begun.
    pub rounds: Vec<Round>,
    /// The machine that the keys are varied in.
    pub base: Machine,
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
                return Err(anyhow!(
                    "--vary {}: the key is varied twice; put its values into one --vary",
                    axis.key.name
                ));
            }
        }
        let memories = Memory::list(&definition.stalls)?;
        let over_memories = OverMemories::parse(&definition.judge, &memories)?;
        check_bound(definition.bound)?;
        check_seeds(definition.synth.as_ref())?;
        let base = Machine::read(&definition.machine).map_err(|e| anyhow!("{e}"))?;
        let shadings = shadings(&definition, &base, &axes)?;
        let synth = definition.synth.is_some();
        let objectives = Objective::list(&definition.objectives, synth, shadings.len() > 1)?;
        let requirements = Requirement::list(
            &definition.require,
            &definition.fits,
            definition.synth.as_ref().map(|of| of.target.as_str()),
        )?;
        let space = Space::new(&base, &axes);
        let whole = space.count();
        if whole > u64::MAX / 2 {
            return Err(anyhow!("--vary: more than 2^63 combinations; permitted: fewer; vary fewer keys"));
        }
        let rows = definition.inputs.len() * memories.len();
        let chosen = match definition.search {
            Some(_) => {
                check_search(&definition, whole, rows as u64)?;
                Vec::new()
            }
            None => {
                let index = |place| space.index(&base, &axes, place);
                chosen(whole, definition.sample, rows as u64, index)?
            }
        };
        check_chunks(definition.chunks, chosen.len() * rows)?;
        let inputs = inputs(&definition.inputs, &shadings)?;
        check_shading(definition.shading.as_deref(), &inputs)?;
        let over_inputs = OverInputs::parse(&definition.judge_inputs, &definition.weights, &inputs)?;
        let judge = Judge { memories: over_memories, inputs: over_inputs };
        let mut sweep = Sweep {
            definition,
            axes,
            inputs,
            memories,
            judge,
            objectives,
            requirements,
            space,
            whole,
            machines: 0,
            points: Vec::new(),
            rounds: Vec::new(),
            base,
        };
        chosen.into_iter().for_each(|index| sweep.add(index));
        Ok(sweep)
    }

    /// Adds the points of a machine.
    pub(super) fn add(&mut self, index: u64) {
        let machine = space::machine(&self.base, &self.axes, index);
        for memory in 0..self.memories.len() {
            for input in 0..self.inputs.len() {
                let point = self.point(machine.clone(), [self.machines, memory, input]);
                self.points.push(point);
            }
        }
        self.machines += 1;
    }

    /// The place of a point among the points.
    pub(super) fn place(&self, machine: usize, memory: usize, input: usize) -> usize {
        (machine * self.memories.len() + memory) * self.inputs.len() + input
    }

    /// The index of a machine by its place among all.
    pub(super) fn index(&self, place: u64) -> u64 {
        self.space.index(&self.base, &self.axes, place)
    }

    /// The point of a machine, a memory and an input, by their places.
    fn point(&self, mut machine: Machine, [number, memory, input]: [usize; 3]) -> Point {
        let of = &self.inputs[input];
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
        let way = of.place(self.definition.shading.as_deref().unwrap_or(shading::of_machine(&machine)));
        let identity = Identity {
            machine: machine.hash(),
            input: of.name.clone(),
            input_hash: of.way(way).hash.clone(),
            stalls: self.memories[memory].waits.to_string(),
            version: self.definition.program.clone(),
            synth: self.synth_identity(),
            bound: self.definition.bound.map(|bound| bound.to_string()).unwrap_or_default(),
            require: self.require_identity(),
        };
        let plan = machine.plan().map_err(|e| e.to_string());
        Point { key: identity.key(), number, memory, input, way, machine, plan }
    }

    /// What a point draws.
    #[must_use]
    pub fn drawn(&self, point: &Point) -> &Way {
        self.inputs[point.input].way(point.way)
    }

    /// Points by their keys.
    #[must_use]
    pub fn by_key(&self) -> BTreeMap<&str, &Point> {
        self.points.iter().map(|point| (point.key.as_str(), point)).collect()
    }

    /// Whether rows tell how far pictures are from the shading equation.
    #[must_use]
    pub fn asks_equation(&self) -> bool {
        self.objectives.iter().any(Objective::is_of_equation)
            || self.requirements.iter().any(Requirement::is_of_equation)
    }

    /// Whether rows tell the estimate of their machines.
    #[must_use]
    pub fn asks_estimate(&self) -> bool {
        self.definition.estimate
            || self.objectives.iter().any(|objective| objective.estimate)
            || self.requirements.iter().any(Requirement::is_of_estimate)
    }

    /// What a machine must keep, in words; empty if nothing.
    #[must_use]
    pub fn require_identity(&self) -> String {
        self.requirements.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
    }

    /// How machines are synthesised, in words; empty if they are not.
    #[must_use]
    pub fn synth_identity(&self) -> String {
        let of = self.definition.synth.as_ref();
        of.map_or_else(String::new, |s| format!("{} {} seeds {}", s.target, s.unit, s.seeds))
    }
}

/// Accepts a shading that an input takes: a scene takes any, a triangle file its own.
fn check_shading(shading: Option<&str>, inputs: &[Subject]) -> Result<()> {
    let Some(shading) = shading else { return Ok(()) };
    let mut left = inputs.iter().map(|input| input.way(0).input.own_shading());
    if left.any(|mode| mode.is_none_or(|mode| mode == shading)) {
        return Ok(());
    }
    let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
    Err(anyhow!(
        "--shading {shading}: triangle files say themselves how they are shaded ({}); permitted: beside a scene; leave --shading out",
        names.join(", ")
    ))
}

fn check_bound(bound: Option<f64>) -> Result<()> {
    match bound {
        Some(bound) if !(bound > 0.5 && bound.is_finite()) => {
            Err(anyhow!("--bound {bound}: permitted: above 0.5 LSB, which the output's rounding takes"))
        }
        _ => Ok(()),
    }
}

fn check_seeds(synth: Option<&Synthesis>) -> Result<()> {
    match synth {
        Some(synth) if !(1..=MAX_SEEDS).contains(&synth.seeds) => {
            Err(anyhow!("--synth-seeds {}: permitted: 1 to {MAX_SEEDS}", synth.seeds))
        }
        _ => Ok(()),
    }
}

fn check_search(of: &Definition, whole: u64, rows: u64) -> Result<()> {
    /// Fewest machines of a search: two for each of the parts that its first half and its steps are.
    const LEAST: u32 = 32;
    let Some(Sample { points, .. }) = of.search else { return Ok(()) };
    let says = |why: String| Err(anyhow!("--search {points}: {why}"));
    if of.synth.is_some() {
        return says(
            "nothing is built in a search; limit the estimate by --require, then build the best".to_owned(),
        );
    }
    if of.chunks.is_some() {
        return says("a search is not cut into parts; leave --chunks out".to_owned());
    }
    if of.sample.is_some() {
        return says("a search takes no sample; leave --sample out".to_owned());
    }
    if u64::from(points) >= whole {
        return says(format!("there are {whole} machines; leave --search out, and all of them are run"));
    }
    if points < LEAST || u64::from(points) * rows > MAX_POINTS {
        return says(format!(
            "permitted: {LEAST} to {} machines with {rows} points each",
            MAX_POINTS / rows.max(1)
        ));
    }
    Ok(())
}

fn check_chunks(chunks: Option<u32>, points: usize) -> Result<()> {
    match chunks {
        Some(chunks) if chunks == 0 || chunks as usize > points => {
            Err(anyhow!("--chunks {chunks}: permitted: 1 to {points}, at most one for each of the points"))
        }
        _ => Ok(()),
    }
}

/// The indices of the machines that are looked at, each of which has so many rows; `index` has them by their places among all.
fn chosen(whole: u64, sample: Option<Sample>, rows: u64, index: impl Fn(u64) -> u64) -> Result<Vec<u64>> {
    /// Draws for each machine of a sample: of a space that is not listed many combinations may be the same machine.
    const DRAWS: u64 = 64;
    let count = sample.map_or(whole, |sample| whole.min(u64::from(sample.points)));
    if sample.is_some_and(|sample| sample.points == 0) {
        return Err(anyhow!("--sample 0: permitted: at least 1"));
    }
    if count.saturating_mul(rows) > MAX_POINTS {
        return Err(anyhow!(
            "{count} machines with {rows} points each: permitted: {MAX_POINTS} points in all; look at some of them with --sample N --seed S; the program also has a search, --search N --seed S"
        ));
    }
    let Some(sample) = sample.filter(|_| count < whole) else { return Ok((0..whole).map(index).collect()) };
    let mut random = Pcg64Mcg::seed_from_u64(sample.seed);
    // Distinct ones: on grids of few values a sequence of low discrepancy would repeat itself.
    if whole < 4 * count {
        let drawn = rand::seq::index::sample(&mut random, whole as usize, count as usize);
        return Ok(drawn
            .into_iter()
            .map(|place| index(place as u64))
            .collect::<BTreeSet<_>>()
            .into_iter()
            .collect());
    }
    let mut indices = BTreeSet::new();
    for _ in 0..count * DRAWS {
        if indices.len() as u64 == count {
            break;
        }
        indices.insert(index(random.random_range(0..whole)));
    }
    Ok(indices.into_iter().collect())
}

/// The ways in which the machines shade.
fn shadings(definition: &Definition, base: &Machine, axes: &[Axis]) -> Result<Vec<&'static str>> {
    if let Some(name) = &definition.shading {
        return Ok(vec![shading::named(name)?.0]);
    }
    let Some(axis) = axes.iter().find(|axis| axis.key.name == "shade.kind") else {
        return Ok(vec![shading::of_machine(base)]);
    };
    let mut machine = base.clone();
    let of = |value: &u32| {
        (axis.key.set)(&mut machine, *value);
        shading::of_machine(&machine)
    };
    Ok(axis.values.iter().map(of).collect())
}

fn inputs(names: &[String], shadings: &[&'static str]) -> Result<Vec<Subject>> {
    let mut all: Vec<Subject> = Vec::new();
    for name in names {
        if all.iter().any(|before| before.name == *name) {
            return Err(anyhow!("{name}: the input is given twice; give it once"));
        }
        all.push(Subject::open(name, shadings)?);
    }
    if all.is_empty() {
        return Err(anyhow!("no input: name a scene, a mesh or a triangle file"));
    }
    Ok(all)
}
