//! Faults put into the source of the model one at a time; each must show in a comparison with the netlist.
//!
//! ```text
//!  crates/model/src ─ one text replaced ─> model n ─> picture, counters ─┐
//!                                                                         ├─ equal? the fault survives
//!                        crates/rtl ─ interpreter ─> picture, counters ───┘
//! ```
//! Compared are every value, fragments, writes and last triangle of every pixel, and the cycles by cause, for seven
//! machines, the directed suites, and a memory that is quick, slow, and slow to write. The netlist draws with the quick one:
//! a picture does not depend on the memory. How long it takes with the others the model without a fault says, every port of
//! which lock-step compares with the netlist in every cycle. A fault that panics or does not come to its end is found too.

mod list;
#[path = "../../../crates/vectors/tests/common/mod.rs"]
mod machines;

use edgewalk_lockstep::{StallKind, render_rtl};
use edgewalk_machine::{Hazard, Kind, Machine, Plan, PortVertex, Precision};
use edgewalk_vectors::Suite;
use list::MUTANTS;
use std::process::ExitCode;
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

/// Depth function, and the stalls of the memory: seed, rd, data, wr.
#[derive(Clone, Copy)]
struct Setting(u8, [u8; 3]);

const SETTINGS: [Setting; 4] =
    [Setting(1, [0, 0, 0]), Setting(3, [40, 80, 60]), Setting(1, [0, 250, 250]), Setting(5, [10, 0, 252])];

type Triangle = [PortVertex; 3];

/// What is compared: numbers of every pixel, one list after the other, then the counters.
type Seen = Vec<u64>;

macro_rules! picture {
    ($frame:expr) => {{
        let frame = &$frame;
        let mut seen: Seen = frame.z.clone();
        seen.extend(frame.rgb.iter().flatten());
        seen.extend(frame.extra.iter().flatten().map(|value| *value as u64));
        seen.extend(frame.coverage.iter().chain(&frame.writes).map(|count| u64::from(*count)));
        seen.extend(frame.id.iter().map(|id| *id as u64));
        seen
    }};
}

macro_rules! counters {
    ($frame:expr) => {{
        let counters = &$frame.counters;
        let mut seen = vec![counters.cycles, counters.triangles, counters.fragments, counters.writes];
        seen.extend(counters.activity);
        seen
    }};
}

macro_rules! frame {
    ($model:path, $plan:expr, $triangles:expr, $setting:expr) => {{
        use $model as model;
        let Setting(depth_func, [rd, data, wr]) = $setting;
        let state = model::DrawState { depth_func, ..model::DrawState::default() };
        let stalls = model::Stalls { seed: 1, rd, data, wr };
        model::render($plan, $triangles.iter().copied(), state, stalls).expect("this machine's vertices")
    }};
}

macro_rules! draw {
    ($model:path) => {
        |plan, triangles, setting| {
            let frame = frame!($model, plan, triangles, setting);
            [picture!(frame), counters!(frame)].concat()
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
    plan: Plan,
    triangles: Vec<Triangle>,
    setting: Setting,
    expected: Seen,
}

/// The machines, one with channels of every kind.
fn plans() -> Vec<(&'static str, Plan)> {
    let names = [
        "small",
        "two_adders_drain",
        "one_adder_interlock",
        "four_segments_interlock",
        "textbook",
        "textbook_exact_edges",
    ];
    let mut plans: Vec<_> = machines::twelve().into_iter().filter(|(name, _)| names.contains(name)).collect();
    let mut own =
        Machine { extra: 3, adders: 3, lanes: 2, hazard: Hazard::Forward, ..Machine::clone(&plans[0].1) };
    for (extra, kind) in own.extras.iter_mut().zip(Kind::ALL) {
        extra.kind = kind;
        extra.precision = Precision { bits: 7, fraction: 8, vertex_fraction: 2 };
    }
    plans.push(("own_channels", own.plan().expect("can be built")));
    plans
}

/// What the netlist makes of it; with a memory that keeps it waiting the cycles are the model's.
fn expected(plan: &Plan, triangles: &[Triangle], setting: Setting) -> Seen {
    let state = edgewalk_model::DrawState { depth_func: setting.0, ..Default::default() };
    let netlist =
        render_rtl(plan, triangles.iter().copied(), state, StallKind::None).expect("it can be drawn");
    let model = frame!(edgewalk_model, plan, triangles, setting);
    let counters = if setting.1 == [0; 3] { counters!(netlist) } else { counters!(model) };
    [picture!(netlist), counters].concat()
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, plan) in plans() {
        for suite in ["hazards", "corners", "sphere"] {
            for (i, setting) in SETTINGS.into_iter().enumerate() {
                let triangles = Suite::named(&plan, suite, 1, 24).expect("listed");
                let triangles: Vec<_> = triangles.triangles().copied().collect();
                let expected = expected(&plan, &triangles, setting);
                let (name, plan) = (format!("{name}, {suite}, memory {i}"), plan.clone());
                cases.push(Case { name, plan, triangles, setting, expected });
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
            |case: &&Case| models::ALL[mutant](&case.plan, &case.triangles, case.setting) != case.expected;
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
