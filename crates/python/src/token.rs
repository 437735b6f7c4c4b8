//! Tokens of a link in Python: a record for many, a dictionary for one.

use crate::array::array;
use crate::error::Error;
use edgewalk_lockstep::{Link, Port, Token};
use edgewalk_machine::Unknown;
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Bits of the largest integer that numpy has.
const LARGEST: u32 = 64;

/// Values of a port: int64 where it is signed, uint64 else; Python's integers where it has more than 64 bits.
fn column<'py>(py: Python<'py>, port: &Port, values: &[u128]) -> PyResult<Bound<'py, PyAny>> {
    let shape = [values.len()];
    if port.width() > LARGEST {
        let numbers = values.iter().map(|value| number(py, port, *value)).collect::<PyResult<Vec<_>>>()?;
        return objects(py, &numbers);
    }
    if port.is_signed() {
        // A signed number of at most 64 bits.
        let numbers = values.iter().map(|value| port.number(*value) as i64).collect();
        let made: Bound<'py, PyArrayDyn<i64>> = array(py, numbers, &shape)?;
        return Ok(made.into_any());
    }
    let made: Bound<'py, PyArrayDyn<u64>> = array(py, values.iter().map(|v| *v as u64).collect(), &shape)?;
    Ok(made.into_any())
}

/// An array of Python's objects.
fn objects<'py>(py: Python<'py>, values: &[Bound<'py, PyAny>]) -> PyResult<Bound<'py, PyAny>> {
    let numpy = py.import("numpy")?;
    let made = numpy.call_method1("empty", (values.len(), "O"))?;
    made.set_item(pyo3::types::PySlice::full(py), PyList::new(py, values)?)?;
    Ok(made)
}

/// A port's value as Python's integer, with its sign.
fn number<'py>(py: Python<'py>, port: &Port, value: u128) -> PyResult<Bound<'py, PyAny>> {
    Ok(if port.is_signed() {
        port.number(value).into_pyobject(py)?.into_any()
    } else {
        value.into_pyobject(py)?.into_any()
    })
}

/// A structured array of these columns, which have `count` rows.
pub fn structured<'py>(
    py: Python<'py>,
    count: usize,
    columns: &[(String, Bound<'py, PyAny>)],
) -> PyResult<Bound<'py, PyAny>> {
    let types = columns.iter().map(|(name, column)| Ok((name, column.getattr("dtype")?)));
    let types = PyList::new(py, types.collect::<PyResult<Vec<_>>>()?)?;
    let made = py.import("numpy")?.call_method1("empty", (count, types))?;
    for (name, column) in columns {
        made.set_item(name, column)?;
    }
    Ok(made)
}

/// The ports' columns of many tokens.
pub fn columns<'py>(
    py: Python<'py>,
    ports: &[Port],
    tokens: &[Token],
) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    let of = |(place, port): (usize, &Port)| {
        let values: Vec<u128> = tokens.iter().map(|token| token[place]).collect();
        Ok((port.name.clone(), column(py, port, &values)?))
    };
    ports.iter().enumerate().map(of).collect()
}

/// A token as port: value.
pub fn dictionary<'py>(py: Python<'py>, link: &Link, token: &[u128]) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (port, value) in link.fields.iter().zip(token) {
        dict.set_item(&port.name, number(py, port, *value)?)?;
    }
    Ok(dict)
}

/// The token of a dictionary that has every port of the link: a value as the port's bits, or with its sign.
pub fn read(link: &Link, given: &Bound<'_, PyDict>) -> PyResult<Token> {
    for key in given.keys() {
        let name = key.str()?.to_string();
        let names = link.fields.iter().map(|port| port.name.as_str());
        if !names.clone().any(|known| known == name) {
            return Err(Error::new_err(Unknown::new("port", &name, names).to_string()));
        }
    }
    let value = |port: &Port| {
        let found = given.get_item(&port.name)?;
        let found = found.ok_or_else(|| {
            Error::new_err(format!(
                "token of {}: no {}; permitted: a value for each port",
                link.name, port.name
            ))
        })?;
        bits(&format!("token of {}: {}", link.name, port.name), port.width(), port.is_signed(), &found)
    };
    link.fields.iter().map(value).collect()
}

/// The bits of an integer, of so many; a negative one where there is a sign.
pub fn bits(name: &str, width: u32, signed: bool, value: &Bound<'_, PyAny>) -> PyResult<u128> {
    let largest = u128::MAX >> (128 - width);
    let least = if signed { -(1i128 << (width - 1)) } else { 0 };
    let refused = || {
        let found = value.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
        Error::new_err(format!("{name}: {found}; permitted: an integer in {least} to {largest}"))
    };
    if let Ok(bits) = value.extract::<u128>() {
        return if bits <= largest { Ok(bits) } else { Err(refused()) };
    }
    match value.extract::<i128>() {
        Ok(number) if number >= least => Ok(number as u128 & largest),
        _ => Err(refused()),
    }
}
