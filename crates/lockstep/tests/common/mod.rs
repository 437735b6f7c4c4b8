//! What the lock-step tests share.
#![allow(dead_code, reason = "every test file uses a part")]

pub mod fail;
pub mod machines;
pub mod tokens;
pub mod polygons;
pub mod triangles;
