//! The report of a sweep: one HTML file without a network address, readable without scripts, better with them.
//!
//! ```text
//!  table ─┬─> data (columns of figures) ─┐
//!         └─> tables, chart, still ──────┴─> page.html with its style and script
//! pictures ──────────────────────────────┘
//! ```

mod chart;
mod data;
mod still;

use crate::sweep::table::Table;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
pub use still::{rule, ruled_out};

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// In the order in which one uses the other.
const SCRIPT: &str =
    concat!(include_str!("page/marks.js"), include_str!("page/errors.js"), include_str!("page/page.js"));

/// A machine's pictures of an input, PNG files.
pub struct Pictures {
    /// Key of a row; rows of the same pixels have them in common.
    pub key: String,
    /// What each shows, and its bytes.
    pub images: Vec<(&'static str, Vec<u8>)>,
}

/// The page. `command`: what made the sweep.
#[must_use]
pub fn page(table: &Table, pictures: &[Pictures], command: &str) -> String {
    let data = data::data(table, pictures);
    let parts = [
        ("@TITLE@", escaped(&title(table))),
        ("@STYLE@", STYLE.to_owned()),
        ("@COMMAND@", escaped(command)),
        ("@SUMMARY@", still::summary(table)),
        ("@CHART@", chart::front(table)),
        ("@BESTS@", still::bests(table)),
        ("@FRONT@", still::front(table)),
        ("@PICTURES@", still::pictures(table, pictures)),
        ("@DATA@", in_script(&data)),
        ("@SCRIPT@", SCRIPT.to_owned()),
    ];
    // One after the other over the template alone: what is put in is not looked at again.
    let mut page = String::new();
    let mut rest = PAGE;
    while let Some((at, (name, text))) =
        parts.iter().filter_map(|part| Some((rest.find(part.0)?, part))).min_by_key(|(at, _)| *at)
    {
        page += &rest[..at];
        page += text;
        rest = &rest[at + name.len()..];
    }
    page + rest
}

fn title(table: &Table) -> String {
    let inputs: Vec<&str> = table.sweep.inputs.iter().map(|input| input.name.as_str()).collect();
    let memories: Vec<&str> = table.sweep.memories.iter().map(|memory| memory.name.as_str()).collect();
    let with = if memories == ["none"] { String::new() } else { format!(", memory {}", memories.join(", ")) };
    format!("{} machines on {}{with}", table.machines.len(), inputs.join(", "))
}

/// Text in HTML.
#[must_use]
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// JSON inside a script element: without `<` nothing in it can end the element, or begin a comment.
fn in_script(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

/// A number with about five digits, as tables and charts show it.
#[must_use]
pub fn number(value: f64) -> String {
    if value == value.trunc() && value.abs() < 1e15 {
        return format!("{value}");
    }
    let digits = (4 - value.abs().log10().floor() as i32).clamp(0, 6) as usize;
    format!("{value:.digits$}")
}

/// PNG bytes as an address that needs no network.
fn embedded(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_five_digits() {
        let cases = [
            (3.0, "3"),
            (0.529_288_1, "0.52929"),
            (1234.567, "1234.6"),
            (1e-7, "0.000000"),
            (0.05, "0.050000"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
