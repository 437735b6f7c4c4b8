//! The cause of every cycle (`docs/machine.md`, section 8).

use crate::plan::Plan;
use crate::shadow::Project;

/// What a cycle was spent on; the number is the `activity` port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Activity {
    /// Nothing to do.
    #[default]
    Idle,
    /// A pixel on the screen.
    Draw,
    /// A pixel stepped over off the screen.
    Offscreen,
    /// DEPTH waits for a pixel in flight.
    Hazard,
    /// The in-flight queue is full.
    Queue,
    /// The depth memory takes no read.
    Memory,
    /// PIXEL has no span; a line or a span is on its way.
    Edge,
    /// Nothing is on its way; SETUP works.
    Setup,
    /// The last fragments leave the pipeline.
    Flush,
    /// DEPTH is full, as BLEND takes no fragment.
    Blend,
    /// SHADOW waits for the light's map.
    Light,
    /// A span waits for TERM's walk.
    Term,
    /// A fragment waits for SHADE's tables.
    Shade,
    /// TEXEL waits for the memory of the textures.
    Texel,
    /// PROJECT divides, and takes no fragment.
    Project,
}

impl Activity {
    /// All, in the order of the port's code.
    pub const ALL: [Activity; 15] = [
        Activity::Idle,
        Activity::Draw,
        Activity::Offscreen,
        Activity::Hazard,
        Activity::Queue,
        Activity::Memory,
        Activity::Edge,
        Activity::Setup,
        Activity::Flush,
        Activity::Blend,
        Activity::Light,
        Activity::Term,
        Activity::Shade,
        Activity::Texel,
        Activity::Project,
    ];

    /// Bits of the port.
    pub const BITS: u32 = 4;

    /// Name in reports and, in capitals, in the netlist.
    #[must_use]
    pub const fn name(self) -> &'static str {
        [
            "idle",
            "draw",
            "offscreen",
            "hazard",
            "queue",
            "memory",
            "edge",
            "setup",
            "flush",
            "blend",
            "light",
            "term",
            "shade",
            "texel",
            "project",
        ][self as usize]
    }

    /// The causes that the machine can have.
    pub fn of(plan: &Plan) -> impl Iterator<Item = Activity> {
        let (blends, shadows) = (plan.blend.is_there(), plan.shadow.is_there());
        let (shades, textures) = (plan.shade.is_there(), plan.shade.textures());
        let divides = plan.shadow.projects() && plan.shadow.project == Project::Serial;
        Activity::ALL.into_iter().filter(move |activity| match activity {
            Activity::Blend => blends,
            Activity::Light => shadows,
            Activity::Term | Activity::Shade => shades,
            Activity::Texel => textures,
            Activity::Project => divides,
            _ => true,
        })
    }

    /// What it means, in words.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        [
            "nothing to do",
            "a pixel on the screen",
            "a pixel off the screen is stepped over",
            "DEPTH waits for a pixel in flight",
            "the in-flight queue is full",
            "the depth memory takes no read",
            "PIXEL has no span; a line or a span is on its way",
            "nothing is on its way; SETUP works",
            "the last fragments leave the pipeline",
            "BLEND takes no fragment",
            "SHADOW takes no fragment",
            "TERM walks to the start of a span",
            "SHADE fetches tables",
            "TEXEL takes no fragment",
            "PROJECT divides",
        ][self as usize]
    }

    /// PIXEL steps in such a cycle.
    #[must_use]
    pub fn is_busy(self) -> bool {
        matches!(self, Activity::Draw | Activity::Offscreen)
    }

    /// PIXEL stalls in such a cycle: a fragment waits at its output. In a cycle neither busy nor a stall PIXEL has no pixel.
    #[must_use]
    pub fn is_stall(self) -> bool {
        use Activity::{Blend, Hazard, Light, Memory, Project, Queue, Shade, Texel};
        matches!(self, Hazard | Queue | Memory | Blend | Light | Shade | Texel | Project)
    }

    /// The codes of a machine in words, for the port's documentation: `0 idle 1 draw …`.
    #[must_use]
    pub fn codes(plan: &Plan) -> String {
        let each = Activity::of(plan).map(|a| format!("{} {}", a as u8, a.name()));
        each.collect::<Vec<_>>().join(" ")
    }

    /// In which causes of a machine PIXEL steps, stalls, or has no pixel, in words.
    #[must_use]
    pub fn of_pixel(plan: &Plan) -> String {
        let names = |of: fn(Activity) -> bool| {
            let mut names: Vec<_> = Activity::of(plan).filter(|a| of(*a)).map(Activity::name).collect();
            let last = names.pop().unwrap_or_default(); // every machine has causes of both kinds
            format!("{} and {last}", names.join(", "))
        };
        let (steps, stalls) = (names(Activity::is_busy), names(Activity::is_stall));
        format!("PIXEL steps in {steps}, and stalls in {stalls}. In every other cause PIXEL has no pixel.")
    }
}
