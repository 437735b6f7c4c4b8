//! Tokens a second of every unit by itself, of the machine and of the fast path: `cargo bench -p edgewalk-model`.
//!
//! A unit gets the tokens that the one before it made, one whenever it takes one, and nothing behind it ever waits.

#![allow(missing_docs)] // criterion_group! writes none

#[path = "../tests/common/depth.rs"]
#[allow(dead_code)] // of which only the feeding is used
mod depth;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use depth::feed;
use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::edge::Edge;
use edgewalk_model::fast::Renderer;
use edgewalk_model::pixel::Pixel;
use edgewalk_model::setup::Setup;
use edgewalk_model::span::Span;
use edgewalk_model::term::Walked;
use edgewalk_model::tokens::{self, FEW, Fragment, Line, Prim};
use edgewalk_model::{DrawState, Events, Stalls, render};
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::hint::black_box;

type Triangle = [PortVertex; 3];

/// Random triangles that lie within 64 pixels each.
fn triangles(machine: &Plan) -> Vec<Triangle> {
    let mut rng = StdRng::seed_from_u64(1);
    let one = 1 << machine.subpixel_bits;
    (0..100)
        .map(|_| {
            let middle =
                [machine.width, machine.height].map(|side| rng.random_range(32..side as i32 - 32) * one);
            std::array::from_fn(|_| {
                let [x, y] = middle.map(|m| m + rng.random_range(-32 * one..=32 * one));
                let values = machine.channels().iter();
                let values = values.map(|c| (rng.random_range(0..=c.max()) << c.vertex_fraction) as i64);
                machine.raw_vertex(x, y, &values.collect::<Vec<_>>())
            })
        })
        .collect()
}

fn setup(machine: &Plan, triangles: &[Triangle]) -> Vec<Prim<FEW>> {
    let mut unit = Setup::new(machine);
    let mut prims = Vec::new();
    let mut input = triangles.iter();
    let mut next = input.next();
    while next.is_some() || !unit.tri_ready() {
        prims.extend(unit.prim().cloned());
        let taken = unit.tri_ready();
        unit.step(next.map(|t| (t, 0)), true, false, &mut Events::default());
        if taken {
            next = input.next();
        }
    }
    prims
}

fn edge(machine: &Plan, prims: &[Prim<FEW>]) -> Vec<Line<FEW>> {
    let mut unit = Edge::new(machine);
    let mut lines = Vec::new();
    let mut input = prims.iter();
    let mut next = input.next();
    while next.is_some() || unit.running() {
        lines.extend(unit.line().cloned());
        let taken = unit.prim_ready(false);
        unit.step(next, false, true, &mut Events::default());
        if taken {
            next = input.next();
        }
    }
    lines
}

fn span(machine: &Plan, lines: &[Line<FEW>]) -> Vec<tokens::Span<FEW>> {
    let mut unit = Span::new(machine);
    let mut spans = Vec::new();
    for line in lines {
        spans.extend(unit.span().cloned());
        unit.step(Some(line).filter(|_| unit.line_ready()), true, false, &mut Events::default());
    }
    // The last line goes from the register into the queue.
    spans.extend(unit.span().cloned());
    unit.step(None, true, false, &mut Events::default());
    spans.extend(unit.span().cloned());
    spans
}

fn pixel(machine: &Plan, spans: &[tokens::Span<FEW>]) -> Vec<Fragment<FEW>> {
    let mut unit = Pixel::new(machine);
    let mut fragments = Vec::new();
    let mut input = spans.iter();
    let mut next = input.next();
    while next.is_some() || unit.occupied() {
        fragments.extend(unit.frag().cloned());
        let taken = unit.span_ready(true);
        unit.step(next, (&[1; FEW], 0), Walked::default, true, false, &mut Events::default());
        if taken {
            next = input.next();
        }
    }
    fragments
}

fn units(criterion: &mut Criterion) {
    let machine = &Machine { width: 128, height: 128, ..Machine::default() }.plan().expect("can be built");
    let triangles = triangles(machine);
    let prims = setup(machine, &triangles);
    let lines = edge(machine, &prims);
    let spans = span(machine, &lines);
    let fragments = pixel(machine, &spans);
    let mut group = criterion.benchmark_group("model");
    let mut bench = |name: &str, tokens: usize, work: &mut dyn FnMut()| {
        group.throughput(Throughput::Elements(tokens as u64)).bench_function(name, |b| b.iter(&mut *work));
    };
    bench("setup, prims", prims.len(), &mut || drop(black_box(setup(machine, &triangles))));
    bench("edge, lines", lines.len(), &mut || drop(black_box(edge(machine, &prims))));
    bench("span, spans", spans.len(), &mut || drop(black_box(span(machine, &lines))));
    bench("pixel, fragments", fragments.len(), &mut || drop(black_box(pixel(machine, &spans))));
    bench("depth and memory, fragments", fragments.len(), &mut || {
        black_box(feed(machine, &fragments, DrawState::default(), Stalls::NONE));
    });
    let state = DrawState::default();
    let cycles = render(machine, triangles.iter().copied(), state, Stalls::NONE)
        .expect("this machine's vertices")
        .counters
        .cycles;
    bench("machine, cycles", cycles as usize, &mut || {
        black_box(render(machine, triangles.iter().copied(), state, Stalls::NONE)).ok();
    });
    let mut renderer = Renderer::new(machine, false);
    bench("fast path, cycles", cycles as usize, &mut || {
        black_box(renderer.draw(triangles.iter().copied(), state)).ok();
    });
}

criterion_group!(benches, units);
criterion_main!(benches);
