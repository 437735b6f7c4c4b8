//! Triangles of the sizes that programs send: a frame by seed, on 640x480 pixels.
//!
//! Of 194,000 triangles captured from 20 OpenGL programs 39 % covered no pixel, 22 % one to three and 7 % 64 or more, and setup took
//! 88 % of the cycles of a machine that divided (223 clocks a triangle, 48 culled). So many are these, and the largest so large
//! that it takes as many. How the rest divides, why some cover no pixel, shapes and values are this file's own.

use rand::{Rng, SeedableRng, seq::SliceRandom};
use rand_pcg::Pcg64Mcg;

/// The screen, px.
pub const SCREEN: [i64; 2] = [640, 480];

/// Parts of a pixel in which corners lie.
const PARTS: i64 = 256;

/// How a triangle is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Above, below, left or right of the screen.
    Off,
    /// Its corners on a line.
    Flat,
    /// Between the pixel centres.
    Between,
    /// So many pixels, both included.
    Pixels(u64, u64),
}

/// What a frame is made of, in percent of its triangles: 39 without a pixel, 22 of 1 to 3, 32 of 4 to 63, 7 of more.
pub const KINDS: [(Kind, usize); 7] = [
    (Kind::Off, 6),
    (Kind::Flat, 3),
    (Kind::Between, 30),
    (Kind::Pixels(1, 3), 22),
    (Kind::Pixels(4, 15), 19),
    (Kind::Pixels(16, 63), 13),
    (Kind::Pixels(64, 600), 7),
];

/// A corner: x, y in px, z, r, g, b in 0 to 1.
pub type Corner = [f64; 6];

/// `hundreds` times a hundred triangles in any order, always the same for a seed.
pub fn triangles(hundreds: usize, seed: u64) -> Vec<[Corner; 3]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut kinds: Vec<Kind> =
        KINDS.iter().flat_map(|(kind, share)| std::iter::repeat_n(*kind, share * hundreds)).collect();
    kinds.shuffle(&mut random);
    kinds.into_iter().map(|kind| shaded(&mut random, kind)).collect()
}

/// The text of a triangle file with them.
pub fn file(triangles: &[[Corner; 3]]) -> String {
    let mut text = format!("size {} {}\n", SCREEN[0], SCREEN[1]);
    for triangle in triangles {
        text.push('T');
        for corner in triangle {
            text.push(' ');
            for number in corner {
                text.push_str(&format!(" {number}"));
            }
            text.push_str(" 0");
        }
        text.push('\n');
    }
    text
}

type Places = [[i64; 2]; 3];

fn corners(random: &mut Pcg64Mcg, kind: Kind) -> Places {
    loop {
        let size = match kind {
            Kind::Pixels(least, most) => {
                let (least, most) = (least as f64 * 0.7, most as f64 * 1.2);
                least * (most / least).powf(random.random())
            }
            Kind::Off | Kind::Flat => 20.0 * random.random::<f64>(),
            Kind::Between => 0.3 * random.random::<f64>(),
        };
        let mut places = shape(random, size);
        match kind {
            Kind::Off => {
                let (axis, low) = (random.random_range(0..2), random.random());
                let ends = |f: fn(i64, i64) -> i64| places.iter().map(|p| p[axis]).reduce(f).unwrap_or(0);
                let away = random.random_range(1..100 * PARTS);
                let shift =
                    if low { -away - ends(i64::max) } else { SCREEN[axis] * PARTS + away - ends(i64::min) };
                places.iter_mut().for_each(|place| place[axis] += shift);
                return places;
            }
            Kind::Flat => {
                let [a, b, _] = places;
                return [a, b, [2 * b[0] - a[0], 2 * b[1] - a[1]]];
            }
            Kind::Between | Kind::Pixels(..) => {
                let (least, most) = if let Kind::Pixels(least, most) = kind { (least, most) } else { (0, 0) };
                if pixels(&places).is_some_and(|count| (least..=most).contains(&count)) {
                    return places;
                }
            }
        }
    }
}

/// A triangle of any shape, of about `area` pixels, about a place on the screen.
fn shape(random: &mut Pcg64Mcg, area: f64) -> Places {
    let middle = SCREEN.map(|side| random.random_range(0.0..side as f64));
    let corners: [[f64; 2]; 3] =
        std::array::from_fn(|_| [random.random_range(-1.0..1.0), random.random_range(-1.0..1.0)]);
    let scale = (area / (twice_area(corners).abs() / 2.0).max(0.05)).sqrt();
    corners.map(|corner| [0, 1].map(|i| ((middle[i] + scale * corner[i]) * PARTS as f64).round() as i64))
}

fn twice_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// Pixels on the screen whose centre lies inside; none if it has no area or a centre lies on an edge, whosever that pixel is.
fn pixels(places: &Places) -> Option<u64> {
    let [mut a, mut b, c] = places.map(|place| place.map(|x| 2 * x)); // centres are odd multiples of PARTS
    let cross =
        |p: [i64; 2], q: [i64; 2], r: [i64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
    match cross(a, b, c) {
        0 => return None,
        area if area < 0 => std::mem::swap(&mut a, &mut b),
        _ => {}
    }
    let range = |i: usize| {
        let (low, high) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        (low.div_euclid(2 * PARTS).max(0))..=(high.div_euclid(2 * PARTS).min(SCREEN[i] - 1))
    };
    let mut count = 0;
    for y in range(1) {
        for x in range(0) {
            let centre = [x, y].map(|place| (2 * place + 1) * PARTS);
            let sides = [cross(a, b, centre), cross(b, c, centre), cross(c, a, centre)];
            if sides.iter().all(|side| *side >= 0) {
                if sides.contains(&0) {
                    return None;
                }
                count += 1;
            }
        }
    }
    Some(count)
}

/// Depth and colours as on a surface: from a corner to the next they change with the way, over the screen by at most 1.
fn shaded(random: &mut Pcg64Mcg, kind: Kind) -> [Corner; 3] {
    let places = corners(random, kind).map(|place| place.map(|x| x as f64 / PARTS as f64));
    let values: [[f64; 3]; 4] = std::array::from_fn(|_| {
        [random.random(), random.random_range(-1.0..1.0), random.random_range(-1.0..1.0)]
    });
    places.map(|[x, y]| {
        let (right, down) = ((x - places[0][0]) / SCREEN[0] as f64, (y - places[0][1]) / SCREEN[0] as f64);
        let value = |[start, by_x, by_y]: [f64; 3]| (start + by_x * right + by_y * down).clamp(0.0, 1.0);
        let [z, r, g, b] = values.map(value);
        [x, y, z, r, g, b]
    })
}
