//! Which events the run of a user's design met, and which its ports do not show.

use edgewalk_machine::Plan;
use edgewalk_vectors::dut::Wiring;
use edgewalk_vectors::{Interface, Reached, Sight, sights};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Events of the unit, in all runs that passed.
#[derive(Serialize)]
pub struct Events {
    /// How often each was met.
    met: BTreeMap<&'static str, u64>,
    not_met: Vec<&'static str>,
    /// Events that cannot be seen, each with the reason.
    not_seen: BTreeMap<&'static str, String>,
}

impl Events {
    /// `runs`: what the bench counted in each run that passed, and what the model met with the same stimulus.
    pub fn of<'a>(
        machine: &Plan,
        wiring: &Wiring,
        runs: impl Iterator<Item = (&'a BTreeMap<String, u64>, &'a Reached)> + Clone,
    ) -> Events {
        let unit = wiring.dut.unit;
        let declared = unit.events(machine).into_iter().map(|event| event.name);
        let mut events = Events { met: BTreeMap::new(), not_met: Vec::new(), not_seen: BTreeMap::new() };
        for (event, sight) in sights(&Interface::new(machine, unit), wiring, declared) {
            let count: u64 = match sight {
                Sight::Tokens => runs.clone().filter_map(|(_, reached)| reached.get(event)).sum(),
                Sight::Cycles(_) => runs.clone().filter_map(|(counted, _)| counted.get(event)).sum(),
                Sight::Hidden(why) => {
                    events.not_seen.insert(event, why);
                    continue;
                }
            };
            match count {
                0 => events.not_met.push(event),
                _ => _ = events.met.insert(event, count),
            }
        }
        events
    }

    /// As lines.
    pub fn lines(&self) -> String {
        let mut text = String::new();
        let met: Vec<String> = self.met.iter().map(|(event, count)| format!("{event} {count}")).collect();
        let hidden: Vec<String> =
            self.not_seen.iter().map(|(event, why)| format!("{event} ({why})")).collect();
        let not_met = self.not_met.iter().map(|event| (*event).to_owned()).collect();
        for (head, list) in [("events met", met), ("not met", not_met), ("not to be seen", hidden)] {
            if !list.is_empty() {
                // Writing to a string cannot fail.
                _ = writeln!(text, "{head}: {}", list.join(", "));
            }
        }
        text
    }
}
