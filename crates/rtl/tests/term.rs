//! TERM against formula (1) of `docs/machine.md`, section 11: random words, random spans, in the clocks that are said there.

use crate::random;
use std::collections::VecDeque;

use edgewalk_machine::{Plan, Record, Walk};
use edgewalk_netlist::Simulator;
use edgewalk_rtl as rtl;
use rand::{Rng, RngCore, SeedableRng};
use rand_pcg::Pcg64Mcg;

const MACHINES: usize = 60;
const TRIANGLES: usize = 12;

/// The first pixel of a span.
#[derive(Clone, Copy)]
struct Pixel {
    x: i64,
    y: i64,
}

fn set(sim: &mut Simulator, name: &str, value: i64) {
    let id = sim.input(name).unwrap_or_else(|_| panic!("no input {name}"));
    sim.set(id, value as u128);
}

fn get(sim: &mut Simulator, name: &str) -> u128 {
    sim.get(name).unwrap_or_else(|_| panic!("no port {name}"))
}

/// A machine with TERM; the fields' other numbers at random.
fn machine(rng: &mut Pcg64Mcg) -> Plan {
    loop {
        let plan = random::random_plan(rng);
        if plan.shade.is_there() {
            return plan;
        }
    }
}

fn signed(value: i64, bits: u32) -> i128 {
    i128::from(value << (64 - bits) >> (64 - bits))
}

/// V, X and XX of a term at a pixel, by formula (1).
fn words(plan: &Plan, record: &Record, leftward: bool, at: Pixel, term: usize) -> [u128; 3] {
    let columns = signed(at.x - i64::from(record.x), plan.widths().column);
    let i = signed(if leftward { -columns } else { columns } as i64, plan.widths().column);
    let n = i128::from((at.y - i64::from(record.y)) & ((1 << plan.widths().y) - 1));
    let [v, x, y, xx, xy, yy] = record.terms[term].map(i128::from);
    let [xx, xy, yy] = if plan.terms()[term].degree == 2 { [xx, xy, yy] } else { [0; 3] };
    let halves = |k: i128| k * (k - 1) / 2;
    let sum = [(1, v), (i, x), (n, y), (halves(i), xx), (halves(n), yy), (i * n, xy)];
    let all =
        |sum: &[(i128, i128)]| sum.iter().fold(0, |all: i128, (k, w)| all.wrapping_add(k.wrapping_mul(*w)));
    let mask = u128::MAX >> (128 - plan.terms()[term].word());
    [all(&sum), all(&[(1, x), (i, xx), (n, xy)]), xx].map(|word| word as u128 & mask)
}

/// Clocks of the walk from one pixel to another.
fn clocks(plan: &Plan, from: Pixel, to: Pixel, leftward: bool) -> u64 {
    let down = (to.y - from.y) & ((1 << plan.widths().y) - 1);
    let along = signed(to.x - from.x, plan.widths().column) as i64;
    let ahead = if leftward { -along } else { along };
    let (forward, back) = (ahead.max(0), (-ahead).max(0));
    let operations: i64 = plan.terms().iter().map(|term| 1 + 2 * (i64::from(term.degree) - 1)).sum();
    let clocks = match plan.shade.walk {
        Walk::Register => down + forward + 2 * back,
        Walk::Memory if down + forward + back == 0 => 0,
        Walk::Memory => operations * (down + forward + back) + 1,
    };
    clocks as u64
}

/// The rig around TERM: a memory that takes a read in every cycle, a taker that always takes.
struct Rig {
    sim: Simulator,
    memory: Vec<u64>,
    reads: VecDeque<(u64, u64)>,
    cycle: u64,
}

impl Rig {
    /// Offers a span until it is taken: the cycles that took, before the one in which it went.
    fn span(&mut self, plan: &Plan, at: Pixel, fresh: bool, leftward: bool, record: i64) -> u64 {
        let offered = self.cycle;
        let values = [
            ("span_valid", 1),
            ("span_x", at.x & ((1 << plan.widths().column) - 1)),
            ("span_y", at.y),
            ("span_fresh", fresh.into()),
            ("span_leftward", leftward.into()),
            ("inc_record", record),
            ("walked_ready", 1),
            ("trd_ready", 1),
        ];
        for (name, value) in values {
            set(&mut self.sim, name, value);
        }
        loop {
            let word = self.reads.front().filter(|(due, _)| *due <= self.cycle).map(|(_, word)| *word);
            set(&mut self.sim, "tdata_valid", word.is_some().into());
            set(&mut self.sim, "tdata_word", word.unwrap_or(0) as i64);
            if get(&mut self.sim, "walked_valid") == 1 {
                return self.cycle - offered;
            }
            assert_eq!(get(&mut self.sim, "term_wait"), 1);
            if word.is_some() {
                assert_eq!(get(&mut self.sim, "tdata_ready"), 1);
                self.reads.pop_front();
            }
            if get(&mut self.sim, "trd_valid") == 1 {
                let addr = get(&mut self.sim, "trd_addr") as usize;
                self.reads.push_back((self.cycle + u64::from(plan.shade.term_latency), self.memory[addr]));
            }
            self.tick();
            assert!(self.cycle - offered < 100_000, "the walk does not come there");
        }
    }

    fn tick(&mut self) {
        self.sim.tick();
        self.cycle += 1;
    }
}

#[test]
fn words_are_those_of_the_formula_in_the_clocks_that_are_said() {
    let mut rng = Pcg64Mcg::seed_from_u64(51);
    let (mut words_checked, mut walks) = (0, [0; 2]);
    for _ in 0..MACHINES {
        let plan = machine(&mut rng);
        walks[plan.shade.walk as usize] += 1;
        let netlist = rtl::term(&plan).unwrap_or_else(|errors| panic!("{plan:?}\n{errors}"));
        let mut rig = Rig {
            sim: Simulator::new(&netlist),
            memory: vec![0; 1 << (plan.shade.record_bits + plan.record_place_bits())],
            reads: VecDeque::new(),
            cycle: 0,
        };
        set(&mut rig.sim, "rst", 1);
        rig.sim.tick();
        set(&mut rig.sim, "rst", 0);
        let lines = 1 << plan.widths().y;
        for _ in 0..TRIANGLES {
            let number = rng.random_range(0..1usize << plan.shade.record_bits);
            let leftward = rng.random_bool(0.5);
            let mut at = Pixel { x: rng.random_range(-9..40), y: rng.random_range(0..lines) };
            let record = Record {
                gloss: rng.random_range(0..=plan.shade.gloss_bits),
                x: at.x as i32,
                y: at.y as u32,
                material: rng.random_range(0..1 << plan.shade.material_bits),
                terms: plan.terms().iter().map(|_| std::array::from_fn(|_| rng.next_u64())).collect(),
            };
            let place = number << plan.record_place_bits();
            let stored = plan.record_words(&record);
            rig.memory[place..place + stored.len()].copy_from_slice(&stored);
            let reading = u64::from(plan.record_length() + plan.shade.term_latency) + 1;
            for k in 0..rng.random_range(1..6) {
                let to = Pixel {
                    x: at.x + if rng.random_bool(0.7) { rng.random_range(-6..=6) } else { 0 },
                    y: (at.y + if rng.random_bool(0.7) { rng.random_range(0..4) } else { 0 }) % lines,
                };
                let took = rig.span(&plan, to, k == 0, leftward, number as i64);
                let read = if k == 0 { reading } else { 0 };
                assert_eq!(took, read + clocks(&plan, at, to, leftward), "clocks, {plan:?}");
                for (place, term) in plan.terms().iter().enumerate() {
                    let wanted = words(&plan, &record, leftward, to, place);
                    let parts = &["v", "g", "gg"][..1 + term.degree as usize];
                    for (part, wanted) in parts.iter().zip(wanted) {
                        let found = get(&mut rig.sim, &format!("walked_{}_{part}", term.name));
                        assert_eq!(found, wanted, "{} {part}, {plan:?}", term.name);
                        words_checked += 1;
                    }
                }
                if plan.shade.normalises() {
                    assert_eq!(get(&mut rig.sim, "walked_gloss"), record.gloss.into(), "gloss, {plan:?}");
                    words_checked += 1;
                }
                if plan.shade.material_bits > 0 {
                    assert_eq!(get(&mut rig.sim, "walked_material"), record.material.into());
                }
                rig.tick();
                at = to;
            }
        }
    }
    println!("{words_checked} words of {MACHINES} machines, {walks:?} that walk in registers, in memory");
    assert!(words_checked > 10_000 && walks.iter().all(|machines| *machines > MACHINES / 4));
}
