//! Waves of a recording as SVG: a flag as a line, a number as boxes, grey where it is don't care.

use super::figures::Figure;
use crate::support::recording::Recording;
use serde_json::Value;
use std::fmt::Write as _;

const LEFT: u32 = 170;
const ROW: u32 = 26;
const TOP: u32 = 24;
const COLOR: &str = "#0072b2";

/// The register, and the field of its token.
fn place<'a>(recording: &'a Recording, name: &'a str) -> (usize, Option<&'a str>) {
    if name == "cause" {
        return (recording.json["cause"].as_u64().unwrap() as usize, None);
    }
    let links = recording.json["links"].as_array().unwrap();
    let end =
        name.rsplit_once('_').filter(|(_, end)| ["valid", "ready"].contains(end) && !name.contains(' '));
    if let Some((link, end)) = end {
        let link =
            links.iter().find(|known| known["name"] == link).unwrap_or_else(|| panic!("no link {link}"));
        return (link[end].as_u64().unwrap() as usize, None);
    }
    let (unit, register) = name.split_once(' ').unwrap_or_else(|| panic!("{name}: unit and register"));
    let (register, field) = register.split_once(':').map_or((register, None), |(r, f)| (r, Some(f)));
    let units = recording.json["units"].as_array().unwrap();
    let unit = units.iter().find(|known| known["name"] == unit).unwrap_or_else(|| panic!("no unit {unit}"));
    let cells = |item: &Value| match &item["table"] {
        Value::Null => vec![item["register"].clone()],
        table => table["rows"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|row| row["cells"].as_array().unwrap().clone())
            .collect(),
    };
    let items = unit["items"].as_array().unwrap().iter().flat_map(cells);
    let ids = items.chain(unit["aside"].as_array().unwrap().iter().cloned()).filter_map(|id| id.as_u64());
    let found = ids.map(|id| id as usize).find(|id| recording.json["registers"][id]["name"] == register);
    (found.unwrap_or_else(|| panic!("no register {name}")), field)
}

/// A value as a reader writes it.
fn text(shape: &Value, value: u64) -> String {
    let bits = shape["bits"].as_u64().unwrap_or(1);
    match shape["kind"].as_str().unwrap() {
        "code" => shape["words"][value as usize].as_str().unwrap().to_owned(),
        "place" => {
            let low = shape["low"].as_u64().unwrap();
            format!("{},{}", value & ((1 << low) - 1), value >> low)
        }
        _ if shape["signed"] == true && value >> (bits - 1) == 1 => {
            (value as i64 - (1i64 << bits)).to_string()
        }
        _ => value.to_string(),
    }
}

/// What a register or a field holds in a cycle; `-` where it is don't care or no token is there.
pub fn shows(recording: &Recording, name: &str, cycle: u64) -> String {
    let (id, field) = place(recording, name);
    let register = &recording.json["registers"][id];
    if register["live"].is_u64() && recording.value(&register["live"], cycle) == 0 {
        return "-".to_owned();
    }
    let value = recording.value(&Value::from(id), cycle);
    let Some(field) = field else { return text(&register["shape"], value) };
    let table = register["shape"]["table"].as_u64().unwrap() as usize;
    let fields = recording.json["tokens"][table]["fields"].as_array().unwrap();
    let at = fields
        .iter()
        .position(|known| known["name"] == field)
        .unwrap_or_else(|| panic!("{name}: no such field"));
    value
        .checked_sub(1)
        .map_or("-".to_owned(), |token| text(&fields[at]["shape"], recording.token(table, at, token)))
}

/// The waves from a cycle on.
pub fn draw(recording: &Recording, figure: &Figure, from: u64) -> String {
    let (cycles, wide) = (figure.cycles, figure.width);
    let last = recording.json["cycles"].as_u64().unwrap();
    assert!(from + cycles <= last, "{}: the run ends in cycle {last}", figure.name);
    let width = LEFT + cycles as u32 * wide + 10;
    let height = TOP + figure.rows.len() as u32 * ROW + 8;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    let every = u64::from(40 / wide).max(1);
    for at in (0..cycles).step_by(every as usize) {
        let x = LEFT + at as u32 * wide;
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" x2=\"{x}\" y1=\"{TOP}\" y2=\"{}\" stroke=\"#e0e0e0\"/>",
            height - 8
        );
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"14\" text-anchor=\"middle\" fill=\"#666666\">{}</text>",
            x + wide / 2,
            from + at
        );
    }
    let _ =
        writeln!(svg, "<text x=\"{}\" y=\"14\" text-anchor=\"end\" fill=\"#666666\">cycle</text>", LEFT - 8);
    for (row, name) in figure.rows.iter().enumerate() {
        let y = TOP + row as u32 * ROW;
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{name}</text>", LEFT - 8, y + 17);
        let (id, field) = place(recording, name);
        let shape = &recording.json["registers"][id]["shape"];
        let values: Vec<String> = (0..cycles).map(|at| shows(recording, name, from + at)).collect();
        let runs = values.chunk_by(|a, b| a == b);
        if field.is_none() && shape["kind"] == "flag" {
            line(&mut svg, runs, y, wide);
        } else {
            boxes(&mut svg, runs, y, wide);
        }
    }
    svg + "</svg>\n"
}

fn line<'a>(svg: &mut String, runs: impl Iterator<Item = &'a [String]>, y: u32, wide: u32) {
    let (mut x, mut points) = (LEFT, String::new());
    for run in runs {
        let end = x + run.len() as u32 * wide;
        if run[0] == "-" {
            grey(svg, x, end, y);
        }
        let height = y + if run[0] == "1" { 5 } else { 21 };
        let _ = write!(points, "{x},{height} {end},{height} ");
        x = end;
    }
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{COLOR}\" stroke-width=\"1.5\"/>",
        points.trim_end()
    );
}

fn boxes<'a>(svg: &mut String, runs: impl Iterator<Item = &'a [String]>, y: u32, wide: u32) {
    let mut x = LEFT;
    for run in runs {
        let end = x + run.len() as u32 * wide;
        if run[0] == "-" {
            grey(svg, x, end, y);
        } else {
            let (low, high, half) = (y + 21, y + 5, y + 13);
            let _ = writeln!(
                svg,
                "<polygon points=\"{x},{half} {},{high} {},{high} {end},{half} {},{low} {},{low}\" fill=\"#eef5fa\" stroke=\"{COLOR}\"/>",
                x + 3,
                end - 3,
                end - 3,
                x + 3
            );
            if run[0].len() as u32 * 6 + 6 <= end - x {
                let _ = writeln!(
                    svg,
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                    (x + end) / 2,
                    y + 17,
                    run[0]
                );
            }
        }
        x = end;
    }
}

fn grey(svg: &mut String, x: u32, end: u32, y: u32) {
    let _ = writeln!(
        svg,
        "<rect x=\"{x}\" y=\"{}\" width=\"{}\" height=\"16\" fill=\"#eeeeee\"/>",
        y + 5,
        end - x
    );
}
