//! Fast Phong shading: the cosines N·L/|N| and N·H/|N| over a triangle as quadratics, stepped by additions (BW86).
//!
//! ```text
//!   vertices' normals ──> quadratic in x, y ──> value and differences ──+──+──> N·L, N·H at a pixel ──> table (N·H)^n
//!   (ch. 7.11)              Taylor or six-point    at the first pixel     two additions a pixel each       saturated
//! ```
//! For one light and one wavelength that is five additions and one table read a pixel: two for N·L, two for N·H, one for
//! the sum of the diffuse and the specular part. It holds for ambient and directional light, where L does not depend on
//! the pixel. Derivations: `docs/fast_phong.md`; how far the quadratics are off: bound 10 in `docs/numerics.md`.
//!
//! Everything is f64, in the order of the incremental algorithm. It is a reference of that algorithm, not the truth.

mod normal_plane;
mod quadratic;
mod taylor;
pub(crate) mod six_point;
mod differences;
pub(crate) mod table;
mod triangle;
mod picture;

pub use differences::{Differences, Walk};
pub use normal_plane::NormalPlane;
pub use picture::{FastShaded, Settings, shade};
pub use quadratic::Quadratic;
pub use six_point::six_point;
pub use table::PowerTable;
pub use taylor::taylor;
pub use triangle::{Directional, FastPhong, Fit, quadratics};
