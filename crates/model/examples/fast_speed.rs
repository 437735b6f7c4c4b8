//! How fast the fast path draws, on one core: `cargo run --release -p edgewalk-model --example fast_speed [FRAMES [PIXELS]]`.
//!
//! Times and rates are of the processor's time of the median frame: other programs do not count.
//!
//! A frame clears the picture and draws every triangle; making the triangles and comparing with ticking is outside the
//! clock. The ticking model draws each scene once, for its own time, and its counters must be equal.

mod common;

use common::{torus, triangles};
use cpu_time::ThreadTime;
use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::fast::Renderer;
use edgewalk_model::{DrawState, Stalls, render};

fn measure(name: &str, plan: &Plan, triangles: &[[PortVertex; 3]], frames: usize) {
    let state = DrawState::default();
    let start = ThreadTime::now();
    let tick = render(plan, triangles.iter().copied(), state, Stalls::NONE);
    let tick = tick.expect("vertices of this machine");
    let ticking = start.elapsed().as_secs_f64();
    let mut renderer = Renderer::new(plan, false);
    let mut frame = || {
        let start = ThreadTime::now();
        let exact = renderer.draw(triangles.iter().copied(), state);
        assert_eq!(exact, Ok(()));
        start.elapsed().as_secs_f64()
    };
    frame(); // touches the memory
    let mut seconds: Vec<f64> = (0..frames).map(|_| frame()).collect();
    let drawn = renderer.frame();
    assert_eq!(drawn.counters, tick.counters);
    assert!(drawn.z == tick.z && drawn.rgb == tick.rgb);
    seconds.sort_by(f64::total_cmp);
    let (min, median) = (seconds[0], seconds[frames / 2]);
    let rate = |count: u64| count as f64 / median * 1e-6;
    let counters = renderer.counters();
    println!(
        "{name}: {:.3} ms, least {:.3}, of {frames}; {:.0} M fragments/s, {:.2} M triangles/s, \
         {:.0} Mcycle/s; ticking {:.0} Mcycle/s",
        median * 1e3,
        min * 1e3,
        rate(counters.fragments),
        rate(counters.triangles),
        rate(counters.cycles),
        counters.cycles as f64 / ticking * 1e-6,
    );
}

fn main() {
    let argument = |n| std::env::args().nth(n).and_then(|text| text.parse::<usize>().ok());
    let frames = argument(1).unwrap_or(101).max(1);
    let plan = Machine { width: 1280, height: 960, ..Machine::default() }.plan().expect("can be built");
    println!("1280x960, one core, one frame = clear and draw all");
    for area in argument(2).map_or_else(|| vec![10, 100, 1000, 10_000], |area| vec![area]) {
        let scene = triangles(&plan, 5000, area as f64);
        measure(&format!("5000 triangles of {area} pixels"), &plan, &scene, frames);
        if area < 200 {
            // Wholly inside the guard band.
            let scene = torus(&plan, area as f64);
            measure(&format!("a torus of {} triangles of {area} pixels", scene.len()), &plan, &scene, frames);
        }
    }
    measure("no triangle: the clear", &plan, &[], frames);
}
