//! What is declared is what model and netlist have: every port is found on random machines. (Lists kept by hand, so that a
//! wrong declaration is not wrong everywhere alike, are in the tests of rtl.)

use crate::common;
use crate::common::machines::random_machine;
use edgewalk_lockstep::{Interface, NetlistDevice, NoPlace, PortError, Triangles, Unit, model, netlist};
use edgewalk_machine::{Field, Plan, Role, Window};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

#[test]
fn model_and_netlist_have_every_declared_port() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let (mut units, mut ports, mut further) = (0, 0, 0);
    for _ in 0..200 {
        let plan = random_machine(&mut rng);
        further += plan.units().count() - 5;
        let each = Unit::all(&plan).into_iter().map(|unit| Interface::new(&plan, unit));
        for interface in each.chain([Interface::with_units(&plan)]) {
            model(&plan, &interface).map(|_| ()).unwrap_or_else(|error| panic!("{error}\n{plan:?}"));
            let netlist = netlist(&plan, interface.unit).expect("can be built");
            NetlistDevice::new(&netlist, &interface).unwrap_or_else(|error| panic!("{error}\n{plan:?}"));
            ports += interface.inputs().len() + interface.outputs().len() + interface.inner_outputs().len();
            units += 1;
        }
    }
    println!("{units} units, {ports} ports resolved");
    // The five units of every machine, those it may have, the machine, and the machine with its units.
    assert_eq!(units, 200 * 7 + further);
    assert!(further > 200);
}

/// A field that is called otherwise than the model and the netlist call it is found out before the first cycle.
#[test]
fn a_field_of_another_name_is_refused() {
    let plan = Plan::default();
    let mut refused = 0;
    for unit in Unit::all(&plan) {
        let declared = unit.ports(&plan);
        let links = [declared.takes.iter(), declared.gives.iter()].into_iter().flatten();
        let fields: Vec<(&str, usize)> =
            links.flat_map(|link| (0..link.fields.len()).map(|place| (link.name, place))).collect();
        for (link, place) in fields {
            let mut faulty = declared.clone();
            let sides = [faulty.takes.as_mut(), faulty.gives.as_mut()].into_iter().flatten();
            for of in sides.filter(|of| of.name == link) {
                of.fields[place].name += "_other";
            }
            // A memory names the field it stores; there the declaration itself would not hold together.
            if faulty.memory.iter().any(|memory| {
                let write = faulty.gives.as_ref().filter(|gives| gives.name == memory.write);
                let address = &memory.read.fields[0].name;
                write.is_some_and(|write| {
                    [Some(memory.word), memory.enable, Some(address)]
                        .into_iter()
                        .flatten()
                        .any(|f| write.place(f).is_none())
                })
            }) {
                continue;
            }
            let interface = Interface::of_ports(unit, &faulty);
            assert!(
                matches!(model(&plan, &interface).err(), Some(NoPlace::Port { .. })),
                "{unit:?} {link} {place}"
            );
            let netlist = netlist(&plan, unit).expect("can be built");
            let error = NetlistDevice::new(&netlist, &interface).expect_err("a port of another name");
            assert!(matches!(error, PortError::Undeclared { .. }), "{error}");
            refused += 1;
        }
    }
    println!("{refused} fields of another name refused");
    assert!(refused > 100);
}

/// A port of another width, and one that is missing, are refused.
#[test]
fn a_port_of_another_width_is_refused() {
    let plan = Plan::default();
    let unit = Unit::named("depth").expect("declared");
    let netlist = netlist(&plan, unit).expect("can be built");
    let mut wider = unit.ports(&plan);
    wider.constants[0] = Field::count("depth_func", 4, "");
    let error = NetlistDevice::new(&netlist, &Interface::of_ports(unit, &wider)).expect_err("too wide");
    assert_eq!(error.to_string(), "module edgewalk_depth: depth_func has 3 bits, the interface 4");
    let mut more = unit.ports(&plan);
    more.constants.push(Field::count("other", 1, ""));
    let error = NetlistDevice::new(&netlist, &Interface::of_ports(unit, &more)).expect_err("missing");
    assert_eq!(error.to_string(), "module edgewalk_depth has no input other");
}

#[test]
fn triangles_pass_the_port_and_come_back() {
    let mut rng = Pcg64Mcg::seed_from_u64(4);
    let (mut checked, mut lines) = (0, 0);
    for _ in 0..3000 {
        let plan = random_machine(&mut rng);
        let triangle = common::triangles::random_primitive(&plan, &mut rng);
        let tag = rng.random::<u32>().checked_shr(32 - plan.tag_bits).unwrap_or(0);
        let port = Triangles::new(&plan);
        // A triangle has one k_t, its first vertex's.
        let first_kt = std::array::from_fn(|corner| {
            let vertex = &triangle[corner];
            let kt = if corner == 0 { i64::from(vertex.kt()) } else { 0 };
            let channels = &vertex.values()[..plan.channels().len()];
            plan.raw_vertex(vertex.x(), vertex.y(), &[channels, &[kt]].concat())
        });
        let kept = plan.with_window(plan.with_role(first_kt, Role::of(&triangle)), Window::of(&triangle));
        assert_eq!(port.unpack(&port.pack(&triangle, tag)), (kept, tag));
        lines += usize::from(Role::of(&triangle).is_line());
        checked += 1;
    }
    println!("{checked} triangles, {lines} of them lines");
    assert!(lines > 20);
}
