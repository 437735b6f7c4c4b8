//! Sentences that a user reads are short and plain (`CONTRIBUTING.md`): comments of emitted Verilog, help texts, comments of the code.

use std::path::{Path, PathBuf};
use std::process::Command;

const MOST_WORDS: usize = 25;

/// Phrases that no reader should meet in Verilog or help.
const BANNED: &[&str] = &[
    "come by",
    "for eyes",
    "so manieth",
    "who wants",
    "the same;",
    "as above",
    "as below",
    "what is there",
    "what there is",
    "means nothing",
    "moves on",
    "nothing in flight",
    "what lies",
    // P is a letter of the specification; a unit says its number.
    "1/p",
    "u/p",
    "v/p",
];

/// A machine of each kind of unit, beside the presets.
const MACHINES: &[&[&str]] = &[
    &["shade.kind=phong", "shade.light=positional", "shade.colour=multiply", "texture.kind=nearest"],
    &["shade.kind=phong", "shade.colour=multiply", "texture.kind=nearest", "texture.bump=yes"],
    &["shade.kind=fast-phong", "shade.lights=2", "term.walk=memory", "interpolator.adders=2"],
    &["shadow.light=parallel", "shadow.gate=scale", "interpolator.segments=2", "setup.lanes=2"],
    &["shadow.light=perspective", "shadow.transmits=yes", "shadow.own_pass=yes", "blend.kind=constant"],
    &["shadow.light=perspective", "shadow.project=serial", "blend.kind=constant", "blend.multipliers=0"],
    &["blend.kind=interpolated", "blend.multipliers=1", "blend.stages=2", "memory.tag_bits=8"],
    &["memory.hazard=interlock", "channels.extra=2", "edge.kind=slope", "fifo.span=4"],
    &["setup.kind=sequenced"],
    &["polygon.lines=yes", "dither.bits=5"],
];

fn edgewalk(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk")).args(arguments).output().expect("it runs");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// What is wrong with a text: each sentence that is too long, each phrase that is banned.
fn faults(text: &str) -> Vec<String> {
    let lower = text.to_lowercase();
    // A phrase, not a part of longer words.
    let apart = |phrase: &str, at: usize| {
        !lower[..at].ends_with(char::is_alphabetic)
            && !lower[at + phrase.len()..].starts_with(char::is_alphabetic)
    };
    let is_there = |phrase: &str| lower.match_indices(phrase).any(|(at, _)| apart(phrase, at));
    let banned = BANNED.iter().filter(|phrase| is_there(phrase));
    let mut found: Vec<String> = banned.map(|phrase| format!("`{phrase}` in: {text}")).collect();
    let mut words = 0;
    for word in text.split_whitespace() {
        words += 1;
        if word.ends_with(['.', ';', ':', '?']) {
            words = 0;
        }
        if words == MOST_WORDS + 1 {
            found.push(format!("a sentence of more than {MOST_WORDS} words: {text}"));
        }
    }
    found
}

/// The comments of a Verilog file: paragraphs of whole lines, without drawings and tables, and what stands behind code.
fn comments(verilog: &str) -> Vec<String> {
    let mut found = vec![String::new()];
    for line in verilog.lines() {
        let line = line.trim();
        let whole = line.strip_prefix("//").map(|text| text.strip_prefix(' ').unwrap_or(text));
        match whole {
            Some(text) if !text.is_empty() && !text.starts_with(' ') => {
                let paragraph = found.last_mut().expect("one is there");
                *paragraph += text;
                paragraph.push(' ');
            }
            _ => {
                found.push(String::new());
                if let (None, Some((_, behind))) = (whole, line.split_once("// ")) {
                    found.push(behind.to_owned());
                    found.push(String::new());
                }
            }
        }
    }
    found.retain(|text| !text.is_empty());
    found
}

#[test]
fn sentences_of_verilog_are_short() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut machines: Vec<Vec<String>> = ["default", "textbook", "small", "ecp5"]
        .map(|preset| vec!["--machine".to_owned(), preset.to_owned()])
        .to_vec();
    let set = |key: &&str| ["--set".to_owned(), (*key).to_owned()];
    machines.extend(MACHINES.iter().map(|keys| keys.iter().flat_map(set).collect()));
    let (mut checked, mut found) = (0, Vec::new());
    for (at, machine) in machines.iter().enumerate() {
        let out = folder.path().join(at.to_string());
        let mut arguments = vec!["emit", "--quiet", "--out", out.to_str().expect("a name")];
        arguments.extend(machine.iter().map(String::as_str));
        edgewalk(&arguments);
        for entry in std::fs::read_dir(&out).expect("the files") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|end| end != "v") {
                continue;
            }
            for comment in comments(&std::fs::read_to_string(&path).expect("text")) {
                for fault in faults(&comment) {
                    if !found.contains(&fault) {
                        found.push(fault);
                    }
                }
                checked += 1;
            }
        }
    }
    println!("{checked} comments of {} machines", machines.len());
    assert!(checked > 1000, "{checked}");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Every page of help, with the command that prints it.
fn pages() -> Vec<(Vec<String>, String)> {
    let (mut waiting, mut pages) = (vec![Vec::new()], Vec::new());
    while let Some(command) = waiting.pop() {
        let mut arguments: Vec<&str> = command.iter().map(String::as_str).collect();
        arguments.push("--help");
        let page = edgewalk(&arguments);
        let listed = page.lines().skip_while(|line| *line != "Commands:").skip(1);
        for line in listed.take_while(|line| !line.is_empty()) {
            let name = line.trim_start().split(' ').next().expect("a name");
            if line.starts_with("  ") && !line.starts_with("   ") && name != "help" {
                waiting.push([command.clone(), vec![name.to_owned()]].concat());
            }
        }
        pages.push((command, page));
    }
    pages
}

#[test]
fn sentences_of_help_are_short() {
    let (mut checked, mut found) = (0, Vec::new());
    let pages = pages();
    for (command, page) in &pages {
        let told = page.split("\nExamples:").next().expect("a part");
        let (mut paragraphs, mut indent) = (vec![String::new()], 0);
        for line in told.lines() {
            let here = line.len() - line.trim_start().len();
            let begins = line.trim_start().starts_with('-') || (here <= 2 && indent > 2);
            if line.trim().is_empty() || begins || (here == 2 && indent == 2) {
                paragraphs.push(String::new());
            }
            let paragraph = paragraphs.last_mut().expect("one is there");
            *paragraph += line.trim();
            paragraph.push(' ');
            indent = here;
        }
        for paragraph in
            paragraphs.iter().filter(|text| !text.trim().is_empty() && !text.starts_with("Usage"))
        {
            // A list in brackets is no sentence.
            let text = paragraph.split(" [").next().expect("a part");
            found.extend(faults(text).into_iter().map(|fault| format!("{command:?}: {fault}")));
            checked += 1;
        }
    }
    println!("{checked} paragraphs of {} pages", pages.len());
    assert!(checked > 300 && pages.len() > 20, "{checked} {}", pages.len());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

/// The doc comments of every crate, each with its file.
fn doc_comments() -> Vec<(PathBuf, String)> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    for entry in std::fs::read_dir(crates).expect("the crates") {
        let folder = entry.expect("an entry").path().join("src");
        if folder.is_dir() {
            sources(&folder, &mut files);
        }
    }
    let mut comments: Vec<(PathBuf, String)> = Vec::new();
    for file in &files {
        let (text, mut goes_on) = (std::fs::read_to_string(file).expect("text"), false);
        for line in text.lines().map(str::trim) {
            let body = line.strip_prefix("///").or_else(|| line.strip_prefix("//!"));
            match (body, comments.last_mut().filter(|_| goes_on)) {
                (Some(body), Some((_, comment))) => *comment += body,
                (Some(body), None) => comments.push((file.clone(), body.trim().to_owned())),
                (None, _) => {}
            }
            goes_on = body.is_some();
        }
    }
    assert!(comments.len() > 3000, "{}", comments.len());
    comments
}

#[test]
fn comments_have_no_riddles() {
    const RIDDLES: &[&str] =
        &["come by", "for eyes", "so manieth", "who wants", "The same;", "means nothing"];
    let (comments, mut found) = (doc_comments(), Vec::new());
    for (file, comment) in &comments {
        let riddle = RIDDLES.iter().find(|riddle| comment.contains(**riddle));
        found.extend(riddle.map(|riddle| format!("{}: `{riddle}` in: {comment}", file.display())));
    }
    println!("{} comments", comments.len());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn comments_begin_with_a_subject() {
    const PRONOUNS: &[&str] = &[
        "It", "Its", "They", "Their", "He", "She", "Who", "Whoever", "Whose", "That", "This", "These",
        "Those",
    ];
    let (comments, mut found) = (doc_comments(), Vec::new());
    for (file, comment) in &comments {
        let first = comment.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
        if PRONOUNS.contains(&first) {
            found.push(format!("{}: {comment}", file.display()));
        }
    }
    println!("{} comments", comments.len());
    assert!(found.is_empty(), "{}", found.join("\n"));
}
