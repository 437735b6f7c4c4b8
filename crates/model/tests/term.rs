//! TERM: every word of every pixel is that of formula (1), in both walks; the clocks of its steps; what it costs.

use crate::common::shade::{leftward, random_shading, words};
use crate::common::{ALWAYS, Triangle, machine, random_machine, random_triangle, watch};
use edgewalk_machine::{Activity, Plan, Walk};
use edgewalk_model::term::Term;
use edgewalk_model::tokens::{MAX_CHANNELS, Span};
use edgewalk_model::{Events, Rig, Shading, Stalls, WordIn};
use rand::{Rng, SeedableRng, rngs::StdRng};

const C: usize = MAX_CHANNELS;

/// The machine with these triangles, their records and tables, before its first cycle.
fn rig(plan: &Plan, shading: &Shading, stalls: Stalls) -> Rig<C> {
    let mut rig = Rig::<C>::new(plan, ALWAYS, stalls);
    rig.memories.write_shading(plan, shading);
    rig
}

/// Compares the words at every pixel that PIXEL stands at, on the screen or off; their number, and events.
fn words_of_all_pixels(
    plan: &Plan,
    triangles: &[Triangle],
    shading: &Shading,
    stalls: Stalls,
) -> (u64, Events) {
    let mut rig = rig(plan, shading, stalls);
    let mut pixels = 0;
    let mut before = None;
    watch(&mut rig, triangles, &mut |_, model, _| {
        let pixel = &model.pixel;
        let id = pixel.source().id as usize;
        let here = pixel.active().then(|| (id, pixel.place()));
        if let Some((id, (x, y))) = here {
            let leftward = leftward(plan, &triangles[id]);
            let wanted = words(plan, &shading.records[id], leftward, (x.into(), y.into()));
            for ((term, found), wanted) in plan.terms().iter().zip(pixel.walked().terms).zip(wanted) {
                let found = found.v & (u64::MAX >> (64 - term.word()));
                assert_eq!(found, wanted, "{} of triangle {id} at {x}, {y} of {plan:?}", term.name);
            }
            assert_eq!(pixel.walked().material, shading.records[id].material, "of triangle {id}");
            pixels += u64::from(here != before);
        }
        before = here;
    });
    assert!(rig.model.counters().add_up());
    (pixels, rig.model.events().clone())
}

#[test]
fn every_word_is_that_of_the_formula() {
    let mut rng = StdRng::seed_from_u64(31);
    let (mut pixels, mut drawn, mut events) = (0, 0, Events::default());
    let mut widths = std::collections::BTreeSet::new();
    for number in 0..200u32 {
        let walk = ["register", "memory"][number as usize % 2];
        // Every length of word from 10 bits to 64.
        let (table, gloss) = (8 + number % 3, number % 9);
        let fraction = (number * 7 % 45).to_string();
        let (table, gloss) = (table.to_string(), gloss.to_string());
        let fixed = [
            ("shade.kind", if number % 5 == 0 { "phong" } else { "fast-phong" }),
            ("shade.table_bits", &table),
            ("shade.gloss_bits", &gloss),
            ("texture.kind", if number % 7 == 0 { "nearest" } else { "none" }),
            ("texture.bits", "3"),
            ("term.walk", walk),
            ("term.fraction", &fraction),
            ("term.record_bits", "6"),
            ("screen.width", "61"),
            ("screen.height", "47"),
            ("screen.guard_bits", "8"),
        ];
        let plan = random_machine(&fixed, &mut rng);
        widths.extend(plan.terms().iter().map(|term| term.word()));
        let triangles: Vec<Triangle> = (0..50)
            .map(|_| {
                let size = 2f64.powf(rng.random_range(0.0..7.0));
                random_triangle(&plan, size, &mut rng)
            })
            .collect();
        let shading = random_shading(&plan, &triangles, &mut rng);
        let stalls = if number % 3 == 0 {
            Stalls { seed: number.into(), rd: 60, data: 60, wr: 60 }
        } else {
            Stalls::NONE
        };
        let (seen, met) = words_of_all_pixels(&plan, &triangles, &shading, stalls);
        pixels += seen;
        drawn += triangles.len();
        events.merge(&met);
    }
    let ends = (widths.first().copied().unwrap_or(0), widths.last().copied().unwrap_or(0));
    println!(
        "{drawn} triangles, {pixels} pixels, words of {} lengths, {ends:?} bits: 0 differ from formula (1)",
        widths.len()
    );
    assert!(drawn == 10_000 && pixels > 700_000);
    assert!(ends.0 < 11 && ends.1 >= 62 && widths.len() > 40);
    for (name, count) in events.counts() {
        let of_term = edgewalk_machine::units::term::SPEC.events.iter().any(|event| event.name == name);
        assert!(!of_term || count > 0, "{name} was not met");
    }
}

/// The walk only steps down: below the reference pixel's line it goes once round all of its lines, and counts on from there.
#[test]
fn walk_counts_lines_down_from_its_reference() {
    let mut rng = StdRng::seed_from_u64(47);
    let mut pixels = 0;
    for walk in ["register", "memory"] {
        let plan = machine(&[
            ("shade.kind", "fast-phong"),
            ("term.walk", walk),
            ("screen.width", "61"),
            ("screen.height", "47"),
        ]);
        let triangles = [random_triangle(&plan, 40.0, &mut rng)];
        for below in [0, 1, 5, 20] {
            let mut shading = random_shading(&plan, &triangles, &mut rng);
            let record = shading.records[0].clone();
            let first = first_line(&plan, &triangles, &shading);
            shading.records[0].y = first + below;
            let lines = 1u32 << plan.widths().y;
            let mut rig = rig(&plan, &shading, Stalls::NONE);
            watch(&mut rig, &triangles, &mut |_, model, _| {
                let pixel = &model.pixel;
                if pixel.active() {
                    let (x, y) = pixel.place();
                    let n = (lines - below) % lines + (y - first);
                    let of_zero = edgewalk_machine::Record { y: 0, ..record.clone() };
                    let leftward = leftward(&plan, &triangles[0]);
                    let wanted = words(&plan, &of_zero, leftward, (x.into(), n.into()));
                    for ((term, found), wanted) in plan.terms().iter().zip(pixel.walked().terms).zip(wanted) {
                        let found = found.v & (u64::MAX >> (64 - term.word()));
                        assert_eq!(found, wanted, "{walk}: {} at {x}, {y}, {below} below", term.name);
                    }
                    pixels += 1;
                }
            });
        }
    }
    println!("{pixels} cycles of pixels: every word is that of formula (1) with the lines that were walked");
    assert!(pixels > 1000, "{pixels}");
}

/// The first line on which PIXEL stands.
fn first_line(plan: &Plan, triangles: &[Triangle], shading: &Shading) -> u32 {
    let (mut rig, mut first) = (rig(plan, shading, Stalls::NONE), None);
    watch(&mut rig, triangles, &mut |_, model, _| {
        let pixel = &model.pixel;
        if pixel.active() {
            first.get_or_insert(pixel.place().1);
        }
    });
    first.expect("the triangle covers a pixel")
}

/// A span at a place, fresh or not.
fn span(x: i32, y: u32, leftward: bool, fresh: bool) -> Span<C> {
    Span { x, y, leftward, fresh, count: 1, ..Span::default() }
}

/// Cycles until the span is there, from the one in which it is offered, counted from 0; then it is taken.
fn wait(unit: &mut Term, span: &Span<C>, memory: &mut Vec<(u64, u64)>, events: &mut Events) -> u64 {
    for cycle in 0..100_000 {
        if unit.there(Some(span)) {
            unit.step(Some(span), &WordIn::NONE, true, events);
            return cycle;
        }
        let due = |(due, _): &&(u64, u64)| *due <= cycle;
        let word = memory.first().filter(due).map(|(_, word)| u128::from(*word));
        let read = unit.read(0);
        unit.step(Some(span), &WordIn { ready: true, word }, false, events);
        if word.is_some() {
            memory.remove(0);
        }
        if let Some(addr) = read {
            memory.push((cycle + 3, if addr < 2 { 20 } else { addr.into() })); // latency 3, reference pixel 20, 20
        }
    }
    panic!("never there");
}

#[test]
fn steps_take_the_clocks_that_the_specification_says() {
    let mut checked = 0;
    for (walk, lights) in [("register", 1u64), ("register", 2), ("memory", 1), ("memory", 2)] {
        let count = lights.to_string();
        let plan = machine(&[("shade.kind", "fast-phong"), ("term.walk", walk), ("shade.lights", &count)]);
        let (mut unit, mut events, mut memory) = (Term::new(&plan), Events::default(), Vec::new());
        let length = u64::from(plan.record_length());
        assert_eq!(length, 3 + 12 * lights);
        let operations = 6 * lights;
        // The record, and no step: begin, the words, the latency, and one.
        assert_eq!(wait(&mut unit, &span(20, 20, false, true), &mut memory, &mut events), length + 3 + 1);
        let mut at = (20i32, 20u32);
        // Lines that were dropped between, spans of one pixel, both directions, an end at the start.
        for (x, y, left) in [
            (20, 21, false),
            (25, 21, false),
            (25, 21, false),
            (22, 24, false),
            (20, 24, true),
            (23, 27, true),
            (-3, 27, true),
        ] {
            let ahead = if left { at.0 - x } else { x - at.0 };
            let (down, across) = (u64::from(y - at.1), u64::from(ahead.unsigned_abs()));
            let steps = down + across;
            let law = match (plan.shade.walk, ahead < 0) {
                (Walk::Register, false) => steps,
                (Walk::Register, true) => down + 2 * across,
                (Walk::Memory, _) if steps == 0 => 0,
                (Walk::Memory, _) => operations * steps + 1,
            };
            let found = wait(&mut unit, &span(x, y, left, false), &mut memory, &mut events);
            assert_eq!(found, law, "{walk}, {lights} lights, from {at:?} to {x}, {y}");
            at = (x, y);
            checked += 1;
        }
    }
    println!("{checked} ways of the walk take the clocks of the specification");
    assert_eq!(checked, 28);
}

/// Clocks a pixel that drawing and the walk take, beside what a triangle of this size cost in the design.
#[test]
fn clocks_a_pixel_by_size() {
    let mut rng = StdRng::seed_from_u64(7);
    println!("size, px: pixels, clocks a pixel: register (walk alone) / memory (walk alone)");
    for (low, high) in [(4.0, 8.0), (8.0, 16.0), (16.0, 32.0), (32.0, 64.0), (64.0, 128.0), (128.0, 300.0)] {
        let mut line = String::new();
        for walk in ["register", "memory"] {
            let plan = machine(&[("shade.kind", "fast-phong"), ("term.walk", walk)]);
            let triangles: Vec<Triangle> =
                (0..200).map(|_| random_triangle(&plan, rng.random_range(low..high), &mut rng)).collect();
            let shading = at_the_top(&plan, &triangles, random_shading(&plan, &triangles, &mut rng));
            let mut rig = rig(&plan, &shading, Stalls::NONE);
            watch(&mut rig, &triangles, &mut |_, _, _| ());
            let counters = rig.model.counters();
            let (pixels, walks) = (counters.busy() as f64, counters.spent(Activity::Term) as f64);
            line += &format!(
                " {:8.0} {:.3} ({:.1} a triangle)",
                pixels,
                1.0 + walks / pixels,
                walks / counters.triangles as f64
            );
            assert!(counters.add_up() && walks > 0.0);
        }
        println!("{low:4} to {high:4}: {line}");
    }
}

/// The same with the reference pixel at the topmost vertex.
fn at_the_top(plan: &Plan, triangles: &[Triangle], shading: Shading) -> Shading {
    let one = 1 << plan.subpixel_bits;
    let records = shading.records.into_iter().zip(triangles).map(|(record, triangle)| {
        let top = triangle.iter().min_by_key(|v| v.y()).expect("three");
        let (x, y) = (top.x().div_euclid(one), top.y().div_euclid(one).clamp(0, plan.height as i32 - 1));
        edgewalk_machine::Record { x, y: y as u32, ..record }
    });
    Shading { records: records.collect(), ..shading }
}
