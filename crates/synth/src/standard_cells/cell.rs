//! A cell of the library: its function, its capacitances, and the energies of its transitions.

use super::function::table;
use super::liberty::{Group, Wrong};
use super::table::Table;

/// A cell whose value and energy can be computed.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// The pins: first the inputs, then the outputs.
    pub pins: Vec<Pin>,
    /// How many of the pins are inputs: at most six.
    pub inputs: usize,
    /// The flip-flop, if there is one.
    pub register: Option<Register>,
    /// Power without any transition, in the library's units.
    pub leakage: f64,
}

/// A pin of a cell.
#[derive(Clone, Debug)]
pub(super) struct Pin {
    pub name: String,
    /// In the library's units.
    pub capacitance: f64,
    /// Of an output: its truth table over the inputs, or over the flip-flop's state alone.
    pub function: u64,
    /// Energies within the cell.
    pub energies: Vec<Energy>,
}

/// A flip-flop of the rising clock edge.
#[derive(Clone, Debug)]
pub(super) struct Register {
    /// The place of its clock among the inputs.
    pub clock: usize,
    /// The truth table of its next state over the inputs.
    pub next: u64,
}

/// Energy of a transition of a pin, within the cell.
#[derive(Clone, Debug)]
pub(super) struct Energy {
    /// The input whose transition is the cause; none where the pin itself is an input.
    pub cause: Option<usize>,
    /// Whether the cause rises where the pin rises; none where it may do either.
    pub along: Option<bool>,
    /// The truth table, over the inputs, of the states in which it is this much.
    pub when: Option<u64>,
    pub rise: Table,
    pub fall: Table,
}

/// Why a cell cannot be in a design whose energy is computed.
pub(super) enum Unusable {
    /// The file is wrong.
    Wrong(Wrong),
    /// What the cell has or lacks.
    Kind(&'static str),
}

impl From<Wrong> for Unusable {
    fn from(wrong: Wrong) -> Unusable {
        Unusable::Wrong(wrong)
    }
}

impl Cell {
    /// Reads `cell (NAME) { ... }`.
    pub fn read(cell: &Group, library: &Group) -> Result<Cell, Unusable> {
        for (kind, what) in [("latch", "is a latch"), ("statetable", "has a table of states")] {
            if cell.of(kind).next().is_some() {
                return Err(Unusable::Kind(what));
            }
        }
        let pins = |direction: &str| {
            let of =
                cell.of("pin").filter(|pin| pin.value("direction").is_some_and(|(of, _)| of == direction));
            of.collect::<Vec<_>>()
        };
        let (inputs, outputs) = (pins("input"), pins("output"));
        let names: Vec<&str> = inputs.iter().map(|pin| pin.name()).collect();
        if names.len() > 6 {
            return Err(Unusable::Kind("has more than six inputs"));
        }
        let flip_flop = cell.of("ff").next();
        let register =
            match flip_flop {
                None => None,
                Some(of) => Some(Register::read(of, &names).ok_or(Unusable::Kind(
                    "is no flip-flop of the rising clock edge without set and reset",
                ))?),
            };
        let mut read = Vec::new();
        for pin in inputs.iter().chain(&outputs) {
            let function = match (pin.value("function"), flip_flop) {
                (None, _) => 0, // of an input
                (Some((function, _)), None) => table(function, &names)
                    .ok_or(Unusable::Kind("has an output that is no function of its inputs"))?,
                (Some((function, _)), Some(of)) => of
                    .names
                    .iter()
                    .zip([false, true])
                    .find_map(|(state, inverse)| {
                        let of_state = table(function, &[state])?;
                        // The second name is that of the inverse.
                        Some(if inverse { of_state >> 1 & 1 | of_state << 1 & 2 } else { of_state })
                    })
                    .ok_or(Unusable::Kind("has an output that is no function of its state"))?,
            };
            if outputs.iter().any(|output| output.name() == pin.name()) && pin.value("function").is_none() {
                return Err(Unusable::Kind("has an output without a function"));
            }
            let mut energies = Vec::new();
            for of in pin.of("internal_power") {
                energies.append(&mut Energy::read(of, &names, function, library)?);
            }
            let capacitance = number(pin, "capacitance")?.unwrap_or(0.0);
            read.push(Pin { name: pin.name().to_owned(), capacitance, function, energies });
        }
        let leakage = number(cell, "cell_leakage_power")?.unwrap_or(0.0);
        Ok(Cell { pins: read, inputs: names.len(), register, leakage })
    }
}

impl Cell {
    /// The place of the pin at which the state of a flip-flop, or else its inverse, is seen.
    pub fn state(&self) -> Option<usize> {
        let shows = |function: u64| {
            let outputs = self.pins.iter().enumerate().skip(self.inputs);
            outputs.filter(|(_, pin)| pin.function == function).map(|(place, _)| place).next()
        };
        self.register.as_ref()?;
        shows(0b10).or_else(|| shows(0b01))
    }
}

impl Register {
    fn read(of: &Group, inputs: &[&str]) -> Option<Register> {
        let bare = |key: &str| {
            let (value, _) = of.value(key)?;
            Some(value.trim_matches(|c: char| c.is_whitespace() || "()".contains(c)))
        };
        if of.value("clear").is_some() || of.value("preset").is_some() {
            return None;
        }
        let clock = bare("clocked_on")?;
        Some(Register {
            clock: inputs.iter().position(|input| *input == clock)?,
            next: table(of.value("next_state")?.0, inputs)?,
        })
    }
}

impl Energy {
    /// Reads `internal_power () { ... }` of a pin with this function: one for each related pin.
    fn read(of: &Group, inputs: &[&str], function: u64, library: &Group) -> Result<Vec<Energy>, Unusable> {
        let read = |kind: &str| of.of(kind).next().map(|table| Table::read(table, library)).transpose();
        let both = read("power")?;
        let [rise, fall] = [read("rise_power")?, read("fall_power")?].map(|one| one.or_else(|| both.clone()));
        let (Some(rise), Some(fall)) = (rise, fall) else {
            let what = "has neither `power` nor both of `rise_power` and `fall_power`".to_owned();
            return Err(Wrong { line: of.line, what: format!("`internal_power` {what}") }.into());
        };
        let when = match of.value("when") {
            None => None,
            Some((when, _)) => Some(
                table(when, inputs)
                    .ok_or(Unusable::Kind("has an energy that does not depend on its inputs"))?,
            ),
        };
        let causes = of.value("related_pin").map_or("", |(pins, _)| pins).split_whitespace();
        let causes: Vec<usize> =
            causes.filter_map(|cause| inputs.iter().position(|input| *input == cause)).collect();
        let energy = |cause: Option<usize>| {
            let along = match cause {
                Some(cause) => along(function, inputs.len(), cause),
                None => Some(true), // the pin itself
            };
            Energy { cause, along, when, rise: rise.clone(), fall: fall.clone() }
        };
        Ok(match causes.is_empty() {
            true => vec![energy(None)],
            false => causes.into_iter().map(|cause| energy(Some(cause))).collect(),
        })
    }
}

/// Whether a function of inputs rises wherever it moves with a rising input, or falls wherever it does.
fn along(function: u64, inputs: usize, input: usize) -> Option<bool> {
    let low = (0..1_u32 << inputs).filter(|state| state >> input & 1 == 0);
    let pairs = low.map(|state| [state, state | 1 << input].map(|state| function >> state & 1));
    let moves: Vec<bool> = pairs.filter(|[low, high]| low != high).map(|[low, high]| low < high).collect();
    moves.first().copied().filter(|first| moves.iter().all(|other| other == first))
}

/// A number of a group.
pub(super) fn number(of: &Group, key: &str) -> Result<Option<f64>, Wrong> {
    let Some((value, line)) = of.value(key) else { return Ok(None) };
    match value.parse().ok().filter(|number: &f64| number.is_finite()) {
        Some(number) => Ok(Some(number)),
        None => {
            let what = format!("found {key} `{}`; a number is needed", super::liberty::cut(value));
            Err(Wrong { line, what })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::liberty::parse;
    use super::{Cell, Unusable};

    const LIBRARY: &str = "library (l) { power_lut_template (scalar) { }
        cell (FF) { cell_leakage_power : 7; ff (I, N) { next_state : \"E * D\"; clocked_on : \"C\"; }
            pin (C) { direction : input; capacitance : 3; }
            pin (D) { direction : input; }
            pin (E) { direction : input; }
            pin (INV) { direction : output; function : \"N\"; }
            pin (OUT) { direction : output; function : \"(I)\"; } }
        cell (AO) { pin (A) { direction : input; } pin (B) { direction : input; } pin (S) { direction : input; }
            pin (Y) { direction : output; function : \"!A S + B !S\";
                internal_power () { related_pin : \"A S\"; when : \"B\"; power (scalar) { values (\"1\"); } }
                internal_power () { related_pin : \"B\"; rise_power (scalar) { values (\"2\"); }
                    fall_power (scalar) { values (\"3\"); } } } }
        cell (L) { latch (I, N) { } }
        cell (SR) { ff (I, N) { next_state : \"D\"; clocked_on : \"C\"; clear : \"R\"; } pin (D) { direction : input; } }
        cell (Z) { pin (Y) { direction : output; } } }";

    fn read(name: &str) -> Result<Cell, Unusable> {
        let library = parse(LIBRARY).map_err(Unusable::Wrong)?;
        let cell = library.of("cell").find(|cell| cell.name() == name).expect("a cell");
        Cell::read(cell, &library)
    }

    fn readable(name: &str) -> Cell {
        read(name).unwrap_or_else(|_| panic!("{name} can be read"))
    }

    #[test]
    fn outputs_are_functions_of_the_state_or_its_inverse() {
        let cell = readable("FF");
        let names: Vec<&str> = cell.pins.iter().map(|pin| pin.name.as_str()).collect();
        assert_eq!((cell.inputs, names), (3, vec!["C", "D", "E", "INV", "OUT"]));
        assert_eq!((cell.pins[3].function, cell.pins[4].function), (0b01, 0b10));
        let register = cell.register.expect("a flip-flop");
        assert_eq!((register.clock, register.next), (0, 0b1100_0000));
        assert_eq!((cell.pins[0].capacitance, cell.leakage), (3.0, 7.0));
    }

    #[test]
    fn energies_have_their_causes_and_conditions() {
        let cell = readable("AO");
        let energies = &cell.pins[3].energies;
        let told: Vec<_> = energies
            .iter()
            .map(|of| (of.cause, of.along, of.when, of.rise.at(0.0, 0.0), of.fall.at(0.0, 0.0)))
            .collect();
        let when = Some(0b1100_1100); // states in which B is 1
        let expected = vec![
            (Some(0), Some(false), when, 1.0, 1.0),
            (Some(2), None, when, 1.0, 1.0),
            (Some(1), Some(true), None, 2.0, 3.0),
        ];
        assert_eq!(told, expected);
    }

    #[test]
    fn cells_that_no_design_has_say_why() {
        for (name, why) in [
            ("L", "is a latch"),
            ("SR", "is no flip-flop of the rising clock edge without set and reset"),
            ("Z", "has an output without a function"),
        ] {
            assert!(matches!(read(name), Err(Unusable::Kind(told)) if told == why), "{name}");
        }
    }
}
