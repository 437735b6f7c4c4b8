//! Model and netlist side by side: one rig that drives, one comparison, every port in every cycle.
//!
//! ```text
//!  declarations of crate machine ─> interface: links, memories, ports with ids
//!                                      │
//!  stimulus ─> rig ──────────> port values ──> model  ─┐
//!       (stalls, resets, memories)       └───> netlist ─┴─> comparison ─> first difference, told in full
//! ```
//! A [`Device`] is whatever takes and gives the port values of an [`Interface`]: units of the model, netlists in the
//! interpreter, and what others put behind it. No port and no field is listed here: all come from the declarations, and are
//! found by name when a run begins. A check that compared nothing has failed: whatever compares here says how much it
//! compared. No I/O.
//!
//! ```
//! use edgewalk_lockstep::{StallKind, render_rtl};
//! use edgewalk_machine::{DrawState, Machine};
//! use edgewalk_model::{Stalls, render};
//! let plan = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! let corner = |x, y, red| plan.port_vertex(x, y, &[0.5, red, 0.0, 0.0]);
//! let triangle = [corner(3.0, 1.5, 1.0)?, corner(13.25, 4.75, 0.0)?, corner(5.5, 10.0, 0.5)?];
//! let model = render(&plan, [triangle], DrawState::default(), Stalls::NONE)?;
//! let netlist = render_rtl(&plan, [triangle], DrawState::default(), StallKind::None)?;
//! assert_eq!((model.z, model.rgb), (netlist.z, netlist.rgb));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: [`Case`] compares every port in every cycle; crate `vectors` writes what a run met for a simulator.

pub mod unit;
pub mod values;
pub mod interface;
pub mod pack;
pub mod stalls;
pub mod rig;
pub mod device;
pub mod held;
pub mod compare;
pub mod lockstep;
pub mod case;
pub mod draw;

pub use case::{Case, Checked};
pub use compare::{Comparison, Difference, status_ports};
pub use device::{Device, ModelDevice, NetlistDevice, NoPlace, PortError, Triangles, model, netlist};
pub use draw::{DrawError, render_on, render_rtl, render_rtl_passes, render_rtl_with, tick_rtl};
pub use held::Kept;
pub use interface::{Direction, Interface, Link, Memory, MemoryWrite, Port, StatusPort};
pub use lockstep::{Agreement, Lockstep, LockstepError, lockstep};
pub use rig::{MemorySetting, Rig, Setting};
pub use stalls::{Pattern, StallKind, patterns};
pub use unit::Unit;
pub use values::{PortId, PortValues};

/// The values of a token's fields, in the order of the link's fields, each below 2^width.
pub type Token = Vec<u128>;

/// A constant of the interface that has no value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the constant {0} has no value")]
pub struct UnknownConstant(pub String);
