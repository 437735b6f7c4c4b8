//! What is shown: an icosahedron on four machines, its page in a file, and the model run anew beside it.

use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::{DrawState, Frame, Rig, Stalls, View, for_channels, render};
use edgewalk_replay::{Recording, Replay, Window, page, record};
use std::path::PathBuf;
use tempfile::TempDir;

pub type Triangle = [PortVertex; 3];

/// A machine, and what it draws.
pub struct Case {
    pub name: &'static str,
    pub plan: Plan,
    pub triangles: Vec<Triangle>,
    pub stalls: Stalls,
}

/// Faces of an icosahedron.
const FACES: [[usize; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

/// An icosahedron in the middle of a screen, its faces in order, whatever side they show.
pub fn icosahedron(plan: &Plan) -> Vec<Triangle> {
    let g = (1.0 + 5.0f64.sqrt()) / 2.0;
    let corner = |k: usize| {
        let (a, b) = ([-1.0, 1.0][k % 2], [g, -g][k / 2 % 2]);
        let [x, y, z] = match k / 4 {
            0 => [a, b, 0.0],
            1 => [0.0, a, b],
            _ => [b, 0.0, a],
        };
        let (s, c) = 0.5f64.sin_cos();
        let (x, z) = (x * c + z * s, z * c - x * s);
        let (y, z) = (y * 0.95 + z * 0.3, z * 0.95 - y * 0.3);
        let size = f64::from(plan.width.min(plan.height)) * 0.24;
        let place = |value: f64, side: u32| f64::from(side) / 2.0 + value * size + 0.21;
        let unit = |value: f64| (value / 4.2 + 0.5).clamp(0.0, 1.0);
        (place(x, plan.width), place(-y, plan.height), [unit(-z), unit(x), unit(y), unit(z)])
    };
    let vertex = |k: usize| {
        let (x, y, values) = corner(k);
        let mut values = values.to_vec();
        // What else there is is half transparent.
        values.resize(plan.channels().len(), 0.5);
        plan.port_vertex(x, y, &values).expect("on the screen")
    };
    FACES.iter().map(|face| face.map(vertex)).collect()
}

pub fn machine(base: Machine, settings: &[(&str, &str)]) -> Plan {
    let mut machine = base;
    for (key, value) in [("screen.width", "64"), ("screen.height", "48")].iter().chain(settings) {
        machine.set(key, value).expect("a key");
    }
    machine.plan().expect("can be built")
}

/// Default, one adder, drain with a slow memory, the textbook, and one that blends.
pub fn five() -> Vec<Case> {
    let textbook = Machine::preset("textbook").expect("a preset");
    let drain = [("memory.hazard", "drain"), ("memory.latency", "8"), ("fifo.inflight", "6")];
    let machines = [
        ("default", machine(Machine::default(), &[])),
        (
            "1 adder",
            machine(Machine::default(), &[("interpolator.adders", "1"), ("interpolator.segments", "2")]),
        ),
        ("drain", machine(Machine::default(), &drain)),
        ("textbook", machine(textbook, &[])),
        ("blend", machine(Machine::default(), &[("blend.kind", "interpolated")])),
    ];
    let case = |(name, plan): (&'static str, Plan)| {
        let stalls =
            if name == "drain" { Stalls { seed: 1, rd: 40, data: 40, wr: 40 } } else { Stalls::NONE };
        Case { name, triangles: icosahedron(&plan), plan, stalls }
    };
    machines.into_iter().map(case).collect()
}

impl Case {
    pub fn recording(&self, window: Window) -> Recording {
        record(&self.plan, &self.triangles, DrawState::default(), self.stalls, window).expect("recorded")
    }

    pub fn replay<'a>(&'a self, recording: &'a Recording) -> Replay<'a> {
        Replay {
            plan: &self.plan,
            scene: "icosahedron",
            triangles: &self.triangles,
            of: self.triangles.len(),
            recording,
            truth: &[],
            command: Some("edgewalk explain icosahedron.obj {x} {y}".to_owned()),
            difference: None,
            lesson: None,
        }
    }

    pub fn html(&self) -> String {
        page::html(&self.replay(&self.recording(Window::default())).json())
    }

    /// The picture as the model draws it.
    pub fn frame(&self) -> Frame {
        let triangles = self.triangles.iter().copied();
        render(&self.plan, triangles, DrawState::default(), self.stalls).expect("its own vertices")
    }

    /// Runs the model anew and sees every cycle, and the write that fires in it: address and triangle.
    pub fn watch(&self, mut see: impl FnMut(u32, &View, Option<(u32, u32)>)) {
        for_channels!(self.plan, C => {
            let mut rig = Rig::<C>::new(&self.plan, DrawState::default(), self.stalls);
            let (mut view, mut waiting) = (View::new(), &self.triangles[..]);
            for now in 0.. {
                let offered = waiting.first().map(|triangle| (triangle, 0));
                rig.model.view(&self.plan, &rig.inputs(offered, true), &mut view);
                let cycle = rig.cycle(offered, true);
                see(now, &view, cycle.write().map(|write| (write.addr, write.source.id)));
                if cycle.triangle {
                    waiting = &waiting[1..];
                } else if cycle.outputs.idle && waiting.is_empty() {
                    break;
                }
            }
        });
    }

    /// Column and line of an address.
    pub fn place(&self, addr: u32) -> (u32, u32) {
        let x_bits = self.plan.widths().x;
        (addr & ((1 << x_bits) - 1), addr >> x_bits)
    }
}

/// A page in a folder whose name is not a plain one.
pub fn file(html: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::Builder::new().prefix("mit Lücke ").tempdir().expect("a folder");
    let path = folder.path().join("ein Bild.html");
    std::fs::write(&path, html).expect("written");
    (folder, path)
}
