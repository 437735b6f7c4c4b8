//! Faults put into the source of the model one at a time; each must show in a comparison with the netlist.
//!
//! ```text
//!  crates/model/src ─ one text replaced ─> model n ─> picture, counters ─┐
//!                                                                         ├─ equal? the fault survives
//!                        crates/rtl ─ interpreter ─> picture, counters ───┘
//! ```
//! Compared are depths, colours, fragments, writes and last triangle of every pixel, and the cycles by cause, for six
//! machines, the directed suites, and a memory that is quick, slow, and slow to write. A fault that panics or does not
//! come to its end is found too.

mod list;
#[path = "../../../crates/vectors/tests/common/mod.rs"]
mod machines;

use edgewalk_machine::{Machine, PortVertex};
use edgewalk_vectors::{Suite, render_rtl};
use list::MUTANTS;
use std::process::ExitCode;
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

/// Depth function, and the stalls of the memory: seed, rd, data, wr.
#[derive(Clone, Copy)]
struct Setting(u8, [u8; 3]);

const SETTINGS: [Setting; 4] =
    [Setting(1, [0, 0, 0]), Setting(3, [40, 80, 60]), Setting(1, [0, 250, 250]), Setting(5, [10, 0, 252])];

/// What is compared: numbers of every pixel, one list after the other, then the counters.
type Seen = Vec<u64>;

macro_rules! seen {
    ($frame:expr) => {{
        let frame = $frame;
        let mut seen: Seen = frame.z;
        seen.extend(frame.rgb.iter().flatten());
        seen.extend(frame.coverage.iter().chain(&frame.writes).map(|count| u64::from(*count)));
        seen.extend(frame.id.iter().map(|id| *id as u64));
        let counters = frame.counters;
        seen.extend([counters.cycles, counters.triangles, counters.fragments, counters.writes]);
        seen.extend(counters.activity);
        seen
    }};
}

macro_rules! draw {
    ($model:ident) => {
        |machine, triangles, Setting(depth_func, [rd, data, wr])| {
            let state = $model::DrawState { depth_func, ..$model::DrawState::default() };
            let stalls = $model::Stalls { seed: 1, rd, data, wr };
            seen!($model::render(machine, triangles.iter().copied(), state, stalls))
        }
    };
}

#[allow(unused)] // copies of which only `render` is used
mod models {
    use super::*;
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
    pub const ALL: &[Draw] = &DRAW;
}

/// A machine, what it draws under which setting, and what the netlist makes of it.
struct Case {
    name: String,
    machine: Machine,
    triangles: Vec<[PortVertex; 3]>,
    setting: Setting,
    expected: Seen,
}

fn cases() -> Vec<Case> {
    let names = [
        "small",
        "two_adders_drain",
        "one_adder_interlock",
        "four_segments_interlock",
        "textbook",
        "textbook_exact_edges",
    ];
    let mut cases = Vec::new();
    for (name, machine) in machines::twelve().into_iter().filter(|(name, _)| names.contains(name)) {
        for suite in ["hazards", "corners", "sphere"] {
            for (i, setting) in SETTINGS.into_iter().enumerate() {
                let triangles = Suite::named(&machine, suite, 1, 24).expect("listed");
                let triangles: Vec<_> = triangles.triangles().copied().collect();
                let draw: fn(&Machine, &[[PortVertex; 3]], Setting) -> Seen =
                    |machine, triangles, Setting(depth_func, [rd, data, wr])| {
                        let state = edgewalk_model::DrawState { depth_func, ..Default::default() };
                        let stalls = edgewalk_model::Stalls { seed: 1, rd, data, wr };
                        seen!(render_rtl(machine, triangles.iter().copied(), state, stalls).expect("checked"))
                    };
                let expected = draw(&machine, &triangles, setting);
                let (name, machine) = (format!("{name}, {suite}, memory {i}"), machine.clone());
                cases.push(Case { name, machine, triangles, setting, expected });
            }
        }
    }
    cases
}

/// Where the fault shows first.
fn killed_by(mutant: usize, cases: &Arc<Vec<Case>>) -> Option<String> {
    let (cases, (send, receive)) = (Arc::clone(cases), mpsc::channel());
    std::thread::spawn(move || {
        let differs =
            |case: &&Case| models::ALL[mutant](&case.machine, &case.triangles, case.setting) != case.expected;
        // If nobody waits any more there is nobody to tell.
        let _ = send.send(cases.iter().find(differs).map(|case| case.name.clone()));
    });
    match receive.recv_timeout(Duration::from_secs(60)) {
        Ok(found) => found,
        Err(mpsc::RecvTimeoutError::Timeout) => Some("does not come to its end".to_owned()),
        Err(mpsc::RecvTimeoutError::Disconnected) => Some("panics".to_owned()),
    }
}

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(|_| {})); // a fault that panics is told in one line
    let start = Instant::now();
    let cases = Arc::new(cases());
    if let Some(case) = killed_by(0, &cases) {
        println!("FAIL: without a fault model and netlist differ: {case}");
        return ExitCode::FAILURE;
    }
    let mut killed = 0;
    for (i, (name, file, ..)) in MUTANTS.iter().enumerate().skip(1) {
        let found = killed_by(i, &cases);
        killed += usize::from(found.is_some());
        let found = found.map_or("SURVIVES".to_owned(), |case| format!("killed ({case})"));
        println!("{name:<50} {file:<18} {found}");
    }
    let expected = MUTANTS.len() - 1;
    println!("killed {killed} / {expected} over {} cases, {:.1?}", cases.len(), start.elapsed());
    if killed * 100 >= expected * 95 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
