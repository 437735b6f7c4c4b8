//! What a recording says of a register is what the netlist's register of that name holds, in every cycle in which it means
//! something: model and netlist in lock-step inside, not only at their ports.

use edgewalk_lockstep::case::constants;
use edgewalk_lockstep::{
    Interface, NetlistDevice, Rig, Setting, StallKind, Triangles, Unit, netlist, patterns,
};
use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::view::Shape;
use edgewalk_model::{BlendInputs, DrawState, Inputs, Model, View, for_channels};
use edgewalk_netlist::SignalId;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::BTreeMap;

/// A signal beside the register, or the field of the token in it, that it must be equal to.
struct Pair {
    register: usize,
    field: Option<usize>,
    signal: SignalId,
    path: String,
    compared: u64,
    /// The first difference: cycle, model, netlist.
    differs: Option<(u64, u64, u128)>,
}

fn pairs(view: &View, device: &mut NetlistDevice) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (id, register) in view.structure().registers.iter().enumerate() {
        let Some(wire) = &register.wire else { continue };
        let paths = match register.shape {
            Shape::Token(table) => {
                let fields = view.tokens().kinds()[table].fields.iter().enumerate();
                fields.map(|(place, field)| (Some(place), format!("{wire}_{}", field.name))).collect()
            }
            _ => vec![(None, wire.clone())],
        };
        for (field, path) in paths {
            let signal =
                device.simulator().signal(&path).unwrap_or_else(|_| panic!("the netlist has no {path}"));
            pairs.push(Pair { register: id, field, signal, path, compared: 0, differs: None });
        }
    }
    pairs
}

/// Draws with model and netlist under one rig; gives by path the values compared.
fn compare(plan: &Plan, triangles: &[[PortVertex; 3]], stalls: StallKind) -> Vec<(String, u64)> {
    for_channels!(plan, C => run::<C>(plan, triangles, stalls))
}

fn run<const C: usize>(plan: &Plan, triangles: &[[PortVertex; 3]], stalls: StallKind) -> Vec<(String, u64)> {
    let interface = Interface::new(plan, Unit::MACHINE);
    let built = netlist(plan, Unit::MACHINE).expect("it can be built");
    let mut device = NetlistDevice::new(&built, &interface).expect("its ports are declared");
    let state = DrawState::default();
    let port = Triangles::new(plan);
    let tokens = triangles.iter().zip(0..).map(|(triangle, k)| port.pack(triangle, k)).collect();
    let setting = Setting::willing(&interface, &constants(&state)).expect("all constants");
    let setting = Setting { tokens, patterns: patterns(plan, &interface, stalls, 5), ..setting };
    let mut rig = Rig::new(&interface, setting);
    let id = |name: &str| interface.port(name).unwrap_or_else(|| panic!("{name}")).id;
    let blends = plan.blend.is_there();
    let [tri, idle, rd_ready, data_valid, data] =
        ["tri_valid", "idle", "rd_ready", "data_valid", "data_z"].map(id);
    let wr_ready = id(if blends { "zwr_ready" } else { "wr_ready" });
    let color = blends.then(|| ["crd_ready", "cdata_valid", "cdata_rgb", "cwr_ready"].map(id));
    let (mut model, mut view, mut ports) = (Model::<C>::new(plan), View::new(), interface.values());
    let mut all: Vec<Pair> = Vec::new();
    loop {
        let exhausted = rig.exhausted();
        rig.drive(&mut ports);
        device.settle(&mut ports);
        let inputs = Inputs {
            rst: false,
            tri: ports.is_high(tri).then(|| (&triangles[rig.sent() as usize], rig.sent())),
            depth_func: state.depth_func,
            depth_write: state.depth_write,
            rd_ready: ports.is_high(rd_ready),
            data: ports.is_high(data_valid).then(|| ports[data] as u64),
            wr_ready: ports.is_high(wr_ready),
            blend: color.map_or_else(BlendInputs::default, |[read, valid, rgb, write]| BlendInputs {
                color_write: state.color_write,
                add: state.blend_add,
                crd_ready: ports.is_high(read),
                cdata: ports.is_high(valid).then(|| ports[rgb] as u64),
                cwr_ready: ports.is_high(write),
            }),
            ..Inputs::default()
        };
        model.view(plan, &inputs, &mut view);
        if all.is_empty() {
            all = pairs(&view, &mut device);
        }
        for pair in &mut all {
            let register = &view.structure().registers[pair.register];
            let own = view.values()[pair.register];
            if register.live.is_some_and(|live| view.values()[live] == 0) {
                continue;
            }
            let expected = match (pair.field, register.shape) {
                (Some(_), _) if own == 0 => continue,
                (Some(place), Shape::Token(table)) => {
                    view.tokens().kinds()[table].met[own as usize - 1][place + 1]
                }
                _ => own,
            };
            let found = device.simulator().value(pair.signal);
            if u128::from(expected) != found && pair.differs.is_none() {
                pair.differs = Some((rig.cycle(), expected, found));
            }
            pair.compared += 1;
        }
        model.cycle(&inputs);
        device.clock();
        let done = exhausted && ports.is_high(idle);
        rig.clock(&ports);
        if done {
            break;
        }
    }
    let differ: Vec<_> = all.iter().filter_map(|pair| Some((&pair.path, pair.differs?))).collect();
    assert!(differ.is_empty(), "machine {}: {differ:?}", plan.hash());
    all.into_iter().map(|pair| (pair.path, pair.compared)).collect()
}

fn random_triangle(plan: &Plan, rng: &mut impl Rng) -> [PortVertex; 3] {
    let p = 1i32 << plan.subpixel_bits;
    let (w, h) = (plan.width as i32 * p, plan.height as i32 * p);
    std::array::from_fn(|_| {
        let values: Vec<i64> =
            plan.channels().iter().map(|c| rng.random_range(0..=c.limit() as i64)).collect();
        plan.raw_vertex(rng.random_range(-w / 4..w * 5 / 4), rng.random_range(-h / 4..h * 5 / 4), &values)
    })
}

#[test]
fn registers_of_the_model_are_those_of_the_netlist() {
    let settings: [&[(&str, &str)]; 10] = [
        &[],
        &[("interpolator.adders", "1"), ("interpolator.segments", "2")],
        &[("memory.hazard", "drain"), ("memory.latency", "8"), ("fifo.inflight", "8")],
        &[("memory.hazard", "interlock"), ("setup.lanes", "1"), ("fifo.span", "1")],
        &[("edge.kind", "slope"), ("interpolator.adders", "2")],
        &[("channels.extra", "3"), ("interpolator.segments", "4"), ("interpolator.adders", "7")],
        &[("screen.subpixel_bits", "4"), ("fifo.span", "5"), ("setup.lanes", "2")],
        &[],
        &[("blend.kind", "interpolated"), ("memory.color_hazard", "forward"), ("interpolator.adders", "5")],
        &[
            ("blend.kind", "constant"),
            ("blend.multipliers", "0"),
            ("blend.stages", "2"),
            ("memory.hazard", "drain"),
        ],
    ];
    let mut compared = BTreeMap::<String, u64>::new();
    for (number, settings) in settings.iter().enumerate() {
        let mut machine =
            if number == 7 { Machine::preset("textbook").expect("a preset") } else { Machine::default() };
        for (key, value) in settings.iter().chain(&[("screen.width", "32"), ("screen.height", "24")]) {
            machine.set(key, value).expect("a key");
        }
        let plan = machine.plan().expect("can be built");
        let mut rng = Pcg64Mcg::seed_from_u64(number as u64);
        let triangles: Vec<_> = (0..12).map(|_| random_triangle(&plan, &mut rng)).collect();
        let before: u64 = compared.values().sum();
        for stalls in [StallKind::None, StallKind::Mixed] {
            for (path, values) in compare(&plan, &triangles, stalls) {
                *compared.entry(path).or_default() += values;
            }
        }
        println!("machine {}: {} values compared", plan.hash(), compared.values().sum::<u64>() - before);
    }
    let all: u64 = compared.values().sum();
    println!("checked {all} values of {} registers on {} machines", compared.len(), settings.len());
    assert!(all > 1_000_000);
    let never: Vec<_> = compared.iter().filter(|(_, values)| **values == 0).collect();
    assert!(never.is_empty(), "registers that never meant anything: {never:?}");
}
