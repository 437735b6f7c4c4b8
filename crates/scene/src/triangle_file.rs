//! The screen-space triangle file: the way in for any outside program.
//!
//! One item a line, words divided by blanks, `#` starts a comment. The header comes first, each item at most once:
//!
//! | line | permitted | default |
//! |---|---|---|
//! | `size W H` | integers 1..=16384, pixels | must be given |
//! | `mode M` | `gouraud`, `flat` (colour of the first vertex) | `gouraud` |
//! | `depth F` | `never less equal lequal greater notequal gequal always`, or `off` | `less` |
//! | `depth_write B` | `0`, `1`; 0 whenever depth is `off` | `1` |
//! | `blend B` | `0`, `1` | `0` |
//! | `clear r g b` | [0, 1] each | `0 0 0` |
//!
//! Then triangles and polygons, drawn in this order whatever their winding:
//!
//! | line | |
//! |---|---|
//! | `T` and three vertices | a triangle |
//! | `P n` and n vertices | a polygon of 3..=65536 vertices; it may be concave and may cross itself |
//! | `H n` and n vertices | one more contour, a hole or an island, of the polygon on the line before |
//!
//! A vertex is `x y z r g b kt`: x and y are pixels to the right and down, at most 10^6 either way; z, colours and k_t
//! lie in [0, 1].

mod reader;
mod writer;

pub use reader::{Reader, parse, read};
pub use writer::write;
