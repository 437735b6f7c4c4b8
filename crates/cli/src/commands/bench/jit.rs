//! The netlist as native code, with a memory as in Verilator's harness. Compiling is part of the first frame.

use super::job::{Job, Times, Work};
use super::stopwatch::Stopwatch;
use anyhow::{Result, anyhow};
use edgewalk_jit::{InputId, OutputId, Simulator};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_netlist::SimError;
use std::collections::VecDeque;

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    let start = Stopwatch::start();
    let mut native = Native::new(job.machine)?;
    let mut memory = Memory::default();
    job.time(&start, || Ok(native.frame(job, &mut memory)))
}

/// Depths and colours by address. It has its room from the first frame on, as that of the harness.
#[derive(Default)]
struct Memory {
    z: Vec<u32>,
    rgb: Vec<u64>,
    /// Depths read, with the cycle from which on they are offered.
    reads: VecDeque<(u64, u32)>,
}

impl Memory {
    fn clear(&mut self, job: &Job) {
        let words = 1 << job.machine.widths().address;
        self.z.clear();
        self.z.resize(words, job.machine.z.max() as u32); // b <= 32 bits
        self.rgb.clear();
        self.rgb.resize(words, packed(job.state.clear));
    }

    /// The depth that is offered.
    fn data(&self, cycle: u64) -> Option<u32> {
        self.reads.front().filter(|(due, _)| *due <= cycle).map(|(_, z)| *z)
    }
}

/// Red, green and blue of at most 16 bits in a word.
fn packed([r, g, b]: [u64; 3]) -> u64 {
    r << 32 | g << 16 | b
}

/// The machine with its ports.
struct Native {
    simulator: Simulator,
    rst: InputId,
    tri_valid: InputId,
    /// x, y and the channels of each vertex.
    vertices: [Vec<InputId>; 3],
    data_valid: InputId,
    data_z: InputId,
    depth_func: InputId,
    depth_write: InputId,
    tri_ready: OutputId,
    data_ready: OutputId,
    idle: OutputId,
    rd_valid: OutputId,
    rd_addr: OutputId,
    wr_valid: OutputId,
    wr_addr: OutputId,
    wr_z: OutputId,
    wr_z_en: OutputId,
    wr_rgb: [OutputId; 3],
}

impl Native {
    fn new(machine: &Plan) -> Result<Native> {
        let netlist =
            edgewalk_rtl::machine(machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
        let mut simulator = Simulator::new(&netlist)?;
        // A memory without stalls.
        simulator.set_input("rd_ready", 1)?;
        simulator.set_input("wr_ready", 1)?;
        let input = |name: &str| simulator.input(name);
        let output = |name: &str| simulator.output(name);
        let vertex = |place: &str| -> Result<Vec<InputId>, SimError> {
            let channels = machine.channels().iter().map(|channel| channel.at_vertex(place));
            let names = [format!("x{place}"), format!("y{place}")].into_iter().chain(channels);
            names.map(|name| input(&format!("tri_{name}"))).collect()
        };
        Ok(Native {
            rst: input("rst")?,
            tri_valid: input("tri_valid")?,
            vertices: [vertex("0")?, vertex("1")?, vertex("2")?],
            data_valid: input("data_valid")?,
            data_z: input("data_z")?,
            depth_func: input("depth_func")?,
            depth_write: input("depth_write")?,
            tri_ready: output("tri_ready")?,
            data_ready: output("data_ready")?,
            idle: output("idle")?,
            rd_valid: output("rd_valid")?,
            rd_addr: output("rd_addr")?,
            wr_valid: output("wr_valid")?,
            wr_addr: output("wr_addr")?,
            wr_z: output("wr_z")?,
            wr_z_en: output("wr_z_en")?,
            wr_rgb: [output("wr_r")?, output("wr_g")?, output("wr_b")?],
            simulator,
        })
    }

    /// Clear and draw all, no more than Verilator's harness does.
    fn frame(&mut self, job: &Job, memory: &mut Memory) -> Work {
        memory.clear(job);
        let latency = u64::from(job.machine.latency);
        let mut work = Work { cycles: 0, writes: 0 };
        let mut triangles = job.triangles.iter();
        self.reset();
        self.simulator.set(self.depth_func, job.state.depth_func.into());
        self.simulator.set(self.depth_write, job.state.depth_write.into());
        let mut next = triangles.next();
        self.offer(next);
        loop {
            let data = memory.data(work.cycles);
            self.simulator.set(self.data_valid, data.is_some().into());
            self.simulator.set(self.data_z, data.unwrap_or(0).into());
            self.simulator.tick();
            if data.is_some() && self.is_high(self.data_ready) {
                memory.reads.pop_front();
            }
            if self.is_high(self.rd_valid) {
                memory.reads.push_back((work.cycles + latency, memory.z[self.word(self.rd_addr) as usize]));
            }
            if self.is_high(self.wr_valid) {
                let address = self.word(self.wr_addr) as usize;
                if self.is_high(self.wr_z_en) {
                    memory.z[address] = self.word(self.wr_z) as u32;
                }
                memory.rgb[address] = packed(self.wr_rgb.map(|port| self.word(port)));
                work.writes += 1;
            }
            work.cycles += 1;
            if next.is_some() && self.is_high(self.tri_ready) {
                next = triangles.next();
                self.offer(next);
            } else if next.is_none() && self.is_high(self.idle) {
                return work;
            }
        }
    }

    fn reset(&mut self) {
        self.simulator.set(self.tri_valid, 0);
        self.simulator.set(self.data_valid, 0);
        self.simulator.set(self.rst, 1);
        self.simulator.tick();
        self.simulator.set(self.rst, 0);
    }

    fn offer(&mut self, triangle: Option<&[PortVertex; 3]>) {
        self.simulator.set(self.tri_valid, triangle.is_some().into());
        for (ports, vertex) in self.vertices.iter().zip(triangle.into_iter().flatten()) {
            let place = [vertex.x(), vertex.y()].map(i64::from);
            // The port takes the low bits.
            for (port, value) in ports.iter().zip(place.iter().chain(vertex.values())) {
                self.simulator.set(*port, i128::from(*value) as u128);
            }
        }
    }

    /// What an output was before the clock; no port here has more bits.
    fn word(&self, output: OutputId) -> u64 {
        self.simulator.sampled(output) as u64
    }

    fn is_high(&self, output: OutputId) -> bool {
        self.word(output) == 1
    }
}
