//! Draws triangles with the machine's netlist in the interpreter, the rig behind its ports.

use crate::device::{NetlistDevice, PortError, Triangles, netlist};
use crate::interface::{Interface, Link};
use crate::rig::{Rig, Setting};
use crate::stalls::{StallKind, patterns};
use crate::unit::Unit;
use crate::values::{PortId, PortValues};
use crate::{UnknownConstant, case};
use edgewalk_machine::{Activity, ForeignVertex, Plan, PortVertex};
use edgewalk_model::tokens::output;
use edgewalk_model::{Counters, DrawState, Events, Frame};
use edgewalk_netlist::{BuildErrors, Simulator};

/// Why a netlist cannot draw.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// It cannot be built.
    #[error("the netlist cannot be built: {0}")]
    Build(#[from] BuildErrors),
    /// It does not have the ports of a machine.
    #[error(transparent)]
    Ports(#[from] PortError),
    /// The machine has a constant that a picture does not set.
    #[error(transparent)]
    Constant(#[from] UnknownConstant),
    /// The triangles are for another machine.
    #[error(transparent)]
    Vertex(#[from] ForeignVertex),
}

/// Draws the triangles in order, as [`edgewalk_model::render`] does.
///
/// Runs with tags of 32 bits, which change nothing but the tag ports: they name the triangle of each write. What is not
/// to be seen at the ports is 0 in the frame: lines and spans among the counters, and all events.
///
/// # Errors
/// Triangles whose vertices were made for another machine.
pub fn render_rtl(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    stalls: StallKind,
) -> Result<Frame, DrawError> {
    run(plan, &plan.tagged(), triangles, state, stalls, |_| true)
}

/// As [`render_rtl`], with the machine as it is, so that ids are the tags that it has, or none; `watch` sees the netlist in
/// every cycle, before the clock edge, and ends the run by returning false.
///
/// # Errors
/// Triangles whose vertices were made for another machine.
pub fn render_rtl_with(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    stalls: StallKind,
    watch: impl FnMut(&mut Simulator) -> bool,
) -> Result<Frame, DrawError> {
    run(plan, plan, triangles, state, stalls, watch)
}

fn run(
    plan: &Plan,
    tagged: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    stalls: StallKind,
    mut watch: impl FnMut(&mut Simulator) -> bool,
) -> Result<Frame, DrawError> {
    let interface = Interface::new(tagged, Unit::MACHINE);
    let mut device = NetlistDevice::new(&*netlist(tagged, Unit::MACHINE)?, &interface)?;
    let mut setting = Setting::willing(&interface, &case::constants(&state))?;
    setting.patterns = patterns(tagged, &interface, stalls, 0);
    let (port, mut foreign) = (Triangles::new(tagged), None);
    let tokens = triangles.into_iter().zip(0..).map_while(|(triangle, number): (_, u32)| {
        foreign = plan.accept(&triangle, number.into()).err();
        foreign.is_none().then(|| port.pack(&triangle, number))
    });
    let mut picture = Picture::new(plan, &interface, &state);
    let mut ports = interface.values();
    let mut rig = Rig::fed(&interface, setting, tokens);
    loop {
        // In the cycle in which it takes the last triangle the machine is still idle.
        let exhausted = rig.exhausted();
        rig.drive(&mut ports);
        device.settle(&mut ports);
        let more = watch(device.simulator());
        picture.see(&ports);
        device.clock();
        rig.clock(&ports);
        if !more || (exhausted && picture.is_idle(&ports)) {
            break;
        }
    }
    drop(rig);
    foreign.map_or(Ok(picture.frame(plan)), |foreign| Err(foreign.into()))
}

/// What the ports tell of every address, and of the run.
struct Picture {
    tri: Link,
    rd: Link,
    wr: Link,
    /// Places of address, enable and tag in a write, and of every channel.
    address: usize,
    enable: usize,
    tag: Option<usize>,
    channels: Vec<usize>,
    activity: PortId,
    idle: PortId,
    /// By channel and address.
    stored: Vec<Vec<u32>>,
    coverage: Vec<u32>,
    writes: Vec<u32>,
    id: Vec<i32>,
    counters: Counters,
}

impl Picture {
    /// A cleared picture: the farthest depth, the state's colour, and 0 in the user's own channels.
    fn new(plan: &Plan, interface: &Interface, state: &DrawState) -> Picture {
        let link = |name| interface.link(name).expect("a machine declares it").clone();
        let status = |name| interface.port(name).expect("a machine declares it").id;
        let (tri, rd, wr) = (link("tri"), link("rd"), link("wr"));
        let place = |field: &str| wr.place(field).expect("a write declares it");
        let words = 1 << plan.widths().address;
        let clear = |i: usize| match i {
            0 => plan.z.max() as u32,                                       // b <= 32 bits
            _ => state.clear.get(i - 1).map_or(0, |colour| *colour as u32), // b <= 16 bits
        };
        Picture {
            address: place("addr"),
            enable: place("z_en"),
            tag: wr.place("tag"),
            channels: plan.channels().iter().map(|channel| place(channel.name)).collect(),
            activity: status("activity"),
            idle: status("idle"),
            stored: (0..plan.channels().len()).map(|i| vec![clear(i); words]).collect(),
            coverage: vec![0; words],
            writes: vec![0; words],
            id: vec![-1; words],
            counters: Counters::default(),
            tri,
            rd,
            wr,
        }
    }

    fn is_idle(&self, ports: &PortValues) -> bool {
        ports.is_high(self.idle)
    }

    fn see(&mut self, ports: &PortValues) {
        let counters = &mut self.counters;
        counters.cycles += 1;
        let activity = Activity::ALL.get(ports[self.activity] as usize).copied().unwrap_or_default();
        counters.activity[activity as usize] += 1;
        counters.triangles += u64::from(self.tri.fires(ports));
        if let Some([address, ..]) = self.rd.fires(ports).then(|| self.rd.token(ports)) {
            self.coverage[*address as usize] += 1;
            counters.fragments += 1;
        }
        if self.wr.fires(ports) {
            let write = self.wr.token(ports);
            let address = write[self.address] as usize;
            for (i, (stored, place)) in self.stored.iter_mut().zip(&self.channels).enumerate() {
                // The depth, the first channel, is stored only where that is permitted.
                if i > 0 || write[self.enable] == 1 {
                    stored[address] = write[*place] as u32; // b <= 32 bits
                }
            }
            self.writes[address] += 1;
            if let Some(tag) = self.tag {
                self.id[address] = write[tag] as i32;
            }
            counters.writes += 1;
        }
    }

    fn frame(self, plan: &Plan) -> Frame {
        let x_bits = plan.widths().x;
        let pixels =
            || (0..plan.height).flat_map(|y| (0..plan.width).map(move |x| (y << x_bits | x) as usize));
        let word = |channel: usize, address: usize| self.stored[channel][address];
        let extra = plan.own_channels();
        Frame {
            z: pixels().map(|a| u64::from(word(0, a))).collect(),
            rgb: pixels().map(|a| [1, 2, 3].map(|channel| u64::from(word(channel, a)))).collect(),
            extra: extra
                .map(|(i, channel)| pixels().map(|a| output(channel, word(i, a))).collect())
                .collect(),
            coverage: pixels().map(|a| self.coverage[a]).collect(),
            writes: pixels().map(|a| self.writes[a]).collect(),
            id: pixels().map(|a| self.id[a]).collect(),
            passes: vec![self.counters.clone()],
            counters: self.counters,
            events: Events::default(),
        }
    }
}
