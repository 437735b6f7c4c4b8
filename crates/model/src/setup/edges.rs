//! Which lines a triangle draws, and how its edges walk over them.

use super::round::round_div;
use super::sort::{Corner, Sorted};
use crate::tokens::{EdgeWalk, sign_extend};
use edgewalk_machine::{EdgeKind, Fill, Plan, Role};

/// What is drawn of the plane: columns and lines from 0 on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen {
    width: i64,
    height: i64,
}

impl Screen {
    /// W and H of the picture.
    pub(crate) fn picture(plan: &Plan) -> Self {
        Screen { width: plan.width.into(), height: plan.height.into() }
    }

    /// Like `picture`, or with `light_pass` SIZE and SIZE of the map.
    pub(crate) fn of_pass(plan: &Plan, light_pass: bool) -> Self {
        let size = plan.shadow.size.into();
        if light_pass { Screen { width: size, height: size } } else { Screen::picture(plan) }
    }

    /// Like `of_pass`, as a triangle or line of this role has it: x and y of a flat line are exchanged.
    fn of_role(self, role: Role) -> Self {
        match role {
            Role::Line { flat: true } => Screen { width: self.height, height: self.width },
            _ => self,
        }
    }
}

impl Screen {
    /// The first column at or right of each corner, cut to the screen.
    pub(super) fn columns<const C: usize>(self, t: u32, sorted: &Sorted<C>) -> [i64; 3] {
        [0, 1, 2].map(|i| (-(-sorted.corners[i].u >> t)).clamp(0, self.of_role(sorted.role).width)) // rounded up
    }
}

/// The drawn lines of the upper and the lower part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Parts {
    /// j0 and j1: first line of each part.
    pub first: [i64; 2],
    /// n1 and n2.
    pub lines: [u32; 2],
}

impl Parts {
    /// jm: first drawn line of the triangle.
    #[inline(always)]
    pub(crate) fn drawn(&self) -> i64 {
        self.first[usize::from(self.lines[0] == 0)]
    }
}

/// Lines of both parts (section 2), cut to the screen.
pub(super) fn parts<const C: usize>(plan: &Plan, screen: Screen, sorted: &Sorted<C>) -> Parts {
    let t = plan.widths().center_fraction;
    let height = screen.of_role(sorted.role).height;
    let v = sorted.corners.map(|c| c.v);
    match plan.fill {
        Fill::Exact => {
            let [top, knee, bottom] = v.map(|v| -(-v >> t)); // rounded up
            let j0 = top.max(0);
            let end = bottom.min(height).max(j0);
            let j1 = knee.clamp(j0, end);
            Parts { first: [j0, j1], lines: [(j1 - j0) as u32, (end - j1) as u32] }
        }
        Fill::Textbook => {
            let y = v.map(|v| v >> t);
            let part = |a: i64, b: i64| {
                let lines = if b > a { b.min(height - 1) - a.max(0) + 1 } else { 0 };
                (a.max(0), lines.max(0) as u32)
            };
            let (upper, lower) = (part(y[0], y[1]), part(y[1], y[2]));
            Parts { first: [upper.0, lower.0], lines: [upper.1, lower.1] }
        }
    }
}

/// No column of pixel centres lies between the smallest and the largest u on the screen; only asked of triangles in exact fill.
pub(super) fn no_columns<const C: usize>(plan: &Plan, screen: Screen, sorted: &Sorted<C>) -> bool {
    let t = plan.widths().center_fraction;
    let [a, b, c] = sorted.corners.map(|c| -(-c.u >> t)); // rounded up
    let (k0, k1) = (a.min(b).min(c).max(0), a.max(b).max(c).min(screen.width));
    plan.fill == Fill::Exact && sorted.role == Role::Triangle && k1 <= k0
}

/// The edge from `a` down to `b`, as it stands on line `j`, its first of `lines`. Where it has none it is not walked: its
/// registers are 0, but for the modulus.
pub(super) fn walk<const C: usize>(
    plan: &Plan,
    a: &Corner<C>,
    b: &Corner<C>,
    j: i64,
    lines: u32,
) -> EdgeWalk {
    let w = plan.widths();
    let p = 1i64 << w.center_fraction;
    let (dx, dy) = (b.u - a.u, b.v - a.v);
    let modulus = match plan.edge_kind {
        EdgeKind::Exact => dy,
        EdgeKind::Slope => 1 << plan.edge_fraction,
    };
    if lines == 0 {
        return EdgeWalk { m: modulus as i32, ..EdgeWalk::default() };
    }
    let o = i64::from(plan.fill == Fill::Textbook);
    let n = a.u * dy + (j * p - a.v) * dx + o * dy; // below 2^(2·DW + 1) <= 2^49
    let steps = dy >= p;
    let (q, f, at) = match plan.edge_kind {
        EdgeKind::Exact => {
            let (q, f) = if steps { (dx.div_euclid(dy), dx.rem_euclid(dy)) } else { (0, 0) };
            (q, f, (-n - o) >> w.center_fraction)
        }
        EdgeKind::Slope => {
            let one = modulus;
            let slope = if steps { round_div(i128::from(dx * one), i128::from(dy)) as i64 } else { 0 };
            // A column of at most 2^49 / 2^t, with F <= 30 fraction bits: it fits, and only COLW + F bits are kept.
            let column = round_div(i128::from(n) * i128::from(one), i128::from(dy * p)) as i64;
            (slope.div_euclid(one), slope.rem_euclid(one), column.wrapping_neg().wrapping_sub(o))
        }
    };
    let column = |c: i64| sign_extend(c as i32, w.column); // the low COLW bits
    EdgeWalk {
        c: column(-at.div_euclid(modulus)),
        r: at.rem_euclid(modulus) as i32,
        q: column(q),
        f: f as i32,
        m: modulus as i32,
    }
}
