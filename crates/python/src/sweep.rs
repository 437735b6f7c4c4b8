//! `Sweep` and `sweep` in Python.

use crate::error::{Error, run};
use crate::machine::{Machine, dict, on_screen, word};
use crate::number::whole;
use crate::token::structured;
use anyhow::{Result, anyhow};
use edgewalk_explore::sweep::check::check;
use edgewalk_explore::sweep::csv::columns;
use edgewalk_explore::sweep::evaluate::{Around, missing, run as evaluate};
use edgewalk_explore::sweep::table::Table;
use edgewalk_explore::sweep::{self as explored, Definition, Judge, Sample, Store, store};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping, PyString};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Many machines on the same inputs, each with a row.
#[pyclass(module = "edgewalk", frozen)]
pub struct Sweep {
    sweep: explored::Sweep,
    rows: BTreeMap<String, Value>,
    /// The same rows as they were written: a number that is read and written again may change in its last digit.
    lines: BTreeMap<String, String>,
}

#[pymethods]
impl Sweep {
    /// The rows in the order of the points: dictionaries, as the lines of the program's `runs.jsonl`.
    #[getter]
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let table = self.rows_by_machine();
        let rows = table.rows.iter().map(|row| self.loaded(py, row));
        PyList::new(py, rows.collect::<PyResult<Vec<_>>>()?)
    }

    /// The rows as a structured array (N,) with the columns of the program's `runs.csv`.
    #[getter]
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let table = self.rows_by_machine();
        let fronts = table.front_of();
        let front = |row: &Value| {
            let front = row["key"].as_str().and_then(|key| fronts.get(key));
            front.map_or(Value::Null, |front| Value::from(*front))
        };
        let of = |(name, pointer): (String, String)| {
            let values = table.rows.iter().map(|row| row.pointer(&pointer).cloned().unwrap_or_default());
            Ok((name, column(py, &values.collect::<Vec<_>>())?))
        };
        let mut all = columns(&table).into_iter().map(of).collect::<PyResult<Vec<_>>>()?;
        let of_front: Vec<Value> = table.rows.iter().map(|row| front(row)).collect();
        all.push(("front".to_owned(), column(py, &of_front)?));
        structured(py, table.rows.len(), &all)
    }

    /// For each objective the first row of the best machine; None where its value is not known of any.
    #[getter]
    fn best<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (table, dict) = (self.rows_by_machine(), PyDict::new(py));
        for objective in &self.sweep.objectives {
            let best = table.best(objective).map(|machine| machine.row());
            dict.set_item(objective.name, best.map(|row| self.loaded(py, row)).transpose()?)?;
        }
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        format!("<edgewalk.Sweep of {} machines>", self.sweep.machines)
    }
}

impl Sweep {
    fn rows_by_machine(&self) -> Table<'_> {
        Table::new(&self.sweep, &self.rows)
    }

    /// A row as it was written, as Python has JSON.
    fn loaded<'py>(&self, py: Python<'py>, row: &Value) -> PyResult<Bound<'py, PyAny>> {
        let line = row["key"].as_str().and_then(|key| self.lines.get(key));
        let line = line.map_or_else(|| row.to_string(), Clone::clone);
        py.import("json")?.call_method1("loads", (line,))
    }
}

/// A column: int64 where all are integers, float64 with nan where numbers are missing, else text, which is empty where it is missing.
fn column<'py>(py: Python<'py>, values: &[Value]) -> PyResult<Bound<'py, PyAny>> {
    let numpy = py.import("numpy")?;
    if values.iter().all(Value::is_i64) {
        let numbers: Vec<i64> = values.iter().filter_map(Value::as_i64).collect();
        return numpy.call_method1("array", (numbers, "int64"));
    }
    if values.iter().all(|value| value.is_number() || value.is_null()) {
        let numbers: Vec<f64> = values.iter().map(|value| value.as_f64().unwrap_or(f64::NAN)).collect();
        return numpy.call_method1("array", (numbers, "float64"));
    }
    let texts = values.iter().map(|value| match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Array(list) => {
            let text = |item: &Value| item.as_str().map_or_else(|| item.to_string(), str::to_owned);
            list.iter().map(text).collect::<Vec<_>>().join("; ")
        }
        other => other.to_string(),
    });
    numpy.call_method1("array", (texts.collect::<Vec<_>>(), "str"))
}

/// Draws inputs on many machines.
#[pyfunction]
#[pyo3(signature = (
    inputs, vary, machine = None, *, shading = None, stalls = Vec::new(), judge = Judge::WORST, judge_inputs = Judge::SUM,
    weights = None, sample = None, seed = None, bound = None, objectives = Vec::new(), store = None
))]
#[allow(clippy::too_many_arguments)] // the arguments of a call in Python, by name
pub fn sweep(
    py: Python<'_>,
    inputs: &Bound<'_, PyAny>,
    vary: &Bound<'_, PyMapping>,
    machine: Option<&Machine>,
    shading: Option<String>,
    stalls: Vec<String>,
    judge: &str,
    judge_inputs: &str,
    weights: Option<BTreeMap<String, f64>>,
    sample: Option<&Bound<'_, PyAny>>,
    seed: Option<&Bound<'_, PyAny>>,
    bound: Option<f64>,
    objectives: Vec<String>,
    store: Option<PathBuf>,
) -> PyResult<Sweep> {
    let seed = whole("seed", seed, 1, 0..=u64::MAX)?;
    let most = u64::from(u32::MAX);
    let points = sample.map(|points| whole("sample", Some(points), 0, 0..=most)).transpose()?;
    let definition = Definition {
        inputs: names(inputs)?,
        shading,
        machine: on_screen(machine, None)?.every_key_to_toml(),
        vary: dict(vary)?.iter().map(|(key, values)| varied(&key, &values)).collect::<PyResult<_>>()?,
        stalls,
        judge: judge.to_owned(),
        judge_inputs: judge_inputs.to_owned(),
        weights: weights.into_iter().flatten().map(|(input, weight)| format!("{input}={weight}")).collect(),
        // The range above fits.
        sample: points.and_then(|points| Some(Sample { points: points.try_into().ok()?, seed })),
        bound,
        objectives,
        ..Definition::default()
    };
    run(py, || {
        swept(definition, store.as_deref()).map_err(|error| anyhow!(without_dashes(&format!("{error:#}"))))
    })
}

/// The program's message; its options are arguments here.
fn without_dashes(message: &str) -> String {
    message.strip_prefix("--").unwrap_or(message).replace(" --", " ")
}

/// A name, or a list of them.
fn names(inputs: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let one = |input: &Bound<'_, PyAny>| {
        let path = input.extract::<PathBuf>().map_err(|_| {
            let found = input.get_type().to_string();
            Error::new_err(format!("inputs: {found}; permitted: names of scenes, and paths of files"))
        })?;
        Ok(path.display().to_string())
    };
    if inputs.is_instance_of::<PyList>() {
        return inputs.try_iter()?.map(|input| one(&input?)).collect();
    }
    Ok(vec![one(inputs)?])
}

/// A key and its values as the program takes them: `key=a,b,c`, or `key=lo..hi` where the values are a text.
fn varied(key: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>) -> PyResult<String> {
    let values = if values.is_instance_of::<PyString>() {
        word(values)?
    } else {
        let all = values.try_iter()?.map(|value| word(&value?));
        all.collect::<PyResult<Vec<_>>>()?.join(",")
    };
    Ok(format!("{}={values}", key.str()?))
}

/// Runs what has no row in the file; without a file everything.
fn swept(definition: Definition, file: Option<&Path>) -> Result<Sweep> {
    let sweep = explored::Sweep::new(definition)?;
    let folder = tempfile::tempdir()?;
    let path = file.map_or_else(|| folder.path().join("runs.jsonl"), Path::to_owned);
    let (store, rows) = Store::open(&path)?;
    let rows = store::by_key(rows);
    check(&sweep, &rows).map_err(|why| anyhow!("{}: {why}", path.display()))?;
    let points: Vec<_> = sweep.points.iter().collect();
    let todo = missing(&sweep, &points, &rows, &[]);
    evaluate(&sweep, &todo, &Around { store: &store, cost: None, estimate: None, done: &|| {} })?;
    let rows = store::by_key(store::read(&path)?);
    Ok(Sweep { sweep, rows, lines: store::lines(&path)? })
}
