//! Where the cycles went over the screen and by size of triangle, datapath and memory alone, and the ranges of numbers.

use crate::occupancy::ratio;
use edgewalk_machine::{Activity, Plan};
use edgewalk_model::profile::{Causes, PortClocks, Profile, Range, SIZES, Spent};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// The most bands of lines that the screen is divided into.
const BANDS: usize = 16;

/// A profile as a part of a report.
#[derive(Clone)]
pub struct Profiled {
    profile: Profile,
    causes: Vec<Activity>,
}

impl Profiled {
    /// Of a picture that this machine drew.
    #[must_use]
    pub fn new(machine: &Plan, profile: Profile) -> Self {
        Profiled { profile, causes: Activity::of(machine).collect() }
    }

    /// Cycles as an object of causes.
    fn by_cause(&self, spent: &Spent) -> Value {
        self.causes.iter().map(|cause| (cause.name().to_owned(), json!(spent[*cause as usize]))).collect()
    }

    fn json(&self) -> Value {
        let Profile { causes, roofline } = &self.profile;
        let ports = roofline.ports.iter().map(
            |PortClocks { memory, port, clocks }| json!({ "memory": memory, "port": port, "clocks": clocks }),
        );
        let bands = bands(causes)
            .into_iter()
            .map(|(from, to, spent)| json!({ "from": from, "to": to, "by_cause": self.by_cause(&spent) }));
        let sizes = sizes(causes).map(|(pixels, count, spent)| {
            json!({ "pixels": pixels, "triangles": count, "by_cause": self.by_cause(spent) })
        });
        json!({
            "roofline": {
                "cycles": roofline.cycles,
                "datapath": roofline.datapath,
                "memory": roofline.memory(),
                "binds": if roofline.memory_binds() { "memory" } else { "datapath" },
                "ports": ports.collect::<Vec<_>>(),
                "windows": roofline.windows.len(),
                "windows_of_memory": roofline.windows_of_memory(),
                "expected": roofline.expected(1.0, 1.0),
                "expected_memory_twice_as_fast": roofline.expected(1.0, 0.5),
                "expected_datapath_twice_as_fast": roofline.expected(0.5, 1.0),
            },
            "lines": bands.collect::<Vec<_>>(),
            "sizes": sizes.collect::<Vec<_>>(),
            "behind": self.by_cause(&causes.behind),
        })
    }

    /// As lines of text.
    pub(super) fn lines(&self) -> String {
        let Profile { causes, roofline } = &self.profile;
        let binds = match roofline.busiest().filter(|_| roofline.memory_binds()) {
            Some(PortClocks { memory, port, .. }) => format!("memory {memory}, port {port}"),
            None => "the datapath".to_owned(),
        };
        let mut t = format!("roofline: {binds} binds; {} cycles\n", roofline.cycles);
        // Writing to a string cannot fail.
        let mut line = |name: &str, cycles: f64| {
            let share = 100.0 * cycles / roofline.cycles.max(1) as f64;
            _ = writeln!(t, "    {name:<40} {cycles:>12.0}  {share:>5.1} %");
        };
        line("datapath alone", roofline.datapath as f64);
        for PortClocks { memory, port, clocks } in &roofline.ports {
            line(&format!("memory {memory} alone, {port}"), *clocks as f64);
        }
        line("expected from these, window by window", roofline.expected(1.0, 1.0));
        line("expected, memory twice as fast", roofline.expected(1.0, 0.5));
        line("expected, datapath twice as fast", roofline.expected(0.5, 1.0));
        let total = |cause: &Activity| {
            let lines = causes.lines.iter().chain([&causes.behind]);
            lines.map(|spent| spent[*cause as usize]).sum::<u64>() > 0
        };
        let met: Vec<&Activity> = self.causes.iter().filter(|cause| total(cause)).collect();
        let head: String = met.iter().map(|cause| format!("{:>10}", cause.name())).collect();
        let row = |spent: &Spent| {
            let all: u64 = spent.iter().sum();
            let share = |cause: &&Activity| format!("{:>8.1} %", 100.0 * ratio(spent[**cause as usize], all));
            format!("{all:>12}{}", met.iter().map(share).collect::<String>())
        };
        _ = writeln!(t, "{:<24}{:>12}{head}", "cycles over the screen", "cycles");
        for (from, to, spent) in bands(causes) {
            _ = writeln!(t, "    {:<20}{}", format!("lines {from} to {to}"), row(&spent));
        }
        _ = writeln!(t, "    {:<20}{}", "behind the last span", row(&causes.behind));
        _ = writeln!(t, "{:<24}{:>12}{head}", "triangles by pixels", "cycles");
        for (pixels, count, spent) in sizes(causes) {
            _ = writeln!(t, "    {:<20}{}", format!("{pixels}: {count}"), row(spent));
        }
        t
    }
}

impl Serialize for Profiled {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.json().serialize(serializer)
    }
}

/// First and last line of each band, and its cycles.
fn bands(causes: &Causes) -> Vec<(usize, usize, Spent)> {
    let height = causes.lines.len().div_ceil(BANDS).max(1);
    let band = |(place, lines): (usize, &[Spent])| {
        let mut sum = Spent::default();
        lines.iter().for_each(|line| sum.iter_mut().zip(line).for_each(|(sum, line)| *sum += line));
        (place * height, place * height + lines.len() - 1, sum)
    };
    causes.lines.chunks(height).enumerate().map(band).collect()
}

/// Sizes of triangles in words, with how many there are and their cycles.
fn sizes(causes: &Causes) -> impl Iterator<Item = (String, u64, &Spent)> {
    causes.sizes.iter().enumerate().map(|(place, (count, spent))| {
        let pixels = match (SIZES[place], SIZES.get(place + 1)) {
            (least, None) => format!("{least}+"),
            (least, Some(next)) if least + 1 == *next => least.to_string(),
            (least, Some(next)) => format!("{least}-{}", next - 1),
        };
        (pixels, *count, spent)
    })
}

/// The range of a number as a part of a report.
#[derive(Clone)]
pub struct Ranged(Range);

impl From<Range> for Ranged {
    fn from(range: Range) -> Self {
        Ranged(range)
    }
}

impl Serialize for Ranged {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Range { unit, name, bits, fraction, signed, modular, least, greatest } = &self.0;
        let value = json!({
            "unit": unit,
            "name": name,
            "bits": bits,
            "fraction": fraction,
            "signed": signed,
            "modular": modular,
            "least": least,
            "greatest": greatest,
            "needed": self.0.needed(),
            "spare": self.0.spare(),
        });
        value.serialize(serializer)
    }
}

/// As a table of text: numbers with bits to spare.
pub(super) fn table(ranges: &[Ranged]) -> String {
    if ranges.is_empty() {
        return String::new();
    }
    let spare: Vec<&Range> =
        ranges.iter().map(|Ranged(range)| range).filter(|range| range.spare() > 0).collect();
    let mut t = format!("ranges: {} of {} numbers have bits to spare\n", spare.len(), ranges.len());
    for range in spare {
        let Range { unit, name, bits, least, greatest, modular, .. } = range;
        let modular = if *modular { ", modular" } else { "" };
        // Writing to a string cannot fail.
        _ = writeln!(
            t,
            "    {:<32} {bits:>3} bits, {:>3} to spare: {least} to {greatest}{modular}",
            format!("{unit} {name}"),
            range.spare()
        );
    }
    t
}
