//! SETUP's results and clocks of triangles and parts of polygons on a machine with POLY, in 64 bits.
//!
//! Lines, and numbers that are too long, are left to the plain setup. Rules: `docs/machine.md`, section 19, "Setup".

use super::divide::Divisor;
use super::setup::{Setup, TooLong, Words};
use crate::setup::SetupClocks;
use crate::setup::clocks::Timing;
use crate::setup::edges::Parts;
use crate::setup::sort::Sorted;
use crate::tokens::{FEW, Prim};
use edgewalk_machine::{PortVertex, Role, Window};
use std::array::from_fn;

impl Setup {
    /// Window and sides of vertices that are sorted; `order`: which vertex of the port stands at each place.
    #[inline(always)]
    pub(super) fn window(&self, sorted: &mut Sorted<FEW>, vertices: &[PortVertex; 3], order: [usize; 3]) {
        let [top, middle, bottom] = order;
        sorted.window = Window::of(vertices);
        sorted.counts = match sorted.role {
            Role::Triangle => [true; 3],
            Role::Line { .. } => [true, false, false],
            // The side opposite to vertex k begins at the vertex behind it.
            Role::Edges(sides) | Role::Plane(sides) => [middle, bottom, top].map(|k| sides.has((k + 1) % 3)),
        };
    }

    /// Like `increments`, of what is no line.
    #[inline(always)]
    pub(super) fn token(
        &self,
        sorted: &Sorted<FEW>,
        prim: &mut Prim<FEW>,
    ) -> Result<(SetupClocks, bool), TooLong> {
        let [a, b, c] = &sorted.corners;
        let (du1, dv1, du2, dv2) = (b.u - a.u, b.v - a.v, c.u - a.u, c.v - a.v);
        let (plane, ends) = (matches!(sorted.role, Role::Plane(_)), sorted.role.ends());
        let window = sorted.window;
        let (y0, y1) = (i64::from(window.y0), i64::from(window.y1).min(self.height));
        let [j0, j1, j2] = [a, b, c].map(|corner| (-(-corner.v >> self.t)).min(y1).max(y0)); // rounded up
        let parts = Parts { first: [j0, j1], lines: [(j1 - j0) as u32, (j2 - j1) as u32] };
        let [left, right] = self.columns([a.u, b.u, c.u]);
        if !plane && j2 == j0 || sorted.role == Role::Triangle && right <= left {
            return Ok((self.timing.culled(), false));
        }
        let area = du1 * dv2 - du2 * dv1;
        let scale = self.timing.scale(sorted, area);
        let phase1 = self.timing.phase1_of_sides(sorted, &parts, scale);
        if area == 0 && !plane && ends {
            return Ok((SetupClocks { phase1, phase2: 0 }, false));
        }
        let line = parts.drawn();
        let [major, upper, lower] = sorted.counts;
        *prim = Prim {
            line: line as u32 & self.line_mask,
            lines: parts.lines,
            major_right: area < 0,
            sides: u32::from(major) | u32::from(upper) << 1 | u32::from(lower) << 2,
            ends,
            void: plane && area == 0,
            start_pixel: [window.x0, window.y0],
            major: self.walk(a, c, line, major && j2 > j0),
            minor: [self.walk(a, b, j0, upper && j1 > j0), self.walk(b, c, j1, lower && j2 > j1)],
            ..Prim::default()
        };
        if area == 0 || !ends {
            return Ok((SetupClocks { phase1: Timing::without_plane(phase1), phase2: 0 }, true));
        }

        // From the first vertex to the pixel at which values start.
        let (du, dv) = ((i64::from(window.x0) << self.t) - a.u, (y0 << self.t) - a.v);
        // |Nx|, |Ny| < 2^(difference_bits + extent), and the numerator of start below that times |du| + |dv|.
        let length = |number: i64| 64 - number.leading_zeros();
        let extent = length(du1.abs() | dv1.abs() | du2.abs() | dv2.abs());
        if self.difference_bits + extent + length(du.abs() + dv.abs()) > 62 {
            return Err(TooLong);
        }
        // Values are shorter than 62 bits: nothing wraps, and what might be checked one by one goes side by side.
        let flip = area >> 63;
        let turned = |value: i64| (value ^ flip).wrapping_sub(flip);
        let dc1: [i64; FEW] = from_fn(|i| turned(b.values[i].wrapping_sub(a.values[i])));
        let dc2: [i64; FEW] = from_fn(|i| turned(c.values[i].wrapping_sub(a.values[i])));
        let nx: [i64; FEW] = from_fn(|i| dc1[i].wrapping_mul(dv2).wrapping_sub(dc2[i].wrapping_mul(dv1)));
        let ny: [i64; FEW] = from_fn(|i| dc2[i].wrapping_mul(du1).wrapping_sub(dc1[i].wrapping_mul(du2)));
        let moved: [i64; FEW] = from_fn(|i| nx[i].wrapping_mul(du).wrapping_add(ny[i].wrapping_mul(dv)));
        let divisor = Divisor::new(area.abs());
        let (across, exact_x) = divisor.round(nx, &self.slope_shift);
        let (down, exact_y) = divisor.round(ny, &self.slope_shift);
        let (start, exact_start) = divisor.round(moved, &self.value_shift);
        if !(exact_x & exact_y & exact_start) {
            return Err(TooLong);
        }
        let word = |values: [i64; FEW]| -> Words { from_fn(|i| values[i] as u64 & self.word_masks[i]) };
        prim.gradient = word(across);
        prim.delta[0] = word(down);
        prim.start[0] = self.first_words(a, start);
        let phase2 = self.timing.phase2_of_plane(sorted, scale, area);
        Ok((SetupClocks { phase1, phase2 }, true))
    }
}
