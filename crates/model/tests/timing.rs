//! Clocks, measured cycle by cycle on the machine and held against its specification; `docs/timing.md` is their table.
//!
//! `EDGEWALK_BLESS=1 cargo test -p edgewalk-model timing::` rewrites the table.

#[path = "../examples/common/mod.rs"]
mod examples;
#[allow(dead_code, reason = "the table writes no file")]
#[path = "../examples/common/mix.rs"]
mod mix;

use crate::common::{ALWAYS, Triangle, machine, place, watch};
use edgewalk_golden::Shading;
use edgewalk_machine::channel::Precision;
use edgewalk_machine::{Activity, EdgeKind, Fill, Machine, Plan};
use edgewalk_model::fast::Renderer;
use edgewalk_model::{DrawState, Rig, SetupClocks, Stalls, longest_setup, setup_clocks};
use edgewalk_scene::Scene;
use std::fmt::Write as _;
use std::path::Path;

fn triangle(machine: &Plan, corners: [[i32; 2]; 3], scale: i32) -> Triangle {
    corners.map(|[x, y]| machine.raw_vertex(x * scale, y * scale, &[100; 4]))
}

/// Cycles in which something happened.
#[derive(Default)]
struct Trace {
    /// Triangles taken.
    triangles: Vec<u64>,
    /// Reads, with their columns and lines.
    reads: Vec<(u64, i64, i64)>,
    /// Writes.
    writes: Vec<u64>,
}

fn trace(machine: &Plan, triangles: &[Triangle]) -> Trace {
    let mut trace = Trace::default();
    let mut rig = Rig::new(machine, ALWAYS, Stalls::NONE);
    watch(&mut rig, triangles, &mut |now, _, cycle| {
        trace.triangles.extend(cycle.outputs.triangle.then_some(now));
        trace.writes.extend(cycle.written.then_some(now));
        if let Some(addr) = cycle.read {
            let (x, y) = place(machine, addr);
            trace.reads.push((now, x, y));
        }
    });
    trace
}

/// The machines of the setup tables.
fn machines() -> [(&'static str, Machine); 4] {
    let preset = |name| Machine::preset(name).expect("a preset");
    let precision = |bits| Precision { bits, fraction: 10, vertex_fraction: 0 };
    let narrow = Machine {
        guard_bits: 11,
        subpixel_bits: 4,
        z: precision(16),
        color: precision(8),
        ..Machine::default()
    };
    let slope = Machine { edge_kind: EdgeKind::Slope, ..Machine::default() };
    [("default", Machine::default()), ("slope", slope), ("narrow", narrow), ("textbook", preset("textbook"))]
}

/// Three pixels, an area of 60, and one that covers the screen of 640x480; pixels.
const SHAPES: [[[i32; 2]; 3]; 3] =
    [[[2, 2], [5, 2], [2, 5]], [[10, 10], [21, 13], [14, 22]], [[0, 0], [1280, 0], [0, 960]]];
/// Without area.
const FLAT: [[i32; 2]; 3] = [[2, 2], [4, 4], [6, 6]];

/// A corner with every channel at 0, one at a half of full scale, one at full scale.
fn shaded(plan: &Plan, corners: [[i32; 2]; 3]) -> Triangle {
    [0, 1, 2].map(|i| {
        let values = plan.channels().iter().map(|c| (c.limit() << c.vertex_fraction) as i64 * i / 2);
        let [x, y] = corners[i as usize].map(|c| c << plan.subpixel_bits);
        plan.raw_vertex(x, y, &values.collect::<Vec<_>>())
    })
}

/// Cycles from one such triangle to the next, where drawing is not waited for.
fn interval(machine: &Plan, triangle: &Triangle) -> u64 {
    let taken = trace(machine, &[*triangle; 5]).triangles;
    let gaps: Vec<_> = taken.windows(2).map(|w| w[1] - w[0]).collect();
    assert!(gaps.windows(2).all(|g| g[0] == g[1]), "{gaps:?}");
    gaps[0]
}

fn setup_table(table: &mut String) {
    let _ = writeln!(
        table,
        "## Setup\nClocks of a triangle in SETUP, S1 + S2 (edges and cull, channels), for every number of lanes; corners in pixels, every\n\
         channel at 0, a half and full scale. From one triangle to the next it is two clocks more, where drawing is not waited\n\
         for; after a culled one, one more. A triangle outside the lines or columns of the screen takes 2. *Bound*: what the\n\
         formats allow. *slope*: the default machine with edges of 16 fraction bits; *narrow*: vertices of 11 + 4 bits, z of 16 +\n\
         10 and colours of 8 + 10 bits.\n\n\
         | machine | lanes | 3 pixels {:?} | area 60 {:?} | the screen {:?} | no area {FLAT:?} | bound |\n|---|---|---|---|---|---|---|",
        SHAPES[0], SHAPES[1], SHAPES[2]
    );
    for (name, machine) in machines() {
        for lanes in [1, 2, 4] {
            let plan = Machine { lanes, ..machine.clone() }.plan().expect("can be built");
            let longest = longest_setup(&plan);
            let _ = write!(table, "| {name} | {lanes} |");
            for (place, corners) in SHAPES.into_iter().enumerate() {
                let triangle = shaded(&plan, corners);
                let SetupClocks { phase1, phase2 } = setup_clocks(&plan, &triangle);
                assert!(phase1 <= longest.phase1 && phase2 <= longest.phase2);
                if place == 0 {
                    let pixels = trace(&plan, &[triangle]).reads.len();
                    assert!(pixels == 3 || plan.fill == Fill::Textbook, "{pixels} pixels");
                    assert_eq!(interval(&plan, &triangle), u64::from(phase1 + phase2 + 2));
                }
                let _ = write!(table, " {phase1} + {phase2} |");
            }
            let flat = shaded(&plan, FLAT);
            let culled = setup_clocks(&plan, &flat);
            assert_eq!((interval(&plan, &flat), culled.phase2), (u64::from(culled.phase1 + 1), 0));
            let _ = writeln!(table, " {} | {} + {} |", culled.phase1, longest.phase1, longest.phase2);
        }
    }
}

/// The torus knot as the program draws it.
fn knot(plan: &Plan) -> Vec<Triangle> {
    let scene = Scene::builtin("torus-knot").expect("a scene");
    let surface = scene.surface(plan.width, plan.height, f64::from((1u32 << plan.guard_bits) - 1));
    let frame = edgewalk_golden::frame(&scene, &surface, Shading::Gouraud);
    let frame = frame.triangulated(plan.subpixel_bits).expect("triangles");
    let vertex = |v: &edgewalk_scene::Vertex| {
        plan.port_vertex(v.x, v.y, &[v.z, v.r, v.g, v.b]).expect("clipped to the guard band")
    };
    frame.triangles.iter().map(|triangle| triangle.0.each_ref().map(vertex)).collect()
}

/// Mean, what 95 % do not exceed, and most.
fn spread(mut clocks: Vec<u32>) -> (f64, u32, u32) {
    clocks.sort_unstable();
    let mean = clocks.iter().map(|c| f64::from(*c)).sum::<f64>() / clocks.len() as f64;
    (mean, clocks[(clocks.len() * 95).div_ceil(100) - 1], clocks[clocks.len() - 1])
}

fn set_table(table: &mut String) {
    let _ = writeln!(
        table,
        "\nThe same of many triangles at 640x480, S1 + S2 of those that are not culled: the scene `torus-knot` (small triangles\n\
         of a smooth surface), and 2,000 of 60 pixels, of any shape but needles, all values at random.\n\n\
         | machine | lanes | torus-knot: mean | 95 % | most | random: mean | 95 % | most |\n|---|---|---|---|---|---|---|---|"
    );
    for (name, machine) in machines() {
        let plan = machine.plan().expect("can be built");
        let sets = [knot(&plan), examples::triangles(&plan, 2000, 60.0)];
        for lanes in [1, 2, 4] {
            let plan = Machine { lanes, ..machine.clone() }.plan().expect("can be built");
            let _ = write!(table, "| {name} | {lanes} |");
            for set in &sets {
                let clocks = set.iter().map(|triangle| setup_clocks(&plan, triangle));
                let drawn: Vec<_> = clocks.filter(|c| c.phase2 > 0).map(SetupClocks::all).collect();
                assert!(drawn.len() > 1500, "{}", drawn.len());
                let (mean, most_do, most) = spread(drawn);
                let _ = write!(table, " {mean:.1} | {most_do} | {most} |");
            }
            table.push('\n');
        }
    }
}

/// What the cycles of this frame are spent on.
const CAUSES: [Activity; 6] =
    [Activity::Setup, Activity::Draw, Activity::Edge, Activity::Offscreen, Activity::Idle, Activity::Flush];

/// Of the machine that divided, four lanes of radix 4, from before SETUP by pairs: the cycles of this frame.
const DIVIDED: [u64; CAUSES.len()] = [1_727_583, 222_511, 21_828, 412, 1_590, 10];

/// A frame of the sizes that programs send: how many there are of each, and what its cycles are spent on.
fn mix_table(table: &mut String) {
    let machine = Machine::default();
    let triangles = mix::triangles(100, 1);
    let frame = |lanes| {
        let plan = Machine { lanes, ..machine.clone() }.plan().expect("can be built");
        let port = triangles.iter().map(|corners| {
            corners.map(|[x, y, values @ ..]| plan.port_vertex(x, y, &values).expect("near the screen"))
        });
        let mut renderer = Renderer::new(&plan, false);
        let passage = renderer.draw_passage(port, DrawState::default()).expect("without ticking");
        (passage, renderer.counters().clone())
    };
    let mut sizes = [0; 5];
    let (passage, counters) = frame(4);
    for fate in passage.fates() {
        sizes[[0, 3, 15, 63].iter().filter(|most| fate.pixels > **most).count()] += 1;
    }
    println!("triangles by pixels, 0, 1 to 3, 4 to 15, 16 to 63, 64 and more: {sizes:?}");
    assert_eq!(sizes, [3900, 2200, 1900, 1300, 700]);
    let _ = writeln!(
        table,
        "\n## Sizes as programs send them\nOf 194,000 triangles captured from 20 OpenGL programs at 640x480 39 % covered no pixel, 22 % one to three, 7 % 64 or\n\
         more; setup took 88 % of the cycles. A frame of 10,000 with these shares, made by seed (`cargo run --release -p\n\
         edgewalk-model --example mix > mix.tri`; `edgewalk render mix.tri` reports them): {} without a pixel, of which 600\n\
         lie off the screen and 300 have no area, {} of 1 to 3 pixels, {} of 4 to 15, {} of 16 to 63 and {} of 64 to\n\
         600; {} fragments. Cycles by cause, and those of the machine that divided (four lanes of radix 4, 223 clocks a\n\
         triangle, 48 culled; commit bcc1d49 drew the same file, 22 November 2026):\n\n\
         | machine | {} | all | to that |\n|---|{}---|---|",
        sizes[0],
        sizes[1],
        sizes[2],
        sizes[3],
        sizes[4],
        counters.fragments,
        CAUSES.map(Activity::name).join(" | "),
        "---|".repeat(CAUSES.len()),
    );
    let before: u64 = DIVIDED.iter().sum();
    let mut row = |name: &str, cycles: &[u64]| {
        let _ = write!(table, "| {name} |");
        for count in cycles {
            let _ = write!(table, " {count} |");
        }
        let all: u64 = cycles.iter().sum();
        let _ = writeln!(table, " {all} | {:.3} |", all as f64 / before as f64);
    };
    row("divided, 4 lanes", &DIVIDED);
    for lanes in [4, 2, 1] {
        let counters = frame(lanes).1;
        let cycles = CAUSES.map(|cause| counters.activity[cause as usize]);
        assert_eq!(cycles.iter().sum::<u64>(), counters.cycles, "other causes have none");
        row(&format!("pairs, {lanes} lanes"), &cycles);
    }
}

/// S2 of machines with channels of the user's own, on every number of lanes.
fn channel_table(table: &mut String) {
    let _ = writeln!(
        table,
        "\n## Channels\nS2, clocks of SETUP for the channels, of machines with N of them (extra channels of the default's 26 bits, shorter\n\
         than z), for the triangle of area 60 above, and S1 + S2 + 2.\n\n\
         | machine | N | lanes | S2 | a triangle every |\n|---|---|---|---|---|"
    );
    for name in ["default", "textbook"] {
        for extra in 0..=4 {
            for lanes in [1, 2, 4] {
                let preset = Machine::preset(name).expect("a preset");
                let machine = Machine { extra, lanes, ..preset }.plan().expect("can be built");
                let SetupClocks { phase1, phase2 } = setup_clocks(&machine, &shaded(&machine, SHAPES[1]));
                let channels = machine.channels().len();
                let _ =
                    writeln!(table, "| {name} | {channels} | {lanes} | {phase2} | {} |", phase1 + phase2 + 2);
            }
        }
    }
}

/// Clocks between pixels of a span, and the most that are lost between two spans.
fn rate(machine: &Plan, shape: &Triangle) -> (u64, u64) {
    let reads = trace(machine, &[*shape]).reads;
    assert!(reads.len() > 20);
    let per_pixel = u64::from(machine.clocks_per_pixel());
    let (mut inside, mut lost) = (0, 0);
    for pair in reads.windows(2) {
        let gap = pair[1].0 - pair[0].0;
        if pair[0].2 == pair[1].2 {
            assert_eq!(gap, per_pixel, "inside a span, at {pair:?}");
            inside = gap;
        } else {
            lost = lost.max(gap - per_pixel);
        }
    }
    (inside, lost)
}

fn rate_table(table: &mut String) {
    let _ = writeln!(
        table,
        "\n## Pixels\nClocks a pixel inside a span, the most that are lost from a span to the next, without stalls of the memory, and clocks\n\
         from the cycle in which a triangle is taken to its first depth read, less S1 + S2.\n\n\
         | adders | segments | span FIFO | clocks a pixel | lost between long spans | lost between spans of one pixel | to the first read |\n\
         |---|---|---|---|---|---|---|"
    );
    // The adders change nothing at the port.
    let long = triangle(&Plan::default(), [[10, 10], [200, 30], [50, 110]], 256);
    let thin = triangle(&Plan::default(), [[10, 10], [11, 10], [11, 1000]], 256);
    for adders in ["4", "3", "2", "1"] {
        for segments in ["1", "2", "4"] {
            for fifo in ["1", "2"] {
                let machine = machine(&[
                    ("interpolator.adders", adders),
                    ("interpolator.segments", segments),
                    ("fifo.span", fifo),
                ]);
                let (clocks, lost_long) = rate(&machine, &long);
                let (_, lost_thin) = rate(&machine, &thin);
                assert_eq!(clocks, u64::from(machine.clocks_per_pixel()));
                assert!(lost_long <= 1 && lost_thin <= 1, "lost {lost_long} and {lost_thin}");
                assert!(fifo == "1" || lost_long + lost_thin == 0);
                let setup = setup_clocks(&machine, &long);
                let run = trace(&machine, &[long]);
                let first = run.reads[0].0 - run.triangles[0] - u64::from(setup.all());
                // prim, line, line held, span, T clocks of adding, D segments
                assert_eq!(first, 4 + u64::from(machine.clocks_per_pixel() + machine.segments));
                let _ = writeln!(
                    table,
                    "| {adders} | {segments} | {fifo} | {clocks} | {lost_long} | {lost_thin} | {first} |"
                );
            }
        }
    }
}

fn depth_table(table: &mut String) {
    let _ = writeln!(
        table,
        "\n## Depth\nClocks from a fragment's depth read to its write, L + 1, and clocks a pixel that the in-flight queue allows (default\n\
         machine, one large triangle; max(1, (L + 1)/depth) when the queue is the limit).\n\n\
         | latency L | queue | read to write | clocks a pixel |\n|---|---|---|---|"
    );
    for latency in [1, 2, 4, 8] {
        for inflight in [1, 2, 4, 8, 16] {
            let mut machine = Machine::default();
            (machine.latency, machine.inflight) = (latency, inflight);
            let machine = machine.plan().expect("can be built");
            let run = trace(&machine, &[triangle(&machine, [[10, 10], [200, 30], [50, 110]], 256)]);
            let to_write = run.writes[0] - run.reads[0].0;
            assert_eq!(to_write, u64::from(latency) + 1);
            let last = run.reads[run.reads.len() - 1].0;
            let clocks = (last - run.reads[0].0) as f64 / (run.reads.len() - 1) as f64;
            let limit = (f64::from(latency + 1) / f64::from(inflight)).max(1.0);
            assert!((clocks - limit).abs() < 0.01, "{clocks} clocks a pixel, not {limit}");
            let _ = writeln!(table, "| {latency} | {inflight} | {to_write} | {clocks:.2} |");
        }
    }
}

#[test]
fn the_timing_table_is_what_the_machine_does() {
    let mut table = "# Timing\n\nWritten by `EDGEWALK_BLESS=1 cargo test -p edgewalk-model timing::`; \
                     the test compares it with the machine.\n\n"
        .to_owned();
    setup_table(&mut table);
    set_table(&mut table);
    mix_table(&mut table);
    channel_table(&mut table);
    rate_table(&mut table);
    depth_table(&mut table);
    println!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/timing.md");
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        std::fs::write(&path, &table).expect("docs can be written");
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == table, "docs/timing.md is out of date: run this test with EDGEWALK_BLESS=1");
}

/// SETUP works on the next triangle while this one is drawn: then the triangles cost only their pixels.
#[test]
fn setup_overlaps_with_drawing() {
    let machine = Plan::default();
    let large = triangle(&machine, [[10, 10], [200, 30], [50, 110]], 256);
    let once = trace(&machine, &[large]);
    let pixels = once.reads.len() as u64;
    let many = trace(&machine, &[large; 8]);
    let (first, last) = (many.reads[0].0, many.reads[many.reads.len() - 1].0);
    assert_eq!(many.reads.len() as u64, 8 * pixels);
    let lost = (last - first + 1) - 8 * pixels;
    println!("{pixels} pixels a triangle, {lost} clocks lost over 8 triangles");
    assert!(lost <= 7 * 3, "{lost} clocks lost");
}
