//! `render --profile` and `--ranges`: the frame once more, looked at cycle by cycle.

use crate::engine::Engine;
use crate::input::{PortFrame, to_port};
use anyhow::{Result, anyhow};
use edgewalk_host::shade::apart;
use edgewalk_judge::report::{Profiled, Ranged, Report};
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_model::profile::{Sent, profile, ranges};
use edgewalk_scene::Frame;

/// What is looked at.
#[derive(clap::Args)]
pub struct Look {
    /// Also tell cycles by cause over the screen and by size of triangle. A roofline tells the cycles of the datapath
    /// alone and of each memory alone
    #[arg(long)]
    profile: bool,
    /// Also tell the least and greatest value of every number of the machine beside its width
    #[arg(long)]
    ranges: bool,
}

impl Look {
    /// The picture is one of the golden engine, which has no cycles.
    pub fn check(&self, engine: Engine) -> Result<()> {
        match (self.option(), engine) {
            (Some(option), Engine::Golden | Engine::Scanline) => {
                Err(anyhow!("{option}: the golden picture has no cycles; draw with --engine fast"))
            }
            _ => Ok(()),
        }
    }

    /// The option that was given.
    fn option(&self) -> Option<&'static str> {
        match (self.profile, self.ranges) {
            (true, _) => Some("--profile"),
            (_, true) => Some("--ranges"),
            _ => None,
        }
    }

    /// The host adds several pictures of the machine.
    pub fn refuse(&self) -> Result<()> {
        match self.option() {
            Some(option) => Err(anyhow!(
                "{option}: the host adds a picture for each light; permitted: a frame that the machine draws alone; leave out lights or surfaces that transmit"
            )),
            None => Ok(()),
        }
    }

    /// Adds what is seen of a frame to the report.
    pub fn at_frame(&self, frame: &Frame, machine: &Plan, waits: Waits, report: &mut Report) -> Result<()> {
        if self.option().is_none() {
            return Ok(());
        }
        if apart(frame, machine)?.is_some() {
            return self.refuse();
        }
        self.at_port(&to_port(frame, machine)?, machine, waits, report)
    }

    /// Adds what is seen of a frame at the port to the report.
    pub fn at_port(&self, port: &PortFrame, machine: &Plan, waits: Waits, report: &mut Report) -> Result<()> {
        if self.option().is_none() {
            return Ok(());
        }
        let (triangles, passes, maps) = port.sent();
        let sent = Sent { triangles: &triangles, passes: &passes, maps: &maps, shading: port.words() };
        if self.profile {
            report.profile = Some(Profiled::new(machine, profile(machine, &sent, waits)?));
        }
        if self.ranges {
            report.ranges = ranges(machine, &sent, waits)?.into_iter().map(Ranged::from).collect();
        }
        Ok(())
    }
}
