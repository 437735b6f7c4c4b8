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
    /// Names of the path in order, from the output of the first register to the cell with the last register. Side by side no
    /// name stands twice. The last is the end, at the time of the whole path.
    pub points: Vec<Point>,
}

/// A place on it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// The wire or register, `unit.name`; for a wire that nobody has named, the one it was named after.
    pub name: String,
    /// Nanoseconds from the clock to where the path last meets the name, before another one.
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
    let mut reach = |name: String, ns: f64| match points.last_mut() {
        Some(last) if last.name == name => last.ns = ns,
        _ => points.push(Point { name, ns }),
    };
    for segment in segments {
        // A wire is reached where its driver is, before its own delay.
        segment.net.as_deref().and_then(named_after).into_iter().for_each(|name| reach(name, ns));
        ns += segment.delay;
    }
    if let Some(Segment { to: Pin { cell, .. }, .. }) = segments.last() {
        reach(named_after(cell).unwrap_or_else(|| cell.clone()), ns);
    }
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

    /// A comparison whose carry bears the name of its result: nextpnr packs the result's table with the register behind it.
    #[test]
    fn a_name_has_its_last_time() {
        let segment = |kind: &str, delay: f64, net: Option<&str>, cell: &str| Segment {
            r#type: kind.to_owned(),
            delay,
            net: net.map(str::to_owned),
            to: Pin { cell: cell.to_owned(), port: "I3".to_owned() },
        };
        let carry = "dut.outside_SB_LUT4_O_I3_SB_CARRY_CO_LC";
        let mut path = vec![
            segment("clk-to-q", 0.5, None, "harness_in_line_cmaj_SB_DFF_Q_DFFLC"),
            segment("routing", 1.5, Some("harness_in_line_cmaj[0]"), carry),
            segment("routing", 8.0, Some("dut.outside_SB_LUT4_O_I3[1]"), carry),
            segment("routing", 4.0, Some("dut.outside_SB_LUT4_O_I3[2]"), "dut.outside_SB_LUT4_O_LC"),
            segment("setup", 0.25, None, "dut.outside_SB_LUT4_O_LC"),
        ];
        let points = |path: &[Segment]| -> Vec<(String, f64)> {
            summary(1, path).points.into_iter().map(|point| (point.name, point.ns)).collect()
        };
        let named = |names: &[(&str, f64)]| -> Vec<(String, f64)> {
            names.iter().map(|(name, ns)| ((*name).to_owned(), *ns)).collect()
        };
        assert_eq!(points(&path), named(&[("input line_cmaj", 0.5), ("outside", 14.25)]));

        // The end is there whatever the tools call its cell.
        path.push(segment("setup", 0.25, None, "$nextpnr_ICESTORM_LC_3"));
        let end = ("$nextpnr_ICESTORM_LC_3", 14.5);
        assert_eq!(points(&path), named(&[("input line_cmaj", 0.5), ("outside", 10.0), end]));
    }

    #[test]
    fn no_path_is_no_clock() {
        let none = r#"{"critical_paths": [], "fmax": {}, "utilization": {}}"#;
        assert!(timing(1, none).expect("JSON").is_none());
        assert!(timing(1, "Warning").is_err());
    }
}
