//! The memory module against the model's memory: reads and writes on all pixels, words taken at random; at the end the
//! contents. Its ports are the far ends of the machine's links to its memories.

mod common;

use common::machines::random_machine;
use edgewalk_lockstep::{Interface, Unit};
use edgewalk_machine::Plan;
use edgewalk_model::{Memory, Stalls, Write, for_channels};
use edgewalk_netlist::{InputId, SignalId, Simulator};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const MACHINES: u64 = 300;
const CYCLES: u64 = 2000;

/// The netlist with the ports of the machine's declared links, without the tag, which no memory keeps.
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
        let memory = &machine.memories[0];
        let write = &machine.links[memory.write.expect("DEPTH writes").link];
        let (read, data) = (&machine.links[memory.read], &machine.links[memory.data]);
        sim.set_input("rst", 1).expect("a reset");
        sim.tick();
        sim.set_input("rst", 0).expect("a reset");
        let input = |name: &str| sim.input(name).expect(name);
        let signal = |name: &str| sim.signal(name).expect(name);
        let stored = write.fields.iter().filter(|port| port.field.name != "tag");
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

/// Every word of both memories.
fn contents<const C: usize>(plan: &Plan, sim: &Simulator, model: &Memory<C>) -> u64 {
    let words = |name: &str| sim.memory(name).expect(name);
    let bits = plan.color.bits;
    let mut compared = 0;
    for (addr, (depth, color)) in words("depths").iter().zip(words("frame")).enumerate() {
        let values = model.pixel(addr as u32);
        assert_eq!(*depth, values[0].into(), "depth at {addr}");
        let packed = values[1..4].iter().fold(0, |word, value| (word << bits) | u128::from(*value));
        assert_eq!(*color, packed, "colour at {addr}");
        compared += 2;
    }
    for (i, channel) in plan.channels().iter().enumerate().skip(4) {
        for (addr, word) in words(&format!("frame_{}", channel.name)).iter().enumerate() {
            assert_eq!(*word, model.pixel(addr as u32)[i].into(), "{} at {addr}", channel.name);
            compared += 1;
        }
    }
    compared
}

fn random_write<const C: usize>(plan: &Plan, words: u32, rng: &mut Pcg64Mcg) -> Write<C> {
    let mut write = Write { addr: rng.random_range(0..words), z_en: rng.random(), ..Write::default() };
    for (value, channel) in write.values.iter_mut().zip(plan.channels()) {
        *value = rng.random_range(0..=channel.max()) as u32; // at most 32 bits
    }
    write
}

#[test]
fn memory_alone() {
    let mut rng = Pcg64Mcg::seed_from_u64(16);
    let (mut machines, mut compared) = (0, 0);
    for _ in 0..MACHINES {
        let plan = random_machine(&mut rng);
        compared += for_channels!(&plan, C => alone::<C>(&plan, &mut rng));
        machines += 1;
    }
    println!("{machines} of {MACHINES} machines, {CYCLES} cycles each, {compared} values compared");
    assert!(compared > 3 * CYCLES * MACHINES);
}
