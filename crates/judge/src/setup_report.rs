//! What SETUP does with the triangles of a picture: its clocks, and what becomes of each.

use crate::occupancy::ratio;
use edgewalk_machine::{Plan, PortVertex, Role};
use edgewalk_model::setup::Setup;
use edgewalk_model::span::Span;
use edgewalk_model::tokens::{MAX_CHANNELS, Prim};
use edgewalk_model::walker::Walker;
use edgewalk_model::{Culled, Events, longest_setup};
use serde::{Serialize, Serializer};
use serde_json::{Map, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// What may become of a triangle, in JSON and in text.
const FATES: [(&str, &str); 5] = [
    ("culled_lines", "culled by lines"),
    ("culled_columns", "culled by columns"),
    ("culled_area", "culled by area"),
    ("without_pixel", "without a pixel"),
    ("drawn", "drawn"),
];

/// Sizes of triangles, and the least pixels of each; culled ones have 0.
const SIZES: [(&str, u64); 5] = [("0", 0), ("1-3", 1), ("4-15", 4), ("16-63", 16), ("64+", 64)];

/// Counts over triangles; a polygon counts as one, with the clocks of all its edges.
#[derive(Clone, Debug)]
pub struct SetupReport {
    /// How many took so many clocks, S1 + S2; without those that were culled.
    clocks: BTreeMap<u32, u64>,
    /// Clocks of all triangles, culled ones too.
    all_clocks: u64,
    fates: [u64; FATES.len()],
    sizes: [u64; SIZES.len()],
    /// What no triangle exceeds; none with POLY, where a polygon is any number of tokens.
    longest: Option<u32>,
}

impl SetupReport {
    /// Of all triangles, in SETUP one after the other.
    pub fn new(machine: &Plan, triangles: &[[PortVertex; 3]]) -> Self {
        let mut report = SetupReport::empty(machine);
        // Units of most channels serve any machine.
        let (mut setup, mut walker) = (Setup::<MAX_CHANNELS>::new(machine), Walker::new(machine));
        let mut clocks = 0;
        for triangle in triangles {
            let mut met = Events::default();
            let pixels = setup.run(triangle, &mut met).map(|prim| pixels(machine, &mut walker, &prim));
            clocks += setup.clocks().all();
            setup.step(None, true, false, &mut met); // EDGE or POLY takes it
            if !Role::of(triangle).ends() {
                continue;
            }
            let fate = match pixels {
                None if met.setup.culled_lines > 0 => 0,
                None if met.setup.culled_columns > 0 => 1,
                None => 2,
                Some(0) => 3,
                Some(_) => 4,
            };
            report.add(clocks, fate, pixels);
            clocks = 0;
        }
        report
    }

    /// Like `new`, of what is known already: of each triangle S1 + S2, why it was culled, and its pixels.
    pub fn of(machine: &Plan, triangles: impl Iterator<Item = (u32, Option<Culled>, u64)>) -> Self {
        let mut report = SetupReport::empty(machine);
        for (clocks, culled, pixels) in triangles {
            let fate = match culled {
                Some(Culled::Lines) => 0,
                Some(Culled::Columns) => 1,
                Some(Culled::Area) => 2,
                None if pixels == 0 => 3,
                None => 4,
            };
            report.add(clocks, fate, culled.is_none().then_some(pixels));
        }
        report
    }

    fn empty(machine: &Plan) -> Self {
        SetupReport {
            clocks: BTreeMap::new(),
            all_clocks: 0,
            fates: [0; FATES.len()],
            sizes: [0; SIZES.len()],
            longest: (!machine.polygon.is_there()).then(|| longest_setup(machine).all()),
        }
    }

    /// A triangle with its clocks, its fate, and its pixels if it was not culled.
    fn add(&mut self, clocks: u32, fate: usize, pixels: Option<u64>) {
        self.all_clocks += u64::from(clocks);
        self.fates[fate] += 1;
        if pixels.is_some() {
            *self.clocks.entry(clocks).or_default() += 1;
        }
        let reached = SIZES.iter().filter(|(_, least)| pixels.unwrap_or(0) >= *least).count();
        self.sizes[reached - 1] += 1; // all have 0 at least
    }

    /// Of the triangles that are not culled: mean, what 95 % do not exceed, most; 0 if there is none.
    fn spread(&self) -> (f64, u32, u32) {
        let count: u64 = self.clocks.values().sum();
        let sum: u64 = self.clocks.iter().map(|(clocks, count)| u64::from(*clocks) * count).sum();
        let mut seen = 0;
        let most_do = self.clocks.iter().find(|(_, count)| {
            seen += **count;
            100 * seen >= 95 * self.clocks.values().sum::<u64>()
        });
        let most = self.clocks.keys().next_back();
        (ratio(sum, count), most_do.map_or(0, |(clocks, _)| *clocks), most.copied().unwrap_or(0))
    }

    /// As three lines of text.
    #[must_use]
    pub fn lines(&self) -> String {
        let (mean, most_do, most) = self.spread();
        let mut t = format!(
            "setup clocks of a triangle that is not culled: mean {mean:.1}, 95 % at most {most_do}, most {most}, bound {}\n",
            self.longest.map_or_else(|| "none".to_owned(), |clocks| clocks.to_string())
        );
        let list = |names: &mut dyn Iterator<Item = &str>, counts: &[u64]| {
            names.zip(counts).map(|(name, count)| format!("{name} {count}")).collect::<Vec<_>>().join(", ")
        };
        // Writing to a string cannot fail.
        _ = writeln!(t, "triangles: {}", list(&mut FATES.iter().map(|fate| fate.1), &self.fates));
        _ = writeln!(t, "triangles by pixels: {}", list(&mut SIZES.iter().map(|size| size.0), &self.sizes));
        t
    }
}

impl Serialize for SetupReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let named = |names: &mut dyn Iterator<Item = &str>, counts: &[u64]| {
            names.zip(counts).map(|(name, count)| (name.to_owned(), json!(count))).collect::<Map<_, _>>()
        };
        let (mean, most_do, most) = self.spread();
        json!({
            "clocks": {
                "mean": mean,
                "p95": most_do,
                "most": most,
                "bound": self.longest,
                "mean_with_culled": ratio(self.all_clocks, self.fates.iter().sum()),
            },
            "triangles": named(&mut FATES.iter().map(|fate| fate.0), &self.fates),
            "by_pixels": named(&mut SIZES.iter().map(|size| size.0), &self.sizes),
        })
        .serialize(serializer)
    }
}

/// Pixels on the screen of all spans of a triangle, or of a polygon that ends here.
fn pixels(machine: &Plan, walker: &mut Walker<MAX_CHANNELS>, prim: &Prim<MAX_CHANNELS>) -> u64 {
    let (mut spans, events) = (Span::new(machine), &mut Events::default());
    loop {
        let taken = walker.prim_ready(Some(prim), false);
        walker.step(Some(prim), false, false, false, events);
        // Behind a sequenced SETUP a prim stays at the port while it is walked, and is taken behind the last line.
        if walker.running() || taken && !machine.is_sequenced() {
            break;
        }
    }
    let mut pixels = 0;
    while walker.running() {
        let Some(line) = walker.line().copied() else {
            walker.step(None, false, false, false, events);
            continue;
        };
        spans.step(Some(&line), false, false, events);
        spans.step(None, false, false, events); // from its register into the queue
        if let Some(span) = spans.span() {
            let (x, count) = (i64::from(span.x), i64::from(span.count));
            let (first, end) = if span.leftward { (x - count + 1, x + 1) } else { (x, x + count) };
            pixels += (end.min(i64::from(machine.width)) - first.max(0)).max(0) as u64;
            spans.step(None, true, false, events);
        }
        walker.step(None, false, true, false, events);
    }
    pixels
}
