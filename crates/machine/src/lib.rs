//! One configuration of the machine, checked, and what each of its units declares: what a wire is called, how
//! wide it is and when it is there, never what is on it.
//!
//! ```text
//!  TOML text / preset ──> Machine ──plan()──> Plan ──> model, rtl, lockstep, vectors, reports
//!      --set key=value ──────┘                 ├─ channels, widths, bounds
//!                                              └─ units: links, memory ports, status, events
//! ```
//! A [`Machine`] is a set of keys that may clash; a [`Plan`] is one that can be built, and all that units,
//! drawing and tools take. `model` and `rtl` share this crate and nothing else: it holds no function from
//! values to values, so behaviour stays written twice. No I/O.
//!
//! ```
//! use edgewalk_machine::Machine;
//! let plan = Machine { adders: 1, ..Machine::default() }.plan().expect("one adder serves four channels");
//! assert_eq!(plan.clocks_per_pixel(), 4);
//! assert!(Machine { guard_bits: 2, ..Machine::default() }.plan().is_err());
//! ```
//!
//! Next: crate `model` draws with a plan, crate `rtl` builds its netlist. `edgewalk config explain KEY` tells a key's meaning;
//! `docs/machine.md` is the specification.

pub mod channel;
pub mod key;
pub mod extra;
pub mod polygon;
pub mod shade;
pub mod shadow;
pub mod dither;
pub mod blend;
pub mod machine;
pub mod keys;
pub mod error;
pub mod presets;
pub mod widths;
pub mod term;
pub mod check;
pub mod budget;
mod stamp;
pub mod plan;
pub mod role;
pub mod record;
pub mod vertex;
pub mod counted;
pub mod contours;
pub mod sequencer;
pub mod draw;
pub mod activity;
pub mod field;
pub mod link;
pub mod unit;
pub mod units;
mod build;
pub mod text;

pub use activity::Activity;
pub use blend::{Blend, BlendKind};
pub use budget::{NoBound, gated};
pub use channel::{Channel, Kind, MAX_CHANNELS, Precision};
pub use counted::Counted;
pub use dither::{Dither, ScreenDoor};
pub use draw::{DrawState, Maps, Pass, Shading, Step, first_of_picture, steps};
pub use edgewalk_nearest::{Unknown, nearest};
pub use edgewalk_numerics::ErrorBudget;
pub use error::MachineError;
pub use extra::ExtraChannel;
pub use field::{Field, Scale};
pub use link::{Held, Link, MemoryPort, Ready, Status, Until};
pub use machine::{EdgeKind, Fill, Hazard, Machine, SetupKind};
pub use plan::{COLOURS, Plan};
pub use polygon::{Lines, Polygon, Values};
pub use record::{Entry, Record};
pub use role::{Role, Sides, Window, wholes};
pub use shade::{Bump, Shade, ShadeColour, ShadeKind, ShadeLight, Texture, Walk};
pub use shadow::{Gate, LIGHT_SPACE, OwnPass, Project, Shadow, ShadowLight, Transmits};
pub use term::Term;
pub use unit::{Event, Ports, UnitSpec};
pub use units::{Events, UNITS};
pub use vertex::{ForeignVertex, PortVertex, VertexError};
pub use widths::Widths;
