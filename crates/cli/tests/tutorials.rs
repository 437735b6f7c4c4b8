//! The tutorials, as their readers go through them: each block of commands is run, what the page says of its output is compared.
//!
//! A fenced block `sh` is run by a shell; the block `text` behind it tells lines of its output, in this order. `...` stands for
//! any lines, or for any part of a line; `[exit code N]` ends it where a command is meant to fail. A block whose fence has a second
//! word is a file of that name.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::root;
use std::path::Path;
use std::process::Command;

/// The fenced blocks of a page: the words behind the fence, and the text.
fn blocks(page: &str) -> Vec<(Vec<String>, String)> {
    let mut blocks: Vec<(Vec<String>, String)> = Vec::new();
    let mut inside = false;
    for line in page.lines() {
        if let Some(words) = line.strip_prefix("```") {
            inside = !inside;
            if inside {
                blocks.push((words.split_whitespace().map(str::to_owned).collect(), String::new()));
            }
        } else if inside {
            let text = &mut blocks.last_mut().unwrap().1;
            *text += line;
            *text += "\n";
        }
    }
    assert!(!inside, "a block does not end");
    blocks
}

fn matches(printed: &str, told: &str) -> bool {
    told.split_once("...").map_or(printed == told, |(begin, end)| {
        printed.len() >= begin.len() + end.len() && printed.starts_with(begin) && printed.ends_with(end)
    })
}

/// The first line that is told and not printed behind those before it.
fn missing<'a>(printed: &str, told: &'a str) -> Option<&'a str> {
    let mut printed = printed.lines();
    told.lines().filter(|line| *line != "...").find(|line| !printed.any(|printed| matches(printed, line)))
}

/// Goes through a page of docs: how many blocks were run, and how many lines compared.
fn walked(name: &str) -> (usize, usize) {
    let page = std::fs::read_to_string(root().join("docs").join(name)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_edgewalk"));
    let path = std::env::join_paths(
        std::iter::once(program.parent().unwrap().to_owned())
            .chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    );
    let blocks = blocks(&page);
    let (mut run, mut compared) = (0, 0);
    for (at, (words, text)) in blocks.iter().enumerate() {
        match &words[..] {
            [_, file] => std::fs::write(folder.path().join(file), text).unwrap(),
            [kind] if kind == "sh" => {
                let mut shell = Command::new("sh");
                shell.args(["-e", "-c", &format!("exec 2>&1\n{text}")]).current_dir(folder.path());
                let output = shell.env("PATH", path.as_ref().unwrap()).output().unwrap();
                let printed = String::from_utf8_lossy(&output.stdout);
                let told = blocks.get(at + 1).filter(|(words, _)| words[..] == ["text"]);
                let told = told.map_or("", |(_, told)| told);
                let (told, code) = match told.split_once("[exit code ") {
                    Some((told, code)) => (told, code.trim_end().trim_end_matches(']').parse().unwrap()),
                    None => (told, 0),
                };
                assert_eq!(output.status.code(), Some(code), "{name}:\n{text}\n{printed}");
                if let Some(line) = missing(&printed, told) {
                    panic!(
                        "{name}:\n{text}\ndoes not print, behind what is told before it:\n{line}\nbut\n{printed}"
                    );
                }
                run += 1;
                compared += told.lines().filter(|line| *line != "...").count();
            }
            _ => {}
        }
    }
    println!("{name}: {run} blocks run, {compared} lines compared");
    (run, compared)
}

#[test]
fn an_architect_finds_a_machine() {
    let (run, compared) = walked("tutorial/architect.md");
    assert!(run >= 6 && compared >= 15, "{run} {compared}");
}

#[test]
fn a_foreign_design_fails_where_it_is_wrong() {
    let (run, compared) = walked("tutorial/your_rtl.md");
    assert!(run >= 7 && compared >= 18, "{run} {compared}");
}

#[test]
fn a_lecture_shows_what_it_says() {
    let (run, compared) = walked("tutorial/teach.md");
    assert!(run >= 9 && compared >= 15, "{run} {compared}");
}

#[test]
fn a_core_draws_on_a_chip() {
    let (run, compared) = walked("tutorial/chip.md");
    assert!(run >= 5 && compared >= 8, "{run} {compared}");
}

#[test]
fn a_contributor_finds_the_way() {
    let (run, compared) = walked("tutorial/contributor.md");
    assert!(run >= 3 && compared >= 2, "{run} {compared}");
}

#[test]
fn a_sweep_finds_machines_that_keep_what_is_required() {
    assert_eq!(walked("exploration.md"), (1, 7));
}

/// The blocks that build are not run here; the crates, tests and files that they name exist.
#[test]
fn commands_that_build_name_what_exists() {
    let mut checked = 0;
    for name in ["architect.md", "your_rtl.md", "teach.md", "chip.md", "contributor.md"] {
        let page = std::fs::read_to_string(root().join("docs/tutorial").join(name)).unwrap();
        for (words, text) in blocks(&page) {
            for line in text.lines().filter(|_| words.is_empty()) {
                let said: Vec<&str> = line.split_whitespace().collect();
                if let Some(at) = said.iter().position(|word| *word == "-p") {
                    let tests = root()
                        .join("crates")
                        .join(said[at + 1].trim_start_matches("edgewalk-"))
                        .join("tests");
                    for suite in said.iter().filter_map(|word| word.strip_suffix("::")) {
                        assert!(tests.join(format!("{suite}.rs")).is_file(), "{line}");
                        checked += 1;
                    }
                }
                for file in said.iter().filter(|word| word.starts_with("docs/") || word.starts_with("tests/"))
                {
                    assert!(root().join(file).exists(), "{line}");
                    checked += 1;
                }
            }
        }
    }
    assert!(checked >= 6, "{checked}");
}
