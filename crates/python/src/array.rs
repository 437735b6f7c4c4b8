//! Arrays of numpy in and out: row 0 on top, C order.

use crate::error::Error;
use edgewalk_judge::outside::picture::{self, Floats, Permitted};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// An array of this shape, which has as many places as there are values.
pub fn array<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    numpy::PyArray1::from_vec(py, values).reshape(shape)
}

/// Anything that numpy makes an array of.
struct Given<'py> {
    name: &'static str,
    array: Bound<'py, PyAny>,
    kind: String,
}

impl<'py> Given<'py> {
    fn new(name: &'static str, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
        let kind = array.getattr("dtype")?.getattr("kind")?.extract()?;
        Ok(Given { name, array, kind })
    }

    fn of_another_type(&self, permitted: &str) -> PyErr {
        let found = self.array.getattr("dtype").map_or_else(|_| "unknown".to_owned(), |t| t.to_string());
        Error::new_err(format!("{}: its type is {found}; permitted: {permitted}", self.name))
    }

    /// The values as this type of numpy's, if the shape is this.
    fn values<T: Element + Copy>(&self, kind: &str, shape: &[usize]) -> PyResult<Vec<T>> {
        let array = self.array.call_method1("astype", (kind,))?;
        let array: PyReadonlyArrayDyn<'py, T> = array.extract()?;
        if array.shape() != shape {
            let found = array.shape();
            let message = format!("{}: its shape is {found:?}; permitted: {shape:?}", self.name);
            return Err(Error::new_err(message));
        }
        Ok(array.as_array().iter().copied().collect())
    }
}

/// Floats of any shape `(N, ..)` whose other sides are these.
pub fn floats(name: &'static str, value: &Bound<'_, PyAny>, sides: &[usize]) -> PyResult<Vec<f64>> {
    let given = Given::new(name, value)?;
    if !["f", "i", "u"].contains(&&*given.kind) {
        return Err(given.of_another_type("floats"));
    }
    let found: Vec<usize> = given.array.getattr("shape")?.extract()?;
    let count = found.first().copied().unwrap_or(0);
    if found.is_empty() || found[1..] != *sides {
        let message = format!("{name}: its shape is {found:?}; permitted: (N, {sides:?})");
        return Err(Error::new_err(message));
    }
    given.values("float64", &[&[count], sides].concat())
}

/// Floats in this range, or unsigned integers in LSB of this many bits.
pub fn unorm(
    name: &'static str,
    value: &Bound<'_, PyAny>,
    shape: &[usize],
    (bits, range): (u32, Floats),
) -> PyResult<Vec<f64>> {
    let (columns, each) = (shape[1] as u32, shape.get(2).copied().unwrap_or(1));
    let given = Given::new(name, value)?;
    let one = (1u64 << bits) - 1;
    match &*given.kind {
        "f" => {
            let values = given.values("float64", shape)?;
            picture::floats(values, range, columns, each).map_err(|error| said(name, &error))
        }
        "u" => {
            let values: Vec<u64> = given.values("uint64", shape)?;
            if let Some(value) = values.iter().find(|value| **value > one) {
                return Err(Error::new_err(format!(
                    "{name}: {value} is more than {one}, the most that {bits} bits hold; permitted: LSB, or floats in 0 to 1"
                )));
            }
            Ok(values.into_iter().map(|value| value as f64 / one as f64).collect())
        }
        _ => Err(given.of_another_type("floats in 0 to 1, or unsigned integers in LSB")),
    }
}

/// Whole numbers as the array of a picture may have them.
pub fn whole<T: TryFrom<i128>>(
    name: &'static str,
    value: &Bound<'_, PyAny>,
    shape: &[usize],
    permitted: &Permitted,
) -> PyResult<Vec<T>> {
    let given = Given::new(name, value)?;
    let columns = shape[1] as u32;
    let checked = match &*given.kind {
        "b" | "i" => permitted.all(given.values::<i64>("int64", shape)?.into_iter().map(i128::from), columns),
        "u" => permitted.all(given.values::<u64>("uint64", shape)?.into_iter().map(i128::from), columns),
        _ => return Err(given.of_another_type("bool, or integers")),
    };
    checked.map_err(|error| said(name, &error))
}

fn said(name: &str, error: &anyhow::Error) -> PyErr {
    Error::new_err(format!("{name}: {error}"))
}
