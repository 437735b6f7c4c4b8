//! What a waveform shows: what can change, causes by name, tags only where the machine has them.

use std::process::Command;

fn vcd(settings: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("t.vcd");
    let small = ["screen.width=24", "screen.height=20", "screen.guard_bits=6"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["trace", "sphere", "--triangles", "2", "--cycles", "900", "--out"]).arg(&out);
    small.iter().chain(settings).for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    std::fs::read_to_string(out).expect("written")
}

#[test]
fn a_waveform_holds_causes_by_name_and_no_constants_and_no_tags() {
    let text = vcd(&[]);
    let (header, changes) = text.split_once("$enddefinitions").expect("a header");
    let declared = |name: &str| header.lines().any(|line| line.contains(&format!(" {name} $end")));
    for name in ["clk", "activity", "activity_name", "tri_valid", "wr_z"] {
        assert!(declared(name), "{name} is not there");
    }
    for name in ["DRAW", "EDGE", "IDLE", "EDGE_STEP", "tri_tag", "wr_tag"] {
        assert!(!declared(name), "{name} is there");
    }
    assert!(!header.contains("_tag"), "a machine without tags is traced with tags");
    let line = header.lines().find(|line| line.contains(" activity_name $end")).expect("declared");
    let id = line.split_whitespace().nth(3).expect("an identifier");
    for name in ["idle", "setup"] {
        assert!(
            changes.lines().any(|line| line == format!("s{name} {id}")),
            "the cause {name} is never shown"
        );
    }
}

#[test]
fn a_waveform_ends_after_as_many_cycles_as_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder.path());
    let output =
        command.args(["trace", "sphere", "--cycles", "70", "--out", "t.vcd"]).output().expect("runs");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "70 cycles -> t.vcd\n");
    let text = std::fs::read_to_string(folder.path().join("t.vcd")).expect("written");
    let times = text.lines().filter_map(|line| line.strip_prefix('#')?.parse::<u64>().ok());
    let times: Vec<u64> = times.collect();
    assert!(times.len() >= 70 && times.len() <= 2 * 70 + 1, "{} times", times.len());
}

/// As every command that has nothing to do; and no file is left.
#[test]
fn nothing_to_trace_is_exit_code_2_with_its_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("empty.tri"), "size 8 8\n").expect("written");
    let away = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\n\n[[object]]\nbuiltin = \"sphere\"\n";
    std::fs::write(folder.path().join("away.toml"), away).expect("written");
    for source in [&["empty.tri"][..], &["away.toml"], &["sphere", "--triangles", "0"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        command.current_dir(folder.path()).arg("trace").args(source);
        command.args(["--set", "screen.width=8", "--set", "screen.height=8", "-q", "--out", "t.vcd"]);
        let output = command.output().expect("the program runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{source:?}: {message}");
        assert!(
            message.contains(&format!("{}: nothing was drawn: it has no triangle", source[0])),
            "{message}"
        );
        assert!(!folder.path().join("t.vcd").exists(), "{source:?}");
    }
}

#[test]
fn tags_that_the_machine_has_are_traced() {
    assert!(vcd(&["memory.tag_bits=4"]).contains(" tri_tag $end"));
}
