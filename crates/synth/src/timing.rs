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
    /// Wires of the path in order, from the output of the first register to the last register, each change of name once.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// As nextpnr-ice40 0.4 writes it, shortened.
    const REPORT: &str = r#"{"critical_paths": [
        {"from": "<async>", "path": [], "to": "posedge clk$SB_IO_IN_$glb_clk"},
        {"from": "posedge clk$SB_IO_IN_$glb_clk", "path": [
            {"delay": 0.5, "from": {"cell": "a", "loc": [7, 3], "port": "CLK"},
             "to": {"cell": "dut.u_edge.minor_c_SB_DFFE_Q_DFFLC", "loc": [6, 3], "port": "O"}, "type": "clk-to-q"},
            {"budget": 0, "delay": 1.0, "from": {"cell": "b", "port": "O"}, "net": "dut.u_edge.minor_c[0]",
             "to": {"cell": "$nextpnr_ICESTORM_LC_3", "port": "I1"}, "type": "routing"},
            {"delay": 0.25, "from": {"cell": "c", "port": "I1"}, "to": {"cell": "$nextpnr_ICESTORM_LC_3", "port": "COUT"}, "type": "logic"},
            {"budget": 0, "delay": 0, "from": {"cell": "c", "port": "COUT"}, "net": "$nextpnr_ICESTORM_LC_3$O",
             "to": {"cell": "dut.u_span.line_ready_SB_LUT4_O_LC", "port": "I3"}, "type": "routing"},
            {"delay": 0.25, "from": {"cell": "d", "port": "I3"}, "to": {"cell": "d", "port": "O"}, "type": "logic"},
            {"budget": 0, "delay": 2.0, "from": {"cell": "d", "port": "O"}, "net": "dut.u_span.line_ready_SB_LUT4_O_I0[1]",
             "to": {"cell": "dut.u_edge.n_SB_DFFE_Q_1_DFFLC", "port": "CEN"}, "type": "routing"},
            {"delay": 0.125, "from": {"cell": "e", "port": "CEN"},
             "to": {"cell": "dut.u_edge.n_SB_DFFE_Q_1_DFFLC", "port": "CEN"}, "type": "setup"}],
         "to": "posedge clk$SB_IO_IN_$glb_clk"}],
        "fmax": {"clk$SB_IO_IN_$glb_clk": {"achieved": 242.42, "constraint": 12}}, "utilization": {}}"#;

    #[test]
    fn a_path_is_told_by_names() {
        let Timing { mhz, path } = timing(4, REPORT).expect("JSON").expect("a path");
        let points: Vec<(&str, f64)> =
            path.points.iter().map(|point| (point.name.as_str(), point.ns)).collect();
        assert_eq!(points, [("edge.minor_c", 0.5), ("span.line_ready", 2.0), ("edge.n", 4.125)]);
        assert_eq!((mhz, path.seed, path.lut4, path.carry), (242.42, 4, 1, 1));
        assert_eq!((path.logic_ns, path.routing_ns), (1.125, 3.0));
    }

    #[test]
    fn no_path_is_no_clock() {
        let none = r#"{"critical_paths": [], "fmax": {}, "utilization": {}}"#;
        assert!(timing(1, none).expect("JSON").is_none());
        assert!(timing(1, "Warning").is_err());
    }
}
