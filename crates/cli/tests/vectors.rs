//! `edgewalk vectors` as a user runs it: own triangles, without tables, with what is missing said.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

const TRIANGLES: &str = "size 24 20\nmode gouraud\ndepth greater\n\
    T 1 1 0.2 1 0 0 1  12 3 0.5 0 1 0 1  4 15 0.8 0 0 1 1\n\
    T 2 2 0.3 1 0 0 1  12 4 0.5 0 1 0 1  4 15 0.8 0 0 1 1\n";

fn vectors(folder: &Path, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("own triangles.tri"), TRIANGLES).expect("written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["vectors", "--out", "v", "--set", "screen.guard_bits=6"]).args(arguments);
    command.current_dir(folder).output().expect("the program runs")
}

fn manifest(folder: &Path, name: &str) -> Value {
    let text = std::fs::read(folder.join("v").join(name).join("manifest.json")).expect("written");
    serde_json::from_slice(&text).expect("JSON")
}

#[test]
fn own_triangles_become_vectors_of_any_unit() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        vectors(folder.path(), &["own triangles.tri", "--unit", "pixel", "--unit", "depth", "--no-csv"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    // Two triangles meet little, and that is said.
    assert!(told.contains("warning: pixel: not covered: off_screen\n"), "{told}");
    let mut names: Vec<String> = std::fs::read_dir(folder.path().join("v"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["own_triangles_depth", "own_triangles_pixel"]);
    let depth = manifest(folder.path(), "own_triangles_depth");
    assert_eq!(depth["suite"]["triangles"], 2);
    // The file's size and depth function count.
    assert_eq!(depth["machine"]["settings"]["screen.width"], "24");
    assert_eq!(depth["constants"]["depth_func"], 4);
    assert!(depth["channels"][0]["table"].is_null());
    let files = depth["files"].as_array().expect("a list");
    assert!(files.iter().all(|file| !file["name"].as_str().expect("text").ends_with(".csv")));
    let output =
        Command::new("make").args(["-C", "v/own_triangles_pixel", "icarus"]).current_dir(&folder).output();
    let output = output.expect("make is installed");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.lines().any(|line| line == "PASS"), "{said}");
}

#[test]
fn tables_are_written_unless_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        vectors(folder.path(), &["own triangles.tri", "--unit", "pixel", "--triangles", "1", "--quiet"]);
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
    let pixel = manifest(folder.path(), "own_triangles_pixel");
    assert_eq!(pixel["suite"]["triangles"], 1);
    assert_eq!(pixel["channels"][0]["table"], "span.csv");
    assert!(folder.path().join("v/own_triangles_pixel/span.csv").exists());
}

#[test]
fn a_huge_directory_is_announced_before_it_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let wide = "size 1024 1024\nT 0 0 0 0 0 0 1  1024 0 0 0 0 0 1  0 1024 0 0 0 0 1\n";
    std::fs::write(folder.path().join("wide.tri"), wide).expect("written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["vectors", "wide.tri", "--unit", "depth", "--stalls", "none", "--out", "v"]);
    let output = command.current_dir(&folder).output().expect("the program runs");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    assert!(told.contains("warning: wide_depth: writing ") && told.contains("--no-csv"), "{told}");
}

#[test]
fn a_suite_for_other_units_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let small = ["--set", "screen.width=24", "--set", "screen.height=20"];
    let output =
        vectors(folder.path(), &[&["--suite", "depth_less", "--unit", "pixel"][..], &small].concat());
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("--suite depth_less: it is for the units machine, depth only"), "{told}");
    assert!(!folder.path().join("v").exists());
}

/// A frame that is shaded at each pixel: its records and tables are there, and what the bench expects is its picture.
#[test]
fn shaded_triangles_bring_their_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = "size 24 20\nmode phong\nview 0 0 1\nsun 0.3 0.3 1 0.9\nspecular halfway\nmaterial 0.1 0.6 0.3 20\n\
        T 1 1 0.2 1 0.5 0 1  20 3 0.5 1 0.5 0 1  4 15 0.8 1 0.5 0 1\nN -0.3 -0.3 0.9055  0.5 -0.3 0.8124  -0.3 0.5 0.8124\n\
        material 0.2 0.4 0.4 5\n\
        T 2 2 0.1 0 0.5 1 1  12 4 0.1 0 0.5 1 1  4 18 0.1 0 0.5 1 1\nN 0.3 -0.3 0.9055  0 0 1  -0.3 0.5 0.8124\n";
    std::fs::write(folder.path().join("shaded.tri"), file).expect("written");
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        command.args(arguments).args(["--set", "shade.kind=phong", "--set", "screen.guard_bits=6"]);
        let output = command.current_dir(&folder).output().expect("the program runs");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let wanted = ["--unit", "machine", "--unit", "term", "--unit", "normal", "--unit", "shade"];
    let (code, told) = run(&[&["vectors", "shaded.tri", "--no-csv", "--out", "v"][..], &wanted].concat());
    assert_eq!(code, Some(0), "{told}");
    for unit in ["machine", "term", "normal", "shade"] {
        let make = ["-C", &format!("v/shaded_{unit}"), "icarus"].map(str::to_owned);
        let output =
            Command::new("make").args(make).current_dir(&folder).output().expect("make is installed");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && said.lines().any(|line| line == "PASS"), "{unit}: {said}");
    }
    let (code, told) = run(&["raster", "shaded.tri", "--engine", "model", "--out", "picture"]);
    assert_eq!(code, Some(0), "{told}");
    let (_, _, rgb) = crate::support::npy(&folder.path().join("picture/rgb.npy"));
    let machine = manifest(folder.path(), "shaded_machine");
    let channels = machine["channels"].as_array().expect("a list");
    let writes = channels.iter().find(|channel| channel["name"] == "wr").expect("it writes");
    let text = std::fs::read_to_string(folder.path().join("v/shaded_machine/wr.exp.mem")).expect("written");
    let mut drawn = std::collections::BTreeMap::new();
    for line in text.lines() {
        let token = u128::from_str_radix(line, 16).expect("hex");
        let field = |port: &str| {
            let fields = writes["fields"].as_array().expect("a list");
            let field = fields.iter().find(|field| field["port"] == port).expect("a write has it");
            let number = |key: &str| field[key].as_u64().expect("a number");
            (token >> number("lsb") & ((1 << number("width")) - 1)) as usize
        };
        drawn.insert(field("wr_addr"), ["wr_r", "wr_g", "wr_b"].map(|port| field(port) as u8));
    }
    assert!(drawn.len() > 100, "{}", drawn.len());
    for (address, colour) in &drawn {
        let pixel = (address / 32 * 24 + address % 32) * 3;
        let drawn =
            rgb[8 * pixel..].chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight")));
        let drawn: Vec<u8> = drawn.take(3).map(|value| (value * 255.0).round() as u8).collect();
        assert_eq!(drawn, colour, "address {address}");
    }
    let few = ["vectors", "shaded.tri", "--out", "w", "--set", "term.record_bits=1"];
    assert_eq!(run(&few).0, Some(0));
    std::fs::write(
        folder.path().join("shaded.tri"),
        format!("{file}{}", &file[file.rfind('T').unwrap_or(0)..]),
    )
    .expect("written");
    let (code, told) = run(&few);
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains("add --triangles 2, or --set term.record_bits=2"), "{told}");
}

/// A machine whose texels have 72 bits: three colours of 16 and two slopes of 12.
const WIDE: [&str; 14] = [
    "--set",
    "formats.color_bits=16",
    "--set",
    "shade.kind=fast-phong",
    "--set",
    "shade.colour=multiply",
    "--set",
    "texture.kind=nearest",
    "--set",
    "texture.bump=yes",
    "--set",
    "texture.bits=2",
    "--set",
    "texture.slope_bits=12",
];

/// `make icarus` in a directory of vectors, which passes.
fn replays_in_icarus(folder: &Path, name: &str) {
    let output =
        Command::new("make").args(["-C", &format!("v/{name}"), "icarus"]).current_dir(folder).output();
    let output = output.expect("make is installed");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.lines().any(|line| line == "PASS"), "{name}: {said}");
}

#[test]
fn words_over_64_bits_are_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let small = ["--set", "screen.width=16", "--set", "screen.height=16"];
    let random =
        ["--suite", "random", "--count", "10", "--unit", "machine", "--unit", "texel", "--no-csv", "--quiet"];
    let output = vectors(folder.path(), &[&random[..], &small, &WIDE].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let machine = manifest(folder.path(), "random_machine");
    let memories = machine["memories"].as_array().expect("a list");
    let textures = memories.iter().find(|memory| memory["name"] == "textures").expect("it has texels");
    assert_eq!(textures["clear"], "f".repeat(72 / 4));
    let words =
        std::fs::read_to_string(folder.path().join("v/random_machine/textures.start.mem")).expect("written");
    let top = words.lines().filter(|word| word.len() == 72 / 4 && !word.starts_with("00")).count();
    assert!(2 * top > words.lines().count(), "{words}");
    replays_in_icarus(folder.path(), "random_machine");
    replays_in_icarus(folder.path(), "random_texel");
}

/// Signed fields of a table have their sign; every value is that of the packed token beside it.
#[test]
fn a_table_has_the_numbers_of_its_tokens() {
    let folder = tempfile::tempdir().expect("a folder");
    let small =
        ["--set", "screen.width=24", "--set", "screen.height=20", "--suite", "corners", "--unit", "edge"];
    assert_eq!(vectors(folder.path(), &small).status.code(), Some(0));
    let edge = manifest(folder.path(), "corners_edge");
    let (mut checked, mut negative) = (0, 0);
    for channel in edge["channels"].as_array().expect("a list") {
        let read = |file: &Value| {
            let file = file.as_str().expect("a name");
            std::fs::read_to_string(folder.path().join("v/corners_edge").join(file)).expect("written")
        };
        let (table, tokens, steps) =
            (read(&channel["table"]), read(&channel["tokens"]), read(&channel["moved"]));
        let head: Vec<&str> = table.lines().next().expect("a head").split(',').collect();
        let fields = channel["fields"].as_array().expect("a list");
        let mut cycle = 0;
        assert_eq!(table.lines().count() - 1, tokens.lines().count());
        for ((row, token), step) in table.lines().skip(1).zip(tokens.lines()).zip(steps.lines()) {
            let row: Vec<&str> = row.split(',').collect();
            let bit = |at: u64| {
                let digit =
                    token.chars().rev().nth(at as usize / 4).and_then(|c| c.to_digit(16)).unwrap_or(0);
                i128::from(digit >> (at % 4) & 1)
            };
            cycle += u64::from_str_radix(step, 16).expect("hex");
            assert_eq!(row[1], cycle.to_string());
            for field in fields {
                let (lsb, width) =
                    (field["lsb"].as_u64().expect("a number"), field["width"].as_u64().expect("a number"));
                let value: i128 = (0..width).map(|at| bit(lsb + at) << at).sum();
                let below = field["signed"] == true && bit(lsb + width - 1) == 1;
                let value = if below { value - (1 << width) } else { value };
                let place = head.iter().position(|name| field["port"] == *name).expect("a column");
                assert_eq!(row[place], value.to_string(), "{}", field["port"]);
                checked += 1;
                negative += u32::from(below);
            }
        }
    }
    println!("checked {checked} values, {negative} of them negative");
    assert!(negative > 100, "{negative}");
}

/// 250 random triangles of the machine; 5,000 take 94 MB.
#[test]
fn vectors_of_the_machine_are_small() {
    let folder = tempfile::tempdir().expect("a folder");
    let large = ["--set", "screen.guard_bits=13"];
    let random = [&["--suite", "random", "--count", "250", "--unit", "machine"][..], &large].concat();
    let bytes = |tables: &[&str]| {
        assert_eq!(vectors(folder.path(), &[&random[..], tables].concat()).status.code(), Some(0));
        let machine = manifest(folder.path(), "random_machine");
        let files = machine["files"].as_array().expect("a list");
        files.iter().map(|file| file["bytes"].as_u64().expect("a number")).sum::<u64>()
    };
    let (with, without) = (bytes(&[]), bytes(&["--no-csv"]));
    println!("{with} bytes with tables, {without} without");
    assert!(without <= 5_500_000, "{without} bytes");
    // As the help says.
    assert!(without < with / 2, "{with} and {without} bytes");
}

/// What stands behind a link in an earlier output folder is neither removed nor replaced.
#[test]
fn a_link_in_the_folder_leads_to_no_removal() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let small =
        ["--set", "screen.width=24", "--set", "screen.height=20", "--suite", "hazards", "--unit", "depth"];
    let write = |name: &str, text: &str| std::fs::write(at(name), text).expect("written");
    let kept =
        |name: &str| assert_eq!(std::fs::read_to_string(at(name)).expect("still there"), "mine", "{name}");
    std::fs::create_dir_all(at("mine/hdl")).expect("a folder");
    std::fs::create_dir_all(at("v")).expect("a folder");
    write("mine/precious.txt", "mine");
    write("mine/tb.v", "mine");
    write("mine/manifest.json", r#"{"files": [{"name": "precious.txt"}, {"name": "tb.v"}]}"#);
    // The directory itself is a link: nothing is written through it.
    std::os::unix::fs::symlink(at("mine"), at("v/hazards_depth")).expect("a link");
    let output = vectors(folder.path(), &small);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(
        told.contains("v/hazards_depth: is a link, and below --out files are written into folders only"),
        "{told}"
    );
    ["mine/precious.txt", "mine/tb.v"].into_iter().for_each(kept);
    // A folder in it is a link, which only the manifest of an earlier run names.
    std::fs::remove_file(at("v/hazards_depth")).expect("the link");
    std::fs::create_dir_all(at("v/hazards_depth")).expect("a folder");
    std::os::unix::fs::symlink(at("mine"), at("v/hazards_depth/old")).expect("a link");
    write(
        "v/hazards_depth/manifest.json",
        r#"{"files": [{"name": "old/precious.txt"}, {"name": "stale.txt"}]}"#,
    );
    write("v/hazards_depth/stale.txt", "stale");
    let output = vectors(folder.path(), &small);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    kept("mine/precious.txt");
    assert!(!at("v/hazards_depth/stale.txt").exists(), "what is of an earlier run goes");
}
