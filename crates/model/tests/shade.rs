//! SHADE: the unit and the whole machine against the rule in plain numbers.

use crate::common::shade::{colour, cosines, leftward, output, random_shading, textured, true_roots, words};
use crate::common::{ALWAYS, Triangle, machine, place, random_machine, random_triangle};
use edgewalk_machine::{Activity, Entry, Plan, Record};
use edgewalk_model::shade::Shade;
use edgewalk_model::{
    Cosines, Drawn, Events, Frame, Given, Pass, Shading, Stalls, WordIn, render_passes_with,
};
use rand::{Rng, SeedableRng, rngs::StdRng};

const C: usize = edgewalk_model::tokens::MAX_CHANNELS;

/// A fragment that DEPTH took: triangle, address, outputs of the channels.
type Fragment = (u32, u32, Vec<u32>);

fn fragments(
    plan: &Plan,
    triangles: &[Triangle],
    shading: &Shading,
    stalls: Stalls,
) -> (Vec<Fragment>, Frame) {
    let mut all = Vec::new();
    let hook = |drawn: Drawn| {
        if let Drawn::Fragment(sample) = drawn {
            all.push((sample.source.id, sample.addr, sample.values.to_vec()));
        }
    };
    let passes = [Pass::all(ALWAYS)];
    let frame = render_passes_with(plan, triangles.iter().copied(), &passes, &[], stalls, shading, hook)
        .expect("this machine's vertices");
    (all, frame)
}

/// Every fragment has the colour that its words ask for, and all else as the same machine without SHADE has it.
fn compare(plan: &Plan, triangles: &[Triangle], shading: &Shading, stalls: Stalls) -> (usize, Frame) {
    let mut plain = (**plan).clone();
    plain.set("shade.kind", "none").expect("a key");
    let (own, _) = fragments(&plain.plan().expect("simpler"), triangles, shading, stalls);
    let (found, frame) = fragments(plan, triangles, shading, stalls);
    assert_eq!(found.len(), own.len());
    for ((id, addr, values), before) in found.iter().zip(&own) {
        assert_eq!((id, addr), (&before.0, &before.1));
        let record = &shading.records[*id as usize];
        let left = leftward(plan, &triangles[*id as usize]);
        let words = words(plan, record, left, place(plan, *addr));
        let outputs: Vec<i64> =
            plan.terms().iter().zip(words).map(|(term, word)| output(term, word)).collect();
        let cosines = cosines(plan, shading, record, &outputs);
        let own = [before.2[1], before.2[2], before.2[3]];
        let own = textured(plan, &shading.textures, record.material, &outputs, own);
        let wanted = colour(plan, &shading.tables, record.material, &cosines, own);
        let mut all = before.2.clone();
        all[1..4].copy_from_slice(&wanted);
        assert_eq!(*values, all, "triangle {id} at {:?} of {cosines:?}, {plan:?}", place(plan, *addr));
    }
    assert!(frame.counters.add_up() && frame.counters.fragments == found.len() as u64);
    (found.len(), frame)
}

#[test]
fn three_hundred_machines_draw_what_their_words_and_tables_ask_for() {
    let mut rng = StdRng::seed_from_u64(5);
    let (mut checked, mut events) = (0, Events::default());
    let mut spent = [0; 3];
    for number in 0..300u64 {
        let fixed = [
            ("shade.kind", if number % 2 == 0 { "fast-phong" } else { "phong" }),
            ("screen.width", "53"),
            ("screen.height", "39"),
            ("screen.guard_bits", "8"),
            ("texture.kind", if number % 5 < 2 { "nearest" } else { "none" }),
            ("texture.bits", ["1", "2", "5", "7"][number as usize % 4]),
            ("texture.bump", if number % 5 == 0 { "yes" } else { "no" }),
            ("term.record_bits", if number % 10 == 0 { "2" } else { "5" }),
        ];
        let plan = random_machine(&fixed, &mut rng);
        let triangles: Vec<Triangle> = (0..rng.random_range(1..24))
            .map(|_| {
                let size = 2f64.powf(rng.random_range(0.0..7.0));
                random_triangle(&plan, size, &mut rng)
            })
            .collect();
        let shading = random_shading(&plan, &triangles, &mut rng);
        let stalls = match number % 3 {
            0 => Stalls::NONE,
            1 => Stalls { seed: number, rd: 60, data: 60, wr: 60 },
            _ => Stalls { seed: number, rd: 200, data: 10, wr: 200 },
        };
        let (drawn, frame) = compare(&plan, &triangles, &shading, stalls);
        checked += drawn;
        events.merge(&frame.events);
        for (sum, activity) in spent.iter_mut().zip([Activity::Term, Activity::Shade, Activity::Texel]) {
            *sum += frame.counters.spent(activity);
        }
    }
    println!("300 machines, {checked} fragments equal; clocks lost to TERM, SHADE and TEXEL {spent:?}");
    assert!(checked > 100_000 && spent.iter().all(|clocks| *clocks > 0));
    for (name, count) in events.counts() {
        use edgewalk_machine::units::{bump, normal, shade, term, texel};
        let units = [&term::SPEC, &texel::SPEC, &bump::SPEC, &normal::SPEC, &shade::SPEC];
        let own = units.iter().flat_map(|unit| unit.events).any(|event| event.name == name);
        assert!(!own || count > 0, "{name} was not met");
    }
}

/// Words that random triangles never have: both cosines exactly at, and one unit beside, every end of the tables.
#[test]
fn words_at_the_ends_of_the_tables() {
    let mut rng = StdRng::seed_from_u64(6);
    let mut checked = 0;
    for (colour, lights) in [("tables", "1"), ("tables", "2"), ("multiply", "1"), ("multiply", "2")] {
        let plan = machine(&[
            ("shade.kind", "fast-phong"),
            ("shade.colour", colour),
            ("shade.lights", lights),
            ("shade.material_bits", "0"),
            ("term.fraction", "3"),
            ("screen.width", "8"),
            ("screen.height", "8"),
        ]);
        let (entry, end) = (8i64, 512 * 8);
        let diffuse = [
            -2 * end,
            -end * 5 / 3,
            -entry - 1,
            -entry,
            -1,
            0,
            1,
            entry - 1,
            entry,
            end / 2,
            end - 1,
            end,
            end + 1,
            end * 5 / 3,
        ];
        let highlight =
            [-32 * end, -end * 16 * 5 / 3, -1, 0, 7, 8, end - 8, end - 1, end, end + 7, 2 * end, 31 * end];
        let mut triangles = Vec::new();
        let mut shading = Shading::default();
        for d in diffuse {
            for h in highlight {
                let [a, b] = [
                    plan.raw_vertex(-256, -256, &[0, 4000, 2000, 77]),
                    plan.raw_vertex(3000, 0, &[0, 4000, 2000, 77]),
                ];
                triangles.push([a, b, plan.raw_vertex(0, 3000, &[0, 4000, 2000, 77])]);
                let flat = |word: i64| [word as u64, 0, 0, 0, 0, 0];
                let others = [flat(rng.random_range(-end..2 * end)), flat(rng.random_range(-end..2 * end))];
                let terms = [flat(d), flat(h)].into_iter().chain(others).take(plan.terms().len()).collect();
                shading.records.push(Record { terms, ..Record::default() });
            }
        }
        for place in 0..plan.shade.entries() {
            // Neighbours differ in every part, and the ends from all.
            let part = |factor: u32| (place * factor + 1) % 256;
            let entry = match colour {
                "tables" => Entry::Colours([part(1), part(3), part(5)], part(7) / 2),
                _ => Entry::Light(part(1) * 4 + 3, part(7) / 2),
            };
            shading.tables.push(plan.table_word(entry));
        }
        checked += compare(&plan, &triangles, &shading, Stalls::NONE).0;
    }
    println!("{checked} fragments at the ends of the tables");
    assert!(checked > 4 * 168 * 20);
}

/// A machine with all of it on a small screen, a triangle over most of that for each record, tables, and a texture.
fn flat_pictures(
    kind: &str,
    side: &str,
    records: Vec<Record>,
    rng: &mut StdRng,
) -> (Plan, Vec<Triangle>, Shading) {
    let plan = machine(&[
        ("shade.kind", kind),
        ("shade.colour", "multiply"),
        ("shade.material_bits", "0"),
        ("texture.kind", "nearest"),
        ("texture.bits", side),
        ("term.fraction", "3"),
        ("term.linear_fraction", "2"),
        ("screen.width", "8"),
        ("screen.height", "8"),
        ("screen.guard_bits", "6"),
    ]);
    let color = [0, 4000, 2000, 77];
    let [a, b, c] = [(-256, -256), (3000, 0), (0, 3000)].map(|(x, y)| plan.raw_vertex(x, y, &color));
    let triangles = vec![[a, b, c]; records.len()];
    let shading = Shading { records, roots: true_roots(&plan), ..random_shading(&plan, &triangles, rng) };
    (plan, triangles, shading)
}

/// Normals of length exactly half and exactly 1, a unit beside, none at all, and products of any sign and size beside them.
#[test]
fn normals_at_the_ends_of_their_lengths() {
    let mut rng = StdRng::seed_from_u64(16);
    let one = 1i64 << 16;
    let mut records = Vec::new();
    for square in [-2 * one, -1, 0, one / 4 - 1, one / 4, one / 4 + 255, one / 2, one - 1, one, 2 * one - 1] {
        for product in [-2 * one, -one, -1, 0, 1, one / 2, one - 1, one, 2 * one - 1] {
            for gloss in [0, 1, 4, 8, 15] {
                let highlight = rng.random_range(one / 2..=one);
                let linear = |value: i64| [(value * 4) as u64, 0, 0, 0, 0, 0];
                let others = [linear(0), linear(0)];
                let quadratic = [(square * 8) as u64, 0, 0, 0, 0, 0];
                let terms =
                    [linear(product), linear(highlight), quadratic].into_iter().chain(others).collect();
                records.push(Record { terms, gloss, ..Record::default() });
            }
        }
    }
    let (plan, triangles, shading) = flat_pictures("phong", "2", records, &mut rng);
    let (checked, frame) = compare(&plan, &triangles, &shading, Stalls::NONE);
    let events = frame.events;
    println!(
        "{checked} fragments; short {}, long {}, cut {}",
        events.normal.normal_short, events.normal.normal_long, events.normal.cosine_cut
    );
    assert!(
        checked > 450 * 20
            && events.normal.normal_short > 0
            && events.normal.normal_long > 0
            && events.normal.cosine_cut > 0
    );
}

/// Textures of 2 to 2048 texels a side, walked over their ends in both directions.
#[test]
fn textures_repeat() {
    let mut rng = StdRng::seed_from_u64(17);
    let mut checked = 0;
    for side in ["1", "5", "11"] {
        let texels = 1i64 << side.parse::<u32>().expect("a number");
        let steps =
            [(-4, 0), (4, 0), (0, 4), (0, -4), (5, -3), (4 * texels, -4 * texels), (4 * texels - 1, 1)];
        let records = steps.map(|(across, down)| {
            let walk = |first: i64| [first, across, down].map(|word| word as u64);
            let linear = |first: i64| {
                let [v, x, y] = walk(first);
                [v, x, y, 0, 0, 0]
            };
            // Three texels before the end, and at its beginning.
            let terms =
                vec![[2000, 0, 0, 0, 0, 0], [1000, 0, 0, 0, 0, 0], linear(4 * (texels - 3)), linear(-1)];
            Record { terms, ..Record::default() }
        });
        let (plan, triangles, shading) = flat_pictures("fast-phong", side, records.to_vec(), &mut rng);
        checked += compare(&plan, &triangles, &shading, Stalls::NONE).0;
    }
    println!("{checked} fragments of textures that repeat");
    assert!(checked > 21 * 20);
}

/// New tables wait until no stage holds a fragment of the old ones, however long that takes.
#[test]
fn tables_stay_while_a_stage_needs_them() {
    let plan = machine(&[("shade.kind", "fast-phong"), ("shade.table_bits", "8")]);
    let (mut unit, mut events) = (Shade::<C>::new(&plan), Events::default());
    let fragment = edgewalk_model::tokens::Fragment::default();
    let of = |material| Cosines { material, ..Cosines::default() };
    // A word is there in the cycle after its read.
    let mut due = None;
    let mut cycle = |unit: &mut Shade<C>, material: u32, ready: bool| {
        let tables = WordIn { ready: true, word: due.take() };
        let given = Given { frag: &fragment, cosines: &of(material) };
        due = unit.read().map(u128::from);
        let taken = unit.frag_ready(Some(given), ready);
        unit.step(Some(given), &tables, ready, &mut events);
        taken
    };
    let clocks = (0..).find(|_| cycle(&mut unit, 3, false)).expect("the tables come");
    assert_eq!(clocks, 256 + 1 + 1);
    // One moves to the end and stays there; another material is offered.
    for _ in 0..400 {
        cycle(&mut unit, 5, false);
        assert!(unit.occupied() && unit.read().is_none());
    }
    // It leaves, all is empty, the fetch begins, and its first read follows.
    let reads = (0..).find(|_| {
        cycle(&mut unit, 5, true);
        unit.read().is_some()
    });
    assert_eq!((reads, unit.read()), (Some(1), Some(5 << 8)));
}

/// Records of culled triangles are stepped over: 17 between two that are drawn, and more triangles than records.
#[test]
fn culled_triangles_have_records_that_nobody_reads() {
    let mut rng = StdRng::seed_from_u64(8);
    let plan = machine(&[
        ("shade.kind", "fast-phong"),
        ("term.record_bits", "3"),
        ("screen.width", "32"),
        ("screen.height", "32"),
    ]);
    let mut triangles = Vec::new();
    for _ in 0..6 {
        triangles.push(random_triangle(&plan, 40.0, &mut rng));
        triangles.extend([[plan.raw_vertex(-5000, -5000, &[0; 4]); 3]; 17]);
    }
    let shading = random_shading(&plan, &triangles, &mut rng);
    let (checked, frame) = compare(&plan, &triangles, &shading, Stalls::NONE);
    println!("{checked} fragments, {} records read of {}", frame.events.term.record_read, triangles.len());
    assert!(checked > 500 && (1..=6).contains(&frame.events.term.record_read));
}

/// Roots of the whole range of N·N, every value of it, against f64.
#[test]
fn roots_are_as_near_as_the_specification_says() {
    let plan = machine(&[("shade.kind", "phong")]);
    let roots = true_roots(&plan);
    let (mut at, mut cut, mut checked) = (0.0f64, 0.0f64, 0);
    for s in 1u64 << 14..1 << 16 {
        let (v, slope) = ((roots[s as usize >> 8] >> 10) as f64, roots[s as usize >> 8] as u64 & 1023);
        let y = v - ((slope * (s & 255) + 128) / 256) as f64;
        let error = |square: u64| (y / 65536.0 * (square as f64 / 65536.0).sqrt() - 1.0).abs();
        at = at.max(error(s));
        cut = cut.max(error(s + 1)); // N·N lay just below s + 1 before it was cut
        checked += 1;
    }
    println!(
        "{checked} roots, largest relative error 2^{:.2}, with the cut of N·N 2^{:.2}",
        at.log2(),
        cut.log2()
    );
    assert!(checked == 49_152 && at < 2f64.powf(-15.6) && cut < 2f64.powf(-14.3) && cut > at);
}

/// One fragment a clock: SHADE adds its stages, and nothing a fragment.
#[test]
fn shading_costs_no_clock_a_pixel() {
    let mut rng = StdRng::seed_from_u64(9);
    for (kind, colour, stages, roots) in
        [("fast-phong", "tables", 3, 0), ("fast-phong", "multiply", 5, 0), ("phong", "tables", 10, 259)]
    {
        let plan = machine(&[("shade.kind", kind), ("shade.colour", colour), ("shade.table_bits", "8")]);
        let vertex = |x, y| plan.raw_vertex(x, y, &[0; 4]);
        let triangle = [vertex(0, 0), vertex(600 * 256, 0), vertex(0, 400 * 256)];
        let mut shading = random_shading(&plan, &[triangle], &mut rng);
        (shading.records[0].x, shading.records[0].y) = (0, 0);
        let (checked, frame) = compare(&plan, &[triangle], &shading, Stalls::NONE);
        let counters = frame.counters;
        let (term, shade) = (counters.spent(Activity::Term), counters.spent(Activity::Shade));
        println!(
            "{colour}: {checked} fragments, TERM {term} clocks, SHADE {shade} clocks, FLUSH {}",
            counters.spent(Activity::Flush)
        );
        assert_eq!(counters.spent(Activity::Draw), checked as u64);
        // The record: begin, 15 words, latency; and the span is there. The tables: as many with 256 words.
        assert_eq!((term, shade), (15 + 2 + 1, roots + 256 + 2 + 1));
        assert_eq!(counters.spent(Activity::Flush), 1 + stages + 2 + 1);
    }
}

/// Two fragments in turn take 34 clocks.
#[test]
fn a_light_at_a_point_takes_seventeen_clocks_a_pixel() {
    /// The words of LAMP's tables, a record, the tables of SHADE, and what starts and ends a frame.
    const BESIDE: u64 = 1024 + 256 + 150;
    let mut rng = StdRng::seed_from_u64(10);
    let keys = [("shade.kind", "phong"), ("shade.light", "positional"), ("shade.table_bits", "8")];
    let plan = machine(&keys);
    let vertex = |x, y| plan.raw_vertex(x, y, &[0; 4]);
    let triangle = [vertex(0, 0), vertex(60 * 256, 0), vertex(0, 40 * 256)];
    let mut shading = random_shading(&plan, &[triangle], &mut rng);
    (shading.records[0].x, shading.records[0].y) = (0, 0);
    let (found, frame) = fragments(&plan, &[triangle], &shading, Stalls::NONE);
    let (clocks, fragments) = (frame.counters.cycles, found.len() as u64);
    println!("{fragments} fragments in {clocks} clocks");
    assert!(fragments > 1000 && (17 * fragments..17 * fragments + BESIDE).contains(&clocks), "{clocks}");
}
