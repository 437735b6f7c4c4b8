//! What shading systems do well and badly: exhibits with their pictures, causes and figures.
//!
//! Each exhibit is a file: a scene (most are in `docs/scenes`), what is drawn of it, and what is measured there. Nothing
//! is written here; the program writes pictures and page.
//!
//! ```
//! let (name, make) = edgewalk_gallery::EXHIBITS[0];
//! let exhibit = make()?;
//! assert_eq!(exhibit.name, name);
//! assert!(!exhibit.figures.is_empty() && !exhibit.views.is_empty());
//! # Ok::<(), anyhow::Error>(())
//! ```
//! Next: `docs/gallery/README.md` is the page; "add an exhibit" in `docs/architecture.md` says what a new one takes.

mod exhibit;
mod plot;
mod profile;
mod machine;

mod worked_example;
mod polygons;
mod walked_polygons;
mod lights;
mod systems;
mod fast_phong;
mod texture;
mod gloss;
mod relief;
mod lamp;
mod shadows;
mod glass;
mod mach_bands;
mod components;
mod flat_faces;
mod textbook_fill;
mod vertex_rule;
mod quantization;
mod hidden_surfaces;
mod missed_highlight;
mod orientation;
mod polygon_normals;
mod perspective;
mod inverse_transform;
mod t_joint;
mod silhouette;
mod averaged_normals;

pub use exhibit::{Exhibit, Image, View};

/// Makes an exhibit.
pub type Maker = fn() -> anyhow::Result<Exhibit>;

/// All of them, in the order in which they are shown, by the names of their files.
pub const EXHIBITS: [(&str, Maker); 27] = [
    ("worked-example", worked_example::worked_example),
    ("polygons", polygons::polygons),
    ("walked-polygons", walked_polygons::walked_polygons),
    ("vertex-rule", || Ok(vertex_rule::vertex_rule())),
    ("textbook-fill", || Ok(textbook_fill::textbook_fill())),
    ("components", components::components),
    ("flat-faces", flat_faces::flat_faces),
    ("lights", lights::lights),
    ("systems", systems::systems),
    ("fast-phong", fast_phong::fast_phong),
    ("texture", texture::texture),
    ("gloss", gloss::gloss),
    ("relief", relief::relief),
    ("lamp", lamp::lamp),
    ("shadows", shadows::shadows),
    ("glass", glass::glass),
    ("mach-bands", mach_bands::mach_bands),
    ("quantization", quantization::quantization),
    ("hidden-surfaces", hidden_surfaces::hidden_surfaces),
    ("missed-highlight", missed_highlight::missed_highlight),
    ("orientation", orientation::orientation),
    ("polygon-normals", || Ok(polygon_normals::polygon_normals())),
    ("perspective", perspective::perspective),
    ("inverse-transform", inverse_transform::inverse_transform),
    ("t-joint", t_joint::t_joint),
    ("silhouette", silhouette::silhouette),
    ("averaged-normals", averaged_normals::averaged_normals),
];
