//! Which lines of the screen the two parts of a triangle meet.

use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use super::area::Area;
use super::control::Control;
use super::polygon::Polygon;
use super::role::Role;
use super::sort::{Vertices, center_unit};
use crate::light_pass::LightPass;
use crate::wires::Registers;

/// The columns and lines that are drawn.
pub(super) struct Screen<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub light_pass: LightPass<'m>,
    /// With lines.
    pub role: Option<Role<'m>>,
    /// With POLY.
    pub polygon: Option<Polygon<'m>>,
}

impl<'m> Screen<'_, 'm> {
    /// W - 1 columns, 2^-t px.
    fn last_column(&self, bits: u32) -> Signal<'m> {
        let t = self.plan.widths().center_fraction;
        self.number(bits, self.columns(), |side| (side - 1) << t)
    }

    /// H - 1 lines, 2^-t px.
    fn last_center(&self, bits: u32) -> Signal<'m> {
        let t = self.plan.widths().center_fraction;
        self.number(bits, self.lines(), |side| (side - 1) << t)
    }

    /// H - 1.
    fn last_line(&self, bits: u32) -> Signal<'m> {
        self.number(bits, self.lines(), |side| side - 1)
    }

    /// H.
    fn height(&self, bits: u32) -> Signal<'m> {
        self.number(bits, self.lines(), |side| side)
    }

    /// W, and of a flat line H.
    fn columns(&self) -> [u32; 2] {
        [self.plan.width, self.plan.height]
    }

    /// H, and of a flat line W.
    fn lines(&self) -> [u32; 2] {
        [self.plan.height, self.plan.width]
    }

    /// A number of a side of the screen: as it is, and of a flat line.
    fn number(&self, bits: u32, [side, flat]: [u32; 2], of: impl Fn(u128) -> u128) -> Signal<'m> {
        let picture = self.m.lit(bits, of(side.into()));
        let picture = self.role.map_or(picture, |role| role.flat.mux(of(flat.into()), picture));
        self.light_pass.choose(picture, || self.m.lit(bits, of(self.plan.shadow.size.into())))
    }
}

/// First lines, signed, G + 2 bits, and how far below the upper ends of edges they lie, in
/// 1/2^t px; t are the fraction bits of centre coordinates.
pub(super) struct Lines<'m> {
    /// First line of the triangle.
    pub jm: Signal<'m>,
    /// From vertex 0 down to the first line, for the major and the first minor edge.
    pub h0: Signal<'m>,
    /// From vertex 1 down to the first line of the lower part.
    pub h1: Signal<'m>,
    /// Textbook fill: from the upper end of the left edge down to the first line of part 1.
    pub left_a: Signal<'m>,
    /// Of part 2.
    pub left_b: Signal<'m>,
}

impl<'m> Lines<'m> {
    /// j0 and j1 are taken in the clock after the triangle, the counts n1 and n2 of the prim in the clock
    /// after that at the latest.
    pub fn new(
        screen: &Screen<'_, 'm>,
        control: &Control<'m>,
        vertices: &Vertices<'m>,
        prim: &Registers<'m>,
        area: &Area<'m>,
    ) -> Lines<'m> {
        let Screen { m, plan, .. } = *screen;
        let counts = ["n1", "n2"].map(|name| prim[name]);
        let (j0, j1) = match plan.fill {
            Fill::Exact => exact(screen, control, vertices, counts),
            Fill::Textbook => textbook(screen, control, vertices, counts),
        };
        let upper = prim["n1"].q().any().named("upper");
        let jm = upper.mux(j0, j1).named_doc("jm", "first line of the triangle");
        let bits = plan.widths().difference;
        let down = |name: &str, from: usize, (what, to): (&str, Signal<'m>), bits: u32| {
            let line = m.cat(&[to, m.lit(plan.widths().center_fraction, 0)]).trunc(bits);
            let v = vertices.v(from);
            let v = if bits > v.width() { v.sext(bits) } else { v.trunc(bits) };
            (line - v).named_doc(name, &format!("from vertex {from} down to {what}, {}", center_unit(plan)))
        };
        // The first line is the vertex's own but for one above the screen, and none is farther above than
        // half a difference; a window may begin a screen below that.
        let bits_of_h = if screen.polygon.is_some() { bits - 1 } else { bits - 2 };
        let first = ("the first line", jm);
        let [part1, part2] = [("the first line of part 1", j0), ("the first line of part 2", j1)];
        let (h0, h1) = (down("h0", 0, first, bits_of_h), down("h1", 1, part2, bits_of_h));
        let (left_a, left_b) = match plan.fill {
            Fill::Exact => (h0, h1),
            Fill::Textbook => (
                down("left_a", 0, part1, bits),
                area.negative.mux(h1.zext(bits), down("left_b", 0, part2, bits)),
            ),
        };
        Lines { jm, h0, h1, left_a, left_b }
    }
}

/// No column of pixel centres of the screen lies between the leftmost and the rightmost vertex: k1 ≤ k0. As
/// k0 is the least of the three ceil(u/P) or 0, and k1 the largest or W, that is so where all three are
/// equal, none is above 0, or none below W; so neither vertex needs to be found.
fn no_column<'m>(screen: &Screen<'_, 'm>, vertices: &Vertices<'m>) -> Signal<'m> {
    let Screen { m, plan, .. } = *screen;
    m.comment("Columns: is there a column centre of the screen from the leftmost up to before the rightmost vertex?");
    let t = plan.widths().center_fraction;
    let u = [0, 1, 2].map(|place| vertices.u(place));
    let (bits, last) = (u[0].width() - t, screen.last_column(u[0].width()));
    let columns = u.map(|u| u.slice(u.width() - 1, t) + u.trunc(t).any().zext(bits));
    let column = |place: usize| {
        columns[place]
            .named_doc(&format!("column{place}"), "the first column of centres at or right of the vertex")
    };
    let [a, b, c] = [column(0), column(1), column(2)];
    let none_between = (a.eq(b) & b.eq(c)).named("none_between");
    let all = |is: &dyn Fn(Signal<'m>) -> Signal<'m>| is(u[0]) & is(u[1]) & is(u[2]);
    let before = all(&|u| u.msb() | !u.any())
        .named_doc("before_screen", "no vertex lies right of the first column of centres");
    let behind = all(&|u| !u.sle(last))
        .named_doc("behind_screen", "every vertex lies right of the last column of centres");
    none_between | before | behind
}

fn at_least<'m>(a: Signal<'m>, b: Signal<'m>) -> Signal<'m> {
    a.slt(b).mux(b, a)
}

fn at_most<'m>(a: Signal<'m>, b: Signal<'m>) -> Signal<'m> {
    a.slt(b).mux(a, b)
}

/// Centres from vertex to vertex, the upper end included, the lower not. As v is sorted, each end may be cut
/// to the screen by itself; a triangle wholly above or below has all of them at the same side.
fn exact<'m>(
    screen: &Screen<'_, 'm>,
    control: &Control<'m>,
    vertices: &Vertices<'m>,
    counts: [Reg<'m>; 2],
) -> (Signal<'m>, Signal<'m>) {
    let Screen { m, plan, .. } = *screen;
    m.comment(
        "Lines: those whose centres lie at or below the upper end and above the lower end, on the screen.",
    );
    let (bits, t) = (plan.widths().column, plan.widths().center_fraction);
    let line = |place: usize, name: &str| {
        let v = vertices.v(place);
        // What is above the screen has line 0 whatever else it is: v without its sign.
        let down = v.trunc(v.width() - 1);
        let up = v.trunc(t).any().zext(bits);
        let ceil = (down.slice(down.width() - 1, t).zext(bits) + up).named_doc(
            &format!("line{place}"),
            "the first line of centres at or below the vertex, if that is not above the screen",
        );
        let line = match screen.polygon {
            None => {
                let on_screen = down.le(screen.last_center(down.width())).mux(ceil, screen.height(bits));
                v.msb().mux(0, on_screen)
            }
            Some(Polygon { first, end, .. }) => {
                // At a line or above it: ceil(v/P) is that line's number or less.
                let at_most = |line: Signal<'m>| {
                    let center = m.cat(&[line, m.lit(t, 0)]);
                    let bits = center.width().max(down.width());
                    down.zext(bits).le(center.zext(bits))
                };
                let above = v.msb() | at_most(first);
                above.mux(first.zext(bits), at_most(end).mux(ceil, end.zext(bits)))
            }
        };
        m.reg(name, bits).doc("line of the screen").set(line).q()
    };
    let (j0, j1, end) = (line(0, "j0"), line(1, "j1"), line(2, "end_line"));
    let [n1, n2] = counts;
    n1.set((j1 - j0).trunc(n1.q().width()));
    n2.set((end - j1).trunc(n2.q().width()));
    let outside = no_column(screen, vertices);
    // A line may have a pixel beside all of its vertices' columns: SPAN drops what lies off the screen.
    let outside = screen.role.map_or(outside, |role| outside & !role.thin);
    let outside = m.reg("no_column", 1).doc("no column of the screen").set(outside).q();
    let nothing = match screen.polygon {
        None => j0.eq(end) | outside,
        Some(Polygon { plane, triangle, .. }) => !plane & (j0.eq(end) | (outside & triangle)),
    };
    control.feedback.nothing.drive(nothing);
    (j0, j1)
}

/// Lines from vertex to vertex, both included; a part without height has none.
fn textbook<'m>(
    screen: &Screen<'_, 'm>,
    control: &Control<'m>,
    vertices: &Vertices<'m>,
    counts: [Reg<'m>; 2],
) -> (Signal<'m>, Signal<'m>) {
    let Screen { m, plan, .. } = *screen;
    m.comment("Lines of each part: from Y of the upper to Y of the lower end, both drawn, on the screen.");
    let (bits, t) = (plan.widths().column, plan.widths().center_fraction);
    let y = |place: usize| vertices.v(place).slice(plan.widths().center - 1, t).sext(bits);
    let first = |place: usize| at_least(y(place), m.lit(bits, 0)).named(&format!("j{place}_next"));
    let lines = [0, 1].map(|part| {
        let first = first(part);
        let last = at_most(y(part + 1), screen.last_line(bits)).named(&format!("last{part}"));
        let some = (y(part).slt(y(part + 1)) & first.sle(last)).named(&format!("some{part}"));
        let n = counts[part];
        n.when(control.sequence.begin, some.mux(last - first + 1, 0).trunc(n.q().width()));
        m.reg(&format!("j{part}"), bits).doc("line, signed").when(control.sequence.begin, first).q()
    });
    control.feedback.nothing.drive(!counts[0].q().any() & !counts[1].q().any());
    (lines[0], lines[1])
}
