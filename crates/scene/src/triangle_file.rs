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
//! Then triangles, drawn in this order whatever their winding: `T`, and `x y z r g b kt` for each of three vertices.
//! x and y are pixels to the right and down, at most 10^6 either way; z, colours and k_t lie in [0, 1].

mod reader;
mod writer;

pub use reader::{parse, read};
pub use writer::write;
