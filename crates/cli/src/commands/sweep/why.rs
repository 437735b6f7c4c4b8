//! What a row depends on, and which of it has changed since.

use super::{ROWS, kept};
use crate::Talk;
use crate::document::document;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_explore::sweep::shading::named;
use edgewalk_explore::sweep::store;
use edgewalk_host::input::Input;
use edgewalk_machine::nearest;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// What a row's key is made of.
const PARTS: [&str; 7] = ["machine", "input", "input_hash", "stalls", "version", "synthesis", "require"];

/// Tells it of the row whose key begins so.
pub fn run(key: &str, out: &Path, talk: Talk) -> Result<Verdict> {
    let rows = store::read(&out.join(ROWS))?;
    let keys = || rows.iter().filter_map(|row| row["key"].as_str());
    let found: Vec<&Value> =
        rows.iter().filter(|row| row["key"].as_str().is_some_and(|of| of.starts_with(key))).collect();
    let row = match found[..] {
        [row] => row,
        [] if rows.is_empty() => return Err(anyhow!("{}: no rows", out.join(ROWS).display())),
        [] => {
            let near = nearest(key, keys()).map_or_else(String::new, |near| format!("; nearest: {near}"));
            return Err(anyhow!("{key}: no row has this key{near}"));
        }
        _ => return Err(anyhow!("{key}: {} rows begin so; give more digits", found.len())),
    };
    let changed = changed(row, out)?;
    let others = others(row, &rows);
    talk.say(
        || document("sweep-why", json!({ "row": row, "changed": changed, "same_machine": others })),
        || text(row, &changed, &others),
    )?;
    Ok(Verdict::Pass)
}

/// What would make another key of it today, in words.
fn changed(row: &Value, out: &Path) -> Result<Vec<String>> {
    let mut changed = Vec::new();
    let version = env!("CARGO_PKG_VERSION");
    if row["version"] != version {
        changed.push(format!("version: the row is of {}, this program is {version}", shown(&row["version"])));
    }
    let name = row["input"].as_str().unwrap_or_default();
    let sweep = kept(out);
    // A triangle file says itself how it is shaded.
    let shading = named(row["shading"].as_str().unwrap_or("gouraud"));
    match shading.and_then(|(_, shading)| Input::open(name, shading)).and_then(|input| input.hash()) {
        Ok(hash) if row["input_hash"] == hash => {}
        Ok(hash) => changed.push(format!(
            "input_hash: {name} was {}, now it is {hash}: the file or what it names has changed",
            shown(&row["input_hash"])
        )),
        Err(why) => changed.push(format!("input_hash: {name} cannot be read any more: {why:#}")),
    }
    if let Ok(sweep) = &sweep
        && !sweep.points.iter().any(|point| row["key"] == point.key.as_str())
    {
        changed.push("the sweep that was asked for last has no such point".to_owned());
    }
    Ok(changed)
}

/// Other rows of the machine, and the parts in which they differ.
fn others(row: &Value, rows: &[Value]) -> Vec<Value> {
    let same = rows.iter().filter(|other| other["machine"] == row["machine"] && other["key"] != row["key"]);
    same.map(|other| {
        let differ: Vec<&str> = PARTS.into_iter().filter(|part| other[part] != row[part]).collect();
        json!({ "key": other["key"], "differs_in": differ })
    })
    .collect()
}

fn shown(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// Writing to a string cannot fail.
fn text(row: &Value, changed: &[String], others: &[Value]) -> String {
    let mut t = format!("{} {}", shown(&row["key"]), shown(&row["status"]));
    if let Some(reason) = row["reason"].as_str() {
        _ = write!(t, ": {reason}");
    }
    _ = writeln!(t, "\nmade of");
    for part in PARTS {
        _ = writeln!(t, "    {part:<12} {}", shown(&row[part]));
    }
    for (key, value) in row["keys"].as_object().into_iter().flatten() {
        _ = writeln!(t, "    {key} = {}", shown(value));
    }
    if changed.is_empty() {
        _ = writeln!(t, "all of it is the same today: the row would not be made again");
    }
    for what in changed {
        _ = writeln!(t, "changed: {what}");
    }
    for other in others {
        _ = writeln!(t, "the same machine: {} differs in {}", shown(&other["key"]), other["differs_in"]);
    }
    t
}
