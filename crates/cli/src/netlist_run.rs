//! The machine's netlist in the interpreter, with the model's memory behind its ports.
//!
//! The memory is no part of the machine; model and netlist see the same one, so their pictures and cycles compare.

use anyhow::{Result, anyhow};
use edgewalk_model::tokens::{Rgb, Source};
use edgewalk_model::{Activity, DrawState, Memory, Stalls, Write};
use edgewalk_netlist::{InputId, SignalId, Simulator};
use edgewalk_numerics::{Machine, PortVertex};

/// What a run of the netlist leaves behind; lists run over the screen, row 0 on top.
pub struct NetlistFrame {
    /// Stored depth.
    pub z: Vec<u64>,
    /// Stored colour.
    pub rgb: Vec<[u64; 3]>,
    /// Depth reads of every pixel: one a fragment.
    pub coverage: Vec<u32>,
    /// Writes of every pixel.
    pub writes: Vec<u32>,
    /// Triangle that wrote last, from the tag; -1 none.
    pub id: Vec<i32>,
    /// Cycles.
    pub cycles: u64,
    /// Cycles by the `activity` port.
    pub activity: [u64; Activity::ALL.len()],
}

/// Ports by name, found once.
struct Ports {
    rst: InputId,
    tri_valid: InputId,
    tri: Vec<InputId>,
    rd_ready: InputId,
    data_valid: InputId,
    data_z: InputId,
    wr_ready: InputId,
    tri_ready: SignalId,
    rd_valid: SignalId,
    rd_addr: SignalId,
    data_ready: SignalId,
    wr_valid: SignalId,
    /// addr, z, z_en, r, g, b, tag.
    wr: [SignalId; 7],
    activity: SignalId,
}

impl Ports {
    fn new(sim: &Simulator) -> Result<Ports> {
        let input = |name: &str| sim.input(name).map_err(|e| anyhow!("{e}"));
        let signal = |name: &str| sim.signal(name).map_err(|e| anyhow!("{e}"));
        let fields = ["x", "y", "z", "r", "g", "b"];
        let corner = |k: usize| fields.map(|f| format!("tri_{f}{k}"));
        let tri = (0..3).flat_map(corner).chain(["tri_tag".to_owned()]).map(|name| input(&name));
        let wr = |f: &str| signal(&format!("wr_{f}"));
        Ok(Ports {
            rst: input("rst")?,
            tri_valid: input("tri_valid")?,
            tri: tri.collect::<Result<_>>()?,
            rd_ready: input("rd_ready")?,
            data_valid: input("data_valid")?,
            data_z: input("data_z")?,
            wr_ready: input("wr_ready")?,
            tri_ready: signal("tri_ready")?,
            rd_valid: signal("rd_valid")?,
            rd_addr: signal("rd_addr")?,
            data_ready: signal("data_ready")?,
            wr_valid: signal("wr_valid")?,
            wr: [wr("addr")?, wr("z")?, wr("z_en")?, wr("r")?, wr("g")?, wr("b")?, wr("tag")?],
            activity: signal("activity")?,
        })
    }
}

/// Draws the triangles; `watch` sees the simulator in every cycle, before the clock edge, and may end the run by returning false.
///
/// Runs with tags of 32 bits, which change nothing but the width of the tag ports: they name the triangle of each write.
pub fn draw(
    machine: &Machine,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    stalls: Stalls,
    mut watch: impl FnMut(&mut Simulator) -> Result<bool>,
) -> Result<NetlistFrame> {
    let tagged = Machine { tag_bits: 32, ..machine.clone() };
    let netlist = edgewalk_rtl::machine(&tagged).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let mut sim = Simulator::new(&netlist);
    let ports = Ports::new(&sim)?;
    let mut memory = Memory::new(machine, state.clear, stalls);
    let words = 1usize << machine.widths().address;
    let (mut coverage, mut writes, mut id) = (vec![0u32; words], vec![0u32; words], vec![-1i32; words]);
    let (mut cycles, mut activity) = (0, [0; Activity::ALL.len()]);

    sim.set_input("depth_func", u128::from(state.depth_func)).map_err(|e| anyhow!("{e}"))?;
    sim.set_input("depth_write", u128::from(state.depth_write)).map_err(|e| anyhow!("{e}"))?;
    sim.set(ports.rst, 1);
    sim.tick();
    sim.set(ports.rst, 0);
    let mut triangles = triangles.into_iter();
    let mut next = triangles.next();
    let mut number = 0u128;
    loop {
        sim.set(ports.tri_valid, u128::from(next.is_some()));
        if let Some(triangle) = &next {
            let corner = |v: &PortVertex| {
                let [z, r, g, b] = v.value.map(u128::from);
                [v.x as u128, v.y as u128, z, r, g, b]
            };
            let values = triangle.iter().flat_map(corner).chain([number]);
            ports.tri.iter().zip(values).for_each(|(port, value)| sim.set(*port, value));
        }
        let data = memory.data();
        sim.set(ports.rd_ready, u128::from(memory.rd_ready()));
        sim.set(ports.wr_ready, u128::from(memory.wr_ready()));
        sim.set(ports.data_valid, u128::from(data.is_some()));
        sim.set(ports.data_z, u128::from(data.unwrap_or(0)));
        sim.eval();
        let spent = sim.value(ports.activity) as usize;
        cycles += 1;
        activity[spent] += 1;
        let read =
            (sim.value(ports.rd_valid) == 1 && memory.rd_ready()).then(|| sim.value(ports.rd_addr) as u32);
        let write = (sim.value(ports.wr_valid) == 1 && memory.wr_ready()).then(|| {
            let [addr, z, z_en, r, g, b, tag] = ports.wr.map(|port| sim.value(port) as u32);
            let rgb = Rgb::new([r, g, b].map(|c| c as u16)); // b <= 16 bits
            Write { addr, z, z_en: z_en == 1, rgb, source: Source { tag, id: tag } }
        });
        let data_taken = data.is_some() && sim.value(ports.data_ready) == 1;
        let taken = next.is_some() && sim.value(ports.tri_ready) == 1;
        let done = next.is_none() && spent == Activity::Idle as usize;
        if let Some(addr) = read {
            coverage[addr as usize] += 1;
        }
        if let Some(write) = &write {
            writes[write.addr as usize] += 1;
            id[write.addr as usize] = write.source.tag as i32;
        }
        memory.step(read, data_taken, write.as_ref());
        if !watch(&mut sim)? || done {
            break;
        }
        sim.tick();
        if taken {
            next = triangles.next();
            number += 1;
        }
    }
    let x_bits = machine.widths().x;
    let pixels: Vec<u32> =
        (0..machine.height).flat_map(|y| (0..machine.width).map(move |x| y << x_bits | x)).collect();
    let pick = |list: &[u32]| pixels.iter().map(|a| list[*a as usize]).collect();
    Ok(NetlistFrame {
        z: pixels.iter().map(|a| u64::from(memory.pixel(*a).z)).collect(),
        rgb: pixels.iter().map(|a| memory.pixel(*a).rgb.channels().map(u64::from)).collect(),
        coverage: pick(&coverage),
        writes: pick(&writes),
        id: pixels.iter().map(|a| id[*a as usize]).collect(),
        cycles,
        activity,
    })
}
