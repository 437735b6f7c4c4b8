//! Meshes, camera, lights and clipping, in floats, down to screen-space triangles.
//!
//! Every path ends in a [`Frame`]: a screen, a depth rule and a list of triangles in pixels. The golden
//! picture and the machine both start there, so a frame is all that they share.
//!
//! ```
//! use edgewalk_scene::{Scene, triangle_file};
//! let sphere = Scene::builtin("sphere")?;
//! assert!(sphere.mesh.faces().len() > 1000);
//!
//! let text = "size 16 12\nT 3 1.5 .25 1 0 0 0  13 4.75 .5 0 1 0 0  5.5 10 .5 0 0 1 0\n";
//! let frame = triangle_file::parse("stdin", text.as_bytes())?;
//! assert_eq!((frame.width, frame.height), (16, 12));
//! # Ok::<(), edgewalk_scene::InputError>(())
//! ```
//! Next: crate `golden` draws a frame, crate `host` sends it to the machine. The file formats are in
//! `docs/triangle_file.md` and `docs/scene_file.md`.

mod error;
mod text;
pub mod inputs;
mod file;
mod kind;

mod texture;
mod mesh;
mod normals;
mod camera;
mod light;
mod shading;
mod pixel_shading;
mod vertex;
mod rules;
mod host;
mod surface;
mod clip;
mod light_view;
mod scene;
mod pixel_frame;
mod scene_file;
pub mod triangle_file;
mod polygon;
mod frame;
mod pass;
mod band;

pub use band::{contour_in_band, fits};
pub use camera::Camera;
pub use error::InputError;
pub use frame::{Frame, Line, MAX_CONTOUR, MAX_COORDINATE, MAX_LIGHTS, MAX_SIDE, Pane, Polygon, Shadow};
pub use host::Host;
pub use kind::InputKind;
pub use light::{Attenuation, Incident, Light};
pub use light_view::{InMap, LightView};
pub use mesh::{Face, FaceData, Material, Mesh, TJoint};
pub use normals::{Crease, NormalRule, Weight};
pub use pass::Pass;
pub use pixel_shading::{PixelMethod, PixelShading, PixelTriangle, Viewer};
pub use polygon::{CrossingEdges, Primitive, Triangulated};
pub use rules::{Blending, Change, DepthFunc, ShadeMode, State};
pub use scene::Scene;
pub use shading::{LightTerms, Lighting, Point, Specular, Terms};
pub use surface::{Surface, SurfaceTriangle, SurfaceVertex};
pub use texture::{Image, MAX_TEXTURE_SIDE, Texture, WAVE_TEXELS};
pub use vertex::{MAX_EXTRA, MAX_EXTRA_VALUE, Triangle, Vertex};
