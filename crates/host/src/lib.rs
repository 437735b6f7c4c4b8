//! What a host does for the machine: a scene becomes words at the port, words of memories and passes; and the machine's memories become a picture.
//!
//! ```text
//!  scene | mesh | triangle file ─> input ─> port (light, shade) ─> draw ─> raster
//! ```
//! [`port::PortFrame`] is a frame at the port, and [`raster::Raster`] a picture, whether golden, the model or the netlist drew it.
//!
//! ```
//! use edgewalk_host::{draw, port};
//! use edgewalk_machine::Machine;
//! use edgewalk_model::Waits;
//! use edgewalk_scene::triangle_file;
//! let text = "size 16 12\nT 3 1.5 .25 1 0 0 0  13 4.75 .5 0 1 0 0  5.5 10 .5 0 0 1 0\n";
//! let frame = triangle_file::parse("stdin", text.as_bytes())?;
//! let plan = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! assert_eq!(port::to_port(&frame, &plan)?.triangles.len(), 1);
//! let drawn = draw::fast(&frame, &plan, Waits::Never)?;
//! assert_eq!(drawn.coverage, draw::golden(&frame, &plan).coverage);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: crate `judge` compares the two pictures; `docs/triangle_file.md` is the format of the text.

pub mod advice;
pub mod extra;
pub mod raster;
pub mod light;
pub mod shade;
pub mod needs;
pub mod vertices;
pub mod polygon;
mod misplaced;
pub mod faces;
pub mod port;
pub mod input;
pub mod lights;
pub mod reach;
pub mod draw;
