//! One key and the values it takes: `key=a,b,c` or `key=lo..hi[..step]`, both ends included.

use anyhow::{Result, anyhow};
use edgewalk_machine::Machine;
use edgewalk_machine::key::{Domain, Key};

/// A key that is varied.
#[derive(Clone)]
pub struct Axis {
    /// The key.
    pub key: &'static Key,
    /// Values of the axis, as the key's `set` takes them, in the order they were given.
    pub values: Vec<u32>,
}

impl Axis {
    /// Reads one.
    ///
    /// # Errors
    /// No such key, no value, a value that is not permitted or comes twice.
    pub fn parse(text: &str) -> Result<Axis> {
        let refuse = |why: String| anyhow!("--vary {text}: {why}");
        let (name, list) = text.split_once('=').ok_or_else(|| {
            refuse("write key=a,b,c or key=lo..hi, as in interpolator.adders=1,2,4".to_owned())
        })?;
        let (name, list) = (name.trim(), list.trim());
        let key = Key::named(name).map_err(|e| refuse(e.to_string()))?;
        let words = if list.contains("..") { range(key, list) } else { Ok(words(list)) };
        let words = words.map_err(refuse)?;
        if words.is_empty() {
            return Err(refuse(format!("no value; permitted: {}", key.permitted())));
        }
        let mut values = Vec::new();
        for word in &words {
            let value = key.parse(word).ok_or_else(|| refuse(key.refusal(word)))?;
            if values.contains(&value) {
                return Err(refuse(format!("{word} comes twice")));
            }
            values.push(value);
        }
        Ok(Axis { key, values })
    }

    /// A value as it is written.
    #[must_use]
    pub fn show(&self, place: usize) -> String {
        let mut machine = Machine::default();
        (self.key.set)(&mut machine, self.values[place]);
        self.key.show(&machine)
    }
}

fn words(list: &str) -> Vec<String> {
    list.split(',').map(|word| word.trim().to_owned()).filter(|word| !word.is_empty()).collect()
}

/// `lo..hi` or `lo..hi..step`.
fn range(key: &Key, list: &str) -> Result<Vec<String>, String> {
    if matches!(key.domain, Domain::Word(_)) {
        return Err(format!("{} takes words: {}", key.name, key.permitted()));
    }
    let parts: Vec<&str> = list.split("..").map(str::trim).collect();
    let number = |text: &str| -> Result<u32, String> {
        text.parse().map_err(|_| format!("{text} is no whole number; write lo..hi or lo..hi..step"))
    };
    let (low, high, step) = match parts[..] {
        [low, high] => (number(low)?, number(high)?, 1),
        [low, high, step] => (number(low)?, number(high)?, number(step)?),
        _ => return Err("write lo..hi or lo..hi..step".to_owned()),
    };
    if step == 0 {
        return Err("the step is 0; permitted: 1 or more".to_owned());
    }
    if low > high {
        return Err(format!("empty range: {low} is above {high}"));
    }
    // A key has few values; what lies outside is refused one by one, so no long list is made.
    if let Domain::Range(least, most) = key.domain
        && (low < least || high > most)
    {
        return Err(format!("{} is permitted from {least} to {most}", key.name));
    }
    let inside = |value: &u32| !matches!(key.domain, Domain::OneOf(list) if !list.contains(value));
    let steps = (low..=high).step_by(step as usize);
    // Of a key with gaps, such as 1, 2, 4, the permitted ones.
    Ok(steps.filter(inside).map(|value| value.to_string()).collect())
}
