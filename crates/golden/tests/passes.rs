//! Rules that change between triangles, against a plain loop over the fragments.

use edgewalk_golden::{Fill, Picture, draw, fragments};
use edgewalk_scene::{Blending, Change, DepthFunc, Frame, State, Triangle, Vertex};
use rand::{Rng, SeedableRng, rngs::StdRng};

const SCREEN: (u32, u32) = (12, 9);

fn triangle(random: &mut StdRng) -> Triangle {
    Triangle([(); 3].map(|()| {
        let [z, r, g, b, kt]: [f64; 5] = random.random();
        let (x, y) = (random.random_range(-4.0..16.0), random.random_range(-4.0..13.0));
        Vertex { x, y, z, r, g, b, kt, ..Vertex::default() }
    }))
}

fn state(random: &mut StdRng) -> State {
    State {
        depth: random.random_bool(0.9).then(|| DepthFunc::ALL[random.random_range(0..8)]),
        depth_write: random.random_bool(0.7),
        blend: Blending::ALL[random.random_range(0..3)],
        color_write: random.random_bool(0.8),
        light: 1,
    }
}

/// Depth, colour, writes and id of every pixel, fragment by fragment. Depths of different triangles differ by much more
/// than f64 errs; those of the same triangle are the same.
fn plain(frame: &Frame) -> (Vec<f64>, Vec<[f64; 3]>, Vec<u32>, Vec<i32>) {
    let size = (SCREEN.0 * SCREEN.1) as usize;
    let (mut z, mut rgb) = (vec![1.0; size], vec![frame.clear; size]);
    let (mut writes, mut id) = (vec![0; size], vec![-1; size]);
    let mut now = frame.state();
    for (place, triangle) in frame.triangles.iter().enumerate() {
        for change in frame.changes.iter().filter(|change| change.after == place) {
            now = change.state;
            if change.clear_depth {
                z.fill(1.0);
            }
        }
        fragments(triangle, frame.mode, 8, SCREEN, |f| {
            let at = (f.y * SCREEN.0 + f.x) as usize;
            let (new, old) = (f.z(), z[at]);
            let passes = match now.depth {
                None | Some(DepthFunc::Always) => true,
                Some(DepthFunc::Never) => false,
                Some(DepthFunc::Less) => new < old,
                Some(DepthFunc::Equal) => new == old,
                Some(DepthFunc::Lequal) => new <= old,
                Some(DepthFunc::Greater) => new > old,
                Some(DepthFunc::Notequal) => new != old,
                Some(DepthFunc::Gequal) => new >= old,
            };
            if !passes {
                return;
            }
            if now.depth_write && now.depth.is_some() {
                z[at] = new;
            }
            if now.color_write {
                let (front, kt) = (f.rgb(), f.kt());
                rgb[at] = [0, 1, 2].map(|c| match now.blend {
                    Blending::Off => front[c],
                    Blending::Mix => (1.0 - kt) * front[c] + kt * rgb[at][c],
                    Blending::Add => (front[c] + rgb[at][c]).min(1.0),
                });
                writes[at] += 1;
                id[at] = place as i32;
            }
        });
    }
    (z, rgb, writes, id)
}

#[test]
fn every_pass_has_its_own_rules() {
    let mut random = StdRng::seed_from_u64(1);
    let (mut pixels, mut equal, mut cleared) = (0, 0, 0);
    for _ in 0..400 {
        let mut frame = Frame::new(SCREEN.0, SCREEN.1);
        frame.clear = random.random();
        frame.triangles = (0..6).map(|_| triangle(&mut random)).collect();
        // Drawn again, so that depths are equal.
        frame.triangles.extend_from_within(2..5);
        let first = state(&mut random);
        (frame.depth, frame.depth_write) = (first.depth, first.stores_depth());
        (frame.blend, frame.color_write) = (first.blend, first.color_write);
        for after in 1..9 {
            if random.random_bool(0.4) {
                let clear_depth = random.random_bool(0.2);
                frame.changes.push(Change { after, state: state(&mut random), clear_depth });
                equal += i32::from(
                    after > 5 && frame.changes.last().map(|c| c.state.depth) == Some(Some(DepthFunc::Equal)),
                );
                cleared += i32::from(clear_depth);
            }
        }
        let Picture { z, rgb, writes, id, .. } = draw(&frame, Fill::Exact { subpixel_bits: 8 });
        let wanted = plain(&frame);
        assert!((&z, &rgb, &writes, &id) == (&wanted.0, &wanted.1, &wanted.2, &wanted.3), "{frame:?}");
        pixels += z.len();
    }
    println!("{pixels} pixels, {equal} passes where equal, {cleared} that clear");
    assert!(pixels == 43_200 && equal > 20 && cleared > 100);
}
