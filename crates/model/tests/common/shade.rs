//! Formula (1) of the specification, the colour that tables ask for, and random records and tables, in plain numbers.

use super::Triangle;
use edgewalk_machine::{Entry, Fill, Plan, Record, ShadeColour, Term};
use edgewalk_model::Shading;
use rand::Rng;

/// The spans of the triangle run to the left: its major edge lies right.
pub fn leftward(plan: &Plan, triangle: &Triangle) -> bool {
    let mut sorted = triangle.map(|v| (i128::from(v.x()), i128::from(v.y())));
    sorted.sort_by_key(|v| v.1);
    let [(u0, v0), (u1, v1), (u2, v2)] = sorted;
    plan.fill == Fill::Exact && (u1 - u0) * (v2 - v0) < (u2 - u0) * (v1 - v0)
}

/// The word of a term by formula (1), modulo 2^w.
pub fn word(term: &Term, words: &[u64; 6], i: i64, n: i64) -> u64 {
    let (i, n) = (i128::from(i), i128::from(n));
    let factors = [1, i, n, i * (i - 1) / 2, i * n, n * (n - 1) / 2];
    let used = term.words() as usize;
    let products =
        words.iter().zip(factors).take(used).map(|(word, f)| u128::from(*word).wrapping_mul(f as u128));
    products.fold(0, u128::wrapping_add) as u64 & (u64::MAX >> (64 - term.word()))
}

/// The words of all terms at a pixel of a triangle.
pub fn words(plan: &Plan, record: &Record, leftward: bool, (x, y): (i64, i64)) -> Vec<u64> {
    let i = (x - i64::from(record.x)) * if leftward { -1 } else { 1 };
    let n = y - i64::from(record.y);
    plan.terms().iter().zip(&record.terms).map(|(term, own)| word(term, own, i, n)).collect()
}

/// The output of a term: floor(word / 2^r), signed.
pub fn output(term: &Term, word: u64) -> i64 {
    let value = (word >> term.fraction) as i64;
    if value >> (term.bits - 1) > 0 { value - (1 << term.bits) } else { value }
}

/// The cosines that SHADE sees, of the outputs of the terms: these, or with BUMP those of a turned normal, or with NORMAL by its
/// table, or with LAMP by its tables, and then what is left of the light; in plain numbers.
pub fn cosines(plan: &Plan, words: &Shading, record: &Record, outputs: &[i64]) -> Vec<i64> {
    let roots = &words.roots;
    if plan.shade.is_positional() {
        return lamp(plan, roots, record, outputs);
    }
    let outputs = &turned(plan, &words.textures, record.material, outputs);
    let Some((square, products)) = outputs.split_last().filter(|_| plan.shade.normalises()) else {
        return outputs.clone();
    };
    let s = (*square).clamp(16384, 65535);
    let entry = roots[(s / 256) as usize];
    let (v, slope) = ((entry / 1024 % 131_072) as i64, (entry % 1024) as i64);
    let y = (v - (slope * (s % 256) + 128).div_euclid(256)).rem_euclid(131_072);
    let t = plan.shade.table_bits;
    let index = |(place, product): (usize, &i64)| {
        let c = (product * y + 32768).div_euclid(65536);
        let highlight = place % 2 == 1;
        let scaled = if highlight { ((c - 65536) << record.gloss) + 65536 } else { c };
        let half = 1i64 << (t + 1 + if highlight { plan.shade.gloss_bits } else { 0 });
        scaled.div_euclid(1 << (16 - t)).max(-half).min(half - 1)
    };
    products.iter().enumerate().map(index).collect()
}

/// Section 17.
fn lamp(plan: &Plan, words: &[u128], record: &Record, outputs: &[i64]) -> Vec<i64> {
    let cut = |x: i64| x.max(-131_072).min(131_071);
    let look = |place: i64, low: i64| {
        let word = words[place as usize];
        let (v, slope) = ((word / 65536 % 131_072) as i64, (word % 65536) as i64);
        (v - (slope * low + 512).div_euclid(1024)).rem_euclid(131_072)
    };
    let times = |a: i64, b: i64| cut((a * b + 32768).div_euclid(65536));
    let near = |p: i64, k: u32| cut((p * 2i64.pow(k) + 64).div_euclid(128));
    let root = |x: i64| {
        let x = x.max(0).min((1 << 30) - 1);
        let k = (0..=7).filter(|k| x * 4i64.pow(*k) < 1 << 30).max().unwrap_or(0);
        let m = (x * 4i64.pow(k)).div_euclid(1 << 14).max(1 << 14);
        (k, m, look(m / 256, 4 * (m % 256)))
    };
    let [dd, pl, dv, da, pv, nn] = [0, 1, 2, 3, 4, 5].map(|place| outputs[place]);
    let (k, m, y) = root(dd);
    let a = look(512 + 64 * i64::from(k) + m / 1024, m % 1024);
    let [toward, w, c] = [pl, dv, da].map(|p| times(near(p, k), y));
    let (k, _, y) = root(nn * 16384);
    let (d, e) = (times(near(toward * 128, k), y), times(near(pv, k), y));
    let z = 65536 - c;
    let within = z.max(0).min(65535);
    let edge = (words[0] / 65536 % 131_072) as i64;
    let f = if z > edge { 0 } else { look(256 + within / 256, 4 * (within % 256)) };
    let beam = times(a, f);
    let (k, _, y) = root((65536 + w) * 8192);
    let h = times(near((d + e) * 64, k), y);
    let t = plan.shade.table_bits;
    let end = |number: i64, bits: u32| number.max(-(1 << (bits - 1))).min((1 << (bits - 1)) - 1);
    let highlight = ((h - 65536) * 2i64.pow(record.gloss) + 65536).div_euclid(1 << (16 - t));
    vec![
        end((d * beam).div_euclid(1 << (32 - t)), t + 2),
        end(highlight, t + plan.shade.gloss_bits + 2),
        beam,
    ]
}

/// The cosines, and with NORMAL N·N, that are left of the outputs of the terms once the slopes of the texel have turned the normal.
fn turned(plan: &Plan, textures: &[u128], material: u32, outputs: &[i64]) -> Vec<i64> {
    let lights = 2 * plan.shade.lights as usize;
    let first = lights + usize::from(plan.shade.normalises());
    if !plan.shade.bumps() {
        return outputs[..first].to_vec();
    }
    let slopes = {
        let modulus = 1i128 << plan.shade.slope_bits;
        let word = texel(plan, textures, material, outputs) as i128;
        let signed = |part: i128| if part >= modulus / 2 { part - modulus } else { part };
        [signed(word / modulus % modulus), signed(word % modulus)]
    };
    let one = 1i128 << (plan.shade.slope_bits - 1);
    let of = |place: usize| i128::from(outputs[place]);
    let within = |sum: i128, divisor: i128, bits: u32| {
        let end = 1i128 << (bits - 1);
        sum.div_euclid(divisor).max(-end).min(end - 1) as i64
    };
    let cosine = |place: usize| {
        let sum = of(place) * one + slopes[0] * of(first + 2 * place) + slopes[1] * of(first + 2 * place + 1);
        if plan.shade.normalises() {
            return within(2 * sum + one, 2 * one, 18); // to nearest
        }
        let bits = if place % 2 == 0 {
            plan.shade.table_bits
        } else {
            plan.shade.table_bits + plan.shade.gloss_bits
        };
        within(sum, 16 * one, bits + 2)
    };
    let mut turned: Vec<i64> = (0..lights).map(cosine).collect();
    if plan.shade.normalises() {
        let [u, v] = slopes;
        let growth = |k: usize| of(first + 2 * lights + k);
        let sum = of(lights) * one * one + u * u * growth(0) + u * v * growth(1) + v * v * growth(2);
        turned.push(within(sum, one * one, 18));
    }
    turned
}

/// The word of the texel that the last two outputs name.
fn texel(plan: &Plan, textures: &[u128], material: u32, outputs: &[i64]) -> u128 {
    let side = 1i64 << plan.shade.texture_bits;
    let [u, v] = [outputs.len() - 2, outputs.len() - 1].map(|i| outputs[i].rem_euclid(side) as u32);
    textures[plan.texel_place(material, u, v)]
}

/// The colour of a fragment behind TEXEL: c·x/(2^b - 1) rounded to nearest, x the texel's, which repeats.
pub fn textured(plan: &Plan, textures: &[u128], material: u32, outputs: &[i64], own: [u32; 3]) -> [u32; 3] {
    if !plan.shade.textures() {
        return own;
    }
    let below = if plan.shade.bumps() { 2 * plan.shade.slope_bits } else { 0 };
    let word = texel(plan, textures, material, outputs) >> below;
    let (b, max) = (plan.color.bits, plan.color.max());
    std::array::from_fn(|i| {
        let part = (word >> (b * (2 - i as u32))) as u64 & max;
        ((2 * u64::from(own[i]) * part + max) / (2 * max)) as u32
    })
}

/// The chords of 1/√x, each lowered by half of its gap.
pub fn true_roots(plan: &Plan) -> Vec<u128> {
    let root = |x: f64| (x / 256.0).powf(-0.5);
    let entry = |k: u32| {
        let (low, high) = (root(k.into()), root(f64::from(k) + 1.0));
        let chord = |f: f64| low + (high - low) * f;
        let gap = (0..=256)
            .map(|f| f64::from(f) / 256.0)
            .map(|f| chord(f) - root(f64::from(k) + f))
            .fold(0.0, f64::max);
        let v = ((low - gap / 2.0) * 65536.0).round() as u32;
        plan.root_word(v, ((low - high) * 65536.0).round() as u32)
    };
    (0..256).map(|k| if k < 64 { 0 } else { entry(k) }).collect()
}

/// The colour of a fragment of these cosines, and of this colour of its own.
pub fn colour(plan: &Plan, tables: &[u128], material: u32, cosines: &[i64], own: [u32; 3]) -> [u32; 3] {
    let (b, end) = (plan.color.bits, 1i64 << plan.shade.table_bits);
    let max = (1u128 << b) - 1;
    let index = |cosine: i64| cosine.max(0).min(end - 1) as u32;
    let (mut light, mut highlight) = ([0u128; 3], 0);
    let (of_lights, beam) = cosines.split_at(2 * plan.shade.lights as usize);
    for (l, pair) in (0..).zip(of_lights.chunks(2)) {
        let at = |cosine| tables[plan.table_place(material, l, index(cosine))];
        let diffuse = at(pair[0]) >> b;
        for (place, light) in (0..3u32).rev().zip(&mut light) {
            *light += match plan.shade.colour {
                ShadeColour::Tables => diffuse >> (place * b) & max,
                ShadeColour::Multiply => diffuse,
            };
        }
        let own = if pair[0] < 0 { 0 } else { at(pair[1]) & max };
        // To nearest, half up; of LAMP's light.
        highlight += beam.first().map_or(own, |beam| ((2 * own * *beam as u128 + 65536) / 131_072).min(max));
    }
    let one = 4u128 << b;
    std::array::from_fn(|i| {
        let diffuse = match plan.shade.colour {
            ShadeColour::Tables => light[i],
            // To nearest, half up.
            ShadeColour::Multiply => (2 * u128::from(own[i]) * light[i].min(one) + one) / (2 * one),
        };
        (diffuse + highlight).min(max) as u32
    })
}

/// Records of random words for the triangles, their reference pixels about where each begins, and random tables, of every
/// material that a record has.
pub fn random_shading(plan: &Plan, triangles: &[Triangle], rng: &mut impl Rng) -> Shading {
    let materials = rng.random_range(1..=3u32.min(1 << plan.shade.material_bits));
    let mut tables = vec![0; plan.table_place(materials, 0, 0)];
    for material in 0..materials {
        for light in 0..plan.shade.lights {
            for entry in 0..1 << plan.shade.table_bits {
                tables[plan.table_place(material, light, entry)] = plan.table_word(random_entry(plan, rng));
            }
        }
    }
    let roots = (0..plan.root_words()).map(|_| plan.root_word(rng.random(), rng.random())).collect();
    let texels = if plan.shade.textures() { plan.texel_place(materials, 0, 0) } else { 0 };
    let colour = |rng: &mut _| [(); 3].map(|()| Rng::random(rng));
    let textures =
        (0..texels).map(|_| plan.texel_word(colour(rng), [(); 2].map(|()| rng.random()))).collect();
    let records = triangles.iter().map(|triangle| random_record(plan, triangle, materials, rng)).collect();
    Shading { records, tables, roots, textures }
}

fn random_entry(plan: &Plan, rng: &mut impl Rng) -> Entry {
    let largest = plan.color.max() as u32;
    // Sums that are cut and sums that are not.
    let most = if rng.random_bool(0.5) { largest / 3 } else { largest };
    let mut part = || rng.random_range(0..=most);
    match plan.shade.colour {
        ShadeColour::Tables => Entry::Colours([part(), part(), part()], part()),
        ShadeColour::Multiply => Entry::Light(part() * 5, part()),
    }
}

fn random_record(plan: &Plan, triangle: &Triangle, materials: u32, rng: &mut impl Rng) -> Record {
    let one = 1i64 << plan.subpixel_bits;
    let columns = triangle.map(|v| i64::from(v.x()).div_euclid(one));
    let top = triangle.iter().map(|v| i64::from(v.y()).div_euclid(one)).min().unwrap_or(0);
    let (left, right) = (columns.into_iter().min().unwrap_or(0), columns.into_iter().max().unwrap_or(0));
    let wide = i64::from(plan.width) + 8;
    let x = rng.random_range(left..=right).clamp(-8, wide) + rng.random_range(-3..=3);
    let y = (top - rng.random_range(0..3)).clamp(0, i64::from(plan.height) - 1);
    let terms = plan.terms().iter().map(|_| random_words(rng)).collect();
    let gloss = if plan.shade.normalises() { rng.random_range(0..=8) } else { 0 };
    Record { x: x as i32, y: y as u32, material: rng.random_range(0..materials), gloss, terms }
}

/// Any bits; now and then a step of 0.
fn random_words(rng: &mut impl Rng) -> [u64; 6] {
    std::array::from_fn(|_| if rng.random_bool(0.1) { 0 } else { rng.random() })
}
