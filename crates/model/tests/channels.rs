//! Channels of the user's own: any number, kind, format, adders and segments; exact coverage, and every output within the
//! bound of its channel.

use crate::common::check::Errors;
use crate::common::{ALWAYS, Check, Triangle, outputs, place, random_machine, random_triangle};
use edgewalk_machine::{Kind, Plan};
use edgewalk_model::{DrawState, Drawn, Events, Stalls, render_with};
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::collections::HashMap;

fn random_triangles(plan: &Plan, count: usize, rng: &mut impl Rng) -> Vec<Triangle> {
    let each = |_| {
        let size = 2f64.powf(rng.random_range(-2.0..7.0));
        random_triangle(plan, size, rng)
    };
    (0..count).map(each).collect()
}

#[test]
fn every_channel_of_400_random_machines_lies_within_its_bound() {
    let mut rng = StdRng::seed_from_u64(1);
    let (mut events, mut pixels) = (Events::default(), 0);
    let all = [Kind::Unorm, Kind::Signed, Kind::Floor, Kind::Weight];
    let mut kinds = all.map(|_| Errors::default());
    let mut sizes: HashMap<_, u32> = HashMap::new();
    for number in 0..400 {
        let extra = (number % 5).to_string();
        let fixed = [
            ("screen.width", "44"),
            ("screen.height", "36"),
            ("edge.fill", "exact"),
            ("edge.kind", "exact"),
            ("channels.extra", &extra),
        ];
        let plan = random_machine(&fixed, &mut rng);
        let triangles = random_triangles(&plan, 30, &mut rng);
        let (check, frame) = Check::run(&plan, &triangles, Stalls::NONE);
        assert!(check.wrong.is_empty(), "{:?} in {plan:?}", check.wrong[0]);
        check.within_bounds();
        pixels += check.pixels;
        events.merge(&frame.events);
        *sizes.entry((plan.channels().len(), plan.adders)).or_default() += 1;
        for (channel, errors) in plan.channels().iter().zip(&check.errors) {
            let kind = &mut kinds[channel.kind as usize];
            kind.checked += errors.checked;
            kind.bounded += errors.bounded;
            kind.of_bound = kind.of_bound.max(errors.of_bound);
        }
    }
    println!("{pixels} pixels as the rule has them; {} numbers of channels and adders", sizes.len());
    for (kind, errors) in all.iter().zip(&kinds) {
        let Errors { checked, bounded, of_bound, .. } = errors;
        println!("{kind:?}: {checked} outputs, {bounded} of them with a bound, at most {of_bound:.4} of it");
        assert!(*bounded > 50_000 && *of_bound >= 0.9, "{kind:?}: nothing comes near its bound");
    }
    println!("{} wraps", events.edge.wrap);
    assert!(events.edge.wrap > 0 && sizes.len() >= 25, "{sizes:?}");
}

/// The frame holds of every channel what was written last, and 0 where nothing was.
#[test]
fn planes_hold_what_was_written_last() {
    let mut rng = StdRng::seed_from_u64(2);
    let (mut checked, mut empty, mut negative) = (0, 0, 0);
    for number in 0..40 {
        let extra = (1 + number % 4).to_string();
        let fixed = [("screen.width", "40"), ("screen.height", "30"), ("channels.extra", &extra)];
        let plan = random_machine(&fixed, &mut rng);
        let triangles = random_triangles(&plan, 12, &mut rng);
        let state = if number % 2 == 0 { ALWAYS } else { DrawState::default() };
        let mut written: HashMap<(i64, i64), Vec<i64>> = HashMap::new();
        let hook = |drawn: Drawn| {
            if let Drawn::Write(sample) = drawn {
                written.insert(place(&plan, sample.addr), outputs(&plan, sample.values));
            }
        };
        let stalls = Stalls { seed: 1, rd: 40, data: 40, wr: 40 };
        let frame = render_with(&plan, triangles, state, stalls, hook).expect("this machine's vertices");
        assert_eq!(frame.extra.len(), plan.extra as usize);
        for (i, plane) in frame.extra.iter().enumerate() {
            assert_eq!(plane.len(), frame.z.len());
            for (value, pixel) in plane.iter().zip(0i64..) {
                let at = (pixel % i64::from(plan.width), pixel / i64::from(plan.width));
                assert_eq!(*value, written.get(&at).map_or(0, |values| values[4 + i]), "e{i} at {at:?}");
                checked += 1;
                empty += i32::from(!written.contains_key(&at));
                negative += i32::from(*value < 0);
            }
        }
        for (rgb, pixel) in frame.rgb.iter().zip(0i64..) {
            let at = (pixel % i64::from(plan.width), pixel / i64::from(plan.width));
            let expected = written.get(&at).map_or([0; 3], |values| [1, 2, 3].map(|i| values[i] as u64));
            assert_eq!(*rgb, expected, "colour at {at:?}");
        }
    }
    println!("{checked} values, {empty} never written, {negative} negative");
    assert!(checked > 50_000 && empty > 0 && negative > 0);
}
