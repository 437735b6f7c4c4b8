//! What the script of the page works with: columns of figures, a row a point.

use super::Pictures;
use crate::sweep::Point;
use crate::sweep::csv::figures;
use crate::sweep::row::{Status, causes};
use crate::sweep::shared::pixel_key;
use crate::sweep::table::Table;
use edgewalk_machine::key::Domain;
use edgewalk_machine::keys::KEYS;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// Rows, columns, keys, pictures.
pub fn data(table: &Table, pictures: &[Pictures]) -> Value {
    let rows: Vec<&Value> =
        table.rows.iter().copied().filter(|row| Status::of(row) == Some(Status::Ok)).collect();
    // Keys alike in all rows are told once.
    let mut alike = Map::new();
    let mut differ = Vec::new();
    for key in KEYS {
        let first = rows.first().map_or(&Value::Null, |row| &row["keys"][key.name]);
        if rows.iter().all(|row| row["keys"][key.name] == *first) {
            alike.insert(key.name.to_owned(), first.clone());
        } else {
            differ.push(key.name);
        }
    }
    let known = |pointer: &str| rows.iter().any(|row| row.pointer(pointer).is_some_and(Value::is_number));
    let figures: Vec<(String, String)> = figures().into_iter().filter(|(_, at)| known(at)).collect();
    let units = units(&rows);
    let fronts = table.front_of();
    let front = |row: &Value| fronts.get(row["key"].as_str()?).copied();
    let line = |row: &&Value| {
        let mut line = vec![
            row["key"].clone(),
            row["machine"].clone(),
            row["input"].clone(),
            row["shading"].clone(),
            row["stalls"].clone(),
            json!(front(row)),
        ];
        line.extend(differ.iter().map(|key| row["keys"][key].clone()));
        line.extend(figures.iter().map(|(_, at)| row.pointer(at).cloned().unwrap_or(Value::Null)));
        line.extend(units.iter().map(|unit| unit_cells(row, unit)));
        json!(line)
    };
    let columns: Vec<String> = ["key", "machine", "input", "shading", "stalls", "front"]
        .into_iter()
        .map(str::to_owned)
        .chain(differ.iter().map(|key| (*key).to_owned()))
        .chain(figures.iter().map(|(name, _)| name.clone()))
        .chain(units.iter().map(|unit| format!("lut4_{unit}")))
        .collect();
    let objectives = table.sweep.objectives.iter();
    json!({
        "columns": columns,
        "rows": rows.iter().map(line).collect::<Vec<_>>(),
        "alike": alike,
        "varied": differ.iter().filter(|name| table.sweep.axes.iter().any(|axis| axis.key.name == **name)).collect::<Vec<_>>(),
        "keys": KEYS.iter().map(|key| json!([key.name, matches!(key.domain, Domain::Word(_))])).collect::<Vec<_>>(),
        "objectives": objectives.map(|o| json!({ "name": column(o.name), "most": o.most, "doc": o.doc })).collect::<Vec<_>>(),
        "causes": causes().collect::<Vec<_>>(),
        "units": units,
        "inputs": table.sweep.inputs.iter().map(|input| &input.name).collect::<Vec<_>>(),
        "memories": table.sweep.memories.iter().map(|memory| json!([memory.waits.to_string(), memory.name])).collect::<Vec<_>>(),
        "pictures": pictures.iter().map(|of| &of.key).collect::<Vec<_>>(),
        "same_pixels": same_pixels(table, pictures),
    })
}

/// The column of an objective.
pub fn column(objective: &str) -> &str {
    match objective {
        "z_bound" => "z_bound_for_input",
        "color_bound" => "color_bound_for_input",
        "mhz" => "mhz_median",
        name => name,
    }
}

/// For each row whose pixels another row's pictures show, which.
fn same_pixels(table: &Table, pictures: &[Pictures]) -> Value {
    let points = table.sweep.by_key();
    let pixels = |point: &Point| ([point.input, point.way], pixel_key(&point.machine));
    let shown = pictures.iter().enumerate();
    let shown = shown.filter_map(|(place, of)| Some((pixels(points.get(of.key.as_str())?), place)));
    let shown: BTreeMap<_, usize> = shown.collect();
    let of = table.sweep.points.iter().filter_map(|point| {
        let place = shown.get(&pixels(point))?;
        Some((point.key.clone(), json!(place)))
    });
    of.collect::<Map<_, _>>().into()
}

/// Units that synthesis counted apart.
fn units(rows: &[&Value]) -> Vec<String> {
    let first = rows.iter().find_map(|row| row.pointer("/synth/units")?.as_array());
    let names = first.into_iter().flatten().filter_map(|unit| unit["unit"].as_str().map(str::to_owned));
    names.collect()
}

fn unit_cells(row: &Value, unit: &str) -> Value {
    let list = row.pointer("/synth/units").and_then(Value::as_array);
    let of = list.and_then(|list| list.iter().find(|of| of["unit"] == unit));
    of.map_or(Value::Null, |of| of["lut4"].clone())
}
