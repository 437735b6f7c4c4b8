//! The parts of the page that need no script.

use super::{Pictures, embedded, escaped, number};
use crate::sweep::row::causes;
use crate::sweep::table::{Candidate, Table};
use serde_json::Value;
use std::fmt::Write as _;

/// Machines of the front in the table; the CSV has all.
const SHOWN: usize = 60;

/// How many points, and what became of them.
pub fn summary(table: &Table) -> String {
    let counts = table.counts();
    let counts = counts.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
    let mut html = format!("<p>{} points: {}.</p>", table.sweep.points.len(), counts.join(", "));
    let refused = table.rows.iter().filter(|row| row["reason"].is_string());
    let mut told: Vec<String> = Vec::new();
    for row in refused {
        let text = format!("{}: {}", text(&row["status"]), text(&row["reason"]));
        if told.len() < 10 && !told.contains(&text) {
            told.push(text);
        }
    }
    if !told.is_empty() {
        html += "<ul>";
        told.iter().for_each(|text| html += &format!("<li>{}</li>", escaped(text)));
        html += "</ul>";
    }
    html
}

/// The best machine for each objective.
pub fn bests(table: &Table) -> String {
    let mut html = "<table><caption>The best machine for each objective</caption><thead><tr><th>objective</th><th>value</th>\
        <th>what it is</th><th>file</th>"
        .to_owned();
    let axes = || table.sweep.axes.iter().map(|axis| axis.key.name);
    axes().for_each(|name| html += &format!("<th>{name}</th>"));
    html += "</tr></thead><tbody>";
    for objective in &table.sweep.objectives {
        let Some(best) = table.best(objective) else { continue };
        let value = objective.of_all(&best.rows).unwrap_or(f64::NAN);
        // Writing to a string cannot fail.
        _ = write!(
            html,
            "<tr><th scope=\"row\">{0}</th><td>{1}</td><td>{2}</td><td>best_{0}.toml</td>{3}</tr>",
            objective.name,
            number(value),
            escaped(objective.doc),
            keys(table, best)
        );
    }
    html + "</tbody></table>"
}

/// The first front, with causes of cycles.
pub fn front(table: &Table) -> String {
    let on: Vec<&Candidate> = table.machines.iter().filter(|machine| machine.front == Some(1)).collect();
    let shown =
        if on.len() > SHOWN { format!(", {SHOWN} of them here, all in runs.csv") } else { String::new() };
    let mut html =
        format!("<table><caption>The first front: {} machines{shown}</caption><thead><tr>", on.len());
    table.sweep.objectives.iter().for_each(|objective| html += &format!("<th>{}</th>", objective.name));
    table.sweep.axes.iter().for_each(|axis| html += &format!("<th>{}</th>", axis.key.name));
    html += "<th>stalls</th><th>cycles by cause</th></tr></thead><tbody>";
    for machine in on.iter().take(SHOWN) {
        html += "<tr>";
        machine.values.iter().flatten().for_each(|value| html += &format!("<td>{}</td>", number(*value)));
        html += &keys(table, machine);
        let row = machine.rows.first().copied().unwrap_or(&Value::Null);
        let shares = causes().filter_map(|cause| {
            let spent = row.pointer(&format!("/report/cycles/by_cause/{cause}"))?.as_f64()?;
            let all = row.pointer("/report/cycles/total")?.as_f64()?;
            (spent > 0.0).then(|| format!("{cause} {:.1} %", 100.0 * spent / all))
        });
        let shares: Vec<String> = shares.collect();
        _ = write!(html, "<td>{}</td><td>{}</td></tr>", escaped(&text(&row["stalls"])), shares.join(", "));
    }
    html + "</tbody></table>"
}

/// Pictures and heat maps of some machines.
pub fn pictures(table: &Table, pictures: &[Pictures]) -> String {
    let mut html = String::new();
    for of in pictures {
        let row = table.rows.iter().find(|row| row["key"] == of.key.as_str());
        let (input, machine) =
            row.map_or_else(Default::default, |row| (text(&row["input"]), text(&row["machine"])));
        _ = write!(
            html,
            "<section data-key=\"{}\"><h3>{} on machine {machine}</h3><div class=\"pictures\">",
            of.key,
            escaped(&input)
        );
        for (name, png) in &of.images {
            _ = write!(
                html,
                "<figure><img alt=\"{name}\" src=\"{}\"><figcaption>{name}</figcaption></figure>",
                embedded(png)
            );
        }
        html += "</div></section>";
    }
    html
}

/// The varied keys of a machine, as cells of a table.
fn keys(table: &Table, machine: &Candidate) -> String {
    let row = machine.rows.first().copied().unwrap_or(&Value::Null);
    table
        .sweep
        .axes
        .iter()
        .map(|axis| format!("<td>{}</td>", escaped(&text(&row["keys"][axis.key.name]))))
        .collect()
}

fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => String::new(),
        other => other.to_string(),
    }
}
