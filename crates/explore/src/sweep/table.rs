//! The rows of a sweep as a table: bests, fronts, CSV.

use super::front::fronts;
use super::objective::Objective;
use super::point::Sweep;
use super::row::{Status, causes};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Rows in the order of the points, and what is best among them.
pub struct Table<'t> {
    /// The sweep.
    pub sweep: &'t Sweep,
    /// A row for each point that has one.
    pub rows: Vec<&'t Value>,
    /// Machines that were drawn on every input.
    pub machines: Vec<Candidate<'t>>,
}

/// A machine with a memory's behaviour, on all inputs.
pub struct Candidate<'t> {
    /// Its rows, one an input.
    pub rows: Vec<&'t Value>,
    /// The value of each objective, if all are known.
    pub values: Option<Vec<f64>>,
    /// Which front it lies on, 1 the best; none where a value is not known.
    pub front: Option<u32>,
}

impl<'t> Table<'t> {
    /// Of the rows that belong to the sweep.
    #[must_use]
    pub fn new(sweep: &'t Sweep, all: &'t BTreeMap<String, Value>) -> Self {
        let rows: Vec<&Value> = sweep.points.iter().filter_map(|point| all.get(&point.key)).collect();
        let mut groups: BTreeMap<(&str, &str), Vec<&Value>> = BTreeMap::new();
        let mut order = Vec::new();
        for row in &rows {
            let of = (text(row, "machine"), text(row, "stalls"));
            if !groups.contains_key(&of) {
                order.push(of);
            }
            groups.entry(of).or_default().push(row);
        }
        let mut machines: Vec<Candidate> = Vec::new();
        for of in order {
            let rows = groups.remove(&of).unwrap_or_default();
            let whole = rows.len() == sweep.inputs.len() && rows.iter().all(|row| is_ok(row));
            let values = sweep.objectives.iter().map(|objective| objective.of_all(&rows));
            let values = if whole { values.collect() } else { None };
            machines.push(Candidate { rows, values, front: None });
        }
        let known: Vec<usize> = (0..machines.len()).filter(|i| machines[*i].values.is_some()).collect();
        let costs: Vec<Vec<f64>> = known
            .iter()
            .filter_map(|i| machines[*i].values.as_ref())
            .map(|values| values.iter().zip(&sweep.objectives).map(|(v, o)| o.cost(*v)).collect())
            .collect();
        for (machine, front) in known.into_iter().zip(fronts(&costs)) {
            machines[machine].front = Some(front);
        }
        Table { sweep, rows, machines }
    }

    /// The best machine for an objective: of equals the one that is better in the next objectives, then the first.
    #[must_use]
    pub fn best(&self, objective: &Objective) -> Option<&Candidate<'t>> {
        let place = self.sweep.objectives.iter().position(|other| other == objective)?;
        let costs = |candidate: &Candidate| -> Option<Vec<f64>> {
            let values = candidate.values.as_ref()?;
            let mut costs: Vec<f64> =
                values.iter().zip(&self.sweep.objectives).map(|(v, o)| o.cost(*v)).collect();
            let first = costs.remove(place);
            costs.insert(0, first);
            Some(costs)
        };
        let known = self.machines.iter().filter_map(|machine| Some((costs(machine)?, machine)));
        let best = known.min_by(|(a, _), (b, _)| {
            let pairs = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
            pairs.into_iter().find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
        });
        best.map(|(_, machine)| machine)
    }

    /// How many rows have each status.
    #[must_use]
    pub fn counts(&self) -> [(Status, usize); 5] {
        Status::ALL
            .map(|status| (status, self.rows.iter().filter(|row| row["status"] == status.name()).count()))
    }

    /// The front of each row's machine, by the row's key.
    #[must_use]
    pub fn front_of(&self) -> BTreeMap<&str, u32> {
        let machines = self.machines.iter().filter_map(|machine| Some((machine, machine.front?)));
        machines
            .flat_map(|(machine, front)| machine.rows.iter().map(move |row| (text(row, "key"), front)))
            .collect()
    }

    /// All rows as CSV with a header.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut columns: Vec<(String, String)> = [
            "key",
            "status",
            "reason",
            "input",
            "input_hash",
            "machine",
            "stalls",
            "version",
            "verdict",
            "seconds",
        ]
        .map(|name| (name.to_owned(), format!("/{name}")))
        .into();
        let mut names: Vec<&str> = Vec::new();
        for row in &self.rows {
            for name in row["keys"].as_object().into_iter().flatten().map(|(name, _)| name) {
                if !names.contains(&name.as_str()) {
                    names.push(name);
                }
            }
        }
        columns.extend(names.into_iter().map(|name| (name.to_owned(), format!("/keys/{name}"))));
        columns.extend(figures());
        let fronts = self.front_of();
        let mut csv = String::new();
        let header: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).chain(["front"]).collect();
        // Writing to a string cannot fail.
        _ = writeln!(csv, "{}", header.join(","));
        for row in &self.rows {
            let mut line: Vec<String> =
                columns.iter().map(|(_, pointer)| field(row.pointer(pointer))).collect();
            line.push(fronts.get(text(row, "key")).map_or_else(String::new, ToString::to_string));
            _ = writeln!(csv, "{}", line.join(","));
        }
        csv
    }
}

/// Columns of figures, and where a row has them.
#[must_use]
pub fn figures() -> Vec<(String, String)> {
    let mut columns: Vec<(String, String)> = [
        ("cycles", "cycles/total"),
        ("path", "cycles/path"),
        ("pixels_per_clock", "cycles/pixels_per_clock"),
        ("triangles", "triangles"),
        ("fragments", "fragments"),
        ("writes", "writes"),
        ("setup_mean", "setup/clocks/mean"),
        ("setup_p95", "setup/clocks/p95"),
        ("setup_most", "setup/clocks/most"),
        ("span_fifo", "occupancy/span_fifo/mean"),
        ("inflight", "occupancy/inflight/mean"),
        ("lanes", "occupancy/lanes/mean"),
        ("covered", "comparison/covered"),
        ("coverage_mismatches", "comparison/coverage_mismatches"),
        ("order_undecided", "comparison/order_undecided"),
        ("order_wrong", "comparison/order_wrong"),
        ("wrapped", "comparison/wrapped"),
        ("additions", "comparison/additions"),
    ]
    .map(|(name, at)| (name.to_owned(), format!("/report/{at}")))
    .into();
    columns.extend(
        causes().map(|cause| (format!("cycles_{cause}"), format!("/report/cycles/by_cause/{cause}"))),
    );
    for channel in ["z", "color"] {
        for figure in ["error", "bound", "bound_for_input"] {
            columns.push((format!("{channel}_{figure}"), format!("/report/comparison/{channel}_{figure}")));
        }
        for figure in ["mean", "p99", "bias"] {
            columns.push((
                format!("{channel}_{figure}"),
                format!("/report/comparison/{channel}_spread/{figure}"),
            ));
        }
        columns.push((format!("{channel}_slack"), format!("/slack/{channel}")));
    }
    for figure in ["lut4", "carry", "ff", "ram", "dsp"] {
        columns.push((figure.to_owned(), format!("/synth/cells/{figure}")));
    }
    for figure in ["median", "min", "max"] {
        columns.push((format!("mhz_{figure}"), format!("/synth/mhz/{figure}")));
    }
    columns.push(("synth_reasons".to_owned(), "/synth/reasons".to_owned()));
    for figure in [
        "word_bits",
        "frames_per_s",
        "mpixels_per_s",
        "mtriangles_per_s",
        "mpixels_per_s_per_lut",
        "mtriangles_per_s_per_lut",
    ] {
        columns.push((figure.to_owned(), format!("/derived/{figure}")));
    }
    columns
}

fn is_ok(row: &Value) -> bool {
    row["status"] == Status::Ok.name()
}

fn text<'v>(row: &'v Value, name: &str) -> &'v str {
    row[name].as_str().unwrap_or_default()
}

/// A field of a CSV file; what is not known is empty.
fn field(value: Option<&Value>) -> String {
    let text = match value {
        None | Some(Value::Null) => return String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Array(list)) => list
            .iter()
            .map(|item| item.as_str().map_or_else(|| item.to_string(), str::to_owned))
            .collect::<Vec<_>>()
            .join("; "),
        Some(other) => other.to_string(),
    };
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}
