//! One page about a picture: what was drawn, how right it is, and where the cycles went; as text and as JSON.

use crate::compare::Comparison;
use crate::occupancy::{Occupancy, ratio};
use crate::passes::Passes;
use crate::setup_report::SetupReport;
use crate::shaded::Shaded;
use anyhow::Result;
use edgewalk_golden::Order;
use edgewalk_host::extra::{self, OwnChannel};
use edgewalk_host::raster::{Cycles, Raster};
use edgewalk_machine::Plan;
use edgewalk_model::{Activity, Events, Waits};
use edgewalk_scene::Host;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;

/// Everything a report says.
pub struct Report {
    name: String,
    machine: Plan,
    triangles: u64,
    polygons: u64,
    covered: u64,
    writes: u64,
    odd_pixels: u64,
    cycles: Option<Cycles>,
    passes: Vec<Cycles>,
    lights: Vec<Cycles>,
    order: Option<Order>,
    corners: Option<Events>,
    comparison: Option<Comparison>,
    parts: Option<Passes>,
    /// Of each light that was drawn by itself and added.
    added: Vec<Comparison>,
    setup: Option<SetupReport>,
    waits: Waits,
    host: Host,
}

impl Report {
    /// A report without a comparison.
    pub fn new(name: &str, triangles: u64, machine: &Plan, drawn: &Raster) -> Self {
        let mut report = Report {
            name: name.to_owned(),
            machine: machine.clone(),
            triangles,
            polygons: 0,
            covered: 0,
            odd_pixels: 0,
            writes: 0,
            cycles: drawn.cycles.clone(),
            passes: drawn.passes.clone(),
            lights: drawn.lights.iter().map(|light| light.cycles.clone()).collect(),
            order: None,
            corners: drawn.corners.clone(),
            comparison: None,
            parts: None,
            added: Vec::new(),
            setup: None,
            waits: Waits::Never,
            host: drawn.host,
        };
        report.add(drawn);
        report
    }

    /// Counts the next lines of the picture in.
    pub fn add(&mut self, band: &Raster) {
        self.covered += band.coverage.iter().map(|c| u64::from(*c)).sum::<u64>();
        // A closed mesh covers every pixel an even number of times, whatever the view.
        self.odd_pixels += band.coverage.iter().map(|c| u64::from(c % 2)).sum::<u64>();
        self.writes += band.writes.iter().map(|c| u64::from(*c)).sum::<u64>();
    }

    /// The same of an input that has polygons too.
    pub fn with_polygons(mut self, count: u64) -> Self {
        self.polygons = count;
        self
    }

    /// The same of triangles to which the host did this.
    #[must_use]
    pub fn with_host(mut self, host: Host) -> Self {
        self.host = host;
        self
    }

    /// The same with a comparison.
    pub fn with(mut self, comparison: Comparison) -> Self {
        self.comparison = Some(comparison);
        self
    }

    /// The same of a picture in passes, one for each light.
    #[must_use]
    pub fn with_parts(mut self, parts: Passes) -> Self {
        self.parts = Some(parts);
        self
    }

    /// The same of a picture that is the sum of one for each light, each compared by itself.
    #[must_use]
    pub fn with_lights(mut self, lights: Vec<Comparison>) -> Self {
        self.added = lights;
        self
    }

    /// The same from a machine whose memory makes it wait.
    #[must_use]
    pub fn with_stalls(mut self, waits: Waits) -> Self {
        self.waits = waits;
        self
    }

    /// The same of triangles that were sorted for blending.
    #[must_use]
    pub fn sorted(mut self, order: Option<Order>) -> Self {
        self.order = order;
        self
    }

    /// The same with what SETUP did.
    pub fn with_setup(mut self, setup: SetupReport) -> Self {
        self.setup = Some(setup);
        self
    }

    /// The same pixels from a machine that differs in timing keys alone.
    #[must_use]
    pub fn timed(
        &self,
        machine: &Plan,
        cycles: Cycles,
        corners: Option<Events>,
        setup: SetupReport,
    ) -> Report {
        let mut comparison = self.comparison.clone();
        if let Some(comparison) = &mut comparison {
            comparison.cycles_unexplained = cycles.unexplained();
        }
        Report {
            name: self.name.clone(),
            machine: machine.clone(),
            cycles: Some(cycles),
            corners,
            comparison,
            setup: Some(setup),
            passes: Vec::new(),
            lights: Vec::new(),
            order: self.order.clone(),
            parts: None,
            added: Vec::new(),
            ..*self
        }
    }

    /// What was compared.
    #[must_use]
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_ref()
    }

    /// Where the cycles went.
    #[must_use]
    pub fn cycles(&self) -> Option<&Cycles> {
        self.cycles.as_ref()
    }

    /// Triangles and polygons over all pixels together.
    pub fn covered(&self) -> u64 {
        self.covered
    }

    /// Triangles and polygons of the input.
    pub fn primitives(&self) -> u64 {
        self.triangles + self.polygons
    }

    /// As JSON, keys in a fixed order.
    pub fn value(&self) -> Result<Value> {
        let mut report = json!({
            "input": self.name,
            "machine": self.machine.hash(),
            "width": self.machine.width,
            "height": self.machine.height,
            "triangles": self.triangles,
            "polygons": self.polygons,
            "fragments": self.covered,
            "writes": self.writes,
            "odd_pixels": self.odd_pixels,
            "host": {
                "off_screen": self.host.off_screen,
                "clipped": self.host.clipped,
                "pieces": self.host.pieces,
                "clamped_depths": self.host.clamped_depths,
            },
        });
        let own = extra::channels(&self.machine);
        if !own.is_empty() {
            let own: Vec<_> = own.iter().map(|channel| OwnChannel::of(channel, &self.machine)).collect();
            report["channels"] = serde_json::to_value(own)?;
        }
        if let Some(c) = &self.comparison {
            report["comparison"] = serde_json::to_value(c)?;
        }
        if !self.added.is_empty() {
            report["lights"] = serde_json::to_value(&self.added)?;
        }
        if let Some(parts) = &self.parts {
            report["parts"] = serde_json::to_value(parts)?;
        }
        if let Some(c) = &self.cycles {
            let causes: Map<_, _> =
                Activity::of(&self.machine).map(|a| (a.name().to_owned(), json!(c.spent(a)))).collect();
            report["cycles"] = json!({
                "total": c.total,
                "by_cause": causes,
                "pixels_per_clock": ratio(self.covered, c.total),
            });
            if let Some(path) = c.path {
                report["cycles"]["path"] = path.to_string().into();
            }
            if self.waits != Waits::Never {
                report["cycles"]["stalls"] = self.waits.to_string().into();
            }
            if let Some(held) = &c.held {
                report["occupancy"] = Occupancy::of(&self.machine, c.total, held).value();
            }
            if !self.lights.is_empty() {
                report["cycles"]["maps"] = self.lights.iter().map(|light| light.total).collect();
            }
            if !self.passes.is_empty() {
                report["cycles"]["passes"] = self.passes.iter().map(|pass| pass.total).collect();
            }
        }
        if let Some(setup) = &self.setup {
            report["setup"] = setup.value();
        }
        if let Some(c) = &self.corners {
            let possible: Vec<_> = self.machine.events().map(|event| event.name).collect();
            report["corners"] = c
                .counts()
                .into_iter()
                .filter(|(name, _)| possible.contains(name))
                .map(|(name, count)| (name.to_owned(), json!(count)))
                .collect::<Map<_, _>>()
                .into();
        }
        Ok(report)
    }

    /// As a page of text.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let m = &self.machine;
        let polygons = match self.polygons {
            0 => String::new(),
            count => format!(" and {count} polygons"),
        };
        let _ = writeln!(
            t,
            "{}: {} triangles{polygons} on {}x{}, machine {}",
            self.name,
            self.triangles,
            m.width,
            m.height,
            m.hash()
        );
        t += &host(&self.host);
        let _ = writeln!(t, "fragments {}, writes {}", self.covered, self.writes);
        if let Some(order) = &self.order {
            let _ =
                writeln!(t, "transparent triangles, drawn last, from back to front: {}", order.transparent);
            order.warning().iter().for_each(|warning| t += &format!("warning: {warning}\n"));
        }
        match &self.comparison {
            Some(c) => compared(&mut t, m, c),
            None if self.parts.is_some() => t += &self.parts.as_ref().map_or_else(String::new, Passes::text),
            // Golden does not round.
            None if self.cycles.is_none() => {}
            None => extra::channels(m).iter().for_each(|c| t += &OwnChannel::of(c, m).line()),
        }
        for (place, shaded) in self.added.iter().filter_map(|light| light.shaded).enumerate() {
            _ = writeln!(
                t,
                "light {} by itself: {} pixels, largest error {:.4} LSB, {}, {} beyond",
                place + 1,
                shaded.pixels,
                shaded.error,
                bounds(&shaded),
                shaded.beyond
            );
        }
        if let Some(setup) = &self.setup {
            t += &setup.text();
        }
        if let Some(c) = &self.cycles {
            if self.waits != Waits::Never {
                let _ = writeln!(t, "memory stalls {}", self.waits);
            }
            let _ = writeln!(
                t,
                "cycles {}{}, {:.4} pixels a clock",
                c.total,
                c.path.map_or_else(String::new, |path| format!(" ({path})")),
                ratio(self.covered, c.total)
            );
            for a in Activity::of(m) {
                let n = c.spent(a);
                let _ = writeln!(t, "    {:<10} {:>12}  {:>5.1} %", a.name(), n, 100.0 * ratio(n, c.total));
            }
            for (place, pass) in self.passes.iter().enumerate() {
                let _ = writeln!(t, "    pass {place:<5} {:>12}", pass.total);
            }
            for (place, light) in self.lights.iter().enumerate() {
                let _ = writeln!(t, "    map {place:<6} {:>12}  before, not among these", light.total);
            }
            let sum: u64 = Activity::of(m).map(|a| c.spent(a)).sum();
            let _ = writeln!(t, "    {:<10} {:>12}  of {} cycles", "sum", sum, c.total);
            if let Some(held) = &c.held {
                t += &Occupancy::of(m, c.total, held).text();
            }
        }
        t
    }
}

/// What was done to the triangles before the machine, if anything was.
fn host(host: &Host) -> String {
    let Host { off_screen, clipped, pieces, clamped_depths } = *host;
    let mut done = Vec::new();
    if off_screen > 0 {
        done.push(format!("{off_screen} beyond the guard band and off the screen, left out"));
    }
    if clipped > 0 {
        done.push(format!("{clipped} cut at the guard band into {pieces}"));
    }
    if clamped_depths > 0 {
        done.push(format!("{clamped_depths} depths beyond 0 or 1 by rounding, clamped"));
    }
    if done.is_empty() { String::new() } else { format!("host: {}\n", done.join("; ")) }
}

/// How large the bounds of a shaded picture are, and where.
fn bounds(shaded: &Shaded) -> String {
    let ([x, y], above) = (shaded.bound_at, shaded.bound_above_1);
    format!("bounds up to {:.4} at pixel {x},{y}, {above} above 1", shaded.bound)
}

/// What the comparison found. Writing to a string cannot fail.
fn compared(t: &mut String, machine: &Plan, c: &Comparison) {
    _ = writeln!(t, "compared {} / {} covered pixels", c.compared, c.covered);
    _ = writeln!(t, "coverage mismatches {} / {}", c.coverage_mismatches, c.pixels);
    _ = writeln!(
        t,
        "largest z error       {:.4} LSB of {} bits, {}",
        c.z_error,
        machine.z.bits,
        extra::bound(c.z_bound, &c.z_no_bound)
    );
    _ = writeln!(
        t,
        "largest colour error  {:.4} LSB of {} bits, {}",
        c.color_error,
        machine.color.bits,
        extra::bound(c.color_bound, &c.color_no_bound)
    );
    if let Some(additions) = c.additions {
        let of = |bound: Option<f64>| bound.map_or_else(|| "none".to_owned(), |b| format!("{b:.4}"));
        let (z, color) = (of(c.z_bound_for_input), of(c.color_bound_for_input));
        _ = writeln!(t, "bounds for these triangles, at most {additions} additions: z {z}, colour {color}");
    }
    if let Some(b) = &c.blended {
        _ = writeln!(
            t,
            "blended: {} pixels, up to {} layers, running bound up to {:.4} LSB, {:.4} of it reached, {} beyond",
            b.pixels, b.layers, b.bound, b.of_bound, b.beyond
        );
    }
    if let Some(l) = &c.lit {
        _ = writeln!(
            t,
            "light: {} pixels, {} in shadow, {} decided otherwise than golden; {} of {} open; unexplained by texels within {:.4} and depths within {:.4} LSB: {}",
            l.pixels, l.shadow, l.differ, l.open, l.pixels, l.texel_bound, l.depth_bound, l.unexplained
        );
        if l.loose > 0 {
            _ = writeln!(
                t,
                "    {} pixels between texels of several shares: their bounds have them all",
                l.loose
            );
        }
    }
    if let Some(s) = &c.shaded {
        _ = writeln!(
            t,
            "shaded: {} pixels, largest error {:.4} LSB from golden, {}, {:.4} of one reached, {} beyond",
            s.pixels,
            s.error,
            bounds(s),
            s.of_bound,
            s.beyond
        );
        _ = writeln!(
            t,
            "a light at the horizon in {} of them, on its other side in {}; from Phong shading at most {:.4}, {:.4} in the mean",
            s.at_horizon, s.other_branch, s.from_phong, s.mean_from_phong
        );
        if let Some(texels) = &s.texels {
            _ = writeln!(
                t,
                "texels: {} pixels, {} other than golden's, unexplained by places within {:.4} texels: {}; {} another for their picture's sides",
                texels.pixels, texels.differ, texels.bound, texels.unexplained, texels.resampled
            );
            if texels.flattened > 0 {
                _ = writeln!(
                    t,
                    "relief: steeper than the machine's words can say in {} pixels, lower there and without a bound",
                    texels.flattened
                );
            }
        }
    }
    for own in &c.extra {
        let (of, label) = (&own.channel, &own.channel.label);
        _ = writeln!(
            t,
            "largest {} error      {:.4} LSB of {} bits, {}, {}",
            label.name,
            own.error,
            label.bits,
            label.kind,
            extra::bound(of.bound, &of.no_bound)
        );
    }
    _ = writeln!(t, "pixels with a value that wrapped {}", c.wrapped);
    _ = writeln!(
        t,
        "triangle or writes differ: {} within the bound of depth order, {} wrong; background wrong {}",
        c.order_undecided, c.order_wrong, c.background_wrong
    );
}
