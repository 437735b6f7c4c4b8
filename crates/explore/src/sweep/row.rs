//! A row: what a point is, and what became of it.

use super::point::{Point, Sweep};
use super::shared::plan;
use anyhow::Result;
use edgewalk_judge::Verdict;
use edgewalk_judge::compare::ChannelError;
use edgewalk_judge::report::Report;
use edgewalk_machine::key::Domain;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::Activity;
use serde_json::{Map, Value, json};

/// What became of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All of it is known.
    Ok,
    /// Not simulated: a bound says that it is not wanted.
    Pruned,
    /// The machine cannot be built.
    Invalid,
    /// It cannot be drawn, or a tool failed.
    Failed,
    /// A tool took too long.
    Timeout,
}

impl Status {
    /// All of them.
    pub const ALL: [Status; 5] =
        [Status::Ok, Status::Pruned, Status::Invalid, Status::Failed, Status::Timeout];

    /// The word in rows.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["ok", "pruned", "invalid", "failed", "timeout"][self as usize]
    }
}

/// Every key of a machine that means something in it, numbers as numbers.
#[must_use]
pub fn keys(machine: &Machine) -> Map<String, Value> {
    let used = KEYS.iter().filter(|key| (key.used)(machine));
    let value = |key: &edgewalk_machine::key::Key| match key.domain {
        Domain::Word(_) => json!(key.show(machine)),
        _ => json!((key.get)(machine)),
    };
    used.map(|key| (key.name.to_owned(), value(key))).collect()
}

/// The row of a point without figures.
#[must_use]
pub fn without_figures(sweep: &Sweep, point: &Point, status: Status, reason: &str) -> Value {
    let mut row = identity(sweep, point);
    row["status"] = status.name().into();
    row["reason"] = reason.into();
    row
}

fn identity(sweep: &Sweep, point: &Point) -> Value {
    let (input, input_hash) = &sweep.inputs[point.input];
    json!({
        "key": point.key,
        "status": null,
        "input": input.name(),
        "input_hash": input_hash,
        "machine": point.machine.hash(),
        "stalls": sweep.waits[point.waits].to_string(),
        "version": sweep.definition.version,
        "synthesis": sweep.synth_identity(),
        "keys": keys(&point.machine),
    })
}

/// What synthesis said, or what became of it.
pub type Cost = std::result::Result<Value, (Status, String)>;

/// The row of a point that was drawn. `proved`: an error above its bound is the program's own fault.
///
/// # Errors
/// A report that cannot be written.
pub fn with_figures(
    sweep: &Sweep,
    point: &Point,
    report: &Report,
    proved: bool,
    cost: Option<Cost>,
) -> Result<Value> {
    let mut row = identity(sweep, point);
    row["status"] = Status::Ok.name().into();
    let slack = |channel: &ChannelError| channel.bound_for_input.map(|bound| channel.error / bound);
    if let Some(c) = &report.comparison {
        row["verdict"] = json!(match c.verdict() {
            Verdict::Pass => "pass",
            Verdict::Mismatch => "mismatch",
            Verdict::Vacuous => "vacuous",
        });
        let [z, color] = [&c.errors.z, &c.errors.color].map(slack);
        row["slack"] = json!({ "z": z, "color": color });
        if proved && [z, color].into_iter().flatten().any(|slack| slack > 1.0 || slack.is_nan()) {
            row["status"] = Status::Failed.name().into();
            row["reason"] = "an error exceeds what is proved: a fault of edgewalk, not of the machine".into();
        }
    }
    row["report"] = serde_json::to_value(report)?;
    match cost {
        None => {}
        Some(Ok(synth)) => row["synth"] = synth,
        Some(Err((status, reason))) => {
            row["status"] = status.name().into();
            row["reason"] = reason.into();
        }
    }
    if let Some(plan) = plan(point) {
        row["derived"] = derived(plan, report, &row["synth"]);
    }
    Ok(row)
}

/// What follows from other figures.
fn derived(plan: &Plan, report: &Report, synth: &Value) -> Value {
    let word_bits: u32 = plan.channels().iter().map(|channel| channel.word()).sum();
    let mut derived = json!({ "word_bits": word_bits });
    let (Some(cycles), Some(mhz)) = (&report.cycles, synth.pointer("/mhz/median").and_then(Value::as_f64))
    else {
        return derived;
    };
    let seconds = cycles.total as f64 / (mhz * 1e6);
    let (pixels, triangles) =
        (report.drawn.fragments as f64 / seconds / 1e6, report.drawn.primitives() as f64 / seconds / 1e6);
    derived["frames_per_s"] = json!(1.0 / seconds);
    derived["mpixels_per_s"] = json!(pixels);
    derived["mtriangles_per_s"] = json!(triangles);
    if let Some(luts) = synth.pointer("/cells/lut4").and_then(Value::as_f64).filter(|luts| *luts > 0.0) {
        derived["mpixels_per_s_per_lut"] = json!(pixels / luts);
        derived["mtriangles_per_s_per_lut"] = json!(triangles / luts);
    }
    derived
}

/// Names of the causes of cycles.
pub fn causes() -> impl Iterator<Item = &'static str> {
    Activity::ALL.into_iter().map(Activity::name)
}
