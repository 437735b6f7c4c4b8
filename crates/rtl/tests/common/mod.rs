//! What the lock-step tests share.

pub mod chain;
pub mod configurations;
pub mod lockstep;
pub mod probe;
pub mod tokens;
pub mod triangles;
pub mod units;
