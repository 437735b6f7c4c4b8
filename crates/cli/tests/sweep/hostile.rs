//! Names and rows of other people: shown as they are, never run.

use super::browser::seen;
use super::oracle::data;
use crate::support::{TRIANGLE, csv, edgewalk, run};
use serde_json::Value;

/// Names of files that a page, a table or a shell might take for something else.
const NAMES: [&str; 4] = [
    "a\"<b>,.tri",
    "<!--<script>.tri",
    "=HYPERLINK(\"x\",1).tri",
    "it's </script><img src=x onerror=alert(1)>.tri",
];

/// What a reader sees of the names, and whether anything of them became an element.
const AFTER: &str = r##"
  seen.title = document.querySelector("h1").textContent;
  seen.command = document.querySelector(".command code").textContent;
  seen.foreign = document.querySelectorAll("b, img[src='x'], main script, header script").length;
  seen.inputs = [...document.querySelectorAll("#front-chart .legend li")].map((li) => li.textContent);
  seen.headings = [...document.querySelectorAll("#pictures h3")].map((h) => h.textContent);
  seen.chosen = document.querySelector("#chosen h3").textContent;
  seen.told = document.querySelector("#command").textContent;
  seen.none = [...document.querySelectorAll("#errors-chart .none")].map((t) => t.textContent);
  seen.bars = [...document.querySelectorAll("#causes-chart .bar-label")].length;
"##;

#[test]
fn best_machine_of_a_name_with_a_line_break_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let name = "a\nb\r.tri";
    std::fs::write(at.join(name), TRIANGLE).unwrap();
    std::fs::write(at.join("c.tri"), TRIANGLE).unwrap();
    let weight = format!("{name}=2");
    let sweep =
        ["sweep", name, "c.tri", "--weight", &weight, "--vary", "fifo.span=1", "--out", "s", "--quiet"];
    assert_eq!(run(at, &sweep), (Some(0), String::new()));
    let best = std::fs::read_to_string(at.join("s/best_cycles.toml")).unwrap();
    assert!(best.starts_with("# machine ") && best.contains("a b .tri times 2"), "{best}");
    let (code, error) = run(at, &["config", "check", "--machine", "s/best_cycles.toml"]);
    assert_eq!((code, error.as_str()), (Some(0), ""));
}

#[test]
fn names_of_files_are_shown_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    // A name with a slash lies in a folder of its own.
    let files: Vec<String> = NAMES.iter().map(|name| name.replace("</", "<\u{2215}")).collect();
    for name in &files {
        std::fs::write(at.join(name), TRIANGLE).unwrap();
    }
    let mut sweep = vec!["sweep"];
    sweep.extend(files.iter().map(String::as_str));
    sweep.extend(["--vary", "formats.z_fraction=4..6", "--out", "s", "--quiet"]);
    assert_eq!(run(at, &sweep), (Some(0), String::new()));

    // The table, by a reader of CSV: each name is one field, and none of them a formula.
    let table = csv(&at.join("s/runs.csv"));
    let place = table[0].iter().position(|name| name == "input").unwrap();
    let mut read: Vec<String> = Vec::new();
    for record in &table[1..] {
        assert!(
            record
                .iter()
                .all(|field| field.parse::<f64>().is_ok() || !field.starts_with(['=', '+', '-', '@'])),
            "{record:?}"
        );
        if !read.iter().any(|name| *name == record[place]) {
            read.push(record[place].clone());
        }
    }
    let own: Vec<String> = files
        .iter()
        .map(|name| if name.starts_with('=') { format!("'{name}") } else { name.clone() })
        .collect();
    assert_eq!(read, own);

    // The page, in a browser.
    let html = std::fs::read_to_string(at.join("s/report.html")).unwrap();
    assert_eq!(data(&html)["inputs"], serde_json::json!(files));
    let seen = seen(at, "s/report.html", AFTER);
    assert_eq!(seen["foreign"], 0, "{seen}");
    assert_eq!(seen["title"], format!("3 machines on {}", files.join(", ")));
    assert_eq!(seen["inputs"], serde_json::json!(files));
    assert!(seen["chosen"].as_str().unwrap().contains(files[0].as_str()), "{seen}");
    assert!(
        seen["headings"].as_array().unwrap().iter().all(|h| files
            .iter()
            .any(|name| h.as_str().unwrap().starts_with(&format!("{name} on machine ")))),
        "{seen}"
    );
    assert!(seen["bars"].as_u64() > Some(3), "{seen}");

    // The command of the page makes the same sweep in a shell: no row is missing.
    let program = format!("'{}'", env!("CARGO_BIN_EXE_edgewalk"));
    let shell = |command: &str| {
        let line = command.replacen("edgewalk", &program, 1) + " --json";
        let output = std::process::Command::new("sh").args(["-c", &line]).current_dir(at).output().unwrap();
        serde_json::from_slice::<Value>(&output.stdout)
            .unwrap_or_else(|e| panic!("{line}: {e}: {}", String::from_utf8_lossy(&output.stderr)))
    };
    let told = shell(seen["command"].as_str().unwrap());
    assert_eq!((&told["made"], &told["rows"]), (&Value::from(0), &Value::from(12)), "{}", seen["command"]);
}

#[test]
fn the_command_of_a_page_makes_its_sweep() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let sweep = [
        "sweep",
        "sphere",
        "--machine",
        "small",
        "--set",
        "interpolator.adders=1",
        "--vary",
        "formats.z_fraction=6..9",
        "--vary",
        "memory.hazard=drain,forward",
        "--shading",
        "constant",
        "--stalls",
        "none",
        "--stalls",
        "fixed:rd=2",
        "--judge",
        "fixed:rd=2",
        "--sample",
        "5",
        "--seed",
        "3",
        "--bound",
        "3.5",
        "--objective",
        "cycles",
        "--objective",
        "z_mean",
        "--out",
        "out put",
    ];
    let sweep = sweep.map(|word| if word == "z_mean" { "z_bound" } else { word });
    assert_eq!(run(at, &[&sweep[..], &["--quiet"]].concat()), (Some(0), String::new()));
    let html = std::fs::read_to_string(at.join("out put/report.html")).unwrap();
    let command = html.split_once("<p class=\"command\"><code>").unwrap().1.split("</code>").next().unwrap();
    let kept = |out: &str| std::fs::read_to_string(at.join(out).join("sweep.json")).unwrap();
    let before = kept("out put");
    let line =
        super::oracle::plain(command).replacen("edgewalk", env!("CARGO_BIN_EXE_edgewalk"), 1) + " --json";
    std::fs::remove_file(at.join("out put/sweep.json")).unwrap();
    let output = std::process::Command::new("sh").args(["-c", &line]).current_dir(at).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{line}: {e}"));
    assert_eq!((&told["made"], &told["points"]), (&Value::from(0), &Value::from(10)), "{line}");
    assert_eq!(kept("out put"), before, "{line}");
}

#[test]
fn a_row_with_markup_is_refused_or_shown_as_text() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let plan =
        ["sweep", "plan", "a.tri", "--vary", "setup.lanes=1,4", "--chunks", "2", "--out", "s", "--quiet"];
    assert_eq!(run(at, &plan).0, Some(0));
    for chunk in ["0", "1"] {
        assert_eq!(run(at, &["sweep", "run", "--out", "s", "--quiet", "--chunk", chunk]).0, Some(0));
    }
    let path = at.join("s/chunks/1.jsonl");
    let mut row: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    // A reason is free text; it comes from tools, or from another machine.
    row["status"] = "failed".into();
    row["reason"] = "</script><script>alert(1)</script><!-- =1+1".into();
    std::fs::write(&path, format!("{row}\n")).unwrap();
    assert_eq!(run(at, &["sweep", "merge", "--out", "s", "--quiet"]).0, Some(0));
    let seen = seen(
        at,
        "s/report.html",
        "seen.reason = document.querySelector('header li').textContent; seen.scripts = document.querySelectorAll('script').length;",
    );
    assert_eq!(seen["reason"], "failed: </script><script>alert(1)</script><!-- =1+1");
    // The collector of faults, the data, the page's own, this test's.
    assert_eq!(seen["scripts"], 4, "{seen}");
    let output = edgewalk(at, &["sweep", "merge", "--out", "s"]).output().unwrap();
    assert!(String::from_utf8_lossy(&output.stdout).contains("first failed: </script>"));
}
