//! `Live` in Python: a unit of the model beside somebody's simulation.

use crate::error::Error;
use crate::machine::{Machine, dict, on_screen};
use crate::token::{bits, dictionary, read};
use crate::vectors::unit;
use edgewalk_lockstep::{Direction, Interface};
use edgewalk_machine::Unknown;
use edgewalk_vectors::live::{self, StartWords};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// A unit of the model that is fed token by token.
#[pyclass(module = "edgewalk")]
pub struct Live {
    interface: Interface,
    /// Reached by `get_mut` alone: two threads at once get Python's error of a borrowed object.
    unit: Mutex<live::Live>,
}

#[pymethods]
impl Live {
    #[new]
    #[pyo3(signature = (unit, machine = None, *, constants = None, memories = None, clear = None))]
    fn new(
        unit: &str,
        machine: Option<&Machine>,
        constants: Option<&Bound<'_, PyMapping>>,
        memories: Option<&Bound<'_, PyMapping>>,
        clear: Option<&Bound<'_, PyMapping>>,
    ) -> PyResult<Self> {
        let machine = on_screen(machine, None)?;
        let unit = self::unit(&machine, unit)?;
        let interface = Interface::new(&machine, unit);
        let constants = self::constants(&interface, constants.map(dict).transpose()?.as_ref())?;
        let constants: Vec<(&str, u128)> =
            constants.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let memories = start(
            &interface,
            memories.map(dict).transpose()?.as_ref(),
            clear.map(dict).transpose()?.as_ref(),
        )?;
        let made = live::Live::new(&machine, unit, &constants, &memories);
        let unit = made.map_err(|error| Error::new_err(error.to_string()))?;
        Ok(Live { interface, unit: Mutex::new(unit) })
    }

    /// Name of the link whose tokens are given.
    #[getter]
    fn takes(&self) -> &'static str {
        self.interface.links[0].name
    }

    /// Names of the links whose tokens come.
    #[getter]
    fn gives(&self) -> Vec<&'static str> {
        self.interface.links_of(Direction::Out).map(|link| link.name).collect()
    }

    /// For each link its ports: name, bits, whether it is signed.
    #[getter]
    fn ports<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for link in &self.interface.links {
            let ports = link.fields.iter().map(|port| (&port.name, port.width(), port.is_signed()));
            dict.set_item(link.name, PyList::new(py, ports)?)?;
        }
        Ok(dict)
    }

    /// Gives the unit a token, as it stood at its ports.
    fn give(&mut self, token: &Bound<'_, PyMapping>) -> PyResult<()> {
        let token = read(&self.interface.links[0], &dict(token)?)?;
        self.unit().give(&token);
        Ok(())
    }

    /// The next token of a link out; None if what was given makes no more.
    fn next<'py>(&mut self, py: Python<'py>, link: &str) -> PyResult<Option<Bound<'py, PyDict>>> {
        let links = &self.interface.links;
        let place = links.iter().position(|known| known.name == link && known.direction == Direction::Out);
        let place =
            place.ok_or_else(|| Error::new_err(Unknown::new("link", link, self.gives()).to_string()))?;
        let Some(token) = self.unit().next(place, || py.check_signals())? else { return Ok(None) };
        dictionary(py, &self.interface.links[place], &token).map(Some)
    }

    /// For each link out: the number of tokens left over.
    fn rest<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (link, count) in self.unit().rest(|| py.check_signals())? {
            dict.set_item(link, count)?;
        }
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        format!("<edgewalk.Live {}>", self.interface.unit.name())
    }
}

impl Live {
    fn unit(&mut self) -> &mut live::Live {
        self.unit.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Constants of the unit by name.
fn constants(interface: &Interface, given: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, u128)>> {
    let of = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name = name.str()?.to_string();
        let port = interface.constants.iter().find(|port| port.name == name);
        let port = port.ok_or_else(|| {
            let names = interface.constants.iter().map(|port| port.name.as_str());
            Error::new_err(Unknown::new("constant", &name, names).to_string())
        })?;
        let value = bits(&name, port.width(), port.is_signed(), &value)?;
        Ok((name, value))
    };
    given.into_iter().flatten().map(of).collect()
}

/// The memories that are named, as they are at the start.
fn start(
    interface: &Interface,
    words: Option<&Bound<'_, PyDict>>,
    clear: Option<&Bound<'_, PyDict>>,
) -> PyResult<BTreeMap<String, StartWords>> {
    let mut all: BTreeMap<String, StartWords> = BTreeMap::new();
    for (is_clear, given) in [(false, words), (true, clear)] {
        for (name, value) in given.into_iter().flatten() {
            let name = name.str()?.to_string();
            let memory = interface.memories.iter().find(|memory| memory.name == name).ok_or_else(|| {
                let names = interface.memories.iter().map(|memory| memory.name);
                Error::new_err(Unknown::new("memory", &name, names).to_string())
            })?;
            let word =
                |value: &Bound<'_, PyAny>| bits(&format!("memory {name}"), memory.word_bits, false, value);
            let none = StartWords { first: Vec::new().into(), clear: None };
            let start = all.entry(name.clone()).or_insert(none);
            if is_clear {
                start.clear = Some(word(&value)?);
                continue;
            }
            start.first = value.try_iter()?.map(|value| word(&value?)).collect::<PyResult<_>>()?;
            if start.first.len() as u128 > 1 << memory.address_bits {
                let (found, permitted) = (start.first.len(), 1u128 << memory.address_bits);
                return Err(Error::new_err(format!("memory {name}: {found} words; permitted: {permitted}")));
            }
        }
    }
    Ok(all)
}
