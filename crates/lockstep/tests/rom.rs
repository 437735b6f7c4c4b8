//! Every bit of the program of a sequenced SETUP, flipped in the ROM of its netlist: is it seen at the ports?

use crate::common::triangles::{random_primitive, random_triangle};
use edgewalk_jit::Simulator;
use edgewalk_lockstep::{Triangles, Unit, netlist};
use edgewalk_machine::units::setup::SPEC;
use edgewalk_machine::{Machine, Plan, PortVertex, SetupKind};
use edgewalk_rtl::program_rom;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::cell::Cell;
use std::collections::BTreeMap;

/// Triangles that a flipped bit is tried with.
const TRIANGLES: usize = 200;

/// Triangles that those are tried with that so few do not find.
const MORE: usize = 1000;

/// Cycles behind the last word.
const AFTER: usize = 4096;

/// What stands at the ports in a cycle.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Cycle {
    in_ready: bool,
    prim_valid: bool,
}

/// A run of the program as it is.
struct Right {
    words: Vec<Option<u128>>,
    cycles: Vec<Cycle>,
    prims: Vec<Vec<u128>>,
}

/// SETUP alone, before its reset, with the places of its outputs.
struct Alone {
    simulator: Simulator,
    fields: Vec<String>,
}

impl Alone {
    fn new(plan: &Plan) -> Alone {
        let unit = Unit::named("setup").expect("declared");
        let simulator = Simulator::new(&netlist(plan, unit).expect("can be built")).expect("compiled");
        let prim = (SPEC.ports)(plan).gives.expect("SETUP gives prims");
        Alone { simulator, fields: prim.fields.iter().map(|field| format!("prim_{}", field.name)).collect() }
    }

    /// EDGE takes a prim at once in some stretches, and keeps SETUP waiting in others.
    fn prim_ready(cycle: usize) -> bool {
        cycle / 1024 % 4 < 2 || cycle % 1024 == 0
    }

    /// Runs on, a cycle at a time, until `see` says that it is enough. It gets the cycle, the ports, and a prim that is taken, and
    /// gives the word for the cycle.
    fn run(
        &self,
        flipped: Option<(usize, u128)>,
        word: &mut dyn FnMut(usize, bool) -> Option<u128>,
        see: &mut dyn FnMut(usize, Cycle, Option<Vec<u128>>) -> bool,
    ) {
        let mut simulator = self.simulator.clone();
        if let Some((address, code)) = flipped {
            simulator.set_word("listing", address, code).expect("a word of the ROM");
        }
        let [valid, data, ready, rst] = ["in_valid", "in_data", "prim_ready", "rst"]
            .map(|name| simulator.input(name).expect("a port of SETUP"));
        let [in_ready, prim_valid] =
            ["in_ready", "prim_valid"].map(|name| simulator.signal(name).expect("a port of SETUP"));
        let fields: Vec<_> =
            self.fields.iter().map(|name| simulator.signal(name).expect("a field of a prim")).collect();
        simulator.set(rst, 1);
        simulator.tick();
        simulator.set(rst, 0);
        for cycle in 0.. {
            let takes = simulator.value(in_ready) == 1;
            let offered = word(cycle, takes);
            simulator.set(valid, offered.is_some().into());
            simulator.set(data, offered.unwrap_or(0));
            simulator.set(ready, Alone::prim_ready(cycle).into());
            let seen = Cycle { in_ready: takes, prim_valid: simulator.value(prim_valid) == 1 };
            let fires = seen.prim_valid && Alone::prim_ready(cycle);
            let prim = fires.then(|| fields.iter().map(|field| simulator.value(*field)).collect());
            if !see(cycle, seen, prim) {
                return;
            }
            simulator.tick();
        }
    }

    fn right(&self, words: &[u128]) -> Right {
        let mut right = Right { words: Vec::new(), cycles: Vec::new(), prims: Vec::new() };
        let (mut next, mut offered) = (0, Vec::new());
        let after = Cell::new(0);
        self.run(
            None,
            &mut |_, takes| {
                let word = words.get(next).copied();
                next += usize::from(takes && word.is_some());
                after.set(after.get() + usize::from(word.is_none()));
                offered.push(word);
                word
            },
            &mut |_, seen, prim| {
                right.cycles.push(seen);
                right.prims.extend(prim);
                after.get() < AFTER
            },
        );
        right.words = offered;
        right
    }

    /// Something else is seen than in the right run.
    fn differs(&self, right: &Right, address: usize, code: u128) -> bool {
        let (mut place, mut found) = (0, false);
        self.run(Some((address, code)), &mut |cycle, _| right.words[cycle], &mut |cycle, seen, prim| {
            found = seen != right.cycles[cycle];
            if let (Some(prim), false) = (prim, found) {
                found = prim != right.prims[place];
                place += 1;
            }
            !found && cycle + 1 < right.cycles.len()
        });
        found
    }
}

/// A triangle of less than three sub-pixels in height about the middle of a line: DX of its edges does not fit.
fn flat(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let middle = rng.random_range(0..plan.height as i32) * unit + unit / 2;
    random_triangle(plan, rng).map(|vertex| {
        let values: Vec<i64> = vertex.values().iter().copied().take(plan.channels().len()).collect();
        let limit = ((1 << plan.guard_bits) - 1) * unit;
        plan.raw_vertex(rng.random_range(-limit..=limit), middle + rng.random_range(-1..=1), &values)
    })
}

/// Words of triangles, of which each fourth is flat.
fn words(plan: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<u128> {
    let port = Triangles::new(plan);
    let triangle = |number| if number % 4 == 3 { flat(plan, rng) } else { random_primitive(plan, rng) };
    let triangles: Vec<_> = (0..count).map(triangle).collect();
    triangles.iter().flat_map(|triangle| port.offers(triangle, 0)).map(|word| word[0]).collect()
}

/// `cargo test --release -p edgewalk-lockstep --test suites -- --ignored every_bit_of_program --nocapture`
///
/// `docs/mutants.md` has the figures. A survivor is no proof: most make a word do what does no harm at its place.
#[test]
#[ignore = "a campaign of a quarter of an hour"]
fn every_bit_of_program_is_flipped() {
    const LANES: u32 = 1;
    let plan = Machine { lanes: LANES, setup_kind: SetupKind::Sequenced, ..Machine::default() };
    let plan = plan.with(|m| (m.width, m.height, m.guard_bits) = (60, 40, 7)).plan().expect("can be built");
    let mut rng = Pcg64Mcg::seed_from_u64(LANES.into());
    let alone = Alone::new(&plan);
    let [few, more] = [TRIANGLES, MORE].map(|count| {
        let right = alone.right(&words(&plan, count, &mut rng));
        println!("{} cycles, {} prims of {count} triangles", right.cycles.len(), right.prims.len());
        assert!(right.prims.len() * 2 > count && right.words.last() == Some(&None));
        right
    });

    let (fields, rom) = program_rom(&plan);
    let bits: u32 = fields.iter().map(|(_, bits)| bits).sum();
    let (mut used, mut found, mut later, mut unused) = (0, 0, 0, 0);
    let mut counts: BTreeMap<&str, [usize; 3]> = BTreeMap::new();
    let mut survivors: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (address, word) in rom.iter().enumerate() {
        let mut above = bits;
        for (name, width) in &fields {
            above -= width;
            for bit in 0..*width {
                let flip = 1 << (above + bit);
                let differs = alone.differs(&few, address, word.code ^ flip);
                if word.used & flip == 0 {
                    assert!(!differs, "bit {bit} of {name} counts in word {address}: {}", word.text);
                    unused += 1;
                    continue;
                }
                let differs_later = !differs && alone.differs(&more, address, word.code ^ flip);
                used += 1;
                found += usize::from(differs);
                later += usize::from(differs_later);
                let of_field = counts.entry(name).or_default();
                for (count, is) in of_field.iter_mut().zip([true, differs, differs_later]) {
                    *count += usize::from(is);
                }
                if !differs && !differs_later {
                    survivors.entry(name).or_default().push(format!("{bit} in {address}: {}", word.text));
                }
            }
        }
    }
    for (name, [of, by_few, by_more]) in &counts {
        println!("| `{name}` | {of} | {by_few} | {by_more} | {} |", of - by_few - by_more);
    }
    for (name, of) in &survivors {
        println!("{name}: {} not found\n  {}", of.len(), of.join("\n  "));
    }
    println!(
        "{found} of {used} bits that count found by {TRIANGLES} triangles, {later} by {MORE} others; {unused} do not care"
    );
    assert!(used > 8_000 && found * 100 >= used * 77, "{found} of {used}");
}
