//! Whether a row can be what this program wrote of its point: rows come back from files that others may have changed.

use super::grid::Sweep;
use super::point::Point;
use super::row::{Status, derived, identity, slack};
use serde_json::Value;
use std::collections::BTreeMap;

/// Checks the rows that belong to the sweep; those of other sweeps in the same file are passed over.
///
/// # Errors
/// The first row that this program cannot have written, and why.
pub fn check(sweep: &Sweep, rows: &BTreeMap<String, Value>) -> Result<(), String> {
    sweep.points.iter().filter_map(|point| Some((point, rows.get(&point.key)?))).try_for_each(
        |(point, row)| {
            of_point(sweep, point, row)
                .map_err(|why| format!("row {}: {why}; remove its line and run the point again", point.key))
        },
    )
}

fn of_point(sweep: &Sweep, point: &Point, row: &Value) -> Result<(), String> {
    for (name, own) in identity(sweep, point).as_object().into_iter().flatten() {
        if name != "status" && row[name] != *own {
            return Err(format!("{name} is {}, where a row with this key has {own}", row[name]));
        }
    }
    let status = Status::of(row);
    if status != Some(Status::Ok) && !row["reason"].is_string() {
        return Err(format!("status {} without a reason", row["status"]));
    }
    match (status, &point.plan) {
        (Some(Status::Ok), Err(why)) => Err(format!("status ok, but the machine cannot be built: {why}")),
        (Some(Status::Ok), Ok(_)) if !row["report"].is_object() => {
            Err("status ok without a report".to_owned())
        }
        (_, Ok(plan)) if row["report"].is_object() => {
            figures(point, row)?;
            same(&row["slack"], &slack(&row["report"]), "slack")?;
            same(&row["derived"], &derived(plan, &row["report"], &row["synth"]), "derived")
        }
        _ => Ok(()),
    }
}

/// Checks that the figures of a report are possible, and agree among themselves.
fn figures(point: &Point, row: &Value) -> Result<(), String> {
    let report = &row["report"];
    for (name, own) in [("input", &row["input"]), ("machine", &row["machine"])] {
        if report[name] != *own {
            return Err(format!("report.{name} is {}, where the row has {own}", report[name]));
        }
    }
    let counts = [
        "/triangles",
        "/polygons",
        "/fragments",
        "/writes",
        "/cycles/total",
        "/comparison/pixels",
        "/comparison/covered",
        "/comparison/compared",
        "/comparison/coverage_mismatches",
        "/comparison/order_undecided",
        "/comparison/order_wrong",
        "/comparison/wrapped",
    ];
    let count = |pointer: &str| {
        let value = report.pointer(pointer).unwrap_or(&Value::Null);
        value.as_u64().ok_or_else(|| format!("report{pointer} is {value}: permitted: a whole number"))
    };
    counts.into_iter().try_for_each(|pointer| count(pointer).map(|_| ()))?;
    let (total, unexplained) = (count("/cycles/total")?, count("/comparison/cycles_unexplained")?);
    let mut spent = 0_u64;
    for cause in report["cycles"]["by_cause"].as_object().into_iter().flatten().map(|(_, cycles)| cycles) {
        spent = spent.saturating_add(
            cause.as_u64().ok_or_else(|| format!("a cause has {cause} cycles: permitted: a whole number"))?,
        );
    }
    if total.abs_diff(spent) != unexplained {
        return Err(format!("report/cycles/total is {total}, but its causes add up to {spent}"));
    }
    let screen = u64::from(point.machine.width) * u64::from(point.machine.height);
    if count("/comparison/covered")? > screen || count("/comparison/compared")? > screen {
        return Err(format!("more pixels than the {screen} of the screen"));
    }
    let limits = ["error", "bound", "bound_for_input"];
    for name in ["z", "color"].iter().flat_map(|channel| limits.map(|figure| format!("{channel}_{figure}"))) {
        let value = &report["comparison"][&name];
        if !value.is_null() && value.as_f64().is_none_or(|value| value < 0.0) {
            return Err(format!("report/comparison/{name} is {value}: permitted: 0 or more, or null"));
        }
    }
    let verdicts = ["pass", "mismatch", "vacuous", "open"];
    if !verdicts.iter().any(|verdict| row["verdict"] == *verdict) {
        return Err(format!("verdict {}: permitted: {}", row["verdict"], verdicts.join(", ")));
    }
    Ok(())
}

/// Checks figures that follow from others; the last digit of a number may change when it is written and read.
fn same(found: &Value, own: &Value, name: &str) -> Result<(), String> {
    let near = match (found.as_f64(), own.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-12 * b.abs(),
        _ => match own.as_object() {
            Some(list) => {
                let all = found.as_object().is_some_and(|found| found.len() == list.len());
                list.iter().try_for_each(|(part, own)| same(&found[part], own, &format!("{name}.{part}")))?;
                all
            }
            None => found == own,
        },
    };
    if near { Ok(()) } else { Err(format!("{name} is {found}, where the figures of the row give {own}")) }
}
