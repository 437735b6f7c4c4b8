//! The completions and the manual name every command and every option that `--help` names.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::edgewalk;
use std::collections::BTreeSet;
use std::path::Path;

fn printed(folder: &Path, arguments: &[&str]) -> String {
    let output = edgewalk(folder, arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The commands that `--help` lists.
fn commands(folder: &Path) -> Vec<String> {
    let help = printed(folder, &["--help"]);
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    let names = listed.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

/// The long options that the help of a command names at the beginning of a line.
fn options(folder: &Path, command: &str) -> BTreeSet<String> {
    let help = printed(folder, &[command, "--help"]);
    let starts = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
    let words = starts.flat_map(|line| line.split([' ', ',']).take(3));
    words.filter(|word| word.starts_with("--")).map(str::to_owned).collect()
}

#[test]
fn shells_complete_every_command_and_option() {
    let folder = tempfile::tempdir().unwrap();
    let commands = commands(folder.path());
    let mut checked = 0;
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let text = printed(folder.path(), &["completions", shell, "--quiet"]);
        for command in &commands {
            assert!(text.contains(command.as_str()), "{shell}: {command}");
            for option in options(folder.path(), command) {
                let name =
                    if shell == "fish" { format!("-l {}", option.trim_start_matches('-')) } else { option };
                assert!(text.contains(&name), "{shell}: {command} {name}");
                checked += 1;
            }
        }
    }
    println!("{checked} options of {} commands", commands.len());
    assert!(commands.len() > 15 && checked > 500, "{checked}");
    let output = edgewalk(folder.path(), &["completions", "dos"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("bash, elvish, fish, powershell, zsh"));
}

#[test]
fn bash_reads_its_completions() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("e"), printed(folder.path(), &["completions", "bash"])).unwrap();
    let script = ". ./e; COMP_WORDS=(edgewalk ren); COMP_CWORD=1; _edgewalk edgewalk ren edgewalk; echo ${COMPREPLY[@]}";
    let output =
        std::process::Command::new("bash").args(["-c", script]).current_dir(folder.path()).output().unwrap();
    assert_eq!(
        String::from_utf8_lossy(&output.stdout),
        "render\n",
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn manual_has_a_page_for_every_command() {
    let folder = tempfile::tempdir().unwrap();
    printed(folder.path(), &["man", "--out", "man"]);
    let page = |name: &str| {
        let path = folder.path().join("man").join(name);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        text.replace("\\-", "-")
    };
    let (top, commands) = (page("edgewalk.1"), commands(folder.path()));
    let mut checked = 0;
    for command in &commands {
        assert!(top.contains(&format!("edgewalk-{command}(1)")), "{command}");
        let page = page(&format!("edgewalk-{command}.1"));
        assert!(page.contains("Examples:"), "{command}");
        for option in options(folder.path(), command) {
            assert!(page.contains(&option), "{command} {option}");
            checked += 1;
        }
    }
    println!("{checked} options of {} commands", commands.len());
    assert!(checked > 100, "{checked}");
    assert!(page("edgewalk-config-explain.1").contains("memory.hazard"));
}
