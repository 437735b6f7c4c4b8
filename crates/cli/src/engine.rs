//! One picture, whichever engine drew it.

use crate::input::to_port;
use crate::progress::bar;
use anyhow::{Result, anyhow};
use edgewalk_model::{Counters, Coverage, Stalls};
use edgewalk_numerics::{Fill, Machine};
use edgewalk_scene::Frame;

/// Who draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// Exact coverage by integers, depth and colour in f64
    Golden,
    /// The machine, cycle by cycle
    Model,
    /// The machine's netlist in the interpreter
    Rtl,
}

/// A picture: row 0 on top, [y][x].
pub struct Raster {
    /// Columns.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Triangles over the pixel, depth test off.
    pub coverage: Vec<u32>,
    /// Writes to the pixel.
    pub writes: Vec<u32>,
    /// Triangle last written, -1 none.
    pub id: Vec<i32>,
    /// Depth in [0,1].
    pub z: Vec<f64>,
    /// Colour in [0,1].
    pub rgb: Vec<[f64; 3]>,
    /// Cycles and their causes, where a machine drew.
    pub counters: Option<Counters>,
    /// Hazards and corners met, where a machine drew.
    pub corners: Option<Coverage>,
}

/// Draws the frame.
pub fn draw(engine: Engine, frame: &Frame, machine: &Machine, quiet: bool) -> Result<Raster> {
    match engine {
        Engine::Golden => Ok(draw_golden(frame, machine)),
        Engine::Model | Engine::Rtl => {
            let port = to_port(frame, machine)?;
            let bar = bar(port.triangles.len() as u64, "triangles", quiet);
            let triangles = bar.wrap_iter(port.triangles.iter().copied());
            let drawn = if engine == Engine::Model {
                edgewalk_model::render(machine, triangles, port.state, Stalls::NONE)
            } else {
                return Err(anyhow!("rtl later"));
            };
            bar.finish_and_clear();
            Ok(from_machine(machine, drawn))
        }
    }
}

fn draw_golden(frame: &Frame, machine: &Machine) -> Raster {
    let fill = match machine.fill {
        Fill::Exact => edgewalk_golden::Fill::Exact { subpixel_bits: machine.subpixel_bits },
        Fill::Textbook => edgewalk_golden::Fill::Textbook,
    };
    let picture = edgewalk_golden::draw(frame, fill);
    Raster {
        width: frame.width,
        height: frame.height,
        coverage: picture.coverage,
        writes: picture.writes,
        id: picture.id,
        z: picture.z,
        rgb: picture.rgb,
        counters: None,
        corners: None,
    }
}

fn from_machine(machine: &Machine, drawn: edgewalk_model::Frame) -> Raster {
    let (z_max, color_max) = (machine.z.max() as f64, machine.color.max() as f64);
    Raster {
        width: machine.width,
        height: machine.height,
        coverage: drawn.coverage,
        writes: drawn.writes,
        id: drawn.id,
        z: drawn.z.iter().map(|v| *v as f64 / z_max).collect(),
        rgb: drawn.rgb.iter().map(|c| c.map(|v| v as f64 / color_max)).collect(),
        counters: Some(drawn.counters),
        corners: Some(drawn.corners),
    }
}
