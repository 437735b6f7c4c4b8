//! Large pictures and endless words: memory stays small, and a refusal comes at once.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::ended;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Runs the program with so many megabytes of address space.
fn within(megabytes: u64, folder: &Path, arguments: &[&str]) -> Output {
    let script = format!("ulimit -v {} && exec \"$@\"", megabytes * 1000);
    let mut shell = Command::new("sh");
    shell.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_edgewalk")]).args(arguments);
    shell.current_dir(folder).output().unwrap()
}

/// Side of the picture, and what the process may take for it: 22 bytes a pixel, as 1.5 GB for 8192 x 8192 are, and what
/// any run takes (code, stacks, address space that the allocator sets apart).
const SIDE: u64 = 3072;
const LIMIT: u64 = SIDE * SIDE * 22 / 1_000_000 + 150;

#[test]
fn a_large_picture_takes_22_bytes_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let all = 2 * SIDE;
    // Every pixel is touched, and a steep triangle lies over lines of every band of the picture.
    let text = format!(
        "size {SIDE} {SIDE}\nT 0 0 0.5 1 0 0 0  {all} 0 0.5 0 1 0 0  0 {all} 1 0 0 1 0\n\
         T 7.5 0 0.25 1 1 1 0  {SIDE} {SIDE} 0.25 1 1 1 0  11 {SIDE} 0.25 1 1 1 0\n"
    );
    std::fs::write(folder.path().join("large.tri"), text).unwrap();
    let mut fragments = Vec::new();
    for engine in ["fast", "golden"] {
        let arguments = ["raster", "large.tri", "--engine", engine, "--json", "--out", engine];
        let output = within(LIMIT, folder.path(), &arguments);
        assert_eq!(ended(&output), (Some(0), String::new()), "{engine} in {LIMIT} MB");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        fragments.push(report["fragments"].as_u64().unwrap());
        let header_and = |bytes: u64| SIDE * SIDE * bytes + 128;
        for (file, bytes) in [("z", 8), ("rgb", 24)] {
            let length = std::fs::metadata(folder.path().join(format!("{engine}/{file}.npy"))).unwrap().len();
            assert_eq!(length, header_and(bytes), "{engine} {file}");
        }
    }
    assert!(fragments[0] > SIDE * SIDE * 5 / 4 && fragments[0] == fragments[1], "{fragments:?}");
    for file in ["coverage.npy", "writes.npy", "id.npy"] {
        let [fast, golden] =
            ["fast", "golden"].map(|engine| std::fs::read(folder.path().join(engine).join(file)).unwrap());
        assert!(fast == golden, "{file}: bands in another order or place");
    }
    println!("checked {} fragments of 2 / 2 engines in {LIMIT} MB", fragments[0]);
}

/// Runs the program, and gives the most memory that it has had at once, bytes. Tools that it starts do not count.
fn most_memory(folder: &Path, arguments: &[&str]) -> u64 {
    let mut program = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    // Nothing side by side, as memory would grow with the cores.
    program.current_dir(folder).args(arguments).env("RAYON_NUM_THREADS", "1");
    let errors = folder.join("errors");
    let mut child =
        program.stdout(Stdio::null()).stderr(File::create(&errors).unwrap()).spawn().expect("it is built");
    let mut most = 0;
    let status = loop {
        // The mark only rises, so its last reading says nearly all; of a program that has ended there is none.
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let mark = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = mark.and_then(|mark| mark.trim().trim_end_matches(" kB").parse::<u64>().ok());
        most = most.max(kilobytes.unwrap_or(0) * 1024);
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let errors = std::fs::read_to_string(&errors).unwrap();
    assert!(status.success() && most > 0, "{arguments:?}: {status}: {errors}");
    most
}

#[test]
fn every_command_draws_large_screens_in_little_memory() {
    let folder = tempfile::tempdir().unwrap();
    // Addresses have a power of two for a line, as on 8192 x 8192.
    const SIDE: u64 = 2048;
    let pixels = SIDE * SIDE;
    let all = 2 * SIDE;
    let covering = format!("size {SIDE} {SIDE}\nT 0 0 0.5 1 0 0 0  {all} 0 0.5 0 1 0 0  0 {all} 1 0 0 1 0\n");
    let small = format!(
        "size {SIDE} {SIDE}\nT 10.5 8.25 0.45 0.3 0.7 0.1 0  50.3 20.9 0.47 0.9 0 0 0  20.2 39.7 0.43 0 0.6 1 0\n"
    );
    std::fs::write(folder.path().join("covering.tri"), covering).unwrap();
    std::fs::write(folder.path().join("small.tri"), small).unwrap();
    let screen = [format!("screen.width={SIDE}"), format!("screen.height={SIDE}")];
    let on_screen = ["--set", &screen[0], "--set", &screen[1]];
    // Bands of some pixels are in memory beside what grows with the screen; commands that write no picture have none.
    let (bands, none) = (80_000_000, 24_000_000);
    let runs: [(&str, &str, u64); 11] = [
        ("raster covering.tri --out raster", "", bands),
        ("render covering.tri --out render", "screen", bands),
        ("explain covering.tri 20 15", "screen", bands),
        ("compare default default,formats.z_fraction=12 covering.tri --out compare", "screen", bands),
        ("sweep covering.tri --vary memory.latency=1,2 --out sweep", "screen", bands),
        ("size covering.tri --out size", "", bands),
        ("replay covering.tri --from 3000000 --cycles 2 --out replay.html", "screen", bands),
        ("triangles covering.tri --out written.tri", "", none),
        ("trace covering.tri --cycles 2 --out trace.vcd", "screen", none),
        ("vectors small.tri --out vectors", "screen", none),
        ("bench small.tri --engine fast,tick,interpreter --repeat 1", "screen", none),
    ];
    for (command, settings, fixed) in runs {
        let words: Vec<&str> = command.split(' ').collect();
        let settings: &[&str] = if settings.is_empty() { &[] } else { &on_screen };
        let most = most_memory(folder.path(), &[&words, settings].concat());
        // 1.5 GB for 8192 x 8192.
        let limit = pixels * 1_500_000_000 / (1 << 26) + fixed;
        println!("{} MB of {}: {command}", most / 1_000_000, limit / 1_000_000);
        assert!(most <= limit, "{} MB for {} permitted: {command}", most / 1_000_000, limit / 1_000_000);
    }
    println!("checked {0} / {0} commands", runs.len());
}

#[test]
fn an_endless_word_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    // 300 MB without a blank or a line end; a hole in the disk.
    for name in ["long.tri", "long.obj", "long.mtl", "long.toml", "machine.toml"] {
        File::create(at(name)).unwrap().set_len(300_000_000).unwrap();
    }
    std::fs::write(at("mesh.obj"), "mtllib long.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    // As long as permitted, and one key.
    std::fs::write(at("key.toml"), "x".repeat((16 << 20) - 5) + " = 1\n").unwrap();
    std::fs::write(at("machine_key.toml"), "[screen]\n".to_owned() + &"x".repeat(1 << 19) + " = 1\n")
        .unwrap();
    std::fs::write(at("word.tri"), "size 8 8\n".to_owned() + &"x".repeat(10 << 20) + " 1\n").unwrap();
    std::fs::write(at("number.tri"), "size 8 8\nT ".to_owned() + &"1 ".repeat(10 << 20) + "\n").unwrap();
    let runs: [(&[&str], &str); 11] = [
        (&["raster", "long.tri", "--out", "o"], "long.tri:1: line: "),
        (&["raster", "long.tri", "--engine", "golden", "--out", "o"], "long.tri:1: line: "),
        (&["render", "long.tri"], "long.tri:1: line: "),
        (&["render", "long.obj"], "long.obj:1: line: "),
        (&["render", "mesh.obj"], "long.mtl:1: line: "),
        (&["render", "long.toml"], "long.toml: length: "),
        (&["render", "key.toml"], "key.toml:1: key: "),
        (&["emit", "--machine", "machine.toml"], "--machine machine.toml: permitted: at most"),
        (
            &["emit", "--machine", "machine_key.toml"],
            "--machine machine_key.toml: line 2: unknown key screen.xxx",
        ),
        (&["raster", "word.tri", "--out", "o"], "word.tri:2: line starts with: "),
        (&["raster", "number.tri", "--out", "o"], "number.tri:2: T: "),
    ];
    for (arguments, says) in runs {
        let start = Instant::now();
        let output = within(300, folder.path(), arguments);
        let (code, error) = ended(&output);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(error.starts_with(&format!("error: {says}")), "{arguments:?}: {error}");
        assert!(error.len() < 1000, "{arguments:?}: {} bytes of message", error.len());
        // A likeness of such a word takes hours; a busy machine takes seconds.
        assert!(start.elapsed() < Duration::from_secs(90), "{arguments:?} took {:?}", start.elapsed());
    }
    println!("checked {0} / {0} inputs", runs.len());
}
