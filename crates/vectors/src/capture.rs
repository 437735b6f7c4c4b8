//! Runs the model under the rig and keeps every token that moves at a port, with the cycle in which it does.
//!
//! ```text
//!  triangles ─> machine ─> trace
//!  triangles ─> setup ─> edge ─> span ─> pixel ─> depth     each alone under its own rig,
//!                                                           fed with what the one before gave
//! ```

use crate::suites::{self, Suite};
use edgewalk_lockstep::{
    Agreement, Direction, Interface, Kept, Link, LockstepError, NetlistDevice, Pattern, Rig, Setting,
    StallKind, Token, Triangles, Unit, lockstep, model, patterns, status_ports,
};
use edgewalk_machine::{Plan, Walk};
use edgewalk_model::{DrawState, Events, longest_setup};
use edgewalk_netlist::{Netlist, Simulate};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// What moved at one link.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinkTrace {
    /// The tokens, in order.
    pub tokens: Vec<Token>,
    /// The cycle in which each moved.
    pub cycles: Vec<u64>,
    /// Number of the triangle that each belongs to; empty where a link does not know (rd, data).
    pub triangles: Vec<u32>,
}

/// All that is to be seen at the ports of a unit in a run.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The machine.
    pub plan: Plan,
    /// The ports.
    pub interface: Interface,
    /// What the rig did.
    pub setting: Setting,
    /// Depth function and write mask, where the unit has them.
    pub state: DrawState,
    /// The stalls in words.
    pub stalls: StallKind,
    /// For each link of the interface.
    pub links: Vec<LinkTrace>,
    /// Every change of the outputs that are compared in every cycle, with its cycle; the first is cycle 0. See
    /// [`edgewalk_lockstep::status_ports`].
    pub status: Vec<(u64, Token)>,
    /// Cycles until nothing more happened.
    pub cycles: u64,
    /// For each link the cycles in which its token was valid.
    pub valid_cycles: Vec<u64>,
    /// Values held beside a link in the cycles in which no token is offered there.
    pub kept_values: u64,
    /// The longest wait between two things that happened, cycles.
    pub longest_gap: u64,
    /// Events met.
    pub events: Events,
}

/// Runs the machine, or one of its units, over a suite.
#[must_use]
pub fn capture(plan: &Plan, unit: Unit, suite: &Suite, state: DrawState, stalls: StallKind) -> Trace {
    capture_watched(plan, unit, suite, state, stalls, &|_, _| {})
}

/// As [`capture`]; now and then `watch` is told how many tokens of the stimulus have entered, and of how many.
#[must_use]
pub fn capture_watched(
    plan: &Plan,
    unit: Unit,
    suite: &Suite,
    state: DrawState,
    stalls: StallKind,
    watch: &dyn Fn(usize, usize),
) -> Trace {
    let runs = Runs::new(plan, suite, state);
    runs.observe(unit, runs.stimulus(unit), stalls, watch)
}

/// Cycles between two calls of a `watch`.
const WATCHED: u64 = 1 << 16;

/// Runs a unit over these tokens, whoever made them; `seed` is that of the stalls.
#[must_use]
pub fn capture_tokens(
    plan: &Plan,
    unit: Unit,
    tokens: Vec<Token>,
    state: DrawState,
    stalls: StallKind,
    seed: u64,
) -> Trace {
    let suite = Suite {
        seed,
        words: suites::words(plan, seed, tokens.len()),
        ..Suite::of_triangles("tokens", "", Vec::new())
    };
    let triangles = (0..tokens.len() as u32).collect();
    Runs::new(plan, &suite, state).observe(unit, Stimulus { tokens, triangles }, stalls, &|_, _| {})
}

/// What enters a unit.
#[derive(Clone)]
struct Stimulus {
    tokens: Vec<Token>,
    /// The triangle that each belongs to.
    triangles: Vec<u32>,
}

/// Runs of the machine and its units over one suite. What enters a unit is worked out once for all of them.
pub struct Runs<'a> {
    plan: &'a Plan,
    suite: &'a Suite,
    state: DrawState,
    units: Vec<Unit>,
    /// For each of the units what leaves it where nothing makes it wait.
    alone: Vec<OnceLock<(Link, Stimulus)>>,
}

impl<'a> Runs<'a> {
    /// None yet.
    #[must_use]
    pub fn new(plan: &'a Plan, suite: &'a Suite, state: DrawState) -> Self {
        let units = Unit::single(plan);
        let alone = units.iter().map(|_| OnceLock::new()).collect();
        Runs { plan, suite, state, units, alone }
    }

    /// The machine, or one of its units, over the suite.
    #[must_use]
    pub fn capture(&self, unit: Unit, stalls: StallKind) -> Trace {
        self.observe(unit, self.stimulus(unit), stalls, &|_, _| {})
    }

    /// What enters the unit: what leaves the one before, running alone and without stalls. What another unit holds beside
    /// that link belongs to the same triangle. Beside a token that is not the first of its triangle no unit may look at it,
    /// as EDGE may have the next triangle: there each bit is the other one.
    fn stimulus(&self, unit: Unit) -> Stimulus {
        let place = self.units.iter().position(|other| *other == unit);
        let Some(before) = place.and_then(|place| place.checked_sub(1)) else { return self.triangles() };
        let (link, mut out) = self.alone(before).clone();
        let own = link.own;
        out.tokens.iter_mut().for_each(|token| token.truncate(own));
        let taken = Interface::new(self.plan, unit);
        let fields = &taken.links[0].fields[own..];
        if fields.is_empty() {
            return out;
        }
        // Whoever holds values of these names.
        for holder in 0..before {
            let (link, held) = self.alone(holder);
            let place = |name: &str| link.fields[link.own..].iter().position(|port| port.name == name);
            let Some(places) = fields.iter().map(|port| place(&port.name)).collect::<Option<Vec<usize>>>()
            else {
                continue;
            };
            let tokens = held.tokens.iter().map(|token| &token[link.own..]);
            let of: BTreeMap<u32, &[u128]> = held.triangles.iter().copied().zip(tokens).collect();
            let fresh = taken.links[0].place("fresh");
            for (token, triangle) in out.tokens.iter_mut().zip(&out.triangles) {
                let unseen = fresh.is_some_and(|fresh| token[fresh] == 0);
                let own = places.iter().map(|place| of.get(triangle).map_or(0, |values| values[*place]));
                let held = own.zip(fields).map(|(value, port)| {
                    if unseen { !value & (u128::MAX >> (128 - port.width())) } else { value }
                });
                token.extend(held);
            }
            break;
        }
        out
    }

    fn triangles(&self) -> Stimulus {
        let port = Triangles::new(self.plan);
        let tokens: Vec<Token> = self.suite.triangles().zip(0..).map(|(t, k)| port.pack(t, k)).collect();
        Stimulus { triangles: (0..tokens.len() as u32).collect(), tokens }
    }

    /// The tokens that leave the unit of this place where nothing makes it wait.
    fn alone(&self, place: usize) -> &(Link, Stimulus) {
        self.alone[place].get_or_init(|| self.run_alone(self.units[place]))
    }

    fn run_alone(&self, unit: Unit) -> (Link, Stimulus) {
        let trace = self.observe(unit, self.stimulus(unit), StallKind::None, &|_, _| {});
        let last = trace.interface.links.len() - 1;
        let out = trace.links.into_iter().next_back().unwrap_or_default();
        (trace.interface.links[last].clone(), Stimulus { tokens: out.tokens, triangles: out.triangles })
    }

    fn setting(&self, interface: &Interface, tokens: Vec<Token>, stalls: StallKind) -> Setting {
        let mut setting = Setting::willing(interface, &self.state.constants())
            .expect("a test of lockstep runs every unit with these constants");
        setting.patterns = patterns(self.plan, interface, stalls, self.suite.seed);
        for (memory, declared) in setting.memories.iter_mut().zip(&interface.memories) {
            if let Some(words) = self.suite.words.get(declared.name) {
                // Of more triangles than the memory has records the first ones'.
                memory.start = words[..words.len().min(memory.words)].into();
            } else if declared.name == "depth" {
                memory.clear = self.suite.clear_z.map_or(memory.clear, u128::from);
            }
        }
        Setting { tokens, ..setting }
    }

    fn observe(
        &self,
        unit: Unit,
        stimulus: Stimulus,
        stalls: StallKind,
        watch: &dyn Fn(usize, usize),
    ) -> Trace {
        let interface = Interface::new(self.plan, unit);
        let Stimulus { tokens, triangles } = stimulus;
        let setting = self.setting(&interface, tokens, stalls);
        let status_ports = status_ports(&interface);
        let mut device =
            model(self.plan, &interface).expect("a test of lockstep finds every declared port in the model");
        let mut rig = Rig::new(&interface, setting.clone()).of_triangles(triangles);
        let mut ports = interface.values();
        let count = interface.links.len();
        let mut trace = Trace {
            plan: self.plan.clone(),
            setting,
            state: self.state,
            stalls,
            links: vec![LinkTrace::default(); count],
            status: Vec::new(),
            cycles: 0,
            valid_cycles: vec![0; count],
            kept_values: 0,
            longest_gap: 0,
            events: Events::default(),
            interface,
        };
        let mut kept = Kept::of(&trace.interface);
        let (mut counting, mut since_event) = (0, 0);
        let patience = patience(self.plan, &trace.setting.patterns);
        while !rig.exhausted() || rig.cycle() < trace.cycles + patience {
            let cycle = rig.cycle();
            if cycle % WATCHED == WATCHED - 1 {
                watch(trace.links[0].tokens.len(), trace.setting.tokens.len());
            }
            rig.drive(&mut ports);
            device.cycle(&mut ports);
            for (place, link) in trace.interface.links.iter().enumerate() {
                trace.valid_cycles[place] += u64::from(ports.is_high(link.valid));
                if link.fires(&ports) {
                    let moved = &mut trace.links[place];
                    moved.tokens.push(link.token(&ports).to_vec());
                    moved.cycles.push(cycle);
                    moved.triangles.extend(ports.triangle(place));
                }
            }
            counting = kept.iter().map(|kept| kept.counting(&ports).len() as u64).sum::<u64>();
            since_event += counting;
            kept.iter_mut().for_each(|kept| kept.clock(&ports));
            let status = status_ports.iter().map(|port| port.value(&ports));
            let changed = trace.status.last().is_none_or(|(_, last)| status.clone().ne(last.iter().copied()));
            if changed {
                trace.status.push((cycle, status.collect()));
            }
            if rig.clock(&ports) || changed {
                trace.longest_gap = trace.longest_gap.max(cycle + 1 - trace.cycles);
                trace.cycles = cycle + 1;
                trace.kept_values += std::mem::take(&mut since_event);
            }
        }
        drop(rig);
        trace.kept_values += AFTER * counting;
        trace.events = device.events().clone();
        trace
    }
}

/// Longest time in which nothing may move at the ports though something will: SETUP, then lines without pixels, then a
/// span that comes from far off the screen, to which TERM walks first; and whatever the rig makes them wait.
pub(crate) fn patience(plan: &Plan, patterns: &[Pattern]) -> u64 {
    let waits: u64 = patterns.iter().map(Pattern::longest_wait).sum();
    let setup = u64::from(longest_setup(plan).all());
    let span = u64::from(plan.clocks_per_pixel()) << plan.widths().column;
    let walk = if plan.shade.is_there() {
        let step = if plan.shade.walk == Walk::Memory { plan.terms().len() as u64 * 3 } else { 2 };
        step * ((1 << (plan.widths().column - 1)) + (1 << plan.widths().y))
    } else {
        0
    };
    let rows = if plan.shadow.projects() { u64::from(plan.shadow.rows()) } else { 0 };
    setup + u64::from(plan.height) + span + walk + rows + waits + 1000
}

/// Cycles that follow the last event of the model: what comes too much would come here.
const AFTER: u64 = 64;

impl Trace {
    /// What moved at the link of that name.
    #[must_use]
    pub fn link(&self, name: &str) -> Option<&LinkTrace> {
        let place = self.interface.links.iter().position(|link| link.name == name)?;
        self.links.get(place)
    }

    /// Tokens that the design has to give.
    #[must_use]
    pub fn tokens_out(&self) -> u64 {
        let links = self.interface.links.iter().zip(&self.links);
        let out = links.filter(|(link, _)| link.direction == Direction::Out);
        out.map(|(_, trace)| trace.tokens.len() as u64).sum()
    }

    /// Tokens and status changes that a bench has to compare.
    #[must_use]
    pub fn expected(&self) -> u64 {
        self.tokens_out() + self.status.len() as u64
    }

    /// The port values that a lock-step over the whole trace has to compare.
    #[must_use]
    pub fn port_values(&self) -> u64 {
        let always = (self.cycles + AFTER) * status_ports(&self.interface).len() as u64;
        let links = self.interface.links.iter().zip(&self.valid_cycles);
        let values = links.map(|(link, valid)| match (link.direction, link.ready_always) {
            (Direction::Out, _) => link.fields.len() as u64 * valid,
            (Direction::In, true) => 0,
            (Direction::In, false) => *valid,
        });
        always + values.sum::<u64>() + self.kept_values
    }

    /// Runs a netlist of the unit beside the model, with the stimulus of the trace.
    ///
    /// # Errors
    /// The first difference.
    pub fn lockstep(&self, netlist: &Netlist) -> Result<Agreement, LockstepError> {
        self.lockstep_of(&mut NetlistDevice::new(netlist, &self.interface)?)
    }

    /// As [`Trace::lockstep`], of a netlist that something else than the interpreter may run.
    ///
    /// # Errors
    /// The first difference.
    pub fn lockstep_of(&self, device: &mut NetlistDevice<impl Simulate>) -> Result<Agreement, LockstepError> {
        if self.tokens_out() == 0 {
            return Err(LockstepError::Vacuous);
        }
        lockstep(&self.plan, &self.interface, &self.setting, self.cycles + AFTER, device)
    }
}
