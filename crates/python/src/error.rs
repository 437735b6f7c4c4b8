//! The exception of the module, and the way to it from errors and panics.

use edgewalk_host::advice;
use edgewalk_host::needs::NotMet;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

pyo3::create_exception!(edgewalk, Error, PyValueError, "What the program would say and end with.");

/// The advice to draw with golden, in Python's words.
const OR_GOLDEN: &str = ", or draw with engine=\"golden\"";

/// The exception with the whole message. Advice for the command line is put in Python's words.
pub fn raised(error: &anyhow::Error) -> PyErr {
    let Some(NotMet { why, settings, by_golden }) = error.downcast_ref() else {
        return Error::new_err(format!("{error:#}").replace(advice::OR_GOLDEN, OR_GOLDEN));
    };
    let settings: Vec<String> = settings.iter().map(|(key, value)| format!("{key:?}: {value:?}")).collect();
    let golden = if *by_golden { OR_GOLDEN } else { "" };
    Error::new_err(format!("{why}; give a machine.with_keys({{{}}}){golden}", settings.join(", ")))
}

/// Does the work without Python's lock; errors become exceptions, and so does a panic, which would be a defect.
pub fn run<T: Send>(py: Python<'_>, work: impl FnOnce() -> anyhow::Result<T> + Send) -> PyResult<T> {
    // What `work` borrows is read only, and what it owned is gone.
    match py.detach(|| catch_unwind(AssertUnwindSafe(work))) {
        Ok(done) => done.map_err(|error| raised(&error)),
        Err(_) => Err(Error::new_err("a defect of edgewalk; permitted: none; report it with the input")),
    }
}
