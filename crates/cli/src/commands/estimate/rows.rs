//! Machines beside their estimates, whatever is estimated.

use crate::Talk;
use anyhow::{Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_netlist::BuildErrors;
use edgewalk_synth::Part;
use serde::Serialize;
use std::time::Instant;

/// A machine and its estimate.
#[derive(Serialize)]
pub struct Row<E> {
    pub name: String,
    /// Hash of the machine.
    pub machine: String,
    /// A number for what the netlist computes. The text does not tell it.
    pub shape: Option<String>,
    #[serde(flatten)]
    pub estimate: E,
    /// What the estimate took, netlist included.
    pub milliseconds: f64,
}

/// A row for each machine, by the estimate of its part.
pub fn rows<E>(
    unit: &str,
    machines: &[(String, Plan)],
    talk: Talk,
    estimate: impl Fn(Part, &Plan) -> Result<E, BuildErrors>,
) -> Result<Vec<Row<E>>> {
    let mut rows = Vec::new();
    for (name, plan) in machines {
        let part = Part::named(unit, plan).map_err(|error| anyhow!("--unit {unit}: {error}"))?;
        let built = |error| anyhow!("{name}: the netlist cannot be built: {error}");
        let since = Instant::now();
        let estimate = estimate(part, plan).map_err(built)?;
        let milliseconds = since.elapsed().as_secs_f64() * 1000.0;
        let shape = talk.json.then(|| part.shape(plan).map(|shape| format!("{shape:016x}"))).transpose();
        rows.push(Row {
            name: if name.is_empty() { "default".to_owned() } else { name.clone() },
            machine: plan.hash(),
            shape: shape.map_err(built)?,
            estimate,
            milliseconds,
        });
    }
    Ok(rows)
}
