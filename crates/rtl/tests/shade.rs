//! SHADE against the definition in `docs/machine.md`, section 12: random tables, cosines around the tables' ends, in the clocks
//! that are said there.

use crate::random;
use std::collections::VecDeque;

use edgewalk_machine::units::tokens;
use edgewalk_machine::{Plan, ShadeColour};
use edgewalk_netlist::Simulator;
use edgewalk_rtl as rtl;
use rand::{Rng, RngCore, SeedableRng};
use rand_pcg::Pcg64Mcg;

const MACHINES: usize = 40;
const FRAGMENTS: usize = 150;

/// What a token of SHADE carries, by the field's name.
type Fields = Vec<(String, u128)>;

fn field(fields: &Fields, name: &str) -> u128 {
    fields.iter().find(|(field, _)| field == name).map_or(0, |(_, value)| *value)
}

/// A number of so many bits around what it means to a table: its ends, and below.
fn cosine(plan: &Plan, bits: u32, rng: &mut Pcg64Mcg) -> u128 {
    let (last, least) = ((1i128 << plan.shade.table_bits) - 1, -1i128 << (bits - 1));
    let number = match rng.random_range(0..10) {
        0 => -1,
        1 => 0,
        2 => last,
        3 => last + 1,
        4 => least,
        5 => -least - 1,
        6 => rng.random_range(least..=-least - 1),
        _ => rng.random_range(0..=last),
    };
    number as u128 & (u128::MAX >> (128 - bits))
}

fn fragment(plan: &Plan, material: u128, rng: &mut Pcg64Mcg) -> Fields {
    let fields = tokens::cosines(plan);
    let value = |name: &str, bits: u32, rng: &mut Pcg64Mcg| match name {
        "material" => material,
        "nl0" | "nh0" | "nl1" | "nh1" => cosine(plan, bits, rng),
        _ => (u128::from(rng.next_u64()) << 64 | u128::from(rng.next_u64())) >> (128 - bits),
    };
    fields.iter().map(|f| (f.name.clone(), value(&f.name, f.width(), rng))).collect()
}

/// Red, green and blue of a fragment, by the definition.
fn colours(plan: &Plan, tables: &[u128], fragment: &Fields) -> [u128; 3] {
    let (b, t) = (plan.color.bits, plan.shade.table_bits);
    let (most, last) = ((1u128 << b) - 1, (1u128 << t) - 1);
    let number = |name: &str| {
        let bits = tokens::cosines(plan).iter().find(|field| field.name == name).expect("a cosine").width();
        (field(fragment, name) << (128 - bits)) as i128 >> (128 - bits)
    };
    let entry = |number: i128| number.clamp(0, last as i128) as usize;
    let (mut diffuse, mut highlights) = ([0; 3], 0);
    for light in 0..plan.shade.lights {
        let [below, above] = ["nl", "nh"].map(|name| number(&format!("{name}{light}")));
        let base = plan.table_place(field(fragment, "material") as u32, light, 0);
        let told = tables[base + entry(below)] >> b;
        match plan.shade.colour {
            ShadeColour::Tables => {
                (0..3).for_each(|i| diffuse[i] += told >> ((2 - i as u32) * b) & most);
            }
            ShadeColour::Multiply => diffuse[0] += told,
        }
        let own = if below >= 0 { tables[base + entry(above)] & most } else { 0 };
        highlights += match plan.shade.is_positional() {
            true => ((own * field(fragment, "beam") + (1 << 15)) >> 16).min(most),
            false => own,
        };
    }
    let triangle = ["r", "g", "b"].map(|name| field(fragment, name));
    [0, 1, 2].map(|i| {
        let all = match plan.shade.colour {
            ShadeColour::Tables => diffuse[i] + highlights,
            ShadeColour::Multiply => {
                let light = diffuse[0].min(1 << (b + 2));
                ((triangle[i] * light + (1 << (b + 1))) >> (b + 2)) + highlights.min(most)
            }
        };
        all.min(most)
    })
}

#[test]
fn colours_are_those_of_the_definition_in_the_clocks_that_are_said() {
    let mut rng = Pcg64Mcg::seed_from_u64(52);
    let (mut checked, mut fetches, mut ways) = (0, 0, [0; 2]);
    for _ in 0..MACHINES {
        let plan = loop {
            let plan = random::random_plan(&mut rng);
            if plan.shade.is_there() {
                break plan;
            }
        };
        ways[plan.shade.colour as usize] += 1;
        let netlist = rtl::shade(&plan).unwrap_or_else(|errors| panic!("{plan:?}\n{errors}"));
        let mut sim = Simulator::new(&netlist);
        let set = |sim: &mut Simulator, name: &str, value: u128| {
            let id = sim.input(name).unwrap_or_else(|_| panic!("no input {name}"));
            sim.set(id, value);
        };
        let get = |sim: &mut Simulator, name: &str| sim.get(name).unwrap_or_else(|_| panic!("no {name}"));
        let materials = 1usize << plan.shade.material_bits;
        let bits = plan.shade.diffuse_bits(plan.color.bits) + plan.color.bits;
        // A third of the words small, so that not all sums are cut.
        let words = (0..materials << plan.shade.entry_bits()).map(|_| {
            let word = (u128::from(rng.next_u64()) << 64 | u128::from(rng.next_u64())) >> (128 - bits);
            if rng.random_bool(0.3) { word } else { word & 0x0303_0303_0303_0303 }
        });
        let tables: Vec<u128> = words.collect();
        set(&mut sim, "rst", 1);
        sim.tick();
        set(&mut sim, "rst", 0);
        set(&mut sim, "tinted_ready", 1);
        set(&mut sim, "srd_ready", 1);

        let used = materials.min(3) as u128;
        let mut reads: VecDeque<(u64, u128)> = VecDeque::new();
        let mut inside: VecDeque<(u64, Fields)> = VecDeque::new();
        let (mut current, mut material, mut cycle, mut sent) = (None, 0, 0, 0);
        let stages = 3
            + 2 * u64::from(plan.shade.colour == ShadeColour::Multiply)
            + u64::from(plan.shade.is_positional());
        let mut offered = fragment(&plan, material, &mut rng);
        // Since when the fragment is offered, and the stages are empty.
        let (mut since, mut empty) = (0, 0);
        while sent < FRAGMENTS || !inside.is_empty() {
            set(&mut sim, "frag_valid", u128::from(sent < FRAGMENTS));
            for (name, value) in &offered {
                set(&mut sim, &format!("frag_{name}"), *value);
            }
            let word = reads.front().filter(|(due, _)| *due <= cycle).map(|(_, word)| *word);
            set(&mut sim, "sdata_valid", word.is_some().into());
            set(&mut sim, "sdata_word", word.unwrap_or(0));
            let due = inside.front().is_some_and(|(taken, _)| taken + stages == cycle);
            assert_eq!(get(&mut sim, "tinted_valid") == 1, due, "{plan:?}");
            if due {
                let (_, fragment) = inside.pop_front().expect("due");
                let rgb = colours(&plan, &tables, &fragment);
                for f in tokens::tinted(&plan) {
                    let place = ["r", "g", "b"].iter().position(|name| *name == f.name);
                    let wanted = place.map_or_else(|| field(&fragment, &f.name), |i| rgb[i]);
                    assert_eq!(get(&mut sim, &format!("tinted_{}", f.name)), wanted, "{} {plan:?}", f.name);
                    checked += 1;
                }
                empty = cycle + 1;
            }
            if sent < FRAGMENTS && get(&mut sim, "frag_ready") == 1 {
                if current != Some(material) {
                    let fetch = u64::from(plan.shade.entries() + plan.shade.table_latency) + 1;
                    assert_eq!(cycle, since.max(empty) + fetch, "clocks, {plan:?}");
                    (current, fetches) = (Some(material), fetches + 1);
                }
                inside.push_back((cycle, offered));
                sent += 1;
                material = if rng.random_bool(0.04) { rng.random_range(0..used) } else { material };
                offered = fragment(&plan, material, &mut rng);
                since = cycle + 1;
            }
            if word.is_some() && get(&mut sim, "sdata_ready") == 1 {
                reads.pop_front();
            }
            if get(&mut sim, "srd_valid") == 1 {
                let address = get(&mut sim, "srd_addr") as usize;
                reads.push_back((cycle + u64::from(plan.shade.table_latency), tables[address]));
            }
            sim.tick();
            cycle += 1;
        }
    }
    println!("{checked} fields of {MACHINES} machines, {ways:?} with tables, multiplied, {fetches} fetches");
    assert!(
        checked > 20_000 && fetches > 2 * MACHINES && ways.iter().all(|machines| *machines > MACHINES / 6)
    );
}
