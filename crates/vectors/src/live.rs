//! A unit of the model that is fed while somebody's simulation runs: it takes the tokens that a design takes, and gives those that
//! the design ought to give.
//!
//! ```text
//!  tokens at the design's port ─> unit of the model under a rig that never waits, with memories of its own ─> tokens, in order
//! ```
//! What a unit gives depends on what it takes, not on when: so the values and the order hold for a design with any timing.

use crate::capture::patience;
use edgewalk_lockstep::device::ModelDevice;
use edgewalk_lockstep::{
    Direction, Interface, PortValues, Rig, Setting, StatusPort, Token, Unit, UnknownConstant, model,
    status_ports,
};
use edgewalk_machine::{DrawState, Plan};
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, mpsc};

/// A memory behind the unit as it is at the start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartWords {
    /// The first words, from address 0 on.
    pub first: Arc<[u128]>,
    /// All the others; none: every bit is 1, the depth of an empty screen.
    pub clear: Option<u128>,
}

/// The tokens that the rig has not offered yet.
struct Given(mpsc::Receiver<Token>);

impl Iterator for Given {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        self.0.try_recv().ok()
    }
}

/// A unit of the model in the middle of a simulation.
pub struct Live {
    interface: Interface,
    /// The sender of the channel that the rig reads tokens from.
    given: mpsc::Sender<Token>,
    rig: Rig<Given>,
    device: Box<dyn ModelDevice + Send>,
    ports: PortValues,
    /// The first words of a token that is sent word by word.
    words: Token,
    /// For each link: the tokens that left the unit and were not read.
    came: Vec<VecDeque<Token>>,
    watched: Vec<StatusPort>,
    /// The values of these ports in the last cycle.
    status: Token,
    /// Cycles in a row without a token and without a change of these ports.
    quiet: u64,
    /// After so many such cycles no token comes any more.
    patience: u64,
}

impl Live {
    /// The unit after reset. Constants that are not named have the value of [`DrawState::default`]; memories that are not named
    /// are clear.
    ///
    /// # Errors
    /// A constant that the unit has and nobody names.
    pub fn new(
        plan: &Plan,
        unit: Unit,
        constants: &[(&str, u128)],
        memories: &BTreeMap<String, StartWords>,
    ) -> Result<Live, UnknownConstant> {
        let interface = Interface::new(plan, unit);
        let preset = DrawState::default().constants();
        // The first of a name counts.
        let constants: Vec<(&str, u128)> = constants.iter().copied().chain(preset).collect();
        let mut setting = Setting::willing(&interface, &constants)?;
        for (memory, declared) in setting.memories.iter_mut().zip(&interface.memories) {
            if let Some(words) = memories.get(declared.name) {
                memory.start = words.first.clone();
                memory.clear = words.clear.unwrap_or(memory.clear);
            }
        }
        let device =
            model(plan, &interface).expect("a test of lockstep finds every declared port in the model");
        let (given, source) = mpsc::channel();
        Ok(Live {
            patience: patience(plan, &setting.patterns),
            rig: Rig::fed(&interface, setting, Given(source)),
            device,
            ports: interface.values(),
            words: Token::new(),
            came: vec![VecDeque::new(); interface.links.len()],
            watched: status_ports(&interface),
            status: Token::new(),
            quiet: 0,
            given,
            interface,
        })
    }

    /// Gives the unit a token of the first link of its interface, as it stood at the ports: of a link that is sent word by word one word.
    pub fn give(&mut self, token: &[u128]) {
        let link = &self.interface.links[0];
        let mut whole = token.to_vec();
        if !link.words.is_empty() {
            let width = link.words[self.words.len()].width();
            self.words.push(token[0] & (u128::MAX >> (128 - width)));
            if self.words.len() < link.words.len() {
                return;
            }
            // What stands beside the words counts with the last.
            whole = std::mem::take(&mut self.words);
            whole.extend_from_slice(&token[1..]);
        }
        self.given.send(whole).expect("the rig holds the other end");
        self.rig.ask_again();
        self.quiet = 0;
    }

    /// The next token that leaves on the link of this place; none if what was given so far makes no more. `go_on` is called
    /// after every 4096 cycles: a token that breaks the unit's rules may keep it busy for ever.
    ///
    /// # Errors
    /// Those of `go_on`.
    pub fn next<E>(
        &mut self,
        link: usize,
        mut go_on: impl FnMut() -> Result<(), E>,
    ) -> Result<Option<Token>, E> {
        let mut cycles = 0;
        while self.came[link].is_empty() && self.quiet < self.patience {
            self.cycle();
            asked(&mut cycles, &mut go_on)?;
        }
        Ok(self.came[link].pop_front())
    }

    /// For each link out: the number of tokens left over. `go_on` as of [`Live::next`].
    ///
    /// # Errors
    /// Those of `go_on`.
    pub fn rest<E>(
        &mut self,
        mut go_on: impl FnMut() -> Result<(), E>,
    ) -> Result<Vec<(&'static str, usize)>, E> {
        let mut cycles = 0;
        while self.quiet < self.patience {
            self.cycle();
            asked(&mut cycles, &mut go_on)?;
        }
        let links = self.interface.links.iter().zip(&self.came);
        let out = links.filter(|(link, _)| link.direction == Direction::Out);
        Ok(out.map(|(link, came)| (link.name, came.len())).collect())
    }

    fn cycle(&mut self) {
        self.rig.drive(&mut self.ports);
        self.device.cycle(&mut self.ports);
        for (link, came) in self.interface.links.iter().zip(&mut self.came) {
            if link.direction == Direction::Out && link.fires(&self.ports) {
                came.push_back(link.token(&self.ports).to_vec());
            }
        }
        let status: Token = self.watched.iter().map(|port| port.value(&self.ports)).collect();
        let changed = std::mem::replace(&mut self.status, status) != self.status;
        self.quiet = if self.rig.clock(&self.ports) || changed { 0 } else { self.quiet + 1 };
    }
}

/// Cycles between two calls of `go_on`.
const BETWEEN: u32 = 4096;

/// Counts a cycle, and calls `go_on` after every [`BETWEEN`].
fn asked<E>(cycles: &mut u32, go_on: &mut impl FnMut() -> Result<(), E>) -> Result<(), E> {
    *cycles += 1;
    if cycles.is_multiple_of(BETWEEN) { go_on() } else { Ok(()) }
}
