//! README is one screen, names every command, and claims only figures that `docs/results.md` has.

use std::collections::BTreeSet;
use std::process::Command;

const MOST_LINES: usize = 90;
const MOST_CHARACTERS: usize = 400;
const MOST_FIGURES: usize = 8;

fn page(name: &str) -> String {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The paragraphs, headings and table rows outside of fenced blocks, each in one line.
fn prose(text: &str) -> Vec<String> {
    let (mut found, mut fenced, mut goes_on) = (Vec::<String>::new(), false, false);
    for line in text.lines() {
        let fence = line.starts_with("```");
        fenced ^= fence;
        if fence || fenced || line.is_empty() {
            goes_on = false;
            continue;
        }
        let begins = line.starts_with(['#', '|', '-']);
        match found.last_mut().filter(|_| goes_on && !begins) {
            Some(paragraph) => *paragraph += &format!(" {}", line.trim()),
            None => found.push(line.to_owned()),
        }
        goes_on = !line.starts_with(['#', '|']);
    }
    found
}

/// The numbers of a text, as `0.530`, without a point or comma at their end. `iCE40` is a name.
fn numbers(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| c.is_whitespace() || "()[]|*/×:;".contains(c));
    let words = words.map(|word| word.trim_end_matches(['.', ',', '%', '?', '!']));
    words.filter(|word| word.starts_with(|c: char| c.is_ascii_digit())).collect()
}

/// The links of a line, `[text](target)`, and the line without them and without its inline code.
fn links(line: &str) -> (Vec<(&str, &str)>, String) {
    let (mut found, mut rest, mut at) = (Vec::new(), String::new(), line);
    while let Some(middle) = at.find("](") {
        let Some(open) = at[..middle].rfind('[') else { break };
        let end = middle + at[middle..].find(')').expect("a link ends");
        rest += &at[..open];
        found.push((&at[open + 1..middle], &at[middle + 2..end]));
        at = &at[end + 1..];
    }
    rest += at;
    (found, rest.split('`').step_by(2).collect())
}

#[test]
fn readme_is_one_screen() {
    let readme = page("README.md");
    let lines = readme.lines().count();
    assert!(lines <= MOST_LINES, "{lines} lines");
    for line in readme.lines() {
        let characters = line.chars().count();
        assert!(characters <= MOST_CHARACTERS, "{characters} characters: {line}");
    }
}

#[test]
fn every_figure_of_readme_has_a_row() {
    let (readme, results) = (page("README.md"), page("docs/results.md"));
    let (mut figures, mut claimed, mut claims) = (0, 0, false);
    for line in &prose(&readme) {
        if let Some(title) = line.strip_prefix("## ") {
            claims = title == "What is claimed";
        }
        let (links, rest) = links(line);
        assert_eq!(numbers(&rest), [""; 0], "a figure without a row: {line}");
        for (text, target) in links {
            let found = numbers(text);
            let Some(row) = target.strip_prefix("docs/results.md#").filter(|_| !found.is_empty()) else {
                assert!(found.is_empty(), "a figure links to no row: [{text}]({target})");
                continue;
            };
            let anchor = format!("<a id=\"{row}\"></a>");
            let row = results.lines().find(|line| line.contains(&anchor));
            let row = numbers(row.unwrap_or_else(|| panic!("results.md has no row {target}")));
            for number in found {
                assert!(row.contains(&number), "{target} does not say {number}, only {row:?}");
                figures += 1;
            }
            claimed += usize::from(claims);
        }
    }
    println!("{figures} figures, {claimed} of them in `What is claimed`");
    assert!(figures >= MOST_FIGURES && (1..=MOST_FIGURES).contains(&claimed));
}

#[test]
fn every_command_stands_in_readme() {
    let help = Command::new(env!("CARGO_BIN_EXE_edgewalk")).arg("--help").output().expect("the program runs");
    let help = String::from_utf8(help.stdout).expect("text");
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    // The first word of a line of the list; text that goes on is indented further.
    let names = listed.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let commands: BTreeSet<&str> = names.filter_map(|line| line.split_whitespace().next()).collect();
    let readme = page("README.md");
    let table = readme.lines().skip_while(|line| !line.starts_with("| command |")).skip(2);
    let rows = table.take_while(|line| line.starts_with('|'));
    let first = rows.filter_map(|row| row.split('|').nth(1)).collect::<Vec<_>>().join(" ");
    let told: BTreeSet<&str> = first.split('`').skip(1).step_by(2).collect();
    let commands: BTreeSet<&str> = commands.into_iter().filter(|name| *name != "help").collect();
    assert!(commands.len() > 15, "{commands:?}");
    assert_eq!(told, commands);
}

#[test]
fn every_row_of_results_is_whole() {
    let results = page("docs/results.md");
    let (mut rows, mut anchors) = (0, BTreeSet::new());
    for line in results.lines().filter(|line| line.contains("<a id=\"")) {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [what, result, command, date, commit, on] = cells[..] else { panic!("not six cells: {line}") };
        let anchor = what.split('"').nth(1).expect("a name");
        assert!(anchors.insert(anchor), "{anchor} stands twice");
        assert!(!result.is_empty() && command.starts_with('`'), "{line}");
        let parts: Vec<usize> = date.split('-').map(str::len).collect();
        assert_eq!(parts, [4, 2, 2], "{line}");
        let hash = commit.rsplit(' ').next().expect("a commit");
        assert!(hash.len() == 7 && hash.chars().all(|c| c.is_ascii_hexdigit()), "{line}");
        assert!(["any", "`quiet`", "`busy`"].contains(&on), "{line}");
        rows += 1;
    }
    println!("{rows} rows");
    assert!(rows >= 30);
}
