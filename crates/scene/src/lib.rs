//! Meshes, camera, lights and clipping, in floats, down to screen-space triangles.
//!
//! Every path ends in a [`Frame`]: a screen, a depth rule and a list of triangles in pixels. The golden
//! picture and the machine both start there, so a frame is all that they share.

mod error;
mod frame;
pub mod triangle_file;

pub use error::{InputError, nearest};
pub use frame::{DepthFunc, Frame, MAX_COORDINATE, MAX_SIDE, ShadeMode, Triangle, Vertex};
