//! What a frame costs over four decades of triangles and of fragments, on one core:
//! `cargo run --release -p edgewalk-model --example scaling > docs/scaling.svg`
//!
//! The times are fitted by t = A triangles + B fragments, by least squares of the relative error. The clear, which costs
//! the same whatever is drawn, is taken off before. The figures go to standard error, the plot to standard output.

mod common;

use common::triangles;
use cpu_time::ThreadTime;
use edgewalk_machine::{Machine, PortVertex};
use edgewalk_model::DrawState;
use edgewalk_model::fast::Renderer;
use std::fmt::Write as _;

/// Pixels a triangle, and a colour for the plot.
const AREAS: [(u32, &str); 4] = [(10, "#1b6ca8"), (100, "#d1495b"), (1000, "#3a7d44"), (10_000, "#8d5a97")];
/// Triangles a frame; large ones only as far as the fragments stay below this.
const COUNTS: [usize; 9] = [100, 316, 1000, 3162, 10_000, 31_623, 100_000, 316_228, 1_000_000];
const MOST_FRAGMENTS: u64 = 110_000_000;

/// A frame.
struct Sample {
    color: &'static str,
    triangles: f64,
    fragments: f64,
    /// Without the clear.
    seconds: f64,
}

/// Processor seconds of a frame, the least of several, and its fragments.
fn measure(renderer: &mut Renderer, triangles: &[[PortVertex; 3]]) -> (f64, u64) {
    let mut best = f64::INFINITY;
    let mut spent = 0.0;
    let mut frames = 0;
    while frames < 3 || (spent < 0.2 && frames < 200) {
        let start = ThreadTime::now();
        renderer
            .draw(triangles.iter().copied(), DrawState::default())
            .expect("a machine that needs no ticking");
        let seconds = start.elapsed().as_secs_f64();
        best = best.min(seconds);
        spent += seconds;
        frames += 1;
    }
    (best, renderer.counters().fragments)
}

/// A and B, seconds.
fn fit(samples: &[Sample]) -> (f64, f64) {
    let sum =
        |f: &dyn Fn(&Sample) -> f64| samples.iter().map(|s| f(s) / (s.seconds * s.seconds)).sum::<f64>();
    let (tt, tf, ff) = (
        sum(&|s| s.triangles * s.triangles),
        sum(&|s| s.triangles * s.fragments),
        sum(&|s| s.fragments * s.fragments),
    );
    let (t, f) = (sum(&|s| s.triangles * s.seconds), sum(&|s| s.fragments * s.seconds));
    let determinant = tt * ff - tf * tf;
    ((t * ff - f * tf) / determinant, (f * tt - t * tf) / determinant)
}

/// Points and the fitted lines over `x`, decade by decade, in a square with its lower left corner at (`left`, 380).
fn panel(
    samples: &[Sample],
    left: f64,
    title: &str,
    decades: [i32; 2],
    x: impl Fn(&Sample) -> f64,
    line: &dyn Fn(&Sample) -> f64,
) -> String {
    const SIDE: f64 = 320.0;
    const SECONDS: [i32; 2] = [-5, 0];
    let place =
        |value: f64, [low, high]: [i32; 2]| (value.log10() - f64::from(low)) / f64::from(high - low) * SIDE;
    let mut svg = String::new();
    for decade in decades[0]..=decades[1] {
        let at = left + place(10f64.powi(decade), decades);
        let _ = writeln!(
            svg,
            r##"<path d="M{at:.1} 60V380" stroke="#ddd"/><text x="{at:.1}" y="398" text-anchor="middle">10^{decade}</text>"##
        );
    }
    for decade in SECONDS[0]..=SECONDS[1] {
        let at = 380.0 - place(10f64.powi(decade), SECONDS);
        let _ = writeln!(
            svg,
            r##"<path d="M{left} {at:.1}h{SIDE}" stroke="#ddd"/><text x="{:.1}" y="{:.1}" text-anchor="end">10^{decade}</text>"##,
            left - 6.0,
            at + 4.0
        );
    }
    let _ =
        writeln!(svg, r#"<text x="{:.1}" y="420" text-anchor="middle">{title}</text>"#, left + SIDE / 2.0);
    let point = |s: &Sample, seconds: f64| (left + place(x(s), decades), 380.0 - place(seconds, SECONDS));
    for (area, color) in AREAS {
        let series: Vec<&Sample> = samples.iter().filter(|s| s.color == color).collect();
        let path: Vec<String> = series
            .iter()
            .map(|s| {
                let (x, y) = point(s, line(s));
                format!("{x:.1} {y:.1}")
            })
            .collect();
        let _ = writeln!(svg, r#"<path d="M{}" fill="none" stroke="{color}"/>"#, path.join("L"));
        for s in series {
            let (x, y) = point(s, s.seconds);
            let _ = writeln!(
                svg,
                r#"<circle cx="{x:.1}" cy="{y:.1}" r="3" fill="{color}"><title>{area} px: {:.6} s</title></circle>"#,
                s.seconds
            );
        }
    }
    svg
}

fn main() {
    let plan = Machine { width: 1280, height: 960, ..Machine::default() }.plan().expect("can be built");
    let mut renderer = Renderer::new(&plan, false);
    let clear = measure(&mut renderer, &[]).0;
    eprintln!("clear {:.3} ms", clear * 1e3);
    let mut samples = Vec::new();
    for (area, color) in AREAS {
        let scene =
            triangles(&plan, 1_000_000.min((MOST_FRAGMENTS / u64::from(area)) as usize), f64::from(area));
        for count in COUNTS.into_iter().filter(|count| *count <= scene.len()) {
            let (seconds, fragments) = measure(&mut renderer, &scene[..count]);
            let sample = Sample {
                color,
                triangles: count as f64,
                fragments: fragments as f64,
                seconds: seconds - clear,
            };
            eprintln!("{count} triangles of {area} pixels: {:.3} ms", sample.seconds * 1e3);
            samples.push(sample);
        }
    }
    let (a, b) = fit(&samples);
    let line = |s: &Sample| a * s.triangles + b * s.fragments;
    let off = samples.iter().map(|s| (line(s) / s.seconds - 1.0).abs()).fold(0.0, f64::max);
    let text = format!(
        "{:.0} ns a triangle + {:.2} ns a fragment; largest deviation {:.0} %",
        a * 1e9,
        b * 1e9,
        off * 100.0
    );
    eprintln!("{text}");
    println!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 440" font-family="sans-serif" font-size="12">"#
    );
    println!(
        r#"<rect width="800" height="440" fill="white"/><text x="60" y="24" font-size="14">Fast path, 1280x960, one core: {text}</text>"#
    );
    for ((area, color), x) in AREAS.into_iter().zip([60, 180, 310, 450]) {
        println!(
            r#"<circle cx="{x}" cy="42" r="4" fill="{color}"/><text x="{}" y="46">{area} pixels each</text>"#,
            x + 8
        );
    }
    print!(
        "{}",
        panel(
            &samples,
            60.0,
            "triangles a frame (seconds of processor time, less the clear)",
            [2, 6],
            |s| s.triangles,
            &line
        )
    );
    print!("{}", panel(&samples, 450.0, "fragments a frame", [3, 9], |s| s.fragments, &line));
    println!("</svg>");
}
