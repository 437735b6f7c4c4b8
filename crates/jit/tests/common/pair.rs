//! The interpreter and native code side by side.

use edgewalk_netlist::{Netlist, Simulate};

/// Both simulators of one netlist, with all that can be compared.
pub struct Pair {
    name: String,
    wanted: edgewalk_netlist::Simulator,
    found: edgewalk_jit::Simulator,
    signals: Vec<(String, edgewalk_netlist::SignalId, edgewalk_jit::SignalId)>,
    outputs: Vec<(edgewalk_netlist::SignalId, edgewalk_jit::OutputId)>,
    memories: Vec<String>,
    /// Values compared so far.
    pub compared: u64,
}

impl Pair {
    pub fn new(netlist: &Netlist) -> Pair {
        let wanted = edgewalk_netlist::Simulator::new(netlist);
        let found = edgewalk_jit::Simulator::new(netlist).unwrap();
        let paths: Vec<String> = wanted.signals().map(|(path, _)| path.to_owned()).collect();
        assert_eq!(found.paths().collect::<Vec<_>>(), paths);
        let ids = |path: String| {
            let ids = (wanted.signal(&path).unwrap(), found.signal(&path).unwrap());
            assert_eq!(wanted.width(ids.0), found.width(ids.1), "{path}");
            (path, ids.0, ids.1)
        };
        let signals = paths.into_iter().map(ids).collect();
        let outputs = netlist.outputs.iter();
        let outputs =
            outputs.map(|o| (wanted.signal(&o.name).unwrap(), found.output(&o.name).unwrap())).collect();
        let mut memories = Vec::new();
        memories_of(netlist, "", &mut memories);
        Pair { name: netlist.name.clone(), wanted, found, signals, outputs, memories, compared: 0 }
    }

    pub fn set(&mut self, input: &str, value: u128) {
        self.wanted.set_input(input, value).unwrap();
        let input = self.found.input(input).unwrap();
        Simulate::set(&mut self.found, input, value);
    }

    /// An output in this cycle, as the interpreter has it.
    #[allow(dead_code, reason = "not every test drives by a rig")]
    pub fn output(&mut self, name: &str) -> u128 {
        let output = self.wanted.signal(name).unwrap();
        self.wanted.value(output)
    }

    /// The outputs in this cycle, as the interpreter has them.
    pub fn outputs(&mut self) -> Vec<u128> {
        self.outputs.iter().map(|(wanted, _)| self.wanted.value(*wanted)).collect()
    }

    /// Every signal and every word of every memory.
    pub fn compare(&mut self, cycle: u64) {
        for (path, wanted, found) in &self.signals {
            // As drivers of any simulator ask.
            let (wanted, found) = (self.wanted.value(*wanted), Simulate::value(&mut self.found, *found));
            assert_eq!(found, wanted, "{} cycle {cycle} {path}", self.name);
        }
        for path in &self.memories {
            let wanted = self.wanted.memory(path).unwrap();
            assert_eq!(self.found.memory(path).unwrap(), wanted, "{} cycle {cycle} {path}", self.name);
            self.compared += wanted.len() as u64;
        }
        self.compared += self.signals.len() as u64;
    }

    /// A clock, and what native code saw at the outputs just before it.
    pub fn tick(&mut self, cycle: u64) {
        let wanted = self.outputs();
        self.wanted.tick();
        self.found.tick();
        let found: Vec<u128> = self.outputs.iter().map(|(_, output)| self.found.sampled(*output)).collect();
        assert_eq!(found, wanted, "{} cycle {cycle}: the outputs before the clock", self.name);
        self.compared += wanted.len() as u64;
    }
}

fn memories_of(netlist: &Netlist, prefix: &str, paths: &mut Vec<String>) {
    paths.extend(netlist.memories.iter().map(|memory| format!("{prefix}{}", memory.name)));
    for instance in &netlist.instances {
        memories_of(&instance.module, &format!("{prefix}{}.", instance.name), paths);
    }
}
