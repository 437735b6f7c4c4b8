//! Shadow maps: who is seen from a light is lit (ch. 7.2, 7.3).
//!
//! ```text
//!   frame on the screen:  Shadow (matrix, L triangles) ──> ShadowMap ──> 1 or AMBIENT for a fragment
//!   scene in the world:   Light ──> LightViews ──> a DepthMap each ──> ShadowMaps ──> r_l for a point ──> Gated colours
//! ```

mod depth_map;
mod frame;
mod maps;
mod gated;

pub(crate) use frame::ShadowMap;
pub use gated::Gated;
pub use maps::ShadowMaps;
