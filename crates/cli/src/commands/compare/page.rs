//! What differs between two machines, as text and as JSON.

use crate::document::document;
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_explore::sweep::equation::Distance;
use edgewalk_explore::sweep::row::{Cost, causes, keys};
use edgewalk_files::difference::Pixels;
use edgewalk_judge::report::Report;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// A machine and what it made of the input.
pub struct Side {
    /// As it was asked for.
    pub name: String,
    /// The machine.
    pub plan: Plan,
    /// How the input is shaded on it; none of a triangle file.
    pub shading: Option<&'static str>,
    /// What `render` says of it.
    pub report: Report,
    /// The picture of this side, beside golden's.
    pub verdict: Verdict,
    /// How far the picture is from the shading equation, where the shadings differ.
    pub distance: Option<Distance>,
    /// What it costs, if asked for.
    pub cost: Option<Cost>,
}

/// Two of them.
pub struct Page {
    sides: [Side; 2],
    /// The reports of both.
    values: [Value; 2],
    input: String,
    waits: Waits,
    pixels: Pixels,
}

/// A figure, and where the reports have it.
const FIGURES: [(&str, &str); 14] = [
    ("cycles", "/cycles/total"),
    ("pixels a clock", "/cycles/pixels_per_clock"),
    ("fragments", "/fragments"),
    ("writes", "/writes"),
    ("z error, LSB", "/comparison/z_error"),
    ("z bound for input, LSB", "/comparison/z_bound_for_input"),
    ("colour error, LSB", "/comparison/color_error"),
    ("colour bound for input, LSB", "/comparison/color_bound_for_input"),
    ("pixels that wrapped", "/comparison/wrapped"),
    ("setup clocks, mean", "/setup/clocks/mean"),
    ("span FIFO, mean", "/occupancy/span_fifo/mean"),
    ("in flight, mean", "/occupancy/inflight/mean"),
    ("setup lanes, mean", "/occupancy/lanes/mean"),
    ("triangles drawn", "/setup/triangles/drawn"),
];

const CELLS: [(&str, &str); 8] = [
    ("LUT4", "/cells/lut4"),
    ("carry", "/cells/carry"),
    ("flip-flops", "/cells/ff"),
    ("RAM", "/cells/ram"),
    ("DSP", "/cells/dsp"),
    ("MHz, median", "/mhz/median"),
    ("MHz, slowest", "/mhz/min"),
    ("MHz, fastest", "/mhz/max"),
];

impl Page {
    /// Of two sides on one screen, and the pixels in which their pictures differ.
    pub fn new(sides: [Side; 2], input: &str, waits: Waits, pixels: Pixels) -> Result<Self> {
        let values = [serde_json::to_value(&sides[0].report)?, serde_json::to_value(&sides[1].report)?];
        Ok(Page { sides, values, input: input.to_owned(), waits, pixels })
    }

    /// Triangles of the input.
    pub fn primitives(&self) -> u64 {
        self.sides[0].report.drawn.primitives()
    }

    /// The worse verdict of both sides. A difference between the sides is no fault.
    pub fn verdict(&self) -> Verdict {
        let [a, b] = &self.sides;
        a.verdict.and(b.verdict)
    }

    /// Keys whose values differ, with both.
    fn keys(&self) -> Vec<(String, Value, Value)> {
        let [a, b] = self.sides.each_ref().map(|side| keys(&side.plan));
        let names = a.keys().chain(b.keys().filter(|name| !a.contains_key(*name)));
        let both = |name: &String| {
            let of = |keys: &serde_json::Map<String, Value>| keys.get(name).cloned().unwrap_or(Value::Null);
            (name.clone(), of(&a), of(&b))
        };
        names.map(both).filter(|(_, a, b)| a != b).collect()
    }

    /// Figures of both, those that are known of either.
    fn figures(&self) -> Vec<(String, Value, Value)> {
        let causes = causes().map(|cause| (format!("cycles: {cause}"), format!("/cycles/by_cause/{cause}")));
        let named = FIGURES.iter().map(|(name, at)| ((*name).to_owned(), (*at).to_owned()));
        let all = named.chain(causes).map(|(name, at)| {
            let [a, b] =
                self.values.each_ref().map(|value| value.pointer(&at).cloned().unwrap_or(Value::Null));
            (name, a, b)
        });
        all.chain(self.distances()).chain(self.cells()).collect()
    }

    /// Of both from the shading equation, LSB of 8 bits.
    fn distances(&self) -> Vec<(String, Value, Value)> {
        let [Some(a), Some(b)] = self.sides.each_ref().map(|side| side.distance) else { return Vec::new() };
        let of = |name: &str, a: f64, b: f64| (format!("shading equation, {name}"), json!(a), json!(b));
        vec![of("largest", a.largest, b.largest), of("mean", a.mean, b.mean)]
    }

    fn cells(&self) -> Vec<(String, Value, Value)> {
        if self.sides.iter().all(|side| side.cost.is_none()) {
            return Vec::new();
        }
        let of = |side: &Side, at: &str| match &side.cost {
            Some(Ok(cost)) => cost.pointer(at).cloned().unwrap_or(Value::Null),
            _ => Value::Null,
        };
        let [a, b] = &self.sides;
        CELLS.iter().map(|(name, at)| ((*name).to_owned(), of(a, at), of(b, at))).collect()
    }

    /// Why a figure of synthesis is not known.
    fn reasons(side: &Side) -> Vec<String> {
        match &side.cost {
            None => Vec::new(),
            Some(Err((_, why))) => vec![why.clone()],
            Some(Ok(cost)) => {
                let list = cost["reasons"].as_array().into_iter().flatten();
                list.filter_map(|why| why.as_str().map(str::to_owned)).collect()
            }
        }
    }

    /// As JSON.
    pub fn json(&self) -> Result<String> {
        let side = |place: usize| {
            let side = &self.sides[place];
            let mut value = json!({
                "machine": side.name,
                "hash": side.plan.hash(),
                "shading": side.shading,
                "verdict": side.verdict.word(),
                "report": self.values[place],
            });
            if let Some(distance) = side.distance {
                value["equation"] = json!(distance);
            }
            if let Some(cost) = &side.cost {
                value["synth"] = cost.clone().unwrap_or_else(|(_, why)| json!({ "reasons": [why] }));
            }
            value
        };
        let differ = |list: Vec<(String, Value, Value)>| -> Value {
            let list = list.into_iter().filter(|(_, a, b)| a != b);
            list.map(|(name, a, b)| (name, json!([a, b]))).collect::<serde_json::Map<_, _>>().into()
        };
        let Pixels { all, color, depth, coverage, shown, largest } = self.pixels;
        let value = json!({
            "input": self.input,
            "stalls": self.waits.to_string(),
            "keys": differ(self.keys()),
            "figures": differ(self.figures()),
            "pixels": {
                "all": all,
                "color": color,
                "depth": depth,
                "coverage": coverage,
                "triangle": shown,
                "largest_color_difference": largest,
            },
            "a": side(0),
            "b": side(1),
        });
        document("compare", value)
    }

    /// As text. Writing to a string cannot fail.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let [a, b] = &self.sides;
        _ = writeln!(t, "{}, stalls {}", self.input, self.waits);
        for (label, side) in [("a", a), ("b", b)] {
            let shading = side.shading.map_or_else(String::new, |shading| format!(", shading {shading}"));
            let verdict = side.verdict.word();
            _ = writeln!(
                t,
                "{label}: {} ({}){shading}, beside golden: {verdict}",
                side.name,
                side.plan.hash()
            );
        }
        _ = writeln!(t, "{:<30}{:>16}{:>16}", "keys", "a", "b");
        for (name, a, b) in self.keys() {
            _ = writeln!(t, "    {name:<26}{:>16}{:>16}", shown(&a), shown(&b));
        }
        _ = writeln!(t, "{:<30}{:>16}{:>16}{:>10}", "figures that differ", "a", "b", "b - a");
        for (name, a, b) in self.figures().into_iter().filter(|(_, a, b)| a != b) {
            _ = writeln!(t, "    {name:<26}{:>16}{:>16}{:>10}", shown(&a), shown(&b), change(&a, &b));
        }
        for (label, side) in ["a", "b"].into_iter().zip(&self.sides) {
            for why in Self::reasons(side) {
                _ = writeln!(t, "{label}: {why}");
            }
        }
        let Pixels { all, color, depth, coverage, shown, largest } = self.pixels;
        if let [Some(a), Some(_)] = [a.distance, b.distance] {
            _ = writeln!(
                t,
                "shading equation: distance from it at each of {} pixels, LSB of 8 bits; each machine's errors are from what it draws",
                a.pixels
            );
        }
        _ = writeln!(
            t,
            "pixels that differ of {all}: colour {color} (by at most {largest:.4} of full scale), depth {depth}, coverage {coverage}, triangle {shown}"
        );
        t
    }
}

fn shown(value: &Value) -> String {
    match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => format!("{:.4}", number.as_f64().unwrap_or(f64::NAN)),
        other => other.to_string(),
    }
}

/// By how much of `a`, in per cent.
fn change(a: &Value, b: &Value) -> String {
    match (a.as_f64(), b.as_f64()) {
        (Some(a), Some(b)) if a != 0.0 => format!("{:+.1} %", 100.0 * (b - a) / a),
        _ => String::new(),
    }
}
