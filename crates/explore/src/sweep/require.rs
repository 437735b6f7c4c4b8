//! What a machine must keep to be wanted: `--require 'est_lut4<=4500'`, `--fits ice40-up5k`.

use super::judge::Judge;
use super::objective::{OBJECTIVES, Objective};
use super::row::Status;
use anyhow::{Result, anyhow};
use edgewalk_machine::Unknown;
use serde_json::Value;

/// The device whose cells and clock are estimated.
const ESTIMATED: &str = "ice40-hx8k";

/// A limit of a figure, or a device.
#[derive(Clone, Debug, PartialEq)]
pub enum Requirement {
    /// A figure is at most, or at least, so much.
    Figure {
        /// Which.
        objective: Objective,
        /// The figure may not be less; else it may not be more.
        at_least: bool,
        /// The limit.
        limit: f64,
        /// The estimate of the figure, where `objective` is measured by synthesis: what it rules out is not built.
        estimate: Option<Objective>,
    },
    /// The estimate fits a device, or its error leaves that open.
    Fits(String),
}

impl Requirement {
    /// Reads `NAME<=NUMBER` or `NAME>=NUMBER`. Without synthesis for a device, a figure that synthesis measures is the
    /// estimate's.
    ///
    /// # Errors
    /// What is wrong, and at which character.
    pub fn parse(text: &str, synth: Option<&str>) -> Result<Requirement> {
        let says = |why: String| anyhow!("--require '{text}': {why}");
        let place = |rest: &str| text.chars().count() - rest.chars().count() + 1;
        let relation = text.find(['<', '>', '=', '!']);
        let Some(at) = relation else {
            return Err(says(match text.trim() {
                "" => "is empty: write NAME<=NUMBER or NAME>=NUMBER".to_owned(),
                name => format!("no <= or >= behind `{name}`: write NAME<=NUMBER or NAME>=NUMBER"),
            }));
        };
        let (name, rest) = text.split_at(at);
        let name = name.trim();
        if name.is_empty() {
            return Err(says(format!("position {}: found `{}` before any name", place(rest), first(rest))));
        }
        let (at_least, number) = match (rest.strip_prefix("<="), rest.strip_prefix(">=")) {
            (Some(number), _) => (false, number),
            (_, Some(number)) => (true, number),
            _ => {
                let found: String = rest.chars().take_while(|c| "<>=!".contains(*c)).collect();
                return Err(says(format!("position {}: found `{found}`: permitted: <=, >=", place(rest))));
            }
        };
        let all = || OBJECTIVES.iter().map(|objective| objective.name);
        let named = |name: &str| OBJECTIVES.iter().find(|objective| objective.name == name).copied();
        let Some(objective) = named(name) else {
            return Err(says(format!(
                "position {}: {}",
                place(text.trim_start()),
                Unknown::new("figure", name, all())
            )));
        };
        let estimate = named(&format!("est_{name}")).filter(|_| objective.synth);
        let objective = match estimate {
            Some(estimate) if synth.is_none() => estimate,
            None if objective.synth && synth.is_none() => {
                return Err(says(format!("only synthesis gives {name}; add --synth TARGET")));
            }
            _ => objective,
        };
        let estimate = estimate.filter(|_| synth == Some(ESTIMATED));
        let trimmed = number.trim();
        let position = place(number.trim_start());
        if trimmed.is_empty() {
            return Err(says(format!("position {position}: no number behind {}", sign(at_least))));
        }
        let limit: f64 = trimmed.parse().map_err(|_| {
            says(format!("position {position}: `{trimmed}` is no number: permitted: 4500, 0.75, 1e6"))
        })?;
        if !limit.is_finite() || limit < 0.0 {
            return Err(says(format!(
                "position {position}: `{trimmed}`: permitted: a finite number of 0 or more"
            )));
        }
        Ok(Requirement::Figure { objective, at_least, limit, estimate })
    }

    /// All of them.
    ///
    /// # Errors
    /// One that cannot be read, a device twice, a figure with two limits on one side or with limits that nothing keeps.
    pub fn list(texts: &[String], devices: &[String], synth: Option<&str>) -> Result<Vec<Requirement>> {
        let mut all: Vec<Requirement> = Vec::new();
        for text in texts {
            let own = Requirement::parse(text, synth)?;
            for other in &all {
                if let Some(why) = own.clashes(other) {
                    return Err(anyhow!("--require '{text}': {why}"));
                }
            }
            all.push(own);
        }
        for device in devices {
            let own = Requirement::Fits(device.clone());
            if all.contains(&own) {
                return Err(anyhow!("--fits {device}: is given twice; give it once"));
            }
            all.push(own);
        }
        Ok(all)
    }

    fn clashes(&self, other: &Requirement) -> Option<String> {
        let (
            Requirement::Figure { objective, at_least, limit, .. },
            Requirement::Figure { objective: o, at_least: l, limit: against, .. },
        ) = (self, other)
        else {
            return None;
        };
        if objective != o {
            return None;
        }
        if at_least == l {
            return Some(format!("{other} is required already; give one of them"));
        }
        let (low, high) = if *at_least { (limit, against) } else { (against, limit) };
        (low > high).then(|| format!("no figure keeps this and {other}"))
    }

    /// Whether it asks how far pictures are from the shading equation.
    #[must_use]
    pub fn is_of_equation(&self) -> bool {
        matches!(self, Requirement::Figure { objective, .. } if objective.is_of_equation())
    }

    /// Whether it asks for the estimate.
    #[must_use]
    pub fn is_of_estimate(&self) -> bool {
        match self {
            Requirement::Figure { objective, estimate, .. } => objective.estimate || estimate.is_some(),
            Requirement::Fits(_) => true,
        }
    }

    /// Whether the estimate rules a machine out before it is drawn or built. Where synthesis follows, only what lies
    /// beyond the estimate's error is ruled out.
    #[must_use]
    pub fn rules_out_early(&self, row: &Value) -> bool {
        match self {
            Requirement::Fits(device) => fits(row, device) == Some(false),
            Requirement::Figure { objective, .. } if objective.estimate => {
                objective.of(row).is_some_and(|value| !self.keeps(value))
            }
            Requirement::Figure { estimate: Some(estimate), at_least, .. } => {
                let Some(value) = estimate.of(row) else { return false };
                let error = estimate.error_of(row);
                !self.keeps(if *at_least { value + error } else { value - error })
            }
            Requirement::Figure { .. } => false,
        }
    }

    /// What the estimate says of it: the figure with its error, or why the device is too small.
    #[must_use]
    pub fn estimated(&self, row: &Value) -> String {
        match self {
            Requirement::Fits(device) => {
                of_device(row, device).and_then(|of| of["text"].as_str()).unwrap_or_default().to_owned()
            }
            Requirement::Figure { objective, estimate, .. } => {
                let of = estimate.as_ref().unwrap_or(objective);
                let error = of.error_of(row);
                let value = of.of(row).map_or_else(|| "unknown".to_owned(), |value| format!("{value:.1}"));
                if error > 0.0 { format!("{value} ± {error:.1}") } else { value }
            }
        }
    }

    /// Whether a figure of a machine, whose rows these are, breaks it.
    fn rules_out(&self, judge: &Judge, rows: &[Vec<&Value>]) -> bool {
        match self {
            Requirement::Fits(device) => rows.iter().flatten().any(|row| fits(row, device) == Some(false)),
            Requirement::Figure { objective, .. } => {
                rows.iter().flatten().any(|row| self.rules_out_early(row))
                    || judge.value(objective, rows).is_some_and(|value| !self.keeps(value))
            }
        }
    }

    /// The place of the first requirement that a machine does not keep. One that a figure breaks comes before one whose figure is
    /// not known.
    #[must_use]
    pub fn first_broken(all: &[Requirement], judge: &Judge, rows: &[Vec<&Value>]) -> Option<usize> {
        let broken = all.iter().position(|of| of.rules_out(judge, rows));
        broken.or_else(|| all.iter().position(|of| of.is_unknown(judge, rows)))
    }

    /// Whether a row that counts lacks the figure, though all of it is known: a bound that is not proved, say.
    fn is_unknown(&self, judge: &Judge, rows: &[Vec<&Value>]) -> bool {
        let Requirement::Figure { objective, .. } = self else { return false };
        let lacks = |row: &&Value| Status::of(row) == Some(Status::Ok) && objective.of(row).is_none();
        let counted = rows.iter().enumerate().filter(|(memory, _)| judge.memories.count(*memory));
        counted.flat_map(|(_, rows)| rows).any(lacks)
    }

    /// Whether a row of one input, with a memory that counts, breaks it: then all the machine's rows do.
    #[must_use]
    pub fn broken_by(&self, judge: &Judge, row: &Value) -> bool {
        match self {
            Requirement::Figure { objective, at_least: false, .. } if !objective.most => {
                judge.of_memory(objective, &[row]).is_some_and(|value| !self.keeps(value))
            }
            _ => false,
        }
    }

    fn keeps(&self, value: f64) -> bool {
        match self {
            Requirement::Figure { at_least, limit, .. } => {
                if *at_least {
                    value >= *limit
                } else {
                    value <= *limit
                }
            }
            Requirement::Fits(_) => true,
        }
    }
}

impl std::fmt::Display for Requirement {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Requirement::Figure { objective, at_least, limit, .. } => {
                write!(f, "{} {} {limit}", objective.name, sign(*at_least))
            }
            Requirement::Fits(device) => write!(f, "fits {device}"),
        }
    }
}

fn sign(at_least: bool) -> &'static str {
    if at_least { ">=" } else { "<=" }
}

fn first(text: &str) -> String {
    text.chars().take(1).collect()
}

/// What the estimate says of a device; none where its error leaves that open.
fn fits(row: &Value, device: &str) -> Option<bool> {
    of_device(row, device)?["fits"].as_bool()
}

fn of_device<'v>(row: &'v Value, device: &str) -> Option<&'v Value> {
    row.pointer("/estimate/fits")?.as_array()?.iter().find(|of| of["device"] == device)
}

#[cfg(test)]
mod tests {
    use super::Requirement;
    use crate::sweep::judge::{Judge, OverInputs, OverMemories};
    use serde_json::json;

    /// Where synthesis follows, only what lies beyond the error of the estimate is ruled out.
    #[test]
    fn the_error_of_an_estimate_counts_for_the_machine() {
        let row = json!({ "estimate": { "est_lut4": { "value": 1000.0, "error": 50.0 } } });
        for (text, out) in
            [("lut4<=960", false), ("lut4<=940", true), ("lut4>=1040", false), ("lut4>=1060", true)]
        {
            let required =
                Requirement::list(&[text.to_owned()], &[], Some("ice40-hx8k")).expect("a requirement");
            assert_eq!(required[0].rules_out_early(&row), out, "{text}");
        }
    }

    #[test]
    fn a_row_alone_breaks_what_its_weighted_sum_breaks() {
        let required = Requirement::list(&["cycles<=100".to_owned()], &[], None).expect("a requirement");
        let row = json!({ "input": "a", "report": { "cycles": { "total": 150 } } });
        for (weight, breaks) in [(1.0, true), (0.7, true), (0.6, false)] {
            let inputs = OverInputs::Sum(vec![("a".to_owned(), weight)]);
            let judge = Judge { memories: OverMemories::Worst, inputs };
            assert_eq!(required[0].broken_by(&judge, &row), breaks, "{weight}");
        }
        let counts = |memories: OverMemories| [0, 1].map(|memory| memories.count(memory));
        assert_eq!(counts(OverMemories::Only(1)), [false, true]);
        assert_eq!(counts(OverMemories::Sum), [true, true]);
    }
}
