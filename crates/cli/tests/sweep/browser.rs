//! The report in a browser, opened from disk without a network: a point of the front is clicked, and its machine checked.

use super::oracle::{is, pointer};
use crate::support::{edgewalk, run};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Collects what goes wrong before the page's own script runs.
pub(super) const BEFORE: &str = "<script>window.faults = []; addEventListener('error', (e) => faults.push(e.message)); \
                      addEventListener('unhandledrejection', (e) => faults.push(String(e.reason)));</script>";

/// Uses the page as a reader does, and leaves what it saw in an element.
const AFTER: &str = r##"
  const of = (query) => document.querySelector(query), text = (query) => of(query)?.textContent ?? null;
  const click = (mark, shift) => {
    const box = mark.getBoundingClientRect();
    of("#front-chart svg").dispatchEvent(new MouseEvent("click", { clientX: box.x + box.width / 2, clientY: box.y + box.height / 2, shiftKey: shift, bubbles: true }));
  };
  const key = (name) => of("#front-chart svg").dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true }));
  click(of("#front-chart [data-point]"));
  seen.toml = text("#toml");
  seen.command = text("#command");
  seen.said = text("#said");
  seen.pictures = document.querySelectorAll("#chosen img").length;
  seen.wide = [...document.querySelectorAll("#chosen img")].every((image) => image.naturalWidth > 0);
  key("b");
  for (let i = 0; i < 5; i++) key("ArrowRight");
  key("Enter");
  seen.other = text("#toml");
  seen.diff = [...document.querySelectorAll("#diff-table tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent));
  const axis = of("#x-axis");
  axis.value = "cycles_setup";
  axis.dispatchEvent(new Event("change"));
  seen.axis = text("#front-chart svg");
  seen.sections = [...document.querySelectorAll("main section[id]")].filter((s) => !s.hidden).map((s) => s.id);
  seen.bars = document.querySelectorAll("#causes-chart rect").length;
  seen.lines = document.querySelectorAll("#parallel-chart .line").length;
  seen.bounds = document.querySelectorAll("#errors-chart .bound").length;
  await new Promise((done) => setTimeout(done, 300));
  seen.pixels = text("#pixels-said");
  const set = (query, value, event) => { const at = of(query); at.value = value; at.dispatchEvent(new Event(event)); };
  const marks = () => document.querySelectorAll("#front-chart [data-point]").length +
    [...document.querySelectorAll("#front-chart .rest")].reduce((sum, path) => sum + (path.getAttribute("d").match(/M/g) ?? []).length, 0);
  seen.all = marks();
  set("#limit-figure", "bytes", "change");
  seen.open = marks();
  set("#limit-figure", "cycles", "change");
  set("#limit-value", "400000", "input");
  seen.most = marks();
  set("#limit-way", "least", "change");
  seen.least = marks();
"##;

/// Contrast of a link to the page behind it, and the width of the column of causes in the table of the front, letters.
const READ: &str = r##"
  const light = (colour) => {
    const [r, g, b] = colour.match(/[\d.]+/g).map((v) => v / 255).map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const [link, paper] = [getComputedStyle(document.querySelector("main a[href]")).color, getComputedStyle(document.body).backgroundColor];
  const [a, b] = [light(link), light(paper)];
  seen.contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  seen.dark = b < 0.2;
  const cell = document.querySelector("#first-front tbody td:last-child");
  seen.letters = cell.getBoundingClientRect().width / parseFloat(getComputedStyle(cell).fontSize);
"##;

/// The page in headless Chromium with its network cut; what it looks like in the end.
pub(super) fn opened(page: &Path, home: &Path, arguments: &[&str]) -> String {
    let output = Command::new("chromium-headless-shell")
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--proxy-server=127.0.0.1:9",
        ])
        .args(["--hide-scrollbars", "--virtual-time-budget=20000", "--timeout=60000"])
        .arg(format!("--user-data-dir={}", home.join("profile").display()))
        .args(arguments)
        .arg(format!("file://{}", page.display()))
        .output()
        .expect("tests/run installs it: apt-get install chromium-headless-shell");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// What this script, run behind the page's own, leaves in the element `result`, as JSON. The page may make no fault and ask for nothing.
pub(super) fn seen(folder: &Path, page: &str, after: &str) -> Value {
    seen_with(folder, page, after, &[])
}

/// The same, where the browser is started with these arguments.
fn seen_with(folder: &Path, page: &str, after: &str, arguments: &[&str]) -> Value {
    let html = std::fs::read_to_string(folder.join(page)).unwrap();
    let end = "seen.requests = performance.getEntriesByType('resource').map((e) => e.name).filter((n) => !n.startsWith('data:')); \
               seen.faults = faults; const result = document.createElement('pre'); result.id = 'result'; \
               result.textContent = encodeURIComponent(JSON.stringify(seen)); document.body.append(result);";
    let after = format!("<script>(async () => {{ const seen = {{}}; {after}; {end} }})();</script></body>");
    let html = html.replacen("<head>", &format!("<head>{BEFORE}"), 1).replacen("</body>", &after, 1);
    std::fs::write(folder.join("opened.html"), html).unwrap();
    let dom = opened(&folder.join("opened.html"), folder, &[&["--dump-dom"], arguments].concat());
    let result = dom.split("<pre id=\"result\">").nth(1).unwrap_or_else(|| panic!("the script did not end"));
    let seen: Value = serde_json::from_str(&decoded(result.split('<').next().unwrap())).unwrap();
    assert_eq!(
        (&seen["faults"], &seen["requests"]),
        (&serde_json::json!([]), &serde_json::json!([])),
        "{seen}"
    );
    seen
}

fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        let digits = [rest.clone().next(), rest.clone().nth(1)].map(Option::unwrap_or_default);
        if byte == b'%' {
            bytes.push(u8::from_str_radix(std::str::from_utf8(&digits).unwrap(), 16).unwrap());
            rest.nth(1);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).unwrap()
}

#[test]
fn a_point_of_the_front_is_clicked_and_its_machine_is_the_one_of_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let sweep = [
        "sweep",
        "sphere",
        "--vary",
        "formats.z_fraction=5..9",
        "--vary",
        "interpolator.adders=1,2,4",
        "--vary",
        "setup.lanes=1,4",
        "--out",
        "s",
        "--quiet",
    ];
    assert_eq!(run(at, &sweep), (Some(0), String::new()));
    let seen = seen(at, "s/report.html", AFTER);

    // The machine file of the point: `config check` finds the hash that it names, and it is that of a row.
    let rows = super::rows(&at.join("s"));
    let mut checked = 0;
    let mut pair: Vec<&Value> = Vec::new();
    for toml in ["toml", "other"].map(|name| seen[name].as_str().unwrap()) {
        std::fs::write(at.join("point.toml"), toml).unwrap();
        let output =
            edgewalk(at, &["config", "check", "--json", "--machine", "point.toml"]).output().unwrap();
        let check: Value = serde_json::from_slice(&output.stdout).unwrap();
        let hash = check["hash"].as_str().unwrap();
        assert!(toml.starts_with(&format!("# machine {hash}\n")), "{toml}");
        pair.push(rows.iter().find(|row| row["machine"] == hash).unwrap_or_else(|| panic!("{hash}")));
        checked += 1;
    }
    assert_eq!(checked, 2);
    assert_ne!(seen["toml"], seen["other"], "arrow keys lead elsewhere");
    assert_eq!(seen["command"], "edgewalk render sphere --machine point.toml");
    assert!(seen["said"].as_str().unwrap().contains("interpolator.adders="), "{}", seen["said"]);
    assert!(seen["pictures"] == 3 && seen["wide"] == true, "{}", seen["pictures"]);
    // What differs between the two: every figure is that of their rows. The point kept first is the second of the table.
    let (a, b) = (pair[1], pair[0]);
    let diff = seen["diff"].as_array().unwrap();
    for line in diff {
        let cells: Vec<&str> = line.as_array().unwrap().iter().map(|cell| cell.as_str().unwrap()).collect();
        let of = |row: &Value| row.pointer(&pointer(cells[0]).unwrap()).and_then(Value::as_f64).unwrap();
        assert!(is(cells[1], of(a)) && is(cells[2], of(b)), "{cells:?}: {} {}", of(a), of(b));
        let change = 100.0 * (of(b) - of(a)) / of(a);
        let told: Option<f64> = cells[3].strip_suffix(" %").and_then(|told| told.parse().ok());
        assert!(
            told.is_some_and(|told| (told - change).abs() <= 0.0501) || of(a) == 0.0,
            "{cells:?}: {change}"
        );
    }
    let differ = |name: &str| pair.iter().map(|row| row.pointer(&pointer(name).unwrap())).collect::<Vec<_>>();
    for name in ["cycles", "z_error", "word_bits", "lanes", "setup_mean"] {
        let [a, b] = differ(name)[..] else { panic!() };
        assert_eq!(a != b, diff.iter().any(|line| line[0] == name), "{name}");
    }
    assert!(seen["axis"].as_str().unwrap().contains("cycles_setup"));
    let sections = ["front", "errors", "causes", "parallel", "diff", "tables", "pictures"];
    assert!(
        sections.iter().all(|id| seen["sections"].as_array().unwrap().iter().any(|s| s == id)),
        "{}",
        seen["sections"]
    );
    for count in ["bars", "lines", "bounds"] {
        assert!(seen[count].as_u64() > Some(0), "{count}");
    }
    // A limit leaves the marks of the rows that keep it.
    let cycles = |row: &&Value| row["report"]["cycles"]["total"].as_u64() <= Some(400_000);
    let quick = rows.iter().filter(cycles).count();
    assert!(quick > 0 && quick < rows.len(), "{quick}");
    for (shown, wanted) in
        [("all", rows.len()), ("open", rows.len()), ("most", quick), ("least", rows.len() - quick)]
    {
        assert_eq!(seen[shown], wanted, "{shown}");
    }
}

#[test]
fn links_and_causes_can_be_read_by_day_and_by_night() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let keys = ["formats.z_fraction=6,9", "formats.color_fraction=6,8", "interpolator.adders=1,2"];
    let vary = keys.iter().flat_map(|key| ["--vary", key]);
    let sweep: Vec<&str> = ["sweep", "sphere"].into_iter().chain(vary).collect();
    let small = ["--set", "screen.width=64", "--set", "screen.height=48", "--out", "s", "--quiet"];
    assert_eq!(run(at, &[&sweep[..], &small].concat()), (Some(0), String::new()));
    for (dark, arguments) in [
        (false, &["--window-size=1000,900"][..]),
        (true, &["--window-size=1000,900", "--blink-settings=preferredColorScheme=0"]),
    ] {
        let seen = seen_with(at, "s/report.html", READ, arguments);
        assert_eq!(seen["dark"], dark, "{seen}");
        assert!(seen["contrast"].as_f64() >= Some(4.5) && seen["letters"].as_f64() >= Some(20.0), "{seen}");
    }
}
