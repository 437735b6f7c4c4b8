//! Why a frame has to be ticked.

use crate::tokens::FEW;
use edgewalk_machine::{ForeignVertex, Plan};

/// Why a frame has to be ticked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The machine has channels of the user's own.
    Channels,
    /// Tokens that no polygon is made of: of several windows, or a line behind edges that no plane has ended.
    Polygons,
    /// Colours run along the edges of polygons.
    Bilinear,
    /// The machine has SHADOW.
    Shadow,
    /// The machine blends.
    Blend,
    /// The machine drops fragments by a pattern.
    ScreenDoor,
    /// The machine shades at each pixel.
    Shade,
    /// The rules change between triangles.
    Passes,
    /// The in-flight queue is so short that it fills: `fifo.inflight` <= `memory.latency` / T.
    Queue,
    /// Interlock, and a fragment may have met its own address in flight.
    Interlock,
    /// The memory makes the machine wait.
    Memory,
}

/// Why a frame was not drawn without ticking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The machine has to be ticked.
    Tick(Reason),
    /// A triangle was made for another machine.
    Foreign(ForeignVertex),
}

impl From<Reason> for Refusal {
    fn from(reason: Reason) -> Self {
        Refusal::Tick(reason)
    }
}

impl From<ForeignVertex> for Refusal {
    fn from(foreign: ForeignVertex) -> Self {
        Refusal::Foreign(foreign)
    }
}

/// Why no frame of the machine can be had without ticking.
pub(super) fn refused(plan: &Plan) -> Option<Reason> {
    if plan.polygon.is_bilinear() {
        return Some(Reason::Bilinear);
    }
    if plan.blend.is_there() {
        return Some(Reason::Blend);
    }
    if plan.dither.drops() {
        return Some(Reason::ScreenDoor);
    }
    if plan.shadow.is_there() {
        return Some(Reason::Shadow);
    }
    if plan.shade.is_there() {
        return Some(Reason::Shade);
    }
    if plan.channels().len() > FEW {
        return Some(Reason::Channels);
    }
    queue_fills(plan).then_some(Reason::Queue)
}

/// The queue holds at most a fragment every T clocks for L clocks; it never fills if it has room for one more.
fn queue_fills(plan: &Plan) -> bool {
    plan.inflight <= plan.latency / plan.clocks_per_pixel()
}
