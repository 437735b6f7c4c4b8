//! What each unit declares, a file a unit, in the order the data flows.

pub mod tokens;
pub mod setup;
pub mod edge;
pub mod poly;
pub mod span;
pub mod term;
pub mod pixel;
pub mod texel;
pub mod bump;
pub mod normal;
pub mod lamp;
pub mod shade;
pub mod project;
pub mod shadow;
pub mod dither;
pub mod depth;
pub mod blend;
pub mod memory;
pub mod machine;

use crate::unit::UnitSpec;

/// Lists the units in the order the data flows, and the counts of their events.
macro_rules! units {
    ($($unit:ident),*) => {
        /// Every unit, in the order the data flows.
        pub const UNITS: &[&UnitSpec] = &[$(&$unit::SPEC),*];

        /// How often each event of the machine was met in a run. A suite that leaves one at zero has not
        /// tested it.
        #[derive(Clone, Debug, Default, PartialEq, Eq)]
        pub struct Events {
            $(#[doc = concat!("Events of unit `", stringify!($unit), "`.")] pub $unit: $unit::Events,)*
            /// Events between units.
            pub machine: machine::Events,
        }

        impl Events {
            /// Every event's name with its count.
            #[must_use]
            pub fn counts(&self) -> Vec<(&'static str, u64)> {
                [$(self.$unit.counts(),)* self.machine.counts()].concat()
            }

            /// Adds the counts of another run.
            pub fn merge(&mut self, other: &Events) {
                $(self.$unit.merge(&other.$unit);)*
                self.machine.merge(&other.machine);
            }
        }
    };
}

units! { setup, edge, poly, span, term, pixel, texel, bump, normal, lamp, shade, project, shadow, dither, depth, blend }

impl Events {
    /// Names of the events that were not met.
    #[must_use]
    pub fn missing(&self) -> Vec<&'static str> {
        self.counts().into_iter().filter(|(_, count)| *count == 0).map(|(name, _)| name).collect()
    }
}
