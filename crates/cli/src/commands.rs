pub mod config;
pub mod raster;
pub mod render;
