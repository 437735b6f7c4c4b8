//! Cases as TOML.
//!
//! ```toml
//! about = "what it has found, and when"
//! fault = "a fault of the netlist that it finds, if it is kept for one"
//! unit = "machine"                # or a unit's name
//! depth_func = 1                  # and the other fields of a case, where they are not as usual
//! tokens = ["3f", "40"]           # packed as in vectors: hex, the first field on top
//! [unwilling]                     # of 256 cycles
//! wr = 100
//! [machine]                       # a machine file: keys by section
//! preset = "textbook"
//! ```

use super::{Case, fed};
use crate::Token;
use crate::interface::Interface;
use crate::pack;
use crate::unit::Unit;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Field, Machine, MachineError, Unknown};
use std::fmt::Write as _;
use toml::{Table, Value};

/// Why a file is no case.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// The text is no TOML.
    #[error("{0}")]
    Syntax(#[from] toml::de::Error),
    /// A key that no case has, or a value of another kind.
    #[error("{key}: {reason}")]
    Key {
        /// The key.
        key: String,
        /// What is wrong with it.
        reason: String,
    },
    /// No such unit.
    #[error("unit: {0}")]
    Unit(#[from] Unknown),
    /// The machine cannot be built.
    #[error("machine: {0}")]
    Machine(#[from] MachineError),
}

fn wrong(key: &str, reason: impl Into<String>) -> CaseError {
    CaseError::Key { key: key.to_owned(), reason: reason.into() }
}

fn text(key: &str, value: &Value) -> Result<String, CaseError> {
    value.as_str().map(str::to_owned).ok_or_else(|| wrong(key, "a text is wanted"))
}

fn number<T: TryFrom<i64>>(key: &str, value: &Value) -> Result<T, CaseError> {
    let number = value.as_integer().and_then(|number| T::try_from(number).ok());
    number.ok_or_else(|| wrong(key, "a number in range is wanted"))
}

fn flag(key: &str, value: &Value) -> Result<bool, CaseError> {
    value.as_bool().ok_or_else(|| wrong(key, "true or false is wanted"))
}

fn list<'a>(key: &str, value: &'a Value) -> Result<&'a [Value], CaseError> {
    value.as_array().map(Vec::as_slice).ok_or_else(|| wrong(key, "a list is wanted"))
}

impl Case {
    /// Reads a case.
    ///
    /// # Errors
    /// What is no case, with the key.
    pub fn from_toml(toml: &str) -> Result<Case, CaseError> {
        let table: Table = toml.parse()?;
        let machine = table.get("machine").and_then(Value::as_table).cloned().unwrap_or_default();
        let plan = Machine::from_toml(&machine.to_string())?.plan()?;
        let unit = table.get("unit").map_or(Ok("machine".to_owned()), |value| text("unit", value))?;
        let mut case = Case::new(&plan, Unit::named(&unit)?);
        let interface = case.interface();
        for (key, value) in &table {
            match key.as_str() {
                "machine" | "unit" => {}
                "about" => case.about = text(key, value)?,
                "fault" => case.fault = Some(text(key, value)?),
                "depth_func" => case.state.depth_func = number(key, value)?,
                "depth_write" => case.state.depth_write = flag(key, value)?,
                "color_write" => case.state.color_write = flag(key, value)?,
                "blend_add" => case.state.blend_add = flag(key, value)?,
                "shadow_on" => case.state.shadow_on = flag(key, value)?,
                "light_pass" => case.state.light_pass = flag(key, value)?,
                "ambient" => case.state.ambient = number(key, value)?,
                "clear_z" => case.clear_z = Some(number(key, value)?),
                "late" => case.late = number(key, value)?,
                "disturbed" => case.disturbed = number(key, value)?,
                "cycles" => case.cycles = number(key, value)?,
                "seed" => case.seed = number(key, value)?,
                "resets" => {
                    let resets = list(key, value)?.iter().map(|reset| number(key, reset));
                    case.resets = resets.collect::<Result<_, _>>()?;
                }
                "tokens" => {
                    let tokens = list(key, value)?.iter().map(|token| read_token(&interface, token));
                    case.tokens = tokens.collect::<Result<_, _>>()?;
                }
                "unwilling" => {
                    let table = value.as_table().ok_or_else(|| wrong(key, "a section is wanted"))?;
                    for (name, share) in table {
                        if !interface.waits().any(|known| known == name) {
                            let known: Vec<&str> = interface.waits().collect();
                            return Err(wrong(
                                &format!("unwilling.{name}"),
                                format!("one of {}", known.join(", ")),
                            ));
                        }
                        case.unwilling.insert(name.clone(), number(&format!("unwilling.{name}"), share)?);
                    }
                }
                _ => return Err(wrong(key, "no case has such a key")),
            }
        }
        Ok(case)
    }

    /// The case as a file; [`Case::from_toml`] reads it back.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let usual = Case::new(&self.plan, self.unit);
        let mut text =
            format!("about = {}\nunit = \"{}\"\n", Value::from(self.about.as_str()), self.unit.name());
        let mut line = |key: &str, value: Value, usual: Value| {
            if value != usual {
                let _ = writeln!(text, "{key} = {value}");
            }
        };
        let whole = |number: u64| Value::from(number as i64); // seeds and cycles have at most 63 bits
        line("depth_func", whole(self.state.depth_func.into()), whole(usual.state.depth_func.into()));
        line("depth_write", self.state.depth_write.into(), usual.state.depth_write.into());
        line("color_write", self.state.color_write.into(), usual.state.color_write.into());
        line("blend_add", self.state.blend_add.into(), usual.state.blend_add.into());
        line("shadow_on", self.state.shadow_on.into(), usual.state.shadow_on.into());
        line("light_pass", self.state.light_pass.into(), usual.state.light_pass.into());
        line("ambient", whole(self.state.ambient), whole(0));
        if let Some(fault) = &self.fault {
            line("fault", fault.as_str().into(), Value::from(""));
        }
        if let Some(clear) = self.clear_z {
            line("clear_z", whole(clear), Value::from(""));
        }
        line("late", whole(self.late), whole(0));
        line(
            "resets",
            self.resets.iter().map(|reset| whole(*reset)).collect::<Vec<_>>().into(),
            Value::Array(Vec::new()),
        );
        line("disturbed", whole(self.disturbed), whole(0));
        line("cycles", whole(self.cycles), whole(usual.cycles));
        line("seed", whole(self.seed), whole(0));
        let widths: Vec<u32> = fed(&self.interface()).whole().map(Field::width).collect();
        text.push_str("tokens = [\n");
        for token in &self.tokens {
            let _ = writeln!(text, "    \"{}\",", pack::pack(&widths, token));
        }
        text.push_str("]\n\n[unwilling]\n");
        for (name, share) in self.unwilling.iter().filter(|(_, share)| **share > 0) {
            let _ = writeln!(text, "{name} = {share}");
        }
        text + "\n" + &self.machine_sections()
    }

    /// The machine's keys that are not those of the default machine.
    fn machine_sections(&self) -> String {
        let usual = Machine::default();
        let mut machine = Table::new();
        for key in KEYS {
            let (section, name) = key.name.split_once('.').unwrap_or(("", key.name));
            if (key.get)(&self.plan) == (key.get)(&usual) || !(key.used)(&self.plan) {
                continue;
            }
            let shown = key.show(&self.plan);
            let value = shown.parse().map_or_else(|_| Value::from(shown), |number: i64| Value::from(number));
            let section = machine.entry(section).or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(section) = section {
                section.insert(name.to_owned(), value);
            }
        }
        Table::from_iter([("machine".to_owned(), Value::Table(machine))]).to_string()
    }
}

fn read_token(interface: &Interface, value: &Value) -> Result<Token, CaseError> {
    let link = fed(interface);
    let widths: Vec<u32> = link.whole().map(Field::width).collect();
    let packed = text("tokens", value)?;
    pack::unpack(&widths, &packed).ok_or_else(|| {
        let bits: u32 = widths.iter().sum();
        let reason = format!("{packed:?} is no token of {}: {bits} bits in hex", link.name);
        wrong("tokens", reason)
    })
}
