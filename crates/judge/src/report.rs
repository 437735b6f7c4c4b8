//! A picture in full: what was drawn, how right it is, and where the cycles went; as text and as JSON.
//!
//! A part says its figures as JSON by `Serialize`, in the order of its fields, and as text by `lines`. To add a part, write such a struct,
//! give [`Report`] a field for it, and give it a place in [`Report::text`].

mod display;
mod drawn;
mod profile;
mod timing;
mod traffic;

use crate::compare::Comparison;
use crate::occupancy::Occupancy;
use crate::passes::Passes;
use crate::setup_report::SetupReport;
use display::Display;
pub use drawn::Drawn;
use drawn::counts;
use edgewalk_golden::Order;
use edgewalk_host::extra::{self, OwnChannel};
use edgewalk_host::raster::{Cycles, Raster};
use edgewalk_machine::Plan;
use edgewalk_model::{Events, Waits};
pub use profile::{Profiled, Ranged};
use serde::Serialize;
use std::fmt::Write as _;
pub use timing::Timing;
pub use traffic::Traffic;

/// Everything that is said of a picture. [`Report::new`] knows what the picture alone tells; the other parts are filled in behind it.
#[derive(Clone, Serialize)]
pub struct Report {
    /// The input, and what was drawn of it.
    #[serde(flatten)]
    pub drawn: Drawn,
    /// The user's own channels, with what is proved of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<OwnChannel>,
    /// The picture beside golden's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comparison: Option<Comparison>,
    /// Each light that was drawn by itself and added, beside golden's.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<Comparison>,
    /// A picture in passes, one for each light, in place of `comparison`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<Passes>,
    /// Where the cycles went, where a machine drew.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cycles: Option<Timing>,
    /// What passed at the ports, where a machine drew; without the lights' maps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub traffic: Option<Traffic>,
    /// How full queues and lanes were, where a model counted it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub occupancy: Option<Occupancy>,
    /// What SETUP did with the triangles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub setup: Option<SetupReport>,
    /// Hazards and corners met, of those that the machine has, where a model counted them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corners: Option<Corners>,
    /// Cycles over the screen and by size of triangle, datapath and memory alone, where this was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profiled>,
    /// What every number held, where this was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ranges: Vec<Ranged>,
    /// The order in which transparent triangles were drawn.
    #[serde(skip)]
    pub order: Option<Order>,
}

/// Events by name.
#[derive(Clone, Serialize)]
#[serde(transparent)]
pub struct Corners {
    #[serde(serialize_with = "counts")]
    met: Vec<(&'static str, u64)>,
}

impl Corners {
    fn of(machine: &Plan, events: &Events) -> Self {
        let possible: Vec<_> = machine.events().map(|event| event.name).collect();
        Corners { met: events.counts().into_iter().filter(|(name, _)| possible.contains(name)).collect() }
    }
}

impl Report {
    /// What a picture of so many triangles tells, drawn with a memory that makes the machine wait so.
    #[must_use]
    pub fn new(name: &str, triangles: u64, machine: &Plan, picture: &Raster, waits: Waits) -> Self {
        let mut drawn = Drawn::new(name, triangles, machine, picture.host);
        drawn.add(picture);
        let own = extra::channels(machine).iter().map(|channel| OwnChannel::of(channel, machine));
        let report = Report {
            channels: own.collect(),
            comparison: None,
            lights: Vec::new(),
            parts: None,
            cycles: None,
            traffic: None,
            occupancy: None,
            setup: None,
            corners: picture.corners.as_ref().map(|met| Corners::of(machine, met)),
            profile: None,
            ranges: Vec::new(),
            order: None,
            drawn,
        };
        let Some(cycles) = &picture.cycles else { return report };
        let report = report.spent(machine, cycles, waits);
        Report { cycles: report.cycles.map(|timing| timing.with_parts(picture)), ..report }
    }

    /// Counts the next lines of the picture in.
    pub fn add(&mut self, band: &Raster) {
        self.drawn.add(band);
        if let Some(timing) = &mut self.cycles {
            timing.of_fragments(self.drawn.fragments);
        }
    }

    /// The same pixels from a machine that differs in timing keys alone.
    #[must_use]
    pub fn timed(
        &self,
        machine: &Plan,
        (cycles, waits): (&Cycles, Waits),
        corners: Option<&Events>,
        setup: SetupReport,
    ) -> Report {
        let mut comparison = self.comparison.clone();
        if let Some(comparison) = &mut comparison {
            comparison.counts.cycles_unexplained = cycles.unexplained();
        }
        let report = Report {
            drawn: Drawn { machine: machine.hash(), ..self.drawn.clone() },
            comparison,
            setup: Some(setup),
            corners: corners.map(|met| Corners::of(machine, met)),
            ..self.clone()
        };
        report.spent(machine, cycles, waits)
    }

    /// With the megabytes a second of its traffic at a clock of so many MHz.
    #[must_use]
    pub fn at_clock(self, mhz: f64) -> Self {
        Report { traffic: self.traffic.map(|traffic| traffic.at_clock(mhz)), ..self }
    }

    /// Adds the accesses of clearing and of a display: pictures a second, at a clock in MHz.
    #[must_use]
    pub fn with_display(self, machine: &Plan, waits: Waits, hz: f64, mhz: f64) -> Self {
        let display = || Display::new(machine, waits, hz, mhz);
        Report { traffic: self.traffic.map(|traffic| traffic.with_display(display())), ..self }
    }

    /// With these cycles.
    fn spent(self, machine: &Plan, cycles: &Cycles, waits: Waits) -> Self {
        Report {
            cycles: Some(Timing::new(machine, cycles, waits, self.drawn.fragments)),
            traffic: Some(Traffic::new(machine, cycles, waits)),
            occupancy: cycles.held.as_ref().map(|held| Occupancy::of(machine, cycles.total, held)),
            ..self
        }
    }

    /// As a page of text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut t = self.drawn.in_lines();
        if let Some(order) = &self.order {
            // Writing to a string cannot fail.
            _ = writeln!(t, "transparent triangles, drawn last, from back to front: {}", order.transparent);
            order.warning().iter().for_each(|warning| t += &format!("warning: {warning}\n"));
        }
        match (&self.comparison, &self.parts) {
            (Some(comparison), _) => t += &comparison.lines(),
            (None, Some(parts)) => t += &parts.lines(),
            // Golden, which takes no cycles, does not round.
            (None, None) if self.cycles.is_none() => {}
            (None, None) => self.channels.iter().for_each(|channel| t += &channel.line()),
        }
        for (place, shaded) in self.lights.iter().filter_map(|light| light.shaded).enumerate() {
            t += &shaded.line_of_light(place + 1);
        }
        t += &self.setup.as_ref().map(SetupReport::lines).unwrap_or_default();
        t += &self.traffic.as_ref().map(Traffic::lines).unwrap_or_default();
        t += &self.cycles.as_ref().map(Timing::lines).unwrap_or_default();
        t += &self.occupancy.as_ref().map(Occupancy::lines).unwrap_or_default();
        t += &self.profile.as_ref().map(Profiled::lines).unwrap_or_default();
        t += &profile::table(&self.ranges);
        t
    }
}
