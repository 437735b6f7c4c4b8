//! What stands in the folder after a run, whatever becomes of it: all of its files or none, and nothing of an earlier run.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, ended, names, run};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("d.tri"), TRIANGLE).unwrap();
    folder
}

/// Runs it, and it succeeds.
fn passes(folder: &Path, arguments: &[&str]) {
    assert_eq!(run(folder, arguments), (Some(0), String::new()), "{arguments:?}");
}

/// Every file under a folder with its contents.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for name in names(folder) {
        let path = folder.join(&name);
        if path.is_dir() {
            files
                .extend(contents(&path).into_iter().map(|(below, bytes)| (format!("{name}/{below}"), bytes)));
        } else {
            files.insert(name, std::fs::read(path).unwrap());
        }
    }
    files
}

const RASTER: [&str; 7] =
    ["coverage.npy", "id.npy", "image.png", "report.json", "rgb.npy", "writes.npy", "z.npy"];

#[test]
fn a_run_that_cannot_place_a_file_changes_nothing() {
    let folder = folder();
    let out = folder.path().join("out");
    passes(folder.path(), &["raster", "d.tri", "--out", "out", "-q"]);
    std::fs::write(out.join("mine.txt"), "mine").unwrap();
    // The last but one to be placed, of another picture.
    std::fs::remove_file(out.join("writes.npy")).unwrap();
    std::fs::create_dir_all(out.join("writes.npy/below")).unwrap();
    std::fs::write(folder.path().join("d.tri"), TRIANGLE.replace("60 0", "50 0")).unwrap();
    let before = contents(&out);
    assert_eq!(before.len(), RASTER.len());
    let (code, error) = run(folder.path(), &["raster", "d.tri", "--out", "out", "--engine", "golden"]);
    assert_eq!(
        (code, error.as_str()),
        (
            Some(2),
            "error: out/writes.npy: is a folder where a file must be written; remove it, or choose another --out\n"
        )
    );
    assert!(contents(&out) == before, "changed: {:?}", names(&out));
    assert!(!names(&out).iter().any(|name| name.starts_with(".edgewalk")), "{:?}", names(&out));

    // Nor are the folders left that were made on the way.
    let (code, _) = run(folder.path(), &["raster", "none.tri", "--out", "a/b/c"]);
    assert_eq!((code, folder.path().join("a").exists()), (Some(2), false));
    // A file where the folder is to be is an error that says so.
    let (code, error) = run(folder.path(), &["emit", "--out", "d.tri"]);
    assert_eq!(code, Some(2));
    assert!(error.starts_with("error: --out d.tri: "), "{error}");
}

/// A pipe stays what it is, as do devices; nothing of the run is moved where one stands in the way.
#[test]
fn no_file_takes_the_place_of_a_pipe() {
    use std::os::unix::fs::{FileTypeExt as _, symlink};
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("r")).unwrap();
    let pipes = ["p.tri", "p.vcd", "p.html", "p.xml", "r/image.png", "r/lit.npy"];
    let made = Command::new("mkfifo").args(pipes).current_dir(folder.path()).status().unwrap();
    assert!(made.success());
    symlink("p.tri", at("link.tri")).unwrap();
    let commands: [(&[&str], &str); 6] = [
        (&["triangles", "d.tri", "--out", "p.tri"], "./p.tri"),
        (&["triangles", "d.tri", "--out", "link.tri"], "./link.tri"),
        (&["trace", "d.tri", "--cycles", "9", "--out", "p.vcd"], "./p.vcd"),
        (&["replay", "d.tri", "--out", "p.html"], "./p.html"),
        (&["verify", "d.tri", "--no-simulators", "--junit", "p.xml"], "./p.xml"),
        (&["raster", "d.tri", "--out", "r"], "r/image.png"),
    ];
    for (command, file) in commands {
        let screen = if command[0] == "raster" { &[][..] } else { &SCREEN };
        let (code, error) = run(folder.path(), &[command, screen, &["-q"]].concat());
        let says = format!("error: {file}: a pipe stands there; permitted: a regular file or a new name\n");
        assert_eq!((code, error), (Some(2), says), "{command:?}");
    }
    assert_eq!(names(&at("r")), ["image.png", "lit.npy"], "nothing was placed");
    // A pipe of the name that a run no longer writes stays.
    std::fs::remove_file(at("r/image.png")).unwrap();
    passes(folder.path(), &["raster", "d.tri", "--out", "r", "-q"]);
    for pipe in pipes.iter().filter(|pipe| **pipe != "r/image.png") {
        let there = std::fs::symlink_metadata(at(pipe)).unwrap();
        assert!(there.file_type().is_fifo(), "{pipe} is no pipe any more");
    }

    // A link to a file is replaced, and the file stays.
    symlink("d.tri", at("file.tri")).unwrap();
    passes(folder.path(), &["triangles", "sphere", "--out", "file.tri", "-q"]);
    assert!(std::fs::symlink_metadata(at("file.tri")).unwrap().is_file());
    assert_eq!(std::fs::read_to_string(at("d.tri")).unwrap(), TRIANGLE);
}

#[test]
fn a_file_that_cannot_be_finished_is_named_by_its_place() {
    let folder = folder();
    // No file may grow beyond so many blocks, as on a disk that is full; the signal that says so is not the program's end.
    let script = "trap '' XFSZ; ulimit -f $0; exec \"$@\"";
    let trace = [&["trace", "d.tri", "-q", "--out", "a/t.vcd"], &SCREEN[..]].concat();
    // Small enough to be written at the very end.
    std::fs::write(folder.path().join("small.tri"), TRIANGLE.replace("size 64 48", "size 40 30")).unwrap();
    let screen = ["--set", "screen.width=120", "--set", "screen.height=90"];
    let picture = [&["render", "sphere", "-q", "--out", "a/p"], &screen[..]].concat();
    let commands: [(&[&str], &str, &str); 5] = [
        (&["raster", "d.tri", "-q", "--out", "a/r"], "20", "a/r/rgb.npy"),
        (&["raster", "small.tri", "-q", "--out", "a/s"], "20", "a/s/rgb.npy"),
        (&["emit", "-q", "--out", "a/e"], "20", "a/e/edgewalk_setup.v"),
        (&trace, "20", "a/t.vcd"),
        // A picture of which all bytes are written at the very end.
        (&picture, "10", "a/p/golden.png"),
    ];
    for (command, blocks, file) in commands {
        let mut shell = Command::new("sh");
        shell.args(["-c", script, blocks, env!("CARGO_BIN_EXE_edgewalk")]).args(command);
        let (code, error) = ended(&shell.current_dir(folder.path()).output().unwrap());
        assert_eq!(code, Some(2), "{command:?}: {error}");
        assert_eq!(error, format!("error: {file}: File too large (os error 27)\n"), "{command:?}");
        assert_eq!(names(folder.path()), ["d.tri", "small.tri"], "{command:?}");
    }
    println!("checked {0} / {0} commands", commands.len());
}

#[test]
fn files_of_an_earlier_run_do_not_stay_and_others_do() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let mine = "mine";
    for out in ["r", "p", "d", "d/hdl", "e", "v", "v/hazards_depth", "g"] {
        std::fs::create_dir_all(at(out)).unwrap();
        for name in ["mine.txt", "edgewalk_mine.v", "phong.npy", "mach-bands-mine.png"] {
            std::fs::write(at(out).join(name), mine).unwrap();
        }
    }
    let passes = |arguments: &[&str]| passes(folder.path(), &[arguments, &["-q"]].concat());
    let left = |out: &str| {
        let mine = |name: &String| std::fs::read(at(out).join(name)).is_ok_and(|text| text == b"mine");
        let (mine, others): (Vec<String>, Vec<String>) = names(&at(out)).into_iter().partition(mine);
        assert_eq!(mine.len(), 4, "{out}: {mine:?}");
        others
    };

    passes(&["raster", "d.tri", "--engine", "golden", "--out", "r"]);
    assert!(left("r").contains(&"lit.npy".to_owned()));
    passes(&["raster", "d.tri", "--out", "r"]);
    assert_eq!(left("r"), RASTER);

    let golden = ["render", "sphere", "--engine", "golden", "--out", "p", "--set", "screen.width=64"];
    passes(&[&golden[..], &["--shading", "fast-phong"]].concat());
    assert_eq!(left("p").len(), 7, "{:?}", left("p"));
    passes(&["render", "sphere", "--out", "p", "--set", "screen.width=64"]);
    let pictures = ["color_error.png", "golden.png", "image.png", "report.json", "report.txt", "z_error.png"];
    assert_eq!(left("p"), pictures);
    passes(&[&golden[..], &["--shading", "wireframe"]].concat());
    assert_eq!(left("p"), ["image.png", "report.json", "report.txt"]);

    passes(&["demo", "sphere", "--out", "d"]);
    let of_default = [left("d"), left("d/hdl")].concat();
    // Whatever its verdict is: the listing's pixels beyond an edge have no proved bound.
    let (code, error) = run(folder.path(), &["demo", "sphere", "--machine", "textbook", "--out", "d", "-q"]);
    assert!(code == Some(0) || code == Some(1), "{error}");
    let of_textbook = [left("d"), left("d/hdl")].concat();
    for name in ["z_accumulator.png", "edgewalk_setup_lane1.v"] {
        let there = [&of_default, &of_textbook].map(|names| names.iter().any(|other| other == name));
        assert_eq!(there, [true, false], "{name}: {of_default:?} {of_textbook:?}");
    }

    passes(&["emit", "--out", "e", "--set", "setup.lanes=4"]);
    assert!(left("e").contains(&"edgewalk_setup_lane1.v".to_owned()));
    passes(&["emit", "--out", "e", "--set", "setup.lanes=1"]);
    let lanes: Vec<String> = left("e").into_iter().filter(|name| name.contains("lane")).collect();
    assert_eq!(lanes, ["edgewalk_setup_lane0.v"]);

    let vectors = ["vectors", "--suite", "hazards", "--out", "v", "--unit"];
    passes(&[&vectors[..], &["depth"]].concat());
    passes(&[&vectors[..], &["setup", "--set", "setup.lanes=4"]].concat());
    assert_eq!(left("v"), ["hazards_depth", "hazards_setup"]);
    assert!(at("v/hazards_setup/hdl/edgewalk_setup_lane1.v").exists());
    passes(&[&vectors[..], &["setup", "--set", "setup.lanes=1"]].concat());
    assert!(!at("v/hazards_setup/hdl/edgewalk_setup_lane1.v").exists());
    assert!(left("v/hazards_depth").len() > 5);

    passes(&["gallery", "worked-example", "t-joint", "--out", "g"]);
    assert!(left("g").iter().any(|name| name.starts_with("t-joint-")));
    passes(&["gallery", "worked-example", "--out", "g"]);
    let shown = left("g");
    assert!(shown.len() > 1 && !shown.iter().any(|name| name.starts_with("t-joint-")), "{shown:?}");
}

/// The program with a SIGHUP that ends it, even where the tests were started to ignore one.
fn hearing_hangups(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new("env");
    command.args(["--default-signal=HUP", env!("CARGO_BIN_EXE_edgewalk")]).args(arguments);
    command.current_dir(folder).stdin(Stdio::null());
    command
}

#[test]
fn a_signal_leaves_nothing_behind() {
    let folder = folder();
    let before = names(folder.path());
    for signal in ["HUP", "INT", "TERM"] {
        let arguments = ["vectors", "--out", "a/v", "-q"];
        let mut child = hearing_hangups(folder.path(), &arguments).spawn().unwrap();
        let target = folder.path().join("a/v");
        let start = Instant::now();
        while !target.exists() || names(&target).is_empty() {
            assert!(start.elapsed() < Duration::from_secs(60), "no folder of the run");
            assert_eq!(child.try_wait().unwrap(), None, "it was done before the signal");
            std::thread::sleep(Duration::from_millis(5));
        }
        // In the middle of its files.
        std::thread::sleep(Duration::from_millis(300));
        let kill =
            Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        let status = child.wait().unwrap();
        assert_eq!(status.code(), None, "SIG{signal} ends it: {status}");
        assert_eq!(names(folder.path()), before, "after SIG{signal}");
    }
}

/// A file for the tools that cannot be written is no broken tool: the error names it. Here a file may have few bytes.
#[test]
fn a_full_cache_is_no_broken_tool() {
    let folder = folder();
    let mut shell = Command::new("sh");
    let limited = "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\"";
    shell.args([
        "-c",
        limited,
        env!("CARGO_BIN_EXE_edgewalk"),
        "synth",
        "--unit",
        "pixel",
        "--cache",
        "full",
    ]);
    let output = shell.args(["--out", "o"]).current_dir(folder.path()).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("full/") && error.contains("File too large"), "{error}");
    assert!(!error.contains("failed:"), "{error}");
}

/// A hangup does not end what was started to outlive it, as `nohup` does.
#[test]
fn an_ignored_hangup_ends_nothing() {
    let folder = folder();
    let vectors =
        ["vectors", "--suite", "hazards", "--unit", "machine", "--unit", "depth", "--out", "v", "-q"];
    let mut shell = Command::new("sh");
    shell.args(["-c", "trap '' HUP; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_edgewalk")]).args(vectors);
    let mut child = shell.current_dir(folder.path()).spawn().unwrap();
    let start = Instant::now();
    while !folder.path().join("v").exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no folder of the run");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(child.try_wait().unwrap(), None, "it was done before the signal");
    assert!(Command::new("kill").args(["-HUP", &child.id().to_string()]).status().unwrap().success());
    assert!(child.wait().unwrap().success());
    assert_eq!(names(&folder.path().join("v")), ["hazards_depth", "hazards_machine"]);
}

/// What a simulator writes beside its output goes with it, whatever ends the program.
#[test]
fn a_signal_leaves_no_files_of_a_tool() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for name in ["tools", "tmp"] {
        std::fs::create_dir(at(name)).unwrap();
    }
    // In place of a simulator that is being compiled.
    let script = "#!/bin/sh\nmkdir \"$TMPDIR/parts\"\necho x >\"$TMPDIR/parts/x\"\necho x >\"$TMP/y\"\ntouch \"$HOLD\"\nsleep 60\n";
    for tool in ["iverilog", "verilator"] {
        std::fs::write(at("tools").join(tool), script).unwrap();
        std::fs::set_permissions(at("tools").join(tool), std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", at("tools").display(), std::env::var("PATH").unwrap());
    for signal in ["TERM", "HUP"] {
        let arguments = [&["verify", "d.tri", "-q"], &SCREEN[..]].concat();
        let mut command = hearing_hangups(folder.path(), &arguments);
        let mut child =
            command.env("PATH", &path).env("TMPDIR", at("tmp")).env("HOLD", at("hold")).spawn().unwrap();
        let start = Instant::now();
        while !at("hold").exists() {
            assert!(start.elapsed() < Duration::from_secs(60), "no simulator was started");
            assert_eq!(child.try_wait().unwrap(), None);
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(!names(&at("tmp")).is_empty(), "it is at work");
        let kill = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(kill.unwrap().success());
        assert_eq!(child.wait().unwrap().code(), None, "SIG{signal} ends it");
        assert_eq!(names(&at("tmp")), [""; 0], "after SIG{signal}");
        std::fs::remove_file(at("hold")).unwrap();
    }
}

/// Commands with a folder for `--out`, and what is in it then at least.
const COMMANDS: [(&[&str], &str); 4] = [
    (&["raster", "d.tri", "-q", "--out"], "z.npy"),
    (&["emit", "-q", "--out"], "edgewalk.v"),
    (&["gallery", "worked-example", "-q", "--out"], "README.md"),
    (&["vectors", "--suite", "hazards", "--unit", "depth", "-q", "--out"], "hazards_depth"),
];

#[test]
fn the_target_may_be_a_mount_point() {
    let mut checked = 0;
    // A file system of our own in a mount namespace, as root or as a user who may have one.
    for flags in ["-m", "-rm"] {
        let trial = Command::new("unshare").args([flags, "sh", "-c", "mount -t tmpfs t /mnt"]).output();
        if !trial.is_ok_and(|output| output.status.success()) {
            continue;
        }
        let folder = folder();
        std::fs::create_dir(folder.path().join("m")).unwrap();
        let script = "mount -t tmpfs t m && \"$@\" && ls -A m";
        let trace = [&["trace", "d.tri", "-q", "--cycles", "9"], &SCREEN[..], &["--out"]].concat();
        let mut commands: Vec<(Vec<&str>, &str)> =
            COMMANDS.iter().map(|(command, file)| ([command, &["m"][..]].concat(), *file)).collect();
        commands.push(([&trace[..], &["m/t.vcd"]].concat(), "t.vcd"));
        for (command, file) in commands {
            let program = env!("CARGO_BIN_EXE_edgewalk");
            let mut unshare = Command::new("unshare");
            unshare.args([flags, "sh", "-c", script, "sh", program]).args(&command);
            let output = unshare.current_dir(folder.path()).output().unwrap();
            assert_eq!(ended(&output), (Some(0), String::new()), "{command:?}");
            let listed = String::from_utf8(output.stdout).unwrap();
            assert!(listed.lines().any(|name| name == file), "{command:?}: {listed}");
            assert!(!listed.contains(".edgewalk"), "{command:?}: {listed}");
            checked += 1;
        }
        break;
    }
    println!("checked {checked} commands on a mount point of our own");

    // Anyone may write to the mount point /dev/shm, and only root beside it.
    let shm = Path::new("/dev/shm");
    if shm.is_dir() {
        let folder = folder();
        let file = format!("/dev/shm/edgewalk-test-{}.vcd", std::process::id());
        let trace = [&["trace", "d.tri", "-q", "--cycles", "9", "--out", &file], &SCREEN[..]].concat();
        let ended = run(folder.path(), &trace);
        let written = std::fs::remove_file(&file).is_ok();
        assert_eq!((ended, written), ((Some(0), String::new()), true));
        checked += 1;
        println!("checked a file in /dev/shm");
    }
    assert!(checked > 0, "neither a mount namespace nor /dev/shm: nothing was checked");
}

/// One machine after the other in the same folder: it holds the modules of the last one alone.
#[test]
fn modules_of_another_machine_do_not_stay() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let bumps = "shade.kind=phong shade.colour=multiply texture.kind=nearest texture.bump=yes dither.bits=4";
    let mut modules = std::collections::BTreeSet::new();
    let mut checked = 0;
    for (preset, sets) in [
        ("polygon", ""),
        ("default", bumps),
        ("hx8k", ""),
        ("bilinear", ""),
        ("default", "shade.kind=phong shade.light=positional"),
        ("default", "shadow.light=perspective shadow.gate=scale blend.kind=constant"),
        ("small", ""),
        ("default", ""),
    ] {
        let sets: Vec<&str> = sets.split_whitespace().flat_map(|set| ["--set", set]).collect();
        passes(folder.path(), &[&["emit", "--machine", preset, "--out", "z", "-q"][..], &sets].concat());
        let list = std::fs::read_to_string(at("z/filelist.f")).unwrap();
        let mut listed: Vec<&str> = list.lines().filter(|line| line.ends_with(".v")).collect();
        listed.sort_unstable();
        let files: Vec<String> = names(&at("z")).into_iter().filter(|name| name.ends_with(".v")).collect();
        assert_eq!(files, listed, "{preset} {sets:?}");
        modules.extend(files);
        checked += 1;
    }
    println!("{checked} machines, {} modules", modules.len());
    assert!(modules.len() > 20, "{modules:?}");
}
