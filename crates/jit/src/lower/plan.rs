//! All that programs are made from.

use crate::design::Design;
use crate::graph::ValueId;
use crate::layout::Layout;
use crate::places::ArrayPlaces;
use crate::sign_extended::Signs;
use crate::step::Step;
use crate::tables::Tables;
use crate::wakes::Wakes;

/// A function of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Program {
    /// Samples the outputs, then a clock.
    Clock,
    /// The outputs of this cycle.
    Outputs,
    /// All signals with a name.
    Signals,
}

/// All that programs are made from.
pub(crate) struct Plan {
    pub design: Design,
    pub steps: Vec<Step>,
    pub tables: Tables,
    pub arrays: ArrayPlaces,
    pub signs: Signs,
    pub wakes: Wakes,
    /// Kept in the state from step to step.
    pub shared: Vec<ValueId>,
    pub layout: Layout,
}
