//! How fast the fast path draws, on one core: `cargo run --release -p edgewalk-model --example fast_speed [FRAMES [PIXELS]]`.
//!
//! Rates are of the processor time a frame takes on average, where the system tells it (Linux): on a machine that does
//! other work as well, the median says how much of it was left for us. Otherwise they are of the median.
//!
//! A frame clears the picture and draws every triangle; making the triangles and comparing with ticking is outside the
//! clock. The ticking model draws each scene once, for its own time, and its counters must be equal.

use edgewalk_model::fast::Renderer;
use edgewalk_model::{DrawState, Stalls, render};
use edgewalk_numerics::{Machine, PortVertex};
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::time::Instant;

/// Random triangles of `area` pixels each, wholly on the screen, any shape but needles, z and colours at random.
fn triangles(machine: &Machine, count: usize, area: f64) -> Vec<[PortVertex; 3]> {
    let mut rng = StdRng::seed_from_u64(1);
    let mut triangles = Vec::new();
    while triangles.len() < count {
        let shape: [[f64; 2]; 3] =
            std::array::from_fn(|_| [rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0)]);
        let [a, b, c] = shape;
        let size = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs() / 2.0;
        if size < 0.2 {
            continue;
        }
        let scale = (area / size).sqrt();
        let sides = [f64::from(machine.width), f64::from(machine.height)];
        let middle = sides.map(|side| rng.random_range(0.0..side));
        let corners = shape.map(|p| [middle[0] + scale * p[0], middle[1] + scale * p[1]]);
        if corners.iter().any(|p| (0..2).any(|i| p[i] < 0.0 || p[i] > sides[i])) {
            continue;
        }
        let vertex = |p: [f64; 2]| {
            machine.port_vertex(p[0], p[1], std::array::from_fn(|_| rng.random_range(0.0..=1.0)))
        };
        let corners: Result<Vec<_>, _> = corners.into_iter().map(vertex).collect();
        if let Ok(Ok(triangle)) = corners.map(<[PortVertex; 3]>::try_from) {
            triangles.push(triangle);
        }
    }
    triangles
}

/// Seconds this process has run on a processor.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|ns| ns * 1e-9)
}

fn measure(name: &str, machine: &Machine, triangles: &[[PortVertex; 3]], frames: usize) {
    let state = DrawState::default();
    let start = Instant::now();
    let tick = render(machine, triangles.iter().copied(), state, Stalls::NONE);
    let ticking = start.elapsed().as_secs_f64();
    let mut renderer = Renderer::new(machine, false);
    let mut frame = || {
        let start = Instant::now();
        let exact = renderer.draw(triangles.iter().copied(), state);
        assert_eq!(exact, Ok(()));
        start.elapsed().as_secs_f64()
    };
    frame(); // touches the memory
    let before = processor_time();
    let mut seconds: Vec<f64> = (0..frames).map(|_| frame()).collect();
    let spent = before.and_then(|before| Some((processor_time()? - before) / frames as f64));
    let drawn = renderer.frame();
    assert_eq!(drawn.counters, tick.counters);
    assert!(drawn.z == tick.z && drawn.rgb == tick.rgb);
    seconds.sort_by(f64::total_cmp);
    let (min, median) = (seconds[0], seconds[frames / 2]);
    let cpu = spent.unwrap_or(median);
    let rate = |count: u64| count as f64 / cpu * 1e-6;
    let counters = renderer.counters();
    println!(
        "{name}: {:.3} ms CPU, {:.3} min, {:.3} median of {frames}; {:.0} M fragments/s, {:.2} M triangles/s, \
         {:.0} Mcycle/s; ticking {:.0} Mcycle/s",
        cpu * 1e3,
        min * 1e3,
        median * 1e3,
        rate(counters.fragments),
        rate(counters.triangles),
        rate(counters.cycles),
        counters.cycles as f64 / ticking * 1e-6,
    );
}

fn main() {
    let argument = |n| std::env::args().nth(n).and_then(|text| text.parse::<usize>().ok());
    let frames = argument(1).unwrap_or(101).max(1);
    let machine = Machine { width: 1280, height: 960, ..Machine::default() };
    println!("1280x960, one core, one frame = clear and draw all");
    for area in argument(2).map_or_else(|| vec![10, 100, 1000, 10_000], |area| vec![area]) {
        let scene = triangles(&machine, 5000, area as f64);
        measure(&format!("5000 triangles of {area} pixels"), &machine, &scene, frames);
    }
    measure("no triangle: the clear", &machine, &[], frames);
}
