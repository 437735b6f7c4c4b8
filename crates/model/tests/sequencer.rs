//! The program of a sequenced SETUP, run word by word, against what the closed formulae of section 2 give: lines, edges
//! and channels of triangles of all kinds, with 1, 2 and 4 lanes.

use crate::common::{Triangle, any_triangle, random_machine, random_triangle};
use edgewalk_machine::sequencer::Program;
use edgewalk_machine::sequencer::word::{Base, Control, Only, Sign, Word};
use edgewalk_machine::{EdgeKind, Fill, MAX_CHANNELS, Machine, Plan, SetupKind};
use edgewalk_model::setup::sequencer::SlowSetup;
use edgewalk_model::setup::{Setup, SetupClocks};
use edgewalk_model::tokens::{EdgeWalk, Prim};
use edgewalk_model::{Culled, Events, longest_setup, setup_clocks};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// What the formulae give, and why the triangle is culled: an edge that is not walked has M = 0 in a sequenced SETUP.
fn by_formulae(plan: &Plan, triangle: &Triangle, light_pass: bool) -> (Option<Prim<MAX_CHANNELS>>, [u64; 3]) {
    let mut setup = Setup::new(plan);
    let events = &mut Events::default();
    setup.step(Some((triangle, 0)), false, light_pass, events);
    while setup.prim().is_none() && !setup.tri_ready() {
        setup.step(None, false, light_pass, events);
    }
    let prim = setup.prim().map(|prim| {
        let mut prim = Prim { source: Default::default(), kt: 0, record: 0, ..*prim };
        for (edge, lines) in prim.minor.iter_mut().zip(prim.lines) {
            if lines == 0 {
                *edge = EdgeWalk::default();
            }
        }
        prim
    });
    (prim, [events.setup.culled_lines, events.setup.culled_columns, events.setup.culled_area])
}

#[derive(Default)]
struct Seen {
    checked: usize,
    culled: [u64; 3],
    clocks: u64,
    most: u32,
}

impl Seen {
    fn check(&mut self, plan: &Plan, count: usize, rng: &mut StdRng) {
        let slow = SlowSetup::new(plan);
        let sequenced =
            plan.with(|m| m.setup_kind = SetupKind::Sequenced).plan().expect("any fill and edges");
        for _ in 0..count {
            let triangle = any_triangle(plan, rng);
            let light_pass = plan.shadow.draws_map() && rng.random_bool(0.5);
            let (prim, culled) = by_formulae(plan, &triangle, light_pass);
            let ran = slow.run::<MAX_CHANNELS>(&triangle, light_pass).expect("the program ends");
            let context = || format!("{triangle:?} on {plan:?}");
            if !light_pass {
                // Counted without running the program, as the machine's model does.
                let SetupClocks { phase1, phase2 } = setup_clocks(&sequenced, &triangle);
                assert_eq!([phase1, phase2], [ran.clocks, ran.load], "S and L of {}", context());
                let longest = longest_setup(&sequenced);
                assert!(ran.clocks <= longest.phase1 && ran.load <= longest.phase2, "longest: {}", context());
            }
            assert_eq!(ran.early, 0, "rows and checks are waited for: {}", context());
            let causes = [Culled::Lines, Culled::Columns, Culled::Area];
            assert_eq!(causes.map(|cause| u64::from(ran.culled == Some(cause))), culled, "{}", context());
            if let Some(prim) = prim {
                assert_eq!(ran.prim, prim, "{}", context());
                self.clocks += u64::from(ran.clocks + ran.load);
                self.most = self.most.max(ran.clocks + ran.load);
            }
            for (all, one) in self.culled.iter_mut().zip(culled) {
                *all += one;
            }
            self.checked += 1;
        }
    }

    fn report(&self, name: &str, textbook: bool) {
        let drawn = self.checked as u64 - self.culled.iter().sum::<u64>();
        println!(
            "{name}: {} triangles equal, culled by lines, columns, area {:?}, mean {:.0} clocks, at most {}",
            self.checked,
            self.culled,
            self.clocks as f64 / drawn as f64,
            self.most
        );
        let [lines, columns, area] = self.culled;
        assert!(lines > 0 && area > 0 && (columns > 0 || textbook), "{:?}", self.culled);
        assert!(2 * drawn > self.checked as u64, "more than half are drawn");
    }
}

const KINDS: [(&str, &str, Fill, EdgeKind); 4] = [
    ("exact", "exact", Fill::Exact, EdgeKind::Exact),
    ("exact", "slope", Fill::Exact, EdgeKind::Slope),
    ("textbook", "exact", Fill::Textbook, EdgeKind::Exact),
    ("textbook", "slope", Fill::Textbook, EdgeKind::Slope),
];

fn campaign(count: usize) {
    const RANDOM: usize = 20;
    let mut all = 0;
    for lanes in [1, 2, 4] {
        let mut rng = StdRng::seed_from_u64(lanes.into());
        let lanes_key = lanes.to_string();
        let common =
            [("setup.kind", "parallel"), ("polygon.lines", "no"), ("setup.lanes", lanes_key.as_str())];
        let share = count / 24;
        for (fill_name, edge_name, fill, edge_kind) in KINDS {
            let mut own = Seen::default();
            let subpixel_bits = if fill == Fill::Textbook { 0 } else { 8 };
            let plan = Machine { lanes, fill, edge_kind, subpixel_bits, ..Machine::default() }.plan();
            own.check(&plan.expect("can be built"), share, &mut rng);
            own.report(
                &format!("{lanes} lanes, {fill_name} fill, {edge_name} edges, default formats"),
                fill == Fill::Textbook,
            );
            let mut others = Seen::default();
            for _ in 0..RANDOM {
                let kinds = [("edge.fill", fill_name), ("edge.kind", edge_name)];
                let settings = [common.as_slice(), &kinds].concat();
                others.check(&random_machine(&settings, &mut rng), share.div_ceil(RANDOM), &mut rng);
            }
            others.report(
                &format!("{lanes} lanes, {fill_name} fill, {edge_name} edges, random machines"),
                fill == Fill::Textbook,
            );
            all += own.checked + others.checked;
        }
    }
    let least = 24 * (count / 24);
    println!("checked {all} / at least {least} triangles");
    assert!(all >= least);
}

#[test]
fn program_gives_what_the_formulae_say() {
    campaign(12_000);
}

/// `cargo test --release -p edgewalk-model -- --ignored program_gives_the_same_on_many_triangles --nocapture`
#[test]
#[ignore = "a campaign of minutes"]
fn program_gives_the_same_on_many_triangles() {
    campaign(100_000);
}

/// The word with one part altered, each part in turn.
fn altered(word: &Word) -> Vec<Word> {
    let mut all = Vec::new();
    let mut push = |change: &dyn Fn(&mut Word)| {
        let mut other = word.clone();
        change(&mut other);
        if other != *word {
            all.push(other);
        }
    };
    push(&|word| word.step = None);
    push(&|word| word.write = None);
    push(&|word| word.give = None);
    push(&|word| word.act = None);
    push(&|word| word.factor = None);
    push(&|word| word.control = Control::Next);
    for base in [Base::Nothing, Base::Same, Base::Twice, Base::Masked] {
        push(&|word| word.step.iter_mut().for_each(|step| step.base = base));
    }
    for sign in [Sign::Plus, Sign::Minus, Sign::ByA, Sign::PlusBySide, Sign::MinusBySide] {
        push(&|word| word.step.iter_mut().for_each(|step| step.sign = sign));
    }
    for only in [Only::Always, Only::Negative, Only::Positive, Only::NoUpper, Only::Right] {
        push(&|word| word.step.iter_mut().for_each(|step| step.only = only));
    }
    all
}

/// Each part of each word, altered, changes a result or a time of one of these triangles, but for those that are printed.
/// Many of these cannot be seen: the sign of a row of zero, the base of a word behind a load, a step that is repeated.
/// Three of four alterations are to be found.
#[test]
fn altered_words_of_program_are_found() {
    const TRIANGLES: usize = 200;
    let plan = Machine { lanes: 1, ..Machine::default() }.plan().expect("can be built");
    let mut rng = StdRng::seed_from_u64(7);
    let triangles: Vec<Triangle> = (0..TRIANGLES).map(|_| any_triangle(&plan, &mut rng)).collect();
    let program = Program::of(&plan);
    let results = |program: Program| {
        let slow = SlowSetup::with(&plan, program);
        let triangles = triangles.clone();
        triangles.into_iter().map(move |triangle| {
            let ran = slow.run::<MAX_CHANNELS>(&triangle, false)?;
            Some((ran.culled.is_none().then_some(ran.prim), ran.culled, ran.clocks, ran.early))
        })
    };
    let right: Vec<_> = results(program.clone()).collect();
    let (mut made, mut survivors) = (0, Vec::new());
    for (place, word) in program.words.iter().enumerate() {
        for other in altered(word) {
            let mut wrong = program.clone();
            wrong.words[place] = other;
            made += 1;
            if results(wrong).zip(&right).all(|(found, right)| found == *right) {
                survivors.push(format!("{place}: {}", word.text));
            }
        }
    }
    println!("{} of {made} alterations found; not:\n{}", made - survivors.len(), survivors.join("\n"));
    assert!(made > 2000, "{made} alterations");
    assert!(survivors.len() * 4 < made, "{} of {made} are not found", survivors.len());
}

/// Clocks up to the first round of channels, and from there on, of a triangle that is not culled.
fn halves(slow: &SlowSetup, front: &SlowSetup, triangle: &Triangle) -> Option<[u32; 2]> {
    let of = |setup: &SlowSetup| setup.run::<MAX_CHANNELS>(triangle, false).expect("the program ends");
    let whole = of(slow);
    let before = of(front).clocks;
    whole.culled.is_none().then(|| [before, whole.clocks + whole.load - before])
}

/// What a second sequencer would gain that does front and edges of the next triangle beside the channels of this one: the
/// longer of both halves in the place of their sum. `docs/synthesis.md` has the figures:
/// `cargo test --release -p edgewalk-model --test suites -- --ignored overlap_of_front_and_channels --nocapture`
#[test]
#[ignore = "a measurement"]
fn overlap_of_front_and_channels_is_measured() {
    const COUNT: usize = 6000;
    for lanes in [1, 2, 4] {
        let plan = Machine { lanes, ..Machine::default() }.plan().expect("can be built");
        let slow = SlowSetup::new(&plan);
        let mut program = Program::of(&plan);
        let place = |name: &str| program.labels().find(|(label, _)| *label == name).expect("a label").1;
        let (round, ready) = (place("round"), place("ready"));
        program.words[usize::from(round)].control = Control::Goto(ready);
        let front = SlowSetup::with(&plan, program);
        let mut rng = StdRng::seed_from_u64(lanes.into());
        for (name, size) in [("small", Some(6.0)), ("of all sizes", None)] {
            let (mut sums, mut longer, mut drawn) = ([0; 2], 0, 0);
            for _ in 0..COUNT {
                let triangle = match size {
                    Some(size) => random_triangle(&plan, size, &mut rng),
                    None => any_triangle(&plan, &mut rng),
                };
                let Some([before, behind]) = halves(&slow, &front, &triangle) else { continue };
                sums[0] += u64::from(before);
                sums[1] += u64::from(behind);
                longer += u64::from(before.max(behind));
                drawn += 1;
            }
            let mean = |sum: u64| sum as f64 / f64::from(drawn);
            let both = mean(sums[0] + sums[1]);
            println!(
                "{lanes} lanes, {drawn} triangles {name}: {:.0} + {:.0} = {both:.0} clocks, the longer {:.0}, {:.2} times as fast",
                mean(sums[0]),
                mean(sums[1]),
                mean(longer),
                both / mean(longer)
            );
            assert!(drawn > COUNT as u32 / 2 && mean(longer) < both);
        }
    }
}
