//! A running netlist beside the model: sets inputs, compares ports, counts what was compared.

use std::fmt;
use std::sync::Arc;

use edgewalk_netlist::{BuildErrors, InputId, Netlist, SignalId, SimError, Simulator};

use super::tokens::Field;

/// Where a netlist first departs from the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The unit whose output it is.
    pub unit: &'static str,
    /// The port.
    pub port: String,
    /// Clocks since the start.
    pub cycle: u64,
    /// Triangles taken in by then; the last of them is in SETUP, earlier ones are further on.
    pub triangle: u64,
    /// What the model has there.
    pub model: i128,
    /// What the netlist has there.
    pub netlist: i128,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference { unit, port, cycle, triangle, model, netlist } = self;
        write!(
            f,
            "{unit}.{port} in cycle {cycle}, {triangle} triangles taken: model {model}, netlist {netlist}"
        )
    }
}

/// Why a comparison ended early.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The netlist is not what the model says.
    Difference(Difference),
    /// A port that the netlist does not have.
    Port(SimError),
    /// The netlist cannot be built.
    Build(BuildErrors),
    /// The machine did not come to rest in so many cycles.
    Busy(u64),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Difference(difference) => difference.fmt(f),
            Failure::Port(error) => {
                write!(f, "the netlist does not have the ports of the specification: {error}")
            }
            Failure::Build(errors) => errors.fmt(f),
            Failure::Busy(cycles) => write!(f, "still busy after {cycles} cycles"),
        }
    }
}

impl From<SimError> for Failure {
    fn from(error: SimError) -> Failure {
        Failure::Port(error)
    }
}

impl From<BuildErrors> for Failure {
    fn from(errors: BuildErrors) -> Failure {
        Failure::Build(errors)
    }
}

/// A netlist under comparison.
pub struct Probe {
    sim: Simulator,
    /// Clocks since the start.
    pub cycle: u64,
    /// Triangles taken in.
    pub triangle: u64,
    /// Values compared.
    pub compared: u64,
}

/// A single port.
pub struct Port {
    unit: &'static str,
    name: String,
    signal: SignalId,
}

/// The fields of a channel, in the order of the function in [`super::tokens`].
pub struct Channel(Vec<Port>);

/// The input fields of a channel.
pub struct InputChannel(Vec<InputId>);

impl Probe {
    /// The netlist at its start.
    pub fn new(built: Result<Arc<Netlist>, BuildErrors>) -> Result<Probe, Failure> {
        Ok(Probe { sim: Simulator::new(&*built?), cycle: 0, triangle: 0, compared: 0 })
    }

    /// An input.
    pub fn input(&self, name: &str) -> Result<InputId, Failure> {
        Ok(self.sim.input(name)?)
    }

    /// The inputs `<channel>_<field>`.
    pub fn input_channel(&self, channel: &str, fields: &[Field]) -> Result<InputChannel, Failure> {
        let input = |(name, _): &Field| self.input(&format!("{channel}_{name}"));
        Ok(InputChannel(fields.iter().map(input).collect::<Result<_, _>>()?))
    }

    /// A port of `unit`, at `path` in the netlist.
    pub fn port(&self, unit: &'static str, name: &str, path: &str) -> Result<Port, Failure> {
        Ok(Port { unit, name: name.to_owned(), signal: self.sim.signal(path)? })
    }

    /// The ports `<channel>_<field>` of `unit`, each at its path after `prefix`.
    pub fn channel(
        &self,
        unit: &'static str,
        prefix: &str,
        channel: &str,
        fields: &[Field],
    ) -> Result<Channel, Failure> {
        let port = |(name, _): &Field| {
            let name = format!("{channel}_{name}");
            self.port(unit, &name, &format!("{prefix}{name}"))
        };
        Ok(Channel(fields.iter().map(port).collect::<Result<_, _>>()?))
    }

    /// Sets an input to a number, negative ones in two's complement.
    pub fn set(&mut self, input: InputId, value: impl Into<i128>) {
        self.sim.set(input, value.into() as u128);
    }

    /// Sets all inputs of a channel.
    pub fn set_channel(&mut self, channel: &InputChannel, fields: &[Field]) {
        for (input, (_, value)) in channel.0.iter().zip(fields) {
            self.set(*input, *value);
        }
    }

    /// Compares a port with the model's number; a negative one is two's complement of the port's width.
    pub fn check(&mut self, port: &Port, model: impl Into<i128>) -> Result<(), Failure> {
        let model = model.into();
        let unused = 128 - self.sim.width(port.signal);
        let bits = self.sim.value(port.signal);
        let netlist = if model < 0 { ((bits << unused) as i128) >> unused } else { bits as i128 };
        self.compared += 1;
        if netlist == model {
            return Ok(());
        }
        let (unit, port) = (port.unit, port.name.clone());
        let (cycle, triangle) = (self.cycle, self.triangle);
        Err(Failure::Difference(Difference { unit, port, cycle, triangle, model, netlist }))
    }

    /// Compares all ports of a channel.
    pub fn check_channel(&mut self, channel: &Channel, fields: &[Field]) -> Result<(), Failure> {
        channel.0.iter().zip(fields).try_for_each(|(port, (_, model))| self.check(port, *model))
    }

    /// A clock edge.
    pub fn tick(&mut self) {
        self.sim.tick();
        self.cycle += 1;
    }

    /// What the netlist has at a port.
    pub fn value(&mut self, port: &Port) -> u128 {
        self.sim.value(port.signal)
    }

    /// A clock with `rst` high; nothing is compared before it.
    pub fn reset(&mut self) -> Result<(), Failure> {
        let rst = self.input("rst")?;
        self.set(rst, true);
        self.tick();
        self.set(rst, false);
        Ok(())
    }

    /// Compares all words of a memory.
    pub fn check_words(
        &mut self,
        unit: &'static str,
        path: &str,
        model: impl Fn(u32) -> u128,
    ) -> Result<(), Failure> {
        for (addr, word) in self.sim.memory(path)?.iter().enumerate() {
            let (model, netlist) = (model(addr as u32) as i128, *word as i128);
            if model != netlist {
                let (port, cycle, triangle) = (format!("{path}[{addr}]"), self.cycle, self.triangle);
                return Err(Failure::Difference(Difference { unit, port, cycle, triangle, model, netlist }));
            }
            self.compared += 1;
        }
        Ok(())
    }
}
