//! `Picture` and `raster` in Python.

use crate::array::array;
use crate::error::{Error, run};
use crate::machine::Machine;
use crate::source;
use anyhow::Result;
use edgewalk_host::draw::{draw_frame, golden, scan_lines};
use edgewalk_host::extra::Values;
use edgewalk_host::port::{PortFrame, of_port, to_port};
use edgewalk_host::raster::{Raster, from_machine, from_model};
use edgewalk_lockstep::{StallKind, render_rtl_passes};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::{Activity, Frame as Drawn, Pass, Shading, Waits, render_passes};
use edgewalk_scene::Frame;
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What draws.
#[derive(Clone, Copy)]
enum Engine {
    Golden,
    Scanline,
    Fast,
    Model,
    Rtl,
    Jit,
}

impl Engine {
    fn named(name: &str) -> PyResult<Self> {
        Ok(match name {
            "golden" => Engine::Golden,
            "scanline" => Engine::Scanline,
            "fast" => Engine::Fast,
            "model" => Engine::Model,
            "rtl" => Engine::Rtl,
            "jit" => Engine::Jit,
            _ => {
                let message = format!("engine: {name:?}; permitted: golden, scanline, fast, model, rtl, jit");
                return Err(Error::new_err(message));
            }
        })
    }

    fn draw(self, frame: &Frame, machine: &Plan) -> Result<Raster> {
        match self {
            Engine::Golden => Ok(golden(frame, machine)),
            Engine::Scanline => scan_lines(frame, machine),
            _ => self.of_port(&to_port(frame, machine)?, machine),
        }
    }

    /// As the machine draws what is at its port.
    fn of_port(self, port: &PortFrame, machine: &Plan) -> Result<Raster> {
        let (Engine::Model | Engine::Rtl | Engine::Jit) = self else {
            return Ok(of_port(draw_frame(machine, port, Waits::Never)?.raster(machine), port));
        };
        let (triangles, passes, maps) = port.sent();
        let triangles = triangles.iter().copied();
        let drawn = match self {
            Engine::Jit => native(machine, triangles, &passes, &maps, port.words())?,
            Engine::Rtl => {
                render_rtl_passes(machine, triangles, &passes, &maps, StallKind::None, port.words())?
            }
            _ => render_passes(machine, triangles, &passes, &maps, Waits::Never, port.words())?,
        };
        let (drawn, lights) = port.apart(drawn);
        let of_model = matches!(self, Engine::Model);
        let raster = if of_model { from_model(machine, drawn) } else { from_machine(machine, drawn) };
        Ok(of_port(Raster { lights, ..raster }, port))
    }
}

/// The netlist's frame, by native code.
#[cfg(feature = "jit")]
fn native(
    machine: &Plan,
    triangles: impl Iterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    maps: &[Vec<u32>],
    words: &Shading,
) -> Result<Drawn> {
    use edgewalk_lockstep::{Interface, NetlistDevice, Unit, netlist, render_on};
    let tagged = machine.tagged();
    let netlist = netlist(&tagged, Unit::MACHINE)?;
    let simulator = edgewalk_jit::Simulator::new(&netlist)?;
    let mut device = NetlistDevice::run_by(simulator, &netlist, &Interface::new(&tagged, Unit::MACHINE))?;
    Ok(render_on(&mut device, machine, triangles, passes, maps, StallKind::None, words)?)
}

#[cfg(not(feature = "jit"))]
fn native(
    _: &Plan,
    _: impl Iterator<Item = [PortVertex; 3]>,
    _: &[Pass],
    _: &[Vec<u32>],
    _: &Shading,
) -> Result<Drawn> {
    anyhow::bail!(
        "engine: \"jit\", and this module was built without the feature jit; permitted: golden, scanline, fast, model, rtl; build \
         one that has it with `pip install ./crates/python --config-settings build-args=\"--features jit\"`"
    )
}

/// A picture: arrays of shape (H, W), row 0 on top.
#[pyclass(module = "edgewalk", frozen)]
pub struct Picture {
    raster: Raster,
    /// The largest stored depth and colour; of golden's picture, which stores none, nothing.
    largest: Option<[u64; 2]>,
}

/// The integer that was divided by `largest` when the float was made: formats have at most 32 bits, so the product
/// errs by less than a half.
fn stored(value: f64, largest: u64) -> u64 {
    (value * largest as f64).round() as u64
}

#[pymethods]
impl Picture {
    /// Triangles over the pixel, depth test off: uint32 (H, W).
    #[getter]
    fn coverage<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<u32>>> {
        array(py, self.raster.coverage.clone(), &self.shape())
    }

    /// Writes to the pixel: uint32 (H, W).
    #[getter]
    fn writes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<u32>>> {
        array(py, self.raster.writes.clone(), &self.shape())
    }

    /// Place of the triangle last written, -1 none: int32 (H, W).
    #[getter]
    fn id<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<i32>>> {
        array(py, self.raster.id.clone(), &self.shape())
    }

    /// Depth in 0 to 1: float64 (H, W).
    #[getter]
    fn z<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        array(py, self.raster.z.clone(), &self.shape())
    }

    /// Colour in 0 to 1: float64 (H, W, 3).
    #[getter]
    fn rgb<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let [height, width] = self.shape();
        array(py, self.raster.rgb.as_flattened().to_vec(), &[height, width, 3])
    }

    /// Depth as the machine stores it, LSB: uint64 (H, W); None of golden.
    #[getter]
    fn z_lsb<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArrayDyn<u64>>>> {
        let Some([largest, _]) = self.largest else { return Ok(None) };
        let values = self.raster.z.iter().map(|z| stored(*z, largest)).collect();
        array(py, values, &self.shape()).map(Some)
    }

    /// Colour as the machine stores it, LSB: uint64 (H, W, 3); None of golden.
    #[getter]
    fn rgb_lsb<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArrayDyn<u64>>>> {
        let Some([_, largest]) = self.largest else { return Ok(None) };
        let values = self.raster.rgb.as_flattened().iter().map(|c| stored(*c, largest)).collect();
        let [height, width] = self.shape();
        array(py, values, &[height, width, 3]).map(Some)
    }

    /// 0 nothing written, 1 in shadow, 2 lit: uint8 (H, W); None where it is not known.
    #[getter]
    fn lit<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArrayDyn<u8>>>> {
        let lit = self.raster.lit.as_ref();
        lit.map(|lit| array(py, lit.clone(), &self.shape())).transpose()
    }

    /// Channels of the user's own, LSB: (H, W) each, int64, or float64 of golden.
    #[getter]
    fn extra<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let shape = self.shape();
        let of = |values: &Values| match values {
            Values::Stored(values) => array(py, values.clone(), &shape).map(Bound::into_any),
            Values::Exact(values) => array(py, values.clone(), &shape).map(Bound::into_any),
        };
        self.raster.extra.iter().map(of).collect()
    }

    /// Cycles by cause, and their `total`; None of golden.
    #[getter]
    fn cycles<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(cycles) = &self.raster.cycles else { return Ok(None) };
        let dict = PyDict::new(py);
        dict.set_item("total", cycles.total)?;
        for activity in Activity::ALL {
            dict.set_item(activity.name(), cycles.spent(activity))?;
        }
        Ok(Some(dict))
    }

    fn __repr__(&self) -> String {
        format!("<edgewalk.Picture {}x{}>", self.raster.width, self.raster.height)
    }
}

impl Picture {
    fn shape(&self) -> [usize; 2] {
        [self.raster.height as usize, self.raster.width as usize]
    }
}

/// Draws triangles with an engine.
#[pyfunction]
#[pyo3(signature = (triangles, machine = None, *, engine = "fast", header = ""))]
pub fn raster(
    py: Python<'_>,
    triangles: &Bound<'_, PyAny>,
    machine: Option<&Machine>,
    engine: &str,
    header: &str,
) -> PyResult<Picture> {
    let engine = Engine::named(engine)?;
    let (machine, frame) = source::frame(triangles, machine, header)?;
    let largest = match engine {
        Engine::Golden | Engine::Scanline => None,
        _ => Some([machine.z.max(), machine.stored_color().max()]),
    };
    Ok(Picture { raster: run(py, || engine.draw(&frame, &machine))?, largest })
}
