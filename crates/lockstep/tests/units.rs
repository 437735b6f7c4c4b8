//! Every unit alone, model against netlist, under inputs that the rest of the machine would rarely give it.

use crate::common::fail::checked;
use crate::common::machines::{random_machine, random_poly};
use crate::common::tokens::{few, random_tokens};
use edgewalk_lockstep::{Case, Checked, Interface, Unit};
use edgewalk_machine::{Machine, Plan};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::BTreeSet;

/// Machines drawn for each unit.
const MACHINES: u64 = 400;

/// The unit of every machine for some thousand cycles.
fn alone(unit: Unit, seed: u64) {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let name = unit.name();
    let cycles = match name {
        "setup" => 3000,
        // Tables of up to 2048 entries.
        "shade" | "lamp" => 6000,
        _ => 2000,
    };
    let (mut all, mut machines, mut without) = (Checked::default(), 0, 0);
    let mut possible = BTreeSet::new();
    for _ in 0..MACHINES {
        let plan = if name == "poly" { random_poly(&mut rng) } else { random_machine(&mut rng) };
        if !Unit::all(&plan).contains(&unit) {
            without += 1;
            continue;
        }
        possible.extend(unit.events(&plan).iter().map(|event| event.name));
        let mut case = Case::new(&plan, unit);
        // SETUP, EDGE and POLY take long for a token.
        let count = if ["setup", "edge", "poly"].contains(&name) { cycles / 40 } else { cycles };
        case.tokens = random_tokens(&plan, unit, count as usize, &mut rng);
        if case.tokens.is_empty() {
            continue; // a machine on whose screen no triangle lies
        }
        let interface = Interface::new(&plan, unit);
        // Tables come in hundreds of words: they are not kept waiting for long.
        let most = |wait: &str| if ["srd", "sdata", "rrd", "rdata"].contains(&wait) { 60 } else { 200 };
        case.unwilling =
            interface.waits().map(|wait| (wait.to_owned(), rng.random_range(0..most(wait)))).collect();
        case.state.depth_func = rng.random_range(0..8);
        case.state.depth_write = rng.random_bool(0.9);
        case.state.color_write = rng.random_bool(0.9);
        case.state.blend_add = rng.random_bool(0.3);
        case.state.shadow_on = rng.random_bool(0.9);
        case.state.light_pass = plan.shadow.draws_map() && rng.random();
        case.state.ambient = rng.random_range(0..=plan.color.max());
        case.clear_z = Some(rng.random_range(0..=few(&plan)));
        case.late = rng.random_range(0..3);
        case.disturbed = rng.random_range(0..40);
        case.resets = if rng.random_bool(0.3) { vec![rng.random_range(1..cycles)] } else { Vec::new() };
        let link = &interface.links[0];
        if let Some(fresh) =
            link.place("fresh").filter(|_| !case.resets.is_empty() && link.own < link.fields.len())
        {
            // Behind a reset EDGE begins anew: no span then goes without increments of its own.
            case.tokens.iter_mut().for_each(|token| token[fresh] = 1);
        }
        case.seed = rng.random_range(0..1 << 32);
        case.cycles = cycles;
        all.merge(&checked(&case));
        machines += 1;
    }
    let Checked { compared, tokens, .. } = all;
    println!(
        "{name}: {machines} of {MACHINES} machines, {without} do not have it, {cycles} cycles each, {tokens} tokens, {compared} values of ports compared"
    );
    assert!(
        machines + without > MACHINES * 9 / 10 && machines > MACHINES / 12 && compared > cycles * machines
    );
    let met = all.events.counts().into_iter().filter(|(_, count)| *count > 0).map(|(name, _)| name);
    let met: Vec<&str> = met.collect();
    for event in possible {
        assert!(met.contains(&event), "{name}: {event} not met");
    }
}

/// All that are declared, side by side.
#[test]
fn every_unit_alone() {
    std::thread::scope(|scope| {
        let poly = Unit::named("poly").expect("declared");
        for (seed, unit) in (11..).zip(Unit::known().skip(1).filter(|unit| *unit != poly)).chain([(99, poly)])
        {
            scope.spawn(move || alone(unit, seed));
        }
    });
}

/// A small screen, and these keys.
fn small(keys: &[(&str, &str)]) -> Plan {
    let mut machine = Machine { width: 6, height: 6, guard_bits: 4, ..Machine::default() };
    for (key, value) in keys {
        machine.set(key, value).expect("a key of the machine");
    }
    machine.plan().expect("can be built")
}

/// Something does, and nothing that the unit does not declare.
#[test]
fn what_happens_to_a_unit_alone_is_counted() {
    let phong = [("shade.kind", "phong"), ("shade.colour", "multiply"), ("term.record_bits", "2")];
    let relief = [("texture.kind", "nearest"), ("texture.bits", "2"), ("texture.bump", "yes")];
    let light = [("shadow.light", "perspective"), ("blend.kind", "constant")];
    let machines = [
        small(&[&phong[..], &relief, &light].concat()),
        small(&[&phong[..], &[("shade.light", "positional")]].concat()),
        small(&[("dither.bits", "5"), ("dither.screen_door", "yes")]),
        small(&[("polygon.edges", "8")]),
    ];
    let mut rng = Pcg64Mcg::seed_from_u64(9);
    let mut known: BTreeSet<&str> = Unit::known().skip(1).map(Unit::name).collect();
    for plan in &machines {
        for unit in Unit::single(plan) {
            let mut case = Case { seed: 3, cycles: 2500, ..Case::new(plan, unit) };
            case.state.shadow_on = true;
            case.tokens = random_tokens(plan, unit, 40, &mut rng);
            let counts = case.run().expect("no difference").events.counts();
            let met: Vec<_> = counts.into_iter().filter(|(_, count)| *count > 0).collect();
            println!("{unit:?}: {met:?}");
            let declared: Vec<&str> = unit.events(plan).iter().map(|event| event.name).collect();
            assert!(!met.is_empty() || declared.is_empty(), "{unit:?}");
            // Lines drawn at random may lie beyond the screen; those of POLY do not, so its SPAN and PIXEL declare fewer events.
            let behind_poly = plan.polygon.is_there() && ["span", "pixel"].contains(&unit.name());
            assert!(
                behind_poly || met.iter().all(|(event, _)| declared.contains(event)),
                "{unit:?}: {met:?}"
            );
            known.remove(unit.name());
        }
    }
    assert!(known.is_empty(), "not run: {known:?}");
}

/// The modulus of such an edge is 2^F: a constant, and no port.
#[test]
fn edges_of_a_slope_are_walked_alike() {
    let edge = Unit::named("edge").expect("declared");
    let mut rng = Pcg64Mcg::seed_from_u64(10);
    for fraction in ["1", "8", "30"] {
        let plan = small(&[("edge.kind", "slope"), ("edge.fraction_bits", fraction)]);
        let mut case = Case { cycles: 400, ..Case::new(&plan, edge) };
        case.tokens = random_tokens(&plan, edge, 20, &mut rng);
        let checked = case.run().unwrap_or_else(|error| panic!("2^{fraction}: {error}"));
        assert!(checked.moved["prim"] == 20 && checked.moved["line"] > 40, "{:?}", checked.moved);
    }
}
