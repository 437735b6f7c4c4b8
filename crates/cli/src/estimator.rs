//! The estimate of one machine after another, for sweeps and comparisons.

use edgewalk_machine::Plan;
use edgewalk_synth::estimate::{Fit, Kept, fits};
use edgewalk_synth::{Fpga, Part, Target, memories};
use serde_json::{Value, json};

/// Estimates machines.
pub struct Estimator {
    /// The fit of a family, and what is kept of machines before. Rows have the figures of the first one.
    families: Vec<(Fpga, Fit, Kept)>,
    /// machine, engine, or a unit.
    unit: String,
    devices: Vec<Target>,
}

impl Estimator {
    /// Of a part of each machine, by the fit in the tree; each estimate says whether it fits these devices.
    pub fn new(unit: &str, devices: Vec<Target>) -> Estimator {
        let wanted =
            |family: &Fpga| *family == Fpga::Ice40 || devices.iter().any(|device| device.family == *family);
        let families = Fpga::ALL.into_iter().filter(wanted).map(|family| {
            let fit = Fit::known(family);
            (family, fit.clone(), Kept::new(fit.delays, family))
        });
        Estimator { families: families.collect(), unit: unit.to_owned(), devices }
    }

    /// As rows have it; null for a machine that has no such unit.
    pub fn value(&self, machine: &Plan) -> Value {
        let Ok(part) = Part::named(&self.unit, machine) else { return Value::Null };
        let mut value = Value::Null;
        let mut devices = Vec::new();
        for (family, fit, kept) in &self.families {
            let Ok(structure) = part.structure(machine, kept) else { return Value::Null };
            let estimate = fit.estimate(&structure);
            for device in self.devices.iter().filter(|device| device.family == *family) {
                devices.push(fits(&estimate, memories(machine, part), device));
            }
            if value.is_null() {
                value = json!(estimate);
            }
        }
        value["fits"] = json!(devices);
        value
    }
}
