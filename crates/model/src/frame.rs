//! Draws triangles: the machine, its memory, and a picture at the end.

use crate::Events;
use crate::counters::Counters;
use crate::io::Cycle;
use crate::machine::Model;
use crate::run::Rig;
use crate::tokens::{Source, for_channels, output};
use crate::waits::Waits;
use edgewalk_machine::{
    DrawState, ForeignVertex, Maps, Pass, Plan, PortVertex, Shading, Step, first_of_picture, steps,
};

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
    /// Like `counters`, of each pass.
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
    let mut tally = Tally::new(plan);
    let blends = plan.blend.is_there();
    let channels = plan.channels().len().min(C); // C serves the plan; said so that no slice is checked in every cycle
    let mut triangles = triangles.zip(0..).map(|(t, number)| plan.accept(&t, number).map(|()| t));
    rig.memories.write_shading(plan, shading);
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
    let (mut maps, mut light_pass) = (Maps::of_host(maps), false);
    let (mut before, mut spent): (_, Vec<Counters>) = (Counters::default(), Vec::new());
    for step in steps(plan, passes, shading) {
        if let Step::State(state) = step {
            light_pass = state.light_pass;
            before = rig.counters();
            spent.push(Counters::default());
        }
        if let Some(count) = rig.memories.take_step(plan, step, &mut maps) {
            rig.draw(triangles.by_ref().take(count), |_, model, cycle| watch(light_pass, model, cycle))?;
            let pass = rig.counters().since(&before);
            spent.last_mut().into_iter().for_each(|last| last.clone_from(&pass));
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
        maps: maps.drawn_by(passes),
        counters: rig.counters(),
        passes: spent,
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
