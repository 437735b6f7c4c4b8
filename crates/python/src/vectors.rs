//! `Vectors` and `vectors` in Python.

use crate::array::array;
use crate::error::{Error, run};
use crate::machine::{Machine, on_screen};
use crate::number::whole;
use crate::source;
use crate::token::{columns, structured};
use anyhow::{Context, Result, anyhow, ensure};
use edgewalk_host::port::to_port;
use edgewalk_machine::{Plan, Unknown};
use edgewalk_vectors::suites::input::Sent;
use edgewalk_vectors::{
    LinkTrace, MAX_COUNT, SUITES, StallKind, Suite, Tables, Trace, Unit, capture, design, directory, manifest,
};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};

/// What moves at the ports of a unit over a suite.
#[pyclass(module = "edgewalk", frozen)]
pub struct Vectors {
    suite: Suite,
    trace: Trace,
}

/// Names and descriptions of the suites that say something about the machine.
#[pyfunction]
#[pyo3(signature = (machine = None))]
pub fn suites(machine: Option<&Machine>) -> PyResult<Vec<(&'static str, &'static str)>> {
    let machine = on_screen(machine, None)?;
    let suites = SUITES.iter().filter(|suite| suite.is_for(&machine));
    Ok(suites.map(|suite| (suite.name, suite.about)).collect())
}

#[pymethods]
impl Vectors {
    /// Name of the directory that the program would write: suite and unit.
    #[getter]
    fn name(&self) -> String {
        format!("{}_{}", self.suite.name, self.trace.interface.unit.name())
    }

    /// Names of the links: those into the unit, then those out of it.
    #[getter]
    fn links(&self) -> Vec<&'static str> {
        self.trace.interface.links.iter().map(|link| link.name).collect()
    }

    /// Tokens and changes of the status ports that a bench compares.
    #[getter]
    fn expected(&self) -> u64 {
        self.trace.expected()
    }

    /// Cycles until nothing more happens.
    #[getter]
    fn total_cycles(&self) -> u64 {
        self.trace.cycles
    }

    /// Tokens of a link in order: structured array (N,), a field for each port.
    fn tokens<'py>(&self, py: Python<'py>, link: &str) -> PyResult<Bound<'py, PyAny>> {
        let (place, moved) = self.moved(link)?;
        let columns = columns(py, &self.trace.interface.links[place].fields, &moved.tokens)?;
        structured(py, moved.tokens.len(), &columns)
    }

    /// The cycle in which each token of a link moves: uint64 (N,).
    fn cycles<'py>(&self, py: Python<'py>, link: &str) -> PyResult<Bound<'py, PyArrayDyn<u64>>> {
        let (_, moved) = self.moved(link)?;
        array(py, moved.cycles.clone(), &[moved.cycles.len()])
    }

    /// Number of the triangle that each token of a link belongs to: uint32 (N,); None where a link does not know.
    fn triangles<'py>(&self, py: Python<'py>, link: &str) -> PyResult<Option<Bound<'py, PyArrayDyn<u32>>>> {
        let (_, moved) = self.moved(link)?;
        if moved.triangles.len() != moved.tokens.len() {
            return Ok(None);
        }
        array(py, moved.triangles.clone(), &[moved.triangles.len()]).map(Some)
    }

    /// Changes of the status ports: structured array with the cycle and a field for each port.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (cycles, tokens): (Vec<u64>, Vec<_>) = self.trace.status.iter().cloned().unzip();
        let ports = edgewalk_lockstep::status_ports(&self.trace.interface);
        let ports: Vec<_> = ports.into_iter().map(|status| status.port).collect();
        let count = cycles.len();
        let cycle = array(py, cycles, &[count])?.into_any();
        let columns = [vec![("cycle".to_owned(), cycle)], columns(py, &ports, &tokens)?].concat();
        structured(py, count, &columns)
    }

    /// The manifest of the directory: `manifest.json` as a dictionary.
    #[getter]
    fn manifest<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let files = run(py, || self.files(false))?;
        let text = &files.iter().find(|(name, _)| name == manifest::FILE).ok_or_else(|| {
            Error::new_err("a defect of edgewalk: no manifest; permitted: none; report it with the input")
        })?;
        py.import("json")?.call_method1("loads", (text.1.as_slice(),))
    }

    /// Writes the directory as the program does, with a bench for Icarus and Verilator.
    #[pyo3(signature = (directory, *, tables = false))]
    fn write(&self, py: Python<'_>, directory: PathBuf, tables: bool) -> PyResult<()> {
        run(py, || write(&directory, &self.files(tables)?))
    }

    fn __repr__(&self) -> String {
        format!("<edgewalk.Vectors {}: {} expected>", self.name(), self.expected())
    }
}

impl Vectors {
    fn moved(&self, link: &str) -> PyResult<(usize, &LinkTrace)> {
        let place = self.trace.interface.links.iter().position(|known| known.name == link);
        let place =
            place.ok_or_else(|| Error::new_err(Unknown::new("link", link, self.links()).to_string()))?;
        Ok((place, &self.trace.links[place]))
    }

    fn files(&self, tables: bool) -> Result<edgewalk_vectors::Files> {
        let tables = if tables { Tables::Written } else { Tables::LeftOut };
        let verilog = design::verilog(&self.trace.plan, self.trace.interface.unit)?;
        Ok(directory(&self.suite, &self.trace, &verilog, tables))
    }
}

/// Writes files into a folder that is new, empty, or of vectors.
fn write(folder: &Path, files: &edgewalk_vectors::Files) -> Result<()> {
    let named = || folder.display().to_string();
    let occupied = folder.exists() && fs::read_dir(folder).with_context(named)?.next().is_some();
    ensure!(
        !occupied || folder.join(manifest::FILE).exists(),
        "{}: a folder with other files; permitted: a new or empty one, or one of vectors",
        named()
    );
    for (name, contents) in files {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        let written = fs::create_dir_all(parent).and_then(|()| fs::write(&path, contents));
        written.with_context(|| path.display().to_string())?;
    }
    Ok(())
}

/// The unit of that name, which the machine has.
pub fn unit(machine: &Plan, name: &str) -> PyResult<Unit> {
    let all = Unit::all(machine);
    all.iter().copied().find(|unit| unit.name() == name).ok_or_else(|| {
        let unknown = Unknown::new("unit", name, all.iter().map(|unit| unit.name()));
        Error::new_err(format!("{unknown}; or set the keys that give the machine this unit"))
    })
}

fn stall_kind(name: &str) -> PyResult<StallKind> {
    StallKind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| {
        let names = StallKind::ALL.map(StallKind::name);
        Error::new_err(Unknown::new("stalls", name, names).to_string())
    })
}

/// Runs a unit of the model over a suite, or over triangles.
#[pyfunction]
#[pyo3(signature = (
    machine = None, *, unit = "machine", suite = None, triangles = None, header = "", only = Vec::new(), stalls = None,
    seed = None, count = None
))]
#[allow(clippy::too_many_arguments)] // the arguments of a call in Python, by name
pub fn vectors(
    py: Python<'_>,
    machine: Option<&Machine>,
    unit: &str,
    suite: Option<&str>,
    triangles: Option<&Bound<'_, PyAny>>,
    header: &str,
    only: Vec<String>,
    stalls: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
    count: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vectors> {
    let stalls = stalls.map(stall_kind).transpose()?;
    let seed = whole("seed", seed, 1, 0..=u64::MAX)?;
    let count = whole("count", count, 100, 1..=MAX_COUNT)?;
    let (machine, frame) = match triangles {
        None => (on_screen(machine, None)?, None),
        Some(_) if suite.is_some() => {
            return Err(Error::new_err("suite and triangles; permitted: one of the two"));
        }
        Some(triangles) => {
            let (machine, frame) = source::frame(triangles, machine, header)?;
            let name = triangles
                .extract::<PathBuf>()
                .map_or_else(|_| "triangles".to_owned(), |p| p.display().to_string());
            (machine, Some((name, frame)))
        }
    };
    let unit = self::unit(&machine, unit)?;
    run(py, || {
        let of = match &frame {
            None => named(&machine, suite.unwrap_or("hazards"), seed, count)?,
            Some((name, frame)) => {
                let port = to_port(frame, &machine)?;
                let map = port.passes.first().and_then(|pass| port.lights.get(pass.map?));
                let sent = Sent {
                    triangles: &port.triangles,
                    ids: &port.ids,
                    state: port.one_state()?,
                    map: map.map(|map| map.words.as_slice()),
                    shading: port.words(),
                };
                Suite { seed, ..Suite::of_input(&machine, name, &sent, None)? }
            }
        };
        let of = cases(of, &only)?;
        ensure!(
            of.is_for(unit),
            "unit {}: the suite {} says nothing about it; permitted: {}",
            unit.name(),
            of.name,
            of.units.iter().map(|unit| unit.name()).collect::<Vec<_>>().join(", ")
        );
        let trace = capture(&machine, unit, &of, of.state, stalls.unwrap_or(of.stalls));
        Ok(Vectors { suite: of, trace })
    })
}

/// The suite of that name, which says something about the machine.
fn named(machine: &Plan, name: &str, seed: u64, count: u64) -> Result<Suite> {
    let fitting = SUITES.iter().filter(|suite| suite.is_for(machine)).map(|suite| suite.name);
    ensure!(fitting.clone().any(|known| known == name), "{}", Unknown::new("suite", name, fitting));
    Ok(Suite::named(machine, name, seed, count)?)
}

/// The suite's cases of these names; all, if none is named.
fn cases(suite: Suite, only: &[String]) -> Result<Suite> {
    let names: Vec<&str> = suite.cases.iter().map(|case| case.name.as_str()).collect();
    if let Some(name) = only.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(anyhow!("only: {}", Unknown::new("case", name, names)));
    }
    Ok(if only.is_empty() { suite } else { suite.only(only) })
}
