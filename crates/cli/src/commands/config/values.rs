//! What each value of a key comes to: the machine with it beside that with the others.

use super::Precision;
use crate::estimator::Estimator;
use edgewalk_judge::verdict::{EVERY_PIXEL, holds};
use edgewalk_machine::Plan;
use edgewalk_machine::key::{Domain, Key};
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write as _;

/// The machine with one value of the key, the other keys as they are.
#[derive(Serialize)]
pub struct Consequence {
    value: String,
    /// Whether the machine asked for has it.
    asked_for: bool,
    /// Why the machine cannot be built.
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
    /// Clocks that a pixel of a span takes.
    #[serde(skip_serializing_if = "Option::is_none")]
    clocks_per_pixel: Option<u32>,
    /// Clocks that a triangle's setup takes at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    setup_clocks: Option<u32>,
    /// Largest errors of depth and colour in every frame, LSB, proved.
    bounds: [Option<f64>; 2],
    /// Why there is none.
    no_bounds: [Option<String>; 2],
    /// The pixels for which bounds hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    holds: Option<&'static str>,
    /// What `edgewalk estimate` says.
    estimate: Value,
}

/// Of all values of a key that has few of them; of a range its ends, the value asked for and those beside it.
pub fn consequences(machine: &Plan, key: &Key) -> Vec<Consequence> {
    let asked_for = (key.get)(machine);
    let values: Vec<u32> = match key.domain {
        Domain::Word(words) => (0..words.len() as u32).collect(),
        Domain::OneOf(values) => values.to_vec(),
        Domain::Range(low, high) => {
            let near = [low, asked_for.saturating_sub(1), asked_for, asked_for + 1, high];
            let mut values: Vec<u32> =
                near.into_iter().filter(|value| (low..=high).contains(value)).collect();
            values.dedup();
            values
        }
    };
    let estimator = Estimator::new("machine", Vec::new());
    let of = |value: u32| {
        let other = machine.with(|machine| (key.set)(machine, value));
        let built = other.clone().plan();
        let plan = built.as_ref().ok();
        let proofs = plan.map(Precision::of);
        Consequence {
            value: key.show(&other),
            asked_for: value == asked_for,
            refused: built.as_ref().err().map(ToString::to_string),
            clocks_per_pixel: plan.map(|plan| plan.clocks_per_pixel()),
            setup_clocks: plan.map(|plan| edgewalk_model::longest_setup(plan).all()),
            bounds: proofs.as_ref().map_or([None; 2], |proofs| proofs.bounds().map(|(bound, _)| bound)),
            no_bounds: proofs
                .as_ref()
                .map_or([None, None], |proofs| proofs.bounds().map(|(_, why)| why.map(str::to_owned))),
            holds: plan.map(|plan| holds(plan)),
            estimate: plan.map_or(Value::Null, |plan| estimator.value(plan)),
        }
    };
    values.into_iter().map(of).collect()
}

/// As a table. Writing to a string cannot fail.
pub fn text(all: &[Consequence]) -> String {
    let wide = all.iter().map(|of| of.value.len()).max().unwrap_or(0).max(5);
    let mut t = format!(
        "\n  {:<wide$}  {:>12}  {:>12}  {:>11}  {:>11}  {:>8}  {:>8}  {:>8}\n",
        "value", "clocks/pixel", "setup clocks", "z bound", "rgb bound", "est_lut4", "est_ff", "est_mhz"
    );
    for of in all {
        let mark = if of.asked_for { '*' } else { ' ' };
        if let Some(why) = &of.refused {
            _ = writeln!(t, "{mark} {:<wide$}  {why}", of.value);
            continue;
        }
        let whole = |value: Option<u32>| value.map_or_else(|| "-".to_owned(), |value| value.to_string());
        let bounds =
            of.bounds.map(|bound| bound.map_or_else(|| "none".to_owned(), |bound| format!("{bound:.4}")));
        let estimated = |at: &str| {
            of.estimate
                .pointer(at)
                .and_then(Value::as_f64)
                .map_or_else(|| "-".to_owned(), |v| format!("{v:.0}"))
        };
        _ = writeln!(
            t,
            "{mark} {:<wide$}  {:>12}  {:>12}  {:>11}  {:>11}  {:>8}  {:>8}  {:>8}",
            of.value,
            whole(of.clocks_per_pixel),
            whole(of.setup_clocks),
            bounds[0],
            bounds[1],
            estimated("/est_lut4/value"),
            estimated("/est_ff"),
            estimated("/est_mhz/value"),
        );
    }
    t += "  * this machine; bounds in LSB, proved; est_* by `edgewalk estimate`, of an iCE40\n";
    if let Some(some) = all.iter().filter_map(|of| of.holds).find(|holds| *holds != EVERY_PIXEL) {
        _ = writeln!(t, "  bounds of slope edges hold at {some}");
    }
    let mut told = Vec::new();
    for (bound, why) in all.iter().flat_map(|of| ["z", "rgb"].into_iter().zip(&of.no_bounds)) {
        if let Some(why) = why
            && !told.contains(&(bound, why))
        {
            _ = writeln!(t, "  no {bound} bound: {why}");
            told.push((bound, why));
        }
    }
    t
}
