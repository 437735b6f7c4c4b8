//! The machine against the golden pictures, which share no arithmetic with it.

use crate::common;
use crate::common::{random_triangle, render};
use edgewalk_golden::{Fill, draw, fragments, half_triangles};
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::{DrawState, Stalls};
use edgewalk_scene as scene;
use rand::{Rng, SeedableRng, rngs::StdRng};

/// Triangles of the port as the golden rasterizer takes them: pixels, and values in [0, 1].
fn frame(machine: &Plan, triangles: &[common::Triangle]) -> scene::Frame {
    let mut frame = scene::Frame::new(machine.width, machine.height);
    frame.triangles = triangles
        .iter()
        .map(|triangle| {
            scene::Triangle(triangle.map(|v| {
                let place = |c: i32| f64::from(c) / f64::from(1u32 << machine.subpixel_bits);
                let unit = |i: usize| {
                    let c = machine.channels()[i];
                    v.values()[i] as f64 / (c.max() << c.vertex_fraction) as f64
                };
                let [z, r, g, b] = [0, 1, 2, 3].map(unit);
                scene::Vertex { x: place(v.x()), y: place(v.y()), z, r, g, b, ..scene::Vertex::default() }
            }))
        })
        .collect();
    frame
}

/// |stored - golden| in LSB, golden in [0, 1].
fn off(stored: u64, golden: f64, max: u64) -> f64 {
    (stored as f64 - golden * max as f64).abs()
}

#[test]
fn pictures_with_the_nearest_fragment_on_top() {
    let machine = Plan::default();
    let mut rng = StdRng::seed_from_u64(1);
    let triangles: Vec<_> = (0..1500)
        .map(|_| {
            let size = 2f64.powf(rng.random_range(-3.0..9.0));
            random_triangle(&machine, size, &mut rng)
        })
        .collect();
    let golden = draw(&frame(&machine, &triangles), Fill::Exact { subpixel_bits: machine.subpixel_bits });
    let drawn = render(&machine, &triangles, DrawState::default(), Stalls::NONE);
    assert_eq!(drawn.coverage, golden.coverage);
    let (mut worst_z, mut worst_color, mut others, mut checked) = (0f64, 0f64, 0, 0);
    for i in 0..golden.z.len() {
        worst_z = worst_z.max(off(drawn.z[i], golden.z[i], machine.z.max()));
        if drawn.id[i] != golden.id[i] {
            others += 1; // two depths within the errors of both
            continue;
        }
        assert!(drawn.id[i] < 0 || drawn.writes[i] > 0);
        for (stored, golden) in drawn.rgb[i].into_iter().zip(golden.rgb[i]) {
            worst_color = worst_color.max(off(stored, golden, machine.color.max()));
        }
        checked += usize::from(drawn.id[i] >= 0);
    }
    println!(
        "{checked} pixels drawn, z {worst_z:.3} LSB, colour {worst_color:.3} LSB, {others} by another triangle"
    );
    assert!(checked > 100_000 && worst_color <= 1.0);
    assert!(worst_z <= 1.0 + if others > 0 { 2.0 } else { 0.0 } && others < checked / 1000);
}

/// Every fragment of every triangle against the half-planes and the plane in f64.
#[test]
fn a_hundred_thousand_triangles() {
    const TRIANGLES: usize = 100_000;
    let machine = Plan::default();
    let mut rng = StdRng::seed_from_u64(3);
    let (mut worst, mut checked) = ([0f64; 4], 0u64);
    let mut drawn = Vec::new();
    for _ in 0..TRIANGLES / 1000 {
        let triangles: Vec<_> = (0..1000)
            .map(|_| {
                let size = 2f64.powf(rng.random_range(-8.0..9.0));
                random_triangle(&machine, size, &mut rng)
            })
            .collect();
        drawn.clear();
        common::fragments(&machine, &triangles, |id, (x, y), values| {
            let values: [i64; 4] = values[..4].try_into().expect("z, r, g, b");
            drawn.push(((id as u64) << 32 | (y as u64) << 16 | x as u64, values));
        });
        // A span may run from right to left.
        drawn.sort_by_key(|(place, _)| *place);
        let mut drawn = drawn.iter();
        let frame = frame(&machine, &triangles);
        let screen = (machine.width, machine.height);
        for (triangle, id) in frame.triangles.iter().zip(0..) {
            fragments(triangle, frame.mode, machine.subpixel_bits, screen, |golden| {
                let (place, values) = drawn.next().expect("as many fragments as the half-planes hold");
                let [by, y, x] = [32, 16, 0].map(|shift| (place >> shift) as u32 & 0xffff);
                assert_eq!((by as usize, x, y), (id, golden.x, golden.y), "{triangle:?}");
                let [r, g, b] = golden.rgb();
                for (i, golden) in [golden.z(), r, g, b].into_iter().enumerate() {
                    worst[i] = worst[i].max(off(values[i] as u64, golden, machine.channels()[i].max()));
                }
                checked += 1;
            });
        }
        assert_eq!(drawn.next(), None, "a fragment too many");
    }
    println!("{TRIANGLES} triangles, {checked} fragments, at most {worst:.3?} LSB off");
    assert!(checked > 10_000_000 && worst.iter().all(|error| *error <= 1.0));
}

#[test]
fn the_textbook_listing_in_its_order() {
    let mut machine = Machine::preset("textbook").expect("a preset");
    machine.set("edge.kind", "exact").expect("a key");
    let machine = machine.plan().expect("can be built");
    let mut rng = StdRng::seed_from_u64(2);
    let triangles: Vec<_> = (0..400)
        .map(|_| {
            let size = rng.random_range(1.0..200.0);
            random_triangle(&machine, size, &mut rng)
        })
        .collect();
    let mut drawn = Vec::new();
    common::fragments(&machine, &triangles, |id, (x, y), values| {
        drawn.push((id, x as u32, y as u32, values))
    });
    let mut drawn = drawn.into_iter();
    let frame = frame(&machine, &triangles);
    let (mut worst, mut checked) = (0f64, 0u32);
    for (triangle, id) in frame.triangles.iter().zip(0..) {
        half_triangles(triangle, frame.mode, (machine.width, machine.height), |_, golden| {
            let (by, x, y, output) = drawn.next().expect("as many fragments as in the listing");
            assert_eq!((by as usize, x, y), (id, golden.x, golden.y), "{triangle:?}");
            let [r, g, b] = golden.rgb();
            for ((output, golden), channel) in
                output.into_iter().zip([golden.z(), r, g, b]).zip(machine.channels())
            {
                let turn = (channel.max() + 1) as f64; // outside the triangle the listing leaves the range, and wraps
                let error = (output as f64 - golden * channel.max() as f64).rem_euclid(turn);
                worst = worst.max(error.min(turn - error));
            }
            checked += 1;
        });
    }
    assert_eq!(drawn.next(), None, "a fragment too many");
    println!("{checked} fragments, at most {worst:.3} LSB off");
    assert!(checked > 100_000 && worst <= 1.0);
}
