//! Traffic, roofline, causes over the screen and ranges, as `render` tells them.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, edgewalk, rendered_by_every_engine, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// What `render --json` says.
fn render(folder: &Path, arguments: &[&str]) -> Value {
    let output = edgewalk(folder, &[&["render"], arguments, &["--json"]].concat()).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Bits of every port of the emitted machine, by name.
fn port_bits(folder: &Path, settings: &[&str]) -> BTreeMap<String, u64> {
    let output = edgewalk(folder, &[&["emit", "--out", "hdl"], settings].concat()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(folder.join("hdl/edgewalk.v")).unwrap();
    let ports =
        text.lines().filter(|line| line.starts_with("  input  wire") || line.starts_with("  output wire"));
    let port = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (high, name) = match words[2].strip_prefix('[').and_then(|range| range.strip_suffix(":0]")) {
            Some(high) => (high.parse().unwrap(), words[3]),
            None => (0, words[2]),
        };
        (name.trim_end_matches(',').to_owned(), high + 1)
    };
    ports.map(port).collect()
}

/// A square with normals, pictures on it and a relief.
const SHADED: &str = "ambient = 0.1
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
[[material]]
name = \"m\"
diffuse = [0.8, 0.7, 0.5]
specular = 0.3
exponent = 20
checker = 2
texels = \"nearest\"
[[object]]
positions = [[-1, -1, 0], [1, -1, 0.1], [1, 1, 0], [-1, 1, 0.2]]
faces = [[0, 1, 2], [0, 2, 3]]
uv = [[0, 0], [2, 0], [2, 2], [0, 2]]
material = \"m\"
[[light]]
kind = \"positional\"
position = [1, 2, 3]
";

/// Glass over what was drawn, with a pass that stores no depth.
const GLASS: &str = "size 64 48
T  0 0 0.5 1 0 0 0   64 0 0.5 1 0 0 0   0 48 0.5 1 0 0 0
depth_write 0
blend 1
T  0 0 0.4 0 0 1 0.5   60 0 0.4 0 0 1 0.5   0 40 0.4 0 0 1 0.5
depth off
blend add
depth_write 1
T  9 9 0.9 0.5 0.25 0 1  40 9 0.9 0.5 0.25 0 1  9 40 0.9 0.5 0.25 0 1
";

/// Accesses are those that the netlist's run counts at its ports; words are as wide as the emitted ports; bytes are their product.
#[test]
fn traffic_equals_accesses_at_the_netlists_ports() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    std::fs::write(folder.path().join("glass.tri"), GLASS).unwrap();
    std::fs::write(folder.path().join("s.toml"), SHADED).unwrap();
    let shaded = [
        "shade.kind=phong",
        "shade.colour=multiply",
        "texture.kind=nearest",
        "texture.bits=5",
        "shade.light=positional",
    ];
    let cases: [(&str, &[&str], &[&str]); 5] = [
        ("a.tri", &["setup.kind=sequenced"], &["depth read", "depth write", "color write"]),
        ("a.tri", &[], &["depth read", "depth write", "color write"]),
        ("a.tri", &["dither.bits=5"], &["depth read", "depth write", "color write"]),
        ("glass.tri", &["blend.kind=constant"], &["depth read", "depth write", "color read", "color write"]),
        ("s.toml", &shaded, &["terms read", "roots read", "tables read", "textures read", "depth read"]),
    ];
    let mut checked = 0;
    for (input, settings, used) in cases {
        let settings: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
        let settings = [&SCREEN[..], &settings].concat();
        let shading: &[&str] = if input == "s.toml" { &["--shading", "phong"] } else { &[] };
        let reports = rendered_by_every_engine(folder.path(), &[&[input], shading, &settings].concat());
        let [fast, model, rtl] = &reports[..] else { panic!("three engines") };
        let traffic = &rtl["traffic"];
        assert_eq!((&fast["traffic"], &model["traffic"]), (traffic, traffic), "{input} {settings:?}");
        assert!(traffic.get("clock_mhz").is_none() && traffic.get("pages").is_none(), "{traffic}");
        let bits = port_bits(folder.path(), &settings);
        let of = |link: &str, fields: &[&str]| -> u64 {
            fields.iter().map(|field| bits.get(&format!("{link}_{field}")).copied().unwrap_or(0)).sum()
        };
        let (mut met, mut bytes) = (Vec::new(), 0.0);
        for port in traffic["ports"].as_array().unwrap() {
            let text = |key: &str| port[key].as_str().unwrap();
            let (memory, direction, link) = (text("memory"), text("direction"), text("link"));
            let (accesses, width) = (port["accesses"].as_u64().unwrap(), port["bits"].as_u64().unwrap());
            let declared = match (memory, direction) {
                ("triangles", _) => {
                    bits.iter()
                        .filter(|(name, _)| name.starts_with(&format!("{link}_")))
                        .map(|(_, bits)| bits)
                        .sum::<u64>()
                        - 2
                }
                ("depth", "read") => of("data", &["z"]),
                ("depth", _) => of(link, &["z"]),
                ("color", "read") => of("cdata", &["rgb"]),
                ("color", _) => of(link, &["r", "g", "b", "rgb", "e0", "e1", "e2", "e3"]),
                _ => of(&link.replace("rd", "data"), &["word", "rgb"]),
            };
            assert_eq!(width, declared, "{input} {settings:?}: {port}");
            assert_eq!(number(&port["bytes"]), (accesses * width) as f64 / 8.0, "{port}");
            if memory != "triangles" {
                bytes += number(&port["bytes"]);
            }
            if accesses > 0 {
                met.push(format!("{memory} {direction}"));
            }
            checked += 1;
        }
        let cycles = number(&rtl["cycles"]["total"]);
        assert_eq!(number(&traffic["bytes"]), bytes);
        assert!((number(&traffic["bytes_per_cycle"]) * cycles - bytes).abs() < 1e-6 * bytes);
        assert!(used.iter().all(|port| met.iter().any(|met| met == port)), "{met:?} of {used:?}");
        // What the rest of the report tells.
        let port = |memory: &str, direction: &str| {
            let ports = traffic["ports"].as_array().unwrap().iter();
            let mut found = ports.filter(|port| port["memory"] == memory && port["direction"] == direction);
            found.next().unwrap()["accesses"].clone()
        };
        assert_eq!(
            (port("depth", "read"), port("color", "write")),
            (rtl["fragments"].clone(), rtl["writes"].clone())
        );
        if input == "glass.tri" {
            assert!(port("depth", "write").as_u64() < port("color", "write").as_u64());
            assert!(port("color", "read").as_u64() < port("color", "write").as_u64());
        }
    }
    println!("{checked} ports of 5 machines");
    assert_eq!(checked, 4 + 4 + 4 + 5 + 8);
}

/// Rates at a clock are bytes a cycle times the clock; pages are those of every access.
#[test]
fn rates_and_pages_follow_from_the_accesses() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let arguments =
        [&["a.tri", "--stalls", "dram:banks=2,page=8,refresh=200", "--clock", "50"], &SCREEN[..]].concat();
    let report = render(folder.path(), &arguments);
    let traffic = &report["traffic"];
    assert_eq!(traffic["clock_mhz"], 50.0);
    let mut accesses = 0;
    for port in traffic["ports"].as_array().unwrap() {
        assert!((number(&port["mb_per_s"]) - 50.0 * number(&port["bytes_per_cycle"])).abs() < 1e-9, "{port}");
        // A write of a pixel holds its depth too.
        if port["link"] == "rd" || port["memory"] == "color" {
            accesses += port["accesses"].as_u64().unwrap();
        }
    }
    assert!((number(&traffic["mb_per_s"]) - 50.0 * number(&traffic["bytes_per_cycle"])).abs() < 1e-9);
    let [pages] = &traffic["pages"].as_array().unwrap()[..] else { panic!("one memory: {traffic}") };
    let count = |key: &str| pages[key].as_u64().unwrap();
    assert_eq!(count("hits") + count("misses"), accesses, "{pages}");
    // Refreshes come as often as the clock says, but for one under way at the end.
    let due = report["cycles"]["total"].as_u64().unwrap() / 200;
    assert!(count("refreshes").abs_diff(due) <= 1 && due > 10, "{pages}, {due} due");
    assert!(count("turns") > 100 && count("misses") > count("refreshes"), "{pages}");
    // Without turns, misses and refreshes each access takes a clock: a read and a write of one pixel take two.
    let fair = render(
        folder.path(),
        &[&["a.tri", "--stalls", "dram:banks=1,page=4096,miss=0,turn=0,refresh=0"], &SCREEN[..]].concat(),
    );
    let pages = &fair["traffic"]["pages"][0];
    assert_eq!(
        (&pages["misses"], &pages["refreshes"]),
        (&1.into(), &0.into()),
        "the first page alone: {pages}"
    );
    // Lines of eight words hold most of what is read and written along a span, and save clocks.
    let lined = render(folder.path(), &[&["a.tri", "--stalls", "dram:line=8"], &SCREEN[..]].concat());
    let plain = render(folder.path(), &[&["a.tri", "--stalls", "dram"], &SCREEN[..]].concat());
    let in_line = |report: &Value| report["traffic"]["pages"][0]["in_line"].as_u64().unwrap();
    assert!(in_line(&plain) == 0 && in_line(&lined) > accesses * 3 / 4, "{} of {accesses}", in_line(&lined));
    assert!(lined["cycles"]["total"].as_u64() < plain["cycles"]["total"].as_u64());
    assert_eq!(lined["traffic"]["ports"][1]["accesses"], plain["traffic"]["ports"][1]["accesses"]);
    assert!(lined["cycles"]["stalls"].as_str().unwrap().ends_with("busy=13,line=8"), "{}", lined["cycles"]);
    for (more, why) in [
        (&["--clock", "0"][..], "permitted: 0.001 to 100000 MHz"),
        (&["--clock", "50", "--engine", "golden"], "the golden picture has no clock"),
        (&["--profile", "--engine", "golden"], "--profile: the golden picture has no cycles"),
        (&["--ranges", "--engine", "scanline"], "--ranges: the golden picture has no cycles"),
    ] {
        let (code, error) = run(folder.path(), &[&["render", "a.tri"], &SCREEN[..], more].concat());
        assert!(code == Some(2) && error.contains(why), "{error}");
    }
}

/// Clearing writes depth and colour of every pixel, a display reads the colours: width x height x bits, in the clocks of the
/// memory.
#[test]
fn clearing_and_a_display_load_the_memory() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let own = TRIANGLE.replacen('\n', "\nextra 1\n", 1) + "X 0 0 0\n";
    std::fs::write(folder.path().join("own.tri"), own).unwrap();
    let dram = "dram:banks=4,page=256,miss=6,turn=2,refresh=0";
    let mut checked = 0;
    // Lines of 64 words fill 12 pages; the first write turns the bus.
    for (stalls, more, clear, scan_out) in [
        ("none", &[][..], 3072, 3072),
        ("fixed:rd=2,wr=1", &[], 2 * 3072, 3 * 3072),
        (dram, &[], 2 + 12 * 6 + 3072, 12 * 6 + 3072),
        (dram, &["--set", "dither.bits=5"], 2 + 12 * 6 + 3072, 12 * 6 + 3072),
        (dram, &["--set", "formats.z_bits=16"], 2 + 12 * 6 + 3072, 12 * 6 + 3072),
        (dram, &["--set", "channels.extra=1"], 2 + 12 * 6 + 3072, 12 * 6 + 3072),
    ] {
        let is_own = more.contains(&"channels.extra=1");
        let input = if is_own { "own.tri" } else { "a.tri" };
        let display = [input, "--stalls", stalls, "--clock", "50", "--display", "60"];
        let report = render(folder.path(), &[&display[..], &SCREEN, more].concat());
        let display = &report["traffic"]["display"];
        let color = if more.contains(&"dither.bits=5") { 15 } else { 24 };
        let depth = if more.contains(&"formats.z_bits=16") { 16 } else { 24 };
        // A value of the user's own has 12 bits. A display does not read it.
        let own = if is_own { 12 } else { 0 };
        for (load, bits, cycles) in [("clear", depth + color + own, clear), ("scan_out", color, scan_out)] {
            let load = &display[load];
            assert_eq!(load["bits"], bits, "{stalls}: {load}");
            assert_eq!(load["accesses"], 64 * 48);
            assert_eq!(number(&load["bytes"]), f64::from(64 * 48 * bits) / 8.0);
            assert_eq!(load["cycles"], cycles, "{stalls}: {load}");
            checked += 1;
        }
        let bytes = number(&display["scan_out"]["bytes"]);
        assert!((number(&display["scan_out_mb_per_s"]) - bytes * 60.0 / 1e6).abs() < 1e-9);
        let share = f64::from(scan_out) * 60.0 / 50e6;
        assert!((number(&display["scan_out_share"]) - share).abs() < 1e-9);
        // The text tells the figures of the JSON.
        let text = std::fs::read_to_string(folder.path().join("out/render/report.txt")).unwrap();
        for told in [
            format!("3072 of {:>3} bits", depth + color + own),
            format!("bytes, {clear} cycles"),
            format!("bytes, {scan_out} cycles"),
            format!("scan-out at 60 Hz: {:.1} MB/s, {:.1} %", bytes * 60.0 / 1e6, 100.0 * share),
        ] {
            assert!(text.contains(&told), "no `{told}` in\n{text}");
        }
    }
    println!("{checked} loads");
    assert_eq!(checked, 12);
    // Lines of 160 pixels begin 256 words apart: each opens a page, and the words between are not read.
    let wide = ["sphere", "--stalls", dram, "--clock", "1", "--display", "60"];
    let wide = render(folder.path(), &[&wide[..], &SMALL].concat());
    let scan_out = &wide["traffic"]["display"]["scan_out"];
    assert_eq!((&scan_out["accesses"], &scan_out["bytes"]), (&(160 * 120).into(), &57_600.0.into()));
    assert_eq!(scan_out["cycles"], 160 * 120 + 120 * 6);
    let text = std::fs::read_to_string(folder.path().join("out/render/report.txt")).unwrap();
    assert!(
        text.contains("119.5 % of the memory's clocks: the memory is too slow for this display"),
        "{text}"
    );
    for (more, why) in [
        (&["--display", "60"][..], "--clock"),
        (&["--clock", "50", "--display", "0"], "permitted: 0.001 to 100000 Hz"),
    ] {
        let (code, error) = run(folder.path(), &[&["render", "a.tri"], &SCREEN[..], more].concat());
        assert!(code == Some(2) && error.contains(why), "{error}");
    }
}

const SMALL: [&str; 4] = ["--set", "screen.width=160", "--set", "screen.height=120"];

/// The roofline foretells the cycles with a memory twice as fast, within 1.5 %. The datapath binds one scene, the memory binds
/// another, and the third lies between.
#[test]
fn memory_twice_as_fast_changes_cycles_as_told() {
    let folder = tempfile::tempdir().unwrap();
    let dram = |word: u32| {
        format!(
            "dram:miss={},turn={},refresh={},busy={},word={word}",
            6 * word,
            2 * word,
            780 * word,
            13 * word
        )
    };
    let mut checked = 0;
    let mut seen = Vec::new();
    for (scene, slow, fast) in [
        ("torus-knot", dram(2), dram(1)),
        ("room", dram(2), dram(1)),
        ("sphere", "fixed:rd=7,data=0,wr=7".to_owned(), "fixed:rd=3,data=0,wr=3".to_owned()),
    ] {
        let told = |waits: &str| {
            let report =
                render(folder.path(), &[&[scene, "--stalls", waits, "--profile"], &SMALL[..]].concat());
            let (roofline, cycles) =
                (report["profile"]["roofline"].clone(), number(&report["cycles"]["total"]));
            assert_eq!(number(&roofline["cycles"]), cycles);
            // Where a dynamic memory binds its clocks are those of its accesses, turns and refreshes.
            let pages = report["traffic"]["pages"].get(0).filter(|_| roofline["binds"] == "memory");
            if let Some(pages) = pages {
                let word = if waits.ends_with("word=2") { 2.0 } else { 1.0 };
                let of = |key: &str| number(&pages[key]) * word;
                let refreshes = number(&roofline["memory"]) / (780.0 * word) * 13.0 * word;
                let clocks = of("hits") + 7.0 * of("misses") + 2.0 * of("turns") + refreshes;
                let memory = number(&roofline["memory"]);
                assert!(
                    (memory / clocks - 1.0).abs() < 0.004,
                    "{scene}: {memory} clocks, {clocks} by its pages"
                );
            }
            roofline
        };
        let [slow, fast] = [told(&slow), told(&fast)];
        let of = |roofline: &Value, key: &str| number(&roofline[key]);
        println!("{scene}: {slow:#} then {fast:#}");
        for roofline in [&slow, &fast] {
            let (datapath, memory, cycles) =
                (of(roofline, "datapath"), of(roofline, "memory"), of(roofline, "cycles"));
            let binds = if memory > datapath { "memory" } else { "datapath" };
            assert_eq!(roofline["binds"], binds, "{scene}");
            // Neither works longer than the frame takes, and the windows tell the frame.
            assert!(cycles >= datapath && cycles >= 0.99 * memory, "{scene}: {roofline}");
            assert!((of(roofline, "expected") / cycles - 1.0).abs() < 0.015, "{scene}: {roofline}");
        }
        assert_eq!(of(&slow, "datapath"), of(&fast, "datapath"));
        assert!((of(&slow, "memory") / of(&fast, "memory") - 2.0).abs() < 0.02, "{scene}: twice as fast");
        let (expected, cycles) = (of(&slow, "expected_memory_twice_as_fast"), of(&fast, "cycles"));
        assert!((expected / cycles - 1.0).abs() < 0.015, "{scene}: {expected} expected, {cycles} came");
        seen.push((slow["binds"].as_str().unwrap().to_owned(), of(&slow, "cycles") / cycles));
        checked += 1;
    }
    println!("{checked} of 3 scenes: {seen:?}");
    assert_eq!(checked, 3);
    assert!(seen.iter().any(|(binds, gain)| binds == "datapath" && *gain < 1.3), "{seen:?}");
    assert!(seen.iter().any(|(binds, gain)| binds == "memory" && *gain > 1.7), "{seen:?}");
}

/// Every cycle stands once over the screen and once among the sizes.
#[test]
fn causes_over_the_screen_add_up() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    std::fs::write(folder.path().join("glass.tri"), GLASS).unwrap();
    let mut checked = 0;
    for (input, more) in [
        ("a.tri", &[][..]),
        ("glass.tri", &["--set", "blend.kind=constant", "--stalls", "random"]),
        ("sphere", &["--set", "interpolator.adders=1"]),
    ] {
        let report = render(folder.path(), &[&[input, "--profile"], &SCREEN[..], more].concat());
        let profile = &report["profile"];
        for cause in report["cycles"]["by_cause"].as_object().unwrap() {
            let sum = |list: &str| -> u64 {
                let parts = profile[list].as_array().unwrap().iter().map(|part| &part["by_cause"]);
                parts.chain([&profile["behind"]]).map(|causes| causes[cause.0].as_u64().unwrap()).sum()
            };
            assert_eq!([sum("lines"), sum("sizes")], [cause.1.as_u64().unwrap(); 2], "{input}: {}", cause.0);
            checked += 1;
        }
        let lines = profile["lines"].as_array().unwrap();
        let ends: Vec<_> = lines.iter().map(|band| (band["from"].as_u64(), band["to"].as_u64())).collect();
        assert!(ends.windows(2).all(|pair| pair[0].1.map(|to| to + 1) == pair[1].0), "{ends:?}");
        assert_eq!((ends[0].0, ends[ends.len() - 1].1), (Some(0), Some(47)));
    }
    assert_eq!(checked, 9 + 10 + 9);
    // One triangle of 1,200 pixels: all its cycles stand in the last size, its pixels in the lines that it covers.
    let profile = render(folder.path(), &[&["a.tri", "--profile"], &SCREEN[..]].concat())["profile"].clone();
    assert_eq!(profile["sizes"][5]["triangles"], 1);
    assert!((0..5).all(|size| profile["sizes"][size]["triangles"] == 0));
    let band = |place: usize| profile["lines"][place]["by_cause"]["draw"].as_u64().unwrap();
    assert!(band(0) > band(5) && band(5) > band(12) && band(15) == 0, "{profile}");
    // The triangle comes in the first cycle: SETUP is waited for at the line where it begins.
    assert!(profile["lines"][0]["by_cause"]["setup"].as_u64() > Some(50), "{profile}");
}

/// A machine with three guard bits more has three bits more to spare in what holds a column.
#[test]
fn ranges_tell_three_bits_too_many() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let told = |guard: &str| -> BTreeMap<String, (i64, i64, i64, i64)> {
        let report = render(folder.path(), &[&["a.tri", "--ranges", "--set", guard], &SCREEN[..]].concat());
        let of = |range: &Value| {
            let whole = |key: &str| range[key].as_i64().unwrap();
            let name = format!("{} {}", range["unit"].as_str().unwrap(), range["name"].as_str().unwrap());
            assert_eq!(whole("bits"), whole("needed") + whole("spare"), "{range}");
            (name, (whole("bits"), whole("spare"), whole("least"), whole("greatest")))
        };
        report["ranges"].as_array().unwrap().iter().map(of).collect()
    };
    let (narrow, wide) = (told("screen.guard_bits=8"), told("screen.guard_bits=11"));
    assert!(narrow.len() > 30 && narrow.len() == wide.len(), "{} numbers", narrow.len());
    let column = |told: &BTreeMap<String, (i64, i64, i64, i64)>| told["edge major.C"];
    let ((bits, spare, least, greatest), more) = (column(&narrow), column(&wide));
    assert_eq!(more, (bits + 3, spare + 3, least, greatest));
    // The right edge goes from column 60 to 0; columns are what the triangle has.
    assert!(least >= 0 && greatest <= 60, "{least} to {greatest}");
    // The line that EDGE walks: 0 to 39, six bits.
    let (_, spare, least, greatest) = narrow["edge y"];
    assert_eq!((spare, least, greatest), (0, 0, 39));
    // No number needs more bits than it has, whatever the machine.
    assert!(narrow.values().chain(wide.values()).all(|(bits, spare, ..)| (0..*bits).contains(spare)));
}

/// The page shows what the program prints for the sphere.
#[test]
fn the_page_shows_what_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["render", "sphere", "--stalls", "dram", "--clock", "50", "--display", "60"];
    let output = edgewalk(folder.path(), &words).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let printed: Vec<&str> = printed.lines().collect();
    let page = include_str!("../../../docs/traffic.md");
    let blocks = page.split("```\n").skip(1).step_by(2);
    let shown = |block: &&str| block.starts_with("traffic at") || block.starts_with("    clear");
    let mut checked = 0;
    for line in blocks.filter(shown).flat_map(str::lines) {
        assert!(printed.contains(&line), "`{line}` is not printed");
        checked += 1;
    }
    println!("checked {checked} / 10 lines");
    assert_eq!(checked, 10);
}
