//! SETUP's results and clocks with divisions that take a few clocks each, in 64 bits.
//!
//! A triangle is sorted when it is brought in, some triangles before the one that is drawn.
//! Only for exact fill and exact edges, formats whose differences over the screen fit in 62 bits, and triangles whose
//! numerators do; all else is left to the plain setup, with its 128 bits. What a machine with POLY takes is in
//! `setup_poly.rs`. Rules: `docs/machine.md`, section 2.

use super::divide::{Divisor, Shifts};
use crate::setup::clocks::Timing;
use crate::setup::edges::{Parts, Screen};
use crate::setup::sort::{Corner, Sorted};
use crate::setup::{self, SetupClocks};
use crate::tokens::{EdgeWalk, FEW, Prim, per_channel, sign_extend, word_masks};
use edgewalk_machine::{EdgeKind, Fill, Plan, PortVertex, Role};
use std::array::from_fn;

pub(super) type Words = crate::tokens::Words<FEW>;

/// What the setup needs to know of a plan.
#[derive(Clone, Debug)]
pub(super) struct Setup {
    plan: Plan,
    pub(super) timing: Timing,
    /// The plain setup does it all.
    plain: bool,
    /// The machine has POLY.
    polygon: bool,
    /// The port takes lines or parts of polygons: not all is a triangle.
    roles: bool,
    width: i64,
    pub(super) height: i64,
    /// Bits of a line.
    pub(super) line_mask: u32,
    /// log2 P.
    pub(super) t: u32,
    /// Bits above the vertex coordinates, and from the coordinates to centre coordinates: shift and offset.
    unused: u32,
    double: u32,
    offset: i32,
    column_bits: u32,
    /// The largest b + e, plus 1: bits of a signed difference.
    pub(super) difference_bits: u32,
    vertex_masks: [i64; FEW],
    pub(super) word_masks: Words,
    /// r - e, and t + r - e.
    pub(super) value_shift: Shifts,
    pub(super) slope_shift: Shifts,
    value_bits: [u32; 4],
    /// 2^(r-1), 0 if r = 0.
    half: Words,
}

/// A number was too long for 62 bits, or a quotient for the division.
pub(super) struct TooLong;

impl Setup {
    pub(super) fn new(plan: &Plan) -> Self {
        let w = plan.widths();
        let difference_bits =
            per_channel::<_, FEW>(plan, |c| c.vertex_bits() + 1).into_iter().max().unwrap_or(0);
        let exact = plan.fill == Fill::Exact && plan.edge_kind == EdgeKind::Exact;
        let s = plan.subpixel_bits;
        let value_bits: [u32; FEW] = per_channel(plan, |c| c.fraction - c.vertex_fraction);
        Setup {
            plan: plan.clone(),
            timing: Timing::new(plan),
            plain: !exact || difference_bits + w.difference > 62,
            polygon: plan.polygon.is_there(),
            roles: plan.polygon.is_there() || plan.polygon.has_lines(),
            width: i64::from(plan.width),
            height: i64::from(plan.height),
            line_mask: u32::MAX >> (32 - w.line),
            t: w.center_fraction,
            unused: 32 - w.vertex,
            double: u32::from(s == 0),
            offset: if s == 0 { 1 } else { 1 << (s - 1) },
            column_bits: w.column,
            difference_bits,
            vertex_masks: per_channel(plan, |c| (1 << c.vertex_bits()) - 1),
            word_masks: word_masks(plan),
            value_shift: Shifts::new(value_bits),
            slope_shift: Shifts::new(value_bits.map(|bits| bits + w.center_fraction)),
            value_bits,
            half: per_channel(plan, |c| (1 << c.fraction) >> 1),
        }
    }

    /// A triangle's vertices as SETUP sees them.
    #[inline(always)]
    pub(super) fn sort(&self, vertices: &[PortVertex; 3], sorted: &mut Sorted<FEW>) {
        if self.plain {
            *sorted = Sorted::new(&self.plan, vertices);
        } else {
            self.sort_short(vertices, sorted);
        }
    }

    /// The clocks of a triangle, and whether it is drawn; if so, `prim` gets its increments, without tag and number.
    #[inline(always)]
    pub(super) fn increments(&self, sorted: &Sorted<FEW>, prim: &mut Prim<FEW>) -> (SetupClocks, bool) {
        let short = match sorted.role {
            _ if self.plain => Err(TooLong),
            Role::Line { .. } => Err(TooLong),
            _ if self.polygon => self.token(sorted, prim),
            _ => self.of_triangle(sorted, prim),
        };
        if let Ok(done) = short {
            return done;
        }
        let screen = Screen::picture(&self.plan);
        let (clocks, culled) = setup::prepare(&self.plan, &self.timing, screen, sorted, prim);
        (clocks, culled.is_none())
    }

    /// Like `increments`, of a machine without POLY, in 64 bits.
    #[inline(always)]
    fn of_triangle(
        &self,
        sorted: &Sorted<FEW>,
        prim: &mut Prim<FEW>,
    ) -> Result<(SetupClocks, bool), TooLong> {
        let (parts, clocks, is_drawn) = self.short(sorted, prim)?;
        // One place for all three ends: a program's clocks are long to count.
        let of_program = self.timing.of_program(Screen::picture(&self.plan), sorted, &parts, prim);
        Ok((of_program.unwrap_or(clocks), is_drawn))
    }

    /// Like `of_triangle`, with the clocks of a parallel SETUP.
    #[inline(always)]
    fn short(
        &self,
        sorted: &Sorted<FEW>,
        prim: &mut Prim<FEW>,
    ) -> Result<(Parts, SetupClocks, bool), TooLong> {
        let [a, b, c] = &sorted.corners;
        let (du1, dv1, du2, dv2) = (b.u - a.u, b.v - a.v, c.u - a.u, c.v - a.v);
        let [top, knee, bottom] = [a, b, c].map(|corner| -(-corner.v >> self.t)); // rounded up
        let j0 = top.max(0);
        let end = bottom.min(self.height).max(j0);
        let j1 = knee.clamp(j0, end);
        let [left, right] = self.columns([a.u, b.u, c.u]);
        let parts = Parts { first: [j0, j1], lines: [(j1 - j0) as u32, (end - j1) as u32] };
        if end == j0 || right <= left {
            return Ok((parts, self.timing.culled(), false));
        }
        let area = du1 * dv2 - du2 * dv1;
        let scale = self.timing.scale(sorted, area);
        let phase1 = self.timing.phase1(sorted, &parts, scale);
        if area == 0 {
            return Ok((parts, SetupClocks { phase1, phase2: 0 }, false));
        }
        let line = if j1 > j0 { j0 } else { j1 };
        let major_right = area < 0;
        let major = self.walk(a, c, line, true);
        let minor = [self.walk(a, b, j0, j1 > j0), self.walk(b, c, j1, end > j1)];

        // From the first vertex to the first pixel.
        let x = i64::from(major.c) - i64::from(major_right);
        let (du, dv) = ((x << self.t) - a.u, (line << self.t) - a.v);
        let q = i64::from(major.q);
        let length =
            |numbers: &[i64]| 64 - numbers.iter().fold(0, |all, n| all | n.unsigned_abs()).leading_zeros();
        // |Nx|, |Ny| < 2^(difference_bits + extent), and all numerators below that times q + 2 or |du| + |dv|.
        let extent = length(&[du1, dv1, du2, dv2]);
        if self.difference_bits + extent + length(&[q.abs() + 2, du.abs() + dv.abs()]) > 62 {
            return Err(TooLong);
        }
        // Values are shorter than 62 bits: nothing wraps here, and what might be checked one by one goes side by side.
        let flip = -i64::from(major_right);
        let turned = |value: i64| (value ^ flip).wrapping_sub(flip);
        let dc1: [i64; 4] = from_fn(|i| turned(b.values[i].wrapping_sub(a.values[i])));
        let dc2: [i64; 4] = from_fn(|i| turned(c.values[i].wrapping_sub(a.values[i])));
        let nx: [i64; 4] = from_fn(|i| dc1[i].wrapping_mul(dv2).wrapping_sub(dc2[i].wrapping_mul(dv1)));
        let ny: [i64; 4] = from_fn(|i| dc2[i].wrapping_mul(du1).wrapping_sub(dc1[i].wrapping_mul(du2)));
        let n0: [i64; 4] = from_fn(|i| ny[i].wrapping_add(nx[i].wrapping_mul(q)));
        let n1: [i64; 4] = from_fn(|i| n0[i].wrapping_add(nx[i]));
        let moved: [i64; 4] = from_fn(|i| nx[i].wrapping_mul(du).wrapping_add(ny[i].wrapping_mul(dv)));
        let divisor = Divisor::new(area.abs());
        let (gx, exact_x) = divisor.round(nx, &self.slope_shift);
        let (d0, exact_0) = divisor.round(n0, &self.slope_shift);
        let (d1, exact_1) = divisor.round(n1, &self.slope_shift);
        let (start, exact_start) = divisor.round(moved, &self.value_shift);
        if !(exact_x & exact_0 & exact_1 & exact_start) {
            return Err(TooLong);
        }
        let word = |values: [i64; 4]| -> Words { from_fn(|i| values[i] as u64 & self.word_masks[i]) };
        // The fields of POLY, BLEND and TERM keep what they have: nothing here. A line, which the plain setup writes, has more.
        (prim.line, prim.lines) = (line as u32, parts.lines);
        (prim.thin, prim.flat) = (false, false);
        prim.major_right = major_right;
        (prim.major, prim.minor) = (major, minor);
        prim.start[0] = self.first_words(a, start);
        prim.delta = [word(d0), word(d1)];
        prim.gradient = word(gx.map(turned));
        let phase2 = self.timing.phase2(sorted, &parts, prim, (area, scale));
        Ok((parts, SetupClocks { phase1, phase2 }, true))
    }

    /// The words at the first pixel: so much more than at a corner.
    #[inline(always)]
    pub(super) fn first_words(&self, corner: &Corner<FEW>, moved: [i64; FEW]) -> Words {
        from_fn(|i| {
            let value = (corner.values[i] as u64) << self.value_bits[i];
            (moved[i] as u64).wrapping_add(value).wrapping_add(self.half[i]) & self.word_masks[i]
        })
    }

    /// Top first; of equal v the earlier comes first. Each field is written where it stays: a `Sorted` is long to copy.
    #[inline(always)]
    fn sort_short(&self, vertices: &[PortVertex; 3], sorted: &mut Sorted<FEW>) {
        let centre = |x: i32| ((x << self.unused >> self.unused) << self.double) - self.offset;
        let [v0, v1, v2] = [&vertices[0], &vertices[1], &vertices[2]].map(|vertex| centre(vertex.y()));
        let mut order = [0usize; 3];
        order[usize::from(v1 < v0) + usize::from(v2 < v0)] = 0;
        order[usize::from(v0 <= v1) + usize::from(v2 < v1)] = 1;
        order[usize::from(v0 <= v2) + usize::from(v1 <= v2)] = 2;
        // Written out: mapped over an array, the corners are copied several times.
        let corner = |vertex: &PortVertex| Corner {
            u: i64::from(centre(vertex.x())),
            v: i64::from(centre(vertex.y())),
            values: from_fn(|i| vertex.values()[i] & self.vertex_masks[i]),
        };
        let [top, middle, bottom] = order;
        sorted.corners = [corner(&vertices[top]), corner(&vertices[middle]), corner(&vertices[bottom])];
        if self.roles {
            sorted.role = Role::of(vertices);
        }
        if self.polygon {
            self.window(sorted, vertices, order);
        }
    }

    /// k0 and k1: the first column that may have a pixel, and the first behind the last.
    #[inline(always)]
    pub(super) fn columns(&self, u: [i64; 3]) -> [i64; 2] {
        let [a, b, c] = u.map(|u| -(-u >> self.t)); // rounded up
        [a.min(b).min(c).max(0), a.max(b).max(c).min(self.width)]
    }

    /// The exact edge from `a` down to `b`, as it stands on line `j`.
    #[inline(always)]
    pub(super) fn walk(&self, a: &Corner<FEW>, b: &Corner<FEW>, j: i64, walked: bool) -> EdgeWalk {
        let (dx, dy) = (b.u - a.u, b.v - a.v);
        if !walked {
            return EdgeWalk { m: dy as i32, ..EdgeWalk::default() };
        }
        let divisor = Divisor::new(dy);
        let n = a.u * dy + ((j << self.t) - a.v) * dx;
        let (q, f) = if dy >> self.t == 0 { (0, 0) } else { divisor.floor(dx) };
        let (column, r) = divisor.floor(-n >> self.t);
        EdgeWalk {
            c: sign_extend(column.wrapping_neg() as i32, self.column_bits),
            r: r as i32,
            q: sign_extend(q as i32, self.column_bits),
            f: f as i32,
            m: dy as i32,
        }
    }
}
