//! Parts of a machine, as the estimate sees them.

use super::compose::compose;
use super::kept::{Kept, Unit};
use super::ports::View;
use super::reads::JOINTS;
use super::structure::Structure;
use super::words::Words;
use crate::part::Part;
use edgewalk_machine::{Plan, UnitSpec};
use edgewalk_netlist::{BuildErrors, Netlist};
use rayon::prelude::*;
use std::sync::Arc;

impl Part {
    /// What the part's netlist comes to on an iCE40; what is kept of it serves the next machine.
    ///
    /// # Errors
    /// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
    pub fn structure(self, plan: &Plan, kept: &Kept) -> Result<Structure, BuildErrors> {
        if self == Part::MACHINE {
            return machine(plan, kept);
        }
        let netlist = self.netlist(plan)?;
        Ok(match self.has_units() {
            true => Structure { whole: false, ..engine(netlist, kept) },
            false => kept.alone(&netlist, self.name()),
        })
    }

    /// A number for what the part's netlist computes; names and comments are no part of it.
    ///
    /// # Errors
    /// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
    pub fn shape(self, plan: &Plan) -> Result<u64, BuildErrors> {
        Ok(Words::of(&*self.netlist(plan)?, &View::default()).shape())
    }
}

/// Of a machine: a unit that a machine before had too is not even built.
fn machine(plan: &Plan, kept: &Kept) -> Result<Structure, BuildErrors> {
    let specs: Vec<_> = plan.units().collect();
    let unit = |spec: &&UnitSpec| {
        let build =
            edgewalk_rtl::units::builder(spec.name).expect("a test finds a builder for every declared unit");
        kept.unit(spec.name, plan, || build(plan))
    };
    let units = specs.par_iter().map(unit).collect::<Result<Vec<_>, _>>()?;
    let join = || {
        let netlists = plan.units().zip(&units).map(|(spec, unit)| (spec, unit.netlist.clone()));
        edgewalk_rtl::join(plan, netlists.collect())
    };
    let joints = kept.unit(JOINTS, plan, join)?;
    Ok(compose(kept, joints, units))
}

/// Of units that are joined.
fn engine(netlist: Arc<Netlist>, kept: &Kept) -> Structure {
    let unit = |name: &str, netlist| Unit::new(name.trim_start_matches("u_"), netlist);
    let units = netlist.instances.iter().map(|of| unit(&of.name, of.module.clone())).collect();
    compose(kept, Unit::new(JOINTS, netlist), units)
}
