//! The machine's netlist against the model: every port of every unit, every cycle.

use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::{Coverage, Inputs, Memory, Model, Outputs, Stalls, Write};
use edgewalk_netlist::InputId;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::chain::{Between, Chain};
use super::probe::{Channel, Failure, InputChannel, Port, Probe};
use super::tokens;

/// What a run does besides drawing its triangles.
#[derive(Clone, Copy, Debug)]
pub struct Stimulus {
    /// Compare function, 0 to 7.
    pub depth_func: u8,
    /// Passing fragments write their depth.
    pub depth_write: bool,
    /// How often the memory makes the machine wait.
    pub stalls: Stalls,
    /// In so many of 256 cycles no triangle is offered.
    pub gaps: u8,
    /// In the cycle before this one the machine is reset, in the midst of its work.
    pub reset_at: Option<u64>,
    /// Seed of the gaps.
    pub seed: u64,
}

/// What a run has compared.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// Clocks.
    pub cycles: u64,
    /// Triangles taken in.
    pub triangles: u64,
    /// Values of ports.
    pub ports: u64,
    /// Pixels written.
    pub writes: u64,
    /// Hazards and corners met.
    pub coverage: Coverage,
}

impl Checked {
    /// Adds another run.
    pub fn merge(&mut self, other: &Checked) {
        self.cycles += other.cycles;
        self.triangles += other.triangles;
        self.ports += other.ports;
        self.writes += other.writes;
        self.coverage.merge(&other.coverage);
    }
}

/// Draws the triangles on the netlist and on the model side by side until both are idle.
///
/// # Errors
/// The first port that differs, in the order of the data.
pub fn lockstep(
    machine: &Plan,
    triangles: &[[PortVertex; 3]],
    stimulus: &Stimulus,
) -> Result<Checked, Failure> {
    let mut bench = Bench::new(machine, Probe::new(edgewalk_rtl::machine(machine))?)?;
    let mut rng = Pcg64Mcg::seed_from_u64(stimulus.seed);
    let (mut model, mut chain) = (Model::new(machine), Chain::new(machine));
    let mut memory = Memory::new(machine, [0; 3], stimulus.stalls);
    let (mut next, mut offered, mut writes) = (0, false, 0);
    let longest = 100_000 + 100_000 * triangles.len() as u64;
    loop {
        let cycle = bench.probe.cycle;
        if cycle > longest {
            return Err(Failure::Busy(cycle));
        }
        // Once offered, a triangle stays until it is taken.
        offered = next < triangles.len() && (offered || rng.random::<u8>() >= stimulus.gaps);
        let inputs = Inputs {
            rst: cycle == 0 || stimulus.reset_at == Some(cycle),
            tri: offered.then(|| (&triangles[next], next as u32 & tag_mask(machine))),
            depth_func: stimulus.depth_func,
            depth_write: stimulus.depth_write,
            rd_ready: memory.rd_ready(),
            data: memory.data(),
            wr_ready: memory.wr_ready(),
        };
        let outputs = model.cycle(&inputs);
        let between = chain.cycle(&inputs);
        bench.set(machine, &inputs);
        // Before the first reset the registers hold nothing.
        if cycle > 0 {
            bench.check(machine, &outputs, &between)?;
        }
        bench.probe.tick();

        let read = outputs.rd.filter(|_| inputs.rd_ready);
        let write = outputs.wr.filter(|_| inputs.wr_ready);
        memory.step(read, outputs.data_ready && inputs.data.is_some(), write.as_ref());
        if inputs.rst {
            memory = Memory::new(machine, [0; 3], stimulus.stalls);
            continue;
        }
        writes += u64::from(write.is_some());
        if offered && outputs.tri_ready {
            (next, offered) = (next + 1, false);
            bench.probe.triangle += 1;
        }
        if next == triangles.len() && outputs.idle {
            let Probe { cycle: cycles, triangle: triangles, compared: ports, .. } = bench.probe;
            return Ok(Checked { cycles, triangles, ports, writes, coverage: model.coverage().clone() });
        }
    }
}

fn tag_mask(machine: &Plan) -> u32 {
    u32::MAX.checked_shr(32 - machine.tag_bits).unwrap_or(0)
}

/// The netlist's ports.
struct Bench {
    probe: Probe,
    rst: InputId,
    tri_valid: InputId,
    tri: InputChannel,
    depth_func: InputId,
    depth_write: InputId,
    rd_ready: InputId,
    data_valid: InputId,
    data_z: InputId,
    wr_ready: InputId,
    readies: Readies,
    valids: Valids,
    prim: Channel,
    line: Channel,
    increments: Channel,
    span: Channel,
    fragment: Channel,
    rd_addr: Port,
    wr: Channel,
    activity: Port,
    idle: Port,
}

struct Readies {
    tri: Port,
    prim: Port,
    line: Port,
    fresh_queued: Port,
    span: Port,
    fragment: Port,
    data: Port,
}

struct Valids {
    prim: Port,
    line: Port,
    span: Port,
    fragment: Port,
    rd: Port,
    wr: Port,
}

impl Bench {
    fn new(machine: &Plan, probe: Probe) -> Result<Bench, Failure> {
        let inner = |unit, name: &str| probe.port(unit, name, &format!("u_{unit}_{name}"));
        let top = |unit, name: &str| probe.port(unit, name, name);
        let vertices = tokens::triangle(machine, &[PortVertex::default(); 3], 0);
        Ok(Bench {
            rst: probe.input("rst")?,
            tri_valid: probe.input("tri_valid")?,
            tri: probe.input_channel("tri", &vertices)?,
            depth_func: probe.input("depth_func")?,
            depth_write: probe.input("depth_write")?,
            rd_ready: probe.input("rd_ready")?,
            data_valid: probe.input("data_valid")?,
            data_z: probe.input("data_z")?,
            wr_ready: probe.input("wr_ready")?,
            readies: Readies {
                tri: top("setup", "tri_ready")?,
                prim: inner("edge", "prim_ready")?,
                line: inner("span", "line_ready")?,
                fresh_queued: inner("span", "fresh_queued")?,
                span: inner("pixel", "span_ready")?,
                fragment: inner("depth", "frag_ready")?,
                data: top("depth", "data_ready")?,
            },
            valids: Valids {
                prim: inner("setup", "prim_valid")?,
                line: inner("edge", "line_valid")?,
                span: inner("span", "span_valid")?,
                fragment: inner("pixel", "frag_valid")?,
                rd: top("depth", "rd_valid")?,
                wr: top("depth", "wr_valid")?,
            },
            prim: probe.channel("setup", "u_setup_", "prim", &tokens::prim(machine, &Default::default()))?,
            line: probe.channel("edge", "u_edge_", "line", &tokens::line(machine, &Default::default()))?,
            increments: probe.channel("edge", "u_edge_", "inc", &tokens::increments(&Default::default()))?,
            span: probe.channel("span", "u_span_", "span", &tokens::span(machine, &Default::default()))?,
            fragment: probe.channel(
                "pixel",
                "u_pixel_",
                "frag",
                &tokens::fragment(machine, &Default::default()),
            )?,
            rd_addr: top("depth", "rd_addr")?,
            wr: probe.channel("depth", "", "wr", &tokens::write(machine, &Write::default()))?,
            activity: top("machine", "activity")?,
            idle: top("machine", "idle")?,
            probe,
        })
    }

    fn set(&mut self, machine: &Plan, inputs: &Inputs) {
        let probe = &mut self.probe;
        probe.set(self.rst, inputs.rst);
        probe.set(self.tri_valid, inputs.tri.is_some());
        if let Some((vertices, tag)) = inputs.tri {
            probe.set_channel(&self.tri, &tokens::triangle(machine, vertices, tag));
        }
        probe.set(self.depth_func, inputs.depth_func);
        probe.set(self.depth_write, inputs.depth_write);
        probe.set(self.rd_ready, inputs.rd_ready);
        probe.set(self.data_valid, inputs.data.is_some());
        probe.set(self.data_z, inputs.data.unwrap_or(0));
        probe.set(self.wr_ready, inputs.wr_ready);
    }

    /// All units in the order of the data; data only where it is valid, a ready that depends on it likewise.
    fn check(&mut self, machine: &Plan, outputs: &Outputs, between: &Between) -> Result<(), Failure> {
        let Bench { probe, readies, valids, .. } = self;
        probe.check(&readies.tri, outputs.tri_ready)?;
        probe.check(&valids.prim, between.prim.is_some())?;
        if let Some(prim) = &between.prim {
            probe.check_channel(&self.prim, &tokens::prim(machine, prim))?;
        }
        probe.check(&readies.prim, between.prim_ready)?;
        probe.check(&valids.line, between.line.is_some())?;
        if let Some(line) = &between.line {
            probe.check_channel(&self.line, &tokens::line(machine, line))?;
            probe.check(&readies.line, between.line_ready)?;
            probe.check_channel(&self.increments, &tokens::increments(&between.increments))?;
        }
        probe.check(&readies.fresh_queued, between.fresh_queued)?;
        probe.check(&valids.span, between.span.is_some())?;
        if let Some(span) = &between.span {
            probe.check_channel(&self.span, &tokens::span(machine, span))?;
        }
        probe.check(&valids.fragment, between.fragment.is_some())?;
        if let Some(fragment) = &between.fragment {
            probe.check_channel(&self.fragment, &tokens::fragment(machine, fragment))?;
            probe.check(&readies.fragment, between.fragment_ready)?;
        }
        probe.check(&readies.span, between.span_ready)?;
        probe.check(&valids.rd, outputs.rd.is_some())?;
        if let Some(address) = outputs.rd {
            probe.check(&self.rd_addr, address)?;
        }
        probe.check(&readies.data, outputs.data_ready)?;
        probe.check(&valids.wr, outputs.wr.is_some())?;
        if let Some(write) = &outputs.wr {
            probe.check_channel(&self.wr, &tokens::write(machine, write))?;
        }
        probe.check(&self.activity, outputs.activity as u8)?;
        probe.check(&self.idle, outputs.idle)
    }
}
