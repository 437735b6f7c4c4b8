//! The program of a sequenced SETUP, run word by word, against what the closed formulae of section 2 give: lines, edges
//! and channels of triangles of all kinds, with 1, 2 and 4 lanes.

use crate::common::{Triangle, any_triangle, random_machine};
use edgewalk_golden::Shading;
use edgewalk_machine::sequencer::Program;
use edgewalk_machine::sequencer::word::{Base, Control, Only, Sign, Word};
use edgewalk_machine::{EdgeKind, Fill, MAX_CHANNELS, Machine, Plan, SetupKind};
use edgewalk_model::setup::sequencer::SlowSetup;
use edgewalk_model::setup::{Setup, SetupClocks};
use edgewalk_model::tokens::{EdgeWalk, Prim};
use edgewalk_model::{Culled, Events, longest_setup, setup_clocks};
use edgewalk_scene::Scene;
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
    /// Random triangles of all kinds.
    fn check_random(&mut self, plan: &Plan, count: usize, rng: &mut StdRng) {
        let triangles: Vec<Triangle> = (0..count).map(|_| any_triangle(plan, rng)).collect();
        self.check(plan, triangles, rng);
    }

    fn check(&mut self, plan: &Plan, triangles: impl IntoIterator<Item = Triangle>, rng: &mut StdRng) {
        let slow = SlowSetup::new(plan);
        let sequenced =
            plan.with(|m| m.setup_kind = SetupKind::Sequenced).plan().expect("any fill and edges");
        for triangle in triangles {
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
            own.check_random(&plan.expect("can be built"), share, &mut rng);
            own.report(
                &format!("{lanes} lanes, {fill_name} fill, {edge_name} edges, default formats"),
                fill == Fill::Textbook,
            );
            let mut others = Seen::default();
            for _ in 0..RANDOM {
                let kinds = [("edge.fill", fill_name), ("edge.kind", edge_name)];
                let settings = [common.as_slice(), &kinds].concat();
                others.check_random(&random_machine(&settings, &mut rng), share.div_ceil(RANDOM), &mut rng);
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

/// The triangles of a scene at 640x480 as they stand at the port.
pub(crate) fn of_scene(plan: &Plan, scene: &Scene) -> Vec<Triangle> {
    let surface = scene.surface(plan.width, plan.height, f64::from((1u32 << plan.guard_bits) - 1));
    let frame = edgewalk_golden::frame(scene, &surface, Shading::Gouraud);
    let frame = frame.triangulated(plan.subpixel_bits).expect("triangles");
    let vertex = |v: &edgewalk_scene::Vertex| {
        plan.port_vertex(v.x, v.y, &[v.z, v.r, v.g, v.b]).expect("clipped to the guard band")
    };
    frame.triangles.iter().map(|triangle| triangle.0.each_ref().map(vertex)).collect()
}

/// Each scene with both fills, both kinds of edges, and 1, 2 and 4 lanes.
fn scenes(scenes: &[(String, Scene)]) {
    let mut rng = StdRng::seed_from_u64(0);
    let (mut all, mut expected) = (0, 0);
    for (name, scene) in scenes {
        for (fill_name, edge_name, fill, edge_kind) in KINDS {
            let subpixel_bits = if fill == Fill::Textbook { 0 } else { 8 };
            for lanes in [1, 2, 4] {
                let machine = Machine { lanes, fill, edge_kind, subpixel_bits, ..Machine::default() };
                let plan = machine.plan().expect("can be built");
                let triangles = of_scene(&plan, scene);
                assert!(!triangles.is_empty(), "{name} has triangles");
                expected += triangles.len();
                let mut seen = Seen::default();
                seen.check(&plan, triangles, &mut rng);
                all += seen.checked;
                println!(
                    "{name}, {lanes} lanes, {fill_name} fill, {edge_name} edges: {} triangles equal, culled {:?}",
                    seen.checked, seen.culled
                );
            }
        }
    }
    println!("checked {all} / {expected} triangles");
    assert!(all == expected && all > 0);
}

#[test]
fn program_gives_the_tokens_of_a_scene() {
    scenes(&[("room".into(), Scene::builtin("room").expect("a scene"))]);
}

/// `EDGEWALK_MESHES=DIR cargo test --release -p edgewalk-model -- --ignored program_gives_the_tokens_of_meshes --nocapture`:
/// the built-in scenes, and each `.obj` of the folder.
#[test]
#[ignore = "a campaign of minutes"]
fn program_gives_the_tokens_of_meshes() {
    let mut list: Vec<(String, Scene)> = Scene::BUILTIN
        .iter()
        .map(|name| (name.to_string(), Scene::builtin(name).expect("a scene")))
        .collect();
    if let Some(folder) = std::env::var_os("EDGEWALK_MESHES") {
        let before = list.len();
        let mut folders = vec![std::path::PathBuf::from(folder)];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder).expect("a folder") {
                let path = entry.expect("readable").path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|end| end == "obj") {
                    let name = path.to_str().expect("UTF-8");
                    list.push((name.into(), Scene::open(name).expect("a mesh")));
                }
            }
        }
        assert!(list.len() > before, "a mesh in the folder");
    }
    scenes(&list);
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
