//! What is to be seen of the machine: every unit declares it, values fit their shapes, SETUP's jobs fill its clocks.

use crate::common::polygon::{KINDS, shape, vertices};
use crate::common::{machine, random_machine, random_triangle};
use edgewalk_machine::{Plan, PortVertex, Role, Sides, UNITS, Window};
use edgewalk_model::view::{Item, Shape, Structure, UnitView};
use edgewalk_model::{DrawState, Rig, Stalls, View, for_channels};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::BTreeSet;

type Triangle = [PortVertex; 3];

/// Draws, and sees the machine in every cycle.
fn watch(plan: &Plan, triangles: &[Triangle], stalls: Stalls, see: &mut dyn FnMut(&View)) {
    for_channels!(plan, C => {
        let mut rig = Rig::<C>::new(plan, DrawState::default(), stalls);
        let (mut view, mut waiting) = (View::new(), triangles);
        loop {
            let offered = waiting.first().map(|triangle| (triangle, 0));
            rig.model.view(plan, &rig.inputs(offered, true), &mut view);
            see(&view);
            let cycle = rig.cycle(offered, true);
            if cycle.outputs.triangle {
                waiting = &waiting[1..];
            } else if cycle.outputs.idle && waiting.is_empty() {
                break;
            }
        }
    });
}

fn machines(count: usize, rng: &mut Pcg64Mcg) -> Vec<Plan> {
    let small = [("screen.width", "40"), ("screen.height", "24")];
    let door = [small[0], small[1], ("dither.bits", "5"), ("dither.screen_door", "yes")];
    let poly = |lanes: &'static str| {
        machine(&[
            small[0],
            small[1],
            ("polygon.edges", "16"),
            ("polygon.lines", "yes"),
            ("setup.lanes", lanes),
        ])
    };
    let mut machines = vec![machine(&small), machine(&[]), machine(&door), machine(&door[..3])];
    machines.extend(["1", "2", "4"].map(poly));
    let kinds = ["none", "fast-phong", "none", "phong"].into_iter().cycle();
    let shading =
        |kind| [small[0], small[1], ("shade.kind", kind), ("texture.bits", "4"), ("term.record_bits", "8")];
    machines.extend(kinds.map(|kind| random_machine(&shading(kind), rng)).take(count));
    machines
}

/// So many triangles or a few more; of a machine with POLY the tokens of polygons among them.
fn drawn(plan: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<Triangle> {
    let mut tokens = Vec::new();
    while tokens.len() < count {
        tokens.push(plan.windowed(random_triangle(plan, 25.0, rng)));
        if plan.polygon.is_there() {
            let contours = shape(plan, KINDS[tokens.len() % KINDS.len()], rng);
            let vertices = vertices(plan, &contours, |channel, [x, y]| {
                (i64::from(x) * 7 + i64::from(y)) & 63 << channel
            });
            let first_lines = Window { x0: 3, y0: 2, y1: 14 };
            tokens
                .extend(plan.polygon(&vertices, if rng.random() { first_lines } else { Window::default() }));
            tokens.push(
                plan.with_role(random_triangle(plan, 9.0, rng), Role::Plane(Sides::of_bits(rng.random()))),
            );
        }
    }
    tokens
}

fn registers(unit: &UnitView) -> Vec<usize> {
    let of_item = |item: &Item| match item {
        Item::Register(id) => vec![*id],
        Item::Table(table) => table.rows.iter().flat_map(|row| row.cells.clone()).collect(),
        Item::Schedule { .. } => Vec::new(),
    };
    unit.items.iter().flat_map(of_item).chain(unit.aside.iter().copied()).collect()
}

/// What a sentence names is there: a register, or a field of a token, `head.addr` of the row `head`.
fn is_there(structure: &Structure, view: &View, unit: &UnitView, path: &str) -> bool {
    registers(unit).into_iter().map(|id| &structure.registers[id]).any(|register| {
        let (owner, field) = path.rsplit_once('.').unwrap_or((path, ""));
        let of_token = match register.shape {
            Shape::Token(table) => view.tokens().kinds()[table].fields.iter().any(|own| own.name == field),
            _ => false,
        };
        let row = register.name.rsplit_once('.').map_or(register.name.as_str(), |(row, _)| row);
        register.name == path || (of_token && (register.name == owner || row == owner))
    })
}

#[test]
fn every_unit_declares_what_is_to_be_seen_of_it() {
    let mut rng = Pcg64Mcg::seed_from_u64(81);
    let (mut units, mut links, mut named, mut met) = (0, 0, 0, BTreeSet::new());
    for plan in machines(100, &mut rng) {
        let mut seen = None;
        watch(&plan, &[random_triangle(&plan, 20.0, &mut rng)], Stalls::NONE, &mut |view| {
            seen.get_or_insert_with(|| view.clone()); // names are those of every cycle
        });
        let seen = seen.expect("a cycle");
        let structure = seen.structure();
        let declared: Vec<&str> = plan.units().map(|unit| unit.name).collect();
        let shown: Vec<&str> = structure.units.iter().map(|unit| unit.name.as_str()).collect();
        met.extend(declared.clone());
        assert_eq!(shown, declared, "a unit shows nothing of itself: it needs a view.rs beside its state");
        for (spec, unit) in plan.units().zip(&structure.units) {
            let ids = registers(unit);
            assert!(ids.len() >= 3 && !unit.says.is_empty(), "{}: registers, sentences", spec.name);
            assert!(unit.lane.is_some() && unit.works.is_some(), "{} has no lane", spec.name);
            assert!(ids.iter().any(|id| structure.registers[*id].wire.is_some()), "{}: wires", spec.name);
            let names: BTreeSet<&str> = ids.iter().map(|id| structure.registers[*id].name.as_str()).collect();
            assert_eq!(names.len(), ids.len(), "{}: two registers of one name: {names:?}", spec.name);
            let row_is_register =
                names.iter().filter_map(|name| name.rsplit_once('.')).find(|(row, _)| names.contains(row));
            assert!(
                row_is_register.is_none(),
                "{}: a row with a register's name: {row_is_register:?}",
                spec.name
            );
            for says in &unit.says {
                for path in says.text.split('{').skip(1).filter_map(|rest| rest.split_once('}')) {
                    assert!(is_there(structure, &seen, unit, path.0), "{}: {{{}}}", spec.name, path.0);
                    named += 1;
                }
            }
            let ports = (spec.ports)(&plan);
            let memory = ports.memory.iter().flat_map(|memory| [memory.read.name, memory.data.name]);
            let own = ports.gives.iter().map(|link| link.name).chain(memory);
            for name in own {
                let found = structure.links.iter().any(|link| {
                    link.name == name
                        && [&link.from, &link.to].into_iter().flatten().any(|end| *end == unit.name)
                });
                assert!(found, "{} does not show its link {name}", spec.name);
                links += 1;
            }
            units += 1;
        }
    }
    println!("checked {units} units, {links} links, {named} names in sentences, of {met:?}");
    let missing: Vec<&str> = UNITS.iter().map(|unit| unit.name).filter(|name| !met.contains(name)).collect();
    assert_eq!(missing, [""; 0], "not met");
    assert!(units >= 60 && links >= 84 && named > 300);
}

#[test]
fn values_fit_their_shapes_in_every_cycle() {
    let mut rng = Pcg64Mcg::seed_from_u64(82);
    let mut checked = 0u64;
    for plan in machines(8, &mut rng) {
        let triangles = drawn(&plan, 12, &mut rng);
        let stalls = Stalls { seed: 3, rd: 60, data: 60, wr: 60 };
        watch(&plan, &triangles, stalls, &mut |view| {
            let structure = view.structure();
            assert_eq!(view.values().len(), structure.registers.len());
            for (value, register) in view.values().iter().zip(&structure.registers) {
                assert!(value >> (register.shape.bits() - 1) <= 1, "{} = {value}", register.name);
                checked += 1;
            }
            for (cause, id) in [(view.values()[structure.cause], structure.cause)] {
                assert!((cause as usize) < edgewalk_model::Activity::ALL.len(), "{id}");
            }
        });
    }
    println!("checked {checked} values");
    assert!(checked > 1_000_000);
}

/// The jobs are counted by other code than the clocks of the phases: where they did not add up, a phase would begin within
/// a job or end before its last one does.
#[test]
fn the_jobs_of_setup_fill_its_clocks() {
    let mut rng = Pcg64Mcg::seed_from_u64(83);
    let (mut clocks, mut jobs) = (0u64, 0u64);
    for plan in machines(22, &mut rng) {
        let triangles = drawn(&plan, 25, &mut rng);
        let mut before: Option<[u64; 4]> = None;
        // The structure of a machine does not change.
        let mut places = None;
        watch(&plan, &triangles, Stalls::NONE, &mut |view| {
            let ids = *places.get_or_insert_with(|| {
                let structure = view.structure();
                let unit = structure.unit("setup").expect("declared");
                ["state", "job", "clock", "clocks"].map(|name| {
                    let id = registers(unit).into_iter().find(|id| structure.registers[*id].name == name);
                    id.unwrap_or_else(|| panic!("{name}"))
                })
            });
            let now = ids.map(|id: usize| view.values()[id]);
            let [state, job, clock, of] = now;
            let works = state == 1 || state == 2;
            if works {
                assert!(job > 0 && (1..=of).contains(&clock), "{now:?} behind {before:?}");
                clocks += 1;
            }
            if plan.is_sequenced() && state == 1 && clock == of && before == Some(now) {
                return; // the last word of WORK is repeated while EDGE reads the prim before
            }
            match before {
                Some([was, old, last, all]) if works && was == state && last < all => {
                    assert_eq!([job, clock, of], [old, last + 1, all], "a job goes on");
                }
                Some([was, _, last, all]) => {
                    assert!(
                        was == 0 || was == 3 || last == all,
                        "{now:?} behind {before:?}: a job is cut off"
                    );
                    assert!(!works || clock == 1, "{now:?} behind {before:?}: a job begins late");
                    jobs += u64::from(works);
                }
                None => {}
            }
            before = Some(now);
        });
    }
    println!("checked {clocks} clocks, {jobs} jobs");
    assert!(clocks > 30_000 && jobs > 3_000);
}
