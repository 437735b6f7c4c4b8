//! A tool as a process with a time limit.

use std::io::{Read, Seek};
use std::os::unix::process::CommandExt;
use std::process::{Command, Stdio};
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
    /// It failed.
    #[error("{tool} failed:\n{}", lines.join("\n"))]
    Broken {
        /// The program.
        tool: String,
        /// What it said first.
        lines: Vec<String>,
    },
    /// It took too long and was ended.
    #[error("{tool} was ended after {} s", limit.as_secs())]
    TimeLimit {
        /// The program.
        tool: String,
        /// The limit.
        limit: Duration,
    },
}

impl Stop {
    pub(super) fn broken(tool: &str, error: &std::io::Error) -> Stop {
        Stop::Broken { tool: tool.to_owned(), lines: vec![error.to_string()] }
    }
}

/// The Debian package that a program comes with.
const PACKAGES: [(&str, &str); 4] =
    [("iverilog", "iverilog"), ("vvp", "iverilog"), ("verilator", "verilator make g++"), ("yosys", "yosys")];

/// Runs a tool to its end and gives what it printed, errors too.
pub(super) fn run(command: &mut Command, limit: Duration) -> Result<String, Stop> {
    let tool = command.get_program().to_string_lossy().into_owned();
    let broken = |error: std::io::Error| Stop::broken(&tool, &error);
    // A file takes any amount of text without anyone reading along.
    let mut printed = tempfile::tempfile().map_err(broken)?;
    let other_end = || printed.try_clone().map(Stdio::from);
    command.stdin(Stdio::null()).stdout(other_end().map_err(broken)?).stderr(other_end().map_err(broken)?);
    // A group of its own: with the tool its compilers end too.
    let mut child = command.process_group(0).spawn().map_err(|error| {
        let package = PACKAGES.iter().find(|(program, _)| *program == tool);
        match (error.kind(), package) {
            (std::io::ErrorKind::NotFound, Some((_, package))) => Stop::Missing {
                tool: tool.clone(),
                install: format!("apt-get install -y --no-install-recommends {package}"),
            },
            _ => Stop::broken(&tool, &error),
        }
    })?;
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(broken)? {
            break status;
        }
        if start.elapsed() > limit {
            let group = format!("-{}", child.id());
            // If even this fails there is only the child itself left to end.
            let _ = Command::new("kill").args(["-KILL", "--", &group]).status();
            let _ = child.kill();
            let _ = child.wait();
            return Err(Stop::TimeLimit { tool, limit });
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    let mut bytes = Vec::new();
    printed.rewind().and_then(|()| printed.read_to_end(&mut bytes)).map_err(broken)?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    match status.success() {
        true => Ok(text),
        false => Err(Stop::Broken { tool, lines: super::first_lines(text.lines()) }),
    }
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
        let late = run(&mut shell("sleep 60 & wait"), Duration::from_millis(50));
        assert_eq!(late, Err(Stop::TimeLimit { tool: "sh".to_owned(), limit: Duration::from_millis(50) }));
    }

    #[test]
    fn says_how_to_install_what_is_missing() {
        let error =
            run(Command::new("yosys").env("PATH", "/nowhere"), Duration::from_secs(1)).expect_err("missing");
        let wanted = "yosys is not installed; try: apt-get install -y --no-install-recommends yosys";
        assert_eq!(error.to_string(), wanted);
    }
}
