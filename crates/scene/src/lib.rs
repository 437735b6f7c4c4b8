//! Meshes, camera, lights and clipping, in floats, down to screen-space triangles
