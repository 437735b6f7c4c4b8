//! A row: what a point is, and what became of it.

use super::equation::Distance;
use super::grid::Sweep;
use super::point::Point;
use anyhow::Result;
use edgewalk_judge::report::Report;
use edgewalk_judge::verdict::within;
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
    /// The machine cannot be drawn, a tool failed, an error exceeds the proved bound, or no pixel could be compared.
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

    /// The status of a row.
    #[must_use]
    pub fn of(row: &Value) -> Option<Status> {
        Status::ALL.into_iter().find(|status| row["status"] == status.name())
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

/// What a row says of its point, before anything is known of it.
pub(super) fn identity(sweep: &Sweep, point: &Point) -> Value {
    let way = sweep.drawn(point);
    let mut row = json!({
        "key": point.key,
        "status": null,
        "input": sweep.inputs[point.input].name,
        "input_hash": way.hash,
        "shading": way.shading,
        "machine": point.machine.hash(),
        "stalls": sweep.memories[point.memory].waits.to_string(),
        "version": sweep.definition.program,
        "synthesis": sweep.synth_identity(),
        "keys": keys(&point.machine),
    });
    if !sweep.requirements.is_empty() {
        row["require"] = sweep.require_identity().into();
    }
    row
}

/// What synthesis said, or what became of it.
pub type Cost = std::result::Result<Value, (Status, String)>;

/// What was found of a point that was drawn.
pub struct Found {
    /// As `render` has it.
    pub report: Report,
    /// How far the picture is from the shading equation, where that was asked for.
    pub equation: Option<Distance>,
    /// The estimate of the machine, where that was asked for.
    pub estimate: Option<Value>,
}

/// The row of a point that was drawn. `synthesise` counts the cells of a machine that meets all requirements.
///
/// # Errors
/// A report that cannot be written.
pub fn with_figures(
    sweep: &Sweep,
    point: &Point,
    plan: &Plan,
    found: Found,
    synthesise: Option<&(dyn Fn(&Plan) -> Cost + Sync)>,
) -> Result<Value> {
    let mut row = identity(sweep, point);
    row["status"] = Status::Ok.name().into();
    if let Some(comparison) = &found.report.comparison {
        row["verdict"] = comparison.verdict().word().into();
    }
    row["report"] = serde_json::to_value(found.report)?;
    row["slack"] = slack(&row["report"]);
    if let Some(distance) = found.equation {
        row["equation"] = serde_json::to_value(distance)?;
    }
    if let Some(estimate) = found.estimate {
        row["estimate"] = estimate;
    }
    // A machine that breaks a requirement already is not built.
    let counts = sweep.judge.memories.count(point.memory);
    let broken = counts && sweep.requirements.iter().any(|of| of.broken_by(&sweep.judge, &row));
    match synthesise.filter(|_| !broken).map(|synthesise| synthesise(plan)) {
        None => {}
        Some(Ok(synth)) => row["synth"] = synth,
        Some(Err((status, reason))) => {
            row["status"] = status.name().into();
            row["reason"] = reason.into();
        }
    }
    if row["verdict"] == "open" {
        row["status"] = Status::Failed.name().into();
        row["reason"] =
            "no pixel was compared: at each covered pixel a depth test is too near to be sure".into();
    }
    if is_beyond(&row) {
        row["status"] = Status::Failed.name().into();
        row["reason"] = "an error exceeds what is proved: a fault of edgewalk, not of the machine".into();
    }
    row["derived"] = derived(plan, &row["report"], &row["synth"]);
    Ok(row)
}

/// The largest error of each channel over the bound that is proved for these triangles; null where none is.
pub(super) fn slack(report: &Value) -> Value {
    let of = |channel: &str| {
        let figure = |name: &str| report["comparison"][format!("{channel}_{name}")].as_f64();
        Some(figure("error")? / figure("bound_for_input")?)
    };
    json!({ "z": of("z"), "color": of("color") })
}

/// Whether an error of the row exceeds the bound that is proved for these triangles. Of slope edges only errors inside the
/// triangles are taken.
#[must_use]
pub fn is_beyond(row: &Value) -> bool {
    let comparison = &row["report"]["comparison"];
    // An error that is no number is null.
    let beyond = |error: &Value, bound: &Value| {
        bound.as_f64().is_some_and(|bound| error.as_f64().is_none_or(|error| !within(error, bound)))
    };
    let own = comparison["extra"].as_array().into_iter().flatten();
    ["z", "color"].iter().any(|channel| {
        let of = |figure: &str| &comparison[format!("{channel}_{figure}")];
        beyond(of("error"), of("bound_for_input"))
    }) || own.into_iter().any(|own| beyond(&own["error"], &own["bound_for_input"]))
}

/// What follows from other figures of a machine.
pub(super) fn derived(plan: &Plan, report: &Value, synth: &Value) -> Value {
    let word_bits: u32 = plan.channels().iter().map(|channel| channel.word()).sum();
    let mut derived = json!({ "word_bits": word_bits });
    let figure = |of: &Value, pointer: &str| of.pointer(pointer).and_then(Value::as_f64);
    let (Some(cycles), Some(mhz)) = (figure(report, "/cycles/total"), figure(synth, "/mhz/median")) else {
        return derived;
    };
    let frames = mhz * 1e6 / cycles;
    let each = |name: &str| figure(report, name).unwrap_or(0.0);
    let pixels = each("/fragments") * frames / 1e6;
    let triangles = (each("/triangles") + each("/polygons")) * frames / 1e6;
    derived["frames_per_s"] = json!(frames);
    derived["mpixels_per_s"] = json!(pixels);
    derived["mtriangles_per_s"] = json!(triangles);
    if let Some(luts) = figure(synth, "/cells/lut4").filter(|luts| *luts > 0.0) {
        derived["mpixels_per_s_per_lut"] = json!(pixels / luts);
        derived["mtriangles_per_s_per_lut"] = json!(triangles / luts);
    }
    derived
}

/// Names of the causes of cycles.
pub fn causes() -> impl Iterator<Item = &'static str> {
    Activity::ALL.into_iter().map(Activity::name)
}
