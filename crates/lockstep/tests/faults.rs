//! What the comparison must not overlook: a device that differs in any one port, a rig that never makes it wait, a reset
//! that forgets.

use crate::common::triangles::{one_pixel, random_primitive};
use edgewalk_lockstep::{
    Case, Device, Interface, LockstepError, ModelDevice, PortId, PortValues, Triangles, Unit, model,
};
use edgewalk_machine::{Hazard, Machine, Plan};
use edgewalk_model::Events;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// The model, but for one thing.
struct Faulty {
    model: Box<dyn ModelDevice>,
    fault: Fault,
    cycle: u64,
}

enum Fault {
    /// The lowest bit of this port is the other, from this cycle on.
    Port(PortId, u64),
    /// It does not see `rst`.
    Reset,
}

impl Device for Faulty {
    fn cycle(&mut self, ports: &mut PortValues) {
        let rst = ports.rst;
        if matches!(self.fault, Fault::Reset) {
            ports.rst = false;
        }
        self.model.cycle(ports);
        ports.rst = rst;
        self.cycle += 1;
        if let Fault::Port(port, from) = self.fault
            && self.cycle > from
        {
            ports[port] ^= 1;
        }
    }
}

impl ModelDevice for Faulty {
    fn events(&self) -> &Events {
        self.model.events()
    }
}

fn small() -> Plan {
    let small = Machine { width: 8, height: 8, guard_bits: 4, extra: 1, tag_bits: 3, ..Machine::default() };
    Machine { hazard: Hazard::Interlock, ..small }.plan().expect("can be built")
}

fn case(plan: &Plan) -> Case {
    let (port, mut rng) = (Triangles::new(plan), Pcg64Mcg::seed_from_u64(8));
    let tokens = (0..12).map(|k| port.pack(&random_primitive(plan, &mut rng), k)).collect();
    let mut case = Case { tokens, seed: 1, ..Case::new(plan, Unit::MACHINE) };
    case.unwilling = ["tri", "rd", "data", "wr"].map(|link| (link.to_owned(), 90)).into_iter().collect();
    case
}

fn run(case: &Case, interface: &Interface, fault: Fault) -> Result<(), LockstepError> {
    let plan = &case.plan;
    let mut reference = model(plan, interface).expect("the model has every port");
    let mut faulty = Faulty { model: model(plan, interface).expect("the same"), fault, cycle: 0 };
    case.run_devices(interface, &mut *reference, &mut faulty).map(|_| ())
}

/// No port is skipped: each output of the machine and of every unit in it, wrong in one bit, is found and named.
#[test]
fn a_fault_in_any_port_is_found_and_named() {
    let plan = small();
    let (case, interface) = (case(&plan), Interface::with_units(&plan));
    let outputs = interface.outputs().iter().chain(interface.inner_outputs());
    let mut found = 0;
    for port in outputs {
        match run(&case, &interface, Fault::Port(port.id, 40)) {
            Err(LockstepError::Differs { difference, compared }) => {
                assert_eq!((&difference.port.owner, &difference.port.name), (&port.owner, &port.name));
                assert_eq!(difference.expected ^ difference.found, 1);
                assert!(compared > 0 && difference.cycle >= 40);
                found += 1;
            }
            other => panic!("{} {} with a fault: {other:?}", port.owner, port.name),
        }
    }
    println!("{found} of {found} ports");
    assert!(found > 90);
}

/// A difference is told with unit, port, cycle, both values raw and by format, triangle and pixel.
#[test]
fn a_difference_is_told_in_full() {
    let plan = small();
    let (case, interface) = (case(&plan), Interface::with_units(&plan));
    let port = interface.port("depth.wr_r").or(interface.port("wr_r")).expect("declared").id;
    let error = run(&case, &interface, Fault::Port(port, 0)).expect_err("a fault").to_string();
    println!("{error}");
    let told = [
        "machine wr_r, cycle ",
        ": expected 0x",
        ", found 0x",
        " (0.",
        " for 0.",
        ", triangle ",
        ", pixel (",
    ];
    assert!(told.iter().all(|word| error.contains(word)), "{error}");
}

/// Behind a triangle without area one of a single pixel.
#[test]
fn the_pixel_of_a_difference_is_the_one_that_is_drawn() {
    let plan = small();
    let mut case = case(&plan);
    let (port, mut rng) = (Triangles::new(&plan), Pcg64Mcg::seed_from_u64(9));
    let interface = case.interface();
    let fault = interface.port("wr_r").expect("declared").id;
    for (x, y) in [(5, 3), (0, 7), (7, 0)] {
        let dot = one_pixel(&plan, &mut rng, x, y);
        case.tokens = vec![port.pack(&[dot[0]; 3], 0), port.pack(&dot, 0)];
        let error = run(&case, &interface, Fault::Port(fault, 0)).expect_err("a fault").to_string();
        assert!(error.ends_with(&format!(", triangle 1, pixel ({x}, {y})")), "{error}");
    }
}

#[test]
fn a_reset_that_is_not_applied_is_found() {
    let plan = small();
    let mut case = case(&plan);
    case.resets = vec![300];
    let interface = case.interface();
    let error = run(&case, &interface, Fault::Reset).expect_err("it went on");
    assert!(
        matches!(error, LockstepError::Differs { ref difference, .. } if difference.cycle == 301),
        "{error}"
    );
}

/// The rig makes the device wait: at every link tokens stand that do not move, and it does not always offer one.
#[test]
fn the_rig_makes_every_link_wait() {
    let plan = small();
    let case = case(&plan);
    let interface = case.interface();
    let mut device = model(&plan, &interface).expect("the model has every port");
    let mut reference = model(&plan, &interface).expect("the same");
    let mut counted =
        Waits { device: &mut *device, interface: &interface, stood: vec![0; interface.links.len()] };
    let waiting = case.run_devices(&interface, &mut *reference, &mut counted).expect("the same device");
    for (link, stood) in interface.links.iter().zip(&counted.stood) {
        println!("{}: {stood} cycles in which a token stands and does not move", link.name);
        assert!(*stood > 0, "{} never waits", link.name);
    }
    let mut willing = case.clone();
    willing.unwilling.clear();
    let willing = willing.run().expect("the same machine");
    assert!(waiting.events.depth.memory_stall > 0 && waiting.events.depth.write_stall > 0);
    assert_eq!((willing.events.depth.memory_stall, willing.events.depth.write_stall), (0, 0));
}

struct Waits<'a> {
    device: &'a mut dyn ModelDevice,
    interface: &'a Interface,
    stood: Vec<u32>,
}

impl Device for Waits<'_> {
    fn cycle(&mut self, ports: &mut PortValues) {
        self.device.cycle(ports);
        for (link, stood) in self.interface.links.iter().zip(&mut self.stood) {
            *stood += u32::from(ports.is_high(link.valid) && !ports.is_high(link.ready));
        }
    }
}
