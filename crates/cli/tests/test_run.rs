//! `tests/run` and `tests/suites` with a build, test programs and a Python part of our own: the exit code is that of the parts.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::root;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

/// Writes a shell script that can be run.
fn script(path: &Path, body: &str) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, format!("#!/bin/sh\n{body}\n")).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// The exit code of `tests/run` and what it prints, where the build, the suites and the Python part end as given.
fn run(build: &str, suites: &str, python: &str) -> (Option<i32>, String) {
    run_with(None, build, suites, python)
}

/// The same, where the caller has this `RUSTC_WRAPPER` or none.
fn run_with(wrapper: Option<&str>, build: &str, suites: &str, python: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("tests")).unwrap();
    fs::copy(root().join("tests/run"), at.join("tests/run")).unwrap();
    // The module is built as the test programs are.
    script(
        &at.join("tests/python"),
        &format!("[ \"$*\" = '--release --workspace --features edgewalk-cli/jit' ] || exit 9\n{python}"),
    );
    script(&at.join("tests/suites"), suites);
    script(&at.join("bin/cargo"), build);
    fs::create_dir(at.join("temporary")).unwrap();
    let path = format!("{}:{}", at.join("bin").display(), std::env::var("PATH").unwrap());
    let mut command = Command::new(at.join("tests/run"));
    // The run that this test is a part of has one.
    command.env_remove("RUSTC_WRAPPER").envs(wrapper.map(|wrapper| ("RUSTC_WRAPPER", wrapper)));
    let output = command.env("PATH", path).env("TMPDIR", at.join("temporary")).output().unwrap();
    let left = fs::read_dir(at.join("temporary")).unwrap().count();
    assert_eq!(left, 0, "temporary folders are left");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(text).unwrap())
}

#[test]
fn the_exit_code_of_the_whole_run_is_that_of_its_parts() {
    let passed = "echo 'test result: ok. 1 passed; finished in 2.00s'";
    let cases = [
        ("true", passed, "echo of Python", 0),
        // The Python part may end first or last.
        ("true", passed, "sleep 1; echo of Python", 0),
        ("true", "sleep 1", "echo of Python", 0),
        ("true", "exit 101", "echo of Python", 1),
        ("true", passed, "exit 1", 1),
        ("true", passed, "exit 3", 1),
        ("exit 101", passed, "echo of Python", 1),
    ];
    for (build, suites, python, code) in cases {
        let (ended, text) = run(build, suites, python);
        assert_eq!(ended, Some(code), "build `{build}`, suites `{suites}`, Python `{python}`: {text}");
        let complains = text.contains("tests/run: tests/python failed");
        assert_eq!(complains, python.starts_with("exit"), "{text}");
        assert_eq!(text.contains("tests/run: suites "), build == "true", "{text}");
    }
}

#[test]
fn the_python_module_is_the_one_of_the_test_build() {
    let folder = tempfile::tempdir().unwrap();
    script(&folder.path().join("cargo"), "echo \"${CARGO-none} ${PYO3_PYTHON-none} $*\"");
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    for (asked, called) in [
        (
            ["rustc", "--lib"],
            "none none test --release --all --no-run --message-format json-render-diagnostics\n",
        ),
        (["metadata", "--offline"], "none python metadata --offline\n"),
    ] {
        let mut command = Command::new(root().join("tests/python"));
        command.args(asked).env("PATH", &path).env("CARGO", "tests/python").env("PYO3_PYTHON", "python");
        let output = command.env("EDGEWALK_MODULE_OF", "--release --all").output().unwrap();
        assert_eq!(String::from_utf8_lossy(&output.stdout), called);
        assert!(output.status.success());
    }
}

/// The exit code of `tests/suites` and what it prints, where these test programs are built and the examples end as given.
fn suites(programs: &[&str], examples: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut artifacts = String::new();
    for (number, body) in programs.iter().enumerate() {
        let (crate_, program) =
            (at.join(format!("a crate {number}")), at.join(format!("a program {number}")));
        script(&crate_.join("tests/main.rs"), "");
        script(&program, body);
        // A program that is no test is named by cargo too.
        for (program, test) in [(&program, true), (&at.join("absent"), false)] {
            artifacts += &format!(
                "{{\"manifest_path\":\"{0}/Cargo.toml\",\"target\":{{\"src_path\":\"{0}/tests/main.rs\",\"test\":true}},\
                 \"profile\":{{\"test\":{test}}},\"features\":[],\"executable\":\"{1}\"}}\n",
                crate_.display(),
                program.display()
            );
        }
    }
    fs::write(at.join("artifacts"), artifacts).unwrap();
    let named = format!("cat '{}'", at.join("artifacts").display());
    let cargo = format!(
        "case \"$*\" in *'--here --no-run'*) {named};; *'--here --doc'*) {examples};; *) exit 9;; esac"
    );
    script(&at.join("bin/cargo"), &cargo);
    fs::create_dir(at.join("temporary")).unwrap();
    let path = format!("{}:{}", at.join("bin").display(), std::env::var("PATH").unwrap());
    let mut command = Command::new(root().join("tests/suites"));
    command.arg("--here").env("PATH", path).env("TMPDIR", at.join("temporary"));
    let output = command.output().unwrap();
    assert_eq!(fs::read_dir(at.join("temporary")).unwrap().count(), 0, "temporary folders are left");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(text).unwrap())
}

#[test]
fn each_test_program_runs_and_each_failure_is_told() {
    let passed = "echo \"in $(basename \"$PWD\"), $(basename \"$CARGO_MANIFEST_DIR\")\"";
    let killed = "echo half a line; kill -9 $$";
    let cases: [(&[&str], &str, i32, &[&str]); 7] = [
        (&[passed; 5], "echo the examples", 0, &[]),
        (&[passed, "exit 101", passed], "true", 1, &["a crate 1 tests/main.rs: exit code 101"]),
        (&[passed, passed, killed], "true", 1, &["a crate 2 tests/main.rs: exit code 137"]),
        (&[passed], "exit 101", 1, &["documentation: exit code 101"]),
        (
            &["exit 1", "exit 2"],
            "exit 3",
            1,
            &["a crate 0 tests/main.rs: exit code 1", "documentation: exit code 3"],
        ),
        (&[], "true", 1, &["cargo names no test program"]),
        (&["sleep 1; exit 4", passed, passed], "true", 1, &["a crate 0 tests/main.rs: exit code 4"]),
    ];
    for (programs, examples, code, told) in cases {
        let (ended, text) = suites(programs, examples);
        assert_eq!(ended, Some(code), "{programs:?}, examples `{examples}`: {text}");
        for told in told {
            assert!(text.contains(told), "{told}: {text}");
        }
        for (number, body) in programs.iter().enumerate() {
            let title = format!("Running a crate {number} tests/main.rs\n");
            assert_eq!(text.matches(&title).count(), 1, "{title}: {text}");
            let own = format!("{title}in a crate {number}, a crate {number}\n");
            assert_eq!(text.contains(&own), *body == passed, "{own}: {text}");
        }
        assert_eq!(text.contains("the examples\n"), examples.starts_with("echo"), "{text}");
    }
}

#[test]
fn the_run_compiles_by_its_own_wrapper_or_the_callers() {
    let said = "echo \"by <$RUSTC_WRAPPER>\"";
    for (wrapper, named) in [(None, "/tests/rustc>"), (Some("mine"), "by <mine>"), (Some(""), "by <>")] {
        let (ended, text) = run_with(wrapper, said, "true", "true");
        assert!(ended == Some(0) && text.contains(named), "{wrapper:?}: {text}");
    }
}

#[test]
fn temporary_files_lie_where_the_caller_wants_them() {
    let (ended, text) = run("true", "echo \"in <$TMPDIR>\"", "true");
    assert!(ended == Some(0) && text.contains("/temporary>"), "{text}");
}

/// The folder for temporary files that `tests/run` chooses without a TMPDIR, where `df` says so many KB are free in `/dev/shm`.
/// Scripts in it can be started or not.
fn temporary_folder(free: u64, may_run: bool) -> String {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("tests")).unwrap();
    fs::copy(root().join("tests/run"), at.join("tests/run")).unwrap();
    script(&at.join("tests/python"), "true");
    script(&at.join("tests/suites"), "echo \"in <${TMPDIR-}>\"");
    script(&at.join("bin/cargo"), "true");
    script(&at.join("bin/df"), &format!("echo 'Filesystem Blocks Used Available'; echo 'shm 9 9 {free}'"));
    if !may_run {
        script(&at.join("bin/chmod"), "true");
    }
    let left = || {
        let names = fs::read_dir("/dev/shm").into_iter().flatten().flatten().map(|entry| entry.file_name());
        names.filter(|name| name.to_string_lossy().starts_with("edgewalk.")).collect::<Vec<_>>()
    };
    let before = left();
    let path = format!("{}:{}", at.join("bin").display(), std::env::var("PATH").unwrap());
    let mut command = Command::new(at.join("tests/run"));
    let output = command.env("PATH", path).env_remove("TMPDIR").output().unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert!(output.status.success(), "{text}");
    assert!(left().iter().all(|name| before.contains(name)), "a file is left in /dev/shm");
    let named =
        text.split_once("in <").and_then(|(_, rest)| rest.split_once(">\n")).expect("the suites ran").0;
    named.to_owned()
}

#[test]
fn temporary_files_lie_in_memory_where_there_is_room_and_programs_may_run() {
    // Whether this system has such a folder at all is asked of it in another way.
    let mine = Path::new("/dev/shm").join(format!("edgewalk-test-{}", std::process::id()));
    let there = fs::write(&mine, "#!/bin/sh\n").is_ok()
        && fs::set_permissions(&mine, fs::Permissions::from_mode(0o755)).is_ok()
        && Command::new(&mine).status().is_ok_and(|status| status.success());
    let _ = fs::remove_file(&mine);
    assert_eq!(temporary_folder(4_000_001, true), if there { "/dev/shm" } else { "" });
    assert_eq!(temporary_folder(4_000_000, true), "");
    assert_eq!(temporary_folder(4_000_001, false), "");
}

/// A compiler in this folder that writes its arguments into its output and counts its calls, and `tests/objcache` before it.
struct Cached<'a>(&'a Path);

impl Cached<'_> {
    /// Compiles a source with these options; the exit code, what is written, and how often the compiler ran.
    fn compile(&self, options: &[&str], source: &str) -> (Option<i32>, Option<String>, usize) {
        let (out, calls) = (self.0.join("out.o"), self.0.join("calls"));
        let _ = (fs::remove_file(&out), fs::remove_file(&calls));
        script(
            &self.0.join("cc"),
            &format!(
                "echo call >>'{}'\ncase \"$*\" in *-Dwrong*) exit 3;; esac\nall=$*\n\
                 while [ $# -gt 0 ]; do [ \"$1\" = -o ] && echo \"$all\" >\"$2\"; shift; done",
                calls.display()
            ),
        );
        let mut command = Command::new(root().join("tests/objcache"));
        command.arg(self.0.join("cc")).args(options).args(["-c", "-o"]).arg(&out).arg(source);
        command.env("EDGEWALK_OBJECTS", self.0.join("objects"));
        let status = command.status().unwrap();
        let calls = fs::read_to_string(&calls).unwrap_or_default().lines().count();
        (status.code(), fs::read_to_string(&out).ok(), calls)
    }
}

/// Two that begin at once: one compiles, the other waits for what it makes.
#[test]
fn a_file_of_verilator_is_compiled_once_by_two_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("objects")).unwrap();
    let compiler = "echo call >>../calls; sleep 1
        while [ $# -gt 0 ]; do [ \"$1\" = -o ] && echo made >\"$2\"; shift; done";
    script(&at("cc"), compiler);
    for own in [true, false] {
        fs::write(at("calls"), "").unwrap();
        let runs = ["one", "two"].map(|place| {
            fs::create_dir_all(at(place)).unwrap();
            let mut command = Command::new(root().join("tests/objcache"));
            let source = if own { "/share/verilator/include/verilated.cpp" } else { "Vtop.cpp" };
            command.arg(at("cc")).args(["-O1", "-c", "-o", "it.o", source]).current_dir(at(place));
            command.env("EDGEWALK_OBJECTS", at("objects")).spawn().unwrap()
        });
        for mut run in runs {
            assert!(run.wait().unwrap().success());
        }
        // Of a simulation's file the header ahead of it, and the file twice.
        let calls = fs::read_to_string(at("calls")).unwrap().lines().count();
        assert_eq!(calls, if own { 1 } else { 3 });
    }
}

#[test]
fn files_of_verilator_are_compiled_once_for_the_same_options() {
    let folder = tempfile::tempdir().unwrap();
    let cached = Cached(folder.path());
    fs::create_dir(folder.path().join("objects")).unwrap();
    let own = "/share/verilator/include/verilated.cpp";
    let (code, first, calls) = cached.compile(&["-O1", "-MMD"], own);
    assert_eq!((code, calls), (Some(0), 1));
    assert!(first.as_ref().is_some_and(|text| text.contains("-O1 -MMD -c -o")), "{first:?}");
    assert_eq!(cached.compile(&["-O1", "-MMD"], own), (Some(0), first.clone(), 0), "kept");
    for (options, source) in
        [(["-O2", "-MMD"], own), (["-O1", "-MMD"], "/share/verilator/include/verilated_vcd_c.cpp")]
    {
        let (code, other, calls) = cached.compile(&options, source);
        assert_eq!((code, calls), (Some(0), 1), "{options:?} {source}");
        assert_ne!(other, first);
    }
    // The compiler's exit code is passed on, and no object is kept.
    assert_eq!(cached.compile(&["-Dwrong"], own), (Some(3), None, 1));
    assert_eq!(cached.compile(&["-Dwrong"], own), (Some(3), None, 1));

    // A file of the simulation: the header ahead of it, once for the same options, and the file each time.
    for (options, calls) in
        [(["-O1", "-MMD"], 2), (["-O1", "-MMD"], 1), (["-O2", "-MMD"], 2), (["-O1", "-MMD"], 1)]
    {
        let (code, made, ran) = cached.compile(&options, "Vtop.cpp");
        assert_eq!((code, ran), (Some(0), calls), "{options:?}");
        let made = made.expect("an object");
        let (before, header) = made.split_once(" -include ").expect("the header is included");
        assert_eq!(before, options.join(" "));
        let header = header.split_once(" -c -o ").expect("then the file").0;
        assert_eq!(fs::read_to_string(header).unwrap(), "#include \"verilated.h\"\n");
        let ahead = fs::read_to_string(format!("{header}.gch")).expect("the header compiled ahead");
        assert!(ahead.starts_with(&options.join(" ")) && ahead.contains("-x c++-header"), "{ahead}");
    }
    assert_eq!(cached.compile(&["-Dwrong"], "Vtop.cpp"), (Some(3), None, 1));
    let kept = fs::read_dir(folder.path().join("objects")).unwrap();
    let names = kept.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let unfinished: Vec<_> =
        names.filter(|name| ![".o", ".h", ".gch", ".lock"].iter().any(|end| name.ends_with(end))).collect();
    assert!(unfinished.is_empty(), "{unfinished:?}");
}

/// What `tests/rustc` hands to the compiler for a crate of this package and name.
fn compiled(package: &str, name: &str, arguments: &str) -> String {
    let mut command = Command::new(root().join("tests/rustc"));
    command.arg("echo").args(arguments.split(' ')).env("CARGO_PKG_NAME", package);
    let output = command.env("CARGO_CRATE_NAME", name).output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

#[test]
fn test_programs_that_compute_little_are_not_optimised() {
    let words = "--crate-name it -C opt-level=3 --test";
    let level = |package: &str, name: &str| {
        let handed = compiled(package, name, words);
        let added = handed.strip_prefix(words).expect("the words of cargo come first");
        added.split_whitespace().find_map(|word| word.strip_prefix("opt-level=")).map(String::from)
    };
    assert_eq!(level("edgewalk-cli", "suites").as_deref(), Some("0"));
    assert_eq!(level("edgewalk-scene", "edgewalk_scene").as_deref(), Some("0"));
    assert_eq!(compiled("edgewalk-scene", "edgewalk_scene", "--emit=link"), "--emit=link", "a library");

    // The others are named: each name is that of a test program.
    let text = fs::read_to_string(root().join("tests/rustc")).unwrap();
    let named: Vec<_> = text.split('"').filter(|part| part.starts_with("edgewalk-")).collect();
    assert_eq!(named.len(), 7, "{named:?}");
    for program in named {
        let (package, name) = program.split_once(' ').expect("package and crate");
        assert_ne!(level(package, name).as_deref(), Some("0"), "{program}");
        let folder = root().join("crates").join(package.trim_start_matches("edgewalk-"));
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let declared = manifest.contains(&format!("[[test]]\nname = \"{name}\"\n"));
        let library = name == package.replace('-', "_");
        assert!(
            declared || library || folder.join("tests").join(name).is_dir(),
            "{program}: no such test program"
        );
    }
}
