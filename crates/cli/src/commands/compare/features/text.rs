//! The table of features as text: a column a machine.

use crate::verdict::Verdict;
use serde_json::Value;
use std::fmt::Write as _;

/// The figures of one row, each with its place below a machine.
pub struct Row {
    /// What stands before it.
    pub name: String,
    /// Where each machine has the figure; none where it has not.
    pub cells: Vec<Option<String>>,
}

/// All rows in order; `places` are below `/machines/N`.
pub fn rows(told: &Value) -> Vec<Row> {
    let machines = told["machines"].as_array().map_or(&[][..], Vec::as_slice);
    let row = |name: String, place: &dyn Fn(&Value) -> Option<String>| Row {
        name,
        cells: machines
            .iter()
            .enumerate()
            .map(|(number, machine)| {
                let place = place(machine)?;
                let known = machine.pointer(&place).is_some_and(|value| !value.is_null());
                known.then(|| format!("/machines/{number}{place}"))
            })
            .collect(),
    };
    let mut units: Vec<&str> = Vec::new();
    for unit in machines.iter().flat_map(|machine| machine["units"].as_array().into_iter().flatten()) {
        let name = unit["unit"].as_str().unwrap_or_default();
        if !units.contains(&name) {
            units.push(name);
        }
    }
    let mut rows = Vec::new();
    for unit in units {
        for (figure, at) in [("est_lut4", "/est_lut4/value"), ("est_ff", "/est_ff"), ("est_ram", "/est_ram")]
        {
            rows.push(row(format!("{unit}: {figure}"), &|machine| {
                let list = machine["units"].as_array()?;
                let place = list.iter().position(|found| found["unit"] == unit)?;
                Some(format!("/units/{place}/estimate{at}"))
            }));
        }
    }
    let whole = [
        ("machine: est_lut4", "/estimate/est_lut4/value"),
        ("machine: est_lut4, error", "/estimate/est_lut4/error"),
        ("machine: est_ff", "/estimate/est_ff"),
        ("machine: est_ram", "/estimate/est_ram"),
        ("machine: est_cells", "/estimate/est_cells/value"),
        ("machine: est_mhz", "/estimate/est_mhz/value"),
        ("machine: est_mhz, error", "/estimate/est_mhz/error"),
        ("ice40-hx8k", "/estimate/fits/0/text"),
        ("ice40-up5k", "/estimate/fits/1/text"),
        ("measured: LUT4", "/synth/cells/lut4"),
        ("measured: flip-flops", "/synth/cells/ff"),
        ("measured: RAM", "/synth/cells/ram"),
        ("measured: DSP", "/synth/cells/dsp"),
        ("measured: MHz, median", "/synth/mhz/median"),
        ("bits of memory", "/memory_bits"),
    ];
    rows.extend(whole.map(|(name, place)| row(name.to_owned(), &|_| Some(place.to_owned()))));
    let reasons = |machine: &Value| machine["synth"]["reasons"].as_array().map_or(0, Vec::len);
    for place in 0..machines.iter().map(reasons).max().unwrap_or(0) {
        rows.push(row("not measured".to_owned(), &|_| Some(format!("/synth/reasons/{place}"))));
    }
    let inputs = told["inputs"].as_array().into_iter().flatten().filter_map(Value::as_str);
    for (number, input) in inputs.enumerate() {
        for (name, key) in [
            ("cycles", "cycles"),
            ("cycles of maps", "map_cycles"),
            ("bytes", "bytes"),
            ("shading error, largest", "shading_error"),
            ("shading error, mean", "shading_mean"),
            ("error of the form, largest", "form_error"),
            ("error of the form, mean", "form_mean"),
            ("depth error, LSB", "z_error"),
            ("colour error, LSB", "color_error"),
            ("energy, thousand gates", "energy/kge"),
            ("energy, MHz without wires", "energy/mhz"),
            ("energy, pJ a cycle", "energy/energy/cycle_pj"),
            ("energy, pJ of the triangles", "energy/energy/frame_pj"),
            ("energy, pJ a pixel", "energy/energy/pixel_pj"),
            ("energy, not computed", "energy/reason"),
            ("not drawn", "reason"),
        ] {
            rows.push(row(format!("{input}: {name}"), &|_| Some(format!("/inputs/{number}/{key}"))));
        }
        rows.push(row(format!("{input}: beside golden"), &|machine| {
            let verdict = format!("/inputs/{number}/verdict");
            // A picture that passes needs no word.
            (machine.pointer(&verdict)? != Verdict::Pass.word()).then_some(verdict)
        }));
        for unit in energies(machines, number) {
            let place = |_: &Value| Some(format!("/inputs/{number}/energy/energy/units/{unit}"));
            rows.push(row(format!("{input}: energy, pJ of {unit}"), &place));
        }
    }
    rows.retain(|row| row.cells.iter().any(Option::is_some));
    rows
}

/// Units whose energy on this input is known.
fn energies(machines: &[Value], input: usize) -> Vec<String> {
    let mut units: Vec<String> = Vec::new();
    let known = machines
        .iter()
        .filter_map(|machine| machine.pointer(&format!("/inputs/{input}/energy/energy/units"))?.as_object());
    for unit in known.flat_map(|units| units.keys()) {
        if !units.contains(unit) {
            units.push(unit.clone());
        }
    }
    units
}

/// A figure as people read it.
pub fn shown(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => {
            let number = number.as_f64().unwrap_or(f64::NAN);
            if number.abs() < 1000.0 { format!("{number:.2}") } else { format!("{number:.0}") }
        }
        Value::Null => "-".to_owned(),
        other => other.to_string(),
    }
}

/// As text. Writing to a string cannot fail.
pub fn text(told: &Value) -> String {
    let mut t = format!("stalls {}\n", shown(&told["stalls"]));
    let machines = told["machines"].as_array().map_or(&[][..], Vec::as_slice);
    let label = |place: usize| format!("M{}", place + 1);
    for (place, machine) in machines.iter().enumerate() {
        _ = writeln!(t, "{}: {} ({})", label(place), shown(&machine["machine"]), shown(&machine["hash"]));
    }
    let head: String = (0..machines.len()).map(|place| format!("{:>14}", label(place))).collect();
    _ = writeln!(t, "{:<44}{head}", "");
    let mut words = Vec::new();
    for Row { name, cells } in rows(told) {
        let value = |cell: &Option<String>| cell.as_ref().and_then(|place| told.pointer(place));
        if cells.iter().filter_map(value).any(Value::is_string) {
            let told = cells.iter().enumerate().filter_map(|(place, cell)| Some((place, value(cell)?)));
            words.extend(told.map(|(place, why)| format!("{}, {name}: {}\n", label(place), shown(why))));
            continue;
        }
        let line: String =
            cells.iter().map(|cell| format!("{:>14}", value(cell).map_or("-".to_owned(), shown))).collect();
        _ = writeln!(t, "{name:<44}{line}");
    }
    t + &words.concat() + NOTE
}

/// What the figures are.
pub const NOTE: &str = "est_*: estimates on an iCE40, of each unit alone and of the machine whole; LUT4 of a preset lie within 1 % of the sum of its units.\n\
    Bits of memory: outside the machine.\n\
    Shading error: distance from the shading equation at each pixel, LSB of 8 bits; of shadows, from the equation with shadows by rays.\n\
    Error of the form: distance from the form of that equation that SHADE draws: highlights of N·H, in Phong a viewer far away.\n\
    Beside golden: a mismatch is a picture that errs beyond its bounds; of an open one no pixel was compared. `edgewalk render` tells more.\n\
    Energy: of the first triangles, in cells for 0.18 um without wires; it compares machines, and is no promise of a chip.\n";
