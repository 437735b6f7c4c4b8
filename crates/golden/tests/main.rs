//! The suites of this crate as one program, a file a suite: built once, and none waits for the one before.

mod shapes;

mod closed_meshes;
mod coverage;
mod depth;
mod fast_phong;
mod incremental;
mod lines;
mod passes;
mod pixel_shading;
mod polygon_coverage;
mod polygon_depth;
mod polygon_table;
mod polygon_triangles;
mod polygon_values;
mod rays;
mod render;
mod scanline;
mod shading;
mod shadow;
mod shadow_maps;
mod textbook;
mod transparency;
mod values;
mod weights;
mod wireframe;
