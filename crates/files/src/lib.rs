//! What a run reads from and leaves on disk, pixel by pixel: folders whose files appear together, pictures, arrays.
//!
//! ```text
//!  Scratch ─> Staging ─┬─> Png, from colours, errors and signed maps
//!                      ├─> Array, for numpy
//!                      └─> First ─> Differences ─> Png
//!  .npy, .png of another rasterizer ─> foreign::read ─> judge's Picture
//! ```
//! A file of pixels is written a band of lines at a time, from the top.

mod scratch;
mod staging;
pub mod picture;
mod array;
pub mod difference;
pub mod foreign;

pub use array::Array;
pub use picture::Png;
pub use scratch::{Scratch, undisturbed, watch_signals};
pub use staging::Staging;
