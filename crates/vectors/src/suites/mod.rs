//! Stimuli as data: named suites of named cases of triangles at the machine's port.
//!
//! ```text
//!  hazards          pixels met again while in flight
//!  corners          degenerate and extreme shapes, quotients that are ties
//!  random           four kinds of triangles; number k depends only on (seed, suite, k)
//!  sphere           a small shaded mesh
//!  depth_never ..   a suite for each depth function, and one without depth writes
//!  blend_add ..     machines with BLEND: colours that are added, and colours that are not written
//!  light ..         machines with SHADOW: the corners of its map, and no map
//!  lines            machines whose port takes lines: every direction, the sides of the screen
//!  own_map ..       machines that draw their map: the ends of map and screen, in either pass
//!  dither           machines with DITHER: each place of its pattern, ends of colours, dropped fences
//!  shade            machines with SHADE: words at the ends of its tables, materials in turn
//! ```
//! A suite knows the formats of the machine, nothing of what it draws.

mod corners;
mod dither;
mod functions;
mod hazards;
pub mod input;
mod ladders;
mod light;
mod lines;
mod own_map;
mod pen;
mod polygon;
mod random;
mod shade;
mod sphere;
mod ties;
mod words;

pub use words::{Words, words};

use edgewalk_lockstep::{StallKind, Unit};
use edgewalk_machine::Unknown;
use edgewalk_machine::units;
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::DrawState;

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
    /// The rules it is drawn by; of `clear` nothing is used.
    pub state: DrawState,
    /// What the memories hold that nobody writes.
    pub words: Words,
    /// Under which stalls it shows what it is for.
    pub stalls: StallKind,
    /// The units that it says something about; all, if none is named.
    pub units: &'static [Unit],
    /// The cases, in order.
    pub cases: Vec<Case>,
}

/// A suite that comes with the program.
pub struct Entry {
    /// Name of the suite.
    pub name: &'static str,
    /// What it is for.
    pub about: &'static str,
    kind: Kind,
}

enum Kind {
    /// Directed or random triangles under `less`; the last two are the seed and the number of triangles wanted, used by
    /// `random` only.
    Shapes(StallKind, fn(&Plan, u64, u64) -> Vec<Case>),
    /// One drawing under this depth function, with or without depth writes.
    Function(u8, bool),
    /// The same drawing for BLEND: with or without colours written, added or mixed.
    Colors { color_write: bool, blend_add: bool },
    /// For SHADOW: its map at work or not.
    Light { shadow_on: bool },
    /// For machines whose port takes lines.
    Lines,
    /// For machines with POLY.
    Polygons(fn(&Plan) -> Vec<Case>),
    /// For machines that draw their map: in the light's pass or in the picture's.
    OwnMap { light_pass: bool },
    /// For DITHER: each place of its pattern.
    Dither,
    /// For TERM, TEXEL, NORMAL and SHADE: words of its own.
    Shade,
}

const fn shapes(
    name: &'static str,
    about: &'static str,
    stalls: StallKind,
    cases: fn(&Plan, u64, u64) -> Vec<Case>,
) -> Entry {
    Entry { name, about, kind: Kind::Shapes(stalls, cases) }
}

const fn function(name: &'static str, about: &'static str, depth_func: u8, depth_write: bool) -> Entry {
    Entry { name, about, kind: Kind::Function(depth_func, depth_write) }
}

impl Entry {
    /// Whether the suite says something about this machine.
    #[must_use]
    pub fn is_for(&self, machine: &Plan) -> bool {
        match self.kind {
            Kind::Colors { .. } => machine.blend.is_there(),
            Kind::Light { .. } => machine.shadow.is_there(),
            Kind::Lines => machine.polygon.has_lines(),
            Kind::Polygons(_) => machine.polygon.is_there(),
            Kind::OwnMap { .. } => machine.shadow.draws_map(),
            Kind::Dither => machine.dither.is_there(),
            Kind::Shade => machine.shade.is_there(),
            Kind::Shapes(..) | Kind::Function(..) => true,
        }
    }

    /// The unit, or the key, that a machine must have for the suite; none for a suite of every machine.
    #[must_use]
    pub fn needs(&self) -> Option<&'static str> {
        match self.kind {
            Kind::Colors { .. } => Some("BLEND"),
            Kind::Light { .. } => Some("SHADOW"),
            Kind::Lines => Some("polygon.lines"),
            Kind::Polygons(_) => Some("POLY"),
            Kind::OwnMap { .. } => Some("shadow.own_pass"),
            Kind::Dither => Some("DITHER"),
            Kind::Shade => Some("SHADE"),
            Kind::Shapes(..) | Kind::Function(..) => None,
        }
    }
}

/// Triangles of the suite `random`, at most: in PIXEL these take 6 GB on a screen of 640 x 480. Other seeds draw other ones.
pub const MAX_COUNT: u64 = 10_000;

/// The suites that come with the program.
pub const SUITES: [Entry; 24] = [
    shapes(
        "hazards",
        "pixels met again while they are in flight: one-pixel triangles on one address, knee lines drawn twice",
        StallKind::Late,
        |machine, _, _| hazards::cases(machine),
    ),
    shapes(
        "corners",
        "flat tops and bottoms, zero areas, knees on lines, shared edges, fans, slivers, the guard band, both sides, ties",
        StallKind::Late,
        |machine, _, _| corners::cases(machine),
    ),
    shapes(
        "random",
        "random triangles in turn: near the screen, tiny on a few pixels, thin across the guard band, upright through it",
        StallKind::Mixed,
        random::cases,
    ),
    shapes("sphere", "a small shaded ball before a wall", StallKind::None, |machine, _, _| {
        sphere::cases(machine)
    }),
    function("depth_never", "the depth function never, before half of full scale", 0, true),
    function("depth_less", "the depth function less, before half of full scale", 1, true),
    function("depth_equal", "the depth function equal, before half of full scale", 2, true),
    function("depth_lequal", "the depth function lequal, before half of full scale", 3, true),
    function("depth_greater", "the depth function greater, before half of full scale", 4, true),
    function("depth_notequal", "the depth function notequal, before half of full scale", 5, true),
    function("depth_gequal", "the depth function gequal, before half of full scale", 6, true),
    function("depth_always", "the depth function always, before half of full scale", 7, true),
    function("depth_unwritten", "depth_write = 0 under less, before half of full scale", 1, false),
    Entry {
        name: "blend_add",
        about: "colours are added, in machines with BLEND",
        kind: Kind::Colors { color_write: true, blend_add: true },
    },
    Entry {
        name: "color_unwritten",
        about: "color_write = 0: depths alone are written, in machines with BLEND",
        kind: Kind::Colors { color_write: false, blend_add: false },
    },
    Entry {
        name: "light",
        about: "a light's map: its corners and sides, depths exactly those of a texel, before and behind it, weights of any sign, in machines with SHADOW",
        kind: Kind::Light { shadow_on: true },
    },
    Entry {
        name: "light_off",
        about: "shadow_on = 0: all is lit, in machines with SHADOW",
        kind: Kind::Light { shadow_on: false },
    },
    Entry {
        name: "lines",
        about: "lines in every direction, on centres and between them, over each side of the screen and beside it, in machines whose port takes lines",
        kind: Kind::Lines,
    },
    Entry {
        name: "polygon",
        about: "polygons: convex, concave, crossing, with holes and several contours, beyond the screen, in turn with triangles, in machines with POLY",
        kind: Kind::Polygons(polygon::shapes),
    },
    Entry {
        name: "polygon_corners",
        about: "vertices on centres, edges on each other and beside the screen, gaps, windows, a full table and one too small, planes without area, in machines with POLY",
        kind: Kind::Polygons(polygon::corners),
    },
    Entry {
        name: "own_map",
        about: "light_pass = 1: what lies around the ends of the map and of the screen, in machines that draw their map",
        kind: Kind::OwnMap { light_pass: true },
    },
    Entry {
        name: "own_picture",
        about: "the same with light_pass = 0",
        kind: Kind::OwnMap { light_pass: false },
    },
    Entry {
        name: "dither",
        about: "each place of the pattern: colours at the ends of their range and between, k_t at and beyond each sixteenth, first fragments dropped, in machines with DITHER",
        kind: Kind::Dither,
    },
    Entry {
        name: "shade",
        about: "cosines at and beside the ends of the tables, normals of every length, textures that repeat, materials in turn, triangles that are culled between, in machines with SHADE",
        kind: Kind::Shade,
    },
];

impl Suite {
    /// The suite of that name for this machine; `random` has `count` triangles, the others are what they are.
    ///
    /// # Errors
    /// An unknown name.
    pub fn named(machine: &Plan, name: &str, seed: u64, count: u64) -> Result<Suite, Unknown> {
        let entry = SUITES.iter().find(|entry| entry.name == name);
        let entry =
            entry.ok_or_else(|| Unknown::new("suite", name, SUITES.iter().map(|entry| entry.name)))?;
        let mut plain = Suite { seed, ..Suite::of_triangles(name, entry.about, Vec::new()) };
        if machine.shadow.is_there() {
            // Every suite is drawn with the map at work, but for the one without.
            (plain.state.shadow_on, plain.state.ambient) = (true, machine.color.max() / 3);
        }
        let suite = match entry.kind {
            Kind::Shapes(stalls, cases) => Suite { stalls, cases: cases(machine, seed, count), ..plain },
            Kind::Function(depth_func, depth_write) => {
                let suite = Suite {
                    state: DrawState { depth_func, depth_write, ..plain.state },
                    stalls: StallKind::Late,
                    units: const { &[Unit::MACHINE, Unit::of(&units::depth::SPEC)] },
                    cases: functions::cases(machine),
                    ..plain
                };
                suite.on_half_depth(machine)
            }
            Kind::Colors { color_write, blend_add } => Suite {
                state: DrawState { color_write, blend_add, ..plain.state },
                stalls: StallKind::Late,
                // What is not written does not come to BLEND.
                units: match color_write {
                    true => {
                        const { &[Unit::MACHINE, Unit::of(&units::depth::SPEC), Unit::of(&units::blend::SPEC)] }
                    }
                    false => const { &[Unit::MACHINE, Unit::of(&units::depth::SPEC)] },
                },
                cases: hazards::cases(machine),
                ..plain
            },
            Kind::Light { shadow_on } => Suite {
                state: DrawState { shadow_on, depth_func: 7, ..plain.state },
                stalls: StallKind::Late,
                units: if machine.shadow.projects() {
                    const { &[Unit::MACHINE, Unit::of(&units::project::SPEC), Unit::of(&units::shadow::SPEC)] }
                } else {
                    const { &[Unit::MACHINE, Unit::of(&units::shadow::SPEC)] }
                },
                cases: light::cases(machine),
                ..plain
            },
            Kind::Lines => Suite { stalls: StallKind::Mixed, cases: lines::cases(machine), ..plain },
            Kind::Polygons(cases) => Suite { stalls: StallKind::Mixed, cases: cases(machine), ..plain },
            Kind::OwnMap { light_pass } => Suite {
                state: DrawState { light_pass, ..plain.state },
                clear_z: light_pass.then_some((1 << machine.shadow.depth_bits) - 1),
                stalls: StallKind::Late,
                units: const {
                    &[
                        Unit::MACHINE,
                        Unit::of(&units::setup::SPEC),
                        Unit::of(&units::span::SPEC),
                        Unit::of(&units::pixel::SPEC),
                        Unit::of(&units::shadow::SPEC),
                    ]
                },
                cases: own_map::cases(machine),
                ..plain
            },
            Kind::Dither => Suite {
                stalls: StallKind::Mixed,
                units: const { &[Unit::MACHINE, Unit::of(&units::dither::SPEC), Unit::of(&units::depth::SPEC)] },
                cases: dither::cases(machine),
                ..plain
            },
            Kind::Shade => {
                let (cases, records) = shade::cases(machine);
                let words = words::with_records(machine, seed, &records);
                return Ok(Suite { stalls: StallKind::Mixed, cases, words, ..plain });
            }
        };
        Ok(Suite { words: words(machine, seed, suite.triangles().count()), ..suite })
    }

    /// A suite of one case under `less`: triangles from elsewhere.
    #[must_use]
    pub fn of_triangles(name: &str, about: &str, triangles: Vec<Triangle>) -> Suite {
        let case = Case { name: name.to_owned(), triangles };
        Suite {
            name: name.to_owned(),
            about: about.to_owned(),
            seed: 0,
            clear_z: None,
            state: DrawState::default(),
            words: Words::new(),
            stalls: StallKind::Mixed,
            units: &[],
            cases: vec![case],
        }
    }

    /// Whether the suite says something about the unit.
    #[must_use]
    pub fn is_for(&self, unit: Unit) -> bool {
        self.units.is_empty() || self.units.contains(&unit)
    }

    /// One suite after the other, as one.
    #[must_use]
    pub fn joined(name: &str, about: &str, suites: impl IntoIterator<Item = Suite>) -> Suite {
        let mut joined = Suite { cases: Vec::new(), ..Suite::of_triangles(name, about, Vec::new()) };
        for suite in suites {
            joined.seed = joined.seed.max(suite.seed);
            // The light is the machine's, and so are tables; a record is a triangle's.
            let DrawState { shadow_on, light_pass, ambient, .. } = suite.state;
            joined.state = DrawState { shadow_on, light_pass, ambient, ..joined.state };
            for (memory, words) in suite.words {
                match joined.words.get_mut(memory) {
                    Some(before) if memory == words::RECORDS => {
                        *before = before.iter().chain(words.iter()).copied().collect();
                    }
                    _ => _ = joined.words.insert(memory, words),
                }
            }
            joined.cases.extend(suite.cases);
        }
        joined
    }

    /// The cases of these names alone, with the records of their triangles, in the suite's order.
    #[must_use]
    pub fn only(mut self, names: &[String]) -> Suite {
        let wanted = |case: &Case| names.contains(&case.name);
        if let Some(records) = self.words.get(words::RECORDS) {
            let each = (records.len() / self.triangles().count().max(1)).max(1);
            let of = self.cases.iter().flat_map(|case| case.triangles.iter().map(|_| wanted(case)));
            let kept = records.chunks(each).zip(of).filter(|(_, wanted)| *wanted);
            let kept: Vec<u128> = kept.flat_map(|(record, _)| record.iter().copied()).collect();
            self.words.insert(words::RECORDS, kept.into());
        }
        self.cases.retain(wanted);
        self
    }

    /// The suite on a depth of half of full scale instead of full scale: then `greater` passes too.
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
