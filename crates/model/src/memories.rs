//! All memories behind a machine: depths, with BLEND colours, and those that the host alone writes.
//!
//! ```text
//!  rd, wr ─────> depth        crd, cwr ─────> colour        asks ─────> records, textures, roots, tables, map
//!    ^──data───────┘             ^──cdata───────┘              ^──words──┘
//! ```
//! A machine that draws its own map has depths and colours twice: one page for the picture, one for the map.

use crate::blend::BlendInputs;
use crate::color_memory::ColorMemory;
use crate::counters::PACED;
use crate::io::{Cycle, Inputs};
use crate::memory::Memory;
use crate::shadow::ShadowInputs;
use crate::tokens::{FEW, OutputWords};
use crate::waits::{PageCounts, Waits};
use crate::word_memory::{Ask, WordIn, WordMemory};
use edgewalk_machine::{DrawState, Maps, Plan, PortVertex, Record, Shading, Step};

/// The memories, and the state that a pass draws with.
#[derive(Clone, Debug)]
pub struct Memories<const C: usize> {
    /// Depths; without BLEND colours too.
    pub depth: Memory<C>,
    /// With BLEND the colours.
    pub color: Option<ColorMemory<C>>,
    /// In the order of [`Plan::word_memories`], each with its name.
    words: Vec<(&'static str, WordMemory)>,
    /// What each of them shows in this cycle.
    ports: Vec<WordIn>,
    /// In a machine that draws its map: the page that is not drawn now.
    other: Option<Box<Page<C>>>,
    state: DrawState,
}

/// What the ports of DEPTH and BLEND reach in a pass.
#[derive(Clone, Debug)]
struct Page<const C: usize> {
    depth: Memory<C>,
    color: Option<ColorMemory<C>>,
}

impl<const C: usize> Memories<C> {
    /// Cleared memories.
    #[must_use]
    pub fn new(plan: &Plan, state: DrawState, waits: Waits) -> Self {
        let color = |clear| plan.blend.is_there().then(|| ColorMemory::new(plan, clear, waits));
        let words = plan.word_memories().into_iter();
        let words: Vec<_> = words.map(|(_, port)| (port.name, WordMemory::new(&port, waits))).collect();
        let mut memories = Memories {
            depth: Memory::new(plan, state.clear, waits),
            color: color(state.clear),
            ports: words.iter().map(|(_, memory)| memory.port()).collect(),
            words,
            other: plan.shadow.draws_map().then(|| {
                let mut depth = Memory::new(plan, [0; 3], waits);
                depth.clear_map(plan);
                Box::new(Page { depth, color: color([plan.color.max(); 3]) })
            }),
            state: DrawState { light_pass: false, ..state },
        };
        memories.set_state(state);
        memories
    }

    /// Writes words of a memory that the host alone writes, from an address on; of a memory that the machine has not, nothing. The
    /// machine is idle.
    pub fn write(&mut self, name: &str, first: usize, words: impl IntoIterator<Item = u128>) {
        if let Some((_, memory)) = self.words.iter_mut().find(|(own, _)| *own == name) {
            memory.write(first, words);
        }
    }

    /// Writes tables, roots, textures, and the records of the first triangles, as many as the memory holds; the machine is idle.
    pub fn write_shading(&mut self, plan: &Plan, shading: &Shading) {
        self.write("tables", 0, shading.tables.iter().copied());
        self.write("textures", 0, shading.textures.iter().copied());
        self.write("roots", 0, shading.roots.iter().copied());
        let records = shading.records.iter().enumerate().take(1 << plan.shade.record_bits);
        for (triangle, record) in records {
            self.write_record(plan, triangle, record);
        }
    }

    /// Writes the record of the triangle with this number, counted from 0; the machine is idle.
    pub fn write_record(&mut self, plan: &Plan, triangle: usize, record: &Record) {
        let place = triangle % (1 << plan.shade.record_bits);
        let words = plan.record_words(record).into_iter().map(u128::from);
        self.write("terms", place << plan.record_place_bits(), words);
    }

    /// Does what the host does in a step, but for [`Step::Draw`]: of that it gives how many triangles are to be drawn.
    pub fn take_step(&mut self, plan: &Plan, step: Step, maps: &mut Maps) -> Option<usize> {
        match step {
            Step::State(state) => self.set_state(state),
            Step::ClearDepth => self.depth.clear_depth(plan),
            Step::ClearMap => self.clear_map(plan),
            Step::LoadMap(number) => {
                let words = maps.words(number).unwrap_or_default();
                self.write("map", 0, words.iter().map(|word| u128::from(*word)));
            }
            Step::Record(triangle, record) => self.write_record(plan, triangle, record),
            Step::Draw(count) => return Some(count),
            Step::StoreMap(number) => maps.keep(number, self.drawn_map(plan)),
        }
        None
    }

    /// Clears the map that is drawn now, with what is left of the light.
    fn clear_map(&mut self, plan: &Plan) {
        self.depth.clear_map(plan);
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
        let stored = self.depth.pixel(addr);
        self.color.as_ref().map_or(stored, |color| color.pixel(addr, stored[0]))
    }

    /// What is stored at an address of the light's map, or of the picture; without a map of the machine's own there is only the picture.
    #[must_use]
    pub fn stored(&self, of_map: bool, addr: u32) -> OutputWords<C> {
        match &self.other {
            Some(other) if of_map != self.state.light_pass => {
                let stored = other.depth.pixel(addr);
                other.color.as_ref().map_or(stored, |color| color.pixel(addr, stored[0]))
            }
            _ => self.pixel(addr),
        }
    }

    /// What the pages of each memory did so far: depth, colour, then the memories that the host alone writes. Depths and colours of the
    /// map and of the picture count as one.
    #[must_use]
    pub fn pages(&self) -> [PageCounts; PACED] {
        let mut pages = [PageCounts::default(); PACED];
        let mut add = |place: usize, counts: PageCounts| pages[place] = pages[place].and(counts);
        let other = self.other.iter().map(|page| (&page.depth, &page.color));
        for (depth, color) in other.chain([(&self.depth, &self.color)]) {
            add(0, depth.pages());
            color.iter().for_each(|color| add(1, color.pages()));
        }
        self.words.iter().enumerate().for_each(|(place, (_, memory))| add(2 + place, memory.pages()));
        pages
    }

    /// What the next triangles are drawn with; the machine is idle.
    pub fn set_state(&mut self, state: DrawState) {
        if let Some(other) = self.other.as_mut().filter(|_| state.light_pass != self.state.light_pass) {
            std::mem::swap(&mut self.depth, &mut other.depth);
            std::mem::swap(&mut self.color, &mut other.color);
        }
        self.state = state;
    }

    /// The machine's inputs in a cycle, with a triangle and its tag offered or none.
    #[inline(always)]
    #[must_use]
    pub fn inputs<'a>(&'a self, tri: Option<(&'a [PortVertex; 3], u32)>, writes_open: bool) -> Inputs<'a> {
        let DrawState { depth_func, depth_write, color_write, .. } = self.state;
        Inputs {
            rst: false,
            tri,
            depth_func,
            depth_write,
            rd_ready: self.depth.rd_ready(),
            data: self.depth.data(),
            wr_ready: self.depth.wr_ready() && writes_open,
            words: &self.ports,
            shadow: ShadowInputs::of(&self.state),
            blend: match &self.color {
                Some(color) if C > FEW => BlendInputs {
                    color_write,
                    add: self.state.blend_add,
                    crd_ready: color.crd_ready(),
                    cdata: color.cdata(),
                    cwr_ready: color.cwr_ready() && writes_open,
                },
                _ => BlendInputs::default(),
            },
        }
    }

    /// Clock edge of a machine of few channels in a cycle in which nothing is read, written, or on its way.
    #[inline(always)]
    pub(crate) fn rest(&mut self) {
        self.depth.step(None, false, None);
    }

    /// Clock edge behind a cycle of the machine, which has asked the memories that the host alone writes for so much.
    #[inline(always)]
    pub fn step(&mut self, cycle: &Cycle<C>, asks: &[Ask]) {
        let outputs = &cycle.outputs;
        if C > FEW {
            let words = self.words.iter_mut().zip(&mut self.ports).zip(asks);
            for (((_, memory), port), ask) in words {
                memory.step(ask.addr.filter(|_| port.ready), ask.take && port.word.is_some());
                *port = memory.port();
            }
        }
        match &mut self.color {
            Some(color) if C > FEW => {
                self.depth.step_depth(cycle.read, cycle.data_taken, cycle.write());
                let read = outputs.blend.crd.filter(|_| color.crd_ready());
                color.step(read, cycle.color_taken, cycle.color_write());
            }
            _ => self.depth.step(cycle.read, cycle.data_taken, cycle.write()),
        }
    }
}
