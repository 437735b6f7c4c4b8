//! Proves by machine that a fault cannot be seen, whatever comes in.
//!
//! ```text
//!           ┌─> original ─┐
//!  inputs ──┤             ├─ differ? ─> bad      bad is never 1, from reset on: property-directed reachability
//!           └─> faulty ───┘
//! ```
//! First in one clock of the module with the fault, its instances and memories cut out, whatever its registers hold: where nothing
//! differs at the place of the fault, or in what they hold next and what comes out, nothing does ever. Then at its ports, every output in every cycle (a lane's value when it is given out), and at the place
//! of the fault, in the states that the module comes to from its first. Then at the ports of the unit, where
//! outputs count as in lock step: fields while their valid is high, a status port while it means something.
//!
//! Inputs are free in every cycle, resets too; only the constants of the interface hold their value from reset to
//! reset. Both copies begin with every register 0, run on free inputs, and are compared from their first reset on. Yosys
//! turns the two printed designs into gates; ABC (`scorr`, `pdr`) finds the invariant or the cycles to a difference.

mod cut;
mod miter;

use crate::Interface;
use cut::{alone, one_clock, without_memories};
use edgewalk_netlist::Netlist;
use edgewalk_netlist::mutate::Mutant;
use edgewalk_tool::{Stop, run};
use miter::{Ports, gives_out, miter, watch};
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::Duration;

/// Seconds of processor time that a search may take at the fault in one clock and at the ports of a module, in one clock of a module and at
/// the fault (and at those of a module without memories), and at the ports of a unit.
const LIMITS: [u32; 3] = [3, 12, 12];

/// Bits of memories that Yosys makes registers of in a time.
const MOST_BITS: usize = 1 << 12;

/// What the search found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proof {
    /// No inputs whatever make a difference.
    Equivalent,
    /// Some do.
    Differs,
    /// The search came to no end.
    Unknown,
}

/// Compares a netlist with the same netlist with a fault; `whole` in all of these ways, else in the first and once more at
/// the place of the fault, or at the ports of its module.
///
/// # Errors
/// Yosys or its ABC is missing, or broken.
pub fn prove(
    interface: &Interface,
    original: &Arc<Netlist>,
    mutant: &Mutant,
    whole: bool,
) -> Result<Proof, Stop> {
    let watched = mutant.watched(original);
    if let Some(watched) = &watched {
        let place = one_clock(&without_memories(&alone(watched, &mutant.module)));
        if never(&Ports::of_module(&place), &place, LIMITS[0])? == Proof::Equivalent {
            return Ok(Proof::Equivalent);
        }
    }
    let faulty = mutant.apply(original);
    let [one, other] = [original, &faulty].map(|netlist| alone(netlist, &mutant.module));
    // What a ROM holds stays in view when memories are cut out.
    let starts = |netlist: &Netlist| {
        let written = netlist.memories.iter().filter(|memory| !memory.writes.is_empty());
        written.map(|memory| memory.contents.clone()).collect::<Vec<_>>()
    };
    let (own, cut) = (starts(&one) == starts(&other), [&one, &other].map(without_memories));
    let [now, then] = [&cut[0], &cut[1]].map(one_clock);
    if own && search(&Ports::of_module(&now), &now, &then, LIMITS[1])? == Proof::Equivalent {
        return Ok(Proof::Equivalent);
    }
    if !whole {
        // Fewer searches: there are many faults, and of most that are left none comes to an end.
        let modules = |netlist: &Arc<Netlist>| [alone(netlist, &mutant.module), Arc::clone(netlist)];
        let places = watched.as_ref().filter(|_| own).map(modules);
        for place in places.iter().flatten().map(without_memories) {
            if never(&Ports::of_module(&place), &place, LIMITS[1])? == Proof::Equivalent {
                return Ok(Proof::Equivalent);
            }
        }
        if own && (watched.is_none() || gives_out(&cut[0])) {
            let ports = Ports::of_running_module(&cut[0]);
            if search(&ports, &cut[0], &cut[1], LIMITS[1])? == Proof::Equivalent {
                return Ok(Proof::Equivalent);
            }
        }
        // A difference there need not reach the ports of the unit.
        return Ok(Proof::Unknown);
    }
    // What is written and asked for alike comes back alike, whatever it is.
    if own && search(&Ports::of_running_module(&cut[0]), &cut[0], &cut[1], LIMITS[1])? == Proof::Equivalent {
        return Ok(Proof::Equivalent);
    }
    if let Some(watched) = watched.as_ref().filter(|_| own).map(without_memories)
        && never(&Ports::of_module(&watched), &watched, LIMITS[1])? == Proof::Equivalent
    {
        return Ok(Proof::Equivalent);
    }
    let bits = one.memories.iter().map(|memory| memory.words * memory.width as usize).sum::<usize>();
    if bits > MOST_BITS {
        return Ok(Proof::Unknown);
    }
    // Of a module without memories this has been searched for longer above.
    if !one.memories.is_empty()
        && search(&Ports::of_running_module(&one), &one, &other, LIMITS[0])? == Proof::Equivalent
    {
        return Ok(Proof::Equivalent);
    }
    let ports = Ports::of_unit(interface);
    if let Some(watched) = &watched
        && never(&ports, watched, LIMITS[1])? == Proof::Equivalent
    {
        return Ok(Proof::Equivalent);
    }
    search(&ports, original, &faulty, LIMITS[2])
}

fn search(ports: &Ports, original: &Arc<Netlist>, faulty: &Arc<Netlist>, limit: u32) -> Result<Proof, Stop> {
    let designs = [("original", original), ("faulty", faulty)];
    reaches(&designs, miter(ports, original, faulty), limit)
}

/// Whether the output of a watched netlist is never 1, from all registers 0 on.
fn never(ports: &Ports, watched: &Arc<Netlist>, limit: u32) -> Result<Proof, Stop> {
    reaches(&[("original", watched)], watch(ports, watched), limit)
}

/// Clock time after which a tool is taken for stuck.
const STUCK: Duration = Duration::from_secs(600);

/// Whether the module `miter` of these designs, in this text, ever shows `bad`.
fn reaches(designs: &[(&str, &Arc<Netlist>)], miter: String, limit: u32) -> Result<Proof, Stop> {
    let temporary = std::env::temp_dir();
    let broken = |error: &std::io::Error| Stop::file(&temporary, error);
    let place = tempfile::tempdir().map_err(|error| broken(&error))?;
    let write = |name: &str, text: String| {
        std::fs::write(place.path().join(name), text).map_err(|error| broken(&error))
    };
    let (mut read, mut copy) = (String::new(), String::new());
    for (name, netlist) in designs {
        write(&format!("{name}.v"), text(netlist))?;
        let top = &netlist.name;
        read += &format!(
            "read_verilog {name}.v; prep -flatten -top {top}; rename {top} {name}; design -stash {name}; "
        );
        copy += &format!("design -copy-from {name} {name}; ");
    }
    write("miter.v", miter)?;
    let gates = format!(
        "{read}{copy}read_verilog miter.v; \
         prep -flatten -top miter; setundef -undriven -zero; setundef -init -zero; opt -full; memory; opt -full; techmap; opt -full; \
         dffunmap; aigmap; opt_clean; write_aiger -zinit miter.aig"
    );
    tool(place.path(), "yosys", &["-Q", "-T", "-p", &gates])?;
    // Where the disk is full Yosys cuts the file and says nothing; a part of it may be proved of which the whole is false.
    let miter = place.path().join("miter.aig");
    let bytes = std::fs::read(&miter).map_err(|error| Stop::unwritten("yosys", &miter, &error))?;
    if !String::from_utf8_lossy(&bytes).contains("c\nGenerated by Yosys") {
        let line = "its miter.aig ends early; permitted: a whole file; make space if the disk of temporary files is full";
        return Err(Stop::Broken { tool: "yosys".to_owned(), lines: vec![line.to_owned()] });
    }
    // Whatever it is at when its time is over: it has found nothing then, and that is no failure.
    let find = format!(
        "command -v yosys-abc >/dev/null || {{ echo 'yosys-abc, of the package yosys, is not installed'; exit 1; }}; \
         (ulimit -t {limit}; exec yosys-abc -c 'read_aiger miter.aig; ifraig -C 10000; scorr -F 2; pdr'); :"
    );
    let printed = tool(place.path(), "sh", &["-c", &find])?;
    Ok(if printed.contains("Property proved") {
        Proof::Equivalent
    } else if printed.contains("was asserted in frame") {
        Proof::Differs
    } else {
        Proof::Unknown
    })
}

fn text(netlist: &Arc<Netlist>) -> String {
    edgewalk_verilog::print(netlist).into_iter().map(|(_, text)| text).collect()
}

/// What a tool printed.
fn tool(place: &Path, tool: &str, arguments: &[&str]) -> Result<String, Stop> {
    run(Command::new(tool).args(arguments).current_dir(place), STUCK)
}
