//! Draws triangles with the machine's netlist, in the interpreter or whatever else runs it, the rig behind its ports.

use crate::device::{Device, NetlistDevice, PortError, Triangles, netlist};
use crate::interface::{Interface, Link};
use crate::rig::{Rig, Setting};
use crate::stalls::{StallKind, patterns};
use crate::unit::Unit;
use crate::values::{PortId, PortValues};
use crate::{Token, UnknownConstant};
use edgewalk_machine::{
    Activity, DrawState, Events, ForeignVertex, Maps, Pass, Plan, PortVertex, Role, Shading, Step,
    first_of_picture, steps,
};
use edgewalk_model::tokens::output;
use edgewalk_model::{Counters, Frame};
use edgewalk_netlist::{BuildErrors, Simulator};
use std::sync::Arc;

/// Why a netlist cannot draw.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// The netlist cannot be built.
    #[error("the netlist cannot be built")]
    Build(#[from] BuildErrors),
    /// The netlist does not have the ports of a machine.
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
    render_rtl_passes(plan, triangles, &[Pass::all(state)], &[], stalls, &Shading::default())
}

/// As [`render_rtl`], pass by pass, as [`edgewalk_model::render_passes`] does; `maps`: the words of the lights' maps. With TERM and SHADE,
/// after as many triangles as there are records in the memory, the machine is idle for a while, and the next records are written.
///
/// # Errors
/// Triangles whose vertices were made for another machine.
pub fn render_rtl_passes(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    maps: &[Vec<u32>],
    stalls: StallKind,
    shading: &Shading,
) -> Result<Frame, DrawError> {
    render_on(&mut tagged_netlist(plan)?, plan, triangles, passes, maps, stalls, shading)
}

/// Draws the triangles by one state, as [`render_rtl`] does; gives the counters and no picture, which on a large screen takes much memory.
///
/// # Errors
/// Triangles whose vertices were made for another machine.
pub fn tick_rtl(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    shading: &Shading,
) -> Result<Counters, DrawError> {
    let mut device = tagged_netlist(plan)?;
    let passes = [Pass::all(state)];
    let drawn = run(plan, &plan.tagged(), triangles, &passes, (&[], shading), StallKind::None, |ports| {
        device.cycle(ports);
        true
    })?;
    Ok(drawn.counters())
}

/// The netlist of the machine with tags of 32 bits, in the interpreter.
fn tagged_netlist(plan: &Plan) -> Result<NetlistDevice, DrawError> {
    let tagged = plan.tagged();
    let (netlist, interface) = (netlist(&tagged, Unit::MACHINE)?, Interface::new(&tagged, Unit::MACHINE));
    Ok(NetlistDevice::new(&netlist, &interface)?)
}

/// As [`render_rtl_passes`], by a device that has just been reset and has the ports of the machine with tags of 32 bits,
/// [`Plan::tagged`]; the outputs inside are not asked for.
///
/// # Errors
/// Triangles whose vertices were made for another machine.
pub fn render_on(
    device: &mut impl Device,
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    maps: &[Vec<u32>],
    stalls: StallKind,
    shading: &Shading,
) -> Result<Frame, DrawError> {
    let drawn = run(plan, &plan.tagged(), triangles, passes, (maps, shading), stalls, |ports| {
        device.cycle(ports);
        true
    })?;
    Ok(drawn.frame(plan, passes))
}

/// Runs the machine as it is, without other tags, as [`render_rtl_passes`] does; gives the counters and no picture, which on a large
/// screen takes much memory. `watch` sees the netlist in every cycle, before the clock edge, and ends the run by returning false.
///
/// # Errors
/// Triangles whose vertices were made for another machine.
pub fn render_rtl_with(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    shading: &Shading,
    mut watch: impl FnMut(&mut Simulator) -> bool,
) -> Result<Counters, DrawError> {
    let mut device =
        NetlistDevice::new(&*netlist(plan, Unit::MACHINE)?, &Interface::new(plan, Unit::MACHINE))?;
    let drawn = run(plan, plan, triangles, passes, (&[], shading), StallKind::None, |ports| {
        device.settle(ports);
        let more = watch(device.simulator());
        device.clock();
        more
    })?;
    Ok(drawn.counters())
}

/// What a run leaves: the memories, and the counters of each pass.
struct Run<'a> {
    picture: Picture,
    maps: Maps<'a>,
    spent: Vec<Counters>,
}

impl Run<'_> {
    /// Of all passes.
    fn counters(&self) -> Counters {
        self.spent.iter().fold(Counters::default(), |sum, pass| sum.and(pass))
    }

    fn frame(self, plan: &Plan, passes: &[Pass]) -> Frame {
        let counters = self.counters();
        Frame { maps: self.maps.drawn_by(passes), counters, passes: self.spent, ..self.picture.frame(plan) }
    }
}

/// `cycle`: a clock of the device, which gives the outputs before the edge; false if enough was seen.
fn run<'a>(
    plan: &Plan,
    tagged: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    (maps, shading): (&'a [Vec<u32>], &Shading),
    stalls: StallKind,
    mut cycle: impl FnMut(&mut PortValues) -> bool,
) -> Result<Run<'a>, DrawError> {
    let interface = Interface::new(tagged, Unit::MACHINE);
    let (port, mut foreign) = (Triangles::new(tagged), None);
    // The tag is what a picture calls the id: edges of a polygon have that of the token that ends it.
    let mut id = 0;
    let mut tokens = triangles.into_iter().zip(0..).map_while(|(triangle, number): (_, u32)| {
        foreign = plan.accept(&triangle, number.into()).err();
        let tag = id;
        id += u32::from(Role::of(&triangle).ends());
        foreign.is_none().then(|| port.pack(&triangle, tag))
    });
    let mut picture = Picture::new(plan, &interface, plan.z.max(), first_of_picture(passes).clear);
    // In a machine that draws its map what the same ports reach then.
    let farthest = u64::MAX >> (64 - plan.shadow.depth_bits);
    let all = [plan.color.max(); 3];
    let mut own_map = plan.shadow.draws_map().then(|| Picture::new(plan, &interface, farthest, all));
    let mut ports = interface.values();
    let (mut maps, mut map): (_, Arc<[u128]>) = (Maps::of_host(maps), Arc::default());
    let mut terms: Vec<u128> = Vec::new();
    let (mut state, mut spent): (_, Vec<Counters>) = (DrawState::default(), Vec::new());
    for step in steps(plan, passes, shading) {
        let page = own_map.as_mut().filter(|_| state.light_pass).unwrap_or(&mut picture);
        match step {
            Step::State(next) => {
                state = next;
                spent.push(Counters::default());
            }
            Step::ClearDepth => page.clear(0),
            Step::ClearMap => (0..4).for_each(|channel| page.clear(channel)),
            Step::LoadMap(number) => {
                if let Some(words) = maps.words(number) {
                    map = words.iter().map(|word| u128::from(*word)).collect();
                }
            }
            Step::Record(triangle, record) => {
                let words = plan.record_words(record);
                let place = (triangle % (1 << plan.shade.record_bits)) << plan.record_place_bits();
                terms.resize(terms.len().max(place + words.len()), 0);
                terms[place..][..words.len()].iter_mut().zip(words).for_each(|(to, word)| *to = word.into());
            }
            Step::Draw(count) => {
                // The memories are as the host and the triangles before have left them.
                let mut setting = Setting::willing(&interface, &state.constants())?;
                for (memory, setting) in interface.memories.iter().zip(&mut setting.memories) {
                    let filled_by_host = match memory.name {
                        "terms" => Some(&terms),
                        "tables" => Some(&shading.tables),
                        "roots" => Some(&shading.roots),
                        "textures" => Some(&shading.textures),
                        _ => None,
                    };
                    setting.clear = match (filled_by_host, memory.name) {
                        (Some(_), _) => 0,
                        (None, "map") => setting.clear,
                        (None, "color") => page.color(plan, |channel| page.cleared[channel]),
                        (None, _) => page.cleared[0].into(),
                    };
                    setting.start = match (filled_by_host, memory.name) {
                        (Some(words), _) => words.as_slice().into(),
                        (None, "map") => Arc::clone(&map),
                        // It is as it was cleared.
                        (None, _) if !page.written => Arc::default(),
                        (None, "color") => page.colors(plan),
                        (None, _) => page.stored[0].iter().map(|word| u128::from(*word)).collect(),
                    };
                }
                setting.patterns = patterns(tagged, &interface, stalls, 0);
                let rig = Rig::fed(&interface, setting, tokens.by_ref().take(count));
                let before = page.counters.clone();
                let more = draw_part(rig, page, &mut ports, &mut cycle);
                let part = page.counters.since(&before);
                spent.last_mut().into_iter().for_each(|pass| *pass = pass.and(&part));
                if !more {
                    break;
                }
            }
            Step::StoreMap(number) => maps.keep(number, page.map(plan)),
        }
    }
    drop(tokens);
    foreign.map_or(Ok(Run { picture, maps, spent }), |foreign| Err(foreign.into()))
}

/// Until all its triangles are drawn; false if enough was seen before.
fn draw_part(
    mut rig: Rig<impl Iterator<Item = Token>>,
    picture: &mut Picture,
    ports: &mut PortValues,
    cycle: &mut impl FnMut(&mut PortValues) -> bool,
) -> bool {
    loop {
        // In the cycle in which it takes the last triangle the machine is still idle.
        let exhausted = rig.exhausted();
        rig.drive(ports);
        let more = cycle(ports);
        picture.see(ports);
        rig.clock(ports);
        if !more || (exhausted && picture.is_idle(ports)) {
            return more;
        }
    }
}

/// What the ports tell of every address, and of the run.
struct Picture {
    triangles: Link,
    /// Words taken of the triangle that comes, where it comes word by word.
    words: usize,
    rd: Link,
    /// The write of the pixel; with BLEND that of its colours, and the depth has its own.
    write: Writes,
    depth_write: Option<Writes>,
    /// With BLEND the reads of colours.
    crd: Option<Link>,
    /// Reads of the memories that the host alone writes.
    word_reads: Vec<Link>,
    tag: Option<usize>,
    /// With SHADOW the field of the write that says whether it is lit.
    lit_field: Option<usize>,
    activity: PortId,
    idle: PortId,
    /// By channel and address.
    stored: Vec<Vec<u32>>,
    coverage: Vec<u32>,
    writes: Vec<u32>,
    id: Vec<i32>,
    /// 0 never written, 1 in shadow, 2 lit.
    lit: Vec<u8>,
    counters: Counters,
    /// To what each channel is cleared.
    cleared: Vec<u32>,
    /// Something was stored.
    written: bool,
}

/// A link that writes, and what of it is stored where.
struct Writes {
    link: Link,
    address: usize,
    stored: Vec<Stored>,
}

/// Bits of a field, for a channel.
struct Stored {
    channel: usize,
    field: usize,
    low: u32,
    bits: u32,
    /// The field that permits it.
    enable: Option<usize>,
}

impl Writes {
    /// Every field of a channel; of a word of colours, each of them.
    fn new(plan: &Plan, link: Link) -> Writes {
        let place = |field: &str| link.place(field);
        let mut stored = Vec::new();
        for (channel, declared) in plan.channels().iter().enumerate() {
            let enable = if channel == 0 { place("z_en") } else { None };
            let bits = declared.bits;
            if let Some(field) = place(declared.name) {
                stored.push(Stored { channel, field, low: 0, bits, enable });
            } else if let (1..=3, Some(field)) = (channel, place("rgb")) {
                stored.push(Stored { channel, field, low: (3 - channel as u32) * bits, bits, enable });
            }
        }
        Writes { address: place("addr").expect("a write declares it"), stored, link }
    }

    /// A depth is written in this cycle.
    fn stores_depth(&self, ports: &PortValues) -> bool {
        let mut depths = self.stored.iter().filter(|stored| stored.channel == 0);
        self.link.fires(ports)
            && depths.any(|stored| stored.enable.is_none_or(|enable| self.link.token(ports)[enable] == 1))
    }

    /// Stores what is written in this cycle; where.
    fn store(&self, ports: &PortValues, memory: &mut [Vec<u32>]) -> Option<usize> {
        let write = self.link.fires(ports).then(|| self.link.token(ports))?;
        let address = write[self.address] as usize;
        for Stored { channel, field, low, bits, enable } in &self.stored {
            if enable.is_none_or(|enable| write[enable] == 1) {
                memory[*channel][address] = (write[*field] >> low & (u128::MAX >> (128 - bits))) as u32; // b <= 32
            }
        }
        Some(address)
    }
}

impl Picture {
    /// A cleared picture: this depth and colour, and 0 in the user's own channels.
    fn new(plan: &Plan, interface: &Interface, farthest: u64, color: [u64; 3]) -> Picture {
        let find = |name| interface.link(name).cloned();
        let link = |name| find(name).expect("a machine declares it");
        let status = |name| interface.port(name).expect("a machine declares it").id;
        let write = find("cwr").unwrap_or_else(|| link("wr"));
        let words = 1 << plan.widths().address;
        let clear = |i: usize| match i {
            0 => farthest as u32,                                     // b <= 32 bits
            _ => color.get(i - 1).map_or(0, |colour| *colour as u32), // b <= 16 bits
        };
        let cleared: Vec<u32> = (0..plan.channels().len()).map(clear).collect();
        Picture {
            triangles: interface.links.first().cloned().expect("a machine takes triangles"),
            words: 0,
            rd: link("rd"),
            tag: write.place("tag"),
            lit_field: write.place("lit"),
            write: Writes::new(plan, write),
            depth_write: find("zwr").map(|link| Writes::new(plan, link)),
            crd: find("crd"),
            word_reads: plan.word_memories().iter().map(|(_, memory)| link(memory.read.name)).collect(),
            activity: status("activity"),
            idle: status("idle"),
            stored: cleared.iter().map(|word| vec![*word; words]).collect(),
            coverage: vec![0; words],
            writes: vec![0; words],
            id: vec![-1; words],
            lit: vec![0; words],
            counters: Counters::default(),
            cleared,
            written: false,
        }
    }

    fn clear(&mut self, channel: usize) {
        self.stored[channel].fill(self.cleared[channel]);
    }

    /// The words of the map that this is, by address.
    fn map(&self, plan: &Plan) -> Vec<u32> {
        let texels = self.stored[0].iter().zip(&self.stored[1]).take(1 << (2 * plan.shadow.side_bits()));
        let word = |(depth, left): (&u32, &u32)| match plan.shadow.transmits() {
            true => depth << plan.color.bits | left,
            false => *depth,
        };
        texels.map(word).collect()
    }

    /// The words of the colour memory: red is the most significant.
    fn colors(&self, plan: &Plan) -> Arc<[u128]> {
        let words = 0..self.stored[0].len();
        words.map(|address| self.color(plan, |channel| self.stored[channel][address])).collect()
    }

    /// A word of the colour memory.
    fn color(&self, plan: &Plan, channel: impl Fn(usize) -> u32) -> u128 {
        (1..=3).fold(0, |word, place| word << plan.color.bits | u128::from(channel(place)))
    }

    fn is_idle(&self, ports: &PortValues) -> bool {
        ports.is_high(self.idle)
    }

    fn see(&mut self, ports: &PortValues) {
        let counters = &mut self.counters;
        counters.cycles += 1;
        let activity = Activity::ALL.get(ports[self.activity] as usize).copied().unwrap_or_default();
        counters.activity[activity as usize] += 1;
        if self.triangles.fires(ports) {
            self.words += 1;
            if self.words >= self.triangles.words.len() {
                self.words = 0;
                counters.triangles += 1;
            }
        }
        if let Some([address, ..]) = self.rd.fires(ports).then(|| self.rd.token(ports)) {
            self.coverage[*address as usize] += 1;
            counters.fragments += 1;
        }
        counters.color_reads += u64::from(self.crd.as_ref().is_some_and(|link| link.fires(ports)));
        for (reads, link) in counters.word_reads.iter_mut().zip(&self.word_reads) {
            *reads += u64::from(link.fires(ports));
        }
        let depths = self.depth_write.as_ref().unwrap_or(&self.write);
        counters.depth_writes += u64::from(depths.stores_depth(ports));
        if let Some(depths) = &self.depth_write {
            self.written |= depths.store(ports, &mut self.stored).is_some();
        }
        if let Some(address) = self.write.store(ports, &mut self.stored) {
            self.written = true;
            self.writes[address] += 1;
            if let Some(tag) = self.tag {
                self.id[address] = self.write.link.token(ports)[tag] as i32;
            }
            if let Some(lit) = self.lit_field {
                self.lit[address] = 1 + self.write.link.token(ports)[lit] as u8; // a bit
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
            lit: match plan.shadow.is_there() {
                true => pixels().map(|a| self.lit[a]).collect(),
                false => Vec::new(),
            },
            maps: Vec::new(),
            passes: Vec::new(),
            counters: self.counters,
            events: Events::default(),
        }
    }
}
