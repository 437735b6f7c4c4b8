//! Power of the gates while a frame is drawn.
//!
//! Each transition of a net takes energy at three places:
//!
//! | place | energy |
//! |---|---|
//! | the net | half of the capacitance of all pins on it, times the square of the voltage; counted at the cell that drives it |
//! | within the cell that drives it | the library's table, at the net's load and the transition time of the input that was the cause |
//! | within each cell that reads it | the library's table, at the net's transition time |
//!
//! Where several inputs change together with an output, each has its share by how often it did so. The clock moves twice a
//! cycle; its net is counted at the flip-flops. Nets that the design's ports drive are not counted: others drive them.

use super::cell::{Cell, Energy, Pin};
use super::gate_run::GateRun;
use super::gates::{Gates, JOINTS, UnitArea};
use super::library::{Library, Units};
use edgewalk_tool::Stop;
use serde::Serialize;
use std::collections::BTreeMap;

/// Power of a design at a clock.
#[derive(Clone, Debug, Serialize)]
pub struct Power {
    /// Watts in all.
    pub watts: f64,
    /// Of these, watts that flow without any transition.
    pub leakage_watts: f64,
    /// Of these, watts for the clock: its net and what moves with it in the flip-flops.
    pub clock_watts: f64,
    /// Of the clock's watts, those of cycles in which no flip-flop of the unit moves: what a clock that stops for such a unit
    /// would not take.
    pub still_watts: f64,
    /// Of these, watts for the other transitions at flip-flops: their inputs, their outputs, and the nets these drive.
    pub flip_flop_watts: f64,
    /// Of these, watts for the transitions of gates and the nets they drive.
    pub gate_watts: f64,
    /// Transitions of all nets a cycle, without the clock.
    pub transitions: f64,
    /// Flip-flops whose values are those of the netlist; the others' are computed from the gates.
    pub counted: u64,
    /// Outputs and next states of flip-flops that were compared with the netlist, cycle by cycle; all are equal.
    pub compared: u64,
    /// Watts of each unit; `joints` is what joins them.
    pub units: Vec<UnitPower>,
}

/// Power of a unit.
#[derive(Clone, Debug, Serialize)]
pub struct UnitPower {
    /// Name of the unit.
    pub unit: String,
    /// Watts of the unit.
    pub watts: f64,
    /// Of these, watts for the clock.
    pub clock_watts: f64,
    /// Share of the cycles in which none of its flip-flops moves; null if it has none.
    pub still: Option<f64>,
}

/// What is charged, by its cause, J.
#[derive(Default)]
pub(super) struct Joules {
    pub clock: f64,
    pub flip_flops: f64,
    pub gates: f64,
}

/// Power of the run at a clock of that period, ns.
///
/// # Errors
/// The gates gave an output or a flip-flop another value than the netlist.
pub fn power(gates: &Gates, library: &Library, run: &GateRun, period: f64) -> Result<Power, Stop> {
    let (flat, counts) = run.counted();
    if let Some((bit, cycle)) = &counts.differs {
        let line = format!("its gates give {bit} another value than the netlist in cycle {cycle}");
        return Err(Stop::Broken { tool: "yosys".to_owned(), lines: vec![line] });
    }
    let units = library.units;
    let (loads, slews) = flat.surroundings(gates, library);
    let cycles = counts.cycles as f64;
    let mut all = Joules::default();
    let mut leakage = 0.0;
    // Watts, and those of the clock.
    let mut watts: BTreeMap<&str, [f64; 2]> = BTreeMap::new();
    let seconds = cycles * period * 1e-9;
    for (of, causes) in flat.cells.iter().zip(&counts.causes) {
        let joules = spent(of.cell, &of.nets, &counts.transitions, causes, cycles, (&loads, &slews), units);
        let leaks = of.cell.leakage * units.watts;
        leakage += leaks;
        let unit = watts.entry(&of.unit).or_default();
        unit[0] += (joules.clock + joules.flip_flops + joules.gates) / seconds + leaks;
        unit[1] += joules.clock / seconds;
        all.clock += joules.clock;
        all.flip_flops += joules.flip_flops;
        all.gates += joules.gates;
    }
    let [clock_watts, flip_flop_watts, gate_watts] =
        [all.clock, all.flip_flops, all.gates].map(|joules| joules / seconds);
    let unit = |area: &UnitArea| {
        let name = if area.unit == JOINTS { "" } else { &area.unit };
        let [watts, clock_watts] = watts.get(name).copied().unwrap_or_default();
        let still = counts.still.get(name).map(|still| *still as f64 / (cycles - 1.0));
        UnitPower { unit: area.unit.clone(), watts, clock_watts, still }
    };
    let units: Vec<UnitPower> = gates.placeless.units.iter().map(unit).collect();
    Ok(Power {
        watts: clock_watts + flip_flop_watts + gate_watts + leakage,
        leakage_watts: leakage,
        clock_watts,
        still_watts: units.iter().map(|unit| unit.clock_watts * unit.still.unwrap_or(0.0)).sum(),
        flip_flop_watts,
        gate_watts,
        transitions: counts.transitions.iter().sum::<u64>() as f64 / cycles,
        counted: counts.known,
        compared: counts.compared,
        units,
    })
}

/// What a cell at these nets takes in the whole run.
pub(super) fn spent(
    cell: &Cell,
    nets: &[usize],
    transitions: &[u64],
    causes: &[u64],
    cycles: f64,
    (loads, slews): (&[f64], &[[f64; 2]]),
    units: Units,
) -> Joules {
    let clock = cell.register.as_ref().map(|register| register.clock);
    // The mean of rise and fall: a net does both equally often.
    let half = |energy: &Energy, load: f64, [rises, falls]: [f64; 2]| {
        let [rise, fall] = match energy.along {
            Some(true) => [rises, falls],
            Some(false) => [falls, rises],
            None => [(rises + falls) / 2.0; 2],
        };
        (energy.rise.at(load, rise) + energy.fall.at(load, fall)) / 2.0 * units.joules
    };
    let charged = |capacitance: f64| capacitance * units.farads * units.volts * units.volts / 2.0;
    let (mut for_clock, mut others) = (0.0, 0.0);
    let mut counts = causes;
    for (place, (Pin { capacitance, energies, .. }, net)) in cell.pins.iter().zip(nets).enumerate() {
        let count;
        (count, counts) = counts.split_at(energies.len());
        if Some(place) == clock {
            // An edge up and one down in every cycle; without a tree its transition time is 0.
            let within: f64 = energies.iter().map(|energy| half(energy, 0.0, [0.0; 2])).sum();
            for_clock += 2.0 * cycles * (within + charged(*capacitance));
        } else if place < cell.inputs {
            let each = energies.iter().zip(count);
            others += each.map(|(energy, count)| *count as f64 * half(energy, 0.0, slews[*net])).sum::<f64>();
        } else {
            let moves = transitions[*net] as f64;
            let together: u64 = count.iter().sum();
            let share = |(energy, count): (&Energy, &u64)| {
                let slew = energy.cause.map_or([0.0; 2], |cause| slews[nets[cause]]);
                *count as f64 / together.max(1) as f64 * half(energy, loads[*net], slew)
            };
            let within: f64 = energies.iter().zip(count).map(share).sum();
            others += moves * (within + charged(loads[*net]));
        }
    }
    match clock {
        Some(_) => Joules { clock: for_clock, flip_flops: others, gates: 0.0 },
        None => Joules { clock: 0.0, flip_flops: 0.0, gates: others },
    }
}
