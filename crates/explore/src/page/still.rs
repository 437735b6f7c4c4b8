//! The parts of the page that need no script.

use super::{Pictures, embedded, escaped, number};
use crate::sweep::Sweep;
use crate::sweep::search::extent;
use crate::sweep::table::{Candidate, Table};
use serde_json::Value;
use std::fmt::Write as _;

/// Machines of the front in the table; the CSV has all.
const SHOWN: usize = 60;

/// How the rows of a machine count together; none where it has one.
#[must_use]
pub fn rule(sweep: &Sweep) -> Option<String> {
    let inputs = (sweep.inputs.len() > 1).then(|| sweep.judge.inputs.words(&sweep.inputs));
    let memories = (sweep.memories.len() > 1)
        .then(|| format!("Machines are judged {}", sweep.judge.memories.words(&sweep.memories)));
    let rules: Vec<String> = inputs.into_iter().chain(memories).collect();
    (!rules.is_empty()).then(|| rules.join(". "))
}

/// How many points, and what became of them.
pub fn summary(table: &Table) -> String {
    let counts = table.counts();
    let counts = counts.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
    let mut html = format!("<p>{} points: {}.</p>", table.sweep.points.len(), counts.join(", "));
    for line in extent(table.sweep).into_iter().chain(rule(table.sweep)) {
        html += &format!("<p>{}.</p>", escaped(&line));
    }
    if table.faults() > 0 {
        html += &format!(
            "<p><strong>{} rows show an error beyond what is proved: a fault of edgewalk.</strong></p>",
            table.faults()
        );
    }
    html += &ruled_out(table).iter().map(|line| format!("<p>{}.</p>", escaped(line))).collect::<String>();
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

/// How many machines each requirement ruled out.
#[must_use]
pub fn ruled_out(table: &Table) -> Vec<String> {
    let all = table.machines.len();
    table
        .ruled_out()
        .into_iter()
        .map(|(text, count)| format!("required: {text}: rules out {count} of {all} machines"))
        .collect()
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
        let value = table.value(objective, best);
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

/// The first front, with the causes of cycles.
pub fn front(table: &Table) -> String {
    let on: Vec<&Candidate> = table.first_front().collect();
    let (memories, judge) = (&table.sweep.memories, &table.sweep.judge);
    let shown =
        if on.len() > SHOWN { format!(", {SHOWN} of them here, all in runs.csv") } else { String::new() };
    let mut html = format!(
        "<table id=\"first-front\"><caption>The first front: {} of {} machines{shown}</caption><thead><tr>",
        on.len(),
        table.machines.len()
    );
    table.sweep.objectives.iter().for_each(|objective| html += &format!("<th>{}</th>", objective.name));
    table.sweep.axes.iter().for_each(|axis| html += &format!("<th>{}</th>", axis.key.name));
    if memories.len() > 1 {
        memories.iter().for_each(|memory| html += &format!("<th>cycles, {}</th>", escaped(&memory.name)));
    }
    html += "<th>cycles by cause</th></tr></thead><tbody>";
    for machine in on.iter().take(SHOWN) {
        html += "<tr>";
        machine.values.iter().flatten().for_each(|value| html += &format!("<td>{}</td>", number(*value)));
        html += &keys(table, machine);
        if memories.len() > 1 {
            for memory in 0..memories.len() {
                let cycles = machine.cycles(judge, memory).map_or_else(String::new, number);
                html += &format!("<td>{cycles}</td>");
            }
        }
        let deciding = machine.deciding(judge);
        let causes = machine.causes(judge, &deciding);
        let all: f64 = causes.iter().map(|(_, cycles)| cycles).sum();
        let shares: Vec<String> = causes
            .into_iter()
            .map(|(cause, cycles)| format!("{cause} {:.1} %", 100.0 * cycles / all))
            .collect();
        let with = match deciding[..] {
            [memory] if memories.len() > 1 => format!("{}: ", escaped(&memories[memory].name)),
            _ => String::new(),
        };
        html += &format!("<td>{with}{}</td></tr>", shares.join(", "));
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
            "<section data-key=\"{}\"><h3>{} on machine {}</h3><div class=\"pictures\">",
            escaped(&of.key),
            escaped(&input),
            escaped(&machine)
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
    let row = machine.row();
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
