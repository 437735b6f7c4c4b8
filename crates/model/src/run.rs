//! The machine and its memory in one: cycle by cycle, or until all triangles are drawn.
//!
//! ```text
//!  triangles ─> Model ─rd, wr─> Memory, with BLEND also ─crd, cwr─> ColorMemory
//!                  ^────data──────┘                ^─────cdata──────────┘
//! ```

use crate::color_memory::ColorMemory;
use crate::machine::{
    BlendInputs, Inputs, Model, NormalInputs, Outputs, ShadeInputs, ShadowInputs, TermInputs, TexelInputs,
};
use crate::map_memory::MapMemory;
use crate::memory::Memory;
use crate::tokens::{ColorWrite, FEW, OutputWords, Write};
use crate::waits::Waits;
use crate::word_memory::WordMemory;
use edgewalk_machine::{DrawState, Plan, PortVertex, Record, Shading};

/// A machine with its memory.
#[derive(Clone, Debug)]
pub struct Rig<const C: usize> {
    /// The machine.
    pub model: Model<C>,
    /// Its memory; with BLEND that of the depths.
    pub memory: Memory<C>,
    /// With TERM the records of the terms.
    pub terms: Option<WordMemory>,
    /// With TEXEL the materials' textures.
    pub textures: Option<WordMemory>,
    /// With NORMAL or LAMP its roots.
    pub roots: Option<WordMemory>,
    /// With SHADE the materials' tables.
    pub tables: Option<WordMemory>,
    /// With SHADOW the light's map.
    pub map: Option<MapMemory>,
    /// With BLEND that of the colours.
    pub color: Option<ColorMemory<C>>,
    /// In a machine that draws its map: the memories of the other page, the map's while the picture is drawn.
    other: Option<Box<Page<C>>>,
    state: DrawState,
}

/// What the ports of DEPTH and BLEND reach in a pass.
#[derive(Clone, Debug)]
struct Page<const C: usize> {
    memory: Memory<C>,
    color: Option<ColorMemory<C>>,
}

/// What happened in a cycle of a [`Rig`].
#[derive(Clone, Copy, Debug)]
pub struct Cycle<const C: usize> {
    /// The ports of the machine.
    pub outputs: Outputs<C>,
    /// A triangle was taken.
    pub triangle: bool,
    /// The address whose read fired; [`Model::last_read`] is its fragment.
    pub read: Option<u32>,
    /// The write of `outputs` fired.
    pub written: bool,
    /// The colour write of `outputs` fired.
    pub color_written: bool,
}

impl<const C: usize> Cycle<C> {
    /// The write that fired.
    #[inline(always)]
    #[must_use]
    pub fn write(&self) -> Option<&Write<C>> {
        self.outputs.wr.as_ref().filter(|_| self.written)
    }

    /// The colour write that fired, with BLEND.
    #[inline(always)]
    #[must_use]
    pub fn color_write(&self) -> Option<&ColorWrite<C>> {
        self.outputs.blend.cwr.as_ref().filter(|_| C > FEW && self.color_written)
    }
}

impl<const C: usize> Rig<C> {
    /// A machine after reset, its memory cleared.
    #[must_use]
    pub fn new(plan: &Plan, state: DrawState, waits: impl Into<Waits>) -> Self {
        let waits = waits.into();
        let color = |clear| plan.blend.is_there().then(|| ColorMemory::new(plan, clear, waits));
        let mut rig = Rig {
            model: Model::new(plan),
            memory: Memory::new(plan, state.clear, waits),
            terms: plan.shade.is_there().then(|| WordMemory::new(plan.shade.term_latency, waits, 3)),
            textures: plan.shade.textures().then(|| WordMemory::new(plan.shade.texel_latency, waits, 6)),
            roots: plan.shade.normalises().then(|| WordMemory::new(plan.shade.root_latency, waits, 5)),
            tables: plan.shade.is_there().then(|| WordMemory::new(plan.shade.table_latency, waits, 4)),
            map: plan.shadow.is_there().then(|| MapMemory::new(plan, waits)),
            color: color(state.clear),
            other: plan.shadow.draws_map().then(|| {
                let mut memory = Memory::new(plan, [0; 3], waits);
                memory.clear_map(plan);
                Box::new(Page { memory, color: color([plan.color.max(); 3]) })
            }),
            state: DrawState { light_pass: false, ..state },
        };
        rig.set_state(state);
        rig
    }

    /// Writes tables, roots, textures, and the records of the first triangles, as many as the memory holds; the machine is idle.
    pub fn write_shading(&mut self, plan: &Plan, shading: &Shading) {
        if let Some(tables) = &mut self.tables {
            tables.write(0, shading.tables.iter().copied());
        }
        if let Some(textures) = &mut self.textures {
            textures.write(0, shading.textures.iter().copied());
        }
        if let Some(roots) = &mut self.roots {
            roots.write(0, shading.roots.iter().copied());
        }
        let records = shading.records.iter().enumerate().take(1 << plan.shade.record_bits);
        for (triangle, record) in records {
            self.write_record(plan, triangle, record);
        }
    }

    /// Writes the record of the triangle with this number, counted from 0; the machine is idle.
    pub fn write_record(&mut self, plan: &Plan, triangle: usize, record: &Record) {
        let place = triangle % (1 << plan.shade.record_bits);
        if let Some(terms) = &mut self.terms {
            let words = plan.record_words(record).into_iter().map(u128::from);
            terms.write(place << plan.record_place_bits(), words);
        }
    }

    /// Clears the map that is drawn now, with what is left of the light; the machine is idle.
    pub(crate) fn clear_map(&mut self, plan: &Plan) {
        self.memory.clear_map(plan);
        if let Some(color) = &mut self.color {
            color.clear([plan.color.max(); 3]);
        }
    }

    /// The words of the map that is drawn now, by address: depth, and with `shadow.transmits` below it what is left of the light.
    #[must_use]
    pub fn drawn_map(&self, plan: &Plan) -> Vec<u32> {
        let word = |addr| {
            let [depth, left, ..] = self.pixel(addr)[..] else { return 0 };
            if plan.shadow.transmits() { depth << plan.color.bits | left } else { depth }
        };
        (0..1 << (2 * plan.shadow.side_bits())).map(word).collect()
    }

    /// What is stored at an address of what is drawn now.
    #[must_use]
    pub fn pixel(&self, addr: u32) -> OutputWords<C> {
        let stored = self.memory.pixel(addr);
        self.color.as_ref().map_or(stored, |color| color.pixel(addr, stored[0]))
    }

    /// What the next triangles are drawn with; the machine is idle.
    pub fn set_state(&mut self, state: DrawState) {
        if let Some(other) = self.other.as_mut().filter(|_| state.light_pass != self.state.light_pass) {
            std::mem::swap(&mut self.memory, &mut other.memory);
            std::mem::swap(&mut self.color, &mut other.color);
        }
        self.state = state;
    }

    /// The machine's inputs in a cycle, with a triangle and its tag offered or none.
    #[inline(always)]
    #[must_use]
    pub fn inputs<'a>(&self, tri: Option<(&'a [PortVertex; 3], u32)>, writes_open: bool) -> Inputs<'a> {
        Inputs {
            rst: false,
            tri,
            depth_func: self.state.depth_func,
            depth_write: self.state.depth_write,
            rd_ready: self.memory.rd_ready(),
            data: self.memory.data(),
            wr_ready: self.memory.wr_ready() && writes_open,
            term: self.term_inputs(),
            texel: self.texel_inputs(),
            normal: self.normal_inputs(),
            shade: self.shade_inputs(),
            shadow: self.shadow_inputs(),
            blend: self.blend_inputs(writes_open),
        }
    }

    /// One cycle, with a triangle and its tag offered or none. The memories take writes if they are ready and `writes_open`.
    #[inline(always)]
    pub fn cycle(&mut self, tri: Option<(&[PortVertex; 3], u32)>, writes_open: bool) -> Cycle<C> {
        let inputs = self.inputs(tri, writes_open);
        let memory = &self.memory;
        let outputs =
            self.model.cycle_and_tell(&inputs, |line| memory.expect(line.y, [line.major, line.minor]));
        let cycle = Cycle {
            outputs,
            triangle: outputs.tri_ready && tri.is_some(),
            read: outputs.rd.filter(|_| inputs.rd_ready),
            written: outputs.wr.is_some() && inputs.wr_ready,
            color_written: outputs.blend.cwr.is_some() && inputs.blend.cwr_ready,
        };
        if let Some(terms) = self.terms.as_mut().filter(|_| C > FEW) {
            let read = outputs.trd.filter(|_| inputs.term.trd_ready);
            terms.step(read, inputs.term.tdata.is_some() && outputs.tdata_ready);
        }
        if let Some(textures) = self.textures.as_mut().filter(|_| C > FEW) {
            let read = outputs.xrd.filter(|_| inputs.texel.xrd_ready);
            textures.step(read, inputs.texel.xdata.is_some() && outputs.xdata_ready);
        }
        if let Some(roots) = self.roots.as_mut().filter(|_| C > FEW) {
            let read = outputs.rrd.filter(|_| inputs.normal.rrd_ready);
            roots.step(read, inputs.normal.rdata.is_some() && outputs.rdata_ready);
        }
        if let Some(tables) = self.tables.as_mut().filter(|_| C > FEW) {
            let read = outputs.srd.filter(|_| inputs.shade.srd_ready);
            tables.step(read, inputs.shade.sdata.is_some() && outputs.sdata_ready);
        }
        if let Some(map) = self.map.as_mut().filter(|_| C > FEW) {
            let read = outputs.mrd.filter(|_| inputs.shadow.mrd_ready);
            map.step(read, inputs.shadow.mdata.is_some() && outputs.mdata_ready);
        }
        let data_taken = inputs.data.is_some() && outputs.data_ready;
        match &mut self.color {
            Some(color) if C > FEW => {
                self.memory.step_depth(cycle.read, data_taken, cycle.write());
                let read = outputs.blend.crd.filter(|_| inputs.blend.crd_ready);
                let taken = inputs.blend.cdata.is_some() && outputs.blend.cdata_ready;
                color.step(read, taken, cycle.color_write());
            }
            _ => self.memory.step(cycle.read, data_taken, cycle.write()),
        }
        cycle
    }

    #[inline(always)]
    fn term_inputs(&self) -> TermInputs {
        let Some(terms) = self.terms.as_ref().filter(|_| C > FEW) else { return TermInputs::default() };
        TermInputs { trd_ready: terms.read_ready(), tdata: terms.data().map(|word| word as u64) }
    }

    #[inline(always)]
    fn texel_inputs(&self) -> TexelInputs {
        let Some(textures) = self.textures.as_ref().filter(|_| C > FEW) else {
            return TexelInputs::default();
        };
        TexelInputs { xrd_ready: textures.read_ready(), xdata: textures.data() }
    }

    #[inline(always)]
    fn normal_inputs(&self) -> NormalInputs {
        let Some(roots) = self.roots.as_ref().filter(|_| C > FEW) else { return NormalInputs::default() };
        NormalInputs { rrd_ready: roots.read_ready(), rdata: roots.data() }
    }

    #[inline(always)]
    fn shade_inputs(&self) -> ShadeInputs {
        let Some(tables) = self.tables.as_ref().filter(|_| C > FEW) else { return ShadeInputs::default() };
        ShadeInputs { srd_ready: tables.read_ready(), sdata: tables.data() }
    }

    #[inline(always)]
    fn shadow_inputs(&self) -> ShadowInputs {
        let Some(map) = self.map.as_ref().filter(|_| C > FEW) else { return ShadowInputs::default() };
        ShadowInputs {
            on: self.state.shadow_on,
            light_pass: self.state.light_pass,
            ambient: self.state.ambient as u32, // b <= 16 bits
            mrd_ready: map.mrd_ready(),
            mdata: map.mdata(),
        }
    }

    #[inline(always)]
    fn blend_inputs(&self, writes_open: bool) -> BlendInputs {
        let Some(color) = self.color.as_ref().filter(|_| C > FEW) else { return BlendInputs::default() };
        BlendInputs {
            color_write: self.state.color_write,
            add: self.state.blend_add,
            crd_ready: color.crd_ready(),
            cdata: color.cdata(),
            cwr_ready: color.cwr_ready() && writes_open,
        }
    }

    /// Offers the triangles one after the other, each as soon as the one before is taken, until the machine is idle again.
    /// `watch` sees the number of every cycle from 0, the machine behind it, and what happened.
    ///
    /// # Errors
    /// The first that `triangles` gives in place of one; the machine is left as it stands.
    #[inline(always)]
    pub fn draw<E>(
        &mut self,
        mut triangles: impl Iterator<Item = Result<[PortVertex; 3], E>>,
        mut watch: impl FnMut(u64, &Model<C>, &Cycle<C>),
    ) -> Result<(), E> {
        let mut next = triangles.next().transpose()?;
        let mut now = 0u64;
        loop {
            let cycle = self.cycle(next.as_ref().map(|triangle| (triangle, 0)), true);
            watch(now, &self.model, &cycle);
            now = now.wrapping_add(1);
            if cycle.triangle {
                next = triangles.next().transpose()?;
            } else if cycle.outputs.idle && next.is_none() {
                return Ok(());
            }
        }
    }
}
