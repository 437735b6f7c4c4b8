//! The reference pictures: exact coverage, depth and colour in f64.
//!
//! What ought to be drawn, said as plainly as possible: a pixel belongs to a triangle if three half-planes say so, in
//! integers; its depth and colour are the plane through the vertices (ch. 7.8). A pixel belongs to a polygon if an odd number of
//! edges pass on its left, each asked anew on every line (the slides). Coverage and depth are never stepped, rounded or wrapped as
//! the machine does it. Where two depths are too near for f64, exact integers decide.
//!
//! What steps is what is meant to show stepping, in f64 and beside the truth: the attributes of Phong shading
//! ([`Incremental`], the additions of ch. 7.9 and 7.10) and the second differences of [`fast_phong`].
//!
//! ```
//! use edgewalk_golden::{Fill, draw};
//! use edgewalk_scene::triangle_file;
//! let text = "size 16 12\nT 3 1.5 .25 1 0 0 0  13 4.75 .5 0 1 0 0  5.5 10 .5 0 0 1 0\n";
//! let frame = triangle_file::parse("stdin", text.as_bytes())?;
//! let picture = draw(&frame, Fill::Exact { subpixel_bits: 8 });
//! assert_eq!(picture.coverage.iter().sum::<u32>(), 38);
//! # Ok::<(), edgewalk_scene::InputError>(())
//! ```
//! Next: crate `judge` holds a machine's picture beside this one; `docs/shading.md` has the equation.

mod cover;
mod textbook;
mod fragment;
mod weights;
pub mod polygon;
mod line;
mod fill;
mod depth;
mod incremental;
mod picture;
mod shadow;
mod draw_list;
mod ray;
mod visibility;
mod pixel_shading;
mod drawing;
mod wireframe;
mod scanline;
pub mod dither;
mod transparency;
mod shading;
mod render;
pub mod fast_phong;

pub use cover::{MAX_SUBPIXEL_BITS, fragments, snap};
pub use drawing::{Drawing, Step, draw};
pub use fill::Fill;
pub use fragment::{Fragment, Weight};
pub use incremental::Incremental;
pub use line::line_fragments;
pub use picture::{Lit, NO_TRIANGLE, Picture};
pub use pixel_shading::{PixelBrush, Texel};
pub use ray::Rays;
pub use render::{Rendered, render, shade};
pub use scanline::{NotOpaque, Work, scan_lines};
pub use shading::{Shaded, Shading, ShadingError, frame};
pub use shadow::{Gated, ShadowMaps};
pub use textbook::{Half, half_triangles};
pub use transparency::{MAX_PAIRS, Order, back_to_front, sorted};
pub use visibility::Visibility;
pub use weights::Weights;
pub use wireframe::{HiddenLines, wireframe, wireframe_in_lines};
