//! Draws triangles on the netlist of a machine, with memories that take a read in any cycle and a test that every fragment passes.

use std::collections::VecDeque;

use edgewalk_machine::{Activity, Plan};
use edgewalk_netlist::{Netlist, Simulator};

/// What a triangle puts on which ports.
pub type Triangle = Vec<(String, i64)>;

/// The links of a memory, and clocks from a read to its word.
#[derive(Clone, Copy)]
pub struct Memory {
    pub read: &'static str,
    pub data: &'static str,
    pub latency: u64,
}

/// What came of it.
#[derive(Default)]
pub struct Seen {
    /// Address, then every channel in its order.
    pub writes: Vec<Vec<u128>>,
    /// Cycles in which PIXEL steps.
    pub busy: u64,
}

/// Runs until the machine is idle again; `watch` sees every cycle.
pub fn run(
    netlist: &Netlist,
    plan: &Plan,
    memories: &[Memory],
    triangles: &[Triangle],
    mut watch: impl FnMut(&mut Simulator),
) -> Seen {
    let mut sim = Simulator::new(netlist);
    set(&mut sim, "rst", 1);
    sim.tick();
    for (name, value) in [("rst", 0), ("depth_func", 7), ("depth_write", 1), ("wr_ready", 1)] {
        set(&mut sim, name, value);
    }
    let names = plan.channels().iter().map(|channel| format!("wr_{}", channel.name));
    let names: Vec<String> = std::iter::once("wr_addr".to_owned()).chain(names).collect();
    // When the words of the reads under way come, by memory.
    let mut reads: Vec<VecDeque<u64>> = vec![VecDeque::new(); memories.len()];
    let mut sent = 0;
    let mut seen = Seen::default();
    for cycle in 0..2_000_000 {
        set(&mut sim, "tri_valid", i64::from(sent < triangles.len()));
        for (port, value) in triangles.get(sent).into_iter().flatten() {
            set(&mut sim, port, *value);
        }
        for (Memory { read, data, .. }, reads) in memories.iter().zip(&reads) {
            let is_there = reads.front().is_some_and(|time| *time <= cycle);
            set(&mut sim, &format!("{read}_ready"), 1);
            set(&mut sim, &format!("{data}_valid"), i64::from(is_there));
        }
        if sent == triangles.len() && get(&mut sim, "idle") == 1 {
            return seen;
        }
        watch(&mut sim);
        let activity = get(&mut sim, "activity");
        seen.busy += u64::from(Activity::ALL.iter().any(|a| *a as u128 == activity && a.is_busy()));
        if get(&mut sim, "wr_valid") == 1 {
            seen.writes.push(names.iter().map(|name| get(&mut sim, name)).collect());
        }
        for (Memory { read, data, latency }, reads) in memories.iter().zip(&mut reads) {
            let both = |sim: &mut Simulator, link: &str| {
                get(sim, &format!("{link}_valid")) & get(sim, &format!("{link}_ready")) == 1
            };
            if both(&mut sim, data) {
                reads.pop_front();
            }
            if both(&mut sim, read) {
                reads.push_back(cycle + latency);
            }
        }
        sent += usize::from(sent < triangles.len() && get(&mut sim, "tri_ready") == 1);
        sim.tick();
    }
    panic!("the machine does not come to an end: {plan:?}");
}

fn set(sim: &mut Simulator, name: &str, value: i64) {
    let id = sim.input(name).unwrap_or_else(|error| panic!("{error}"));
    sim.set(id, value as u128);
}

fn get(sim: &mut Simulator, name: &str) -> u128 {
    sim.get(name).unwrap_or_else(|error| panic!("{error}"))
}
