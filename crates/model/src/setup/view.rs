//! What is to be seen of SETUP.

use super::edges::{no_columns, parts};
use super::schedule::{Job, Schedule, schedule};
use super::{Setup, SetupClocks, State};
use crate::tokens::EdgeWalk;
use crate::view::{Shape, View, increment, modulo, word};
use edgewalk_machine::units::tokens::{EDGES, results};
use edgewalk_machine::{Fill, PortVertex, Role};

const STATES: [&str; 4] = ["IDLE", "PHASE1", "PHASE2", "DONE"];
const SEQUENCED_STATES: [&str; 4] = ["IDLE", "WORK", "LOAD", "DONE"];

impl<const C: usize> Setup<C> {
    /// Shows the unit in a cycle with these inputs.
    pub fn view(&self, tri: Option<(&[PortVertex; 3], u32)>, prim_ready: bool, view: &mut View) {
        view.unit(&self.plan, "setup");
        let idle = self.state == State::Idle;
        view.triangle((!idle).then(|| self.taken.wrapping_sub(1)));
        let states = if self.plan.is_sequenced() { &SEQUENCED_STATES } else { &STATES };
        let state = view.code("state", "what the unit is at", states, self.state as usize);
        view.phase(state);
        let job = self.view_job(view);
        self.view_corners(view);
        self.view_edges(view);
        self.view_channels(view);
        if self.plan.is_sequenced() {
            view.number("words_taken", "of the triangle that comes", 16, self.come);
            view.note("the words of the program are not modelled: only their number, and what they give");
        } else {
            view.note(
                "the lanes bit by bit are not modelled: a result appears when the hardware would have it",
            );
        }

        let done = self.state == State::Done;
        let last = self.come + 1 == self.words;
        view.says(
            idle && tri.is_some() && last,
            "takes a triangle and sorts its vertices from top to bottom.",
        );
        view.says(idle && tri.is_some() && !last, "takes a word of a triangle.");
        for (number, text) in Job::SAYS.iter().enumerate().skip(1) {
            view.says(job == number, &format!("clock {{clock}} of {{clocks}}: {text}."));
        }
        let drops = self.state == State::Phase1 && self.culled && self.remaining == 0;
        view.says(drops, "drops the triangle: no line, no column, or no area.");
        let offered = self.prim().is_some();
        let walker = if self.plan.polygon.is_there() { "poly" } else { "edge" };
        if self.sequenced {
            let waits = self.state == State::Phase1 && self.remaining == 0 && !self.culled && offered;
            view.says(waits, "waits: EDGE still reads the registers of the triangle before.");
            view.says(offered && prim_ready, "EDGE has walked the triangle before: its registers are free.");
        } else {
            view.says(done && prim_ready, "hands the triangle over: {n1} + {n2} lines from line {jm} on.");
            view.says(
                done && !prim_ready,
                if self.plan.polygon.is_there() {
                    "waits with the prim: POLY loads its edges, or walks, or PIXEL has not taken the increments of the polygon before."
                } else {
                    "waits with the triangle: EDGE walks, or PIXEL has not taken the increments of the one before."
                },
            );
        }
        view.takes(if self.sequenced { "in" } else { "tri" }, tri.is_some(), idle);
        view.gives("prim", Some(walker), offered, prim_ready);
        view.step("triangle", 't');
    }

    /// The job of the lanes; gives its number.
    fn view_job(&self, view: &mut View) -> usize {
        let working = matches!(self.state, State::Phase1 | State::Phase2);
        let (job, clock, clocks) =
            if working { self.jobs().at(self.phase(), self.elapsed()) } else { (Job::Rest, 0, 0) };
        let busy = view.guard("working", "the lanes are at work", working);
        view.live(Some(busy));
        let shown = view.code("job", "of all lanes", &Job::NAMES, job as usize);
        view.schedule(shown, busy);
        let clock = view.number("clock", "of the job, from 1", 16, clock);
        view.number("clocks", "of the job", 16, clocks);
        view.live(None);
        view.lane(clock, self.state != State::Idle);
        job as usize
    }

    /// PHASE1 or PHASE2.
    fn phase(&self) -> usize {
        usize::from(self.state == State::Phase2)
    }

    /// Clocks since the phase began.
    fn elapsed(&self) -> u32 {
        self.jobs().clocks(self.phase()).wrapping_sub(1 + self.remaining)
    }

    pub(super) fn jobs(&self) -> Schedule {
        if self.plan.is_sequenced() {
            let SetupClocks { phase1, phase2 } = self.clocks;
            return Schedule([phase1, phase2].map(|clocks| vec![(Job::Program, clocks)]));
        }
        let parts = parts(&self.plan, self.screen, &self.sorted);
        let plane = matches!(self.sorted.role, Role::Plane(_));
        let at_once = !plane && parts.lines == [0, 0] || no_columns(&self.plan, self.screen, &self.sorted);
        schedule(&self.plan, &self.sorted, &parts, at_once, &self.prim)
    }

    fn view_corners(&self, view: &mut View) {
        let plan = &self.plan;
        let w = plan.widths();
        let taken = view.guard("taken", "the corners are those of the triangle", self.state != State::Idle);
        view.live(Some(taken));
        let centre =
            Shape::Number { bits: w.center, fraction: w.center_fraction, signed: true, modular: false };
        view.table("corners, px", &["u", "v"], false);
        for (row, corner) in ["p0", "p1", "p2"].into_iter().zip(&self.sorted.corners) {
            view.row(row);
            for value in [corner.u, corner.v] {
                view.cell("centre coordinate", || centre, modulo(value, w.center));
            }
        }
        let names: Vec<&str> = plan.channels().iter().map(|c| c.name).collect();
        view.table("values of the corners, LSB", &names, true);
        for (row, corner) in ["p0", "p1", "p2"].into_iter().zip(&self.sorted.corners) {
            view.row(row);
            for (channel, value) in plan.channels().iter().zip(corner.values) {
                let (bits, fraction) = (channel.vertex_bits(), channel.vertex_fraction);
                let signed = channel.kind.is_signed();
                let shape = || Shape::Number { bits, fraction, signed, modular: false };
                view.cell("at the vertex", shape, modulo(value, bits));
            }
        }
        view.signed("area2", "twice the area, times P squared", 2 * w.difference, self.sorted.area());
    }

    fn view_edges(&self, view: &mut View) {
        let (plan, prim) = (&self.plan, &self.prim);
        let w = plan.widths();
        let known = matches!(self.state, State::Phase2 | State::Done);
        let live = view.guard("edges_known", "phase 1 is over", known);
        view.live(Some(live));
        view.number("jm", "first line", w.line, prim.line);
        view.number("n1", "lines of the upper part", w.line + 1, prim.lines[0]);
        view.number("n2", "lines of the lower part", w.line + 1, prim.lines[1]);
        if plan.polygon.has_lines() {
            view.flag("thin", "a line, a pixel wide", prim.thin);
            view.flag("flat", "of a line: x and y have changed places", prim.flat);
        }
        view.flag("major_right", "the major edge is the right one", prim.major_right);
        if plan.polygon.is_there() {
            view.number("sides", "major, first and second minor edge that count, a bit each", 3, prim.sides);
            view.flag(
                "ends",
                "1: a whole triangle or line, or the last edges of a polygon with its plane",
                prim.ends,
            );
            view.flag("void", "the plane has no area", prim.void);
            let [x, y] = plan.window_bits();
            view.number("start_x", "column at which values start", x, prim.start_pixel[0]);
            view.number(
                "start_y",
                "line at which values start, the first that is drawn",
                y,
                prim.start_pixel[1],
            );
        }
        view.table("edges", &EdgeWalk::COLUMNS, false);
        for (name, edge) in EDGES.into_iter().zip([&prim.major, &prim.minor[0], &prim.minor[1]]) {
            view.row(name);
            edge.view(plan, None, view);
        }
    }

    fn view_channels(&self, view: &mut View) {
        let (plan, prim) = (&self.plan, &self.prim);
        let done = view.guard("done", "all is known", self.state == State::Done);
        view.live(Some(done));
        let names: Vec<&str> = results(plan).iter().map(|(name, _)| *name).collect();
        view.table("increments, LSB", &names, true);
        for (i, channel) in plan.planes() {
            view.row(channel.name);
            for (name, doc) in results(plan) {
                let value = match (plan.fill, *name) {
                    (_, "g") => prim.gradient[i],
                    (Fill::Exact, "start") | (Fill::Textbook, "start_a") => prim.start[0][i],
                    (Fill::Exact, "d0") | (Fill::Textbook, "d_a") => prim.delta[0][i],
                    (_, "start_b") => prim.start[1][i],
                    _ => prim.delta[1][i],
                };
                let shape = || if name.starts_with("start") { word(channel) } else { increment(channel) };
                view.cell(doc, shape, value);
                view.wire(|| format!("prim_{}_{name}", channel.name));
            }
        }
        view.live(None);
    }
}
