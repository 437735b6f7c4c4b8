//! Bilinear colours of POLY against values along the true edges and from edge to edge.

use crate::common::machine;
use crate::common::polygon::{Contours, KINDS, loaded, shape};
use edgewalk_machine::{COLOURS, MAX_CHANNELS, Plan, PortVertex};
use edgewalk_model::Events;
use edgewalk_model::tokens::{Line, Words};
use edgewalk_numerics::Steps;
use edgewalk_numerics::bounds::bilinear_error;
use rand::{Rng, SeedableRng, rngs::StdRng};

/// What was compared.
#[derive(Debug, Default)]
struct Met {
    polygons: u64,
    spans: u64,
    values: u64,
    /// Spans with another crossing near an end.
    left_out: u64,
    /// Values that differ by more than the bound, or lie outside 0 to the largest colour.
    beyond: u64,
    outside: u64,
    /// The largest share of the bound, and the largest error, LSB.
    reached: f64,
    error: f64,
}

/// An edge on a line: its place, px, its colours, LSB, and the lines it has walked.
struct Crossing {
    x: f64,
    colours: [f64; 3],
    walked: u32,
}

/// All spans that POLY gives for these tokens, each with the increments that it holds for it.
fn spans(plan: &Plan, tokens: &[[PortVertex; 3]]) -> Vec<(Line<MAX_CHANNELS>, Words<MAX_CHANNELS>)> {
    let (mut poly, mut events, mut spans) = (loaded(plan, tokens), Events::default(), Vec::new());
    while poly.walking() {
        let line = poly.line().copied();
        spans.extend(line.map(|line| (line, *poly.gradient())));
        poly.step(None, false, line.is_some(), false, &mut events);
    }
    spans
}

/// The true crossings of a line, from left to right.
fn crossings(plan: &Plan, contours: &[Vec<PortVertex>], line: u32, first: u32) -> Vec<Crossing> {
    let unit = f64::from(1u32 << plan.subpixel_bits);
    let one = f64::from(1u32 << plan.color.vertex_fraction);
    let mut all = Vec::new();
    for contour in contours {
        for k in 0..contour.len() {
            let ends = [contour[k], contour[(k + 1) % contour.len()]];
            let [a, b] = if ends[0].y() <= ends[1].y() { ends } else { [ends[1], ends[0]] };
            let lines = plan.first_pixel(a.y())..plan.first_pixel(b.y());
            if !lines.contains(&(line as i32)) {
                continue;
            }
            let place = |at: i32| f64::from(at) / unit;
            let share = (f64::from(line) + 0.5 - place(a.y())) / (place(b.y()) - place(a.y()));
            let between = |a: f64, b: f64| a + share * (b - a);
            let colour = |c: usize| between(a.values()[c] as f64, b.values()[c] as f64) / one;
            let begun = lines.start.max(first as i32);
            all.push(Crossing {
                x: between(place(a.x()), place(b.x())),
                colours: [1, 2, 3].map(colour),
                walked: (line as i32 - begun) as u32,
            });
        }
    }
    all.sort_by(|a, b| a.x.total_cmp(&b.x));
    all
}

fn compare(plan: &Plan, contours: &Contours, rng: &mut StdRng, met: &mut Met) {
    let most = (plan.color.max() << plan.color.vertex_fraction) as i64;
    let vertex = |p: &[i32; 2], rng: &mut StdRng| {
        let values: Vec<i64> = (0..4)
            .map(|channel| match (channel, rng.random_range(0..4)) {
                (0, _) => 1000,
                (_, 0) => 0,
                (_, 1) => most,
                _ => rng.random_range(0..=most),
            })
            .collect();
        plan.raw_vertex(p[0], p[1], &values)
    };
    let contours: Vec<Vec<PortVertex>> =
        contours.iter().map(|contour| contour.iter().map(|p| vertex(p, rng)).collect()).collect();
    let window = plan.window_from(&contours.concat());
    met.polygons += 1;
    for (line, gradient) in spans(plan, &plan.polygon(&contours, window)) {
        let crossings = crossings(plan, &contours, line.y, window.y0);
        let epsilon = |walked: u32| f64::from(walked + 1) * 0.5f64.powi(plan.edge_fraction as i32 + 1);
        // The pair of this span: that with a column of it, where edges do not lie on a centre.
        let middle = f64::from(line.major) + 0.5;
        let pair = crossings.chunks_exact(2).position(|pair| {
            let far = epsilon(pair[0].walked.max(pair[1].walked));
            pair[0].x - far <= middle && middle <= pair[1].x + far
        });
        met.spans += 1;
        let Some(pair) = pair else {
            met.left_out += 1;
            continue;
        };
        let [left, right] = [&crossings[2 * pair], &crossings[2 * pair + 1]];
        let walked = left.walked.max(right.walked);
        let near = |k: usize| {
            let others = [k.checked_sub(1), Some(k + 1)].into_iter().flatten().filter(|j| j / 2 != k / 2);
            others
                .filter_map(|j| crossings.get(j))
                .any(|other| (other.x - crossings[k].x).abs() <= 2.0 * epsilon(walked.max(other.walked)))
        };
        if near(2 * pair) || near(2 * pair + 1) {
            met.left_out += 1;
            continue;
        }
        let one = f64::from(1u32 << plan.color.fraction);
        for (k, channel) in COLOURS.enumerate() {
            let mask = (1u64 << plan.channels()[channel].word()) - 1;
            for x in line.major..line.minor {
                let steps = (x - line.major) as u64;
                let word = line.values[channel].wrapping_add(steps.wrapping_mul(gradient[channel])) & mask;
                let value = word as f64 / one - 0.5;
                let width = right.x - left.x;
                let share = ((f64::from(x) + 0.5 - left.x) / width).clamp(0.0, 1.0);
                let truth = left.colours[k] + share * (right.colours[k] - left.colours[k]);
                let difference = (right.colours[k] - left.colours[k]).abs();
                let bound =
                    bilinear_error(plan.color.fraction, Steps { lines: walked, columns: steps as u32 })
                        .to_f64()
                        + difference * (epsilon(walked) / width).min(1.0);
                let error = (value - truth).abs();
                met.values += 1;
                met.beyond += u64::from(error > bound + 1e-9);
                met.outside += u64::from(word >> plan.color.fraction > plan.color.max());
                met.reached = met.reached.max(error / bound);
                met.error = met.error.max(error);
            }
        }
    }
}

fn within_the_bound(count: usize, seed: u64) -> Met {
    let mut rng = StdRng::seed_from_u64(seed);
    let mut met = Met::default();
    for (side, fraction, bits) in [("24", "14", "20"), ("64", "11", "16"), ("24", "14", "16")] {
        let plan = machine(&[
            ("screen.width", side),
            ("screen.height", side),
            ("screen.guard_bits", "9"),
            ("polygon.edges", "64"),
            ("polygon.values", "bilinear"),
            ("edge.kind", "slope"),
            ("edge.fraction_bits", bits),
            ("formats.color_fraction", fraction),
        ]);
        for number in 0..count / 3 {
            let contours = shape(&plan, KINDS[number % KINDS.len()], &mut rng);
            compare(&plan, &contours, &mut rng, &mut met);
        }
    }
    println!("{met:?}");
    met
}

#[test]
fn bilinear_colours_stay_within_their_bound() {
    let met = within_the_bound(600, 11);
    assert_eq!((met.beyond, met.outside), (0, 0), "{met:?}");
    assert!(met.values > 100_000 && met.left_out * 100 < met.spans, "{met:?}");
    assert!(met.reached > 0.3 && met.reached <= 1.0, "{met:?}");
}

/// `cargo test --release -p edgewalk-model bilinear::many -- --ignored --nocapture`
#[test]
#[ignore = "a minute"]
fn many_bilinear_colours_stay_within_their_bound() {
    let met = within_the_bound(6000, 12);
    assert_eq!((met.beyond, met.outside), (0, 0), "{met:?}");
    assert!(met.values > 1_000_000, "{met:?}");
}
