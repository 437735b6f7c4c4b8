//! What a host does for the machine: a scene becomes words at the port, words of memories and passes; and the machine's memories become a picture.
//!
//! ```text
//!  scene | mesh | triangle file ─> input ─> port (light, shade) ─> draw ─> raster
//! ```
//! [`port::PortFrame`] is a frame at the port, and [`raster::Raster`] a picture, whether golden, the model or the netlist drew it.

pub mod extra;
pub mod raster;
pub mod light;
pub mod shade;
pub mod needs;
pub mod polygon;
pub mod port;
pub mod input;
pub mod lights;
pub mod reach;
pub mod draw;
