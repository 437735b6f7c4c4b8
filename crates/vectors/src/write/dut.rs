//! What the manifest says of a user's design.

use crate::dut::{Compare, Ends, Wire, Wiring};
use crate::manifest::{DutInfo, Place, ResetInfo};
use edgewalk_lockstep::{Interface, Link, Port};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// All that a bench in any language needs to drive it.
pub fn info(interface: &Interface, wiring: &Wiring) -> DutInfo {
    let dut = &wiring.dut;
    let mut places = Places::default();
    for (link, ends) in interface.links.iter().zip(&wiring.links) {
        places.link(link, ends);
    }
    let single = interface.constants.iter().zip(&wiring.constants);
    let single = single.chain(interface.levels.iter().zip(&wiring.levels));
    let status = interface.status.iter().map(|status| &status.port).zip(&wiring.status);
    single.chain(status).for_each(|(port, wire)| places.add(port, wire));
    let names = |paths: &[PathBuf]| paths.iter().map(|path| path.display().to_string()).collect();
    DutInfo {
        top: dut.top.clone(),
        files: names(&dut.files),
        include: names(&dut.include),
        clock: dut.clock.clone(),
        reset: ResetInfo {
            port: dut.reset.port.clone(),
            active: if dut.reset.active_low { "low" } else { "high" }.to_owned(),
            kind: if dut.reset.asynchronous { "asynchronous" } else { "synchronous" }.to_owned(),
            cycles: dut.reset.cycles,
        },
        compare: if dut.compare == Compare::Order { "order" } else { "cycle" }.to_owned(),
        parameters: dut.parameters.iter().cloned().collect(),
        tie: dut.tie.iter().cloned().collect(),
        ports: places.ports,
        absent: places.absent,
        memories: dut.memories.clone(),
    }
}

/// Clock and reset of the design in words.
pub fn clock_and_reset(wiring: &Wiring) -> (String, String) {
    let reset = &wiring.dut.reset;
    let kind = if reset.asynchronous { "asynchronous" } else { "synchronous" };
    let level = if reset.active_low { "low" } else { "high" };
    (format!("{}, rising edge", wiring.dut.clock), format!("{}, {kind}, active {level}", reset.port))
}

#[derive(Default)]
struct Places {
    ports: BTreeMap<String, Place>,
    absent: Vec<String>,
}

impl Places {
    fn link(&mut self, link: &Link, ends: &Ends) {
        let one = |port: &String| Place { port: port.clone(), lsb: 0, width: 1 };
        match &ends.valid {
            Some(valid) => _ = self.ports.insert(format!("{}_valid", link.name), one(valid)),
            None => self.absent.push(format!("{}_valid", link.name)),
        }
        match &ends.ready {
            Some(ready) => _ = self.ports.insert(format!("{}_ready", link.name), one(ready)),
            None => self.absent.push(format!("{}_ready", link.name)),
        }
        link.fields.iter().zip(&ends.fields).for_each(|(port, wire)| self.add(port, wire));
        let Some(packed) = &ends.packed else { return };
        let mut lsb = 0;
        for place in packed.order.iter().rev() {
            let field = &link.fields[*place];
            let width = field.width();
            self.ports.insert(field.name.clone(), Place { port: packed.name.clone(), lsb, width });
            lsb += width;
        }
    }

    fn add(&mut self, port: &Port, wire: &Wire) {
        match wire {
            Wire::Port { name, above } => {
                let place = Place { port: name.clone(), lsb: 0, width: port.width() + above };
                self.ports.insert(port.name.clone(), place);
            }
            Wire::Packed => {}
            Wire::Absent => self.absent.push(port.name.clone()),
        }
    }
}
