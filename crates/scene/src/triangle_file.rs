//! The screen-space triangle file: the way in for any outside program. `docs/triangle_file.md` is its reference.
//!
//! One item a line. The header sets the screen and the rules; then come the triangles in drawing order, and apart from
//! those the triangles of a light's depth map.

mod vertices;
mod shadow;
mod extra;
mod rules;
mod shading;
mod texture;
mod unsaid;
mod reader;
mod writer;

pub use reader::{Reader, open, parse, read};
pub use writer::write;
