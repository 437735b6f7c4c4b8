//! Draws triangles: the machine, its memory, and a picture at the end.

use crate::counters::Counters;
use crate::coverage::Coverage;
use crate::machine::{Inputs, Model};
use crate::memory::{Memory, Stalls};
use crate::tokens::{Fragment, Write};
use edgewalk_machine::{Plan, PortVertex};

/// What stays the same over a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawState {
    /// Compare function, bits 0, 1, 2: less, equal, greater pass; 7 always.
    pub depth_func: u8,
    /// Fragments that pass store their depth.
    pub depth_write: bool,
    /// Colour of the empty screen, b bits each.
    pub clear: [u64; 3],
}

impl Default for DrawState {
    /// The nearest fragment wins, on black.
    fn default() -> Self {
        DrawState { depth_func: 1, depth_write: true, clear: [0; 3] }
    }
}

/// A picture, row by row from the top, W×H pixels, and what it took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Stored depth, b bits.
    pub z: Vec<u64>,
    /// Stored colour, b bits each.
    pub rgb: Vec<[u64; 3]>,
    /// Fragments of every pixel, whatever the depth test says.
    pub coverage: Vec<u32>,
    /// Writes to every pixel.
    pub writes: Vec<u32>,
    /// Number of the triangle that wrote the pixel last, -1: none.
    pub id: Vec<i32>,
    /// Performance counters.
    pub counters: Counters,
    /// Hazards and corners met.
    pub corners: Coverage,
}

/// What [`render_with`] reports, in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event<'a> {
    /// A fragment's depth read fired.
    Fragment(&'a Fragment),
    /// A write fired.
    Write(&'a Write),
}

/// Draws the triangles in order; the machine must have passed [`edgewalk_machine::Machine::plan`].
pub fn render(
    machine: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    stalls: Stalls,
) -> Frame {
    render_with(machine, triangles, state, stalls, |_| {})
}

/// As [`render`], and calls `hook` for every fragment and write.
pub fn render_with(
    machine: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    stalls: Stalls,
    mut hook: impl FnMut(Event),
) -> Frame {
    let mut model = Model::new(machine);
    let mut memory = Memory::new(machine, state.clear, stalls);
    let mut tally = Tally::new(machine);
    let mut triangles = triangles.into_iter();
    let mut next = triangles.next();
    loop {
        let inputs = Inputs {
            rst: false,
            tri: next.as_ref().map(|t| (t, 0)),
            depth_func: state.depth_func,
            depth_write: state.depth_write,
            rd_ready: memory.rd_ready(),
            data: memory.data(),
            wr_ready: memory.wr_ready(),
        };
        let outputs = model.cycle(&inputs);
        let data_taken = inputs.data.is_some() && outputs.data_ready;
        let read = outputs.rd.filter(|_| inputs.rd_ready);
        let write = outputs.wr.as_ref().filter(|_| inputs.wr_ready);
        if let Some(addr) = read {
            tally.read(addr);
            hook(Event::Fragment(&model.last_read()));
        }
        if let Some(write) = write {
            tally.write(write);
            hook(Event::Write(write));
        }
        memory.step(read, data_taken, write);
        if outputs.tri_ready && next.is_some() {
            next = triangles.next();
        } else if outputs.idle && next.is_none() {
            break;
        }
    }
    let x_bits = machine.widths().x;
    let addresses: Vec<usize> = (0..machine.height)
        .flat_map(|y| (0..machine.width).map(move |x| (y << x_bits | x) as usize))
        .collect();
    let stored = || addresses.iter().map(|addr| memory.pixel(*addr as u32));
    Frame {
        z: stored().map(|p| u64::from(p.z)).collect(),
        rgb: stored().map(|p| p.rgb.channels().map(u64::from)).collect(),
        coverage: addresses.iter().map(|addr| tally.reads[*addr]).collect(),
        writes: addresses.iter().map(|addr| tally.writes[*addr]).collect(),
        id: addresses.iter().map(|addr| tally.id[*addr]).collect(),
        counters: model.counters().clone(),
        corners: model.coverage().clone(),
    }
}

/// What happened at every address.
struct Tally {
    reads: Vec<u32>,
    writes: Vec<u32>,
    /// Number of the triangle that wrote it last, -1: none.
    id: Vec<i32>,
}

impl Tally {
    fn new(machine: &Plan) -> Self {
        let words = 1 << machine.widths().address;
        Tally { reads: vec![0; words], writes: vec![0; words], id: vec![-1; words] }
    }

    fn read(&mut self, addr: u32) {
        let reads = &mut self.reads[addr as usize];
        *reads = reads.wrapping_add(1);
    }

    fn write(&mut self, write: &Write) {
        let writes = &mut self.writes[write.addr as usize];
        *writes = writes.wrapping_add(1);
        self.id[write.addr as usize] = write.source.id as i32;
    }
}
