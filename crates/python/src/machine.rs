//! `Machine` in Python.

use crate::error::{Error, raised};
use anyhow::Result;
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Plan, Unknown};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyMapping};

/// A checked machine: a preset or a machine file, with keys of its own. It never changes.
#[pyclass(module = "edgewalk", frozen)]
pub struct Machine(pub Plan);

/// Names and descriptions of the presets.
#[pyfunction]
pub fn presets() -> Vec<(&'static str, &'static str)> {
    PRESETS.to_vec()
}

#[pymethods]
impl Machine {
    #[new]
    #[pyo3(signature = (preset = "default", keys = None))]
    fn new(preset: &str, keys: Option<&Bound<'_, PyMapping>>) -> PyResult<Self> {
        let machine = edgewalk_machine::Machine::preset(preset).ok_or_else(|| {
            Error::new_err(Unknown::new("preset", preset, PRESETS.iter().map(|p| p.0)).to_string())
        })?;
        with_keys(machine, keys)
    }

    /// The machine of a machine file's text.
    #[staticmethod]
    #[pyo3(signature = (text, keys = None))]
    fn from_toml(text: &str, keys: Option<&Bound<'_, PyMapping>>) -> PyResult<Self> {
        let machine =
            edgewalk_machine::Machine::from_toml(text).map_err(|e| Error::new_err(e.to_string()))?;
        with_keys(machine, keys)
    }

    /// Another machine, with these keys changed.
    fn with_keys(&self, keys: &Bound<'_, PyMapping>) -> PyResult<Self> {
        with_keys(edgewalk_machine::Machine::clone(&self.0), Some(keys))
    }

    /// The machine as a file, every key with its meaning.
    fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    /// Twelve hex digits that stand for this machine.
    #[getter]
    fn hash(&self) -> String {
        self.0.hash()
    }

    /// Columns of the screen.
    #[getter]
    fn width(&self) -> u32 {
        self.0.width
    }

    /// Lines of the screen.
    #[getter]
    fn height(&self) -> u32 {
        self.0.height
    }

    /// Bits of a stored depth.
    #[getter]
    fn depth_bits(&self) -> u32 {
        self.0.z.bits
    }

    /// Bits of a stored colour.
    #[getter]
    fn color_bits(&self) -> u32 {
        self.0.stored_color().bits
    }

    fn __repr__(&self) -> String {
        format!("<edgewalk.Machine {} {}x{}>", self.0.hash(), self.0.width, self.0.height)
    }
}

fn with_keys(
    mut machine: edgewalk_machine::Machine,
    keys: Option<&Bound<'_, PyMapping>>,
) -> PyResult<Machine> {
    for (key, value) in keys.map(dict).transpose()?.into_iter().flatten() {
        let (key, text) = (key.str()?.to_string(), word(&value)?);
        machine.set(&key, &text).map_err(|e| Error::new_err(format!("{key} = {text}: {e}")))?;
    }
    Ok(Machine(machine.plan().map_err(|e| Error::new_err(e.to_string()))?))
}

/// A value of a key as in a machine file; a bool is yes or no.
pub fn word(value: &Bound<'_, PyAny>) -> PyResult<String> {
    match value.is_instance_of::<PyBool>() {
        true => Ok(if value.is_truthy()? { "yes" } else { "no" }.to_owned()),
        false => Ok(value.str()?.to_string()),
    }
}

/// A mapping as a dict.
pub fn dict<'py>(mapping: &Bound<'py, PyMapping>) -> PyResult<Bound<'py, PyDict>> {
    PyDict::from_sequence(mapping.items()?.as_any())
}

/// The machine asked for or the default one, with a screen of this size where a file has one.
pub fn on_screen(machine: Option<&Machine>, size: Option<(u32, u32)>) -> PyResult<Plan> {
    let plan = || -> Result<Plan> {
        let mut machine = machine
            .map_or_else(edgewalk_machine::Machine::default, |m| edgewalk_machine::Machine::clone(&m.0));
        if let Some((width, height)) = size {
            machine.set("screen.width", &width.to_string())?;
            machine.set("screen.height", &height.to_string())?;
        }
        Ok(machine.plan()?)
    };
    plan().map_err(|error| raised(&error))
}
