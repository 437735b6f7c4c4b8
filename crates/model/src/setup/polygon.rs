//! SETUP in a machine with POLY: triangles, lines, and parts of polygons.
//!
//! Rules: `docs/machine.md`, section 19, "Setup".

use super::clocks::Timing;
use super::edges::{self, Parts, Screen};
use super::sort::Sorted;
use super::spent::SetupClocks;
use super::{Culled, channels};
use crate::Events;
use crate::tokens::Prim;
use edgewalk_machine::{COLOURS, Plan, Role};

/// The clocks of a token, and why it gives no prim; if it gives one, without tag and numbers.
pub(super) fn prepare<const C: usize>(
    plan: &Plan,
    timing: &Timing,
    screen: Screen,
    sorted: &Sorted<C>,
    prim: &mut Prim<C>,
) -> (SetupClocks, Option<Culled>) {
    let parts = edges::parts(plan, screen, sorted);
    let role = sorted.role;
    let plane = matches!(role, Role::Plane(_));
    if !plane && parts.lines == [0, 0] {
        return (timing.culled(), Some(Culled::Lines));
    }
    // Asked of triangles only.
    if edges::no_columns(plan, screen, sorted) {
        return (timing.culled(), Some(Culled::Columns));
    }
    let area = sorted.area();
    let scale = timing.scale(sorted, area);
    let phase1 = timing.phase1_of_sides(sorted, &parts, scale);
    if area == 0 && !plane && role.ends() {
        return (SetupClocks { phase1, phase2: 0 }, Some(Culled::Area));
    }
    let [a, b, c] = &sorted.corners;
    let ([j0, j1], [n1, n2]) = (parts.first, parts.lines);
    let [major, upper, lower] = sorted.counts;
    let lines = |counts: bool, lines: u32| if counts { lines } else { 0 };
    *prim = Prim {
        line: parts.drawn() as u32 & (u32::MAX >> (32 - plan.widths().line)),
        lines: parts.lines,
        major_right: area < 0,
        sides: u32::from(major) | u32::from(upper) << 1 | u32::from(lower) << 2,
        ends: role.ends(),
        void: plane && area == 0,
        start_pixel: [sorted.window.x0, sorted.window.y0],
        thin: role.is_line(),
        flat: role.is_flat(),
        major: edges::walk(plan, a, c, parts.drawn(), lines(major, n1 + n2)),
        minor: [edges::walk(plan, a, b, j0, lines(upper, n1)), edges::walk(plan, b, c, j1, lines(lower, n2))],
        ..Prim::default()
    };
    if plan.polygon.is_bilinear() {
        ends_of_edges(plan, sorted, &parts, prim);
    }
    if area == 0 || !role.ends() {
        return (SetupClocks { phase1: Timing::without_plane(phase1), phase2: 0 }, None);
    }
    channels::prepare(plan, sorted, &parts, prim);
    (SetupClocks { phase1, phase2: timing.phase2_of_plane(sorted, scale, area) }, None)
}

/// What POLY makes colours along edges of.
fn ends_of_edges<const C: usize>(plan: &Plan, sorted: &Sorted<C>, parts: &Parts, prim: &mut Prim<C>) {
    let w = plan.widths();
    let length = |length: i64| length as u32 & (u32::MAX >> (33 - w.difference)); // DW - 1 bits
    let [a, b, c] = &sorted.corners;
    prim.heights = [c.v - a.v, b.v - a.v, c.v - b.v].map(length);
    let down = |line: i64, from: i64| length((line << w.center_fraction) - from);
    prim.down = [down(parts.drawn(), a.v), down(parts.first[1], b.v)];
    for (values, place) in prim.colours.iter_mut().zip(COLOURS) {
        *values = [a, b, c].map(|corner| corner.values[place] as u32); // unsigned, at most 32 bits
    }
}

/// Counts a token that gives a prim and is cut by its window.
pub(super) fn count<const C: usize>(plan: &Plan, screen: Screen, sorted: &Sorted<C>, events: &mut Events) {
    let [top, bottom] = edges::cut_by_window(plan, screen, sorted);
    events.setup.window_top += u64::from(top);
    events.setup.window_bottom += u64::from(bottom);
}
