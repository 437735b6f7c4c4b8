//! The gates without modules: cells and the nets between them, in the order of the data.

use super::cell::Cell;
use super::gates::Gates;
use super::library::Library;
use super::written::{Bit, Module, Placed};
use edgewalk_tool::Stop;
use std::collections::{BTreeMap, HashMap};

/// The net that is always 0.
pub(super) const ZERO: usize = 0;
/// The net that is always 1.
pub(super) const ONE: usize = 1;

/// A design's cells and nets.
pub(super) struct Flat<'l> {
    /// Cells without a register, each behind those whose outputs it reads; then those with one.
    pub cells: Vec<Instance<'l>>,
    /// How many of the cells have no register.
    pub gates: usize,
    /// How many nets there are, with [`ZERO`] and [`ONE`].
    pub nets: usize,
    /// The design's input ports without the clock, and their nets.
    pub inputs: Vec<(String, usize)>,
    /// The design's output ports, and their nets.
    pub outputs: Vec<(String, usize)>,
}

/// A cell in its place.
pub(super) struct Instance<'l> {
    /// The path, as OpenSTA has it: `u_span/queue/cell_7`.
    pub path: String,
    /// The unit it belongs to; empty for what joins the units.
    pub unit: String,
    pub cell: &'l Cell,
    /// The net at each pin, in the order of the cell's pins.
    pub nets: Vec<usize>,
    /// Of a flip-flop: where its state is seen.
    pub seen: Option<Seen>,
}

/// The output at which a flip-flop's state is seen.
pub(super) struct Seen {
    /// The output's place among the cell's pins.
    pub pin: usize,
    /// Names of its bit: `u_span.queue.place1_z[0]`.
    pub names: Vec<String>,
    /// Where Yosys gave a state machine other codes: the states in which the bit is 1, each by the bits that the state has in the
    /// design. Empty where the bit is one of the design.
    pub states: Vec<Vec<(String, bool)>>,
}

impl<'l> Flat<'l> {
    /// Of the gates.
    ///
    /// # Errors
    /// A cell whose function is not known, or a loop of cells without a register.
    pub fn new(gates: &Gates, library: &'l Library) -> Result<Flat<'l>, Stop> {
        let mut wires = Wires { of: vec![ZERO, ONE] };
        let mut open = Open { library, modules: &gates.modules, cells: Vec::new() };
        let top = &gates.modules[&gates.top];
        let ports: BTreeMap<&str, usize> =
            top.ports.keys().map(|name| (name.as_str(), wires.fresh())).collect();
        open.module(top, "", &ports, &mut wires)?;
        let mut cells = open.cells;
        for net in cells.iter_mut().flat_map(|cell| &mut cell.nets) {
            *net = wires.root(*net);
        }
        let port = |name: &String| (name.clone(), wires.root(ports[name.as_str()]));
        let [inputs, outputs] = [&top.inputs, &top.outputs].map(|names| names.iter().map(port).collect());
        let nets = wires.of.len();
        let (cells, gates) = ordered(cells, nets)?;
        Ok(Flat { cells, gates, nets, inputs, outputs })
    }
}

/// A load for each net, and the transition times of its driver, rise and fall.
pub(super) type Surroundings = (Vec<f64>, Vec<[f64; 2]>);

impl Flat<'_> {
    /// Of each net, in the library's units. What the design's ports drive has no transition time.
    pub fn surroundings(&self, gates: &Gates, library: &Library) -> Surroundings {
        let (mut loads, mut slews) = (vec![0.0; self.nets], vec![[0.0; 2]; self.nets]);
        for of in &self.cells {
            for (place, (pin, net)) in of.cell.pins.iter().zip(&of.nets).enumerate() {
                loads[*net] += pin.capacitance;
                if place >= of.cell.inputs {
                    let slew = gates.slews.get(&format!("{}/{}", of.path, pin.name));
                    slews[*net] = slew.copied().unwrap_or_default().map(|time| time / library.units.ns);
                }
            }
        }
        (loads, slews)
    }
}

/// Nets, of which some turn out to be the same.
struct Wires {
    /// The same net with a lower number, or the net itself.
    of: Vec<usize>,
}

impl Wires {
    fn fresh(&mut self) -> usize {
        self.of.push(self.of.len());
        self.of.len() - 1
    }

    fn root(&self, mut net: usize) -> usize {
        while self.of[net] != net {
            net = self.of[net];
        }
        net
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.of[one.max(other)] = one.min(other);
    }
}

struct Open<'l, 'm> {
    library: &'l Library,
    modules: &'m BTreeMap<String, Module>,
    cells: Vec<Instance<'l>>,
}

impl Open<'_, '_> {
    /// Adds an instance of the module, at whose ports are these nets.
    fn module(
        &mut self,
        module: &Module,
        path: &str,
        ports: &BTreeMap<&str, usize>,
        wires: &mut Wires,
    ) -> Result<(), Stop> {
        let mut inner: HashMap<u64, usize> = HashMap::new();
        let mut net = |bit: &Bit, wires: &mut Wires| match bit {
            Bit::Wire(wire) => *inner.entry(*wire).or_insert_with(|| wires.fresh()),
            Bit::Constant(value) if value == "1" => ONE,
            Bit::Constant(_) => ZERO, // an undefined bit may be anything
        };
        for (port, bit) in &module.ports {
            if let Some(outer) = ports.get(port.as_str()) {
                let inner = net(bit, wires);
                wires.join(inner, *outer);
            }
        }
        let unit = path.split('/').next().unwrap_or_default().trim_start_matches("u_");
        let dotted = path.replace('/', ".");
        for Placed { name, of, pins } in &module.cells {
            let cell = self.library.cell(of)?;
            let nets = cell.pins.iter().map(|pin| match pins.get(&pin.name) {
                Some(bit) => net(bit, wires),
                None => wires.fresh(), // nothing is connected
            });
            let nets = nets.collect();
            let seen = self.library.register(of).and_then(|output| {
                let pin = cell.pins.iter().position(|pin| pin.name == output)?;
                let names = match pins.get(output) {
                    Some(Bit::Wire(wire)) => module.names.get(wire).map_or(&[][..], Vec::as_slice),
                    _ => &[],
                };
                let states = names.iter().find_map(|name| module.states(name, &dotted)).unwrap_or_default();
                Some(Seen {
                    pin,
                    names: names.iter().map(|name| format!("{dotted}{name}")).collect(),
                    states,
                })
            });
            self.cells.push(Instance {
                path: format!("{path}{name}"),
                unit: unit.to_owned(),
                cell,
                nets,
                seen,
            });
        }
        for Placed { name, of, pins } in &module.instances {
            let ports = pins.iter().map(|(port, bit)| (port.as_str(), net(bit, wires))).collect();
            self.module(&self.modules[of], &format!("{path}{name}/"), &ports, wires)?;
        }
        Ok(())
    }
}

/// The cells in the order of the data, and how many have no register.
fn ordered(cells: Vec<Instance>, nets: usize) -> Result<(Vec<Instance>, usize), Stop> {
    let (mut gates, registers): (Vec<_>, Vec<_>) =
        cells.into_iter().partition(|cell| cell.cell.register.is_none());
    let mut readers: Vec<Vec<usize>> = vec![Vec::new(); nets];
    let mut driven = vec![false; nets];
    for (place, Instance { cell, nets, .. }) in gates.iter().enumerate() {
        nets[..cell.inputs].iter().for_each(|net| readers[*net].push(place));
        nets[cell.inputs..].iter().for_each(|net| driven[*net] = true);
    }
    let waits = |gate: &Instance| gate.nets[..gate.cell.inputs].iter().filter(|net| driven[**net]).count();
    let mut waits: Vec<usize> = gates.iter().map(waits).collect();
    let mut order: Vec<usize> = (0..gates.len()).filter(|gate| waits[*gate] == 0).collect();
    let mut next = 0;
    while let Some(gate) = order.get(next) {
        next += 1;
        let Instance { cell, nets, .. } = &gates[*gate];
        for reader in nets[cell.inputs..].iter().flat_map(|net| &readers[*net]) {
            waits[*reader] -= 1;
            if waits[*reader] == 0 {
                order.push(*reader);
            }
        }
    }
    if let Some(stuck) = waits.iter().position(|waits| *waits > 0) {
        let line = format!("its gates have a loop without a register, at {}", gates[stuck].path);
        return Err(Stop::Broken { tool: "yosys".to_owned(), lines: vec![line] });
    }
    let mut rank = vec![0; gates.len()];
    order.iter().enumerate().for_each(|(at, gate)| rank[*gate] = at);
    let mut ranked: Vec<_> = gates.drain(..).zip(rank).collect();
    ranked.sort_by_key(|(_, rank)| *rank);
    let count = ranked.len();
    Ok((ranked.into_iter().map(|(gate, _)| gate).chain(registers).collect(), count))
}
