//! Draws triangles: the machine, its memory, and a picture at the end.

use crate::counters::Counters;
use crate::events::Events;
use crate::machine::Model;
use crate::passes::{Pass, first_of_picture};
use crate::run::{Cycle, DrawState, Rig};
use crate::tokens::{Source, for_channels, output};
use crate::waits::Waits;
use edgewalk_machine::{ForeignVertex, Plan, PortVertex, Record};
use std::borrow::Cow;

/// A picture, row by row from the top, W×H pixels, and what it took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Stored depth, b bits.
    pub z: Vec<u64>,
    /// Stored colour, b bits each.
    pub rgb: Vec<[u64; 3]>,
    /// A plane for every channel of the user's own: LSB, signed as its kind says, 0 where nothing was written.
    pub extra: Vec<Vec<i64>>,
    /// Fragments of every pixel, whatever the depth test says.
    pub coverage: Vec<u32>,
    /// Writes to every pixel.
    pub writes: Vec<u32>,
    /// Number of the triangle that wrote the pixel last, -1: none.
    pub id: Vec<i32>,
    /// With SHADOW: 0 no colour was written, 1 the last was in shadow, 2 lit. Else empty.
    pub lit: Vec<u8>,
    /// Where the lights' own passes drew maps: the words of all maps, by address.
    pub maps: Vec<Vec<u32>>,
    /// Performance counters, of all passes.
    pub counters: Counters,
    /// The same of each pass.
    pub passes: Vec<Counters>,
    /// Events of the units.
    pub events: Events,
}

/// A pixel of one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample<'a> {
    /// y·2^xb + x.
    pub addr: u32,
    /// The output of every channel, b bits; [`output`] reads one.
    pub values: &'a [u32],
    /// The triangle.
    pub source: Source,
}

/// What the memories behind TERM, TEXEL, NORMAL and SHADE hold.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Shading {
    /// The record of every triangle, culled or not, in their order; of those behind the last the memory holds nothing.
    pub records: Vec<Record>,
    /// Entries of the tables, [`Plan::table_word`] at [`Plan::table_place`]; what is not there is 0.
    pub tables: Vec<u128>,
    /// Entries of NORMAL's table, [`Plan::root_word`], 256 of them.
    pub roots: Vec<u128>,
    /// Texels, [`Plan::texel_word`] at [`Plan::texel_place`].
    pub textures: Vec<u128>,
}

/// What [`render_with`] reports, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn<'a> {
    /// A fragment's depth read fired.
    Fragment(Sample<'a>),
    /// A write fired; with BLEND that of the colour, whose depth is not told.
    Write(Sample<'a>),
}

/// Draws the triangles in order.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn render(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    waits: impl Into<Waits>,
) -> Result<Frame, ForeignVertex> {
    render_passes(plan, triangles, &[Pass::all(state)], &[], waits, &Shading::default())
}

/// As [`render`], and calls `hook` for every fragment and write.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn render_with(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    state: DrawState,
    waits: impl Into<Waits>,
    hook: impl FnMut(Drawn),
) -> Result<Frame, ForeignVertex> {
    render_passes_with(plan, triangles, &[Pass::all(state)], &[], waits, &Shading::default(), hook)
}

/// As [`render`], pass by pass; `maps`: the words of the lights' maps, by address; before the first of them nothing is hidden. On a machine with TERM and SHADE
/// it is idle for a while after as many triangles as there are records in the memory, and the next records are written.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn render_passes(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    maps: &[Vec<u32>],
    waits: impl Into<Waits>,
    shading: &Shading,
) -> Result<Frame, ForeignVertex> {
    draw_any(plan, &mut triangles.into_iter(), passes, maps, waits.into(), shading, None)
}

/// As [`render_passes`], and calls `hook` as [`render_with`] does; it sees nothing of the lights' own passes.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn render_passes_with(
    plan: &Plan,
    triangles: impl IntoIterator<Item = [PortVertex; 3]>,
    passes: &[Pass],
    maps: &[Vec<u32>],
    waits: impl Into<Waits>,
    shading: &Shading,
    mut hook: impl FnMut(Drawn),
) -> Result<Frame, ForeignVertex> {
    draw_any(plan, &mut triangles.into_iter(), passes, maps, waits.into(), shading, Some(&mut hook))
}

/// Triangles from anywhere, so that the machine is compiled here and not with every iterator and hook there is.
type Triangles<'a> = &'a mut dyn Iterator<Item = [PortVertex; 3]>;

/// Without a hook by a machine of its own: one that may be anything costs a fifth of the speed.
fn draw_any(
    plan: &Plan,
    triangles: Triangles,
    passes: &[Pass],
    maps: &[Vec<u32>],
    waits: Waits,
    shading: &Shading,
    hook: Option<&mut dyn FnMut(Drawn)>,
) -> Result<Frame, ForeignVertex> {
    for_channels!(plan, C => match hook {
        None => draw::<C>(plan, triangles, passes, maps, waits, shading, |_| {}),
        Some(hook) => draw::<C>(plan, triangles, passes, maps, waits, shading, hook),
    })
}

fn draw<const C: usize>(
    plan: &Plan,
    triangles: Triangles,
    passes: &[Pass],
    maps: &[Vec<u32>],
    waits: Waits,
    shading: &Shading,
    mut hook: impl FnMut(Drawn),
) -> Result<Frame, ForeignVertex> {
    let state = first_of_picture(passes);
    let mut rig = Rig::<C>::new(plan, state, waits);
    let mut counters: Vec<Counters> = Vec::new();
    let mut tally = Tally::new(plan);
    let blends = plan.blend.is_there();
    let channels = plan.channels().len().min(C); // C serves the plan; said so that no slice is checked in every cycle
    let mut triangles = triangles.zip(0..).map(|(t, number)| plan.accept(&t, number).map(|()| t)).peekable();
    rig.memories.write_shading(plan, shading);
    let mut records = shading.records.iter().enumerate();
    let at_once = if plan.shade.is_there() { 1 << plan.shade.record_bits } else { usize::MAX };
    let mut maps: Vec<Cow<[u32]>> = maps.iter().map(Cow::from).collect();
    let draws_maps = passes.iter().any(|pass| pass.state.light_pass);
    let mut watch = |light_pass: bool, model: &Model<C>, cycle: &Cycle<C>| {
        if light_pass {
            return;
        }
        if let Some(addr) = cycle.read {
            tally.read(addr);
            let fragment = model.last_read();
            let values = &fragment.values[..channels];
            hook(Drawn::Fragment(Sample { addr, values, source: fragment.source }));
        }
        if let Some(write) = cycle.write().filter(|_| !blends) {
            tally.write(write.addr, write.source.id, write.lit);
            let values = &write.values[..channels];
            hook(Drawn::Write(Sample { addr: write.addr, values, source: write.source }));
        }
        if let Some(write) = cycle.color_write() {
            tally.write(write.addr, write.source.id, write.lit);
            let values = &write.values[..channels];
            hook(Drawn::Write(Sample { addr: write.addr, values, source: write.source }));
        }
    };
    for pass in passes {
        let before = rig.model.counters().clone();
        rig.memories.set_state(pass.state);
        if pass.clear_depth {
            rig.memories.clear_depth(plan);
        }
        if let Some(map) = pass.map.and_then(|map| maps.get(map)) {
            rig.memories.write("map", 0, map.iter().map(|word| u128::from(*word)));
        }
        let mut left = pass.triangles;
        loop {
            let part = left.min(at_once);
            for (triangle, record) in records.by_ref().take(part) {
                rig.memories.write_record(plan, triangle, record);
            }
            let light_pass = pass.state.light_pass;
            rig.draw(triangles.by_ref().take(part), |_, model, cycle| watch(light_pass, model, cycle))?;
            left -= part;
            if left == 0 || triangles.peek().is_none() {
                break;
            }
        }
        counters.push(rig.model.counters().since(&before));
        if let Some(map) = pass.map.filter(|_| pass.state.light_pass) {
            maps.resize(maps.len().max(map + 1), Cow::default());
            maps[map] = rig.memories.drawn_map(plan).into();
        }
    }
    rig.memories.set_state(state);
    let x_bits = plan.widths().x;
    let addresses: Vec<usize> =
        (0..plan.height).flat_map(|y| (0..plan.width).map(move |x| (y << x_bits | x) as usize)).collect();
    let stored = || addresses.iter().map(|addr| rig.memories.pixel(*addr as u32));
    let extra = plan.own_channels();
    Ok(Frame {
        z: stored().map(|values| u64::from(values[0])).collect(),
        rgb: stored().map(|values| [1, 2, 3].map(|i| u64::from(values[i]))).collect(),
        extra: extra
            .map(|(i, channel)| stored().map(|values| output(channel, values[i])).collect())
            .collect(),
        coverage: addresses.iter().map(|addr| tally.reads[*addr]).collect(),
        writes: addresses.iter().map(|addr| tally.writes[*addr]).collect(),
        id: addresses.iter().map(|addr| tally.id[*addr]).collect(),
        lit: match plan.shadow.is_there() {
            true => addresses.iter().map(|addr| tally.lit[*addr]).collect(),
            false => Vec::new(),
        },
        maps: if draws_maps { maps.into_iter().map(Cow::into_owned).collect() } else { Vec::new() },
        counters: rig.model.counters().clone(),
        passes: counters,
        events: rig.model.events().clone(),
    })
}

/// What happened at every address.
struct Tally {
    reads: Vec<u32>,
    writes: Vec<u32>,
    /// Number of the triangle that wrote it last, -1: none.
    id: Vec<i32>,
    /// 0 never written, 1 in shadow, 2 lit.
    lit: Vec<u8>,
}

impl Tally {
    fn new(plan: &Plan) -> Self {
        let words = 1 << plan.widths().address;
        Tally { reads: vec![0; words], writes: vec![0; words], id: vec![-1; words], lit: vec![0; words] }
    }

    fn read(&mut self, addr: u32) {
        let reads = &mut self.reads[addr as usize];
        *reads = reads.wrapping_add(1);
    }

    fn write(&mut self, addr: u32, id: u32, lit: bool) {
        let writes = &mut self.writes[addr as usize];
        *writes = writes.wrapping_add(1);
        self.id[addr as usize] = id as i32;
        self.lit[addr as usize] = 1 + u8::from(lit);
    }
}
