//! Stimuli as data: named suites of named cases of triangles at the machine's port.
//!
//! ```text
//!  hazards   pixels met again while in flight
//!  corners   degenerate and extreme shapes
//!  random    four kinds of triangles; number k depends only on (seed, suite, k)
//!  sphere    a small shaded mesh
//! ```
//! A suite knows the formats of the machine, nothing of what it draws.

mod corners;
mod hazards;
mod pen;
mod random;
mod sphere;

use edgewalk_machine::nearest::nearest;
use edgewalk_machine::{Plan, PortVertex};

/// A triangle at the port.
pub type Triangle = [PortVertex; 3];

/// A few triangles that show one thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// What they show, in words joined by `_`.
    pub name: String,
    /// The triangles, in order.
    pub triangles: Vec<Triangle>,
}

/// Cases that are drawn one after the other onto one cleared screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suite {
    /// Name of the directory.
    pub name: String,
    /// What it is for.
    pub about: String,
    /// Seed of whatever is random in it.
    pub seed: u64,
    /// Every stored depth at the start, LSB; the largest if `None`.
    pub clear_z: Option<u64>,
    /// The cases, in order.
    pub cases: Vec<Case>,
}

/// A suite that comes with the program.
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it is for.
    pub about: &'static str,
    /// Makes its cases; the last two are the seed and the number of triangles wanted, used by `random` only.
    cases: fn(&Plan, u64, u64) -> Vec<Case>,
}

/// The suites that come with the program.
pub const SUITES: [Entry; 4] = [
    Entry {
        name: "hazards",
        about: "pixels met again while they are in flight: one-pixel triangles on one address, knee lines drawn twice",
        cases: |machine, _, _| hazards::cases(machine),
    },
    Entry {
        name: "corners",
        about: "flat tops and bottoms, zero areas, knees on lines, shared edges, fans, slivers, the guard band, both sides",
        cases: |machine, _, _| corners::cases(machine),
    },
    Entry {
        name: "random",
        about: "random triangles in turn: near the screen, tiny on a few pixels, thin across the guard band, upright through it",
        cases: random::cases,
    },
    Entry {
        name: "sphere",
        about: "a small shaded ball before a wall",
        cases: |machine, _, _| sphere::cases(machine),
    },
];

/// No suite of that name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown suite {name}; nearest: {nearest}")]
pub struct UnknownSuite {
    /// What was asked for.
    pub name: String,
    /// The most similar name there is.
    pub nearest: &'static str,
}

impl Suite {
    /// The suite of that name for this machine; `random` has `count` triangles, the others are what they are.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(machine: &Plan, name: &str, seed: u64, count: u64) -> Result<Suite, UnknownSuite> {
        let entry = SUITES.iter().find(|entry| entry.name == name).ok_or_else(|| UnknownSuite {
            name: name.to_owned(),
            nearest: nearest(name, SUITES.iter().map(|entry| entry.name)),
        })?;
        Ok(Suite {
            name: name.to_owned(),
            about: entry.about.to_owned(),
            seed,
            clear_z: None,
            cases: (entry.cases)(machine, seed, count),
        })
    }

    /// A suite of one case: triangles from elsewhere.
    #[must_use]
    pub fn of_triangles(name: &str, about: &str, triangles: Vec<Triangle>) -> Suite {
        let case = Case { name: name.to_owned(), triangles };
        Suite { name: name.to_owned(), about: about.to_owned(), seed: 0, clear_z: None, cases: vec![case] }
    }

    /// One suite after the other, as one.
    #[must_use]
    pub fn joined(name: &str, about: &str, suites: impl IntoIterator<Item = Suite>) -> Suite {
        let mut joined = Suite { cases: Vec::new(), ..Suite::of_triangles(name, about, Vec::new()) };
        for suite in suites {
            joined.seed = joined.seed.max(suite.seed);
            joined.cases.extend(suite.cases);
        }
        joined
    }

    /// The same on a depth of half of full scale instead of full scale: then `greater` passes too.
    #[must_use]
    pub fn on_half_depth(self, machine: &Plan) -> Suite {
        Suite { clear_z: Some(machine.z.max().div_ceil(2)), ..self }
    }

    /// All triangles, in order.
    pub fn triangles(&self) -> impl Iterator<Item = &Triangle> {
        self.cases.iter().flat_map(|case| &case.triangles)
    }

    /// The case that a triangle belongs to, by the triangle's number.
    #[must_use]
    pub fn case_of(&self, triangle: usize) -> Option<&Case> {
        let mut first = 0;
        self.cases.iter().find(|case| {
            first += case.triangles.len();
            triangle < first
        })
    }
}
