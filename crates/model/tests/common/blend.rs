//! BLEND by itself: the unit with its memory, and what it must come to.

use edgewalk_machine::Plan;
use edgewalk_model::blend::Blend;
use edgewalk_model::tokens::{ColorWrite, Fragment, MAX_CHANNELS};
use edgewalk_model::{BlendInputs, ColorMemory, Events, Stalls};

pub const C: usize = MAX_CHANNELS;

/// Three colours as a word of the memory, red the most significant.
pub fn word(plan: &Plan, rgb: [u32; 3]) -> u64 {
    rgb.into_iter().fold(0, |word, c| word << plan.color.bits | u64::from(c))
}

/// A fragment of this colour and k_t, the triangle's or that of its channel.
pub fn fragment(addr: u32, [r, g, b]: [u32; 3], kt: u32) -> Fragment<C> {
    Fragment { addr, values: [0, r, g, b, kt, 0, 0, 0], kt: kt as u16, ..Fragment::default() }
}

/// Feeds BLEND and its memory with a fragment a clock; gives the memory, the writes, the events and the cycles.
pub fn feed(
    plan: &Plan,
    fragments: &[Fragment<C>],
    add: bool,
    stalls: Stalls,
) -> (ColorMemory<C>, Vec<ColorWrite<C>>, Events, u64) {
    let mut blend = Blend::new(plan);
    let mut memory = ColorMemory::new(plan, [1, 2, 3], stalls);
    let (mut events, mut writes) = (Events::default(), Vec::new());
    let (mut next, mut cycles) = (0, 0);
    while next < fragments.len() || blend.occupied() {
        let pass = fragments.get(next);
        let inputs = BlendInputs {
            color_write: true,
            add,
            crd_ready: memory.crd_ready(),
            cdata: memory.cdata(),
            cwr_ready: memory.cwr_ready(),
        };
        let read = blend.read(pass, add).filter(|_| inputs.crd_ready);
        let fires = pass.is_some() && blend.pass_ready(pass, &inputs);
        let taken = inputs.cdata.is_some() && blend.cdata_ready(inputs.cwr_ready);
        let write = blend.write().filter(|_| inputs.cwr_ready);
        blend.step(pass, &inputs, &mut events);
        memory.step(read, taken, write.as_ref());
        next += usize::from(fires);
        writes.extend(write);
        cycles += 1;
        assert!(cycles < 1000 * (fragments.len() as u64 + 10), "BLEND does not come to rest: {plan:?}");
    }
    (memory, writes, events, cycles)
}
