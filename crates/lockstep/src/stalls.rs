//! When the rig makes the device wait: for every link a pattern that repeats, the same in Rust and in Verilog.

use crate::interface::{Direction, Interface};
use crate::unit::Unit;
use edgewalk_machine::{Plan, Project};
use edgewalk_model::longest_setup;
use rand::Rng;
use rand_pcg::Pcg64Mcg;
use sha2::{Digest, Sha256};

/// Bit `n mod length` says whether the rig is willing in cycle n: to offer a new token, or to take one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern(Vec<bool>);

impl Pattern {
    /// Willing in every cycle.
    #[must_use]
    pub fn always() -> Pattern {
        Pattern(vec![true])
    }

    /// Unwilling in so many of 256 cycles, at random.
    #[must_use]
    pub fn random(random: &mut Pcg64Mcg, length: usize, unwilling: u8) -> Pattern {
        Pattern((0..length).map(|_| random.random::<u8>() >= unwilling).collect())
    }

    /// Whether the rig is willing in the cycle.
    #[must_use]
    pub fn at(&self, cycle: u64) -> bool {
        self.0[(cycle % self.0.len() as u64) as usize]
    }

    /// The longest time without a willing cycle.
    #[must_use]
    pub fn longest_wait(&self) -> u64 {
        let twice = self.0.iter().chain(&self.0);
        let waits = twice.scan(0, |wait, willing| {
            *wait = if *willing { 0 } else { *wait + 1 };
            Some(*wait)
        });
        waits.max().unwrap_or(0)
    }

    /// The bits, that of cycle 0 first.
    #[must_use]
    pub fn bits(&self) -> &[bool] {
        &self.0
    }
}

/// How a rig behaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum StallKind {
    /// Never makes the device wait.
    #[default]
    None,
    /// Every link waits in about a third of the cycles.
    Mixed,
    /// Depths, writes and reads in turn wait for several triangles, so that the pixels of all of them are in flight
    /// together. What leaves a unit without a memory waits long and is then taken in a burst.
    Late,
}

impl StallKind {
    /// All, the gentlest first.
    pub const ALL: [StallKind; 3] = [StallKind::None, StallKind::Mixed, StallKind::Late];

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["none", "mixed", "late"][self as usize]
    }
}

/// Lengths of the patterns, different primes, so that the patterns of a rig together repeat only after very long.
pub(crate) const LENGTHS: [usize; 6] = [61, 67, 53, 71, 59, 73];

/// A pattern for every link and level of an interface, in their order.
#[must_use]
pub fn patterns(plan: &Plan, interface: &Interface, kind: StallKind, seed: u64) -> Vec<Pattern> {
    let held = held(interface);
    let programme =
        (kind == StallKind::Late && !held.is_empty()).then(|| programme(plan, interface, &held, seed));
    let waits = interface.waits().enumerate();
    waits
        .map(|(i, name)| {
            if kind == StallKind::None {
                return Pattern::always();
            }
            match (&programme, held.iter().position(|held| *held == name)) {
                (Some(programme), Some(held)) => Pattern(programme.iter().map(|row| row[held]).collect()),
                // The whole machine takes triangles when it can: SETUP keeps them apart anyway.
                (Some(_), None) if interface.unit == Unit::MACHINE => Pattern::always(),
                (None, _) if kind == StallKind::Late && leaves(interface, name) => Pattern(burst()),
                _ => Pattern(mixed(seed, name, LENGTHS[i % LENGTHS.len()])),
            }
        })
        .collect()
}

/// About two cycles of three, at random.
fn mixed(seed: u64, link: &str, length: usize) -> Vec<bool> {
    draws(seed, link, length).into_iter().map(|draw| draw % 3 != 0).collect()
}

fn leaves(interface: &Interface, name: &str) -> bool {
    interface.links_of(Direction::Out).any(|link| link.name == name)
}

/// Three quarters of the time nothing, then everything.
fn burst() -> Vec<bool> {
    (0..LENGTHS[0]).map(|n| 4 * n >= 3 * LENGTHS[0]).collect()
}

/// The links that [`StallKind::Late`] holds, in turn: those of the memories, reads last.
fn held(interface: &Interface) -> Vec<&'static str> {
    let mut places: Vec<usize> = interface.memories.iter().map(|memory| memory.data).collect();
    places.extend(interface.memories.iter().filter_map(|memory| Some(memory.write?.link)));
    places.extend(interface.memories.iter().map(|memory| memory.read));
    let mut names: Vec<&str> = places.into_iter().map(|place| interface.links[place].name).collect();
    names.dedup(); // memories may share their writes
    names
}

/// Fragments that can wait before DEPTH while a read is held: in PIXEL's output, in PIXEL, in the span FIFO, and one to
/// spare.
const BEFORE_DEPTH: usize = 4;

/// One common programme for the links that are held, a row a cycle.
///
/// Each in turn is held for as many triangles as can be in flight behind it and two more, while the others are willing.
/// Then all are let go at once; the second time at random, so that what leaves meets what enters in every way.
fn programme(plan: &Plan, interface: &Interface, held: &[&str], seed: u64) -> Vec<Vec<bool>> {
    // Cycles from one small triangle to the next, at the most; a unit alone gets fragments as fast as it takes them.
    let blend = if plan.blend.is_there() { plan.blend.queue + plan.blend.stages + 1 } else { 0 };
    let shadow = if plan.shadow.is_there() { plan.shadow.queue + divided(plan) } else { 0 };
    let places = (plan.inflight + blend + shadow) as usize;
    let (triangle, free) = if interface.unit == Unit::MACHINE {
        (longest_setup(plan).all() as usize + 8, 3 * (places + 4))
    } else {
        (2, places + 3)
    };
    let reads: Vec<&str> =
        interface.memories.iter().map(|memory| interface.links[memory.read].name).collect();
    let mut rows = Vec::new();
    for name in held {
        let triangles = if reads.contains(name) { BEFORE_DEPTH + shadow as usize } else { places + 2 };
        for at_random in [false, true] {
            let row: Vec<bool> = held.iter().map(|held| held != name).collect();
            rows.extend(std::iter::repeat_n(row, triangles * triangle));
            let random = held.iter().map(|held| mixed(seed, &format!("{name}/{held}"), free));
            let random: Vec<Vec<bool>> = random.collect();
            rows.extend((0..free).map(|n| random.iter().map(|willing| !at_random || willing[n]).collect()));
        }
    }
    rows
}

/// Fragments in PROJECT.
fn divided(plan: &Plan) -> u32 {
    match plan.shadow.project {
        _ if !plan.shadow.projects() => 0,
        Project::Pipelined => plan.shadow.rows() + 1,
        Project::Serial => 1,
    }
}

/// Random bytes that depend only on seed and link.
fn draws(seed: u64, link: &str, length: usize) -> Vec<u8> {
    (0u64..).flat_map(|block| Sha256::digest(format!("{seed}/{link}/{block}"))).take(length).collect()
}
