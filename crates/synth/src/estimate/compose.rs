//! A machine from its units: each is worked out by itself, with what the others say of its ports, round after round
//! until nothing new is said.

use super::delay::Path;
use super::kept::{Kept, Unit, Viewed};
use super::module::{Gives, Module, OFTEN};
use super::ports::{Seen, View};
use super::structure::{Structure, UnitTables};
use super::ways::{Way, longer};
use edgewalk_netlist::Netlist;
use rayon::Scope;
use rayon::prelude::*;
use std::num::NonZeroU32;
use std::sync::Arc;

/// Rounds at most.
const ROUNDS: usize = 32;
/// The unit at the head of the pipeline. It is the largest one, and the last one of the first round. Its neighbours seldom
/// tell more of it later, so its cover begins at once.
const HEAD: usize = 1;

/// Where a bit comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Source {
    Constant(bool),
    /// An input bit of the machine.
    Outside(u32),
    /// An output bit of a module.
    Of(u32, u32),
}

struct Composed<'k> {
    kept: &'k Kept,
    /// What joins the units, then the units.
    modules: Vec<Unit>,
    /// By module: where its bits begin among the outputs of what joins them, and among its inputs.
    first: Vec<[usize; 2]>,
    /// By input bit of what joins the units: the module that drives it. Inputs of the machine have none.
    drivers: Vec<u32>,
    /// By output bit of what joins the units: the module that reads it. Outputs of the machine have none.
    takers: Vec<u32>,
    /// Outputs of what joins the units that only hand an input bit on, in the order of these bits.
    wires: Vec<u32>,
    /// By input bit of what joins the units: where its outputs begin in `wires`. The last number is that of all.
    wired: Vec<usize>,
    gives: Vec<Vec<Gives>>,
    reads: Vec<Vec<u8>>,
    /// By module: where its outputs begin among the outputs of all modules. The last number is that of all.
    outputs: Vec<usize>,
}

/// A module of a machine that is settled.
struct Settled {
    view: View,
    viewed: Arc<Viewed>,
}

/// The machine of this netlist, whose instances are these units.
pub(super) fn compose(kept: &Kept, joints: Unit, units: Vec<Unit>) -> Structure {
    rayon::scope(|scope| {
        let mut composed = Composed::new(kept, joints, units);
        let settled = composed.settle(scope);
        let module = |place: usize| {
            let Settled { view, viewed } = &settled[place];
            kept.module(&composed.modules[place], view, viewed)
        };
        // The head's cover is on its way. A thread that asks for it waits, so it is asked for last.
        (0..settled.len()).into_par_iter().filter(|place| *place != HEAD).for_each(|place| {
            module(place);
        });
        let found = (0..settled.len()).map(module);
        composed.structure(&found.collect::<Vec<_>>())
    })
}

fn bits(netlist: &Netlist) -> [usize; 2] {
    let inputs = netlist.inputs.iter().map(|input| netlist.width(input.node) as usize);
    let outputs = netlist.outputs.iter().map(|output| netlist.width(output.driver) as usize);
    [inputs.sum(), outputs.sum()]
}

/// What is seen of an input bit, by the first one that has the same source.
fn equal(first: &mut u32, input: u32) -> Seen {
    if *first == u32::MAX {
        *first = input;
    }
    if *first == input { Seen::Own } else { Seen::Same(*first) }
}

impl<'k> Composed<'k> {
    fn new(kept: &'k Kept, joints: Unit, units: Vec<Unit>) -> Composed<'k> {
        let [inputs, outputs] = bits(&joints.netlist);
        let (mut drivers, mut takers) = (vec![0; inputs], vec![0; outputs]);
        let mut first = vec![[0, 0]];
        let mut ports = Vec::new();
        for (place, unit) in units.iter().enumerate() {
            let [inputs, outputs] = bits(&unit.netlist);
            first.push([takers.len(), drivers.len()]);
            takers.resize(takers.len() + inputs, place as u32 + 1);
            drivers.resize(drivers.len() + outputs, place as u32 + 1);
            ports.push([inputs, outputs]);
        }
        ports.insert(0, [drivers.len(), takers.len()]);
        let modules = [joints].into_iter().chain(units).collect();
        let gives = ports.iter().map(|[_, outputs]| vec![Gives::Own; *outputs]).collect();
        let reads = ports.iter().map(|[inputs, _]| vec![1; *inputs]).collect();
        let mut outputs = vec![0];
        outputs.extend(ports.iter().scan(0, |sum, [_, outputs]| {
            *sum += outputs;
            Some(*sum)
        }));
        let wired = vec![0; drivers.len() + 1];
        Composed { kept, modules, first, drivers, takers, wires: Vec::new(), wired, gives, reads, outputs }
    }

    fn settle(&mut self, scope: &Scope<'k>) -> Vec<Settled> {
        let joints = View { outside: true, family: self.kept.family, ..View::default() };
        let joints = self.kept.viewed(&self.modules[0], &joints);
        joints.take_logic(); // only its ports are wanted
        let mut wires = Vec::new();
        for (bit, gives) in &joints.ports.gives {
            self.gives[0][*bit as usize] = *gives;
            if let Gives::Input(input) = gives {
                wires.push((*input, *bit));
                self.wired[*input as usize + 1] += 1;
            }
        }
        wires.sort_unstable();
        self.wires = wires.into_iter().map(|(_, output)| output).collect();
        for input in 1..self.wired.len() {
            self.wired[input] += self.wired[input - 1];
        }
        let mut settled: Vec<Option<Settled>> = self.modules.iter().map(|_| None).collect();
        // Steps in which a port said something new, and in which a module was last looked at.
        let (mut step, mut news, mut looked) = (1, 1, vec![0; self.modules.len()]);
        for round in 0..ROUNDS {
            for place in 0..self.modules.len() {
                // What joins the units comes first in each round. Unread bits are told from the last unit to the first.
                // Constant and equal bits are told the other way.
                let count = self.modules.len();
                let place = if round % 2 == 0 { (count - place) % count } else { place };
                if looked[place] >= news {
                    continue;
                }
                let view = self.view(place);
                looked[place] = step;
                step += 1;
                if settled[place].as_ref().is_some_and(|before| before.view == view) {
                    continue;
                }
                let viewed = self.kept.viewed(&self.modules[place], &view);
                if self.told(place, &viewed) {
                    (news, step) = (step, step + 1);
                }
                if round == 0 && place == HEAD {
                    let (kept, unit) = (self.kept, self.modules[place].clone());
                    let (view, viewed) = (view.clone(), viewed.clone());
                    scope.spawn(move |_| {
                        kept.module(&unit, &view, &viewed);
                    });
                }
                if let Some(before) = settled[place].replace(Settled { view, viewed }) {
                    before.viewed.take_logic();
                }
            }
            if looked.iter().all(|looked| *looked >= news) {
                break;
            }
        }
        settled.into_iter().flatten().collect()
    }

    /// Takes over what a module says of its ports; whether it is new.
    fn told(&mut self, place: usize, viewed: &Viewed) -> bool {
        let mut new = false;
        for (bit, gives) in &viewed.ports.gives {
            new |= std::mem::replace(&mut self.gives[place][*bit as usize], *gives) != *gives;
        }
        new |= self.reads[place] != viewed.ports.reads;
        self.reads[place].clone_from(&viewed.ports.reads);
        new
    }

    /// Where an input bit of a module comes from.
    fn source(&self, mut module: usize, mut input: usize) -> Source {
        loop {
            let (giver, mut output) = match module {
                0 if self.drivers[input] == 0 => return Source::Outside(input as u32),
                0 => (self.drivers[input] as usize, input - self.first[self.drivers[input] as usize][1]),
                unit => (0, self.first[unit][0] + input),
            };
            (module, input) = loop {
                match self.gives[giver][output] {
                    Gives::Own => return Source::Of(giver as u32, output as u32),
                    Gives::Constant(value) => return Source::Constant(value),
                    Gives::Input(input) => break (giver, input as usize),
                    Gives::Same(other) => output = other as usize,
                }
            };
        }
    }

    fn view(&self, module: usize) -> View {
        let inputs = self.reads[module].len();
        // By output of all modules, then by input of the machine: the first input bit that is equal to it.
        let outputs = self.outputs[self.modules.len()];
        let mut first = vec![u32::MAX; outputs + self.drivers.len()];
        let mut seen = |input: usize| match self.source(module, input) {
            Source::Constant(value) => Seen::Constant(value),
            // What joins the units takes a bit from the unit that computes it, not from one that passes it on.
            Source::Of(unit @ 1.., output) if module == 0 => {
                match self.first[unit as usize][1] as u32 + output {
                    other if other == input as u32 => Seen::Own,
                    other => Seen::Same(other),
                }
            }
            Source::Outside(bit) => equal(&mut first[outputs + bit as usize], input as u32),
            Source::Of(of, output) => {
                equal(&mut first[self.outputs[of as usize] + output as usize], input as u32)
            }
        };
        let inputs = (0..inputs).map(&mut seen).collect();
        let taken = |output: usize| match self.takers[output] as usize {
            0 => 1,
            taker => self.reads[taker][output - self.first[taker][0]],
        };
        let readers = |output: usize| match module {
            0 if matches!(self.gives[0][output], Gives::Input(_)) => 0,
            0 => taken(output),
            unit => {
                let input = self.first[unit][1] + output;
                let wires = &self.wires[self.wired[input]..self.wired[input + 1]];
                let wires = wires.iter().map(|wire| taken(*wire as usize)).fold(0, u8::saturating_add);
                (self.reads[0][input] + wires).min(OFTEN)
            }
        };
        let readers = (0..self.gives[module].len()).map(readers).collect();
        View { inputs, readers, outside: module == 0, inside: module > 0, family: self.kept.family }
    }

    fn structure(&self, found: &[&Module]) -> Structure {
        let sum = |of: fn(&Module) -> u64| found.iter().map(|module| of(module)).sum();
        let tables = self.modules.iter().zip(found).map(|(unit, found)| UnitTables {
            unit: unit.name.clone(),
            tables: found.tables.iter().map(|(_, tables)| tables).sum(),
        });
        Structure {
            whole: true,
            tables: tables.collect(),
            carry: sum(|module| module.carry),
            ff: sum(|module| module.ff),
            ram: sum(|module| module.ram),
            distributed: sum(|module| module.distributed),
            products: sum(|module| module.products),
            lone_ff: sum(|module| module.lone_ff),
            lone_carry: sum(|module| module.lone_carry),
            path: self.longest(found),
        }
    }

    /// The longest way from register to register, through as many modules as it takes.
    fn longest(&self, modules: &[&Module]) -> Path {
        let mut arrivals = Arrivals {
            composed: self,
            modules,
            known: vec![None; self.outputs[self.modules.len()]],
            ways: Vec::new(),
        };
        let mut longest: Option<Way> = None;
        for (place, found) in modules.iter().enumerate() {
            longer(&mut longest, found.ways.within);
            for (input, end) in &found.ways.ends {
                if let Some(way) = arrivals.at(self.source(place, *input as usize)) {
                    longer(&mut longest, way.then(end));
                }
            }
        }
        let outputs = self.takers.iter().enumerate().filter(|(_, taker)| **taker == 0);
        for (output, _) in outputs {
            if let Some(way) = arrivals.at(Source::Of(0, output as u32)) {
                longer(&mut longest, way);
            }
        }
        longest.unwrap_or_default().path
    }
}

/// The longest ways to bits, each worked out once.
struct Arrivals<'c> {
    composed: &'c Composed<'c>,
    modules: &'c [&'c Module],
    /// By output of all modules: the place of its way among `ways`, once it is known.
    known: Vec<Option<NonZeroU32>>,
    ways: Vec<Option<Way>>,
}

impl Arrivals<'_> {
    fn at(&mut self, source: Source) -> Option<Way> {
        let Source::Of(module, mut output) = source else { return Some(Way::default()) };
        let Composed { outputs, gives, .. } = self.composed;
        let slot = outputs[module as usize] + output as usize;
        if let Some(place) = self.known[slot] {
            return self.ways[place.get() as usize - 1];
        }
        match gives[module as usize][output as usize] {
            Gives::Constant(_) => return None,
            Gives::Input(input) => {
                return self.at(self.composed.source(module as usize, input as usize));
            }
            Gives::Same(other) => output = other,
            Gives::Own => {}
        }
        let ways = &self.modules[module as usize].ways;
        let mut longest = ways.begins.get(&output).copied();
        for (input, through) in ways.through.get(&output).into_iter().flatten() {
            if let Some(way) = self.at(self.composed.source(module as usize, *input as usize)) {
                longer(&mut longest, way.then(through));
            }
        }
        self.ways.push(longest);
        self.known[slot] = NonZeroU32::new(self.ways.len() as u32);
        longest
    }
}
