//! A frame: the screen, the rules for depth and blending, and triangles and polygons in pixels.

use crate::host::Host;
use crate::pixel_shading::PixelShading;
use crate::rules::{Blending, Change, DepthFunc, ShadeMode};
use crate::vertex::{Triangle, Vertex};

/// Largest side of a screen, pixels.
pub const MAX_SIDE: u32 = 16384;

/// Largest |x| or |y| of a vertex, pixels. Times 2^8 sub-pixels it is an integer below 2^28, so edge products
/// stay far inside 64 bits.
pub const MAX_COORDINATE: f64 = 1e6;

/// By how much a depth may lie outside of [0, 1]: what single precision makes of one that does not. It is
/// clamped.
pub const DEPTH_ROUNDING: f64 = 1e-5;

/// Most vertices of a contour.
pub const MAX_CONTOUR: usize = 65536;

/// Most lights with shadows.
pub const MAX_LIGHTS: usize = 16;

/// A polygon on the screen: convex, concave, with holes or crossing itself; inside is what an odd number of
/// edges lies to the left of (the slides, odd-even rule).
///
/// Its values run linearly along the edges, then linearly along a line between two edges (the slides: l_a,
/// l_b, l_p). Only in a triangle, or where the vertices' values lie in one plane, is that the plane;
/// elsewhere it depends on how the polygon is turned.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Closed lines of 3..=[`MAX_CONTOUR`] vertices; the last vertex is joined to the first. In flat mode the
    /// first vertex of the first contour colours the whole.
    pub contours: Vec<Vec<Vertex>>,
    /// How many triangles of the frame are drawn before it.
    pub after: usize,
}

/// A line on the screen, a pixel wide: one pixel in each column, or in each row of a steep one, whose centre lies
/// from the first end to before the other along its longer side. Of a path of lines no pixel is drawn twice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// In flat mode the first end colours the whole.
    pub ends: [Vertex; 2],
    /// How many triangles and polygons of the frame are drawn before it.
    pub after: usize,
}

/// The shadows of one light: its depth map, and the way from the screen into it (ch. 7.3).
#[derive(Debug, Clone, PartialEq)]
pub struct Shadow {
    /// Side of the map, 1..=[`MAX_SIDE`] texels.
    pub size: u32,
    /// A point is in shadow if it lies farther from the light than the map's depth by more than this, [-1,
    /// 1].
    pub bias: f64,
    /// What comes on top of it for a point of each of the frame's triangles and polygons, by their places;
    /// empty: nothing.
    pub slopes: Vec<f64>,
    /// What the colour of a point in shadow is multiplied by, [0, 1]; that of one behind panes alone by this
    /// and, of what is missing to 1, as much as they transmit.
    pub ambient: f64,
    /// Rows of the matrix that takes a fragment's column vector (x + 1/2, y + 1/2, z, 1), in pixels and
    /// depth, to homogeneous (texel x, texel y, depth, q).
    pub matrix: [[f64; 4]; 4],
    /// What hides the light: x, y in texels, z its depth in [0, 1]; the nearest wins.
    pub triangles: Vec<[[f64; 3]; 3]>,
    /// What lets some of it through.
    pub panes: Vec<Pane>,
}

/// A triangle that transmits light. Behind all of them that cover a texel and are nearer than what hides the
/// light there, the product of their k_t is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pane {
    /// As those of [`Shadow::triangles`].
    pub corners: [[f64; 3]; 3],
    /// Transmission coefficient, (0, 1].
    pub kt: f64,
}

impl Shadow {
    /// The bias of a triangle or polygon, by its place in the frame.
    pub fn bias_of(&self, place: usize) -> f64 {
        self.bias + self.slopes.get(place).unwrap_or(&0.0)
    }
}

/// One picture to draw: triangles and polygons in list order on a cleared screen, by rules that may change.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Width, 1..=[`MAX_SIDE`] pixels.
    pub width: u32,
    /// Height, 1..=[`MAX_SIDE`] pixels.
    pub height: u32,
    /// Colour over a triangle.
    pub mode: ShadeMode,
    /// The depth test; `None` lets every fragment pass and leaves the stored depth alone.
    pub depth: Option<DepthFunc>,
    /// Whether a fragment that passes stores its depth; false where `depth` is `None`.
    pub depth_write: bool,
    /// What becomes of the colour of a fragment that passes.
    pub blend: Blending,
    /// Whether it is stored at all.
    pub color_write: bool,
    /// Colour of the empty screen, [0, 1] each; the empty depth is 1.
    pub clear: [f64; 3],
    /// How many values of the user's own a vertex has, 0..=[`MAX_EXTRA`](crate::MAX_EXTRA); without polygons
    /// where it has any. Where nothing is drawn they are 0.
    pub extra: usize,
    /// The shadows of lights, whose numbers count from 1.
    pub shadows: Vec<Shadow>,
    /// The number of the light whose shadows count, until a change; 0, or one that there is not: none.
    pub light: usize,
    /// The equation at each pixel, in place of the vertices' colours; without polygons where it is.
    pub shading: Option<PixelShading>,
    /// The triangles, drawn in this order.
    pub triangles: Vec<Triangle>,
    /// Where other rules than those above begin to hold, in order ([`Frame::passes`]).
    pub changes: Vec<Change>,
    /// The polygons, in this order, each after as many triangles as it says ([`Frame::primitives`]).
    pub polygons: Vec<Polygon>,
    /// The lines, in this order, each after as many triangles and polygons as it says ([`Frame::primitives`]);
    /// without values of the user's own and without normals.
    pub lines: Vec<Line>,
    /// What was done to them since the program gave them.
    pub host: Host,
}

impl Frame {
    /// A black screen with nothing on it: Gouraud, nearest fragment wins.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            mode: ShadeMode::Gouraud,
            depth: Some(DepthFunc::Less),
            depth_write: true,
            blend: Blending::Off,
            color_write: true,
            changes: Vec::new(),
            clear: [0.0; 3],
            extra: 0,
            shadows: Vec::new(),
            light: 1,
            shading: None,
            triangles: Vec::new(),
            polygons: Vec::new(),
            lines: Vec::new(),
            host: Host::default(),
        }
    }
}
