//! What changes to a sequenced SETUP's program would gain: measurements, for `docs/synthesis.md`.

use crate::common::{Triangle, any_triangle, random_triangle};
use crate::sequencer::of_scene;
use edgewalk_machine::sequencer::Program;
use edgewalk_machine::sequencer::word::Control;
use edgewalk_machine::{MAX_CHANNELS, Machine, Plan, PortVertex};
use edgewalk_model::setup::sequencer::SlowSetup;
use edgewalk_model::tokens::Prim;
use edgewalk_scene::Scene;
use rand::{SeedableRng, rngs::StdRng};

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
        let front = SlowSetup::with(&plan, ends_at_channels(&plan));
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

/// Digits of both factors of a sum, and how many of them are not 0 in both; a sign's digit and what repeats it count as none.
fn digits(factors: [i64; 2]) -> (u32, u32) {
    let left = factors.map(|f| 64 - (f ^ (f >> 63)).leading_zeros()).into_iter().max().expect("two").max(1);
    let both_zero = (0..left).filter(|bit| factors.iter().all(|f| f >> bit & 1 == 0)).count() as u32;
    (left, left - both_zero)
}

/// Clocks that the sums gx and d0 of a triangle would save where the numbers of every lane leave room: there |dc| times 2^n
/// is below M, n digits may be added without bringing the sum back below M, and a digit takes one clock in place of three.
/// Rounds that have this room in both sums, and rounds.
fn room(plan: &Plan, triangle: &Triangle, prim: &Prim<MAX_CHANNELS>) -> (u32, u32, u32) {
    let mut order = *triangle;
    order.sort_by_key(|vertex| vertex.y()); // stable: of equal lines the earlier first
    let unit = plan.widths().center_fraction - plan.subpixel_bits;
    let [x, y] = [PortVertex::x, PortVertex::y].map(|of| order.each_ref().map(|v| i64::from(of(v)) << unit));
    let [du1, du2, dv1, dv2] = [x[1] - x[0], x[2] - x[0], y[1] - y[0], y[2] - y[0]];
    let q = i64::from(prim.major.q);
    let area = (du1 * dv2 - du2 * dv1).unsigned_abs();
    let sums = [digits([dv2, dv1]), digits([q * dv2 - du2, q * dv1 - du1])];
    let (mut saved, mut roomy, mut rounds) = (0, 0, 0);
    for round in plan.channels().iter().enumerate().collect::<Vec<_>>().chunks(plan.lanes as usize) {
        let largest = |place: usize| {
            let [a, b, c] = order.each_ref().map(|vertex| vertex.values()[place]);
            [a - b, b - c, c - a].map(i64::unsigned_abs).into_iter().max().expect("three")
        };
        let dc = round.iter().map(|(place, _)| largest(*place)).max().expect("a channel");
        // M grows eightfold until the differences fit.
        let m = std::iter::successors(Some(area), |m| Some(m * 8)).find(|m| *m > dc).expect("an area");
        let fit = sums.map(|(left, _)| u128::from(dc) << left < u128::from(m));
        saved += fit.iter().zip(sums).map(|(fit, (_, added))| if *fit { 2 * added } else { 0 }).sum::<u32>();
        roomy += u32::from(fit == [true; 2]);
        rounds += 1;
    }
    (saved, roomy, rounds)
}

/// What two other changes would gain, mean clocks a triangle: sums that stay above M while there is room, and the three
/// products of the shear on three lanes. `docs/synthesis.md` has the figures:
/// `cargo test --release -p edgewalk-model --test suites -- --ignored room_and_shear_are_measured --nocapture`
#[test]
#[ignore = "a measurement"]
fn room_and_shear_are_measured() {
    const COUNT: usize = 6000;
    for lanes in [1, 2, 4] {
        let plan = Machine { lanes, ..Machine::default() }.plan().expect("can be built");
        let slow = SlowSetup::new(&plan);
        let front = SlowSetup::with(&plan, ends_at_channels(&plan));
        let one_product = SlowSetup::with(&plan, one_product_of_shear(&plan));
        let mut rng = StdRng::seed_from_u64(lanes.into());
        let knot = of_scene(&plan, &Scene::builtin("torus-knot").expect("a scene"));
        let sets: [(&str, Vec<Triangle>); 3] = [
            ("small", (0..COUNT).map(|_| random_triangle(&plan, 6.0, &mut rng)).collect()),
            ("of all sizes", (0..COUNT).map(|_| any_triangle(&plan, &mut rng)).collect()),
            ("of torus-knot", knot),
        ];
        for (name, triangles) in sets {
            let (mut clocks, mut sums, mut shear, mut roomy, mut rounds, mut drawn) = (0, 0, 0, 0, 0, 0);
            for triangle in &triangles {
                let of =
                    |setup: &SlowSetup| setup.run::<MAX_CHANNELS>(triangle, false).expect("the program ends");
                let ran = of(&slow);
                if ran.culled.is_some() {
                    continue;
                }
                let (saved, with_room, all) = room(&plan, triangle, &ran.prim);
                clocks += ran.clocks + ran.load;
                sums += saved;
                shear += of(&front).clocks - of(&one_product).clocks;
                (roomy, rounds, drawn) = (roomy + with_room, rounds + all, drawn + 1);
            }
            let mean = |sum: u32| f64::from(sum) / f64::from(drawn);
            println!(
                "{lanes} lanes, {drawn} triangles {name}: {:.0} clocks; sums {:.0} less, room in {:.1} % of {rounds} rounds; shear {:.0} less",
                mean(clocks),
                mean(sums),
                100.0 * f64::from(roomy) / f64::from(rounds),
                mean(shear)
            );
            assert!(drawn as usize > COUNT / 2 && shear > 0);
        }
    }
}

/// The program that ends where the channels begin.
fn ends_at_channels(plan: &Plan) -> Program {
    let mut program = Program::of(plan);
    let place = |name: &str| program.labels().find(|(label, _)| *label == name).expect("a label").1;
    let (round, ready) = (place("round"), place("ready"));
    program.words[usize::from(round)].control = Control::Goto(ready);
    program
}

/// That program with the first product of the shear alone: the other two are as long, as q has the digits of all.
fn one_product_of_shear(plan: &Plan) -> Program {
    let mut program = ends_at_channels(plan);
    let texts: Vec<&str> = program.words.iter().map(|word| word.text.trim()).collect();
    let products: Vec<usize> = (0..texts.len()).filter(|i| texts[*i].starts_with("factor f q")).collect();
    let [_, second, _] = products[..] else { panic!("three products, found {products:?}") };
    let behind = texts.iter().position(|text| text.starts_with("sub half -> tmp")).expect("its end");
    program.words[second - 1].control = Control::Goto(behind as u16);
    program
}
