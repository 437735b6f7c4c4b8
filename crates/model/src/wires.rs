//! The links between the units in one cycle: who offers what, and who takes it.
//!
//! ```text
//!  PIXEL ─given 0─> stage 0 ─given 1─> stage 1 ─> .. ─given n─> DEPTH ─pass─> BLEND
//!        <─ready 0─         <─ready 1─             <─ready n─         <─pass_ready─
//! ```
//! They are found once in a cycle. Step, cause of the cycle, view and lock-step read them here.

use crate::depth::{Block, DepthInputs};
use crate::io::Inputs;
use crate::stage::Made;
use crate::tokens::FEW;
use crate::word_memory::{Ask, MEMORIES};

/// Most stages of a pipe.
pub(crate) const STAGES: usize = 8;

/// What units offer in a cycle and hold in no register. It is kept from cycle to cycle, as room for it costs time. A machine of few
/// channels has none.
#[derive(Clone, Debug, Default)]
pub struct Offers<const C: usize>(Option<Box<Room<C>>>);

#[derive(Clone, Debug)]
struct Room<const C: usize> {
    made: Vec<Made<C>>,
    asks: [Ask; MEMORIES],
}

impl<const C: usize> Offers<C> {
    /// Room for a pipe of so many stages.
    pub(crate) fn new(stages: usize) -> Self {
        let room =
            || Box::new(Room { made: vec![Made::default(); stages], asks: [Ask::default(); MEMORIES] });
        Offers((C > FEW).then(room))
    }

    /// Fragments that stages make, by place in the pipe.
    #[inline(always)]
    pub(crate) fn made(&self) -> &[Made<C>] {
        self.0.as_ref().map_or(&[], |room| &room.made)
    }

    /// What is asked of the memories that the host alone writes, in the order of
    /// [`Plan::word_memories`](edgewalk_machine::Plan::word_memories).
    #[inline(always)]
    pub(crate) fn asks(&self) -> &[Ask] {
        self.0.as_ref().map_or(&[], |room| &room.asks)
    }

    /// [`Self::made`] and [`Self::asks`], to be filled.
    #[inline(always)]
    pub(crate) fn parts(&mut self) -> (&mut [Made<C>], &mut [Ask]) {
        self.0.as_mut().map_or((&mut [], &mut []), |room| (&mut room.made, &mut room.asks))
    }
}

/// What is on the links.
#[derive(Clone, Copy, Debug)]
pub struct Wires {
    /// By place in the pipe, and of DEPTH behind the last: a fragment is offered there.
    pub(crate) offered: [bool; STAGES + 1],
    /// By place in the pipe, and of DEPTH behind the last: the fragment offered there is taken.
    pub(crate) ready: [bool; STAGES + 1],
    /// The address that DEPTH reads.
    pub(crate) rd: Option<u32>,
    /// What keeps the fragment offered to DEPTH from being read.
    pub block: Option<Block>,
    /// BLEND takes a fragment that DEPTH offers.
    pub pass_ready: bool,
    /// The span offered by SPAN is at PIXEL's door: the walk of TERM stands there.
    pub there: bool,
    /// PIXEL takes a span that is at its door.
    pub pixel_ready: bool,
}

impl Wires {
    /// The fragment offered to the stage at this place, or behind the last stage to DEPTH, is taken.
    #[inline(always)]
    #[must_use]
    pub fn ready(&self, place: usize) -> bool {
        self.ready[place]
    }

    /// PIXEL takes the span that is offered.
    #[inline(always)]
    #[must_use]
    pub fn span_ready(&self) -> bool {
        self.there && self.pixel_ready
    }

    /// The inputs of DEPTH.
    #[inline(always)]
    #[must_use]
    pub fn depth_inputs(&self, inputs: &Inputs) -> DepthInputs {
        DepthInputs {
            depth_func: inputs.depth_func,
            depth_write: inputs.depth_write,
            rd_ready: inputs.rd_ready,
            data: inputs.data,
            wr_ready: inputs.wr_ready,
            color_write: inputs.blend.color_write,
            pass_ready: self.pass_ready,
        }
    }
}
