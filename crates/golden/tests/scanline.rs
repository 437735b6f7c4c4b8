//! Hidden surfaces by scan lines: the picture of a depth buffer, each pixel shaded once.

use edgewalk_golden::{Fill, NO_TRIANGLE, NotOpaque, Work, draw, scan_lines};
use edgewalk_scene::{Blending, DepthFunc, Frame, Line, Polygon, Scene, ShadeMode, Triangle, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

const EXACT: Fill = Fill::Exact { subpixel_bits: 8 };

/// Anywhere around the screen, at one of a few depths or any.
fn vertex(rng: &mut Pcg64, side: u32, depths: u32) -> Vertex {
    let reach = f64::from(side) * 0.2;
    let mut place = || (rng.random_range(-reach..f64::from(side) + reach) * 4.0).round() / 4.0;
    let (x, y) = (place(), place());
    let z = match depths {
        0 => rng.random(),
        n => f64::from(rng.random_range(0..=n)) / f64::from(n),
    };
    Vertex { x, y, z, r: rng.random(), g: rng.random(), b: rng.random(), ..Vertex::default() }
}

/// Triangles that cut each other, crossing polygons with holes, and among flat ones many at equal depths.
fn frame(rng: &mut Pcg64, round: u32) -> Frame {
    let side = rng.random_range(1..60);
    let depths = [0, 0, 2, 4][round as usize % 4];
    let flat = round % 3 == 0;
    let mut frame = Frame::new(side, side);
    let level = |list: &mut [Vertex]| {
        let z = list[0].z;
        list.iter_mut().filter(|_| flat).for_each(|v| v.z = z);
    };
    frame.triangles = (0..rng.random_range(0..12))
        .map(|_| {
            let mut corners = [0; 3].map(|_| vertex(rng, side, depths));
            level(&mut corners);
            Triangle(corners)
        })
        .collect();
    for _ in 0..rng.random_range(0..4) {
        let after = rng.random_range(0..=frame.triangles.len());
        let contours = (0..rng.random_range(1..3))
            .map(|_| {
                let mut contour: Vec<Vertex> =
                    (0..rng.random_range(1..8)).map(|_| vertex(rng, side, depths)).collect();
                level(&mut contour);
                contour
            })
            .collect();
        frame.polygons.push(Polygon { contours, after });
    }
    frame.polygons.sort_by_key(|polygon| polygon.after);
    frame.depth = Some(if round % 2 == 0 { DepthFunc::Less } else { DepthFunc::Lequal });
    frame
}

/// Draws both ways; gives the work and the pixels that show something.
fn same(frame: &Frame) -> (Work, u64) {
    let buffer = draw(frame, EXACT);
    let (lines, work) = scan_lines(frame, 8).expect("an opaque frame");
    assert!(lines.coverage == buffer.coverage, "coverage");
    assert!(lines.id == buffer.id, "ids");
    assert!(lines.z == buffer.z, "depths");
    assert!(lines.rgb == buffer.rgb, "colours");
    let shown = buffer.id.iter().filter(|id| **id != NO_TRIANGLE).count() as u64;
    assert_eq!(work.shaded, shown);
    assert_eq!(work.fragments, buffer.coverage.iter().map(|count| u64::from(*count)).sum::<u64>());
    assert_eq!(work.deepest, buffer.coverage.iter().max().map_or(0, |most| *most as usize));
    (work, shown)
}

#[test]
fn random_frames_equal_a_depth_buffer() {
    let mut rng = Pcg64::seed_from_u64(60);
    let (mut shown, mut cut, mut fragments) = (0, 0, 0);
    for round in 0..1_500 {
        let frame = frame(&mut rng, round);
        let (work, pixels) = same(&frame);
        (shown, fragments) = (shown + pixels, fragments + work.fragments);
        cut += u32::from(work.stretches > 0 && work.deepest > 1);
    }
    println!("1500 frames, {shown} pixels of {fragments} fragments; {cut} with polygons over each other");
    assert!(shown > 500_000 && 2 * fragments > 3 * shown && cut > 700);
}

#[test]
fn scenes_equal_a_depth_buffer() {
    for name in ["torus", "torus-knot", "terrain"] {
        let scene = Scene::builtin(name).unwrap_or_else(|error| panic!("{error}"));
        let frame = scene.frame(160, 120, 1000.0, ShadeMode::Gouraud);
        let (work, shown) = same(&frame);
        println!("{name}: {work:?}");
        assert!(shown > 2_000 && work.fragments > work.shaded && work.active > 20, "{name}");
    }
}

#[test]
fn frames_without_one_order_are_refused() {
    let plain = Frame::new(4, 4);
    let line = Line { ends: [Vertex::default(); 2], after: 0 };
    let refused = [
        (Frame { depth: None, ..plain.clone() }, NotOpaque::Depth),
        (Frame { depth: Some(DepthFunc::Greater), ..plain.clone() }, NotOpaque::Depth),
        (Frame { depth_write: false, ..plain.clone() }, NotOpaque::Depth),
        (Frame { blend: Blending::Mix, ..plain.clone() }, NotOpaque::Blend),
        (Frame { lines: vec![line], ..plain.clone() }, NotOpaque::Lines),
    ];
    for (frame, why) in refused {
        assert_eq!(scan_lines(&frame, 8).map(|_| ()), Err(why));
    }
    assert!(scan_lines(&plain, 8).is_ok());
}
