//! The map and then the picture under it on one machine, without a reset between: the netlist and the model, pass by pass.

use crate::common::machines::random_machine;
use crate::common::tokens::random_tokens;
use crate::common::triangles::random_primitive;
use edgewalk_lockstep::{Case, NetlistDevice, StallKind, Triangles, Unit, model, netlist, render_rtl_passes};
use edgewalk_machine::{Activity, Fill, Machine, OwnPass, Plan, PortVertex, Shadow, ShadowLight};
use edgewalk_model::{Counters, DrawState, Frame, Pass, Shading, Stalls, longest_setup, render_passes};
use edgewalk_netlist::mutate::mutants;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A random machine that draws its map and whose SETUP is short.
fn drawn(rng: &mut Pcg64Mcg) -> Plan {
    loop {
        let plan = random_machine(rng);
        let quick = plan.guard_bits <= 6 && longest_setup(&plan).all() < 500 && !plan.shade.is_there();
        if plan.shadow.draws_map() && quick {
            return plan;
        }
    }
}

/// A picture without a map, the map, what transmits behind it, and the picture under it.
fn passes(plan: &Plan, triangles: usize, rng: &mut Pcg64Mcg) -> Vec<Pass> {
    let clear = [1, 0, plan.color.max()];
    let lit = DrawState { shadow_on: true, ambient: plan.color.max() / 3, clear, ..DrawState::default() };
    let before = DrawState { shadow_on: false, depth_func: rng.random_range(1..8), ..lit };
    // That a map counts makes no difference to the map that is drawn.
    let of_map = DrawState { clear: [0; 3], ..lit };
    let hides = DrawState { light_pass: true, color_write: false, shadow_on: rng.random(), ..of_map };
    let panes = DrawState { depth_write: false, color_write: true, ..hides };
    let pass = |state, map| Pass { triangles, map, ..Pass::all(state) };
    let again = Pass { clear_depth: true, ..pass(hides, Some(1)) };
    let mut list = vec![
        pass(before, None),
        pass(hides, Some(0)),
        pass(panes, Some(0)),
        pass(lit, Some(0)),
        again,
        pass(lit, Some(1)),
    ];
    // What comes first says nothing of how the picture begins.
    list.rotate_left(usize::from(rng.random::<bool>()));
    list
}

fn same(rtl: &Frame, model: &Frame) -> Result<(), &'static str> {
    let parts = [
        ("maps", rtl.maps == model.maps),
        ("depths", rtl.z == model.z),
        ("colours", (&rtl.rgb, &rtl.extra) == (&model.rgb, &model.extra)),
        ("lit", rtl.lit == model.lit),
        ("writes", (&rtl.coverage, &rtl.writes, &rtl.id) == (&model.coverage, &model.writes, &model.id)),
    ];
    parts.into_iter().find(|(_, same)| !same).map_or(Ok(()), |(name, _)| Err(name))
}

fn seen(counters: &Counters) -> (u64, [u64; Activity::ALL.len()], u64, u64, u64) {
    let Counters { cycles, activity, triangles, fragments, writes, .. } = *counters;
    (cycles, activity, triangles, fragments, writes)
}

#[test]
fn map_and_picture_of_the_netlist_are_those_of_the_model() {
    let mut rng = Pcg64Mcg::seed_from_u64(71);
    let (mut texels, mut glass, mut found, mut cycles) = (0, 0, [0; 3], 0);
    for i in 0..30 {
        let plan = drawn(&mut rng);
        let list = passes(&plan, 5, &mut rng);
        let triangles: Vec<_> = (0..30).map(|_| random_primitive(&plan, &mut rng)).collect();
        let stalls = StallKind::ALL[i % 3];
        let model = render_passes(&plan, triangles.clone(), &list, &[], Stalls::NONE, &Shading::default())
            .expect("its own");
        let rtl =
            render_rtl_passes(&plan, triangles, &list, &[], stalls, &Shading::default()).expect("its own");
        assert_eq!(same(&rtl, &model), Ok(()), "{plan:?}");
        assert_eq!((rtl.passes.len(), rtl.maps.len()), (6, 2));
        if stalls == StallKind::None {
            for (rtl, model) in rtl.passes.iter().zip(&model.passes) {
                assert_eq!(seen(rtl), seen(model), "{plan:?}");
            }
            assert_eq!(seen(&rtl.counters), seen(&model.counters));
            cycles += rtl.counters.cycles;
        }
        let empty = u32::MAX >> (32 - plan.map_word_bits());
        texels += model.maps.iter().flatten().filter(|word| **word != empty).count();
        let left = plan.color.max() as u32;
        glass += model.maps[0].iter().filter(|word| plan.shadow.transmits() && **word & left != left).count();
        model.lit.iter().for_each(|lit| found[usize::from(*lit)] += 1);
    }
    println!(
        "30 machines, {texels} texels drawn, {glass} of them behind what transmits; pixels nothing, in shadow, lit: {found:?}; {cycles} cycles of ten machines equal, pass by pass"
    );
    assert!(texels > 1000 && glass > 50 && found.iter().all(|n| *n > 10) && cycles > 10_000);
}

/// A machine of few bits whose map has other sides than its screen.
fn mixed(fill: Fill, [width, height, size]: [u32; 3]) -> Plan {
    let plain = Machine::default();
    let light = ShadowLight::Parallel;
    let shadow = Shadow { light, size, depth_bits: 6, own_pass: OwnPass::Yes, ..plain.shadow };
    let subpixel_bits = if fill == Fill::Textbook { 0 } else { 2 };
    let (mut z, mut color) = (plain.z, plain.color);
    (z.bits, color.bits) = (8, 3);
    let machine = Machine { width, height, guard_bits: 4, subpixel_bits, fill, shadow, z, color, ..plain };
    machine.plan().expect("can be built")
}

/// Triangles with vertices on the last centres of screen and map, and right beside them.
fn around_the_ends(plan: &Plan, rng: &mut Pcg64Mcg) -> [PortVertex; 3] {
    let unit = 1 << plan.subpixel_bits;
    let limit = ((1 << plan.guard_bits) - 1) * unit;
    let mut at = |side: u32| {
        let side = if rng.random() { side } else { plan.shadow.size };
        let end = [0, 1, side as i32, side as i32 + 1][rng.random_range(0..4)] * unit - unit / 2;
        if rng.random_bool(0.1) { rng.random_range(-limit..=limit) } else { end + rng.random_range(-1..=1) }
    };
    let mut places = [(); 3].map(|()| (at(plan.width), at(plan.height)));
    // Now and then all beyond an end.
    match rng.random_range(0..8usize) {
        0 => places
            .iter_mut()
            .for_each(|(x, _)| *x = plan.width as i32 * unit - unit / 2 + rng.random_range(0..8)),
        1 => places.iter_mut().for_each(|(_, y)| *y = -rng.random_range(0..4 * unit)),
        n @ (2 | 3) => {
            let below = places.iter_mut().skip(n - 2);
            below.for_each(|(_, y)| *y = limit - rng.random_range(0..4 * unit));
        }
        _ => {}
    }
    places.map(|(x, y)| plan.raw_vertex(x, y, &vec![1; plan.channels().len()]))
}

/// A fault that changes nothing: why.
fn no_fault(plan: &Plan, fault: &str) -> Option<&'static str> {
    let unit = 1 << plan.widths().center_fraction;
    let last = |side: u32| (side - 1) * unit;
    let lines = format!("Mux(light_pass, {}, {})", last(plan.shadow.size), last(plan.height));
    let exact = plan.fill == Fill::Exact;
    let of_line = exact && fault.contains(&lines);
    if of_line && fault.contains("` becomes `") && !fault.contains("_v") && !fault.contains("becomes `Mux") {
        return Some("a 2^-t px behind the last centre the line is rounded up to H all the same");
    }
    if exact && fault.contains("Ge(line_c") && fault.contains("becomes `GeSigned(") {
        return Some("whether the column is negative is asked beside it");
    }
    if !exact && fault.contains("LtSigned(") && fault.contains("becomes `LeSigned(") {
        return Some("of two equal numbers either is the smaller");
    }
    (!exact && fault.contains("LtSigned(xe") && fault.contains("becomes `Lt(xe"))
        .then_some("a span that ends before column 0 is empty, wherever it ends")
}

/// Every single fault of the netlists where the input says something, in every unit that has it, alone and whatever the pass.
#[test]
fn single_faults_where_the_pass_counts_are_found() {
    let machines =
        [mixed(Fill::Exact, [6, 5, 9]), mixed(Fill::Textbook, [9, 12, 6]), mixed(Fill::Exact, [11, 4, 5])];
    let (mut tried, mut found, mut equivalent, mut survivors) = ([0; 4], 0, 0, Vec::new());
    for (number, plan) in machines.iter().enumerate() {
        for (i, name) in ["setup", "span", "pixel", "shadow"].into_iter().enumerate() {
            let unit = Unit::named(name).expect("declared");
            let mut rng = Pcg64Mcg::seed_from_u64(80 + i as u64);
            let port = Triangles::new(plan);
            let cases = [false, true].map(|light_pass| {
                let mut case = Case::new(plan, unit);
                case.tokens = match name {
                    "setup" => (0..800).map(|_| port.pack(&around_the_ends(plan, &mut rng), 0)).collect(),
                    _ => random_tokens(plan, unit, 300, &mut rng),
                };
                (case.state.light_pass, case.state.shadow_on) = (light_pass, true);
                case.cycles = if name == "setup" { 50_000 } else { 1500 };
                case
            });
            let design = netlist(plan, unit).expect("can be built");
            for mutant in mutants(&design) {
                if !mutant.description.contains("light_pass") {
                    continue;
                }
                tried[i] += 1;
                let faulty = mutant.apply(&design);
                let differs = |case: &Case| {
                    let interface = case.interface();
                    let mut device = NetlistDevice::new(&faulty, &interface).expect("the same ports");
                    device.reset();
                    let mut reference = model(plan, &interface).expect("the model has the unit");
                    case.run_devices(&interface, &mut *reference, &mut device).is_err()
                };
                if no_fault(plan, &mutant.description).is_some() {
                    equivalent += 1;
                } else if cases.iter().any(differs) {
                    found += 1;
                } else {
                    survivors.push(format!("machine {number}, {name}: {}", mutant.description));
                }
            }
            for case in &cases {
                assert!(case.run().is_ok(), "the design itself differs: machine {number}, {name}");
            }
        }
    }
    let all: usize = tried.iter().sum();
    println!("{found} of {all} found, {equivalent} are none; tried in setup, span, pixel, shadow: {tried:?}");
    survivors.iter().for_each(|survivor| println!("  {survivor}"));
    assert!(tried.iter().all(|tried| *tried > 3) && found > 2 * equivalent && survivors.is_empty());
}
