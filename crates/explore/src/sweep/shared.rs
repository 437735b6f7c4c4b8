//! What points share: those of one geometry the frame and golden, those of the same word lengths the pixels.

use super::equation::{Distance, Equation};
use anyhow::{Result, anyhow};
use edgewalk_host::draw;
use edgewalk_host::input::Input;
use edgewalk_host::port::{PortFrame, of_port, to_port};
use edgewalk_host::raster::{Cycles, Raster, from_fast, from_model};
use edgewalk_host::reach::{self, Reach, untimed};
use edgewalk_judge::compare::compare_for;
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
const GEOMETRY: [&str; 3] = ["screen.", "edge.fill", "channels."];

/// Machines alike in this have golden and the frame in common.
#[must_use]
pub fn geometry_key(machine: &Machine) -> Vec<u32> {
    values(machine, |name| GEOMETRY.iter().any(|start| name.starts_with(start)))
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
    pub(super) name: String,
    pub(super) frame: Frame,
    pub(super) golden: Raster,
    /// What every way of shading is measured by, where that is asked for.
    pub(super) equation: Option<Equation>,
}

impl Geometry {
    /// On the screen of this machine; with the shading equation at each pixel if `asks_equation`.
    ///
    /// # Errors
    /// An input that such a machine cannot draw.
    pub fn new(input: &Input, plan: &Plan, asks_equation: bool) -> Result<Geometry> {
        let frame = input.frame(plan)?;
        let golden = draw::golden(&frame, plan);
        let equation = if asks_equation { Equation::of(input, plan) } else { None };
        Ok(Geometry { name: input.name().to_owned(), frame, golden, equation })
    }

    /// The frame.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }
}

/// Pixels that machines of the same word lengths have in common, compared with golden.
pub struct Pixels {
    port: PortFrame,
    /// The report without what depends on time.
    report: Report,
    culled: Vec<Option<Culled>>,
    passage: Passage,
    /// It was drawn without ticking.
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
        let Geometry { name, frame, golden, equation } = geometry;
        let port = to_port(frame, plan)?;
        let fast = untimed(plan)?;
        let mut renderer = Renderer::new(&fast, true);
        let (drawn, passage, plain) = match renderer.draw_passage(&port.triangles, port.state()?) {
            Ok(passage) => (from_fast(plan, renderer.frame(), Path::Fast), passage, true),
            Err(Refusal::Tick(_)) => {
                let drawn = render(&fast, port.triangles.iter().copied(), port.state()?, Waits::Never)?;
                (from_model(plan, drawn), reach::geometry(plan, &port)?, false)
            }
            Err(Refusal::Foreign(foreign)) => return Err(foreign.into()),
        };
        let drawn = of_port(drawn, &port);
        let reach = Reach::of(plan, &port.ids, &passage).ok_or_else(|| {
            anyhow!("none of the {} triangles covers a pixel of the screen", port.triangles.len())
        })?;
        let comparison = compare_for(plan, frame, golden, &drawn, Some(&reach)).without_maps();
        let report = Report::new(name, frame.triangles.len() as u64, plan, &drawn, Waits::Never);
        let report = Report { comparison: Some(comparison), ..report };
        let culled = port.triangles.iter().map(|triangle| cull(plan, triangle)).collect();
        let distance = equation.as_ref().map(|equation| equation.distance(&drawn));
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
        let facts = fates.map(|((clocks, culled), fate)| (clocks.all(), *culled, fate.pixels));
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
