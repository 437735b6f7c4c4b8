//! Tables for people and spreadsheets: a token a line, signed fields with their sign.

use crate::capture::{LinkTrace, Trace};
use crate::suites::Suite;
use edgewalk_lockstep::{Link, Port};
use std::fmt::Write as _;

/// The tokens of a link, with their number, the cycle, and, where it is known, the triangle and its case.
#[must_use]
pub fn link(suite: &Suite, link: &Link, trace: &LinkTrace) -> String {
    let with_triangle = !trace.triangles.is_empty();
    let mut text = String::from("token,cycle");
    if with_triangle {
        text.push_str(",triangle,case");
    }
    for field in &link.fields {
        let _ = write!(text, ",{}", field.name);
    }
    text.push('\n');
    for (i, (token, cycle)) in trace.tokens.iter().zip(&trace.cycles).enumerate() {
        let _ = write!(text, "{i},{cycle}");
        if let Some(triangle) = trace.triangles.get(i) {
            let case = suite.case_of(*triangle as usize).map_or("", |case| &case.name);
            let _ = write!(text, ",{triangle},{case}");
        }
        for (field, value) in link.fields.iter().zip(token) {
            let _ = write!(text, ",{}", shown(field, *value));
        }
        text.push('\n');
    }
    text
}

/// The changes of the status ports.
#[must_use]
pub fn status(ports: &[Port], trace: &Trace) -> String {
    let names: Vec<&str> = ports.iter().map(|field| field.name.as_str()).collect();
    let mut text = format!("change,cycle,{}\n", names.join(","));
    for (i, (cycle, values)) in trace.status.iter().enumerate() {
        let values: Vec<String> = values.iter().map(ToString::to_string).collect();
        let _ = writeln!(text, "{i},{cycle},{}", values.join(","));
    }
    text
}

fn shown(field: &Port, value: u128) -> String {
    field.number(value).to_string()
}
