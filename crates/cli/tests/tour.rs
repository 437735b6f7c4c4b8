//! `docs/tour.md`: its commands are run, its pictures are drawn from the recordings that they write, its numbers are looked up there.
//!
//! ```text
//!  command of the page ─> edgewalk replay ─> recording ─┬─> docs/tour/NAME.svg   for each picture behind the command
//!                                                       └─> cycle | register | value   of each row behind it
//! ```
//! `EDGEWALK_BLESS=1` writes the pictures.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod figures;
mod screen;
mod wave;

use crate::support::recording::Recording;
use crate::support::{edgewalk, root};
use figures::{FIGURES, Start};

/// The recording that a command of the page writes.
fn recorded(command: &str) -> Recording {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("tour.json");
    let (before, _) = command.split_once(" --out ").expect("the command names its output last");
    let mut arguments: Vec<&str> = before.split_whitespace().skip(1).collect();
    arguments.extend(["--out", out.to_str().unwrap()]);
    let output = edgewalk(&root(), &arguments).output().unwrap();
    assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
    Recording::read(serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap())
}

/// The picture of this name, drawn from the recording.
fn drawn(name: &str, recording: &Recording) -> String {
    if name == "triangle" {
        return screen::draw(recording);
    }
    let figure = FIGURES.iter().find(|figure| figure.name == name);
    let figure = figure.unwrap_or_else(|| panic!("tests/tour/figures.rs has no picture {name}"));
    let from = match figure.start {
        Start::Fires(link, number) => {
            let fires = |cycle| {
                wave::shows(recording, &format!("{link}_valid"), cycle) == "1"
                    && wave::shows(recording, &format!("{link}_ready"), cycle) == "1"
            };
            recording.cycles().filter(|cycle| fires(*cycle)).nth(number)
        }
        Start::Rises(register) => {
            recording.cycles().find(|cycle| wave::shows(recording, register, *cycle) == "1")
        }
    };
    let from = from.unwrap_or_else(|| panic!("{name}: it never begins")).saturating_sub(figure.before);
    wave::draw(recording, figure, from)
}

#[test]
fn tour_shows_what_the_machine_does() {
    let page = std::fs::read_to_string(root().join("docs/tour.md")).unwrap();
    let bless = std::env::var_os("EDGEWALK_BLESS").is_some();
    let (mut recording, mut pictures, mut numbers) = (None, Vec::new(), 0);
    for line in page.lines() {
        if line.starts_with("edgewalk replay ") {
            recording = Some(recorded(line));
        } else if let Some(name) = line.split_once("](tour/").and_then(|(_, rest)| rest.split_once(".svg")) {
            let svg = drawn(name.0, recording.as_ref().expect("a command stands before the picture"));
            let path = root().join(format!("docs/tour/{}.svg", name.0));
            if bless {
                std::fs::write(&path, &svg).unwrap();
            }
            let kept = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(kept == svg, "docs/tour/{}.svg is not what the model does: bless it anew", name.0);
            pictures.push(name.0);
        } else if let [cycle, register, value, ..] =
            line.split('|').skip(1).map(str::trim).collect::<Vec<_>>()[..]
            && let Ok(cycle) = cycle.parse()
        {
            let recording = recording.as_ref().expect("a command stands before the numbers");
            assert_eq!(wave::shows(recording, register.trim_matches('`'), cycle), value, "{line}");
            numbers += 1;
        }
    }
    println!("{numbers} numbers, {} pictures", pictures.len());
    assert!(numbers >= 60 && pictures.len() == FIGURES.len() + 1, "{numbers} {pictures:?}");
    let files = std::fs::read_dir(root().join("docs/tour")).unwrap().count();
    assert_eq!(files, pictures.len(), "a file in docs/tour that the page does not show");
}

#[test]
fn tour_names_every_cause() {
    let page = std::fs::read_to_string(root().join("docs/tour.md")).unwrap();
    let recording = recorded(page.lines().find(|line| line.starts_with("edgewalk replay ")).unwrap());
    let causes = recording.json["causes"].as_array().unwrap();
    for cause in causes {
        let [name, means] = ["name", "means"].map(|key| cause[key].as_str().unwrap());
        assert!(page.contains(&format!("\n| `{name}` | {means} |\n")), "{name}: {means}");
    }
    assert!(causes.len() > 10);
}
