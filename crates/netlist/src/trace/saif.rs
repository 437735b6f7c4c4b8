//! SAIF: how often and how long each bit was 1, for tools that compute power from it (IEEE 1801, annex I).

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::watch::{CYCLE, Scope, Watch, everything};
use crate::simulate::Simulator;

/// A count of transitions being taken; the file is written at the end.
///
/// The file has a `NET` entry for every bit of every named signal that can change. `T0` and `T1` are the nanoseconds at 0 and
/// at 1, `TC` the transitions. Signals are seen once a cycle, so glitches within a cycle are not counted.
pub struct SaifTrace<W: Write> {
    out: W,
    scope: Scope,
    watch: Watch,
    nets: Vec<Net>,
    /// The instance of the top module that computes each signal, by place; empty for the top module.
    units: Vec<String>,
}

/// What was counted of a signal.
#[derive(Clone, Debug, Default)]
struct Net {
    /// Transitions of each bit, the lowest first.
    transitions: Vec<u64>,
    /// Cycles at 1 of each bit, up to `since`.
    high: Vec<u64>,
    value: u128,
    /// The cycle in which the value appeared.
    since: u64,
}

/// Transitions of the signals that one unit computes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitTransitions {
    /// The instance in the top module; empty for the top module itself.
    pub unit: String,
    /// Bits of its named signals that can change.
    pub bits: u64,
    /// Transitions of all these bits, in the whole run.
    pub transitions: u64,
}

impl<W: Write> SaifTrace<W> {
    /// Counts nothing yet; `top` is the name of the outermost instance in the file.
    pub fn new(out: W, sim: &Simulator, top: &str) -> Self {
        let (scope, watch) = everything(sim, top, &[]);
        let net = |width: &u32| {
            let zeros = vec![0; *width as usize];
            Net { transitions: zeros.clone(), high: zeros, ..Net::default() }
        };
        let nets = watch.widths().iter().map(net).collect();
        let units = watch.signals().map(|signal| sim.unit(signal).to_owned()).collect();
        SaifTrace { out, scope, watch, nets, units }
    }

    /// Counts the changes since the last sample; to be called once a cycle, before the tick.
    pub fn sample(&mut self, sim: &mut Simulator) {
        let cycle = self.watch.cycles();
        for change in self.watch.changed(sim) {
            self.nets[change.place].change(change.from, change.to, cycle);
        }
    }

    /// Writes the file, and gives the sums by unit in alphabetical order.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> io::Result<Vec<UnitTransitions>> {
        let cycles = self.watch.cycles();
        self.nets.iter_mut().for_each(|net| net.count_high(cycles));
        writeln!(self.out, "(SAIFILE\n(SAIFVERSION \"2.0\")\n(DIRECTION \"backward\")\n(DESIGN)")?;
        writeln!(self.out, "(VENDOR \"edgewalk\")\n(PROGRAM_NAME \"edgewalk\")")?;
        writeln!(self.out, "(VERSION \"{}\")", env!("CARGO_PKG_VERSION"))?;
        writeln!(self.out, "(DIVIDER .)\n(TIMESCALE 1 ns)\n(DURATION {})", cycles * CYCLE)?;
        let clk = (cycles > 0).then_some((cycles * CYCLE / 2, 2 * cycles - 1));
        write_scope(&mut self.out, &self.scope, &self.nets, cycles, 0, clk)?;
        writeln!(self.out, ")")?;
        self.out.flush()?;
        let mut sums: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
        for (unit, net) in self.units.iter().zip(&self.nets) {
            let (bits, transitions) = sums.entry(unit).or_default();
            *bits += net.transitions.len() as u64;
            *transitions += net.transitions.iter().sum::<u64>();
        }
        let sum = |(unit, (bits, transitions)): (&str, (u64, u64))| UnitTransitions {
            unit: unit.to_owned(),
            bits,
            transitions,
        };
        Ok(sums.into_iter().map(sum).collect())
    }
}

impl Net {
    /// The first value of a run comes `from` none: no transition.
    fn change(&mut self, from: Option<u128>, to: u128, cycle: u64) {
        if let Some(from) = from {
            self.count_high(cycle);
            let bits = self.transitions.iter_mut().enumerate();
            bits.for_each(|(bit, count)| *count += ((from ^ to) >> bit & 1) as u64);
        }
        (self.value, self.since) = (to, cycle);
    }

    /// Adds the cycles since the last change.
    fn count_high(&mut self, cycle: u64) {
        let bits = self.high.iter_mut().enumerate();
        bits.for_each(|(bit, count)| *count += (self.value >> bit & 1) as u64 * (cycle - self.since));
        self.since = cycle;
    }
}

/// An instance with its nets and the instances in it. `clk`: nanoseconds at 1 and transitions of the clock, in the top module.
fn write_scope(
    out: &mut impl Write,
    scope: &Scope,
    nets: &[Net],
    cycles: u64,
    depth: usize,
    clk: Option<(u64, u64)>,
) -> io::Result<()> {
    let indent = "  ".repeat(depth);
    writeln!(out, "{indent}(INSTANCE {}", scope.name)?;
    if !scope.variables.is_empty() || clk.is_some() {
        writeln!(out, "{indent}  (NET")?;
        if let Some((high, transitions)) = clk {
            write_net(out, &indent, "clk", cycles * CYCLE - high, high, transitions)?;
        }
        for (name, place) in &scope.variables {
            let net = &nets[*place];
            for (bit, (transitions, high)) in net.transitions.iter().zip(&net.high).enumerate() {
                let name = if net.high.len() == 1 { name.clone() } else { format!("{name}\\[{bit}\\]") };
                write_net(out, &indent, &name, (cycles - high) * CYCLE, high * CYCLE, *transitions)?;
            }
        }
        writeln!(out, "{indent}  )")?;
    }
    for inner in &scope.scopes {
        write_scope(out, inner, nets, cycles, depth + 1, None)?;
    }
    writeln!(out, "{indent})")
}

fn write_net(out: &mut impl Write, indent: &str, name: &str, t0: u64, t1: u64, tc: u64) -> io::Result<()> {
    writeln!(out, "{indent}    ({name} (T0 {t0}) (T1 {t1}) (TX 0) (TC {tc}) (IG 0))")
}
