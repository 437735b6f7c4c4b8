//! Which declared events a unit of a machine can meet at all: only these may be missing from a suite.

use crate::capture::Trace;
use std::collections::BTreeMap;

/// How often a run met each event that its unit can meet.
pub type Reached = BTreeMap<&'static str, u64>;

/// What can be met in this unit of this machine, with this depth function and write mask, and how often it was.
#[must_use]
pub fn reached(trace: &Trace) -> Reached {
    let counts: BTreeMap<&str, u64> = trace.events.counts().into_iter().collect();
    let declared = trace.interface.unit.events(&trace.plan).into_iter().map(|event| event.name);
    let possible = declared.filter(|name| possible(trace, name));
    possible.map(|name| (name, counts.get(name).copied().unwrap_or(0))).collect()
}

/// What could be met in some of these runs and was met in none of them.
#[must_use]
pub fn not_covered<'a>(runs: impl IntoIterator<Item = &'a Reached>) -> Vec<&'static str> {
    let mut sum = Reached::new();
    for (name, count) in runs.into_iter().flatten() {
        *sum.entry(name).or_default() += count;
    }
    sum.into_iter().filter(|(_, count)| *count == 0).map(|(name, _)| name).collect()
}

/// What the machine can meet, the state of the picture may rule out: depths that are not written are not waited for and
/// not passed on, nor are colours, and what is added takes its pixel's colour always.
fn possible(trace: &Trace, name: &str) -> bool {
    let state = &trace.state;
    let blends = state.color_write && state.depth_func != 0;
    match name {
        "opaque" | "opaque_behind" | "behind_opaque" => blends && !state.blend_add,
        "depth_first" | "color_first" => blends && state.depth_write,
        "depth_write_waits" => state.depth_write && state.depth_func != 0,
        "fence_handed_on" => blends && state.depth_func != 7,
        name if name.starts_with("color_") => blends,
        "interlock_stall" => state.depth_write,
        "forward_write" | "forward_used" | "forward_compare" => state.depth_write && state.depth_func != 0,
        "own_map" => state.light_pass,
        "shadow_off" => !state.shadow_on && !state.light_pass,
        "outside_map" | "before_map" | "behind_map" | "texel_lit" | "texel_shadow" | "texel_tie"
        | "texel_wait" | "map_stall" | "known_behind_read" => state.shadow_on && !state.light_pass,
        "depth_fail" => state.depth_func != 7,
        _ => true,
    }
}
