//! `dut.toml`: a user's design and how its ports stand for those of a unit. What the file says by itself is checked
//! here; what it says of the unit and of the design, in `wiring.rs`.

use super::error::DutError;
use super::reader::{Section, shown};
use edgewalk_lockstep::Unit;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::Value;

/// A user's design.
#[derive(Clone, Debug, PartialEq)]
pub struct Dut {
    /// The file that describes it, as it was named.
    pub file: String,
    /// What it stands for.
    pub unit: Unit,
    /// The top module.
    pub top: String,
    /// The design's files, absolute.
    pub files: Vec<PathBuf>,
    /// Folders for its include lines, absolute.
    pub include: Vec<PathBuf>,
    /// The clock port; the rising edge counts.
    pub clock: String,
    /// The reset.
    pub reset: Reset,
    /// How its outputs are compared.
    pub compare: Compare,
    /// What happens to ports of another width.
    pub widths: Widths,
    /// Clocks in which nothing happens that end a run; `None`: found from the model's longest wait.
    pub patience: Option<u32>,
    /// Parameters of the top module: name, value in Verilog.
    pub parameters: Vec<(String, String)>,
    /// Inputs that hold one value: port, value.
    pub tie: Vec<(String, u64)>,
    /// Channels in, by the unit's names.
    pub inputs: BTreeMap<String, Channel>,
    /// Channels out, by the unit's names.
    pub outputs: BTreeMap<String, Channel>,
    /// Ports outside channels: the unit's name, the design's.
    pub ports: BTreeMap<String, String>,
    /// Ports outside channels that the design has not.
    pub absent: Vec<String>,
    /// Memories that the design has inside, each with the path of its array below the top module.
    pub memories: BTreeMap<String, String>,
}

/// A reset.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reset {
    /// The port.
    pub port: String,
    /// 0 resets.
    pub active_low: bool,
    /// Whether the reset acts without a clock. The bench then releases it between two edges.
    pub asynchronous: bool,
    /// Clocks for which it is held.
    pub cycles: u32,
}

/// How outputs are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compare {
    /// Order and values of the tokens.
    Order,
    /// The cycles and the status ports too.
    Cycle,
}

/// What happens to ports of another width than their values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Widths {
    /// A port of another width is refused.
    Equal,
    /// A wider port takes and gives its values extended, by the sign where they have one.
    Extend,
    /// Nothing is read from the design before it is simulated.
    Unchecked,
}

/// The ports of a channel; names that are not given follow from the prefix.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Channel {
    /// The port of valid.
    pub valid: Option<String>,
    /// The port of ready.
    pub ready: Option<String>,
    /// What the names of the other ports begin with; `None`: the channel's name and a `_`.
    pub prefix: Option<String>,
    /// Fields with names of their own.
    pub fields: BTreeMap<String, String>,
    /// One port for all fields that have none of their own.
    pub packed: Option<String>,
    /// The fields in it, the most significant first; `None`: in the unit's order.
    pub order: Option<Vec<String>>,
    /// Fields, or `ready`, that the design has not.
    pub absent: Vec<String>,
}

impl Dut {
    /// The year of the language's standard that a simulator is told.
    #[must_use]
    pub fn standard(&self) -> &'static str {
        let newer = self.files.iter().any(|file| file.extension().is_some_and(|end| end == "sv"));
        if newer { "2012" } else { "2001" }
    }

    /// Reads the file and finds the design's files.
    ///
    /// # Errors
    /// What the file says by itself is wrong, or names files that are not there.
    pub fn read(path: &Path) -> Result<Dut, DutError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|error| DutError::new(&name, "", error.to_string(), "a file of TOML in UTF-8"))?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = std::path::absolute(folder.unwrap_or(Path::new(".")))
            .map_err(|error| DutError::new(&name, "", error.to_string(), "a file in a folder"))?;
        Dut::parse(&name, &text, &folder)
    }

    fn parse(file: &str, text: &str, folder: &Path) -> Result<Dut, DutError> {
        let mut whole = Section::whole(file, text)?;
        let unit = whole.text("unit")?;
        let unit = needed(&whole, "unit", unit)?;
        let unit = Unit::named(&unit).map_err(|_| {
            let found = shown(&Value::String(unit.clone()));
            DutError::unknown(file, "unit", found, &unit, Unit::known().map(Unit::name))
        })?;
        let top = whole.text("top")?;
        let top = identifier(&whole, "top", &needed(&whole, "top", top)?)?;
        let files = whole.texts("files")?;
        let files = super::files::found(&whole, needed(&whole, "files", files)?, folder)?;
        let include = whole.texts("include")?.unwrap_or_default();
        let include = super::files::folders(&whole, include, folder)?;
        let clock = whole.text("clock")?.unwrap_or_else(|| "clk".to_owned());
        let clock = identifier(&whole, "clock", &clock)?;
        let reset = reset(whole.table("reset")?)?;
        let compare = whole.choice("compare", &[("order", Compare::Order), ("cycle", Compare::Cycle)])?;
        let widths = [("equal", Widths::Equal), ("extend", Widths::Extend), ("unchecked", Widths::Unchecked)];
        let widths = whole.choice("widths", &widths)?;
        let patience = whole.number("patience", 1 << 24)?;
        let parameters = whole.table("parameters")?.map(parameters).transpose()?.unwrap_or_default();
        let tie = whole.table("tie")?.map(tie).transpose()?.unwrap_or_default();
        let inputs = whole.table("in")?.map(channels).transpose()?.unwrap_or_default();
        let outputs = whole.table("out")?.map(channels).transpose()?.unwrap_or_default();
        let (ports, absent) = whole.table("ports")?.map(ports).transpose()?.unwrap_or_default();
        let memories = whole.table("memories")?.map(memories).transpose()?.unwrap_or_default();
        whole.finish()?;
        Ok(Dut {
            file: file.to_owned(),
            unit,
            top,
            files,
            include,
            clock,
            reset,
            compare: compare.unwrap_or(Compare::Order),
            widths: widths.unwrap_or(Widths::Equal),
            patience,
            parameters,
            tie,
            inputs,
            outputs,
            ports,
            absent,
            memories,
        })
    }
}

fn needed<T>(section: &Section, name: &str, value: Option<T>) -> Result<T, DutError> {
    value.ok_or_else(|| section.error(name, "missing", "a value; it has no default"))
}

/// A plain name of Verilog.
fn identifier(section: &Section, key: &str, name: &str) -> Result<String, DutError> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '$';
    let starts = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    if starts && name.chars().all(plain) && name.len() <= 200 {
        return Ok(name.to_owned());
    }
    let found = shown(&Value::String(name.to_owned()));
    Err(section.error(
        key,
        found,
        "a name of Verilog: letters, digits, _ and $, at most 200, a letter or _ first",
    ))
}

fn optional(section: &mut Section, key: &'static str) -> Result<Option<String>, DutError> {
    let name = section.text(key)?;
    name.map(|name| identifier(section, key, &name)).transpose()
}

fn reset(section: Option<Section>) -> Result<Reset, DutError> {
    let Some(mut section) = section else {
        return Ok(Reset { port: "rst".to_owned(), active_low: false, asynchronous: false, cycles: 3 });
    };
    let port = optional(&mut section, "port")?.unwrap_or_else(|| "rst".to_owned());
    let active_low = section.choice("active", &[("high", false), ("low", true)])?.unwrap_or(false);
    let kinds = [("synchronous", false), ("asynchronous", true)];
    let asynchronous = section.choice("kind", &kinds)?.unwrap_or(false);
    let cycles = section.number("cycles", 1000)?.unwrap_or(3);
    section.finish()?;
    Ok(Reset { port, active_low, asynchronous, cycles })
}

fn parameters(section: Section) -> Result<Vec<(String, String)>, DutError> {
    let value = |(name, value): (&String, &Value)| {
        let name = identifier(&section, name, name)?;
        let plain = |text: &str| text.chars().all(|c| (' '..='~').contains(&c) && c != '"' && c != '\\');
        let text = match value {
            Value::Integer(number) if i32::try_from(*number).is_ok() => number.to_string(),
            Value::Boolean(flag) => u8::from(*flag).to_string(),
            Value::String(text) if plain(text) => format!("\"{text}\""),
            other => {
                let permitted =
                    "a whole number of 32 bits, true, false, or a text without quotes and backslashes";
                return Err(section.error(&name, shown(other), permitted));
            }
        };
        Ok((name, text))
    };
    section.values().map(value).collect()
}

/// Paths of arrays, as `u_store.words`.
fn memories(section: Section) -> Result<BTreeMap<String, String>, DutError> {
    let path = |(name, value): (&String, &Value)| {
        let plain = |part: &str| identifier(&section, name, part).is_ok();
        match value.as_str().filter(|path| path.split('.').all(plain)) {
            Some(path) => Ok((name.clone(), path.to_owned())),
            None => Err(section.error(
                name,
                shown(value),
                "names of Verilog with points between, as \"u_store.words\"",
            )),
        }
    };
    section.values().map(path).collect()
}

fn tie(section: Section) -> Result<Vec<(String, u64)>, DutError> {
    let value = |(name, value): (&String, &Value)| {
        let name = identifier(&section, name, name)?;
        match value.as_integer().and_then(|number| u64::try_from(number).ok()) {
            Some(number) => Ok((name, number)),
            None => Err(section.error(&name, shown(value), "a whole number, 0 or more")),
        }
    };
    section.values().map(value).collect()
}

fn channels(section: Section) -> Result<BTreeMap<String, Channel>, DutError> {
    section.tables()?.into_iter().map(|(name, section)| Ok((name, channel(section)?))).collect()
}

fn channel(mut section: Section) -> Result<Channel, DutError> {
    let valid = optional(&mut section, "valid")?;
    let ready = optional(&mut section, "ready")?;
    let prefix = optional(&mut section, "prefix")?;
    let packed = optional(&mut section, "packed")?;
    let order = section.texts("order")?;
    if let (None, Some(order)) = (&packed, &order) {
        let found = format!("{order:?} without a port that they share");
        return Err(section.error("order", found, "the fields of `packed`, and only beside it"));
    }
    let absent = section.texts("absent")?.unwrap_or_default();
    let fields = section.table("fields")?.map(|fields| names(&fields)).transpose()?.unwrap_or_default();
    section.finish()?;
    Ok(Channel { valid, ready, prefix, fields, packed, order, absent })
}

/// Ports of the design under names of the unit.
fn names(section: &Section) -> Result<BTreeMap<String, String>, DutError> {
    let name = |(key, value): (&String, &Value)| match value.as_str() {
        Some(name) => Ok((key.clone(), identifier(section, key, name)?)),
        None => Err(section.error(key, shown(value), "a port in quotes")),
    };
    section.values().map(name).collect()
}

fn ports(mut section: Section) -> Result<(BTreeMap<String, String>, Vec<String>), DutError> {
    let absent = section.texts("absent")?.unwrap_or_default();
    Ok((names(&section)?, absent))
}
