//! Draws triangles with the machine's netlist in the interpreter, the model's memory behind its ports.
//!
//! The memory is no part of the machine: model and netlist see the same one, so their pictures and cycles compare.

use crate::design;
use crate::device::{NetlistDevice, PortError};
use crate::ports::{Token, Unit, interface, pack_triangle};
use crate::suites::Triangle;
use edgewalk_machine::Plan;
use edgewalk_model::tokens::{Rgb, Source};
use edgewalk_model::{Activity, Counters, Coverage, DrawState, Frame, Memory, Stalls, Write};
use edgewalk_netlist::{BuildErrors, Simulator};

/// Why a netlist cannot draw.
#[derive(Debug, thiserror::Error)]
pub enum DriveError {
    /// It cannot be built.
    #[error("the netlist cannot be built: {0}")]
    Build(#[from] BuildErrors),
    /// It does not have the ports of a machine.
    #[error(transparent)]
    Ports(#[from] PortError),
}

/// Draws the triangles in order, as [`edgewalk_model::render`] does; the machine must have passed [`edgewalk_machine::Machine::plan`].
///
/// Runs with tags of 32 bits, which change nothing but the tag ports: they name the triangle of each write. What is not
/// to be seen at the ports is 0 in the frame: lines and spans among the counters, and all corners.
///
/// # Errors
/// None for a machine that the check accepts.
pub fn render_rtl(
    machine: &Plan,
    triangles: impl IntoIterator<Item = Triangle>,
    state: DrawState,
    stalls: Stalls,
) -> Result<Frame, DriveError> {
    render_rtl_with(machine, triangles, state, stalls, |_| true)
}

/// As [`render_rtl`]; `watch` sees the netlist in every cycle, before the clock edge, and ends the run by returning
/// false.
///
/// # Errors
/// None for a machine that the check accepts.
pub fn render_rtl_with(
    machine: &Plan,
    triangles: impl IntoIterator<Item = Triangle>,
    state: DrawState,
    stalls: Stalls,
    mut watch: impl FnMut(&mut Simulator) -> bool,
) -> Result<Frame, DriveError> {
    let tagged = machine.tagged();
    let netlist = design::netlist(&tagged, Unit::Machine)?;
    let mut device = NetlistDevice::new(&netlist, &interface(&tagged, Unit::Machine))?;
    let mut memory = Memory::new(machine, state.clear, stalls);
    let mut picture = Picture::new(machine);
    let mut numbered = (0..).zip(triangles).map(|(k, triangle)| pack_triangle(&tagged, &triangle, k));
    let mut next = numbered.next();
    let mut outputs = Vec::new();
    loop {
        let data = memory.data();
        device.settle(&inputs(&tagged, next.as_ref(), state, &memory), &mut outputs);
        let out = Outputs::of(&outputs);
        let read = out.read.filter(|_| memory.rd_ready());
        let write = out.write.filter(|_| memory.wr_ready());
        picture.count(&out, read, write.as_ref(), next.is_some());
        memory.step(read, data.is_some() && out.data_ready, write.as_ref());
        if !watch(device.simulator()) || (next.is_none() && out.activity == Activity::Idle) {
            return Ok(picture.frame(machine, &memory));
        }
        device.clock();
        if out.tri_ready && next.is_some() {
            next = numbered.next();
        }
    }
}

/// In the order of the interface: tri, data, rd_ready, wr_ready, depth_func, depth_write.
fn inputs(tagged: &Plan, triangle: Option<&Token>, state: DrawState, memory: &Memory) -> Token {
    let mut inputs = vec![u128::from(triangle.is_some())];
    match triangle {
        Some(token) => inputs.extend(token),
        None => inputs.extend(pack_triangle(tagged, &Triangle::default(), 0)),
    }
    let data = memory.data();
    inputs.extend([u128::from(data.is_some()), u128::from(data.unwrap_or(0))]);
    inputs.extend([memory.rd_ready(), memory.wr_ready()].map(u128::from));
    inputs.extend([u128::from(state.depth_func), u128::from(state.depth_write)]);
    inputs
}

/// The outputs of a cycle.
struct Outputs {
    tri_ready: bool,
    data_ready: bool,
    read: Option<u32>,
    write: Option<Write>,
    activity: Activity,
}

impl Outputs {
    /// In the order of the interface: tri_ready, data_ready, rd, wr, activity, idle.
    fn of(outputs: &[u128]) -> Outputs {
        let at = |place: usize| outputs[place] as u64; // no port here is wider
        let bit = |place: usize| outputs[place] == 1;
        Outputs {
            tri_ready: bit(0),
            data_ready: bit(1),
            read: bit(2).then(|| at(3) as u32),
            write: bit(4).then(|| Write {
                addr: at(5) as u32,
                z: at(6) as u32,
                z_en: bit(7),
                rgb: Rgb::new([8, 9, 10].map(|place| at(place) as u16)),
                source: Source { tag: at(11) as u32, id: at(11) as u32 },
            }),
            activity: Activity::ALL.get(at(12) as usize).copied().unwrap_or_default(),
        }
    }
}

/// What the ports tell of every address, and of the run.
struct Picture {
    coverage: Vec<u32>,
    writes: Vec<u32>,
    id: Vec<i32>,
    counters: Counters,
}

impl Picture {
    fn new(machine: &Plan) -> Picture {
        let words = 1 << machine.widths().address;
        Picture {
            coverage: vec![0; words],
            writes: vec![0; words],
            id: vec![-1; words],
            counters: Counters::default(),
        }
    }

    fn count(&mut self, out: &Outputs, read: Option<u32>, write: Option<&Write>, offered: bool) {
        self.counters.cycles += 1;
        self.counters.activity[out.activity as usize] += 1;
        self.counters.triangles += u64::from(out.tri_ready && offered);
        if let Some(address) = read {
            self.coverage[address as usize] += 1;
            self.counters.fragments += 1;
        }
        if let Some(write) = write {
            self.writes[write.addr as usize] += 1;
            self.id[write.addr as usize] = write.source.id as i32;
            self.counters.writes += 1;
        }
    }

    fn frame(self, machine: &Plan, memory: &Memory) -> Frame {
        let x_bits = machine.widths().x;
        let pixels = || (0..machine.height).flat_map(|y| (0..machine.width).map(move |x| y << x_bits | x));
        Frame {
            z: pixels().map(|a| u64::from(memory.pixel(a).z)).collect(),
            rgb: pixels().map(|a| memory.pixel(a).rgb.channels().map(u64::from)).collect(),
            coverage: pixels().map(|a| self.coverage[a as usize]).collect(),
            writes: pixels().map(|a| self.writes[a as usize]).collect(),
            id: pixels().map(|a| self.id[a as usize]).collect(),
            counters: self.counters,
            corners: Coverage::default(),
        }
    }
}
