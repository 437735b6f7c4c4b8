//! Whole numbers given in Python.

use crate::error::Error;
use pyo3::prelude::*;
use std::ops::RangeInclusive;

/// The argument of that name, or `usual` where it is left out.
///
/// # Errors
/// No integer, or one outside of the range.
pub fn whole(
    name: &str,
    given: Option<&Bound<'_, PyAny>>,
    usual: u64,
    range: RangeInclusive<u64>,
) -> PyResult<u64> {
    let Some(given) = given else { return Ok(usual) };
    given.extract().ok().filter(|number| range.contains(number)).ok_or_else(|| {
        Error::new_err(format!(
            "{name}: {given}; permitted: an integer in {} to {}",
            range.start(),
            range.end()
        ))
    })
}
