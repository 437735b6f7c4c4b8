//! A whole scene by a shading system: with the shadows of its lights, and with what is transparent in it.
//!
//! ```text
//!   surface ──> opaque triangles ──> draw ──> id and depth at each pixel ──> their colours, pixel by pixel
//!          └──> transparent ones ──> from back to front ──> where nearer than that depth: (1 - k_t) I* + k_t I_back
//! ```
//! r_l is taken at the point that the pixel shows, whatever the system interpolates. Constant shading has none (ch. 7.6).
//! The picture and the truth beside it are blended alike, each with its own colours.

use crate::depth::compare;
use crate::drawing::{draw, mix};
use crate::fill::Fill;
use crate::fragment::Fragment;
use crate::incremental::Incremental;
use crate::picture::Lit;
use crate::shading::{Attributes, Shaded, Shading, color, frame, on_surface, packed};
use crate::shadow::Gated;
use crate::transparency::{Order, back_to_front};
use crate::visibility::Visibility;
use crate::weights::Weights;
use edgewalk_scene::{Frame, Scene, Surface, SurfaceTriangle};
use glam::DVec3;
use std::cmp::Ordering;

/// A picture of a scene, and the order in which its triangles were drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Rendered {
    /// The picture and the truth. Its depths are those of what is opaque; its ids name the nearest triangle that was drawn.
    pub shaded: Shaded,
    /// Of the surface's triangles.
    pub order: Order,
}

/// Draws a scene by one of the systems, without shadows. `surface` is the scene's own on this screen.
pub fn shade(scene: &Scene, surface: &Surface, shading: Shading, fill: Fill) -> Shaded {
    render(scene, surface, shading, fill, &Visibility::Full).shaded
}

/// Draws a scene by one of the systems, with the shadows that `visibility` says. `surface` is the scene's own on this
/// screen.
pub fn render(
    scene: &Scene,
    surface: &Surface,
    shading: Shading,
    fill: Fill,
    visibility: &Visibility,
) -> Rendered {
    let whole = frame(scene, surface, shading);
    let order = back_to_front(&whole.triangles, fill.subpixel_bits());
    let (opaque, transparent) = order.order.split_at(order.order.len() - order.transparent);
    let triangles = opaque.iter().map(|place| whole.triangles[*place]).collect();
    let mut picture = draw(&Frame { triangles, ..whole.clone() }, fill);
    let mut truth = picture.rgb.clone();
    let brush = Brush { scene, shading, visibility };
    let screen = (whole.width, whole.height);
    let pixel = |fragment: &Fragment| fragment.y as usize * screen.0 as usize + fragment.x as usize;

    let mut rgb = picture.rgb.clone();
    for (place, id) in opaque.iter().zip(0..) {
        let mut stroke = brush.stroke(&surface.triangles[*place]);
        fill.fragments(&whole.triangles[*place], whole.mode, screen, |fragment| {
            let (at, values) = (pixel(fragment), stroke.step(fragment));
            if picture.id[at] == id {
                (rgb[at], truth[at]) = stroke.colors(fragment, values);
            }
        });
    }
    for id in picture.id.iter_mut().filter(|id| **id >= 0) {
        *id = opaque[*id as usize] as i32;
    }
    for place in transparent {
        let mut stroke = brush.stroke(&surface.triangles[*place]);
        fill.fragments(&whole.triangles[*place], whole.mode, screen, |fragment| {
            let (at, values) = (pixel(fragment), stroke.step(fragment));
            picture.coverage[at] += 1;
            if compare(fragment.z(), picture.z[at], fill.doubt()) == Some(Ordering::Less) {
                let (own, exact) = stroke.colors(fragment, values);
                rgb[at] = mix(own, fragment.kt(), rgb[at]);
                truth[at] = mix(exact, fragment.kt(), truth[at]);
                picture.writes[at] += 1;
                picture.id[at] = *place as i32;
                picture.lit[at] = Lit::Lit;
            }
        });
    }
    picture.rgb = rgb;
    Rendered { shaded: Shaded { picture, truth }, order }
}

/// What colours are made with.
struct Brush<'a> {
    scene: &'a Scene,
    shading: Shading,
    visibility: &'a Visibility<'a>,
}

impl<'a> Brush<'a> {
    fn stroke(&'a self, triangle: &'a SurfaceTriangle) -> Stroke<'a> {
        let shadows = !matches!(self.visibility, Visibility::Full);
        let stepped = || Incremental::new(triangle.vertices.map(packed));
        Stroke {
            brush: self,
            triangle,
            attributes: (self.shading == Shading::Phong).then(stepped),
            gated: (self.shading == Shading::Gouraud && shadows).then(|| Gated::new(self.scene, triangle)),
        }
    }
}

/// A triangle while it is drawn.
struct Stroke<'a> {
    brush: &'a Brush<'a>,
    triangle: &'a SurfaceTriangle,
    /// In Phong shading.
    attributes: Option<Incremental<8>>,
    /// In Gouraud shading with shadows.
    gated: Option<Gated>,
}

impl Stroke<'_> {
    /// The additions of Phong shading: they go on under what hides the triangle.
    fn step(&mut self, fragment: &Fragment) -> Option<Attributes> {
        self.attributes.as_mut().map(|attributes| Attributes::unpacked(attributes.step(fragment)))
    }

    /// The colour by the system, and the truth; `stepped` is what [`Self::step`] gave at the fragment.
    fn colors(&self, fragment: &Fragment, stepped: Option<Attributes>) -> ([f64; 3], [f64; 3]) {
        let scene = self.brush.scene;
        let exact = on_surface(fragment, self.triangle);
        let r = self.brush.visibility.factors(scene, exact.position, self.triangle);
        let own = match (&stepped, &self.gated) {
            (Some(stepped), _) => color(scene, self.triangle, stepped, &r),
            (None, Some(gated)) => {
                gated.color(Weights::linear(fragment), &r).clamp(DVec3::ZERO, DVec3::ONE).to_array()
            }
            (None, None) => fragment.rgb(),
        };
        (own, color(scene, self.triangle, &exact, &r))
    }
}
