//! Several lights by passes: the ambient part first, then for each light its part, added where the light reaches.
//!
//! Every pass draws the same triangles in the same order, l LSB nearer in pass l, under `less`: a fragment passes only where it is what
//! the first pass left, and what it writes lets no second one pass. So each pixel takes exactly one fragment a pass, the winner of the
//! first, also where triangles tie in depth.

use edgewalk_lockstep::{StallKind, render_rtl_passes};
use edgewalk_machine::{Blend, BlendKind, Hazard, Machine, Plan, PortVertex, Shadow, ShadowLight};
use edgewalk_model::{DrawState, Frame, Pass, Shading, Stalls, render_passes};

/// A screen of a few pixels and a map of four texels, with this policy.
fn machine(hazard: Hazard) -> Plan {
    let plain =
        Machine { width: 4, height: 4, guard_bits: 4, subpixel_bits: 2, hazard, ..Machine::default() };
    let blend = Blend { kind: BlendKind::Constant, hazard, ..plain.blend };
    let light = ShadowLight::Parallel;
    let shadow = Shadow { light, size: 2, guard_bits: 1, depth_bits: 8, ..plain.shadow };
    Machine { blend, shadow, ..plain }.plan().expect("can be built")
}

/// The pixel (1, 1), of this depth, colour, texel and depth from the light, all LSB.
fn dot(plan: &Plan, z: i64, color: i64, [tx, ty, d]: [i64; 3]) -> [PortVertex; 3] {
    let values: Vec<i64> = plan
        .channels()
        .iter()
        .map(|channel| {
            let value = match channel.name {
                "z" => z,
                "lx" => tx,
                "ly" => ty,
                "lz" => d,
                _ => color,
            };
            value << channel.vertex_fraction
        })
        .chain([0]) // opaque
        .collect();
    [(4, 4), (9, 4), (4, 9)].map(|(x, y)| plan.raw_vertex(x, y, &values))
}

/// Of the passes in turn: what is added, and the texel.
const LIGHTS: [(i64, i64); 2] = [(40, 0), (7, 1)];
const AMBIENT: i64 = 3;

/// The ambient pass and one for each light over fragments of these depths; each is told from the others by its colours, and the
/// second light reaches only fragments of even number.
fn frame(plan: &Plan, depths: &[i64]) -> (Vec<[PortVertex; 3]>, Vec<Pass>, Vec<Vec<u32>>) {
    let lights = LIGHTS.len() as i64;
    let mut triangles = Vec::new();
    let state = DrawState { depth_func: 1, ..DrawState::default() };
    let mut passes = vec![Pass { triangles: depths.len(), state, clear_depth: false, map: None }];
    for (place, z) in (0..).zip(depths) {
        triangles.push(dot(plan, 100 + lights + z, AMBIENT + place, [0, 0, 0]));
    }
    for (l, (color, texel)) in (1..).zip(LIGHTS) {
        for (place, z) in (0..).zip(depths) {
            // In shadow of the second light: one LSB behind its map.
            let behind = i64::from(l == 2 && place % 2 == 1);
            triangles.push(dot(plan, 100 + lights - l + z, color + place, [texel, 0, 9 + behind]));
        }
        let state = DrawState { blend_add: true, shadow_on: true, ..state };
        let map = Some(l as usize - 1);
        passes.push(Pass { triangles: depths.len(), state, clear_depth: false, map });
    }
    // Each light has its own map: the texels of the other are full of what hides everything.
    let maps = (0..2).map(|l| (0..4).map(|texel| if texel == l { 9 } else { 0 }).collect()).collect();
    (triangles, passes, maps)
}

/// What the pixel must have: the parts of the first of the nearest fragments.
fn expected(depths: &[i64]) -> u64 {
    let nearest = depths.iter().min().expect("some");
    let place = depths.iter().position(|z| z == nearest).expect("the nearest") as i64;
    let second = if place % 2 == 0 { LIGHTS[1].0 + place } else { 0 };
    (AMBIENT + place + LIGHTS[0].0 + place + second) as u64
}

/// Fragments that the first pass writes: each nearer than all before it.
fn passed_at_first(depths: &[i64]) -> usize {
    (0..depths.len()).filter(|i| depths[..*i].iter().all(|before| depths[*i] < *before)).count()
}

fn pixel(frame: &Frame) -> [u64; 3] {
    frame.rgb[4 + 1]
}

/// All sequences of up to six fragments of three depths.
fn sequences() -> Vec<Vec<i64>> {
    let mut all = vec![Vec::new()];
    for length in 0..6 {
        let shorter: Vec<Vec<i64>> =
            all.iter().filter(|depths: &&Vec<i64>| depths.len() == length).cloned().collect();
        all.extend(shorter.iter().flat_map(|depths| (0..3).map(|z| [&depths[..], &[z]].concat())));
    }
    all.into_iter().filter(|depths| !depths.is_empty()).collect()
}

#[test]
fn each_light_is_added_once() {
    let policies = [Hazard::Drain, Hazard::Interlock, Hazard::Forward].map(machine);
    let stalls = Stalls { seed: 1, rd: 60, data: 120, wr: 200 };
    let (mut checked, mut twice) = (0, 0);
    for (i, depths) in sequences().into_iter().enumerate() {
        let plan = &policies[i % 3];
        let (triangles, passes, maps) = frame(plan, &depths);
        let list = || triangles.iter().copied();
        let drawn =
            render_passes(plan, list(), &passes, &maps, stalls, &Shading::default()).expect("its own");
        assert_eq!(pixel(&drawn), [expected(&depths); 3], "{depths:?}");
        assert_eq!(drawn.passes.len(), 3);
        // Plain `equal` at the same depth takes every one that ties.
        let mut equal = passes.clone();
        equal[1..].iter_mut().for_each(|pass| pass.state.depth_func = 2);
        let level: Vec<_> = (0..3).flat_map(|_| frame(plan, &depths).0[..depths.len()].to_vec()).collect();
        let naive =
            render_passes(plan, level, &equal, &maps, Stalls::NONE, &Shading::default()).expect("its own");
        let ties = depths.iter().filter(|z| Some(*z) == depths.iter().min()).count();
        assert_eq!(naive.writes[4 + 1] as usize, passed_at_first(&depths) + 2 * ties, "{depths:?}");
        twice += u32::from(ties > 1);
        checked += 1;
    }
    println!("{checked} of 1092 sequences; with `equal` {twice} of them add a light more than once");
    assert_eq!((checked, twice), (1092, 749));
}

#[test]
fn the_netlist_does_so_too() {
    let policies = [Hazard::Drain, Hazard::Interlock, Hazard::Forward].map(machine);
    let mut checked = 0;
    for (i, depths) in sequences().into_iter().enumerate().filter(|(i, _)| i % 37 == 0) {
        let plan = &policies[i % 3];
        let (triangles, passes, maps) = frame(plan, &depths);
        let kind = StallKind::ALL[i % 2];
        let rtl =
            render_rtl_passes(plan, triangles.iter().copied(), &passes, &maps, kind, &Shading::default())
                .expect("its own");
        assert_eq!(pixel(&rtl), [expected(&depths); 3], "{depths:?}");
        let model = render_passes(plan, triangles, &passes, &maps, Stalls::NONE, &Shading::default())
            .expect("its own");
        assert_eq!((&rtl.z, &rtl.rgb, &rtl.lit, &rtl.id), (&model.z, &model.rgb, &model.lit, &model.id));
        if kind == StallKind::None {
            let cycles = |frame: &Frame| frame.passes.iter().map(|pass| pass.cycles).collect::<Vec<_>>();
            assert_eq!(cycles(&rtl), cycles(&model), "cycles of each pass");
        }
        checked += 1;
    }
    println!("{checked} sequences");
    assert_eq!(checked, 30);
}
