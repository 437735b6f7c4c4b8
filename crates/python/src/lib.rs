//! The Python module `edgewalk`: machines, pictures of every engine, judgements, vectors, units beside a simulation, sweeps; with
//! numpy arrays.
//!
//! What Python reads of it is in `edgewalk.pyi`.

#![forbid(unsafe_code)]

mod error;
mod machine;
mod array;
mod source;
mod picture;
mod judgement;
mod token;
mod number;
mod vectors;
mod live;
mod sweep;

use pyo3::prelude::*;

/// A cycle-level, bit-accurate model of scan-line triangle hardware.
#[pymodule]
fn edgewalk(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Error", module.py().get_type::<error::Error>())?;
    module.add_class::<machine::Machine>()?;
    module.add_class::<picture::Picture>()?;
    module.add_class::<judgement::Judgement>()?;
    module.add_class::<vectors::Vectors>()?;
    module.add_class::<live::Live>()?;
    module.add_class::<sweep::Sweep>()?;
    module.add_function(wrap_pyfunction!(machine::presets, module)?)?;
    module.add_function(wrap_pyfunction!(picture::raster, module)?)?;
    module.add_function(wrap_pyfunction!(judgement::judge, module)?)?;
    module.add_function(wrap_pyfunction!(vectors::suites, module)?)?;
    module.add_function(wrap_pyfunction!(vectors::vectors, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep, module)?)
}
