//! The memory module against the model's memory: reads and writes on all pixels, words taken at random; at the end the
//! contents. Its ports are the far ends of the machine's links to its memories.

use crate::common::machines::random_machine;
use edgewalk_lockstep::{Interface, Unit};
use edgewalk_machine::Plan;
use edgewalk_model::tokens::ColorWrite;
use edgewalk_model::{ColorMemory, Memory, Stalls, Write, for_channels};
use edgewalk_netlist::{InputId, SignalId, Simulator};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const MACHINES: u64 = 300;
const CYCLES: u64 = 2000;

/// The netlist with the ports of the machine's declared links, without the tag and what is lit, which no memory keeps.
struct Module {
    sim: Simulator,
    rd_valid: InputId,
    rd_addr: InputId,
    data_ready: InputId,
    wr_valid: InputId,
    /// In the order of the link's fields: name and port.
    wr: Vec<(String, InputId)>,
    rd_ready: SignalId,
    wr_ready: SignalId,
    data_valid: SignalId,
    data: SignalId,
}

impl Module {
    fn new(plan: &Plan) -> Module {
        let netlist = edgewalk_rtl::memory(plan, plan.z.max()).expect("can be built");
        let mut sim = Simulator::new(&netlist);
        let machine = Interface::new(plan, Unit::MACHINE);
        let memory = machine.memories.iter().find(|memory| memory.name == "depth").expect("DEPTH reads");
        let write = &machine.links[memory.write.expect("DEPTH writes").link];
        let (read, data) = (&machine.links[memory.read], &machine.links[memory.data]);
        sim.set_input("rst", 1).expect("a reset");
        sim.tick();
        sim.set_input("rst", 0).expect("a reset");
        let input = |name: &str| sim.input(name).expect(name);
        let signal = |name: &str| sim.signal(name).expect(name);
        let stored = write.fields.iter().filter(|port| !["lit", "tag"].contains(&port.field.name.as_str()));
        Module {
            rd_valid: input(&format!("{}_valid", read.name)),
            rd_addr: input(&read.fields[0].name),
            data_ready: input(&format!("{}_ready", data.name)),
            wr_valid: input(&format!("{}_valid", write.name)),
            wr: stored.map(|port| (port.field.name.clone(), input(&port.name))).collect(),
            rd_ready: signal(&format!("{}_ready", read.name)),
            wr_ready: signal(&format!("{}_ready", write.name)),
            data_valid: signal(&format!("{}_valid", data.name)),
            data: signal(&data.fields[0].name),
            sim,
        }
    }
}

/// Runs the colour memory of a machine with BLEND; values compared. Its ports are other than those of the depths, and lead to
/// nothing of them.
fn colors<const C: usize>(plan: &Plan, rng: &mut Pcg64Mcg) -> u64 {
    let netlist = edgewalk_rtl::memory(plan, plan.z.max()).expect("can be built");
    let mut sim = Simulator::new(&netlist);
    sim.set_input("rst", 1).expect("a reset");
    sim.tick();
    sim.set_input("rst", 0).expect("a reset");
    let mut model = ColorMemory::<C>::new(plan, [0; 3], Stalls::NONE);
    let words = 1u32 << plan.widths().address;
    let often = rng.random_range(0.1..1.0);
    let (mut in_flight, mut compared) = (0, 0);
    let set = |sim: &mut Simulator, name: &str, value: u64| sim.set_input(name, value.into()).expect(name);
    for cycle in 0..CYCLES {
        let at = |port: &str| format!("{port} in cycle {cycle}\n{plan:?}");
        let read = rng.random_bool(0.7).then(|| rng.random_range(0..words));
        let write = rng.random_bool(0.5).then(|| {
            let mut values = [0; C];
            for (value, channel) in values.iter_mut().zip(plan.channels()) {
                *value = rng.random_range(0..=channel.max()) as u32; // at most 32 bits
            }
            let rgb = rng.random_range(0..1u64 << (3 * plan.color.bits));
            ColorWrite { addr: rng.random_range(0..words), rgb, values, ..ColorWrite::default() }
        });
        let ready = rng.random_bool(often);
        set(&mut sim, "crd_valid", read.is_some().into());
        set(&mut sim, "crd_addr", read.unwrap_or(0).into());
        set(&mut sim, "cdata_ready", ready.into());
        set(&mut sim, "cwr_valid", write.is_some().into());
        let ColorWrite { addr, rgb, values, .. } = write.unwrap_or_default();
        set(&mut sim, "cwr_addr", addr.into());
        set(&mut sim, "cwr_rgb", rgb);
        for (i, channel) in plan.own_channels() {
            set(&mut sim, &format!("cwr_{}", channel.name), values[i].into());
        }
        let mut is_high = |port: &str| sim.get(port).expect(port) == 1;
        assert!(is_high("cwr_ready"), "{}", at("cwr_ready"));
        let (takes, data) = (is_high("crd_ready"), model.cdata());
        assert_eq!(is_high("cdata_valid"), data.is_some(), "{}", at("cdata_valid"));
        if let Some(rgb) = data {
            assert_eq!(sim.get("cdata_rgb").expect("a port"), rgb.into(), "{}", at("cdata_rgb"));
            compared += 1;
        }
        // It may refuse a read only while as many are on their way as it has stages.
        assert!(takes || in_flight >= plan.blend.latency, "{}", at("crd_ready"));
        compared += 3;
        sim.tick();
        let (read, taken) = (read.filter(|_| takes), ready && data.is_some());
        in_flight = in_flight + u32::from(read.is_some()) - u32::from(taken);
        model.step(read, taken, write.as_ref());
    }
    compared + frame(plan, &sim, |addr| model.pixel(addr, 0).to_vec())
}

/// Runs one machine's memory; values compared.
fn alone<const C: usize>(plan: &Plan, rng: &mut Pcg64Mcg) -> u64 {
    let mut module = Module::new(plan);
    let mut model = Memory::<C>::new(plan, [0; 3], Stalls::NONE);
    let words = 1u32 << plan.widths().address;
    let often = rng.random_range(0.1..1.0);
    let (mut in_flight, mut compared) = (0, 0);
    for cycle in 0..CYCLES {
        let read = rng.random_bool(0.7).then(|| rng.random_range(0..words));
        let write = rng.random_bool(0.5).then(|| random_write::<C>(plan, words, rng));
        let ready = rng.random_bool(often);
        let sim = &mut module.sim;
        sim.set(module.rd_valid, read.is_some().into());
        sim.set(module.rd_addr, read.unwrap_or(0).into());
        sim.set(module.data_ready, ready.into());
        sim.set(module.wr_valid, write.is_some().into());
        for (name, port) in &module.wr {
            let Write { addr, values, z_en, .. } = write.unwrap_or_default();
            let value = match name.as_str() {
                "addr" => addr,
                "z_en" => z_en.into(),
                name => values[plan.channels().iter().position(|c| c.name == name).expect("a channel")],
            };
            sim.set(*port, value.into());
        }
        let at = |port: &str| format!("{port} in cycle {cycle}\n{plan:?}");
        assert_eq!(sim.value(module.wr_ready), 1, "{}", at("wr_ready"));
        let data = model.data();
        assert_eq!(sim.value(module.data_valid) == 1, data.is_some(), "{}", at("data_valid"));
        if let Some(z) = data {
            assert_eq!(sim.value(module.data), z.into(), "{}", at("data"));
            compared += 1;
        }
        let takes = sim.value(module.rd_ready) == 1;
        // It may refuse a read only while as many are on their way as it has stages.
        assert!(takes || in_flight >= plan.latency, "{}", at("rd_ready"));
        compared += 3;
        sim.tick();
        let (read, taken) = (read.filter(|_| takes), ready && data.is_some());
        in_flight = in_flight + u32::from(read.is_some()) - u32::from(taken);
        model.step(read, taken, write.as_ref());
    }
    compared + contents(plan, &module.sim, &model)
}

/// Every word of both memories; with BLEND of the depths, as the colours have a write of their own.
fn contents<const C: usize>(plan: &Plan, sim: &Simulator, model: &Memory<C>) -> u64 {
    let mut compared = 0;
    for (addr, depth) in sim.memory("depths").expect("depths").iter().enumerate() {
        assert_eq!(*depth, model.pixel(addr as u32)[0].into(), "depth at {addr}");
        compared += 1;
    }
    if plan.blend.is_there() {
        return compared;
    }
    compared + frame(plan, sim, |addr| model.pixel(addr).to_vec())
}

/// Every colour and every value of the user's own channels.
fn frame(plan: &Plan, sim: &Simulator, pixel: impl Fn(u32) -> Vec<u32>) -> u64 {
    let words = |name: &str| sim.memory(name).expect(name);
    let mut compared = 0;
    for (addr, color) in words("frame").iter().enumerate() {
        let rgb = &pixel(addr as u32)[1..4];
        let packed =
            rgb.iter().fold(0, |word, value| (word << plan.stored_color().bits) | u128::from(*value));
        assert_eq!(*color, packed, "colour at {addr}");
        compared += 1;
    }
    for (i, channel) in plan.own_channels() {
        for (addr, word) in words(&format!("frame_{}", channel.name)).iter().enumerate() {
            assert_eq!(*word, pixel(addr as u32)[i].into(), "{} at {addr}", channel.name);
            compared += 1;
        }
    }
    compared
}

fn random_write<const C: usize>(plan: &Plan, words: u32, rng: &mut Pcg64Mcg) -> Write<C> {
    // With BLEND every write of a depth is meant.
    let z_en = plan.blend.is_there() || rng.random();
    let mut write = Write { addr: rng.random_range(0..words), z_en, ..Write::default() };
    for (value, channel) in write.values.iter_mut().zip(plan.channels()) {
        let is_color = ["r", "g", "b"].contains(&channel.name);
        let most = if is_color { plan.stored_color().max() } else { channel.max() };
        *value = rng.random_range(0..=most) as u32; // at most 32 bits
    }
    write
}

#[test]
fn memory_alone() {
    let mut rng = Pcg64Mcg::seed_from_u64(16);
    let (mut machines, mut compared, mut blend) = (0, 0, 0);
    for _ in 0..MACHINES {
        let plan = random_machine(&mut rng);
        compared += for_channels!(&plan, C => alone::<C>(&plan, &mut rng));
        if plan.blend.is_there() {
            compared += for_channels!(&plan, C => colors::<C>(&plan, &mut rng));
            blend += 1;
        }
        machines += 1;
    }
    assert!(blend > MACHINES / 3);
    println!(
        "{machines} of {MACHINES} machines, {blend} with BLEND, {CYCLES} cycles each, {compared} values compared"
    );
    assert!(compared > 3 * CYCLES * MACHINES);
}
