//! The table of features as one page without scripts, whose figures name their places in the JSON.

use super::text::{NOTE, Row, rows, shown};
use edgewalk_explore::page::escaped;
use serde_json::Value;
use std::fmt::Write as _;

const STYLE: &str = "body{font:15px/1.4 system-ui,sans-serif;margin:2em;color:#222;background:#fff}\
    table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}\
    th{text-align:left;font-weight:600}thead th{border-bottom:2px solid #888}td.words{text-align:left;max-width:18em}\
    .scroll{overflow-x:auto}";

/// The page. Writing to a string cannot fail.
pub fn page(told: &Value) -> String {
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>Cost of features</title><style>{STYLE}</style></head><body><h1>Cost of features</h1>\n<p>Stalls of the memory: {}.</p>\n\
         <div class=\"scroll\"><table><thead><tr><th>Figure</th>",
        escaped(&shown(&told["stalls"]))
    );
    for machine in told["machines"].as_array().into_iter().flatten() {
        _ = write!(html, "<th>{}</th>", escaped(&shown(&machine["machine"])));
    }
    html += "</tr></thead><tbody>\n";
    for Row { name, cells } in rows(told) {
        _ = write!(html, "<tr><th>{}</th>", escaped(&name));
        for cell in &cells {
            match cell.as_ref().and_then(|place| Some((place, told.pointer(place)?))) {
                Some((place, value)) => {
                    let class = if value.is_string() { " class=\"words\"" } else { "" };
                    _ = write!(html, "<td{class} data-at=\"{place}\">{}</td>", escaped(&shown(value)));
                }
                None => html += "<td>-</td>",
            }
        }
        html += "</tr>\n";
    }
    html += "</tbody></table></div>\n";
    NOTE.lines().for_each(|line| html += &format!("<p>{}</p>\n", escaped(line.trim())));
    html + "</body></html>\n"
}
