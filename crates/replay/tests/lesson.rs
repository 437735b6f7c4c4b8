//! The lesson: every number of it in the machine's registers, on the triangle of the page, on random triangles that meet
//! named corners, and on the textbook machine; and `docs/lesson.md`, which is written from it.

use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::{DrawState, Stalls};
use edgewalk_replay::lesson::markdown::markdown;
use edgewalk_replay::lesson::{SCREEN, triangle};
use edgewalk_replay::{Lesson, Window, lesson, record};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::{BTreeMap, BTreeSet};

fn on_screen(machine: Machine, (width, height): (u32, u32)) -> Plan {
    Machine { width, height, ..machine }.plan().expect("can be built")
}

/// The lesson of a triangle, or that it is culled.
fn of(plan: &Plan, corners: [PortVertex; 3]) -> Result<Lesson, String> {
    let recording = record(plan, &[corners], DrawState::default(), Stalls::NONE, Window::default());
    lesson(plan, &corners, &recording.map_err(|error| error.to_string())?, 1)
}

fn agrees(plan: &Plan, lesson: &Lesson) -> usize {
    for check in &lesson.checks {
        assert_eq!(check.expected, check.found, "machine {}: {check:?}", plan.hash());
    }
    assert!(lesson.checks.len() > 40, "{}", lesson.checks.len());
    lesson.checks.len()
}

#[test]
fn the_triangle_of_the_page() {
    let mut checked = 0;
    for machine in [Machine::default(), Machine::preset("textbook").expect("a preset")] {
        let plan = on_screen(machine, SCREEN);
        let lesson = of(&plan, triangle(&plan).expect("on the screen")).expect("it is drawn");
        checked += agrees(&plan, &lesson);
        let sections: BTreeSet<u32> = lesson.steps.iter().flat_map(|step| step.sections.clone()).collect();
        assert_eq!(sections, (1..=8).collect(), "every section of machine.md is named");
        assert!(lesson.steps.iter().all(|step| step.cycle != u32::MAX && !step.parts.is_empty()));
    }
    println!("checked {checked} numbers");
    assert!(checked > 300);
}

/// Which corners a triangle meets.
fn corners_met(plan: &Plan, corners: &[PortVertex; 3], lesson: &Lesson) -> Vec<&'static str> {
    let found = |name: &str| lesson.checks.iter().find(|check| check.name == name).map(|check| check.found);
    let p = 1i32 << plan.subpixel_bits;
    let mut sorted = *corners;
    sorted.sort_by_key(PortVertex::y);
    let [top, knee, bottom] = sorted.map(|v| v.y());
    let (n1, n2) = (found("setup n1"), found("setup n2"));
    let columns = corners.map(|v| v.x());
    let (left, right) = (columns.iter().min().copied(), columns.iter().max().copied());
    let two = n1 > Some(0) && n2 > Some(0);
    let all = [
        ("major edge left", found("setup major_right") == Some(0)),
        ("major edge right", found("setup major_right") == Some(1)),
        ("no upper part", n1 == Some(0)),
        ("no lower part", n2 == Some(0)),
        ("knee on a line", two && (knee - p / 2) % p == 0),
        ("an edge lower than a pixel", (1..p).contains(&(knee - top)) || (1..p).contains(&(bottom - knee))),
        ("cut left", left < Some(0)),
        ("cut right", right > Some(plan.width as i32 * p)),
        ("cut above", top < 0),
        ("cut below", bottom > plan.height as i32 * p),
    ];
    all.into_iter().filter(|(_, met)| *met).map(|(name, _)| name).collect()
}

/// A triangle around the screen; every third is drawn so that corners are met.
fn random_triangle(plan: &Plan, k: usize, rng: &mut impl Rng) -> [PortVertex; 3] {
    let p = 1i32 << plan.subpixel_bits;
    let (w, h) = (plan.width as i32, plan.height as i32);
    let mut corners = [(); 3].map(|()| {
        let range = if k.is_multiple_of(2) { -w * p / 3..w * p * 4 / 3 } else { p..(w - 1) * p };
        let lines = if k.is_multiple_of(2) { -h * p / 3..h * p * 4 / 3 } else { p..(h - 1) * p };
        (rng.random_range(range), rng.random_range(lines))
    });
    match k % 6 {
        1 => corners[1].1 = corners[0].1,
        3 => corners[1].1 = corners[1].1 / p * p + p / 2,
        5 => corners[2].1 = corners[1].1 + rng.random_range(1..=p.max(2) / 2),
        _ => {}
    }
    corners.map(|(x, y)| {
        let values: Vec<i64> =
            plan.channels().iter().map(|c| rng.random_range(0..1 << c.vertex_bits())).collect();
        plan.raw_vertex(x, y, &values)
    })
}

#[test]
fn random_triangles_that_meet_every_corner() {
    let mut rng = Pcg64Mcg::seed_from_u64(9);
    let machines = [
        (on_screen(Machine::default(), (40, 30)), 200),
        (on_screen(Machine { adders: 1, segments: 2, lanes: 1, ..Machine::default() }, (33, 20)), 60),
        (on_screen(Machine::preset("textbook").expect("a preset"), (40, 30)), 100),
    ];
    for (plan, wanted) in machines {
        let (mut checked, mut drawn, mut met) = (0, 0, BTreeMap::<&str, usize>::new());
        for k in 0.. {
            assert!(k < 40 * wanted, "hardly any triangle is drawn");
            if drawn == wanted {
                break;
            }
            let corners = random_triangle(&plan, k, &mut rng);
            match of(&plan, corners) {
                Ok(lesson) => {
                    checked += agrees(&plan, &lesson);
                    drawn += 1;
                    for corner in corners_met(&plan, &corners, &lesson) {
                        *met.entry(corner).or_default() += 1;
                    }
                }
                Err(error) => assert_eq!(error, "the triangle is culled"),
            }
        }
        println!("machine {}: {checked} numbers of {drawn} triangles: {met:?}", plan.hash());
        // Of whole pixels no edge is lower than one, and every knee lies on a line.
        let all = if plan.subpixel_bits > 0 { 10 } else { 8 };
        assert!(met.len() >= all && met.values().all(|count| *count > 1), "{met:?}");
    }
}

/// Compares, or with EDGEWALK_BLESS=1 writes.
#[test]
fn docs_lesson_md_is_the_lesson() {
    let plan = on_screen(Machine::default(), SCREEN);
    let text = markdown(&of(&plan, triangle(&plan).expect("on the screen")).expect("it is drawn"));
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/lesson.md");
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        std::fs::write(&path, &text).expect("written");
    }
    let there = std::fs::read_to_string(&path).expect("docs/lesson.md");
    assert!(
        there == text,
        "docs/lesson.md is not the lesson: EDGEWALK_BLESS=1 cargo test -p edgewalk-replay --test lesson"
    );
}
