//! The rows of a sweep as CSV, for spreadsheets.

use super::row::causes;
use super::table::Table;
use serde_json::Value;
use std::fmt::Write as _;

/// All rows with a header, in the order of the points; the last column is the front of the row's machine.
#[must_use]
pub fn csv(table: &Table) -> String {
    let columns = columns(table);
    let fronts = table.front_of();
    let mut csv = String::new();
    let header: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).chain(["front"]).collect();
    // Writing to a string cannot fail.
    _ = writeln!(csv, "{}", header.join(","));
    for row in &table.rows {
        let mut line: Vec<String> = columns.iter().map(|(_, pointer)| field(row.pointer(pointer))).collect();
        let front = row["key"].as_str().and_then(|key| fronts.get(key));
        line.push(front.map_or_else(String::new, ToString::to_string));
        _ = writeln!(csv, "{}", line.join(","));
    }
    csv
}

/// The columns: names, and where a row has them.
#[must_use]
pub fn columns(table: &Table) -> Vec<(String, String)> {
    let mut columns: Vec<(String, String)> = [
        "key",
        "status",
        "reason",
        "input",
        "input_hash",
        "shading",
        "machine",
        "stalls",
        "version",
        "verdict",
        "seconds",
    ]
    .map(|name| (name.to_owned(), format!("/{name}")))
    .into();
    let mut names: Vec<&str> = Vec::new();
    for row in &table.rows {
        for name in row["keys"].as_object().into_iter().flatten().map(|(name, _)| name) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
    }
    columns.extend(names.into_iter().map(|name| (name.to_owned(), format!("/keys/{name}"))));
    columns.extend(figures());
    columns
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
        ("bytes", "traffic/bytes"),
        ("bytes_per_cycle", "traffic/bytes_per_cycle"),
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
    columns.push(("shading_error".to_owned(), "/equation/largest".to_owned()));
    columns.push(("shading_mean".to_owned(), "/equation/mean".to_owned()));
    for figure in ["lut4", "carry", "ff", "ram", "dsp"] {
        columns.push((figure.to_owned(), format!("/synth/cells/{figure}")));
    }
    for figure in ["median", "min", "max"] {
        columns.push((format!("mhz_{figure}"), format!("/synth/mhz/{figure}")));
    }
    for figure in ["est_lut4", "est_cells", "est_mhz"] {
        columns.push((figure.to_owned(), format!("/estimate/{figure}/value")));
        columns.push((format!("{figure}_error"), format!("/estimate/{figure}/error")));
    }
    for figure in ["est_carry", "est_ff", "est_ram"] {
        columns.push((figure.to_owned(), format!("/estimate/{figure}")));
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
        // A number, which may begin with a sign.
        Some(other) => return other.to_string(),
    };
    // A spreadsheet takes text that begins so for a formula; behind an apostrophe it is text.
    let formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    let text = if formula { format!("'{text}") } else { text };
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}
