//! The netlist draws what the model draws, in the same cycles where nothing makes it wait.

use crate::common::machines::random_machine;
use crate::common::triangles::{half_square, one_pixel, random_primitive};
use edgewalk_lockstep::{DrawError, StallKind, render_rtl, render_rtl_passes, render_rtl_with};
use edgewalk_machine::{Machine, Plan, Record};
use edgewalk_model::{DrawState, Pass, Shading, Stalls, longest_setup, render_passes};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A random machine whose SETUP is short, so that the interpreter has mostly pixels to draw.
fn quick_machine(rng: &mut Pcg64Mcg) -> Plan {
    loop {
        let plan = random_machine(rng);
        if plan.guard_bits <= 6 && longest_setup(&plan).all() < 400 {
            return plan;
        }
    }
}

/// Records of random words for so many triangles, and random tables.
fn random_shading(plan: &Plan, triangles: usize, rng: &mut Pcg64Mcg) -> Shading {
    let record = |rng: &mut Pcg64Mcg| Record {
        gloss: rng.random_range(0..=plan.shade.gloss_bits),
        x: rng.random_range(-4..plan.width as i32 + 4),
        y: rng.random_range(0..plan.height),
        material: rng.random_range(0..1 << plan.shade.material_bits),
        terms: plan.terms().iter().map(|_| std::array::from_fn(|_| rng.random())).collect(),
    };
    let bits = plan.shade.diffuse_bits(plan.color.bits) + plan.color.bits;
    let materials = 1 << plan.shade.material_bits;
    let entries = plan.table_place(materials, 0, 0);
    let texels = if plan.shade.textures() { plan.texel_place(materials, 0, 0) } else { 0 };
    let records = (0..triangles).map(|_| record(rng)).collect();
    let mut words = |count, bits| (0..count).map(|_| rng.random::<u128>() >> (128 - bits)).collect();
    Shading {
        records,
        tables: words(entries, bits),
        roots: words(plan.root_words() as usize, plan.root_word_bits()),
        textures: words(texels, plan.texel_word_bits()),
    }
}

#[test]
fn the_picture_of_the_netlist_is_that_of_the_model() {
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    let (mut fragments, mut machines, mut blend, mut shadow, mut shade, mut waited) = (0, [0; 3], 0, 0, 0, 0);
    for i in 0..36 {
        let plan = quick_machine(&mut rng);
        let triangles: Vec<_> = (0..12).map(|_| random_primitive(&plan, &mut rng)).collect();
        let state = DrawState {
            depth_func: [1, 3, 7][i % 3],
            depth_write: rng.random_bool(0.9),
            color_write: rng.random_bool(0.9),
            blend_add: rng.random_bool(0.3),
            shadow_on: true,
            clear: [1, 2, 3],
            ..DrawState::default()
        };
        let stalls = StallKind::ALL[i % 3];
        let shading = random_shading(&plan, triangles.len(), &mut rng);
        let passes = [Pass::all(state)];
        let model = render_passes(&plan, triangles.iter().copied(), &passes, &[], Stalls::NONE, &shading)
            .expect("its own triangles");
        let rtl = render_rtl_passes(&plan, triangles.iter().copied(), &passes, &[], stalls, &shading)
            .expect("its own triangles");
        assert_eq!((&rtl.z, &rtl.rgb, &rtl.extra), (&model.z, &model.rgb, &model.extra), "{plan:?}");
        assert_eq!(rtl.lit, model.lit, "{plan:?}");
        assert_eq!(
            (&rtl.coverage, &rtl.writes, &rtl.id),
            (&model.coverage, &model.writes, &model.id),
            "{plan:?}"
        );
        if stalls == StallKind::None {
            let seen =
                |c: &edgewalk_model::Counters| (c.cycles, c.activity, c.triangles, c.fragments, c.writes);
            assert_eq!(seen(&rtl.counters), seen(&model.counters), "{plan:?}");
        } else {
            // SETUP, or the reading of tables, may take so long that a stall is hidden behind it.
            let longer = rtl.counters.cycles.checked_sub(model.counters.cycles).expect("it waits");
            waited += u32::from(longer > 0);
        }
        fragments += model.counters.fragments;
        machines[i % 3] += 1;
        blend += u32::from(plan.blend.is_there());
        shadow += u32::from(plan.shadow.is_there());
        shade += u32::from(plan.shade.is_there());
    }
    println!(
        "{fragments} fragments compared on {machines:?} machines, by stalls; {blend} of them with BLEND, {shadow} with SHADOW, {shade} with SHADE, \
         {waited} of 24 waited"
    );
    assert!(fragments > 1000 && blend > 10 && shadow > 5 && shade > 10 && waited > 12, "{fragments}");
}

/// Six pixels, and the same behind them.
#[test]
fn what_is_drawn_is_counted() {
    let plan = Machine { width: 5, height: 4, guard_bits: 4, ..Machine::default() };
    let plan = plan.plan().expect("can be built");
    let triangles = [7, 8].map(|z| half_square(&plan, z));
    for stalls in StallKind::ALL {
        let frame = render_rtl(&plan, triangles, DrawState::default(), stalls).expect("its own triangles");
        let seen = frame.counters;
        assert_eq!((seen.triangles, seen.fragments, seen.writes), (2, 12, 6));
        assert_eq!(seen.activity.iter().sum::<u64>(), seen.cycles, "every cycle has one cause");
        let covered = [[1, 1, 1, 0, 0], [1, 1, 0, 0, 0], [1, 0, 0, 0, 0], [0; 5]].concat();
        assert_eq!(frame.writes, covered);
        assert_eq!(frame.coverage, covered.iter().map(|pixel| 2 * pixel).collect::<Vec<_>>());
        assert_eq!(frame.id, covered.iter().map(|pixel| *pixel as i32 - 1).collect::<Vec<_>>());
    }
}

/// Of two records at a time; each triangle has a pixel of its own, whose colour says by which record it was shaded.
#[test]
fn triangles_wait_until_their_records_are_written() {
    let mut machine = Machine { width: 5, height: 3, guard_bits: 4, ..Machine::default() };
    for (key, value) in [("shade.kind", "fast-phong"), ("term.record_bits", "1")] {
        machine.set(key, value).expect("a key");
    }
    let plan = machine.plan().expect("can be built");
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let triangles: Vec<_> = (0..5).map(|x| one_pixel(&plan, &mut rng, x, x % 3)).collect();
    let shading = random_shading(&plan, 5, &mut rng);
    let passes = [Pass::all(DrawState { depth_func: 7, ..DrawState::default() })];
    let model = render_passes(&plan, triangles.iter().copied(), &passes, &[], Stalls::NONE, &shading)
        .expect("its own triangles");
    let rtl = render_rtl_passes(&plan, triangles, &passes, &[], StallKind::None, &shading)
        .expect("its own triangles");
    assert_eq!((&rtl.rgb, &rtl.id), (&model.rgb, &model.id));
    assert_eq!((rtl.counters.writes, rtl.counters.cycles), (5, model.counters.cycles));
}

#[test]
fn a_watcher_sees_every_cycle_and_may_end_the_run() {
    let plan = Plan::default();
    let mut rng = Pcg64Mcg::seed_from_u64(6);
    let triangles: Vec<_> = (0..5).map(|_| random_primitive(&plan, &mut rng)).collect();
    let mut seen = 0;
    let watch = |simulator: &mut edgewalk_netlist::Simulator| {
        seen += 1;
        assert!(simulator.get("activity").is_ok());
        seen < 100
    };
    let passes = [Pass::all(DrawState::default())];
    let counters = render_rtl_with(&plan, triangles, &passes, &Shading::default(), watch);
    assert_eq!(counters.expect("its own triangles").cycles, 100);
    assert_eq!(seen, 100);
}

#[test]
fn triangles_of_another_machine_are_refused() {
    let other = Machine { extra: 1, ..Machine::default() }.plan().expect("can be built");
    let triangle = [other.raw_vertex(0, 0, &[0; 5]); 3];
    let drawn = render_rtl(&Plan::default(), [triangle], DrawState::default(), StallKind::None);
    assert!(matches!(drawn, Err(DrawError::Vertex(error)) if error.triangle == 0));
}
