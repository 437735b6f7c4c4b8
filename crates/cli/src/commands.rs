//! One file a command; each has `Args` and `run`.

pub mod demo;
pub mod render;
pub mod gallery;
pub mod explain;
pub mod raster;
pub mod triangles;
pub mod size;
pub mod sweep;
pub mod compare;
pub mod judge;
pub mod emit;
pub mod vectors;
pub mod mutants;
pub mod verify;
pub mod trace;
pub mod replay;
pub mod synth;
pub mod estimate;
pub mod calibrate;
pub mod energy;
pub mod bench;
pub mod config;
pub mod completions;
pub mod man;
