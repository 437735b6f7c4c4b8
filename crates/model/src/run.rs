//! The machine and its memories in one: cycle by cycle, or until all triangles are drawn.
//!
//! ```text
//!  triangles ─> Model ─reads, writes─> Memories
//!                  ^────words──────────┘
//! ```

use crate::counters::Counters;
use crate::io::{Cycle, Inputs};
use crate::machine::Model;
use crate::memories::Memories;
use crate::tokens::{FEW, for_channels};
use crate::waits::Waits;
use edgewalk_machine::{DrawState, Events, Plan, PortVertex, Shading};
use std::convert::Infallible;

/// Draws triangles by one state, cycle by cycle and without a look at the pixels: performance counters and events.
#[must_use]
pub fn tick(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    state: DrawState,
    waits: Waits,
    shading: &Shading,
) -> (Counters, Events) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("bmi2")
        && is_x86_feature_detected!("avx2")
    {
        // SAFETY: the function is safe code, compiled for exactly the features found here.
        return unsafe { tick_by_vectors(plan, triangles, state, waits, shading) };
    }
    tick_by_any(plan, triangles, state, waits, shading)
}

/// [`tick`] compiled for vectors of 256 bits: a fragment, or the words of four channels, is one.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2")]
fn tick_by_vectors(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    state: DrawState,
    waits: Waits,
    shading: &Shading,
) -> (Counters, Events) {
    tick_by_any(plan, triangles, state, waits, shading)
}

/// [`tick`] for the processor that the caller is compiled for.
#[inline(always)]
fn tick_by_any(
    plan: &Plan,
    triangles: &[[PortVertex; 3]],
    state: DrawState,
    waits: Waits,
    shading: &Shading,
) -> (Counters, Events) {
    for_channels!(plan, C => {
        let mut rig = Rig::<C>::new(plan, state, waits);
        rig.memories.write_shading(plan, shading);
        let triangles = triangles.iter().map(|triangle| Ok::<_, Infallible>(*triangle));
        let Ok(()) = rig.draw(triangles, |_, _, _| {});
        (rig.counters(), rig.model.events().clone())
    })
}

/// A machine with its memories.
#[derive(Clone, Debug)]
pub struct Rig<const C: usize> {
    /// The machine.
    pub model: Model<C>,
    /// The memories.
    pub memories: Memories<C>,
}

impl<const C: usize> Rig<C> {
    /// A machine after reset, its memory cleared.
    #[must_use]
    pub fn new(plan: &Plan, state: DrawState, waits: impl Into<Waits>) -> Self {
        Rig { model: Model::new(plan), memories: Memories::new(plan, state, waits.into()) }
    }

    /// Performance counters since construction, with those of the memories.
    #[must_use]
    pub fn counters(&self) -> Counters {
        Counters { pages: self.memories.pages(), ..self.model.counters().clone() }
    }

    /// The machine's inputs in a cycle, with a triangle and its tag offered or none.
    #[inline(always)]
    #[must_use]
    pub fn inputs<'a>(&'a self, tri: Option<(&'a [PortVertex; 3], u32)>, writes_open: bool) -> Inputs<'a> {
        self.memories.inputs(tri, writes_open)
    }

    /// One cycle, with a triangle and its tag offered or none. The memories take writes if they are ready and `writes_open`.
    #[inline(always)]
    pub fn cycle(&mut self, tri: Option<(&[PortVertex; 3], u32)>, writes_open: bool) -> Cycle<C> {
        let Rig { model, memories } = self;
        if C == FEW && model.rests() {
            // No read is on its way, and none is asked for.
            let outputs = model.cycle_at_rest(&Inputs { tri, ..Inputs::default() });
            memories.rest();
            return Cycle { outputs, ..Cycle::default() };
        }
        let inputs = memories.inputs(tri, writes_open);
        let outputs =
            model.cycle_and_tell(&inputs, |line| memories.depth.expect(line.y, [line.major, line.minor]));
        let cycle = Cycle {
            outputs,
            read: outputs.rd.filter(|_| inputs.rd_ready),
            data_taken: outputs.data_ready && inputs.data.is_some(),
            color_taken: outputs.blend.cdata_ready && inputs.blend.cdata.is_some(),
            written: outputs.wr.is_some() && inputs.wr_ready,
            color_written: outputs.blend.cwr.is_some() && inputs.blend.cwr_ready,
        };
        memories.step(&cycle, model.asks());
        cycle
    }

    /// Offers the triangles one after the other, each as soon as the one before is taken, until the machine is idle again.
    /// `watch` sees the number of every cycle from 0, the machine behind it, and what happened.
    ///
    /// # Errors
    /// The first that `triangles` gives in place of one; the machine is left as it stands.
    #[inline(always)]
    pub fn draw<E>(
        &mut self,
        triangles: impl Iterator<Item = Result<[PortVertex; 3], E>>,
        watch: impl FnMut(u64, &Model<C>, &Cycle<C>),
    ) -> Result<(), E> {
        self.draw_seen(triangles, |_, _| (), watch)
    }

    /// Draws like [`Rig::draw`]. `see` gets the machine and the offered tokens before each cycle.
    #[inline(always)]
    pub(crate) fn draw_seen<E>(
        &mut self,
        mut triangles: impl Iterator<Item = Result<[PortVertex; 3], E>>,
        mut see: impl FnMut(&Self, Option<(&[PortVertex; 3], u32)>),
        mut watch: impl FnMut(u64, &Model<C>, &Cycle<C>),
    ) -> Result<(), E> {
        let mut next = triangles.next().transpose()?;
        let mut now = 0u64;
        loop {
            see(self, next.as_ref().map(|triangle| (triangle, 0)));
            let cycle = self.cycle(next.as_ref().map(|triangle| (triangle, 0)), true);
            watch(now, &self.model, &cycle);
            now = now.wrapping_add(1);
            if cycle.outputs.triangle {
                next = triangles.next().transpose()?;
            } else if cycle.outputs.idle && next.is_none() {
                return Ok(());
            }
        }
    }
}
