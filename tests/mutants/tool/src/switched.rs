//! The tree with all switches in it: what does not build is set aside, until the rest does.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::cargo::{Build, Refused};
use crate::fault::Fault;
use crate::instrument::{SWITCHES, Written, instrumented};
use crate::place::{Place, Places};
use crate::tree::{self, Files};

/// Puts the switches into the tree and gives the faults that have none: no place for one, or it does not build with it.
/// `aside`: those known from before.
pub fn switched(
    files: &Files,
    faults: &[Fault],
    build: &Build,
    mut aside: BTreeMap<u32, String>,
) -> Result<BTreeMap<u32, String>> {
    let mut places: Vec<(&Fault, Place)> = Vec::new();
    for (file, faults) in by_file(faults) {
        let found = Places::of(text(files, file)?).with_context(|| file.to_owned())?;
        for fault in faults {
            match found.find(fault) {
                Ok(place) => places.push((fault, place)),
                Err(why) => drop(aside.insert(fault.number, why.to_owned())),
            }
        }
    }
    loop {
        places.retain(|(fault, _)| !aside.contains_key(&fault.number));
        let mut changed = files.clone();
        let mut written = BTreeMap::new();
        let mut roots = BTreeSet::new();
        for file in places.iter().map(|(fault, _)| fault.file.as_str()).collect::<BTreeSet<_>>() {
            let here: Vec<_> = places.iter().filter(|(fault, _)| fault.file == file).cloned().collect();
            let (new, parts) = instrumented(text(files, file)?, &here);
            if let Some(content) = changed.get_mut(Path::new(file)) {
                content.bytes = new.into_bytes();
            }
            written.insert(file, parts);
            roots.insert(&here[0].0.owner);
        }
        for owner in roots {
            for root in ["lib.rs", "main.rs"] {
                if let Some(content) = changed.get_mut(Path::new(&format!("crates/{owner}/src/{root}"))) {
                    content.bytes.extend_from_slice(SWITCHES.as_bytes());
                }
            }
        }
        tree::hold(&build.tree, &changed)?;
        let refused = build.check()?;
        if refused.is_empty() {
            return Ok(aside);
        }
        let before = aside.len();
        for error in &refused {
            for number in blamed(error, &written, &places) {
                aside
                    .entry(number)
                    .or_insert_with(|| error.message.lines().next().unwrap_or_default().to_owned());
            }
        }
        if aside.len() == before {
            bail!("an error that is of no fault:\n{}", refused[0].message);
        }
        println!("  {} errors; set aside so far: {}", refused.len(), aside.len());
    }
}

fn by_file(faults: &[Fault]) -> BTreeMap<&str, Vec<&Fault>> {
    let mut files: BTreeMap<&str, Vec<&Fault>> = BTreeMap::new();
    for fault in faults {
        files.entry(&fault.file).or_default().push(fault);
    }
    files
}

fn text<'a>(files: &'a Files, file: &str) -> Result<&'a str> {
    let content = files.get(Path::new(file)).with_context(|| format!("{file} is gone"))?;
    std::str::from_utf8(&content.bytes).with_context(|| file.to_owned())
}

/// The faults of the smallest part that holds one of the error's places, the main ones first; where none does, those of
/// what was written nearest to it.
fn blamed(error: &Refused, written: &BTreeMap<&str, Vec<Written>>, places: &[(&Fault, Place)]) -> Vec<u32> {
    let there = |number: &u32| places.iter().any(|(fault, _)| fault.number == *number);
    let holds =
        |part: &Range<usize>, place: &Range<usize>| part.start <= place.start && place.end <= part.end;
    for (file, place) in &error.places {
        let parts = written.get(file.as_str()).into_iter().flatten();
        if let Some(part) = parts.filter(|part| holds(&part.range, place)).min_by_key(|part| part.range.len())
        {
            return part.faults.clone();
        }
    }
    for (file, place) in &error.places {
        let parts =
            written.get(file.as_str()).into_iter().flatten().filter(|part| part.faults.iter().any(there));
        if let Some(part) = parts.min_by_key(|part| part.range.start.abs_diff(place.start)) {
            return part.faults.clone();
        }
    }
    Vec::new()
}
