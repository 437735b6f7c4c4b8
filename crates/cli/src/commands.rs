pub mod config;
pub mod raster;
