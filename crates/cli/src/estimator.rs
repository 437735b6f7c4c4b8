//! The estimate of one machine after another, for sweeps and comparisons.

use edgewalk_machine::Plan;
use edgewalk_synth::estimate::{Fit, Kept, fits};
use edgewalk_synth::{Part, Target, memories};
use serde_json::{Value, json};

/// Estimates machines.
pub struct Estimator {
    fit: Fit,
    kept: Kept,
    /// machine, engine, or a unit.
    unit: String,
    devices: Vec<Target>,
}

impl Estimator {
    /// Of a part of each machine, by the fit in the tree; each estimate says whether it fits these devices.
    pub fn new(unit: &str, devices: Vec<Target>) -> Estimator {
        let fit = Fit::known();
        Estimator { kept: Kept::new(fit.delays), fit, unit: unit.to_owned(), devices }
    }

    /// As rows have it; null for a machine that has no such unit.
    pub fn value(&self, machine: &Plan) -> Value {
        let Ok(part) = Part::named(&self.unit, machine) else { return Value::Null };
        let Ok(structure) = part.structure(machine, &self.kept) else { return Value::Null };
        let estimate = self.fit.estimate(&structure);
        let fits = |device| fits(&estimate, memories(machine, part), device);
        let devices: Vec<_> = self.devices.iter().map(fits).collect();
        let Ok(mut value) = serde_json::to_value(estimate) else { return Value::Null };
        value["fits"] = json!(devices);
        value
    }
}
