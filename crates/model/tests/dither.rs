//! DITHER: its pattern and its steps beside golden's, which were written apart; the share that a screen door leaves.

use crate::common::{machine, random_triangle, render};
use edgewalk_golden::dither::{Dither, left_out, pattern};
use edgewalk_model::dither::Cut;
use edgewalk_model::fast::{self, Path};
use edgewalk_model::{DrawState, Stalls};
use rand::SeedableRng;
use rand::rngs::StdRng;

/// Every colour of b bits at every place, for every b and n that a machine may have.
#[test]
fn every_colour_becomes_the_step_of_golden() {
    let mut checked = 0u64;
    for bits in 5..=16 {
        for left in 4..bits.min(8) {
            let plan =
                machine(&[("formats.color_bits", &bits.to_string()), ("dither.bits", &left.to_string())]);
            let (cut, golden) = (Cut::new(&plan), Dither { bits, left });
            let xb = plan.widths().x;
            for place in 0..64u32 {
                let (x, y) = (place % 8 + 40, place / 8 + 16);
                assert_eq!(cut.pattern(y << xb | x), pattern(x, y), "{x}, {y}");
            }
            for step in 0..1u32 << left {
                let color = cut.color_of(step);
                assert!((0..16).all(|place| cut.color(color, place) == step) && color >> bits == 0, "{step}");
            }
            for color in 0..1u32 << bits {
                for place in 0..16u32 {
                    let step = cut.color(color, pattern(place % 4, place / 4));
                    assert_eq!(
                        u64::from(step),
                        golden.ordered(color.into(), place % 4, place / 4),
                        "{bits}, {left}, {color}"
                    );
                    checked += 1;
                }
            }
        }
    }
    println!("{checked} colours");
    assert!(checked > 5_000_000);
}

/// A machine with DITHER draws what one without draws, each colour rounded at its pixel, in as many clocks.
#[test]
fn dithered_pictures_are_plain_pictures_rounded() {
    let (plain, rounded) = (machine(&[]), machine(&[("dither.bits", "5")]));
    let golden = Dither { bits: 8, left: 5 };
    let mut rng = StdRng::seed_from_u64(19);
    let triangles: Vec<_> = (0..200).map(|_| random_triangle(&plain, 200.0, &mut rng)).collect();
    let draw = |plan| render(plan, &triangles, DrawState::default(), Stalls::NONE);
    // The port is the same, so are the vertices.
    let (full, few) = (draw(&plain), draw(&rounded));
    assert_eq!(full.counters, few.counters);
    assert!(
        full.z == few.z && full.coverage == few.coverage && full.writes == few.writes && full.id == few.id
    );
    let mut checked = 0;
    for (at, (full, few)) in full.rgb.iter().zip(&few.rgb).enumerate() {
        let (x, y) = (at as u32 % plain.width, at as u32 / plain.width);
        assert_eq!(full.map(|color| golden.ordered(color, x, y)), *few, "{x}, {y}");
        checked += 1;
    }
    let (fast, path) =
        fast::draw(&rounded, triangles.iter().copied(), DrawState::default()).expect("its own vertices");
    assert!(path == Path::Fast && fast.rgb == few.rgb);
    assert_eq!(checked, 640 * 480);
}

/// Of each square of 4 x 4 pixels of a triangle as many are left out as its k_t says, the same ones as golden's.
#[test]
fn a_screen_door_leaves_out_golden_pixels() {
    let plan = machine(&[("dither.screen_door", "yes"), ("screen.width", "64"), ("screen.height", "64")]);
    let mut checked = 0;
    for k in (0..=256).step_by(3).chain([1, 15, 16, 17, 255, 256]) {
        let corner = |(x, y): (i32, i32)| plan.raw_vertex(x << 8, y << 8, &[100 << 4, 4000, 2000, 1000, k]);
        let square = [[(0, 0), (64, 0), (0, 64)], [(64, 0), (64, 64), (0, 64)]].map(|of| of.map(corner));
        let drawn = render(&plan, &square, DrawState::default(), Stalls::NONE);
        for (at, writes) in drawn.writes.iter().enumerate() {
            let (x, y) = (at as u32 % 64, at as u32 / 64);
            assert_eq!(*writes == 0, left_out(k as f64 / 256.0, x, y), "{k} at {x}, {y}");
            checked += 1;
        }
        assert_eq!(drawn.counters.writes, u64::from(drawn.writes.iter().sum::<u32>()));
        assert_eq!(drawn.counters.fragments, drawn.counters.writes, "what is dropped reads no depth");
    }
    println!("{checked} pixels");
    assert!(checked > 300_000);
}
