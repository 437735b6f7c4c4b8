//! The reference pictures: exact coverage, depth and colour in f64.
//!
//! What ought to be drawn, said as plainly as possible: a pixel belongs to a triangle if three half-planes say so, in
//! integers; its depth and colour are the plane through the vertices (A 7.8). Polygons have the active edge table of
//! seed B instead. Nothing here steps, rounds or wraps as the machine does. Where two depths are too near for f64, exact
//! integers decide.

mod cover;
mod textbook;
mod fragment;
mod weights;
pub mod polygon;
mod fill;
mod depth;
mod incremental;
mod shadow;
mod draw_list;
mod ray;
mod visibility;
mod picture;
mod wireframe;
mod transparency;
mod shading;
mod render;
pub mod fast_phong;

pub use cover::{MAX_SUBPIXEL_BITS, fragments, snap};
pub use fill::Fill;
pub use fragment::{Fragment, Weight};
pub use incremental::Incremental;
pub use picture::{Drawing, Lit, NO_TRIANGLE, Picture, draw};
pub use ray::Rays;
pub use render::{Rendered, render, shade};
pub use shading::{Shaded, Shading, ShadingError, frame};
pub use shadow::ShadowMaps;
pub use textbook::{Half, half_triangles};
pub use transparency::{MAX_PAIRS, Order, back_to_front};
pub use visibility::Visibility;
pub use weights::Weights;
pub use wireframe::{HiddenLines, wireframe};
