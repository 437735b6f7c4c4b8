//! How far the values of a frame's triangles are stepped, and what that proves of their errors.

use crate::port::PortFrame;
use anyhow::{Result, anyhow};
use edgewalk_machine::{Channel, ErrorBudget, Fill, Hazard, Machine, Plan, PortVertex, Role, Window};
use edgewalk_model::DrawState;
use edgewalk_model::fast::{Passage, Renderer};
use edgewalk_numerics::Steps;

/// The pixel behind the most additions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// Place in the frame of its triangle.
    pub triangle: i32,
    /// Column and line.
    pub pixel: (u32, u32),
    /// Additions behind it.
    pub steps: Steps,
}

impl Reach {
    /// Of the frame that went through the units; none where nothing was drawn.
    #[must_use]
    pub fn of(machine: &Plan, ids: &[i32], passage: &Passage) -> Option<Reach> {
        let drawn = passage.fates().iter().filter(|fate| fate.ends);
        let farthest = drawn.zip(ids).filter_map(|(fate, id)| Some((fate.farthest?, *id)));
        let ((pixel, [lines, columns]), triangle) =
            farthest.max_by_key(|((_, [lines, columns]), _)| lines + columns)?;
        let pixel = (pixel % machine.width, pixel / machine.width);
        Some(Reach { triangle, pixel, steps: Steps { lines, columns } })
    }

    /// What is proved of a channel's outputs for no more additions than these; none where they may wrap.
    #[must_use]
    pub fn budget(&self, machine: &Plan, channel: &Channel) -> Option<ErrorBudget> {
        let budget = machine.budget_behind(channel, self.steps);
        (machine.fill == Fill::Exact && budget.holds()).then_some(budget)
    }

    /// The largest error that it allows, LSB.
    #[must_use]
    pub fn bound(&self, machine: &Plan, channel: &Channel) -> Option<f64> {
        self.budget(machine, channel).map(|budget| budget.after_rounding().to_f64())
    }
}

/// The machine with timing keys by which no frame has to be ticked, if it has neither channels of the user's own nor BLEND; its
/// pixels are the same.
///
/// # Errors
/// None for a machine that was planned.
pub fn untimed(machine: &Plan) -> Result<Plan> {
    Ok(machine.with(as_untimed).plan()?)
}

fn as_untimed(keys: &mut Machine) {
    (keys.hazard, keys.latency, keys.inflight) = (Hazard::Forward, 1, 16);
}

/// Takes the frame through the units, as far as it is the same whatever the machine has besides: where its triangles are stepped.
///
/// # Errors
/// Vertices of another machine.
pub fn geometry(machine: &Plan, port: &PortFrame) -> Result<Passage> {
    let bare = Machine::default();
    let bare = machine.with(|keys| {
        (keys.shade, keys.shadow, keys.dither, keys.blend) =
            (bare.shade, bare.shadow, bare.dither, bare.blend);
        (keys.extra, keys.adders) = (bare.extra, keys.adders.min(bare.adders));
        keys.polygon.values = bare.polygon.values; // where a frame is stepped does not follow its colours
        as_untimed(keys);
    });
    let plan = bare.plan()?;
    let of_plan = |triangle: &[PortVertex; 3]| {
        let vertices = triangle.map(|v| plan.raw_vertex(v.x(), v.y(), v.values()));
        plan.with_window(plan.with_role(vertices, Role::of(triangle)), Window::of(triangle))
    };
    let triangles = port.triangles.iter().map(of_plan);
    // The rules decide what is stored, not where it is stepped: those of the first pass serve.
    let state = port.passes.first().map_or_else(DrawState::default, |pass| pass.state);
    let drawn = Renderer::new(&plan, false).draw_passage(triangles, state);
    drawn.map_err(|refusal| anyhow!("the fast engine draws every frame of such a machine: {refusal:?}"))
}

/// Like `geometry`, of all passes together.
///
/// # Errors
/// Vertices of another machine.
pub fn walked(machine: &Plan, port: &PortFrame) -> Result<Option<Reach>> {
    Ok(Reach::of(machine, &port.ids, &geometry(machine, port)?))
}

/// How far the values of these triangles are stepped; none where the frame has several passes.
///
/// # Errors
/// Vertices of another machine.
pub fn reach(machine: &Plan, port: &PortFrame) -> Result<Option<Reach>> {
    if port.passes.len() != 1 {
        return Ok(None);
    }
    walked(machine, port)
}
