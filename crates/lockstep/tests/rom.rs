//! Every bit of the program of a sequenced SETUP, flipped in the ROM of its netlist: is it seen at the ports?

mod dead;
mod differences;
mod known;
mod thing;
mod word;

use crate::common::triangles::{random_primitive, random_triangle};
use edgewalk_jit::Simulator;
use edgewalk_lockstep::{Triangles, Unit, netlist};
use edgewalk_machine::sequencer::{Program, rounds};
use edgewalk_machine::units::setup::SPEC;
use edgewalk_machine::{Machine, Plan, PortVertex, SetupKind};
use edgewalk_rtl::{RomWord, program_rom};
use known::{Flow, ROWS, Range};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::cell::Cell;
use std::collections::BTreeMap;
use word::Word;

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

/// What is known of the program in front of each word.
fn flow(plan: &Plan, fields: &[(&'static str, u32)], rom: &[RomWord]) -> Flow {
    let (program, widths) = (Program::of(plan), plan.widths());
    let p = 1i128 << widths.center_fraction;
    let mut rows = vec![Range::ZERO; ROWS];
    let constants = [
        ("one", 1),
        ("half", p / 2),
        ("up", p / 2 - 1),
        ("pixel", p),
        ("height", i128::from(plan.height) * p),
        ("width", i128::from(plan.width) * p),
    ];
    for (name, number) in constants {
        rows[usize::from(program.row(name))] = Range { low: number, high: number, lines: number % p == 0 };
    }
    let place = 1i128 << (widths.vertex - 1) << (widths.center_fraction - plan.subpixel_bits);
    let value =
        plan.channels().iter().map(|channel| 1i128 << channel.vertex_bits()).max().expect("a channel");
    for vertex in [0x80, 0x90, 0xa0] {
        rows[vertex..vertex + 2].fill(Range { low: -place, high: place, lines: false });
        rows[vertex + 2..vertex + 16].fill(Range { low: -value, high: value, lines: false });
    }
    let words: Vec<Word> = rom.iter().map(|word| Word::new(fields, word.code)).collect();
    let mut written = [false; ROWS];
    for word in words.iter().filter(|word| word.is("write_a") || word.is("write_w")) {
        (0..8).for_each(|number| written[usize::from(word.written(number))] = true);
    }
    Flow::new(words, rounds(plan) as u32 - 1, rows, &written)
}

/// The machine of the campaign.
fn small_machine() -> Plan {
    let plan = Machine { lanes: 1, setup_kind: SetupKind::Sequenced, ..Machine::default() };
    plan.with(|m| (m.width, m.height, m.guard_bits) = (60, 40, 7)).plan().expect("can be built")
}

/// Of a flipped bit.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Found,
    FoundLater,
    /// Proved to change nothing that a port shows.
    Dead,
    Open,
}

/// `cargo test --release -p edgewalk-lockstep --test suites -- --ignored every_bit_of_program --nocapture`
///
/// `docs/mutants.md` has the figures. A bit that is proved to be dead must not be found by any triangle.
#[test]
#[ignore = "a campaign of a quarter of an hour"]
fn every_bit_of_program_is_flipped() {
    let plan = small_machine();
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let alone = Alone::new(&plan);
    let [few, more] = [TRIANGLES, MORE].map(|count| {
        let right = alone.right(&words(&plan, count, &mut rng));
        println!("{} cycles, {} prims of {count} triangles", right.cycles.len(), right.prims.len());
        assert!(right.prims.len() * 2 > count && right.words.last() == Some(&None));
        right
    });

    let (fields, rom) = program_rom(&plan);
    let flow = flow(&plan, &fields, &rom);
    let bits: u32 = fields.iter().map(|(_, bits)| bits).sum();
    let mut unused = 0;
    let mut counts: BTreeMap<&str, [usize; 4]> = BTreeMap::new();
    let mut survivors: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (address, word) in rom.iter().enumerate() {
        let mut above = bits;
        for (name, width) in &fields {
            above -= width;
            for bit in 0..*width {
                let flip = 1 << (above + bit);
                let differs = alone.differs(&few, address, word.code ^ flip);
                let told = format!("bit {bit} of {name} in word {address}: {}", word.text);
                if word.used & flip == 0 {
                    assert!(!differs, "counts: {told}");
                    unused += 1;
                    continue;
                }
                let is_dead = dead::is_dead(&flow, &fields, address, word.code ^ flip);
                let verdict = match (differs, is_dead) {
                    (true, false) => Verdict::Found,
                    (false, false) if alone.differs(&more, address, word.code ^ flip) => Verdict::FoundLater,
                    (false, false) => Verdict::Open,
                    (false, true) => Verdict::Dead,
                    (true, true) => panic!("proved to be dead, but found: {told}"),
                };
                counts.entry(name).or_default()[verdict as usize] += 1;
                if verdict == Verdict::Open {
                    survivors.entry(name).or_default().push(told);
                }
            }
        }
    }
    for (name, [found, later, dead, open]) in &counts {
        println!("| `{name}` | {} | {found} | {later} | {dead} | {open} |", found + later + dead + open);
    }
    for (name, of) in &survivors {
        println!("{name}: {} open\n  {}", of.len(), of.join("\n  "));
    }
    let sum = |verdict: Verdict| counts.values().map(|of| of[verdict as usize]).sum::<usize>();
    let [found, later, dead, open] =
        [Verdict::Found, Verdict::FoundLater, Verdict::Dead, Verdict::Open].map(sum);
    let count = found + later + open;
    println!(
        "{found} of {count} bits that count found by {TRIANGLES} triangles, {later} by {MORE} others, {open} open; {dead} proved to be dead, {unused} do not care"
    );
    assert!(count > 7_000 && found * 100 >= count * 93, "{found} of {count}");
}
