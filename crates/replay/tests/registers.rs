//! What a recording says of a register is what the netlist's register of that name holds, in every cycle in which it means
//! something: model and netlist in lock-step inside, not only at their ports.

use edgewalk_lockstep::{
    Case, Device, Interface, ModelDevice, NetlistDevice, PortValues, Triangles, Unit, model, netlist,
};
use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::view::Shape;
use edgewalk_model::{Events, View};
use edgewalk_netlist::SignalId;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

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

/// The model, and what is to be seen of it in the cycle.
struct Seen {
    model: Box<dyn ModelDevice>,
    view: Rc<RefCell<View>>,
}

impl Device for Seen {
    fn cycle(&mut self, ports: &mut PortValues) {
        assert!(self.model.view(ports, &mut self.view.borrow_mut()), "the whole machine can be seen");
        self.model.cycle(ports);
    }
}

impl ModelDevice for Seen {
    fn events(&self) -> &Events {
        self.model.events()
    }
}

/// The netlist, whose signals are compared with what was seen of the model in the same cycle.
struct Compared {
    netlist: NetlistDevice,
    view: Rc<RefCell<View>>,
    pairs: Vec<Pair>,
    cycle: u64,
}

impl Device for Compared {
    fn cycle(&mut self, ports: &mut PortValues) {
        self.netlist.settle(ports);
        let view = self.view.borrow();
        if self.pairs.is_empty() {
            self.pairs = pairs(&view, &mut self.netlist);
        }
        for pair in &mut self.pairs {
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
            let found = self.netlist.simulator().value(pair.signal);
            if u128::from(expected) != found && pair.differs.is_none() {
                pair.differs = Some((self.cycle, expected, found));
            }
            pair.compared += 1;
        }
        drop(view);
        self.netlist.clock();
        self.cycle += 1;
    }
}

/// Draws with model and netlist under one rig; gives by path the values compared. `waits`: in so many of 256 cycles no link is willing.
fn compare(plan: &Plan, triangles: &[[PortVertex; 3]], waits: u8) -> Vec<(String, u64)> {
    let mut case = Case::new(plan, Unit::MACHINE);
    let port = Triangles::new(plan);
    case.tokens = triangles.iter().zip(0..).map(|(triangle, k)| port.pack(triangle, k)).collect();
    let interface = Interface::new(plan, Unit::MACHINE);
    case.unwilling = interface.waits().map(|link| (link.to_owned(), waits)).collect();
    (case.state.shadow_on, case.state.ambient, case.seed) = (true, plan.color.max() / 3, 5);
    let built = netlist(plan, Unit::MACHINE).expect("it can be built");
    let view = Rc::new(RefCell::new(View::new()));
    let model = model(plan, &interface).expect("its ports are declared");
    let mut seen = Seen { model, view: Rc::clone(&view) };
    let device = NetlistDevice::new(&built, &interface).expect("its ports are declared");
    let mut compared = Compared { netlist: device, view, pairs: Vec::new(), cycle: 0 };
    let ran = case.run_devices(&interface, &mut seen, &mut compared);
    // A register that differs comes before the port at which it shows.
    let differ: Vec<_> = compared.pairs.iter().filter_map(|pair| Some((&pair.path, pair.differs?))).collect();
    assert!(differ.is_empty(), "machine {}: {differ:?}", plan.hash());
    ran.unwrap_or_else(|why| panic!("machine {}: {why}", plan.hash()));
    compared.pairs.into_iter().map(|pair| (pair.path, pair.compared)).collect()
}

/// Around the screen, and around the light's map.
fn random_triangle(plan: &Plan, rng: &mut impl Rng) -> [PortVertex; 3] {
    let (w, h) = (f64::from(plan.width), f64::from(plan.height));
    std::array::from_fn(|_| {
        let value = |channel: &edgewalk_machine::Channel, share: f64| {
            let (low, high) = channel.host_range();
            match channel.name {
                "lx" | "ly" => f64::from(plan.shadow.size) * (share * 1.4 - 0.2),
                "lz" => f64::from(1 << plan.shadow.depth_bits) * (share * 1.2 - 0.1),
                _ => low + (high - low) * share,
            }
        };
        let mut values: Vec<f64> =
            plan.channels().iter().map(|channel| value(channel, rng.random_range(0.0..=1.0))).collect();
        values.extend(plan.has_triangle_kt().then_some(0.25));
        plan.port_vertex(w * rng.random_range(-0.25..1.25), h * rng.random_range(-0.25..1.25), &values)
            .expect("in its ranges")
    })
}

/// What POLY is sent of a polygon with so many corners, which mostly crosses itself.
fn random_polygon(plan: &Plan, corners: usize, rng: &mut impl Rng) -> Vec<[PortVertex; 3]> {
    let contour: Vec<PortVertex> = (0..corners).map(|_| random_triangle(plan, rng)[0]).collect();
    plan.polygon(std::slice::from_ref(&contour), plan.window_from(&contour))
}

#[test]
fn registers_of_the_model_are_those_of_the_netlist() {
    let settings: [&[(&str, &str)]; 17] = [
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
        &[
            ("shadow.light", "parallel"),
            ("shadow.gate", "scale"),
            ("shadow.size", "64"),
            ("channels.extra", "1"),
        ],
        &[("shadow.light", "parallel"), ("blend.kind", "interpolated"), ("memory.hazard", "interlock")],
        &[("shade.kind", "fast-phong"), ("term.record_bits", "4")],
        &[
            ("shade.kind", "phong"),
            ("shade.colour", "multiply"),
            ("texture.kind", "nearest"),
            ("texture.bump", "yes"),
            ("term.record_bits", "4"),
        ],
        &[("shade.kind", "phong"), ("shade.light", "positional"), ("term.record_bits", "4")],
        &[("polygon.edges", "8")],
        &[("polygon.edges", "16"), ("polygon.lines", "yes"), ("edge.kind", "slope")],
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
        let mut triangles: Vec<_> = (0..12).map(|_| random_triangle(&plan, &mut rng)).collect();
        if plan.polygon.is_there() {
            triangles = triangles.into_iter().map(|triangle| plan.windowed(triangle)).collect();
            // The last ones have more edges than the table, and are refused.
            (3..20).for_each(|corners| triangles.extend(random_polygon(&plan, corners, &mut rng)));
        }
        let before: u64 = compared.values().sum();
        for waits in [0, 85] {
            for (path, values) in compare(&plan, &triangles, waits) {
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
