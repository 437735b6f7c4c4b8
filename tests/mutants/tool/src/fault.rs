//! The faults that cargo-mutants makes up, and the sample of them.

use std::ops::Range;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::cksum::cksum;

/// One fault: the text of `span` is replaced.
pub struct Fault {
    /// Its switch, from 1.
    pub number: u32,
    /// The sample that it is of.
    pub seed: u64,
    /// The crate, without `edgewalk-`.
    pub owner: String,
    /// From the top of the tree.
    pub file: String,
    /// As it is called in verdicts: `crates/x/src/y.rs:1:2: replace ...`.
    pub name: String,
    pub genre: String,
    /// In bytes of the file.
    pub span: Range<usize>,
    pub replacement: String,
}

impl Fault {
    /// A part of the file's text, which holds the span, with the fault.
    pub fn changed(&self, text: &str, part: Range<usize>) -> String {
        let before = &text[part.start..self.span.start];
        let after = &text[self.span.end..part.end];
        // What is deleted may stand between words.
        format!("{before}{} {after}", self.replacement)
    }
}

/// For each seed the first `sample` faults of a crate in the order of a checksum of seed and name, those of several samples once;
/// numbers them from `first`.
pub fn sampled(tree: &Path, owner: &str, seeds: &[u64], sample: usize, first: u32) -> Result<Vec<Fault>> {
    let mut command = Command::new("cargo");
    command
        .args(["mutants", "--list", "--json", "--package", &format!("edgewalk-{owner}")])
        .current_dir(tree);
    let output = command.output().context("cargo mutants --list")?;
    ensure!(output.status.success(), "cargo mutants --list: {}", String::from_utf8_lossy(&output.stderr));
    let list: Vec<Value> = serde_json::from_slice(&output.stdout).context("cargo mutants --list")?;
    let names = list.iter().map(|entry| text(entry, "/name")).collect::<Result<Vec<String>>>()?;
    let mut chosen: Vec<(u64, usize)> = Vec::new();
    for seed in seeds {
        let mut order: Vec<usize> = (0..list.len()).collect();
        // By name too, where checksums meet.
        order.sort_by_cached_key(|place| {
            (cksum(format!("{seed} {}", names[*place]).as_bytes()), &names[*place])
        });
        for place in order.into_iter().take(sample) {
            if chosen.iter().all(|(_, other)| *other != place) {
                chosen.push((*seed, place));
            }
        }
    }
    let mut faults = Vec::new();
    for (number, (seed, place)) in (first..).zip(chosen) {
        let (entry, name) = (&list[place], names[place].clone());
        let file = text(entry, "/file")?;
        let source = std::fs::read_to_string(tree.join(&file)).with_context(|| file.clone())?;
        let place = |end: &str| -> Result<usize> {
            let at = |what: &str| {
                let value = entry.pointer(&format!("/span/{end}/{what}")).and_then(Value::as_u64);
                value.with_context(|| format!("{name}: no {what}"))
            };
            byte_of(&source, at("line")?, at("column")?).with_context(|| format!("{name}: not in the file"))
        };
        let (span, genre) = (place("start")?..place("end")?, text(entry, "/genre")?);
        let replacement = text(entry, "/replacement")?;
        faults.push(Fault { number, seed, owner: owner.to_owned(), file, name, genre, span, replacement });
    }
    Ok(faults)
}

fn text(entry: &Value, pointer: &str) -> Result<String> {
    let value = entry.pointer(pointer).and_then(Value::as_str);
    Ok(value.with_context(|| format!("the list of cargo-mutants has no {pointer}"))?.to_owned())
}

/// The byte of a line and a column, both from 1; columns count characters.
fn byte_of(text: &str, line: u64, column: u64) -> Option<usize> {
    let start = match line {
        1 => 0,
        _ => text.match_indices('\n').nth(line as usize - 2)?.0 + 1,
    };
    let rest = &text[start..];
    let characters = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
    Some(start + characters.take(column as usize).last()?)
}

#[cfg(test)]
mod tests {
    use super::byte_of;

    #[test]
    fn columns_count_characters() {
        let text = "a\nü = x\n";
        assert_eq!(byte_of(text, 1, 1), Some(0));
        assert_eq!(byte_of(text, 2, 1), Some(2));
        assert_eq!(byte_of(text, 2, 3), Some(5));
        assert_eq!(byte_of(text, 9, 1), None);
    }
}
