//! Points that share nothing: frames whose rules change, with a light's map, or shaded at each pixel. Each is drawn anew, as
//! `render` draws it.

use super::equation::Distance;
use super::shared::Geometry;
use anyhow::Result;
use edgewalk_host::draw::draw_frame;
use edgewalk_host::port::to_port;
use edgewalk_host::reach::reach;
use edgewalk_judge::beside::Proved;
use edgewalk_judge::report::Report;
use edgewalk_judge::setup_report::SetupReport;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::Frame;

/// Whether machines draw such a frame one by one.
#[must_use]
pub fn stands_apart(frame: &Frame, plan: &Plan) -> bool {
    frame.passes().len() > 1 || plan.shadow.is_there() || plan.shade.is_there()
}

/// What the machine makes of the frame, and how far that is from the shading equation.
///
/// # Errors
/// What of the frame the machine cannot take.
pub fn report(geometry: &Geometry, plan: &Plan, waits: Waits) -> Result<(Report, Option<Distance>)> {
    let port = to_port(geometry.frame(), plan)?;
    let drawn = draw_frame(plan, &port, waits)?;
    let reach = reach(plan, &port)?;
    let shading = port.shade.as_ref().map(|feed| &feed.proof);
    let proved = Proved { reach: reach.as_ref(), shading };
    let (report, distance) = geometry.beside_golden(plan, &port, drawn, proved, waits)?;
    Ok((Report { setup: Some(SetupReport::new(plan, &port.triangles)), ..report }, distance))
}
