//! The suites of this crate as one program, a file a suite: built once, and none waits for the one before.

mod common;

mod builtin;
mod clipping;
mod fuzz;
mod gltf_files;
mod light_views;
mod malformed;
mod materials;
mod obj_files;
mod pixel_shading;
mod placed_objects;
mod scene_file;
mod statements;
mod textures;
mod t_joints;
mod texture_lines;
mod triangle_file;
