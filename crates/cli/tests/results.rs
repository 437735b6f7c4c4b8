//! `docs/results.md`, measured anew: the command of each row of a section is run, and its figures are looked up in the output.
//!
//! `EDGEWALK_SECTION=Timing cargo test --release -p edgewalk-cli results:: -- --ignored --nocapture` writes date and commit into
//! the rows whose figures are all printed again. It fails with the figures that are not: those the row must get by hand.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::root;
use std::path::Path;
use std::process::Command;

/// The numbers of a text, `342,727` as `342727`. What stands in brackets or is part of a word is none: `iCE40`, `(bound 4)`.
fn numbers(text: &str) -> Vec<String> {
    let mut depth = 0i32;
    let outside = text.chars().filter(|c| {
        depth += i32::from("([".contains(*c)) - i32::from(")]".contains(*c));
        depth == 0
    });
    let outside: String = outside.collect::<String>().replace(',', "\u{1}");
    let words = outside.split(|c: char| c.is_whitespace() || "/;:%×=".contains(c));
    let words = words.filter(|word| !word.contains(char::is_alphabetic));
    let words = words.map(|word| word.trim_matches(|c: char| !c.is_ascii_digit()).replace('\u{1}', ""));
    words.filter(|word| !word.is_empty() && word.chars().all(|c| c.is_ascii_digit() || c == '.')).collect()
}

/// The figures of a result that an output does not have.
fn missing(result: &str, output: &str) -> Vec<String> {
    let found: Vec<String> =
        output.lines().flat_map(|line| numbers(&line.replace(['(', ')', '[', ']'], " "))).collect();
    numbers(result).into_iter().filter(|number| !found.contains(number)).collect()
}

/// The command of a row as a shell takes it; `None` where a person has to fill in a file.
fn command(cell: &str) -> Option<String> {
    let command = cell.split('`').nth(1)?;
    let by_hand = command.split_whitespace().any(|word| word.starts_with("FILE") || word == "DIR");
    let prints = command.contains("--nocapture") || !command.starts_with("cargo test");
    let end = match (prints, command.contains(" -- ")) {
        (true, _) => "",
        (false, true) => " --nocapture",
        (false, false) => " -- --nocapture",
    };
    (!by_hand).then(|| format!("{command}{end}"))
}

fn run(command: &str) -> Option<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_edgewalk")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let shell = Command::new("sh")
        .args(["-c", &format!("{command} 2>&1")])
        .env("PATH", path)
        .current_dir(root())
        .output();
    let output = shell.unwrap();
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

fn word(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).current_dir(root()).output().unwrap();
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

/// The page with one row of a section measured anew, or why not.
fn measured(
    row: &str,
    (date, commit): (&str, &str),
    run: impl FnOnce(&str) -> Option<String>,
) -> Result<String, String> {
    let mut cells: Vec<&str> = row.split(" | ").collect();
    let [what, result, told, ..] = cells[..] else { return Err(format!("not six cells: {row}")) };
    let name = what.split('"').nth(1).unwrap_or(what);
    let command = command(told).ok_or_else(|| format!("{name}: by hand, it needs a file"))?;
    let output = run(&command).ok_or_else(|| format!("{name}: `{command}` fails"))?;
    let missing = missing(result, &output);
    if !missing.is_empty() {
        return Err(format!("{name}: `{command}` does not print {}", missing.join(", ")));
    }
    (cells[3], cells[4]) = (date, commit);
    Ok(cells.join(" | "))
}

#[test]
fn figures_of_a_row_are_found() {
    assert_eq!(
        numbers("342,727 of 342,727 values ([bound 4](x)), iCE40, 98.4 %; 5 min."),
        ["342727", "342727", "98.4", "5"]
    );
    assert_eq!(missing("mean 80, 151; 0 / 307200", "80 of (151) at 307,200 in 0.3 s"), ["0"]);
    assert_eq!(command("`edgewalk demo`; held").as_deref(), Some("edgewalk demo"));
    assert_eq!(command("`cargo test x::`").as_deref(), Some("cargo test x:: -- --nocapture"));
    assert_eq!(command("`edgewalk bench FILE.tri`"), None);
}

#[test]
fn a_row_is_measured_anew() {
    let row = "| <a id=\"demo\"></a>the demo | fragments 161,440 | `edgewalk demo`; held | 2026-11-24 | 0398464 | any |";
    let measured = |output: Option<&str>| {
        measured(row, ("2026-12-01", "0123456"), |command| {
            assert_eq!(command, "edgewalk demo");
            output.map(str::to_owned)
        })
    };
    let anew = row.replace("2026-11-24 | 0398464", "2026-12-01 | 0123456");
    assert_eq!(measured(Some("fragments 161440, writes 93913")), Ok(anew));
    let why = "demo: `edgewalk demo` does not print 161440";
    assert_eq!(measured(Some("fragments 161441")), Err(why.to_owned()));
    assert_eq!(measured(None), Err("demo: `edgewalk demo` fails".to_owned()));
}

#[test]
#[ignore = "runs every command of a section"]
fn a_section_is_measured_anew() {
    let section =
        std::env::var("EDGEWALK_SECTION").expect("EDGEWALK_SECTION names a section of docs/results.md");
    let path = root().join("docs/results.md");
    let (mut page, mut inside) = (std::fs::read_to_string(&path).unwrap(), false);
    let (date, commit) = (word("date", &["-u", "+%F"]), word("git", &["rev-parse", "--short=7", "HEAD"]));
    let (mut rows, mut faults) = (0, Vec::new());
    for line in page.clone().lines() {
        if let Some(title) = line.strip_prefix("## ") {
            inside = title == section;
        } else if inside && line.contains("<a id=\"") {
            rows += 1;
            match measured(line, (&date, &commit), run) {
                Ok(anew) => page = page.replace(line, &anew),
                Err(why) => faults.push(why),
            }
        }
    }
    std::fs::write(&path, page).unwrap();
    println!("{section}: {rows} rows, {} measured anew", rows - faults.len());
    assert!(rows > 0, "docs/results.md has no section {section} with rows");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
