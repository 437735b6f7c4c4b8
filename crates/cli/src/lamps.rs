//! Several lights at a point: a picture of the machine for each, beside golden, and the sum of them.

use crate::engine::{Engine, draw, draw_waiting};
use crate::input::{PortFrame, to_port};
use anyhow::{Context as _, Result, anyhow};
use edgewalk_host::lights::sum;
use edgewalk_host::raster::Raster;
use edgewalk_host::reach::reach;
use edgewalk_host::shade::Proof;
use edgewalk_judge::compare::{Comparison, compare_shaded};
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::Frame;

/// What the machine makes of the parts.
pub struct Added {
    /// The sum of the pictures.
    pub drawn: Raster,
    /// As the first goes to the port.
    pub port: PortFrame,
    /// What is proved of the sum.
    pub proof: Option<Proof>,
    /// Each beside golden's.
    pub lights: Vec<Comparison>,
}

/// Draws every part, compares it, and adds them.
pub fn added(
    parts: &[Frame],
    machine: &Plan,
    (engine, waits): (Engine, Waits),
    quiet: bool,
) -> Result<Added> {
    let (mut pictures, mut ports, mut lights) = (Vec::new(), Vec::new(), Vec::new());
    let mut proof: Option<Proof> = None;
    for (place, part) in parts.iter().enumerate() {
        let port = to_port(part, machine).with_context(|| format!("light {}", place + 1))?;
        let golden = draw(Engine::Golden, part, machine, quiet)?;
        let drawn = draw_waiting(engine, part, machine, waits, quiet)?;
        let (reach, own) = (reach(machine, &port)?, port.shade.as_ref().map(|feed| feed.proof.clone()));
        let compared = compare_shaded(machine, part, &golden, &drawn, reach.as_ref(), own.as_ref());
        lights.push(compared.without_maps());
        proof = proof.map(|all| own.iter().cloned().fold(all, Proof::and)).or(own);
        pictures.push(drawn);
        ports.push(port);
    }
    let drawn = sum(&pictures).ok_or_else(|| anyhow!("no light"))?;
    Ok(Added { drawn, port: ports.swap_remove(0), proof, lights })
}
