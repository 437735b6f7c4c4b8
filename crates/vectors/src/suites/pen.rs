//! Draws cases in pixels and in shares of full scale; what a machine cannot hold is moved to the nearest it can.

use super::{Case, Triangle};
use edgewalk_machine::{LIGHT_SPACE, Plan, PortVertex, Window};

/// Red, green and blue of the three corners, so that every channel varies in both directions.
const COLORS: [[f64; 3]; 3] = [[1.0, 0.1, 0.3], [0.2, 0.9, 0.0], [0.0, 0.4, 1.0]];

/// Makes the triangles of one machine.
pub(super) struct Pen<'a> {
    machine: &'a Plan,
}

impl<'a> Pen<'a> {
    pub fn new(machine: &'a Plan) -> Self {
        Pen { machine }
    }

    /// Largest |x| and |y|, px.
    pub fn limit(&self) -> f64 {
        f64::from((1u32 << self.machine.guard_bits) - 1)
    }

    /// Sub-pixels of a pixel, centres between them.
    pub fn subpixels(&self) -> f64 {
        f64::from(1u32 << self.machine.widths().center_fraction)
    }

    /// Sub-pixels between two places where a vertex may lie.
    pub fn vertex_step(&self) -> i64 {
        1 << (self.machine.widths().center_fraction - self.machine.subpixel_bits)
    }

    /// Columns and lines of the screen.
    pub fn size(&self) -> (f64, f64) {
        (f64::from(self.machine.width), f64::from(self.machine.height))
    }

    /// A vertex at (x, y) px with shares of the range of every channel: Z, R, G, B, and again for the user's own. Its k_t, where
    /// there is one, follows from the depth: that of one in four is 0, of another 1.
    pub fn vertex(&self, at: (f64, f64), shares: [f64; 4]) -> PortVertex {
        let z = shares[0].clamp(0.0, 1.0);
        let kt = match (z * 37.0).round() as u32 % 4 {
            0 => 0.0,
            1 => 1.0,
            _ => (z * 37.0).fract().max(0.25),
        };
        self.glass(at, shares, kt)
    }

    /// Like `vertex`, with this k_t.
    pub fn glass(&self, at: (f64, f64), shares: [f64; 4], kt: f64) -> PortVertex {
        let channels = self.machine.channels().iter().zip(shares.into_iter().cycle());
        let values = channels.map(|(channel, share)| {
            let (low, high) = channel.host_range();
            // Of what a light-space value may be the map is a small part: around that.
            let (low, high) = match channel.name {
                "lw" => (-self.weight() / 16.0, high),
                "lx" | "ly" | "lz" if self.machine.shadow.projects() => around(self.weight(), low, high),
                "lx" | "ly" => around(f64::from(self.machine.shadow.size), low, high),
                "lz" => around(f64::from(1u32 << self.machine.shadow.depth_bits), low, high),
                _ => (low, high),
            };
            let share = if channel.name == "kt" { kt } else { share };
            low + (high - low) * share.clamp(0.0, 1.0)
        });
        self.placed(at, values.chain(self.machine.has_triangle_kt().then_some(kt)).collect())
    }

    /// A weight in the middle of what a vertex may have.
    pub fn weight(&self) -> f64 {
        f64::from(1u32 << (self.machine.shadow.light_bits - 1))
    }

    /// A vertex with shares as in [`Pen::vertex`] at these texels and this depth of a light's map, LSB.
    pub fn lit(&self, at: (f64, f64), shares: [f64; 4], [x, y, d]: [f64; 3]) -> PortVertex {
        if !self.machine.shadow.projects() {
            return self.seen(at, shares, [x, y, d, 0.0]);
        }
        let side = f64::from(1u32 << self.machine.shadow.side_bits());
        let depth = f64::from(1u32 << self.machine.shadow.depth_bits);
        self.seen(at, shares, [x / side, y / side, d / depth, 1.0].map(|quotient| quotient * self.weight()))
    }

    /// Like `lit`, with these light-space values, LSB.
    pub fn seen(&self, at: (f64, f64), shares: [f64; 4], light: [f64; 4]) -> PortVertex {
        let channels = self.machine.channels().iter().zip(shares.into_iter().cycle());
        let values = channels.map(|(channel, share)| {
            let (low, high) = channel.host_range();
            match LIGHT_SPACE.iter().position(|name| *name == channel.name) {
                Some(i) => light[i].clamp(low, high),
                // Opaque.
                None if channel.name == "kt" => 0.0,
                None => low + (high - low) * share,
            }
        });
        self.placed(at, values.chain(self.machine.has_triangle_kt().then_some(0.0)).collect())
    }

    fn placed(&self, at: (f64, f64), values: Vec<f64>) -> PortVertex {
        let limit = self.limit();
        self.machine
            .port_vertex(at.0.clamp(-limit, limit), at.1.clamp(-limit, limit), &values)
            .expect("clamped to what the port takes")
    }

    /// A triangle with a depth at each corner and corners of different colours.
    pub fn shaded(&self, at: [(f64, f64); 3], z: [f64; 3]) -> Triangle {
        std::array::from_fn(|i| {
            let [r, g, b] = COLORS[i];
            self.vertex(at[i], [z[i], r, g, b])
        })
    }

    /// A triangle of one depth.
    pub fn level(&self, at: [(f64, f64); 3], z: f64) -> Triangle {
        self.shaded(at, [z; 3])
    }

    /// A line with a depth at each end, for a machine whose port takes lines.
    pub fn line(&self, ends: [(f64, f64); 2], z: [f64; 2]) -> Triangle {
        let [a, b] = [0, 1].map(|i| {
            let [r, g, b] = COLORS[i];
            self.vertex(ends[i], [z[i], r, g, b])
        });
        self.machine.line([a, b])
    }

    /// A polygon whose corners have different colours, for a machine with POLY: all lines of the screen, or those of a window.
    pub fn polygon(&self, contours: &[Vec<(f64, f64)>], window: Option<Window>) -> Vec<Triangle> {
        let mut corners = 0;
        let mut vertex = |at: &(f64, f64)| {
            corners += 1;
            let [r, g, b] = COLORS[corners % 3];
            self.vertex(*at, [f64::from(corners as u32 % 5) / 5.0, r, g, b])
        };
        let contours: Vec<Vec<PortVertex>> =
            contours.iter().map(|contour| contour.iter().map(&mut vertex).collect()).collect();
        let window = window.unwrap_or_else(|| self.machine.window_from(&contours.concat()));
        self.machine.polygon(&contours, window)
    }

    /// For which it draws.
    pub fn machine(&self) -> &'a Plan {
        self.machine
    }

    /// A triangle that in exact fill covers the pixel (column, line) alone, on any sub-pixel grid.
    pub fn dot(&self, column: f64, line: f64, z: f64) -> Triangle {
        self.level([(column, line), (column + 1.5, line), (column, line + 1.5)], z)
    }

    /// Like `dot`, with this k_t.
    pub fn glass_dot(&self, column: f64, line: f64, z: f64, kt: f64) -> Triangle {
        let at = [(column, line), (column + 1.5, line), (column, line + 1.5)];
        std::array::from_fn(|i| {
            let [r, g, b] = COLORS[i];
            self.glass(at[i], [z, r, g, b], kt)
        })
    }
}

/// From a little before 0 to a little beyond the end, within what there is.
fn around(end: f64, low: f64, high: f64) -> (f64, f64) {
    ((-end / 8.0).max(low), (end * 1.125).min(high))
}

/// A case of these triangles.
pub(super) fn case(name: &str, triangles: impl IntoIterator<Item = Triangle>) -> Case {
    Case { name: name.to_owned(), triangles: triangles.into_iter().collect() }
}
