//! What points share: those of one geometry the frame and golden, those of the same word lengths the pixels.

use super::equation::{Distance, Equation, Measure};
use anyhow::{Result, anyhow};
use edgewalk_host::draw::{self, Drawn};
use edgewalk_host::input::Input;
use edgewalk_host::port::{PortFrame, of_port, to_port};
use edgewalk_host::raster::{Cycles, Raster};
use edgewalk_host::reach::{self, Reach, untimed};
use edgewalk_judge::beside::{Golden, Proved, Subject};
use edgewalk_judge::report::Report;
use edgewalk_judge::setup_report::SetupReport;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::fast::{Passage, Path, Reason, Refusal, Renderer};
use edgewalk_model::{Culled, DrawState, SetupClocks, Shading, Waits, cull, render, tick};
use edgewalk_scene::Frame;

/// Keys that change when things happen, and no pixel.
pub const TIMING: [&str; 8] = [
    "setup.lanes",
    "fifo.span",
    "interpolator.adders",
    "interpolator.segments",
    "memory.hazard",
    "memory.latency",
    "fifo.inflight",
    "memory.tag_bits",
];

/// Keys that golden depends on.
const GEOMETRY: [&str; 4] = ["screen.", "edge.fill", "channels.", "polygon."];

/// Machines alike in this have golden and the frame in common. With POLY a polygon's formats decide whether a plane holds its
/// values.
#[must_use]
pub fn geometry_key(machine: &Machine) -> Vec<u32> {
    let formats = if machine.polygon.is_there() { "formats." } else { GEOMETRY[0] };
    values(machine, |name| GEOMETRY.iter().chain([&formats]).any(|start| name.starts_with(start)))
}

/// Machines alike in this draw the same pixels.
#[must_use]
pub fn pixel_key(machine: &Machine) -> Vec<u32> {
    values(machine, |name| !TIMING.contains(&name))
}

fn values(machine: &Machine, wanted: impl Fn(&str) -> bool) -> Vec<u32> {
    let keys = KEYS.iter().filter(|key| wanted(key.name));
    keys.map(|key| if (key.used)(machine) { (key.get)(machine) } else { u32::MAX }).collect()
}

/// A frame, and golden's picture of it.
pub struct Geometry {
    name: String,
    frame: Frame,
    /// None of a large screen: there it is drawn anew for each comparison, band by band.
    golden: Option<Raster>,
    /// What every way of shading is measured by, where that is asked for.
    equation: Option<Equation>,
}

/// Pixels of the largest screen of which golden's picture is kept: it takes 45 bytes a pixel.
const KEPT: u64 = 1 << 21;

/// Pixels of all pictures that are drawn side by side: each takes up to 24 bytes a pixel.
const SIDE_BY_SIDE: u64 = 1 << 26;

/// How many pictures of this machine's screen may be drawn side by side.
#[must_use]
pub fn side_by_side(machine: &Machine) -> usize {
    (SIDE_BY_SIDE / pixels(machine)).max(1) as usize
}

fn pixels(machine: &Machine) -> u64 {
    u64::from(machine.width) * u64::from(machine.height)
}

impl Geometry {
    /// On the screen of this machine; with the shading equation at each pixel if `asks_equation`.
    ///
    /// # Errors
    /// An input that such a machine cannot draw.
    pub fn new(input: &Input, plan: &Plan, asks_equation: bool) -> Result<Geometry> {
        let frame = input.frame(plan)?;
        let golden = (pixels(plan) <= KEPT).then(|| draw::golden(&frame, plan));
        let equation = if asks_equation { Equation::of(input, plan) } else { None };
        Ok(Geometry { name: input.name().to_owned(), frame, golden, equation })
    }

    /// The frame.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// What is to be said of the machine's picture, and how far that is from the shading equation, where this is asked for.
    ///
    /// # Errors
    /// None but of a picture without lines.
    pub(super) fn beside_golden(
        &self,
        plan: &Plan,
        port: &PortFrame,
        drawn: Drawn,
        proved: Proved,
        waits: Waits,
    ) -> Result<(Report, Option<Distance>)> {
        let Geometry { name, frame, golden, equation } = self;
        let golden = golden.as_ref().map_or_else(|| Golden::of(frame, plan), Golden::Whole);
        let mut measure = equation.as_ref().map(Equation::measure);
        let draw = |lines: u32, take: &mut dyn FnMut(Raster) -> Result<()>| {
            drawn.bands(plan, draw::bands(plan.height, lines), |band| take(of_port(band, port)))
        };
        let subject = Subject { name, machine: plan, frame, golden: &golden, proved, waits };
        let report = subject.report(draw, |beside| {
            measure.iter_mut().for_each(|measure| measure.add(beside.drawn));
            Ok(())
        })?;
        Ok((report, measure.map(Measure::distance)))
    }
}

/// Pixels that machines of the same word lengths have in common, compared with golden.
pub struct Pixels {
    port: PortFrame,
    /// The report without what depends on time.
    report: Report,
    culled: Vec<Option<Culled>>,
    passage: Passage,
    /// The pixels were drawn without ticking.
    plain: bool,
    /// From the shading equation, where that was asked for.
    distance: Option<Distance>,
}

impl Pixels {
    /// Draws and compares.
    ///
    /// # Errors
    /// What of the frame the machine cannot take, or nothing is drawn.
    pub fn new(geometry: &Geometry, plan: &Plan) -> Result<Pixels> {
        let port = to_port(geometry.frame(), plan)?;
        let fast = untimed(plan)?;
        let mut renderer = Renderer::new(&fast, true);
        let (drawn, passage, plain) = match renderer.draw_passage(&port.triangles, port.state()?) {
            Ok(passage) => (Drawn::Fast(renderer), passage, true),
            Err(Refusal::Tick(reason)) => {
                drop(renderer);
                let frame = render(&fast, port.triangles.iter().copied(), port.state()?, Waits::Never)?;
                (Drawn::Ticked(frame, reason, Vec::new()), reach::geometry(plan, &port)?, false)
            }
            Err(Refusal::Foreign(foreign)) => return Err(foreign.into()),
        };
        let reach = Reach::of(plan, &port.ids, &passage).ok_or_else(|| {
            anyhow!("none of the {} triangles covers a pixel of the screen; check the input, screen.width and screen.height", port.triangles.len())
        })?;
        let proved = Proved { reach: Some(&reach), shading: None };
        let (report, distance) = geometry.beside_golden(plan, &port, drawn, proved, Waits::Never)?;
        let culled = port.triangles.iter().map(|triangle| cull(plan, triangle)).collect();
        Ok(Pixels { port, report, culled, passage, plain, distance })
    }

    /// SETUP's clocks on a machine that differs in timing keys alone.
    ///
    /// # Errors
    /// Vertices of another machine.
    pub fn setup(&self, plan: &Plan) -> Result<Setup> {
        let clocks = if self.plain {
            Passage::setup(plan, &self.port.triangles).map_err(|refusal| anyhow!("{refusal:?}"))?
        } else {
            let triangles = self.port.triangles.iter();
            triangles.map(|triangle| edgewalk_model::setup_clocks(plan, triangle)).collect()
        };
        let fates = clocks.iter().zip(&self.culled).zip(self.passage.fates());
        let mut spent = 0;
        // A polygon is any number of tokens: its clocks are theirs, and what becomes of it the last one says.
        let facts = fates.filter_map(|((clocks, culled), fate)| {
            spent += clocks.all();
            fate.ends.then(|| (std::mem::take(&mut spent), *culled, fate.pixels))
        });
        let report = SetupReport::of(plan, facts);
        Ok(Setup { clocks, report })
    }

    /// What the machine makes of the frame: as [`Report`] has it.
    ///
    /// # Errors
    /// Vertices of another machine.
    pub fn timed(&self, plan: &Plan, setup: &Setup, waits: Waits) -> Result<Report> {
        let clocked = if waits != Waits::Never {
            Err(Reason::Memory)
        } else {
            self.passage.clocked(plan, &setup.clocks)
        };
        let (cycles, corners) = match clocked {
            Ok(counters) => (Cycles::of(&counters, Some(Path::Fast)), None),
            Err(reason) => {
                // Frames of several passes stand apart.
                let state = self.port.passes.first().map_or_else(DrawState::default, |pass| pass.state);
                let (counters, events) = tick(plan, &self.port.triangles, state, waits, &Shading::default());
                let cycles = Cycles::of(&counters, Some(Path::Ticked(reason)));
                (cycles, Some(events))
            }
        };
        Ok(self.report.timed(plan, (&cycles, waits), corners.as_ref(), setup.report.clone()))
    }

    /// How far they are from the shading equation, where that was asked for.
    #[must_use]
    pub fn distance(&self) -> Option<Distance> {
        self.distance
    }
}

/// What SETUP does with the triangles.
pub struct Setup {
    clocks: Vec<SetupClocks>,
    report: SetupReport,
}
