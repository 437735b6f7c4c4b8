//! The library of standard cells: one of the user's own, or OSU's for 0.18 um, as Debian packages it.
//!
//! A cell is known by its function. These are needed: a flip-flop of the rising edge without set and reset, an inverter,
//! and a NAND of two inputs, in whose area the others are counted.

use super::cell::{Cell, Unusable, number};
use super::function::table;
use super::liberty::{Group, Wrong, cut, parse};
use edgewalk_tool::Stop;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// Where the Debian package puts the library.
const INSTALLED: &str = "/usr/share/qflow/tech/osu018/osu018_stdcells.lib";
/// What installs it.
const INSTALL: &str = "apt-get install -y --no-install-recommends qflow-tech-osu018";
/// Longer files are no library of cells, bytes.
const MOST_BYTES: u64 = 256 << 20;

/// A library of cells in the Liberty format.
#[derive(Clone, Debug)]
pub struct Library {
    /// The file's text.
    pub(super) text: String,
    /// SHA-256 of the text.
    pub(super) hash: String,
    name: String,
    /// Area of each cell, um2.
    areas: BTreeMap<String, f64>,
    /// What is computed with each cell; of those that no design can have, why.
    cells: BTreeMap<String, Result<Cell, &'static str>>,
    /// What the numbers of the cells count.
    pub(super) units: Units,
    /// The smallest NAND of two inputs, and its area.
    gate: (String, f64),
    /// Name of the inverter that drives the inputs of a design.
    pub(super) inverter: String,
}

/// What numbers of a library count.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    /// The supply, V.
    pub volts: f64,
    /// A capacitance of 1, F.
    pub farads: f64,
    /// An energy of 1, J.
    pub joules: f64,
    /// A time of 1, ns.
    pub ns: f64,
    /// A leakage of 1, W.
    pub watts: f64,
}

/// A file that is no usable library.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// The file could not be opened or read.
    #[error("{file}: cannot be read")]
    Read {
        /// The file as the user named it.
        file: String,
        /// The operating system's reason.
        source: std::io::Error,
    },
    /// The format or a value is wrong.
    #[error("{file}:{line}: {what}")]
    Line {
        /// The file as the user named it.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// The fault, then the remedy.
        what: String,
    },
    /// The file as a whole is wrong, or lacks a cell that every design takes.
    #[error("{file}: {what}")]
    Whole {
        /// The file as the user named it.
        file: String,
        /// The fault, then the remedy.
        what: String,
    },
}

impl Library {
    /// The library of the system.
    ///
    /// # Errors
    /// It is not installed, or damaged.
    pub fn installed() -> Result<Library, Stop> {
        let tool = INSTALLED.to_owned();
        if !Path::new(INSTALLED).exists() {
            return Err(Stop::Missing { tool, install: INSTALL.to_owned() });
        }
        Library::read(INSTALLED.as_ref())
            .map_err(|error| Stop::Broken { tool, lines: vec![error.to_string()] })
    }

    /// Reads the file.
    ///
    /// # Errors
    /// It cannot be read, is no library in the Liberty format, or lacks a cell that every design takes.
    pub fn read(path: &Path) -> Result<Library, LibraryError> {
        let file = || path.display().to_string();
        let unread = |source| LibraryError::Read { file: file(), source };
        let whole = |what: &str| LibraryError::Whole { file: file(), what: what.to_owned() };
        let kind = std::fs::metadata(path).map_err(unread)?;
        if !kind.is_file() {
            return Err(whole("is no regular file; a library in the Liberty format is needed"));
        }
        if kind.len() > MOST_BYTES {
            return Err(whole(&format!("has {} bytes; permitted: {MOST_BYTES}", kind.len())));
        }
        let bytes = std::fs::read(path).map_err(unread)?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
            LibraryError::Line { file: file(), line, what: "is no text in UTF-8".to_owned() }
        })?;
        Library::of(text, &file())
    }

    /// Of the text of a file.
    pub(super) fn of(text: String, file: &str) -> Result<Library, LibraryError> {
        let whole = |what: &str| LibraryError::Whole { file: file.to_owned(), what: what.to_owned() };
        let at = |Wrong { line, what }| LibraryError::Line { file: file.to_owned(), line, what };
        let library = parse(&text).map_err(at)?;
        let areas = areas(&library).map_err(at)?;
        let units = Units::of(&library).map_err(at)?;
        let mut cells = BTreeMap::new();
        for cell in library.of("cell") {
            let read = match Cell::read(cell, &library) {
                Ok(read) => Ok(read),
                Err(Unusable::Kind(why)) => Err(why),
                Err(Unusable::Wrong(wrong)) => return Err(at(wrong)),
            };
            cells.insert(cell.name().to_owned(), read);
        }
        let (mut gates, mut inverters) = (Vec::new(), Vec::new());
        for cell in library.of("cell") {
            let area = areas[cell.name()]; // there: `areas` has one of each cell
            match shape(cell) {
                Some((2, 0b0111, _)) => gates.push((cell.name().to_owned(), area)),
                Some((1, 0b01, drives)) => inverters.push((cell.name(), area, drives)),
                _ => {}
            }
        }
        if !cells.values().flatten().any(|cell: &Cell| cell.state().is_some()) {
            return Err(whole("has no flip-flop of the rising clock edge without set and reset"));
        }
        gates.sort_by(|a, b| a.1.total_cmp(&b.1));
        let gate = gates.into_iter().find(|(_, area)| *area > 0.0);
        let gate =
            gate.ok_or_else(|| whole("has no NAND of two inputs with an area: areas are told in it"))?;
        // The smallest one; of several, the one that drives most.
        inverters.sort_by(|a, b| a.1.total_cmp(&b.1).then(b.2.total_cmp(&a.2)));
        let inverter =
            inverters.first().ok_or_else(|| whole("has no inverter: it drives the inputs"))?.0.to_owned();
        let hash = Sha256::digest(&text).iter().map(|byte| format!("{byte:02x}")).collect();
        let name = library.name().to_owned();
        Ok(Library { hash, name, areas, cells, units, gate, inverter, text })
    }

    /// Name of the library, as its file tells it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The cell in whose area others are told.
    #[must_use]
    pub fn gate(&self) -> &str {
        &self.gate.0
    }

    /// Area of one gate equivalent, um2.
    pub(super) fn gate_area(&self) -> f64 {
        self.gate.1
    }

    /// Area of a cell, um2.
    pub(super) fn area(&self, cell: &str) -> Option<f64> {
        self.areas.get(cell).copied()
    }

    /// The cell, for its value and its energy.
    pub(super) fn cell(&self, name: &str) -> Result<&Cell, Stop> {
        let why = match self.cells.get(name) {
            Some(Ok(cell)) => return Ok(cell),
            Some(Err(why)) => why,
            None => "is not in the library",
        };
        let line = format!(
            "it took the cell `{name}`, which {why}; without that cell in the library it takes others"
        );
        Err(Stop::Broken { tool: "yosys".to_owned(), lines: vec![line] })
    }

    /// Names of the cell's outputs.
    pub(super) fn outputs(&self, cell: &str) -> impl Iterator<Item = &str> {
        let cell = self.cells.get(cell).and_then(|cell| cell.as_ref().ok());
        cell.into_iter().flat_map(|cell| &cell.pins[cell.inputs..]).map(|pin| pin.name.as_str())
    }

    /// The pin at which the state of a cell's flip-flop is seen, if it has one.
    pub(super) fn register(&self, cell: &str) -> Option<&str> {
        let cell = self.cells.get(cell)?.as_ref().ok()?;
        cell.state().map(|pin| cell.pins[pin].name.as_str())
    }
}

impl Units {
    fn of(library: &Group) -> Result<Units, Wrong> {
        let wrong = |line, what: String| Wrong { line, what };
        // A number and a unit behind it: `1ns`.
        let scaled = |key: &str, units: [(&str, f64); 4], default: f64| {
            let Some((value, line)) = library.value(key) else { return Ok(default) };
            let text = value.trim();
            let (number, unit) = text.split_at(text.find(|c: char| c.is_alphabetic()).unwrap_or(text.len()));
            let unit = units.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit.trim()));
            match (number.trim().parse::<f64>(), unit) {
                (Ok(number), Some((_, scale))) if number.is_finite() && number > 0.0 => Ok(number * scale),
                _ => {
                    let names = units.map(|(name, _)| name).join(", ");
                    let what =
                        format!("found {key} `{}`; permitted: a number and one of {names}", cut(value));
                    Err(wrong(line, what))
                }
            }
        };
        let ns = scaled("time_unit", [("ns", 1.0), ("ps", 1e-3), ("fs", 1e-6), ("us", 1e3)], 1.0)?;
        let volt = scaled("voltage_unit", [("V", 1.0), ("mV", 1e-3), ("uV", 1e-6), ("kV", 1e3)], 1.0)?;
        let watts =
            scaled("leakage_power_unit", [("nW", 1e-9), ("pW", 1e-12), ("uW", 1e-6), ("mW", 1e-3)], 1e-9)?;
        let Some((parts, line)) = library.list("capacitive_load_unit") else {
            let what = "the library has no capacitive_load_unit; needed: capacitive_load_unit (1, pf);";
            return Err(wrong(library.line, what.to_owned()));
        };
        let found = match parts {
            [number, unit] => {
                let scale = [("pf", 1e-12), ("ff", 1e-15)].into_iter();
                let mut scale = scale;
                let scale = scale.find(|(name, _)| name.eq_ignore_ascii_case(unit));
                number.parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0).zip(scale)
            }
            _ => None,
        };
        let Some((count, (_, scale))) = found else {
            let what = format!(
                "found capacitive_load_unit ({}); permitted: a number, and pf or ff",
                cut(&parts.join(", "))
            );
            return Err(wrong(line, what));
        };
        let farads = count * scale;
        let Some(volts) = number(library, "nom_voltage")?.filter(|volts| *volts > 0.0) else {
            let what = "the library has no nom_voltage above 0; needed: nom_voltage : 1.8;";
            return Err(wrong(library.line, what.to_owned()));
        };
        Ok(Units { volts: volts * volt, farads, joules: farads * volt * volt, ns, watts })
    }
}

/// The area of each cell.
fn areas(library: &Group) -> Result<BTreeMap<String, f64>, Wrong> {
    let mut areas = BTreeMap::new();
    for cell in library.of("cell") {
        let name = cell.name();
        if name.is_empty() {
            return Err(Wrong {
                line: cell.line,
                what: "a cell without a name; needed: cell (NAME) {".to_owned(),
            });
        }
        let Some((value, line)) = cell.value("area") else {
            let what = format!("cell `{}` has no area; needed: area : UM2;", cut(name));
            return Err(Wrong { line: cell.line, what });
        };
        let Some(area) = value.parse().ok().filter(|area: &f64| area.is_finite() && *area >= 0.0) else {
            let what = format!(
                "area of cell `{}`: found `{}`; permitted: a number of 0 or more, um2",
                cut(name),
                cut(value)
            );
            return Err(Wrong { line, what });
        };
        if areas.insert(name.to_owned(), area).is_some() {
            let what = format!("cell `{}` is there a second time; permitted: once", cut(name));
            return Err(Wrong { line: cell.line, what });
        }
    }
    match areas.is_empty() {
        true => Err(Wrong { line: library.line, what: "the library has no cells".to_owned() }),
        false => Ok(areas),
    }
}

/// A cell of one output and at most two inputs: how many, its truth table, and the greatest capacitance it drives.
fn shape(cell: &Group) -> Option<(usize, u64, f64)> {
    let pins = |direction: &str| {
        let of = cell.of("pin").filter(|pin| pin.value("direction").is_some_and(|(of, _)| of == direction));
        of.collect::<Vec<_>>()
    };
    let (inputs, outputs) = (pins("input"), pins("output"));
    let ([output], 1..=2) = (&outputs[..], inputs.len()) else { return None };
    let names: Vec<&str> = inputs.iter().map(|pin| pin.name()).collect();
    let drives = output.value("max_capacitance").and_then(|(most, _)| most.parse().ok()).unwrap_or(0.0);
    Some((names.len(), table(output.value("function")?.0, &names)?, drives))
}

#[cfg(test)]
mod tests {
    use super::Library;

    /// Cells of the same function, the wanted one neither first nor last.
    #[test]
    fn the_smallest_cells_are_taken() {
        let inverter = |name: &str, area: &str, drives: &str| {
            format!(
                "cell ({name}) {{ area : {area}; pin (A) {{ direction : input; }}
                pin (Y) {{ direction : output; function : \"A'\"; max_capacitance : {drives}; }} }}"
            )
        };
        let two = |name: &str, area: &str, function: &str| {
            format!(
                "cell ({name}) {{ area : {area}; pin (A) {{ direction : input; }} pin (B) {{ direction : input; }}
                pin (Y) {{ direction : output; function : \"{function}\"; }} }}"
            )
        };
        let flip_flop = |name: &str, pins: &str| {
            format!(
                "cell ({name}) {{ area : 9; ff (I, N) {{ next_state : \"D\"; clocked_on : \"C\"; }}
                pin (C) {{ direction : input; }} pin (D) {{ direction : input; }} {pins} }}"
            )
        };
        let (q, qn) = (
            "pin (OUT) { direction : output; function : \"I\"; }",
            "pin (INV) { direction : output; function : \"N\"; }",
        );
        let cells = [
            inverter("weak", "2", "0.5"),
            inverter("strong", "2", "0.9"),
            inverter("large", "3", "5"),
            two("nor", "1", "(A+B)'"),
            two("big", "8", "(A B)'"),
            two("nand", "4.5", "!A + !B"),
            two("and", "4", "A B"),
            flip_flop("both", &format!("{qn} {q}")),
            flip_flop("inverted", qn),
        ];
        let text =
            format!("library (l) {{ nom_voltage : 1; capacitive_load_unit (1, pf); {} }}", cells.join("\n"));
        let library = Library::of(text, "l.lib").expect("a library");
        assert_eq!((library.inverter.as_str(), library.gate(), library.gate_area()), ("strong", "nand", 4.5));
        assert_eq!((library.register("both"), library.register("inverted")), (Some("OUT"), Some("INV")));
        assert_eq!(
            (library.register("nand"), library.area("large"), library.area("none")),
            (None, Some(3.0), None)
        );
    }
}
