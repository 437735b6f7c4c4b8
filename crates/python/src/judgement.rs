//! `Judgement` and `judge` in Python.

use crate::array::{array, unorm, whole};
use crate::error::{Error, run};
use crate::machine::Machine;
use crate::source;
use anyhow::ensure;
use edgewalk_host::draw;
use edgewalk_judge::Verdict;
use edgewalk_judge::outside::picture::{COVERAGE, Floats, ID, LIT};
use edgewalk_judge::outside::{self, Asked, Cause, Rule, Tolerance};
use edgewalk_machine::Fill;
use edgewalk_model::Waits;
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What a picture came to, pixel by pixel.
#[pyclass(module = "edgewalk", frozen)]
pub struct Judgement {
    judgement: outside::Judgement,
    shape: [usize; 2],
}

#[pymethods]
impl Judgement {
    /// Whether pixels were covered and none is wrong.
    #[getter]
    fn passed(&self) -> bool {
        self.judgement.verdict() == Verdict::Pass
    }

    /// Pixels that are wrong.
    #[getter]
    fn wrong(&self) -> u64 {
        self.judgement.wrong()
    }

    /// Pixels that the reference covers.
    #[getter]
    fn covered(&self) -> u64 {
        self.judgement.covered
    }

    /// Pixels by cause.
    #[getter]
    fn causes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for count in &self.judgement.causes {
            dict.set_item(count.cause.text(), count.pixels)?;
        }
        Ok(dict)
    }

    /// Place of each pixel's cause among `causes`, 255 where it agrees: uint8 (H, W).
    #[getter]
    fn map<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<u8>>> {
        array(py, self.judgement.map.clone(), &self.shape)
    }

    /// What the program prints.
    fn __str__(&self) -> String {
        self.judgement.lines()
    }

    /// The first pixels of a cause, a line each.
    fn lines_of(&self, cause: &str) -> PyResult<String> {
        let named = Cause::ALL.into_iter().find(|c| c.text() == cause);
        let names = || Cause::ALL.map(Cause::text).join(", ");
        let named =
            named.ok_or_else(|| Error::new_err(format!("cause: {cause:?}; permitted: {}", names())))?;
        Ok(self.judgement.lines_of(named))
    }
}

/// The rule of that name; without one the machine's.
fn rule(name: Option<&str>, fill: Fill) -> PyResult<Rule> {
    let all = [Rule::TopLeft, Rule::TopRight, Rule::BottomLeft, Rule::BottomRight, Rule::Textbook];
    match name {
        None => Ok(if fill == Fill::Textbook { Rule::Textbook } else { Rule::TopLeft }),
        Some(name) => all.into_iter().find(|rule| rule.to_string() == name).ok_or_else(|| {
            let names = all.map(|rule| rule.to_string()).join(", ");
            Error::new_err(format!("rule: {name:?}; permitted: {names}"))
        }),
    }
}

/// A tolerance in LSB, which must be 0 or more.
fn asked(name: &str, lsb: Option<f64>) -> PyResult<Asked> {
    if let Some(lsb) = lsb.filter(|lsb| !(lsb.is_finite() && *lsb >= 0.0)) {
        return Err(Error::new_err(format!("{name}: {lsb}; permitted: a number of 0 or more, LSB")));
    }
    Ok(Asked { bits: None, lsb })
}

/// Judges arrays beside golden's picture, or beside the machine's.
#[pyfunction]
#[pyo3(signature = (
    triangles, machine = None, *, z = None, rgb = None, coverage = None, id = None, lit = None, header = "",
    against = "golden", rule = None, depth_lsb = None, color_lsb = None
))]
#[allow(clippy::too_many_arguments)] // the arguments of a call in Python, by name
pub fn judge(
    py: Python<'_>,
    triangles: &Bound<'_, PyAny>,
    machine: Option<&Machine>,
    z: Option<&Bound<'_, PyAny>>,
    rgb: Option<&Bound<'_, PyAny>>,
    coverage: Option<&Bound<'_, PyAny>>,
    id: Option<&Bound<'_, PyAny>>,
    lit: Option<&Bound<'_, PyAny>>,
    header: &str,
    against: &str,
    rule: Option<&str>,
    depth_lsb: Option<f64>,
    color_lsb: Option<f64>,
) -> PyResult<Judgement> {
    let is_machine = match against {
        "golden" => false,
        "machine" => true,
        _ => return Err(Error::new_err(format!("against: {against:?}; permitted: golden, machine"))),
    };
    let (machine, frame) = source::frame(triangles, machine, header)?;
    let shape @ [height, width] = [machine.height as usize, machine.width as usize];
    let own = self::rule(None, machine.fill)?;
    let rule = self::rule(rule, machine.fill)?;
    let range = if rule == Rule::Textbook { Floats::Finite } else { Floats::InUnit };
    let colors = |rgb| -> PyResult<Vec<[f64; 3]>> {
        let values = unorm("rgb", rgb, &[height, width, 3], (machine.stored_color().bits, range))?;
        Ok(values.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect())
    };
    let picture = outside::Picture {
        width: machine.width,
        height: machine.height,
        coverage: coverage.map(|values| whole("coverage", values, &shape, &COVERAGE)).transpose()?,
        id: id.map(|values| whole("id", values, &shape, &ID)).transpose()?,
        z: z.map(|values| unorm("z", values, &shape, (machine.z.bits, range))).transpose()?,
        rgb: rgb.map(colors).transpose()?,
        lit: lit.map(|values| whole("lit", values, &shape, &LIT)).transpose()?,
        color_step: 0.0,
    };
    if [z, rgb, coverage, id, lit].iter().all(Option::is_none) {
        return Err(Error::new_err("no array; permitted: one or more of z, rgb, coverage, id, lit"));
    }
    let (depth, color) = (asked("depth_lsb", depth_lsb)?, asked("color_lsb", color_lsb)?);
    let judgement = run(py, || {
        let tolerance = Tolerance::of(&machine, &frame, depth, color);
        if is_machine {
            ensure!(
                rule == own,
                "rule: {rule}; the machine draws by {own}; permitted with against=\"machine\": {own}"
            );
            let drawn = draw::fast(&frame, &machine, Waits::Never)?;
            return outside::beside_machine(&machine, &frame, &drawn, &picture, &tolerance);
        }
        ensure!(
            frame.shading.is_none() || color_lsb.is_some() || picture.rgb.is_none(),
            "the frame is shaded at each pixel, and its colours have no bound that holds for all pixels; give color_lsb, or \
             against=\"machine\""
        );
        outside::beside_golden(&machine, &frame, &picture, &tolerance, rule)
    })?;
    Ok(Judgement { judgement, shape })
}
