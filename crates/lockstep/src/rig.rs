//! The rig: offers tokens, takes tokens, and is every memory behind the device.
//!
//! ```text
//!  tokens ─> link in ──> ┌────────┐ ──> links out, taken when willing
//!  levels, constants ──> │ device │ ──rd──> memory ──data──┐
//!                        └────────┘ <──────────────────────┘  <──wr
//! ```
//! It does what the test bench in Verilog (`vectors/bench`) does, cycle for cycle. Nothing it drives depends on an output
//! of the same cycle. A token that is offered stays until it is taken. One that a link takes word by word begins anew behind a reset.

mod memory;

use crate::interface::{Direction, Interface, Link};
use crate::stalls::Pattern;
use crate::values::PortValues;
use crate::{Token, UnknownConstant};
pub use memory::MemorySetting;
use memory::Served;
use rand::{RngCore, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// How the rig behaves.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Tokens of the first link in, whole; those of the memories come from the rig.
    pub tokens: Vec<Token>,
    /// Values of the constants, in the interface's order.
    pub constants: Vec<u128>,
    /// A pattern for each link, then for each level; see [`crate::stalls::patterns`].
    pub patterns: Vec<Pattern>,
    /// Of each memory of the interface.
    pub memories: Vec<MemorySetting>,
    /// Cycles with `rst` high, in the midst of the work; ascending.
    pub resets: Vec<u64>,
    /// Fields without a token carry random bits from this seed; 0 where there is none.
    pub noise: Option<u64>,
}

impl Setting {
    /// A rig that never makes the device wait, its memories as they are at the start of a picture.
    ///
    /// # Errors
    /// A constant of the interface that `constants` does not name.
    pub fn willing(interface: &Interface, constants: &[(&str, u128)]) -> Result<Setting, UnknownConstant> {
        let value = |name: &str| {
            let found = constants.iter().find(|(constant, _)| *constant == name);
            found.map(|(_, value)| *value).ok_or_else(|| UnknownConstant(name.to_owned()))
        };
        Ok(Setting {
            tokens: Vec::new(),
            constants: interface.constants.iter().map(|port| value(&port.name)).collect::<Result<_, _>>()?,
            patterns: interface.waits().map(|_| Pattern::always()).collect(),
            memories: interface.memories.iter().map(MemorySetting::of).collect(),
            resets: Vec::new(),
            noise: None,
        })
    }
}

/// The rig in the middle of a run; its tokens come from `S`.
pub struct Rig<S = std::vec::IntoIter<Token>> {
    source: S,
    /// The token that is offered, or will be.
    next: Option<Token>,
    /// Words taken of it, where it is sent word by word.
    place: usize,
    /// Tokens taken so far.
    sent: u32,
    /// The triangle of each token; empty where a token is a triangle, or its number will do.
    triangles: Vec<u32>,
    links: Vec<Link>,
    constants: Vec<(crate::PortId, u128)>,
    levels: Vec<crate::PortId>,
    patterns: Vec<Pattern>,
    memories: Vec<Served>,
    resets: Vec<u64>,
    noise: Option<Pcg64Mcg>,
    /// Whether each link in stood valid, unfired, in the cycle before.
    held: Vec<bool>,
    cycle: u64,
}

impl Rig {
    /// A rig before cycle 0, with the tokens of the setting.
    #[must_use]
    pub fn new(interface: &Interface, mut setting: Setting) -> Rig {
        let tokens = std::mem::take(&mut setting.tokens);
        Rig::fed(interface, setting, tokens.into_iter())
    }
}

impl<S: Iterator<Item = Token>> Rig<S> {
    /// Like `new`, with tokens from elsewhere.
    #[must_use]
    pub fn fed(interface: &Interface, setting: Setting, mut source: S) -> Rig<S> {
        let memories = interface.memories.iter().zip(setting.memories);
        let constants = interface.constants.iter().map(|port| port.id).zip(setting.constants);
        Rig {
            next: source.next(),
            source,
            place: 0,
            sent: 0,
            triangles: Vec::new(),
            links: interface.links.clone(),
            constants: constants.collect(),
            levels: interface.levels.iter().map(|port| port.id).collect(),
            patterns: setting.patterns,
            memories: memories.map(|(memory, setting)| Served::new(memory, setting)).collect(),
            resets: setting.resets,
            noise: setting.noise.map(Pcg64Mcg::seed_from_u64),
            held: vec![false; interface.links.len()],
            cycle: 0,
        }
    }

    /// Like `fed`, with the triangle that each token belongs to.
    #[must_use]
    pub fn of_triangles(self, triangles: Vec<u32>) -> Rig<S> {
        Rig { triangles, ..self }
    }

    /// Asks the source again where it had no token left: one that is fed during the run may have one now.
    pub fn ask_again(&mut self) {
        if self.next.is_none() {
            self.next = self.source.next();
        }
    }

    /// The cycle that [`Rig::drive`] is for, from 0.
    #[must_use]
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Tokens of the first link in that were taken.
    #[must_use]
    pub fn sent(&self) -> u32 {
        self.sent
    }

    /// All tokens have been taken, and all words that were read.
    #[must_use]
    pub fn exhausted(&self) -> bool {
        self.next.is_none() && self.memories.iter().all(Served::is_quiet)
    }

    /// Drives the inputs of this cycle.
    pub fn drive(&mut self, ports: &mut PortValues) {
        let cycle = self.cycle;
        ports.rst = self.resets.contains(&cycle);
        let triangle = self.triangles.get(self.sent as usize).copied().unwrap_or(self.sent);
        for (place, link) in self.links.iter().enumerate() {
            let willing = self.patterns[place].at(cycle);
            if link.direction == Direction::Out {
                ports.set(link.ready, willing);
                continue;
            }
            let served = self.memories.iter().find(|memory| memory.data() == place);
            let token = match served {
                Some(memory) => memory.offered(cycle),
                None => self.next.as_deref(),
            };
            let token = token.filter(|_| self.held[place] || willing);
            ports.set(link.valid, token.is_some());
            ports.set_triangle(place, token.and(served.is_none().then_some(triangle)));
            match (token, &mut self.noise) {
                (Some(token), noise) if !link.words.is_empty() => {
                    let ports = ports.range_mut(&link.range());
                    ports.iter_mut().zip(link.word(token, self.place)).for_each(|(port, word)| *port = word);
                    noise.iter_mut().for_each(|noise| disturb(link, self.place, noise, ports));
                }
                (Some(token), _) => ports.range_mut(&link.range()).copy_from_slice(token),
                (None, None) => ports.range_mut(&link.range()).fill(0),
                (None, Some(noise)) => {
                    for field in &link.fields {
                        ports[field.id] = bits(noise, field.width());
                    }
                }
            }
        }
        for (port, value) in &self.constants {
            ports[*port] = *value;
        }
        // A level is high where its pattern is not willing, while there are tokens: without stalls it never is.
        for (level, pattern) in self.levels.iter().zip(&self.patterns[self.links.len()..]) {
            ports.set(*level, self.next.is_some() && !pattern.at(cycle));
        }
    }

    /// The clock edge after a cycle with these values. True if any token moved. In a cycle with reset none does, and what
    /// was read is forgotten.
    pub fn clock(&mut self, ports: &PortValues) -> bool {
        self.cycle += 1;
        if ports.rst {
            self.held.fill(false);
            self.place = 0; // the device has forgotten the words of a token that was not whole
            self.memories.iter_mut().for_each(Served::reset);
            return false;
        }
        let mut moved = false;
        for (place, link) in self.links.iter().enumerate() {
            let fires = link.fires(ports);
            moved |= fires;
            self.held[place] = !fires && ports.is_high(link.valid);
            let fed =
                link.direction == Direction::In && self.memories.iter().all(|memory| memory.data() != place);
            if fires && fed {
                self.place += 1;
                if self.place >= link.words.len() {
                    self.place = 0;
                    self.sent += 1;
                    self.next = self.source.next();
                }
            }
        }
        for memory in &mut self.memories {
            memory.clock(&self.links, ports, self.cycle - 1);
        }
        moved
    }
}

/// Noise in what is not seen of a word: the bits above it, and what stands beside all words but the last.
fn disturb(link: &Link, place: usize, noise: &mut Pcg64Mcg, ports: &mut [u128]) {
    let (width, whole) = (link.words[place].width(), link.fields[0].width());
    let seen = u128::MAX >> (128 - width);
    ports[0] = ports[0] & seen | bits(noise, whole) & !seen;
    if place + 1 < link.words.len() {
        let beside = ports[1..].iter_mut().zip(&link.fields[1..]);
        beside.for_each(|(port, field)| *port = bits(noise, field.width()));
    }
}

/// Random bits.
pub(crate) fn bits(random: &mut Pcg64Mcg, width: u32) -> u128 {
    (u128::from(random.next_u64()) << 64 | u128::from(random.next_u64())) >> (128 - width)
}
