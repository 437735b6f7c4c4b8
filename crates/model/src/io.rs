//! The ports of the whole machine in a cycle, and what happened at them.

use crate::blend::{BlendInputs, BlendOutputs};
use crate::shadow::ShadowInputs;
use crate::tokens::{ColorWrite, FEW, Write};
use crate::word_memory::WordIn;
use edgewalk_machine::{Activity, DrawState, PortVertex};

/// Input ports of a cycle; a valid and its data are an `Option`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inputs<'a> {
    /// Synchronous reset.
    pub rst: bool,
    /// A triangle and its tag; where it comes word by word, the triangle of which a word is offered.
    pub tri: Option<(&'a [PortVertex; 3], u32)>,
    /// Compare function, constant while the machine is busy: 0 never, 1 less, 2 equal, 3 lequal, 4 greater, 5 notequal,
    /// 6 gequal, 7 always.
    pub depth_func: u8,
    /// Fragments that pass store their depth; constant while the machine is busy.
    pub depth_write: bool,
    /// The memory takes a read.
    pub rd_ready: bool,
    /// The depth of the oldest read.
    pub data: Option<u64>,
    /// The memory takes a write.
    pub wr_ready: bool,
    /// The memories that the host alone writes, in the order of [`Plan::word_memories`](edgewalk_machine::Plan::word_memories).
    pub words: &'a [WordIn],
    /// What only machines with SHADOW have.
    pub shadow: ShadowInputs,
    /// What only machines with BLEND have.
    pub blend: BlendInputs,
}

/// Output ports of the same cycle. A link fires if it is valid here and ready there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outputs<const C: usize> {
    /// A triangle is taken, if there is one, or a word of it.
    pub tri_ready: bool,
    /// Not hardware: a triangle is taken; one that comes word by word with its last word.
    pub triangle: bool,
    /// Address of a depth read.
    pub rd: Option<u32>,
    /// The depth is taken, if it is there.
    pub data_ready: bool,
    /// A write; with BLEND of a depth.
    pub wr: Option<Write<C>>,
    /// What only machines with BLEND have.
    pub blend: BlendOutputs<C>,
    /// What the cycle was spent on.
    pub activity: Activity,
    /// Nothing to do: `activity` is 0.
    pub idle: bool,
}

impl Inputs<'_> {
    /// The constants.
    pub(crate) fn state(&self) -> DrawState {
        DrawState {
            depth_func: self.depth_func,
            depth_write: self.depth_write,
            shadow_on: self.shadow.on,
            light_pass: self.shadow.light_pass,
            ambient: self.shadow.ambient.into(),
            color_write: self.blend.color_write,
            blend_add: self.blend.add,
            clear: [0; 3],
        }
    }
}

/// What happened in a cycle of the machine with its memories.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cycle<const C: usize> {
    /// The ports of the machine.
    pub outputs: Outputs<C>,
    /// The address whose read fired; [`last_read`](crate::Model::last_read) is its fragment.
    pub read: Option<u32>,
    /// The depth that the memory offered was taken.
    pub data_taken: bool,
    /// The colour that the memory offered was taken, with BLEND.
    pub color_taken: bool,
    /// The write of `outputs` fired.
    pub written: bool,
    /// The colour write of `outputs` fired.
    pub color_written: bool,
}

impl<const C: usize> Cycle<C> {
    /// The write that fired.
    #[inline(always)]
    #[must_use]
    pub fn write(&self) -> Option<&Write<C>> {
        self.outputs.wr.as_ref().filter(|_| self.written)
    }

    /// The colour write that fired, with BLEND.
    #[inline(always)]
    #[must_use]
    pub fn color_write(&self) -> Option<&ColorWrite<C>> {
        self.outputs.blend.cwr.as_ref().filter(|_| C > FEW && self.color_written)
    }
}
