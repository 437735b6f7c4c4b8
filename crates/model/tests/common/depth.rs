//! DEPTH by itself: the unit with its memory, and what it must come to.

use edgewalk_machine::Plan;
use edgewalk_model::depth::{Depth, DepthInputs};
use edgewalk_model::tokens::{FEW, Fragment, OutputWords, Write};
use edgewalk_model::{DrawState, Events, Memory, Stalls};
use std::collections::HashMap;

/// Feeds DEPTH and its memory with a fragment a clock; gives the memory, the writes and the events.
pub fn feed(
    plan: &Plan,
    fragments: &[Fragment<FEW>],
    state: DrawState,
    stalls: Stalls,
) -> (Memory<FEW>, Vec<Write<FEW>>, Events) {
    let mut depth = Depth::new(plan);
    let mut memory = Memory::new(plan, state.clear, stalls);
    let mut events = Events::default();
    let mut writes = Vec::new();
    let mut next = 0;
    while next < fragments.len() || depth.occupied() {
        let frag = fragments.get(next);
        let inputs = DepthInputs {
            depth_func: state.depth_func,
            depth_write: state.depth_write,
            rd_ready: memory.rd_ready(),
            data: memory.data(),
            wr_ready: memory.wr_ready(),
            ..DepthInputs::default()
        };
        let block = depth.block(frag, state.depth_write);
        let read = frag.filter(|_| block.is_none() && inputs.rd_ready).map(|f| f.addr);
        let data_taken = inputs.data.is_some() && depth.data_ready(inputs.wr_ready, false);
        let write = depth.write().filter(|_| inputs.wr_ready);
        depth.step(frag, block, &inputs, &mut events);
        memory.step(read, data_taken, write.as_ref());
        next += usize::from(read.is_some());
        writes.extend(write);
    }
    (memory, writes, events)
}

/// The depth test one fragment after the other: what is stored in the end, and what was written.
pub struct Sequential<const C: usize> {
    pub stored: HashMap<u32, OutputWords<C>>,
    pub writes: Vec<Write<C>>,
}

pub fn sequential<const C: usize>(plan: &Plan, fragments: &[Fragment<C>], state: DrawState) -> Sequential<C> {
    let empty = Memory::<C>::new(plan, state.clear, Stalls::NONE).pixel(0);
    assert_eq!(u64::from(empty[0]), plan.z.max());
    let mut stored = HashMap::new();
    let mut writes = Vec::new();
    for f in fragments {
        let pixel = stored.entry(f.addr).or_insert(empty);
        let (z, old) = (f.values[0], pixel[0]);
        let passes = match state.depth_func {
            0 => false,
            1 => z < old,
            2 => z == old,
            3 => z <= old,
            4 => z > old,
            5 => z != old,
            6 => z >= old,
            _ => true,
        };
        if passes {
            *pixel = f.values;
            if !state.depth_write {
                pixel[0] = old;
            }
            let (z_en, lit) = (state.depth_write, f.lit);
            writes.push(Write { addr: f.addr, values: f.values, z_en, lit, source: f.source });
        }
    }
    Sequential { stored, writes }
}
