//! The light's own pass: the machine's map beside that of a second machine whose screen it is, and the picture beside one that finds its
//! map ready.

use crate::common::{self, Triangle, machine, random_machine, random_triangle};
use edgewalk_machine::{Blend, BlendKind, Fill, Machine, Plan, PortVertex, Precision, Shadow};
use edgewalk_model::fast::Reason;
use edgewalk_model::{Counters, DrawState, Frame, Pass, Shading, Stalls, render_passes};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The machine of section 10's *What transmits*: the map for a screen, depths of bz bits.
fn second(plan: &Plan) -> Plan {
    let z = Precision { bits: plan.shadow.depth_bits, ..plan.z };
    let kind = if plan.shadow.transmits() { BlendKind::Constant } else { BlendKind::None };
    let second = Machine {
        width: plan.shadow.size,
        height: plan.shadow.size,
        z,
        extra: 0,
        adders: 1,
        segments: 1,
        shadow: Shadow::default(),
        blend: Blend { kind, ..plan.blend },
        ..(**plan).clone()
    };
    second.plan().expect("the map is a screen")
}

/// The same triangle for the machine that draws its own map: its z has more bits, and it has more channels.
fn for_own_pass(plan: &Plan, second: &Plan, triangle: &Triangle) -> Triangle {
    triangle.map(|vertex| {
        let mut values = vec![0; plan.channels().len()];
        values[..4].copy_from_slice(&vertex.values()[..4]);
        if second.has_triangle_kt() {
            let kt = i64::from(triangle[0].kt());
            match plan.blend.kind {
                BlendKind::Interpolated => *values.last_mut().expect("k_t") = kt << plan.blend.kt_vertex,
                _ => values.push(kt),
            }
        } else if plan.has_triangle_kt() {
            values.push(0);
        }
        plan.raw_vertex(vertex.x(), vertex.y(), &values)
    })
}

/// What hides, then what transmits.
fn light_passes(plan: &Plan, counts: [usize; 2], light_pass: bool) -> Vec<Pass> {
    let all = plan.color.max();
    let hides = DrawState { color_write: false, light_pass, clear: [all; 3], ..DrawState::default() };
    let panes = DrawState { depth_write: false, color_write: true, ..hides };
    let map = light_pass.then_some(0);
    let pass = |triangles, state| Pass { triangles, map, ..Pass::all(state) };
    let mut passes = vec![pass(counts[0], hides), pass(counts[1], panes)];
    passes.truncate(if plan.shadow.transmits() { 2 } else { 1 });
    passes
}

fn words(second: &Plan, plan: &Plan, drawn: &Frame) -> Vec<u32> {
    let (size, side) = (plan.shadow.size as usize, plan.shadow.side_bits());
    let empty = u32::MAX >> (32 - plan.map_word_bits());
    let mut words = vec![empty; 1 << (2 * side)];
    for (place, (depth, [left, ..])) in drawn.z.iter().zip(&drawn.rgb).enumerate() {
        let word = if plan.shadow.transmits() { depth << second.color.bits | left } else { *depth };
        words[(place / size) << side | place % size] = word as u32;
    }
    words
}

fn random_own(rng: &mut impl Rng) -> Plan {
    let bits: u32 = rng.random_range(4..=32);
    let light = ["parallel", "perspective"][rng.random_range(0..2)];
    let fill = ["exact", "textbook"][usize::from(rng.random_bool(0.25))];
    let subpixel = if fill == "textbook" { 0 } else { rng.random_range(0..=8) };
    let number = |n: u32| n.to_string();
    let fixed = [
        ("shadow.own_pass", "yes".to_owned()),
        ("shadow.light", light.to_owned()),
        ("shadow.light_bits", number(24)),
        ("shadow.size", number(rng.random_range(1..=48))),
        ("shadow.depth_bits", number(rng.random_range(4..=bits.min(24)))),
        ("screen.width", number(rng.random_range(1..=40))),
        ("screen.height", number(rng.random_range(1..=40))),
        ("screen.guard_bits", number(rng.random_range(6..=9))),
        ("edge.fill", fill.to_owned()),
        ("screen.subpixel_bits", number(subpixel)),
        ("formats.z_bits", number(bits)),
        ("formats.z_vertex", number(0)),
        ("formats.color_vertex", number(0)),
        ("shadow.light_vertex", number(0)),
        ("blend.kt_vertex", number(0)),
        ("channels.extra", number(0)),
        ("interpolator.segments", number(1)),
        ("interpolator.adders", number(rng.random_range(1..=7))),
        ("shadow.transmits", if light == "parallel" || rng.random() { "yes" } else { "no" }.to_owned()),
    ];
    let fixed: Vec<_> = fixed.iter().map(|(key, value)| (*key, value.as_str())).collect();
    random_machine(&fixed, rng)
}

#[test]
fn the_map_is_that_of_a_second_machine_bit_by_bit() {
    let mut rng = Pcg64Mcg::seed_from_u64(61);
    let (mut machines, mut texels, mut drawn_texels, mut beyond, mut panes, mut textbook) =
        (0, 0, 0, 0, 0, 0);
    let (mut lit, mut shadow, mut interpolated) = (0, 0, 0);
    for _ in 0..150 {
        let plan = random_own(&mut rng);
        let second = second(&plan);
        let counts = [rng.random_range(1..8), rng.random_range(1..6)];
        let passes = light_passes(&plan, counts, false);
        let light: Vec<Triangle> = (0..passes.iter().map(|pass| pass.triangles).sum())
            .map(|_| random_triangle(&second, 60.0, &mut rng))
            .collect();
        let waits = Stalls { seed: rng.random(), rd: 40, data: 40, wr: 40 };
        let reference =
            render_passes(&second, light.clone(), &passes, &[], Stalls::NONE, &Shading::default())
                .expect("its own");
        let expected = words(&second, &plan, &reference);

        // The picture before, the map, and the picture again, now under the map.
        let picture: Vec<Triangle> = (0..6).map(|_| random_triangle(&plan, 40.0, &mut rng)).collect();
        let clear = [1, 0, plan.color.max()];
        let state =
            DrawState { shadow_on: true, ambient: plan.color.max() / 3, clear, ..DrawState::default() };
        let of_picture = Pass { triangles: 3, ..Pass::all(state) };
        let picture_again = picture.clone();
        let own: Vec<Triangle> = light.iter().map(|t| for_own_pass(&plan, &second, t)).collect();
        let mut all = picture[..3].to_vec();
        all.extend(&own);
        all.extend(&picture[3..]);
        let looks = Pass { map: Some(0), ..of_picture };
        let mut list = vec![of_picture];
        list.extend(light_passes(&plan, counts, true));
        list.push(looks);
        let drawn = render_passes(&plan, all.clone(), &list, &[], Stalls::NONE, &Shading::default())
            .expect("its own");
        assert_eq!(drawn.maps.len(), 1);
        assert_eq!(drawn.maps[0], expected, "{:?}", *plan);

        // A machine that finds the map ready draws the same, pass by pass.
        let mut without = (*plan).clone();
        without.set("shadow.own_pass", "no").expect("a word");
        let without = without.plan().expect("less");
        let stalled = render_passes(&plan, all, &list, &[], waits, &Shading::default()).expect("its own");
        assert_eq!(stalled.maps[0], expected, "under stalls: {:?}", *plan);
        let ready = render_passes(
            &without,
            picture,
            &[of_picture, looks],
            &[expected.clone()],
            Stalls::NONE,
            &Shading::default(),
        );
        let ready = ready.expect("the same port");
        let map_first = [&list[1..], &list[..1]].concat();
        let order = [&own[..], &picture_again[3..], &picture_again[..3]].concat();
        let first =
            render_passes(&plan, order, &map_first, &[], Stalls::NONE, &Shading::default()).expect("its own");
        let turned = [&picture_again[3..], &picture_again[..3]].concat();
        let as_ready = render_passes(
            &without,
            turned,
            &[looks, of_picture],
            &[expected.clone()],
            Stalls::NONE,
            &Shading::default(),
        );
        let as_ready = as_ready.expect("the same port");
        assert_eq!(
            (&first.z, &first.rgb, &first.lit),
            (&as_ready.z, &as_ready.rgb, &as_ready.lit),
            "the map first"
        );
        for drawn in [&drawn, &stalled] {
            assert_eq!((&drawn.z, &drawn.rgb, &drawn.lit), (&ready.z, &ready.rgb, &ready.lit));
            assert_eq!((&drawn.coverage, &drawn.writes), (&ready.coverage, &ready.writes));
        }
        let cycles = |of: &Counters| (of.cycles, of.activity);
        let [first, .., last] = &drawn.passes[..] else { panic!("three passes at least") };
        assert_eq!([first, last].map(cycles), [&ready.passes[0], &ready.passes[1]].map(cycles));
        assert!(drawn.events.shadow.own_map > 0 || reference.coverage.iter().all(|n| *n == 0), "{:?}", *plan);

        machines += 1;
        textbook += u32::from(plan.fill == Fill::Textbook);
        interpolated += u32::from(plan.blend.kind == BlendKind::Interpolated && plan.shadow.transmits());
        texels += expected.len();
        let side = plan.shadow.size as usize;
        for (place, count) in reference.coverage.iter().enumerate().filter(|(_, count)| **count > 0) {
            drawn_texels += 1;
            let (x, y) = (place % side, place / side);
            beyond += u32::from(x >= plan.width as usize || y >= plan.height as usize);
            panes += u32::from(reference.rgb[place][0] < plan.color.max());
            _ = count;
        }
        lit += ready.lit.iter().filter(|lit| **lit == 2).count();
        shadow += ready.lit.iter().filter(|lit| **lit == 1).count();
    }
    println!(
        "{machines} machines ({textbook} in textbook fill, {interpolated} with k_t interpolated): {texels} texels equal, {drawn_texels} drawn, \
         {beyond} beyond the picture's screen, {panes} behind panes; pixels lit {lit}, in shadow {shadow}"
    );
    assert!(machines == 150 && textbook > 10 && interpolated > 10 && beyond > 1000 && panes > 1000);
    assert!(lit > 100 && shadow > 50);
}

/// A machine with a map larger than its screen, or the other way round; lone pixels of triangles.
fn sides(screen: &str, size: &str) -> Plan {
    machine(&[
        ("shadow.own_pass", "yes"),
        ("shadow.light", "parallel"),
        ("shadow.size", size),
        ("shadow.depth_bits", "8"),
        ("screen.width", screen),
        ("screen.height", screen),
    ])
}

fn square(plan: &Plan, [x, y]: [i32; 2]) -> Triangle {
    let one = 1 << plan.subpixel_bits;
    let corner = |x: i32, y: i32| -> PortVertex {
        plan.raw_vertex(x * one, y * one, &[5 << plan.z.vertex_fraction, 0, 0, 0, 0, 0, 0])
    };
    [corner(x, y), corner(x + 2, y), corner(x, y + 2)]
}

#[test]
fn each_pass_has_its_own_scissor_and_addresses() {
    let light = DrawState { light_pass: true, ..DrawState::default() };
    let mut met = 0;
    for (screen, size) in [("8", "20"), ("20", "8"), ("8", "9"), ("5", "3")] {
        let plan = sides(screen, size);
        let [small, large] =
            [plan.width.min(plan.shadow.size), plan.width.max(plan.shadow.size)].map(|n| n as i32);
        for [x, y] in
            [[small, 0], [0, small], [small, small], [0, 0], [large - 1, 0], [0, large - 1], [large, 0]]
        {
            for light_pass in [false, true] {
                let (state, side) =
                    if light_pass { (light, plan.shadow.size) } else { (DrawState::default(), plan.width) };
                let pass = Pass { map: light_pass.then_some(0), ..Pass::all(state) };
                let drawn = render_passes(
                    &plan,
                    [square(&plan, [x, y])],
                    &[pass],
                    &[],
                    Stalls::NONE,
                    &Shading::default(),
                );
                let drawn = drawn.expect("its own");
                let bits = side.next_power_of_two().ilog2();
                let stored: Vec<u64> = match light_pass {
                    true => drawn.maps[0].iter().map(|word| u64::from(*word)).collect(),
                    false => {
                        let mut all = vec![plan.z.max(); 1 << (2 * bits)];
                        for (place, z) in drawn.z.iter().enumerate() {
                            all[(place / side as usize) << bits | place % side as usize] = *z;
                        }
                        all
                    }
                };
                // The half square of two pixels has the centres (x, y), (x + 1, y) and (x, y + 1) on edges or inside.
                for (place, z) in stored.iter().enumerate() {
                    let (px, py) = (place as i32 & ((1 << bits) - 1), place as i32 >> bits);
                    let inside = px >= x && py >= y && (px - x) + (py - y) < 1;
                    let on_screen = px < side as i32 && py < side as i32;
                    if on_screen {
                        assert_eq!(
                            *z == 5,
                            inside,
                            "{screen} {size} {light_pass}: ({px}, {py}) of ({x}, {y})"
                        );
                        met += u32::from(inside);
                    } else {
                        assert_ne!(*z, 5, "{screen} {size} {light_pass}: ({px}, {py}) lies outside");
                    }
                }
                let culled = drawn.events.setup.culled_lines + drawn.events.setup.culled_columns;
                assert_eq!(culled > 0, x >= side as i32 || y >= side as i32);
                // What one page takes the other does not see.
                if light_pass {
                    assert!(
                        drawn.z.iter().all(|z| *z == plan.z.max()) && drawn.writes.iter().all(|n| *n == 0)
                    );
                }
            }
        }
    }
    assert!(met > 20, "{met}");
}

#[test]
fn a_frame_with_a_map_is_ticked() {
    let plan = sides("8", "20");
    let triangle = [square(&plan, [1, 1])];
    let refused = edgewalk_model::fast::draw(&plan, triangle, common::ALWAYS).expect("its own").1;
    assert_eq!(refused, edgewalk_model::fast::Path::Ticked(Reason::Shadow));
}
