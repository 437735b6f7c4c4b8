//! A machine in standard cells: flip-flops and gates of each module.
//!
//! Modules stay apart, as `edgewalk energy` maps them: nothing is known at a module's ports.

use super::build::build;
use super::cover::live;
use super::family::Family;
use super::graph::{FALSE, Node, TRUE};
use super::narrow::narrow;
use super::ports::View;
use super::reads::JOINTS;
use super::states::state_machines;
use super::words::Words;
use crate::part::Part;
use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Netlist};
use std::collections::BTreeMap;
use std::ops::AddAssign;

/// What a unit comes to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GateCounts {
    /// Flip-flops.
    pub ff: u64,
    /// Flip-flops that do not take a new value in every clock: a choice stands before each.
    pub held: u64,
    /// Flip-flops with a reset.
    pub reset: u64,
    /// Gates of two inputs.
    pub gates: u64,
}

impl AddAssign for GateCounts {
    fn add_assign(&mut self, other: GateCounts) {
        self.ff += other.ff;
        self.held += other.held;
        self.reset += other.reset;
        self.gates += other.gates;
    }
}

impl GateCounts {
    /// Of each unit of a part, by name; `joints` is what joins the units.
    ///
    /// # Errors
    /// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
    pub fn of(part: Part, plan: &Plan) -> Result<BTreeMap<String, GateCounts>, BuildErrors> {
        let netlist = part.netlist(plan)?;
        if !part.has_units() {
            return Ok(BTreeMap::from([(part.name().to_owned(), GateCounts::whole(&netlist))]));
        }
        let unit = |name: &str| name.trim_start_matches("u_").to_owned();
        let units = netlist.instances.iter().map(|of| (unit(&of.name), GateCounts::whole(&of.module)));
        Ok(units.chain([(JOINTS.to_owned(), GateCounts::own(&netlist))]).collect())
    }

    /// Of a module with all that is in it.
    fn whole(netlist: &Netlist) -> GateCounts {
        let mut all = GateCounts::own(netlist);
        netlist.instances.iter().for_each(|of| all += GateCounts::whole(&of.module));
        all
    }

    /// Of a module without its instances.
    fn own(netlist: &Netlist) -> GateCounts {
        let mut words = Words::of(netlist, &View { outside: true, family: Family::Gates, ..View::default() });
        words.machines = state_machines(&words);
        narrow(&mut words);
        let built = build(&words);
        let mut found = GateCounts::default();
        for (node, _) in built.graph.nodes.iter().zip(live(&built)).filter(|(_, live)| *live) {
            match node {
                Node::And(..) => found.gates += 1,
                Node::Register(place) => {
                    let flip_flop = &built.flip_flops[*place as usize];
                    found.ff += 1;
                    found.held += u64::from(flip_flop.enable != TRUE);
                    found.reset += u64::from(flip_flop.reset != FALSE);
                }
                _ => {}
            }
        }
        found
    }
}
