//! `edgewalk replay` as a user runs it: what it writes, what it refuses and in which words.

use crate::support::{self, HALF, PASSES, SCREEN, TRIANGLE, edgewalk, names, run};
use std::path::Path;

fn replay(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    let (code, error) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {error}");
    let out = arguments.iter().position(|a| *a == "--out").expect("--out") + 1;
    let text = std::fs::read_to_string(folder.join(arguments[out])).expect("written");
    let json = match text.split_once("<script type=\"application/json\" id=\"replay\">") {
        Some((_, rest)) => rest.split_once("</script>").expect("an end").0.to_owned(),
        None => text,
    };
    serde_json::from_str(&json).expect("JSON")
}

#[test]
fn one_file_without_any_address() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).expect("written");
    let page = replay(folder.path(), &["replay", "t.tri", "--out", "out/t.html", "-q"]);
    assert_eq!(names(&folder.path().join("out")), ["t.html"]);
    let json = replay(folder.path(), &["replay", "t.tri", "--out", "t.json", "-q"]);
    assert_eq!(page, json, "page and recording say the same");
    assert_eq!((&page["format"], &page["scene"]["of"]), (&"edgewalk-replay".into(), &1.into()));
    let text = std::fs::read_to_string(folder.path().join("out/t.html")).expect("written");
    for address in ["http:", "https:", "//cdn", "src=", "@import", "url("] {
        assert!(!text.contains(address), "{address} stands in the page");
    }
    assert!(text.len() < 300_000 && text.contains("default-src 'none'"));
}

/// A part of a run is that part of the whole run: the same cycle, and the picture as it was.
#[test]
fn a_part_is_that_part_of_the_run() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).expect("written");
    let whole = replay(folder.path(), &["replay", "t.tri", "--out", "a.json", "-q"]);
    let cycles = whole["cycles"].as_u64().expect("cycles");
    let last = (cycles - 1).to_string();
    let part = replay(
        folder.path(),
        &["replay", "t.tri", "--from", "400", "--cycles", "50", "--out", "b.json", "-q"],
    );
    assert_eq!((&part["from"], &part["cycles"]), (&400.into(), &50.into()));
    let part =
        replay(folder.path(), &["replay", "t.tri", "--from", "400", "--to", &last, "--out", "b.json", "-q"]);
    assert_eq!(part["cycles"], cycles - 400);
    let stalled = replay(folder.path(), &["replay", "t.tri", "--stalls", "mixed", "--out", "b.json", "-q"]);
    assert!(stalled["cycles"].as_u64() > Some(cycles), "stalls take time");
    // Those that `render` knows, and in as many cycles.
    let dram = ["--stalls", "dram:miss=9"];
    let stalled = replay(folder.path(), &[&["replay", "t.tri", "--out", "b.json", "-q"], &dram[..]].concat());
    let render = ["render", "t.tri", "--json", "--out", "r"];
    let output = edgewalk(folder.path(), &[&render[..], &dram, &SCREEN].concat()).output().expect("runs");
    let drawn: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(stalled["cycles"], drawn["cycles"]["total"]);
    assert!(stalled["cycles"].as_u64() > Some(cycles + 100));
}

#[test]
fn the_lesson_needs_no_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let lesson = replay(folder.path(), &["replay", "--lesson", "--out", "l.html", "-q"]);
    let steps = lesson["lesson"].as_array().expect("steps");
    let checks = steps.iter().flat_map(|step| step["parts"].as_array().into_iter().flatten());
    let checks: Vec<_> = checks.filter(|part| part["check"].is_object()).collect();
    assert!(
        checks.len() > 100 && checks.iter().all(|part| part["check"]["same"] == true),
        "{}",
        checks.len()
    );
}

/// On a machine with POLY the lesson walks the slides' polygon. Its edge table is that of the page.
#[test]
fn the_lesson_of_poly_walks_a_polygon() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut checked = 0;
    for more in [&[][..], &["--set", "edge.kind=slope"], &["--set", "polygon.lines=yes"]] {
        let command = ["replay", "--lesson", "--machine", "polygon", "--out", "l.html", "-q"];
        let lesson = replay(folder.path(), &[&command[..], more].concat());
        let steps = lesson["lesson"].as_array().expect("steps");
        let titles: Vec<&str> = steps.iter().filter_map(|step| step["title"].as_str()).collect();
        // Six edges, three steps before the lines, ten lines.
        assert_eq!(titles.len(), 19, "{titles:?}");
        assert!(titles.contains(&"Edge 5") && titles.contains(&"Line 10"), "{titles:?}");
        for part in steps.iter().flat_map(|step| step["parts"].as_array().into_iter().flatten()) {
            if part["check"].is_object() {
                assert_eq!(part["check"]["same"], true, "{part}");
                checked += 1;
            }
        }
        let last = steps.last().expect("steps")["parts"].to_string();
        assert!(last.contains("pair_left") && last.contains("r.V"), "{last}");
    }
    println!("checked {checked} numbers");
    assert!(checked > 300);
}

/// What every channel of a fragment is off, one of the user's own too: less than is proved, and not nothing.
#[test]
fn each_channel_is_within_its_bound_of_the_truth() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = TRIANGLE.replace("T 0", "extra 2\nT 0") + "X -30 0.25 0 1 200.5 0.5\n";
    std::fs::write(folder.path().join("t.tri"), own).expect("written");
    let own = "channels.extra=2 channels.e0_kind=signed channels.e0_bits=9 channels.e1_kind=unorm channels.e1_bits=10";
    let own: Vec<&str> = own.split(' ').flat_map(|setting| ["--set", setting]).collect();
    let page = replay(folder.path(), &[&["replay", "t.tri", "--out", "t.json", "-q"], &own[..]].concat());
    let kinds = page["tokens"].as_array().expect("kinds of tokens");
    let fragment = kinds.iter().find(|kind| kind["name"] == "fragment").expect("fragments");
    let truth = fragment["truth"].as_array().expect("channels");
    let named: Vec<&str> = truth.iter().filter_map(|channel| channel["field"].as_str()).collect();
    assert_eq!(named, ["z", "r", "g", "b", "e0", "e1"]);
    for channel in truth {
        let [largest, bound] = ["largest", "bound"].map(|key| channel[key].as_f64().expect("a number"));
        assert!(largest > 0.2 && largest <= bound + 1.0 / 1024.0, "{channel}");
    }
}

/// An edge of POLY with few fraction bits leaves its place, and colours between edges err by what that shifts: as `render` says.
#[test]
fn bilinear_colours_have_the_bound_of_their_edges() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = "size 32 24\nT 2 1 0.5 1 0 0 0   30 3 0.5 0 1 0 0   5 22 0.5 0 0 1 0\n";
    std::fs::write(folder.path().join("t.tri"), file).expect("written");
    let machine = ["--machine", "bilinear", "--set", "edge.fraction_bits=8"];
    let page = replay(folder.path(), &[&["replay", "t.tri", "--out", "t.json", "-q"], &machine[..]].concat());
    let rendered = [&["render", "t.tri", "--out", "r", "--json"], &machine[..]].concat();
    let report = support::report(&edgewalk(folder.path(), &rendered).output().expect("runs"));
    let kinds = page["tokens"].as_array().expect("kinds of tokens");
    let fragment = kinds.iter().find(|kind| kind["name"] == "fragment").expect("fragments");
    let rendered = report["comparison"]["color_bound"].as_f64().expect("a number");
    let mut worst = 0.0f64;
    for colour in &fragment["truth"].as_array().expect("channels")[1..4] {
        let [largest, bound] = ["largest", "bound"].map(|key| colour[key].as_f64().expect("a number"));
        assert!(largest <= bound + 1.0 / 1024.0, "{colour}");
        assert!((bound - rendered).abs() < 1e-9, "{bound}, and {rendered} of render");
        worst = worst.max(largest);
    }
    assert!(worst > 0.6, "{worst}: more than with edges in their places");
}

/// Normals, of more triangles than there are records at once.
pub const NORMALS: &str = "size 32 32
mode fast-phong
view 0 0 1
sun 0.3 0.3 1 0.7
material 0.1 0.7 0.5 40
T 1 1 0.5 0 0.2 1 0  31 1 0.5 0 0.2 1 0  1 31 0.5 0 0.2 1 0
N -0.3 -0.3 0.9055  0.5 -0.3 0.8124  -0.3 0.5 0.8124
T 20 31 0.4 1 0.5 0 0  31 31 0.4 1 0.5 0 0  31 12 0.4 1 0.5 0 0
N 0 0 1  0 0 1  0.6 0 0.8
T 2 31 0.4 1 0.5 0 0  12 31 0.4 1 0.5 0 0  6 12 0.4 1 0.5 0 0
N 0 0 1  0 0 1  0.6 0 0.8
";

/// Whatever the machine draws it shows: the units that it has, in as many cycles as it draws in.
#[test]
fn every_unit_appears_where_the_machine_has_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let phong = NORMALS.replace("fast-phong", "phong");
    let files = [("passes.tri", PASSES), ("half.tri", HALF), ("fast.tri", NORMALS), ("phong.tri", &phong)];
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let (mut checked, mut colours) = (0, 0);
    for (file, settings, units) in [
        ("passes.tri", &["blend.kind=constant"][..], &["blend"][..]),
        ("half.tri", &["shadow.light=parallel", "shadow.size=4", "shadow.gate=scale"], &["shadow"]),
        (
            "half.tri",
            &["shadow.light=parallel", "shadow.size=4", "shadow.gate=scale", "blend.kind=constant"],
            &["shadow", "blend"],
        ),
        (
            "half.tri",
            &["shadow.light=perspective", "shadow.size=4", "shadow.gate=scale"],
            &["project", "shadow"],
        ),
        ("fast.tri", &["shade.kind=fast-phong", "term.record_bits=1"], &["term", "shade"]),
        ("phong.tri", &["shade.kind=phong", "term.walk=memory"], &["term", "normal", "shade"]),
    ] {
        let set: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
        let shown = replay(
            folder.path(),
            &[&["replay", file, "--triangles", "9", "--out", "r.json", "-q"], &set[..]].concat(),
        );
        let raster = ["raster", file, "--engine", "model", "--json", "--out", "m"];
        let output = edgewalk(folder.path(), &[&raster[..], &set].concat()).output().expect("runs");
        let drawn: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(shown["cycles"], drawn["cycles"]["total"], "{file} {settings:?}");
        assert!(shown["cycles"].as_u64() > Some(100));
        let names: Vec<&str> = shown["units"]
            .as_array()
            .expect("units")
            .iter()
            .filter_map(|unit| unit["name"].as_str())
            .collect();
        assert!(units.iter().all(|unit| names.contains(unit)), "{file}: {names:?}");
        let registers = shown["registers"].as_array().expect("registers");
        assert!(registers.iter().all(|register| register["changes"].as_u64() >= Some(1)));
        let light =
            shown["store"]["planes"].as_array().expect("planes").iter().any(|plane| plane["title"] == "Lit");
        assert_eq!(light, units.contains(&"shadow"));
        checked += units.len();
        // A token shows the colour that its pixel gets; others with colours have more bits than a screen.
        for token in shown["tokens"].as_array().expect("tokens") {
            let fields = token["fields"].as_array().expect("fields");
            let place = |name: &str| fields.iter().position(|field| field["name"] == name);
            let colour = place("addr").is_some_and(|place| place == 0).then(|| ["r", "g", "b"].map(place));
            let told = colour.filter(|places| places.iter().all(Option::is_some));
            assert_eq!(token["swatch"], serde_json::json!(told), "{token}");
            colours += usize::from(told.is_some());
        }
    }
    assert_eq!(checked, 11);
    assert!(colours > 0);
}

#[test]
fn what_cannot_be_shown_is_refused_in_words() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).expect("written");
    std::fs::write(folder.path().join("empty.tri"), "size 8 8\n").expect("written");
    let cleared = TRIANGLE.to_owned() + "clear_depth\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n";
    std::fs::write(folder.path().join("cleared.tri"), cleared).expect("written");
    std::fs::write(folder.path().join("normals.tri"), NORMALS).expect("written");
    let screen = [&["replay", "sphere", "--out", "o.html"][..], &SCREEN].concat();
    let many =
        [&screen[..], &["--triangles", "2208", "--stalls", "mixed", "--set", "setup.lanes=1"]].concat();
    for (arguments, words) in [
        (many, &["sphere", "permitted: at most 200000", "--triangles", "--from"][..]),
        ([&screen[..], &["--from", "99999999"]].concat(), &["--from 99999999", "permitted: 0 to "]),
        ([&screen[..], &["--from", "9", "--to", "5"]].concat(), &["--from 9", "permitted: 0 to 5"]),
        ([&screen[..], &["--triangles", "0"]].concat(), &["'0' for '--triangles <N>': 0 is not in 1.."]),
        (vec!["replay", "empty.tri", "--out", "o.html"], &["empty.tri: nothing was drawn"]),
        (vec!["replay", "t.tri", "--out", "o.txt"], &["--out o.txt: the file must end in .html or .json"]),
        (vec!["replay", "spere", "--out", "o.html"], &["spere", "sphere"]),
        (vec!["replay", "t.tri", "--lesson", "--out", "o.html"], &["--lesson", "cannot be used with"]),
        (
            vec!["replay", "--lesson", "--out", "o.html", "--set", "blend.kind=constant"],
            &["--lesson", "blend.kind", "none"],
        ),
        (
            vec!["replay", "--lesson", "--out", "o.html", "--set", "shadow.light=perspective"],
            &["--lesson: shadow.light: the lesson does not go through SHADOW; permitted: none"],
        ),
        (
            vec!["replay", "--lesson", "--out", "o.html", "--set", "shade.kind=phong"],
            &["--lesson: shade.kind: ", "permitted: none"],
        ),
        (
            vec!["replay", "--lesson", "--out", "o.html", "--machine", "bilinear"],
            &["--lesson: polygon.values = bilinear", "permitted: plane"],
        ),
        (vec!["replay", "cleared.tri", "--out", "o.html"], &["cleared before cycle", "--to ", "--from "]),
        (
            vec!["replay", "normals.tri", "--out", "o.html"],
            &["mode fast-phong", "--set shade.kind=fast-phong"],
        ),
        (vec!["replay", "t.tri", "--stalls", "often", "--out", "o.html"], &["often", "mixed"]),
        (vec!["replay", "t.tri", "--cycles", "0", "--out", "o.html"], &["--cycles", "0"]),
    ] {
        let (code, error) = run(folder.path(), &arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(words.iter().all(|word| error.contains(word)), "{arguments:?}: {error}");
        assert!(!folder.path().join("o.html").exists());
    }
}

/// A window may end with the cycle before a clearing of the depth memory, and begin behind it: both as the error says.
#[test]
fn a_window_ends_or_begins_at_a_clearing() {
    let folder = tempfile::tempdir().expect("a folder");
    let cleared = TRIANGLE.to_owned() + "clear_depth\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n";
    std::fs::write(folder.path().join("a.tri"), cleared).expect("written");
    let replay = |window: &[&str]| {
        let arguments = [&["replay", "a.tri", "--out", "o.json", "--quiet"], window].concat();
        run(folder.path(), &arguments)
    };
    let (code, error) = replay(&[]);
    let behind = |key: &str| {
        let word = error.split(key).nth(1).and_then(|rest| rest.split_whitespace().next());
        word.and_then(|word| word.trim_end_matches([',', ';']).parse::<u64>().ok())
            .unwrap_or_else(|| panic!("{key}: {error}"))
    };
    let (cycle, end, begin) = (behind("before cycle "), behind("--to "), behind("--from "));
    // The triangle is drawn twice: what is before the clearing takes as long as the first alone.
    let (alone, error) = replay(&["--triangles", "1"]);
    let text = std::fs::read_to_string(folder.path().join("o.json")).expect("written");
    let shown: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!((alone, shown["cycles"].as_u64()), (Some(0), Some(cycle)), "{error}");
    assert_eq!((code, end + 1, begin), (Some(2), cycle, cycle));
    for (window, wanted) in [
        (["--to".to_owned(), end.to_string()], 0),
        (["--to".to_owned(), cycle.to_string()], 2),
        (["--from".to_owned(), begin.to_string()], 0),
        (["--from".to_owned(), end.to_string()], 2),
    ] {
        let (code, error) = replay(&window.each_ref().map(String::as_str));
        assert_eq!(code, Some(wanted), "{window:?}: {error}");
    }
}
