//! Clocks, measured cycle by cycle on the machine and held against its specification; `docs/timing.md` is their table.
//!
//! `EDGEWALK_BLESS=1 cargo test -p edgewalk-model --test timing` rewrites the table.

mod common;

use common::{ALWAYS, Triangle, machine, place};
use edgewalk_machine::{MAX_CHANNELS, Machine, Plan};
use edgewalk_model::{Rig, Stalls, setup_clocks};
use std::convert::Infallible;
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
    let tokens = triangles.iter().copied().map(Ok::<_, Infallible>);
    let Ok(()) = Rig::<MAX_CHANNELS>::new(machine, ALWAYS, Stalls::NONE).draw(tokens, |now, _, cycle| {
        trace.triangles.extend(cycle.triangle.then_some(now));
        trace.writes.extend(cycle.written.then_some(now));
        if let Some(addr) = cycle.read {
            let (x, y) = place(machine, addr);
            trace.reads.push((now, x, y));
        }
    });
    trace
}

/// Clocks between two triangles that are too small to be waited for; the formula is S1 + S2 + 2.
fn triangle_interval(machine: &Plan) -> u64 {
    let one = 1 << machine.subpixel_bits;
    let tiny = [triangle(machine, [[2, 2], [4, 2], [2, 4]], one); 5];
    let taken = trace(machine, &tiny).triangles;
    let gaps: Vec<_> = taken.windows(2).map(|w| w[1] - w[0]).collect();
    assert!(gaps.windows(2).all(|g| g[0] == g[1]), "{gaps:?}");
    gaps[0]
}

/// The same for triangles that draw nothing; the formula is S1 + 1.
fn culled_interval(machine: &Plan) -> u64 {
    let flat = [triangle(machine, [[2, 2], [4, 4], [6, 6]], 1 << machine.subpixel_bits); 3];
    let taken = trace(machine, &flat).triangles;
    taken[2] - taken[1]
}

fn setup_table(table: &mut String) {
    let _ = writeln!(
        table,
        "## Setup\nClocks of a triangle in SETUP, S1 (edges, cull) and S2 (channels), and from one triangle to the next where drawing\n\
         is not waited for (S1 + S2 + 2; a culled one S1 + 1). Measured with triangles of three pixels.\n\n\
         | machine | edges | lanes | radix | S1 | S2 | a triangle every | a culled one every |\n|---|---|---|---|---|---|---|---|"
    );
    for (name, kind) in [("default", "exact"), ("default", "slope"), ("textbook", "slope")] {
        for lanes in [1, 2, 4] {
            for radix in [2, 4, 16] {
                let mut machine = Machine::preset(name).expect("a preset");
                machine.set("edge.kind", kind).expect("a key");
                (machine.lanes, machine.radix) = (lanes, radix);
                let machine = machine.plan().expect("can be built");
                let clocks = setup_clocks(&machine);
                let (every, culled) = (triangle_interval(&machine), culled_interval(&machine));
                assert_eq!(every, u64::from(clocks.phase1 + clocks.phase2 + 2));
                assert_eq!(culled, u64::from(clocks.phase1 + 1));
                let _ = writeln!(
                    table,
                    "| {name} | {kind} | {lanes} | {radix} | {} | {} | {every} | {culled} |",
                    clocks.phase1, clocks.phase2
                );
            }
        }
    }
}

/// S2 of machines with channels of the user's own, on every number of lanes; the formula is 1 + ceil(N/lanes) T2.
fn channel_table(table: &mut String) {
    let _ = writeln!(
        table,
        "\n## Channels\nS2, clocks of SETUP for the channels, of machines with N of them (radix 4; extra channels of the default's 26 bits, shorter\n\
         than z), and from one triangle to the next, S1 + S2 + 2. Measured as above.\n\n\
         | machine | N | lanes | S2 | a triangle every |\n|---|---|---|---|---|"
    );
    for name in ["default", "textbook"] {
        for extra in 0..=4 {
            for lanes in [1, 2, 4] {
                let preset = Machine::preset(name).expect("a preset");
                let machine = Machine { extra, lanes, radix: 4, ..preset }.plan().expect("can be built");
                let clocks = setup_clocks(&machine);
                let every = triangle_interval(&machine);
                assert_eq!(every, u64::from(clocks.phase1 + clocks.phase2 + 2));
                let channels = machine.channels().len();
                let _ = writeln!(table, "| {name} | {channels} | {lanes} | {} | {every} |", clocks.phase2);
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
                let setup = setup_clocks(&machine);
                let run = trace(&machine, &[long]);
                let first = run.reads[0].0 - run.triangles[0] - u64::from(setup.phase1 + setup.phase2);
                // prim, line, span, T clocks of adding, D segments
                assert_eq!(first, 3 + u64::from(machine.clocks_per_pixel() + machine.segments));
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
    let mut table = "# Timing\n\nWritten by `EDGEWALK_BLESS=1 cargo test -p edgewalk-model --test timing`; \
                     the test compares it with the machine.\n\n"
        .to_owned();
    setup_table(&mut table);
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
