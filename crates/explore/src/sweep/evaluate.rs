//! Runs the points that are not there yet.

use super::apart::{self, stands_apart};
use super::grid::Sweep;
use super::point::Point;
use super::row::{Cost, Found, Status, with_figures, without_figures};
use super::shared::{Geometry, Pixels, geometry_key, pixel_key, side_by_side};
use super::store::Store;
use anyhow::Result;
use edgewalk_host::needs::reason;
use edgewalk_host::port::to_port;
use edgewalk_host::reach::{Reach, reach};
use edgewalk_judge::compare::bounds_for_input;
use edgewalk_machine::{COLOURS, EdgeKind, Plan};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::time::Instant;

/// What a run needs beside its points.
pub struct Around<'a> {
    /// Where rows go.
    pub store: &'a Store,
    /// Synthesises a machine.
    pub cost: Option<&'a (dyn Fn(&Plan) -> Cost + Sync)>,
    /// Estimates a machine.
    pub estimate: Option<&'a (dyn Fn(&Plan) -> Value + Sync)>,
    /// Told of each finished row.
    pub done: &'a (dyn Fn() + Sync),
}

/// Runs these points and appends a row for each.
///
/// # Errors
/// A row that cannot be written; those before it are kept.
pub fn run(sweep: &Sweep, points: &[&Point], around: &Around) -> Result<()> {
    let run = Run { sweep, around, estimates: estimates(points, around) };
    let mut geometries: BTreeMap<([usize; 2], Vec<u32>), Vec<Planned>> = BTreeMap::new();
    for point in points {
        match &point.plan {
            Ok(_) if run.ruled_out(point)? => {}
            Ok(plan) => {
                let key = ([point.input, point.way], geometry_key(&point.machine));
                geometries.entry(key).or_default().push((*point, plan));
            }
            Err(why) => run.put(without_figures(sweep, point, Status::Invalid, why), Instant::now())?,
        }
    }
    // One at a time: golden's picture is the largest thing there is.
    geometries.values().try_for_each(|points| run.within_memory(points))
}

/// The estimate of each machine of these points, by the machine's hash: a triangle file may bring another screen.
fn estimates(points: &[&Point], around: &Around) -> BTreeMap<String, Value> {
    let Some(estimate) = around.estimate else { return BTreeMap::new() };
    let machines: BTreeMap<String, &Plan> =
        points.iter().filter_map(|point| Some((point.machine.hash(), point.plan.as_ref().ok()?))).collect();
    machines.into_par_iter().map(|(hash, plan)| (hash, estimate(plan))).collect()
}

struct Run<'r> {
    sweep: &'r Sweep,
    around: &'r Around<'r>,
    /// By the machine's hash.
    estimates: BTreeMap<String, Value>,
}

/// A point with its machine.
type Planned<'p> = (&'p Point, &'p Plan);
type Points<'p> = [Planned<'p>];

impl Run<'_> {
    fn put(&self, mut row: Value, since: Instant) -> Result<()> {
        row["seconds"] = json!(since.elapsed().as_secs_f64());
        self.around.store.append(&row)?;
        (self.around.done)();
        Ok(())
    }

    fn estimate(&self, point: &Point) -> Option<Value> {
        self.estimates.get(&point.machine.hash()).cloned()
    }

    /// Writes the row of a point whose estimate breaks a requirement. Whether it does.
    fn ruled_out(&self, point: &Point) -> Result<bool> {
        let Some(estimate) = self.estimate(point) else { return Ok(false) };
        let mut row = json!({ "estimate": estimate });
        let Some(broken) = self.sweep.requirements.iter().find(|of| of.rules_out_early(&row)) else {
            return Ok(false);
        };
        let reason = format!("required: {broken}; by the estimate: {}", broken.estimated(&row));
        let estimate = row["estimate"].take();
        let mut row = without_figures(self.sweep, point, Status::Pruned, &reason);
        row["estimate"] = estimate;
        self.put(row, Instant::now())?;
        Ok(true)
    }

    fn all(&self, points: &Points, status: Status, reason: &str) -> Result<()> {
        let row = |(point, _): &(&Point, _)| without_figures(self.sweep, point, status, reason);
        points.iter().try_for_each(|point| self.put(row(point), Instant::now()))
    }

    /// Points of one input on one screen; of a large one fewer than there are cores side by side.
    fn within_memory(&self, points: &Points) -> Result<()> {
        let Some((first, _)) = points.first() else { return Ok(()) };
        let threads = side_by_side(&first.machine);
        if threads >= rayon::current_num_threads() {
            return self.geometry(points);
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(|| self.geometry(points))
    }

    /// Points of one input on one screen.
    fn geometry(&self, points: &Points) -> Result<()> {
        let Some((first, plan)) = points.first() else { return Ok(()) };
        let input = &self.sweep.drawn(first).input;
        let geometry = match Geometry::new(input, plan, self.sweep.asks_equation()) {
            Ok(geometry) => geometry,
            Err(why) => return self.all(points, Status::Failed, &reason(&why)),
        };
        let mut groups: BTreeMap<Vec<u32>, Vec<Planned>> = BTreeMap::new();
        for (point, plan) in points {
            groups.entry(pixel_key(&point.machine)).or_default().push((*point, *plan));
        }
        let mut reaches = BTreeMap::new();
        let mut wanted = Vec::new();
        for group in groups.into_values() {
            match self.unwanted(&geometry, group[0].1, &mut reaches) {
                Ok(Some(why)) => self.all(&group, Status::Pruned, &why)?,
                Ok(None) => wanted.push(group),
                Err(why) => self.all(&group, Status::Failed, &reason(&why))?,
            }
        }
        wanted.par_iter().with_max_len(1).try_for_each(|group| self.pixels(&geometry, group))
    }

    /// Why points are not wanted: no bound as small as asked for is proved of their machine.
    fn unwanted(
        &self,
        geometry: &Geometry,
        plan: &Plan,
        reaches: &mut BTreeMap<(bool, u32), Option<Reach>>,
    ) -> Result<Option<String>> {
        let Some(limit) = self.sweep.definition.bound else { return Ok(None) };
        let edges = (plan.edge_kind == EdgeKind::Exact, plan.edge_fraction);
        if let std::collections::btree_map::Entry::Vacant(place) = reaches.entry(edges) {
            place.insert(reach(plan, &to_port(geometry.frame(), plan)?)?);
        }
        let Some(reach) = reaches.get(&edges).copied().flatten() else {
            // Nothing is drawn, which is said later; or nothing is proved of a frame in several passes.
            let apart = stands_apart(geometry.frame(), plan);
            return Ok(apart.then(|| format!("no bound is proved of this frame, asked for are {limit}")));
        };
        let [z, color] = bounds_for_input(plan, geometry.frame(), &reach);
        let mut bounds = plan.channels().iter().enumerate().map(|(place, channel)| match place {
            0 => (channel, z),
            place if COLOURS.contains(&place) => (channel, color),
            _ => (channel, reach.bound(plan, channel)),
        });
        let beyond = bounds.find(|(_, bound)| bound.is_none_or(|bound| bound > limit));
        Ok(beyond.map(|(channel, bound)| {
            let bound =
                bound.map_or_else(|| "no bound is proved".to_owned(), |b| format!("proved are {b:.4} LSB"));
            format!(
                "{} with {} fraction bits behind {} additions: {bound}, asked for are {limit}",
                channel.name,
                channel.fraction,
                reach.steps.total()
            )
        }))
    }

    /// Points of the same pixels.
    fn pixels(&self, geometry: &Geometry, points: &Points) -> Result<()> {
        if stands_apart(geometry.frame(), points[0].1) {
            return points.par_iter().try_for_each(|(point, plan)| self.apart(geometry, point, plan));
        }
        let pixels = match Pixels::new(geometry, points[0].1) {
            Ok(pixels) => pixels,
            Err(why) => return self.all(points, Status::Failed, &reason(&why)),
        };
        let mut lanes: BTreeMap<u32, Vec<Planned>> = BTreeMap::new();
        for (point, plan) in points {
            lanes.entry(plan.lanes).or_default().push((*point, *plan));
        }
        lanes.par_iter().try_for_each(|(_, points)| {
            let setup = pixels.setup(points[0].1)?;
            points.par_iter().try_for_each(|(point, plan)| {
                let since = Instant::now();
                let report = pixels.timed(plan, &setup, self.sweep.memories[point.memory].waits)?;
                let found = Found { report, equation: pixels.distance(), estimate: self.estimate(point) };
                self.put(with_figures(self.sweep, point, plan, found, self.around.cost)?, since)
            })
        })
    }
}

impl Run<'_> {
    /// A point that shares nothing.
    fn apart(&self, geometry: &Geometry, point: &Point, plan: &Plan) -> Result<()> {
        let since = Instant::now();
        let row = match apart::report(geometry, plan, self.sweep.memories[point.memory].waits) {
            Ok((report, equation)) => {
                let found = Found { report, equation, estimate: self.estimate(point) };
                with_figures(self.sweep, point, plan, found, self.around.cost)?
            }
            Err(why) => without_figures(self.sweep, point, Status::Failed, &reason(&why)),
        };
        self.put(row, since)
    }
}

/// Of these points those that have no row, one that is to be tried again, or one without the distance from the shading
/// equation or the estimate that this sweep asks for.
#[must_use]
pub fn missing<'p>(
    sweep: &Sweep,
    points: &[&'p Point],
    rows: &BTreeMap<String, Value>,
    again: &[Status],
) -> Vec<&'p Point> {
    let wanted = |point: &&&Point| {
        let Some(row) = rows.get(&point.key) else { return true };
        let status = Status::of(row);
        let asked = sweep.asks_equation() && sweep.drawn(point).shading.is_some();
        again.iter().any(|again| status == Some(*again))
            || asked && status == Some(Status::Ok) && row["equation"].is_null()
            || sweep.asks_estimate() && status == Some(Status::Ok) && row["estimate"].is_null()
    };
    points.iter().filter(wanted).copied().collect()
}
