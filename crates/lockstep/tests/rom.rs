//! Every bit of the program of a sequenced SETUP, flipped in the ROM of its netlist: is it seen at the ports?

mod dead;
mod differences;
mod flow;
mod form;
mod known;
mod path;
mod paths;
mod range;
mod thing;
mod word;

use crate::common::triangles::{random_primitive, random_triangle};
use edgewalk_jit::Simulator;
use edgewalk_lockstep::{Triangles, Unit, netlist};
use edgewalk_machine::sequencer::{Program, rounds};
use edgewalk_machine::units::setup::SPEC;
use edgewalk_machine::{Machine, Plan, PortVertex, SetupKind};
use edgewalk_rtl::{RomWord, program_rom};
use flow::Flow;
use known::ROWS;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use range::Range;
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
        match cycle / 4096 % 4 {
            0 | 1 => true,
            2 => cycle.is_multiple_of(1024),
            _ => cycle % 4096 == 4095,
        }
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

    /// Words come at once in some stretches, and in others now and then.
    fn offers(cycle: usize) -> bool {
        (cycle / 2048).is_multiple_of(2) || (cycle * cycle / 7).is_multiple_of(3)
    }

    fn right(&self, words: &[u128]) -> Right {
        let mut right = Right { words: Vec::new(), cycles: Vec::new(), prims: Vec::new() };
        let (mut next, mut offered) = (0, Vec::new());
        let after = Cell::new(0);
        self.run(
            None,
            &mut |cycle, takes| {
                let word = words.get(next).copied().filter(|_| Alone::offers(cycle));
                next += usize::from(takes && word.is_some());
                after.set(after.get() + usize::from(next == words.len()));
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

/// A triangle with an edge of less than three sub-pixels in height about the middle of a line: its DX does not fit.
fn flat(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let middle = rng.random_range(0..plan.height as i32) * unit + unit / 2;
    let limit = ((1 << plan.guard_bits) - 1) * unit;
    // Of some the last vertex lies elsewhere: one edge of three is flat.
    let mut flats = if rng.random_bool(0.5) { 2 } else { 3 };
    random_triangle(plan, rng).map(|vertex| {
        let values: Vec<i64> = vertex.values().iter().copied().take(plan.channels().len()).collect();
        let y = if flats > 0 { middle + rng.random_range(-1..=1) } else { rng.random_range(-limit..=limit) };
        flats -= 1;
        plan.raw_vertex(rng.random_range(-limit..=limit), y, &values)
    })
}

/// A triangle without area that lines meet: its last vertex is as far behind the second as that is behind the first.
fn collinear(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let [x, y] = [plan.width, plan.height].map(|size| rng.random_range(0..size as i32) * unit);
    let [right, down] = [0, 1].map(|_| rng.random_range(-20 * unit..20 * unit));
    let mut far = 0;
    random_triangle(plan, rng).map(|vertex| {
        let values: Vec<i64> = vertex.values().iter().copied().take(plan.channels().len()).collect();
        let vertex = plan.raw_vertex(x + far * right, y + far * down, &values);
        far += 1;
        vertex
    })
}

/// A triangle of 16 sub-pixels along both sides of a right angle, whose values differ by multiples of its area.
fn right_angled(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let [x, y] = [plan.width, plan.height]
        .map(|size| rng.random_range(0..size as i32) * unit + unit / 2 - rng.random_range(0..8));
    let mut sides = [[0, 0], [16, 0], [0, 16]];
    let [a, b] = [0, 1].map(|_| rng.random_range(0..3));
    sides.swap(a, b);
    let mut side = sides.into_iter();
    random_triangle(plan, rng).map(|vertex| {
        let values = vertex.values().iter().copied().take(plan.channels().len());
        let values: Vec<i64> = values.map(|value| value & !0xff).collect();
        let [right, down] = side.next().unwrap_or_default();
        plan.raw_vertex(x + right, y + down, &values)
    })
}

/// A triangle above or below the screen.
fn outside(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let (lines, limit) = (plan.height as i32 * unit, ((1 << plan.guard_bits) - 1) * unit);
    let is_above = rng.random_bool(0.5);
    random_triangle(plan, rng).map(|vertex| {
        let values: Vec<i64> = vertex.values().iter().copied().take(plan.channels().len()).collect();
        let y = if is_above { rng.random_range(-limit..0) } else { rng.random_range(lines..=limit) };
        plan.raw_vertex(rng.random_range(-limit..=limit), y, &values)
    })
}

/// A triangle of a few sub-pixels about the middle of a pixel: values differ by more than its area.
fn tiny(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let middle = [plan.width, plan.height].map(|size| rng.random_range(0..size as i32) * unit + unit / 2);
    let reach = 1 << rng.random_range(1..6);
    random_triangle(plan, rng).map(|vertex| {
        let values: Vec<i64> = vertex.values().iter().copied().take(plan.channels().len()).collect();
        let [x, y] = middle.map(|middle| middle + rng.random_range(-reach..=reach));
        plan.raw_vertex(x, y, &values)
    })
}

/// Words of triangles, some of which are flat, tiny, right-angled, without area or beside the screen.
fn words(plan: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<u128> {
    let port = Triangles::new(plan);
    let triangle = |number| match number % 16 {
        3 | 7 | 11 => flat(plan, rng),
        5 => tiny(plan, rng),
        1 | 13 => right_angled(plan, rng),
        9 => collinear(plan, rng),
        15 => outside(plan, rng),
        _ => random_primitive(plan, rng),
    };
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
        // Behind them nothing is ever written.
        let values = vertex + 2..vertex + 2 + plan.channels().len();
        rows[values].fill(Range { low: -value, high: value, lines: false });
    }
    let words: Vec<Word> = rom.iter().map(|word| Word::new(fields, word.code)).collect();
    // What is raised does not reach the low bits of W that stand for a row of A.
    let raises = |channel: &edgewalk_machine::Channel| {
        widths.center_fraction + channel.fraction - channel.vertex_fraction
    };
    assert!(plan.channels().iter().all(|channel| raises(channel) > widths.difference));
    Flow::new(words, rounds(plan) as u32 - 1, widths.difference + 1, p, program.row("j"), rows)
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
    /// The same, by paths of both signs.
    DeadByPaths,
    Open,
}

/// One in this many dead or don't-care bits is tried with triangles too. The longer proof is tried on one in this many of
/// the bits that triangles find.
const SAMPLE: usize = 16;

/// What the bits of a word are tried with.
struct Campaign {
    few: Right,
    more: Right,
    flow: Flow,
    fields: Vec<(&'static str, u32)>,
    rom: Vec<RomWord>,
}

impl Campaign {
    /// What becomes of each bit of a word: its field, the verdict, none if it does not care, and what it is.
    fn word(&self, alone: &Alone, address: usize) -> Vec<(&'static str, Option<Verdict>, String)> {
        let word = &self.rom[address];
        let mut above: u32 = self.fields.iter().map(|(_, bits)| bits).sum();
        let mut told = Vec::new();
        for (name, width) in &self.fields {
            above -= width;
            for bit in 0..*width {
                let text = format!("bit {bit} of {name} in word {address}: {}", word.text);
                told.push((*name, self.bit(alone, address, above + bit, &text), text));
            }
        }
        told
    }

    fn bit(&self, alone: &Alone, address: usize, bit: u32, text: &str) -> Option<Verdict> {
        let word = &self.rom[address];
        let code = word.code ^ 1 << bit;
        let is_sample = (address + bit as usize).is_multiple_of(SAMPLE);
        let found = || alone.differs(&self.few, address, code);
        if word.used >> bit & 1 == 0 {
            assert!(!is_sample || !found(), "counts: {text}");
            return None;
        }
        if dead::is_dead(&self.flow, &self.fields, address, code) {
            assert!(!is_sample || !found(), "proved to be dead, but found: {text}");
            return Some(Verdict::Dead);
        }
        let found = found();
        let other = Word::new(&self.fields, code);
        let by_paths = (is_sample || !found) && paths::is_dead(&self.flow, address as u32, &other);
        let later = !found && (is_sample || !by_paths) && alone.differs(&self.more, address, code);
        assert!(!by_paths || !(found || later), "proved to be dead, but found: {text}");
        Some(match () {
            () if found => Verdict::Found,
            () if later => Verdict::FoundLater,
            () if by_paths => Verdict::DeadByPaths,
            () => Verdict::Open,
        })
    }
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
    let campaign = Campaign { few, more, flow: flow(&plan, &fields, &rom), fields, rom };
    // Two at a time, each with a simulator of its own.
    let part = |first: usize| {
        let alone = Alone::new(&plan);
        let words = (first..campaign.rom.len()).step_by(2);
        let of_word = |address: usize| {
            let told = campaign.word(&alone, address);
            let open = told.iter().filter(|told| told.1 == Some(Verdict::Open)).count();
            println!("word {address} of {}: {open} open", campaign.rom.len());
            told
        };
        words.flat_map(of_word).collect::<Vec<_>>()
    };
    let told = std::thread::scope(|scope| {
        let other = scope.spawn(|| part(1));
        let own = part(0);
        [own, other.join().expect("its panic is the test's failure")].concat()
    });
    let mut counts: BTreeMap<&str, [usize; 5]> = BTreeMap::new();
    for (name, verdict, text) in &told {
        let Some(verdict) = verdict else { continue };
        counts.entry(name).or_default()[*verdict as usize] += 1;
        if *verdict == Verdict::Open {
            println!("open: {text}");
        }
    }
    for (name, [found, later, dead, by_paths, open]) in &counts {
        let all = found + later + dead + by_paths + open;
        println!("| `{name}` | {all} | {found} | {later} | {dead} | {by_paths} | {open} |");
    }
    let sum = |verdict: Verdict| counts.values().map(|of| of[verdict as usize]).sum::<usize>();
    let [found, later, open] = [Verdict::Found, Verdict::FoundLater, Verdict::Open].map(sum);
    let [dead, by_paths] = [Verdict::Dead, Verdict::DeadByPaths].map(sum);
    let (count, unused) = (found + later + open, told.iter().filter(|told| told.1.is_none()).count());
    println!(
        "{found} of {count} bits that count found by {TRIANGLES} triangles, {later} by {MORE} others, {open} open; {dead} and {by_paths} proved to be dead, {unused} do not care"
    );
    assert!(count > 7_000 && (found + later) * 100 >= count * 99, "{found} and {later} of {count}");
}
