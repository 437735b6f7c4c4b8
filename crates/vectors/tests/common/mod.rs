//! Machines that the tests share.
#![allow(dead_code)] // every test file uses a part of it

use edgewalk_lockstep::{Agreement, Interface, LockstepError, NetlistDevice, PortError};
use edgewalk_machine::units;
use edgewalk_machine::{
    Blend, BlendKind, Bump, Dither, EdgeKind, Fill, Gate, Hazard, Kind, Lines, Machine, OwnPass, Plan,
    Precision, Project, ScreenDoor, SetupKind, Shade, ShadeColour, ShadeKind, ShadeLight, Shadow,
    ShadowLight, Texture, Transmits, Values, Walk,
};
use edgewalk_netlist::Netlist;
use edgewalk_vectors::{Files, Trace, Unit};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Writes a directory of vectors.
pub fn write(files: &Files, to: &Path) {
    for (name, bytes) in files {
        let path = to.join(name);
        std::fs::create_dir_all(path.parent().expect("inside")).expect("a directory");
        std::fs::write(path, bytes).expect("a file");
    }
}

/// A netlist compiled: quicker by far than the interpreter, which tests of its own hold it against.
pub fn native(
    netlist: &Netlist,
    interface: &Interface,
) -> Result<NetlistDevice<edgewalk_jit::Simulator>, PortError> {
    let simulator = edgewalk_jit::Simulator::new(netlist).expect("a code generator for this host");
    NetlistDevice::run_by(simulator, netlist, interface)
}

/// Runs a netlist, compiled, beside the model.
pub fn lockstep(trace: &Trace, netlist: &Netlist) -> Result<Agreement, LockstepError> {
    trace.lockstep_of(&mut native(netlist, &trace.interface)?)
}

/// The units of a machine, and the machine, as native code: each is built and compiled once, however often it runs.
pub struct Natives<'a> {
    plan: &'a Plan,
    compiled: BTreeMap<&'static str, NetlistDevice<edgewalk_jit::Simulator>>,
}

impl<'a> Natives<'a> {
    pub fn new(plan: &'a Plan) -> Self {
        Natives { plan, compiled: BTreeMap::new() }
    }

    /// Runs the unit of the trace beside the model, from the state that it has before the first clock: how many port values
    /// were compared, which is all of the trace. `machine` is the machine's name among the tests' machines.
    pub fn compared(&mut self, machine: &str, trace: &Trace) -> u64 {
        let unit = trace.interface.unit;
        let device = self.compiled.entry(unit.name()).or_insert_with(|| {
            let netlist = edgewalk_vectors::design::netlist(self.plan, unit).expect("a checked machine");
            native(&netlist, &trace.interface).expect("the ports that are declared")
        });
        let agreement = trace.lockstep_of(&mut device.clone());
        let run = format!("{machine}, {}, stalls {}", unit.name(), trace.stalls.name());
        let compared = agreement.unwrap_or_else(|error| panic!("{run}: {error}")).compared;
        assert_eq!(compared, trace.port_values(), "{run}");
        compared
    }
}

/// `make` in a directory as a user runs it: whether it passes, and all that is said.
pub fn made(folder: &Path, arguments: &[&str]) -> (bool, String) {
    let mut make = Command::new("make");
    // What a surrounding make or the user's shell says to make is none of this one's business.
    for name in ["MAKEFLAGS", "MAKELEVEL", "MFLAGS", "HDL", "CHECK_CYCLES", "RULES", "SEED", "SHA256SUM"] {
        make.env_remove(name);
    }
    // The C++ that Verilator writes runs for a moment only: to optimise it takes longer.
    make.env("MAKEFLAGS", "e");
    for level in ["OPT_FAST", "OPT_SLOW", "OPT_GLOBAL"] {
        make.env(level, "-O0");
    }
    let output = make.arg("-C").arg(folder).args(arguments).output().expect("make is installed");
    let said = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&said).into_owned())
}

/// A machine with a small screen and short words: quick in every tool.
pub fn small() -> Plan {
    checked(Machine {
        width: 24,
        height: 20,
        guard_bits: 6,
        subpixel_bits: 4,
        z: Precision { bits: 8, fraction: 8, vertex_fraction: 2 },
        color: Precision { bits: 4, fraction: 8, vertex_fraction: 2 },
        lanes: 1,
        ..Machine::default()
    })
}

/// The same with four lanes in SETUP: for what comes after it. With one lane a suite takes two to three times the clocks.
pub fn quick() -> Machine {
    Machine { lanes: 4, ..Machine::clone(&small()) }
}

fn checked(machine: Machine) -> Plan {
    machine.plan().expect("can be built")
}

/// The declared units.
pub const SETUP: Unit = Unit::of(&units::setup::SPEC);
pub const EDGE: Unit = Unit::of(&units::edge::SPEC);
pub const SPAN: Unit = Unit::of(&units::span::SPEC);
pub const POLY: Unit = Unit::of(&units::poly::SPEC);
pub const TERM: Unit = Unit::of(&units::term::SPEC);
pub const PIXEL: Unit = Unit::of(&units::pixel::SPEC);
pub const TEXEL: Unit = Unit::of(&units::texel::SPEC);
pub const BUMP: Unit = Unit::of(&units::bump::SPEC);
pub const NORMAL: Unit = Unit::of(&units::normal::SPEC);
pub const LAMP: Unit = Unit::of(&units::lamp::SPEC);
pub const SHADE: Unit = Unit::of(&units::shade::SPEC);
pub const DITHER: Unit = Unit::of(&units::dither::SPEC);
pub const DEPTH: Unit = Unit::of(&units::depth::SPEC);
pub const PROJECT: Unit = Unit::of(&units::project::SPEC);
pub const SHADOW: Unit = Unit::of(&units::shadow::SPEC);
pub const BLEND: Unit = Unit::of(&units::blend::SPEC);

/// A machine with channels of the user's own, of these kinds and numbers of bits.
fn with_extras<const K: usize>(machine: Machine, extras: [(Kind, u32); K]) -> Machine {
    let mut machine = Machine { extra: K as u32, ..machine };
    for (extra, (kind, bits)) in machine.extras.iter_mut().zip(extras) {
        extra.kind = kind;
        extra.precision = Precision { bits, fraction: 8, vertex_fraction: 2 };
    }
    machine
}

/// Three machines whose port takes lines: a wide screen, a high one with slopes and tags, one that blends and draws its map.
pub fn lined() -> Vec<(&'static str, Plan)> {
    let mut wide = quick();
    wide.polygon.lines = Lines::Yes;
    let slopes = Machine { edge_kind: EdgeKind::Slope, edge_fraction: 12, tag_bits: 3, ..wide.clone() };
    let high = Machine { width: 12, height: 33, subpixel_bits: 1, hazard: Hazard::Drain, ..slopes };
    let blend = Blend { kind: BlendKind::Constant, kt_fraction: 8, kt_vertex: 2, ..wide.blend };
    let light = Shadow { light: ShadowLight::Parallel, fraction: 8, vertex_fraction: 2, ..wide.shadow };
    let shadow = Shadow { size: 40, guard_bits: 0, depth_bits: 8, own_pass: OwnPass::Yes, ..light };
    let own_map = Machine { blend, shadow, lanes: 2, ..wide.clone() };
    [("wide", wide), ("high_slopes_tags", high), ("blend_own_map", own_map)]
        .map(|(name, machine)| (name, checked(machine)))
        .into()
}

/// The same machines with POLY in EDGE's place, but for the one that blends without lines; and one with bilinear colours.
pub fn polygonal() -> Vec<(&'static str, Plan)> {
    let with_poly = |(name, machine): (&'static str, Plan)| {
        let mut machine = Machine::clone(&machine);
        machine.polygon.edges = if name == "high_slopes_tags" { 16 } else { 8 };
        if name == "blend_own_map" {
            machine.polygon.lines = Lines::No;
        }
        (name, checked(machine))
    };
    let mut machines: Vec<_> = lined().into_iter().map(with_poly).collect();
    let (_, slopes) =
        machines.iter().find(|(name, _)| *name == "high_slopes_tags").expect("one of the three");
    let mut bilinear = Machine::clone(slopes);
    bilinear.polygon.values = Values::Bilinear;
    machines.push(("high_bilinear", checked(bilinear)));
    machines
}

/// Twelve machines with their names: adders, segments, lanes, radices, word lengths, fills, edges, hazard policies, and in
/// two of them channels of the user's own, more than their adders or lanes divide. Six have a sequenced SETUP, of 1, 2 and
/// 4 lanes, one of them in four rounds of channels.
pub fn twelve() -> Vec<(&'static str, Plan)> {
    let s = Machine::clone(&small());
    let textbook = Machine { subpixel_bits: 0, fill: Fill::Textbook, guard_bits: 6, ..s.clone() };
    let sequenced = Machine { setup_kind: SetupKind::Sequenced, ..s.clone() };
    let list = vec![
        ("small", s.clone()),
        ("two_adders_drain", Machine { adders: 2, hazard: Hazard::Drain, lanes: 2, ..s.clone() }),
        ("two_segments", Machine { segments: 2, latency: 1, inflight: 1, lanes: 4, ..sequenced.clone() }),
        ("one_adder_interlock", Machine { adders: 1, hazard: Hazard::Interlock, lanes: 4, ..s.clone() }),
        (
            "two_adders_of_two_segments_three_extras",
            with_extras(
                Machine { adders: 2, segments: 2, inflight: 7, latency: 5, lanes: 2, ..sequenced.clone() },
                [(Kind::Floor, 5), (Kind::Unorm, 3), (Kind::Signed, 7)],
            ),
        ),
        ("one_adder_of_four_segments", Machine { adders: 1, segments: 4, span_fifo: 1, ..sequenced.clone() }),
        (
            "four_segments_interlock",
            Machine { segments: 4, hazard: Hazard::Interlock, latency: 3, lanes: 4, ..s.clone() },
        ),
        (
            "slopes_two_extras",
            with_extras(
                Machine { edge_kind: EdgeKind::Slope, edge_fraction: 12, lanes: 4, ..sequenced.clone() },
                [(Kind::Unorm, 6), (Kind::Signed, 4)],
            ),
        ),
        (
            "textbook",
            Machine {
                edge_kind: EdgeKind::Slope,
                adders: 1,
                segments: 4,
                hazard: Hazard::Drain,
                lanes: 2,
                ..textbook.clone()
            },
        ),
        ("textbook_exact_edges", Machine { lanes: 4, setup_kind: SetupKind::Sequenced, ..textbook.clone() }),
        (
            "tiny",
            Machine {
                width: 8,
                height: 5,
                guard_bits: 4,
                subpixel_bits: 1,
                z: Precision { bits: 4, fraction: 0, vertex_fraction: 0 },
                color: Precision { bits: 2, fraction: 0, vertex_fraction: 0 },
                inflight: 1,
                latency: 1,
                tag_bits: 3,
                ..sequenced
            },
        ),
        (
            "wide_words",
            Machine {
                guard_bits: 8,
                subpixel_bits: 8,
                z: Precision { bits: 24, fraction: 14, vertex_fraction: 4 },
                color: Precision { bits: 8, fraction: 14, vertex_fraction: 4 },
                ..s
            },
        ),
    ];
    list.into_iter().map(|(name, machine)| (name, checked(machine))).collect()
}

/// Eight machines with BLEND: kinds, policies for depths and colours, multipliers, stages, queues, latencies.
pub fn glass() -> Vec<(&'static str, Plan)> {
    use BlendKind::{Constant, Interpolated};
    use Hazard::{Drain, Forward, Interlock};
    let small = quick();
    let machine = |kind, [depths, colors]: [Hazard; 2], [multipliers, stages, queue, latency]: [u32; 4]| {
        let blend = Blend { kind, hazard: colors, multipliers, stages, queue, latency, ..small.blend };
        Machine { hazard: depths, blend: Blend { kt_fraction: 8, kt_vertex: 2, ..blend }, ..small.clone() }
    };
    let mut odd = machine(Interpolated, [Drain, Forward], [0, 2, 5, 3]);
    (odd.blend.kt_bits, odd.tag_bits) = (5, 3);
    let tagged = Machine { tag_bits: 4, adders: 2, ..machine(Constant, [Interlock, Forward], [1, 2, 3, 2]) };
    let list = vec![
        ("constant_interlock", machine(Constant, [Interlock, Interlock], [3, 1, 4, 2])),
        ("constant_forward", machine(Constant, [Forward, Forward], [3, 1, 4, 2])),
        ("interpolated_forward_two_stages", machine(Interpolated, [Forward, Forward], [3, 2, 4, 1])),
        ("interpolated_drain_one_multiplier", machine(Interpolated, [Drain, Drain], [1, 1, 2, 2])),
        ("constant_forward_one_multiplier_two_stages_tags", tagged),
        ("interpolated_interlock_bit_by_bit", machine(Interpolated, [Forward, Interlock], [0, 1, 4, 4])),
        ("interpolated_forward_five_bits_by_bit_two_stages_tags", odd),
        (
            "textbook_constant_drain_two_extras",
            with_extras(
                Machine {
                    subpixel_bits: 0,
                    fill: Fill::Textbook,
                    ..machine(Constant, [Interlock, Drain], [3, 2, 1, 2])
                },
                [(Kind::Signed, 5), (Kind::Unorm, 3)],
            ),
        ),
    ];
    list.into_iter().map(|(name, machine)| (name, checked(machine))).collect()
}

/// Ten machines with SHADOW, three of them with PROJECT: gates, sides that are powers of two and not, queues, latencies, adders, three whose map transmits; four of them with BLEND, two with
/// channels of the user's own; the last two draw their map, larger than the screen and smaller.
pub fn lights() -> Vec<(&'static str, Plan)> {
    let small = quick();
    let light = |[size, guard_bits, depth_bits]: [u32; 3], gate, [queue, latency]: [u32; 2]| {
        let light = Shadow { light: ShadowLight::Parallel, fraction: 8, vertex_fraction: 2, ..small.shadow };
        let shadow = Shadow { size, guard_bits, depth_bits, gate, queue, latency, ..light };
        Machine { shadow, ..small.clone() }
    };
    let glass = |kind, hazard, machine: Machine| {
        let blend = Blend { kind, hazard, kt_fraction: 8, kt_vertex: 2, ..small.blend };
        Machine { blend, ..machine }
    };
    let perspective = |size, depth_bits, project, gate| {
        let machine = light([size, 0, depth_bits], gate, [3, 2]);
        let shadow =
            Shadow { light: ShadowLight::Perspective, light_bits: depth_bits + 4, project, ..machine.shadow };
        Machine { shadow, ..machine }
    };
    let transmits = |machine: Machine| {
        let shadow = Shadow { transmits: Transmits::Yes, ..machine.shadow };
        Machine { shadow, ..machine }
    };
    let own = |machine: Machine| {
        let shadow = Shadow { own_pass: OwnPass::Yes, ..machine.shadow };
        Machine { shadow, ..machine }
    };
    let tagged = Machine { tag_bits: 3, adders: 2, ..light([5, 1, 8], Gate::Scale, [3, 1]) };
    let tagged = with_extras(tagged, [(Kind::Signed, 5)]);
    let list = vec![
        ("and", light([8, 2, 8], Gate::And, [4, 2])),
        ("scale_five_texels_tags_one_extra", tagged),
        ("and_one_place", Machine { adders: 1, ..light([3, 0, 4], Gate::And, [1, 1]) }),
        (
            "scale_constant_kt_transmits",
            transmits(glass(BlendKind::Constant, Hazard::Forward, light([4, 1, 6], Gate::Scale, [2, 2]))),
        ),
        (
            "and_interpolated_kt",
            glass(BlendKind::Interpolated, Hazard::Interlock, light([1, 2, 5], Gate::And, [5, 3])),
        ),
        (
            "textbook_constant_kt_one_extra",
            with_extras(
                Machine {
                    subpixel_bits: 0,
                    fill: Fill::Textbook,
                    ..glass(BlendKind::Constant, Hazard::Drain, light([6, 1, 7], Gate::Scale, [4, 4]))
                },
                [(Kind::Unorm, 3)],
            ),
        ),
        (
            "perspective_pipelined_scale_tags",
            Machine { tag_bits: 3, ..perspective(5, 4, Project::Pipelined, Gate::Scale) },
        ),
        (
            "perspective_serial_constant_kt_transmits",
            transmits(glass(
                BlendKind::Constant,
                Hazard::Forward,
                perspective(8, 6, Project::Serial, Gate::And),
            )),
        ),
        ("own_map_larger_than_the_screen", own(light([30, 0, 6], Gate::Scale, [4, 2]))),
        (
            "own_map_smaller_perspective_constant_kt_transmits",
            own(transmits(glass(
                BlendKind::Constant,
                Hazard::Interlock,
                perspective(9, 6, Project::Pipelined, Gate::Scale),
            ))),
        ),
    ];
    list.into_iter().map(|(name, machine)| (name, checked(machine))).collect()
}

/// Five machines with DITHER: every number of bits that are left and several that are cut, screen doors with and without, narrow screens,
/// policies of DEPTH, SHADOW and channels of the user's own.
pub fn dithers() -> Vec<(&'static str, Plan)> {
    let small = quick();
    let machine = |[color, bits, kt_bits]: [u32; 3], screen_door| {
        let mut machine = small.clone();
        machine.color.bits = color;
        machine.dither = Dither { bits, screen_door };
        machine.blend.kt_bits = kt_bits;
        machine
    };
    let five = machine([8, 5, 8], ScreenDoor::No);
    let door = Machine { hazard: Hazard::Drain, ..machine([8, 0, 4], ScreenDoor::Yes) };
    let both = Machine { hazard: Hazard::Interlock, tag_bits: 3, ..machine([10, 4, 7], ScreenDoor::Yes) };
    let narrow = Machine { width: 2, height: 2, ..machine([8, 7, 5], ScreenDoor::Yes) };
    let mut shadow = with_extras(machine([12, 6, 6], ScreenDoor::Yes), [(Kind::Signed, 5)]);
    shadow.shadow =
        Shadow { light: ShadowLight::Parallel, size: 8, fraction: 8, vertex_fraction: 2, ..shadow.shadow };
    let list = [
        ("five_of_eight_bits", five),
        ("screen_door_drain", door),
        ("four_of_ten_bits_screen_door_interlock", both),
        ("seven_of_eight_bits_two_columns_and_lines", narrow),
        ("six_of_twelve_bits_screen_door_shadow_one_extra", shadow),
    ];
    list.map(|(name, machine)| (name, checked(machine))).to_vec()
}

/// Nine machines with TERM and SHADE: fast Phong and Phong, both walks, colours from tables and multiplied, one light and two, materials,
/// textures, reliefs, a light at a point, latencies; with BLEND, SHADOW, channels of the user's own, segments, textbook fill.
pub fn shades() -> Vec<(&'static str, Plan)> {
    use ShadeColour::{Multiply, Tables};
    use ShadeKind::{FastPhong, Phong};
    use Walk::{Memory, Register};
    let small = quick();
    let shade = |kind, walk, colour, [lights, material_bits, gloss_bits, latency]: [u32; 4]| {
        let short = Shade { table_bits: 8, fraction: 8, linear_fraction: 4, record_bits: 5, ..small.shade };
        let shade = Shade { kind, walk, colour, lights, material_bits, gloss_bits, ..short };
        let latencies = Shade { term_latency: latency, table_latency: latency, ..shade };
        Machine {
            shade: Shade { root_latency: latency, texel_latency: latency, ..latencies },
            ..small.clone()
        }
    };
    let textured = |bits, queue, machine: Machine| {
        let shade =
            Shade { texture: Texture::Nearest, texture_bits: bits, texel_queue: queue, ..machine.shade };
        Machine { shade, ..machine }
    };
    let relief = |slope_bits, machine: Machine| {
        let shade = Shade { bump: Bump::Yes, slope_bits, ..machine.shade };
        Machine { shade, ..machine }
    };
    let lamp = |machine: Machine| {
        let shade = Shade { light: ShadeLight::Positional, ..machine.shade };
        Machine { shade, ..machine }
    };
    let light = Shadow { light: ShadowLight::Parallel, fraction: 8, vertex_fraction: 2, ..small.shadow };
    let light = Shadow { size: 4, guard_bits: 1, depth_bits: 6, gate: Gate::Scale, ..light };
    let glass = |kind| Blend { kind, hazard: Hazard::Forward, kt_fraction: 8, kt_vertex: 2, ..small.blend };
    let all = relief(6, textured(2, 3, shade(Phong, Memory, Multiply, [1, 1, 3, 3])));
    let list = vec![
        ("fast_phong_registers_tables", shade(FastPhong, Register, Tables, [1, 2, 4, 2])),
        ("fast_phong_memory_tables_two_lights", shade(FastPhong, Memory, Tables, [2, 1, 2, 1])),
        (
            "fast_phong_memory_multiply_tags_segments",
            Machine { tag_bits: 3, segments: 2, ..shade(FastPhong, Memory, Multiply, [1, 0, 0, 3]) },
        ),
        (
            "fast_phong_registers_relief",
            relief(4, textured(3, 4, shade(FastPhong, Register, Multiply, [1, 1, 4, 2]))),
        ),
        ("phong_registers_tables", shade(Phong, Register, Tables, [1, 1, 4, 2])),
        (
            "phong_memory_multiply_two_lights_one_extra",
            with_extras(
                Machine { adders: 2, ..shade(Phong, Memory, Multiply, [2, 1, 6, 1]) },
                [(Kind::Signed, 5)],
            ),
        ),
        (
            "phong_memory_relief_shadow_interpolated_kt",
            Machine { shadow: light, blend: glass(BlendKind::Interpolated), ..all },
        ),
        (
            "textbook_fast_phong_texture_constant_kt",
            Machine {
                subpixel_bits: 0,
                fill: Fill::Textbook,
                blend: glass(BlendKind::Constant),
                ..textured(1, 1, shade(FastPhong, Register, Multiply, [2, 1, 2, 4]))
            },
        ),
        ("phong_lamp_multiply_texture", lamp(textured(2, 2, shade(Phong, Register, Multiply, [1, 1, 3, 2])))),
    ];
    list.into_iter().map(|(name, machine)| (name, checked(machine))).collect()
}

/// The results of `work` on every item, in order; two threads share them.
pub fn two_at_a_time<T: Sync, R: Send>(items: &[T], work: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let next = std::sync::atomic::AtomicUsize::new(0);
    let run = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            let Some(item) = items.get(i) else { return done };
            done.push((i, work(i, item)));
        }
    };
    let mut results: Vec<(usize, R)> = std::thread::scope(|scope| {
        let threads = [scope.spawn(run), scope.spawn(run)];
        threads
            .into_iter()
            .flat_map(|thread| thread.join().expect("the panic is the test's failure"))
            .collect()
    });
    results.sort_by_key(|(i, _)| *i);
    results.into_iter().map(|(_, result)| result).collect()
}
