//! What is shown: an icosahedron on four machines, its page in a file, and the model run anew beside it.

use edgewalk_machine::{
    Counted, DrawState, Machine, Maps, Pass, Plan, PortVertex, Record, Shading, first_of_picture, steps,
};
use edgewalk_model::{Frame, Rig, Stalls, View, for_channels, render_passes};
use edgewalk_replay::{Recording, Replay, Rules, Window, page, record_passes};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::PathBuf;
use tempfile::TempDir;

pub type Triangle = [PortVertex; 3];

/// A machine, and what it draws by which rules.
pub struct Case {
    pub name: &'static str,
    pub plan: Plan,
    pub triangles: Vec<Triangle>,
    pub passes: Vec<Pass>,
    /// Of a light, if there is one.
    pub maps: Vec<Vec<u32>>,
    pub shading: Shading,
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
    icosahedron_on(plan, (plan.width, plan.height))
}

/// An icosahedron in the middle of a picture of that width and height.
fn icosahedron_on(plan: &Plan, (width, height): (u32, u32)) -> Vec<Triangle> {
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
        let size = f64::from(width.min(height)) * 0.24;
        let place = |value: f64, side: u32| f64::from(side) / 2.0 + value * size + 0.21;
        let unit = |value: f64| (value / 4.2 + 0.5).clamp(0.0, 1.0);
        (place(x, width), place(-y, height), [unit(-z), unit(x), unit(y), unit(z)])
    };
    let vertex = |k: usize| {
        let (x, y, near) = corner(k);
        let mut values = near.to_vec();
        // The light comes from where the eye is: texels follow the screen, its depths those of the picture. What else there is is
        // half transparent.
        let (size, deep) = (f64::from(plan.shadow.size), f64::from(1 << plan.shadow.depth_bits));
        values.extend(plan.channels()[4..].iter().map(|channel| match channel.name {
            "lx" => x / f64::from(width) * size,
            "ly" => y / f64::from(height) * size,
            "lz" => near[0] * deep,
            _ => 0.5,
        }));
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

/// Default, one adder, drain with a slow memory, the textbook, one that blends, one with a light, one that shades pixels.
pub fn seven() -> Vec<Case> {
    let textbook = Machine::preset("textbook").expect("a preset");
    let drain = [("memory.hazard", "drain"), ("memory.latency", "8"), ("fifo.inflight", "6")];
    let shade = [
        ("shade.kind", "phong"),
        ("term.record_bits", "3"),
        ("shade.colour", "multiply"),
        ("texture.kind", "nearest"),
        ("texture.bits", "3"),
    ];
    let machines = [
        ("default", machine(Machine::default(), &[])),
        (
            "1 adder",
            machine(Machine::default(), &[("interpolator.adders", "1"), ("interpolator.segments", "2")]),
        ),
        ("drain", machine(Machine::default(), &drain)),
        ("textbook", machine(textbook, &[])),
        ("blend", machine(Machine::default(), &[("blend.kind", "interpolated")])),
        ("light", machine(Machine::default(), &[("shadow.light", "parallel"), ("shadow.size", "16")])),
        ("shade", machine(Machine::default(), &shade)),
    ];
    let case = |(name, plan): (&'static str, Plan)| {
        let stalls =
            if name == "drain" { Stalls { seed: 1, rd: 40, data: 40, wr: 40 } } else { Stalls::NONE };
        Case { stalls, ..Case::of(name, plan) }
    };
    machines.into_iter().map(case).collect()
}

/// Words of any terms, a few pixels from the screen at most; tables and roots of any numbers.
fn shading(plan: &Plan, triangles: usize) -> Shading {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    if !plan.shade.is_there() {
        return Shading::default();
    }
    let mut record = || Record {
        x: rng.random_range(0..plan.width as i32),
        y: rng.random_range(0..plan.height),
        material: rng.random_range(0..1 << plan.shade.material_bits.min(1)),
        gloss: 2,
        terms: plan.terms().iter().map(|_| std::array::from_fn(|_| rng.random::<u64>() >> 40)).collect(),
    };
    let records = (0..triangles).map(|_| record()).collect();
    let mut words = |count: usize| (0..count).map(|_| (rng.random::<u64>() >> 40).into()).collect();
    let texels = 1 << (plan.shade.material_bits + 2 * plan.shade.texture_bits);
    Shading { records, tables: words(1 << 13), roots: words(256), textures: words(texels) }
}

impl Case {
    /// All triangles by the same rules; a light that is there sees every other texel nearer than anything.
    pub fn of(name: &'static str, plan: Plan) -> Case {
        let light = plan.shadow.is_there();
        let state = DrawState { shadow_on: light, ..DrawState::default() };
        let texels = 0..1u32 << (2 * plan.shadow.side_bits());
        let map = texels.map(|texel| if texel % 2 == 0 { 0 } else { (1 << plan.shadow.depth_bits) - 1 });
        let triangles = icosahedron(&plan);
        Case {
            name,
            passes: vec![Pass { map: light.then_some(0), ..Pass::all(state) }],
            maps: if light { vec![map.collect()] } else { Vec::new() },
            shading: shading(&plan, triangles.len()),
            triangles,
            plan,
            stalls: Stalls::NONE,
        }
    }

    /// A machine that draws the map of 16 x 16 texels itself, from the same triangles.
    pub fn own_map() -> Case {
        let settings = [("shadow.light", "parallel"), ("shadow.size", "16"), ("shadow.own_pass", "yes")];
        let case = Case::of("own map", machine(Machine::default(), &settings));
        let light = DrawState { light_pass: true, ..DrawState::default() };
        let pass = Pass { triangles: FACES.len(), state: light, clear_depth: true, map: Some(0) };
        let lights = icosahedron_on(&case.plan, (16, 16));
        Case {
            triangles: [&lights[..], &case.triangles].concat(),
            passes: [&[pass], &case.passes[..]].concat(),
            maps: Vec::new(),
            ..case
        }
    }

    /// A machine with POLY that draws the polygon of the slides, four pixels to one of theirs.
    pub fn polygon() -> Case {
        let plan = machine(Machine::default(), &[("polygon.edges", "8")]);
        let corner = |[x, y]: [f64; 2]| {
            let values = [0.5, x / 16.0, 1.0 - y / 16.0, 0.6];
            plan.port_vertex(4.0 * x + 1.0, 4.0 * y, &values).expect("on the screen")
        };
        let contour =
            [[2.0, 3.0], [7.0, 1.0], [13.0, 5.0], [13.0, 11.0], [7.0, 7.0], [2.0, 9.0]].map(corner).to_vec();
        let triangles = plan.polygon(std::slice::from_ref(&contour), plan.window_from(&contour));
        Case { triangles, ..Case::of("polygon", plan) }
    }

    pub fn recording(&self, window: Window) -> Recording {
        let rules = Rules { passes: &self.passes, maps: &self.maps, shading: &self.shading };
        record_passes(&self.plan, &self.triangles, &rules, self.stalls, window).expect("recorded")
    }

    pub fn replay<'a>(&'a self, recording: &'a Recording) -> Replay<'a> {
        Replay {
            plan: &self.plan,
            scene: if self.plan.polygon.is_there() { "polygon" } else { "icosahedron" },
            triangles: &self.triangles,
            drawn: Counted::of(&self.triangles),
            of: Counted::of(&self.triangles),
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
        render_passes(&self.plan, triangles, &self.passes, &self.maps, self.stalls, &self.shading)
            .expect("its own vertices")
    }

    /// Runs the model anew and sees every cycle, and the write that fires in it: address and triangle.
    pub fn watch(&self, mut see: impl FnMut(u32, &View, Option<(u32, u32)>)) {
        for_channels!(self.plan, C => {
            let mut rig = Rig::<C>::new(&self.plan, first_of_picture(&self.passes), self.stalls);
            rig.memories.write_shading(&self.plan, &self.shading);
            let (mut view, mut maps, mut now) = (View::new(), Maps::of_host(&self.maps), 0..);
            let mut waiting = &self.triangles[..];
            for step in steps(&self.plan, &self.passes, &self.shading) {
                let Some(count) = rig.memories.take_step(&self.plan, step, &mut maps) else { continue };
                let mut left = count.min(waiting.len());
                loop {
                    let offered = waiting.first().filter(|_| left > 0).map(|triangle| (triangle, 0));
                    rig.model.view(&self.plan, &rig.inputs(offered, true), &mut view);
                    let cycle = rig.cycle(offered, true);
                    let now = now.next().expect("fewer than 2^32 cycles");
                    see(now, &view, cycle.write().map(|write| (write.addr, write.source.id)));
                    if cycle.outputs.triangle {
                        (waiting, left) = (&waiting[1..], left - 1);
                    } else if cycle.outputs.idle && left == 0 {
                        break;
                    }
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
