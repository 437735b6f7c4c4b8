//! What nextpnr finds after routing: the clock that the design can have, and the path that forbids a faster one.

use crate::names::named_after;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The longest path from register to register.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CriticalPath {
    /// The seed it is of.
    pub seed: u32,
    /// Nanoseconds in cells: from the clock to the first register's output, through cells, and before the last clock.
    pub logic_ns: f64,
    /// Nanoseconds in wires.
    pub routing_ns: f64,
    /// Look-up tables it goes through.
    pub lut4: usize,
    /// Bits of carry it goes through.
    pub carry: usize,
    /// Its wires in order, from the output of the first register to the last register, each change of name once.
    pub points: Vec<Point>,
}

/// A place on it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// The wire or register, `unit.name`; for a wire that nobody has named, the one it was named after.
    pub name: String,
    /// Nanoseconds from the clock to here.
    pub ns: f64,
}

/// What a seed gives.
pub(crate) struct Timing {
    pub mhz: f64,
    pub path: CriticalPath,
}

#[derive(Deserialize)]
struct Report {
    fmax: BTreeMap<String, Clock>,
    critical_paths: Vec<Path>,
}

#[derive(Deserialize)]
struct Clock {
    achieved: f64,
}

#[derive(Deserialize)]
struct Path {
    from: String,
    to: String,
    path: Vec<Segment>,
}

#[derive(Deserialize)]
struct Segment {
    r#type: String,
    delay: f64,
    net: Option<String>,
    to: Pin,
}

#[derive(Deserialize)]
struct Pin {
    cell: String,
    port: String,
}

/// From the report of nextpnr; `None` if no path in it runs from register to register.
pub(crate) fn timing(seed: u32, report: &str) -> serde_json::Result<Option<Timing>> {
    let report: Report = serde_json::from_str(report)?;
    // There is one clock; pins are in other paths.
    let mhz = report.fmax.values().map(|clock| clock.achieved).min_by(f64::total_cmp);
    let path =
        report.critical_paths.iter().find(|path| path.from == path.to && path.from.starts_with("posedge"));
    Ok(mhz.zip(path).map(|(mhz, path)| Timing { mhz, path: summary(seed, &path.path) }))
}

fn summary(seed: u32, segments: &[Segment]) -> CriticalPath {
    let total = |routing: bool| {
        let of = segments.iter().filter(|segment| (segment.r#type == "routing") == routing);
        of.map(|segment| segment.delay).sum()
    };
    let through = |ports: &[&str]| {
        let logic = segments.iter().filter(|segment| segment.r#type == "logic");
        logic.filter(|segment| ports.contains(&segment.to.port.as_str())).count()
    };
    let mut points: Vec<Point> = Vec::new();
    let mut ns = 0.0;
    let mut reach = |name: Option<String>, ns: f64| {
        if let Some(name) = name.filter(|name| points.last().is_none_or(|last| last.name != *name)) {
            points.push(Point { name, ns });
        }
    };
    for segment in segments {
        // A wire is reached where its driver is, before its own delay.
        reach(segment.net.as_deref().and_then(named_after), ns);
        ns += segment.delay;
    }
    reach(segments.last().and_then(|last| named_after(&last.to.cell)), ns);
    CriticalPath {
        seed,
        logic_ns: total(false),
        routing_ns: total(true),
        lut4: through(&["O", "F", "OFX"]),
        carry: through(&["COUT", "FCO"]),
        points,
    }
}
