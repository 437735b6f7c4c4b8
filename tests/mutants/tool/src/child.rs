//! A command with a limit of time and of memory.

use std::fs::File;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

/// Of each process, in KiB: a fault may ask for all there is.
const MEMORY: u64 = 8 << 20;

/// How a command ended.
#[derive(Debug, PartialEq, Clone, Copy)]
pub enum Ended {
    Passed,
    Failed,
    TimedOut,
    /// From outside: it says nothing.
    Cut,
}

/// Runs a command to its end and gives the time it took; what it writes goes to `log`. It has a folder of its own for
/// temporary files, which is removed. After `limit` it is ended with all that it started, even if this process is gone by then.
pub fn run(
    command: &[&str],
    folder: &Path,
    variables: &[(&str, &str)],
    limit: Duration,
    log: &Path,
) -> Result<(Ended, Duration)> {
    let limit = Duration::from_secs(limit.as_secs() + 1); // as the command that keeps it counts
    let scratch = log.with_extension("tmp");
    std::fs::create_dir_all(&scratch)?;
    let written = File::create(log).with_context(|| log.display().to_string())?;
    let script = format!("ulimit -d {MEMORY} || exit 125; exec timeout -s KILL \"$@\"");
    let mut shell = Command::new("sh");
    shell.args(["-c", &script, "sh", &limit.as_secs().to_string()]).args(command);
    shell.current_dir(folder).env("TMPDIR", &scratch).env_remove("UPDATE_EXPECT");
    shell.envs(variables.iter().copied()).process_group(0);
    shell.stdin(Stdio::null()).stdout(written.try_clone()?).stderr(written);
    let began = Instant::now();
    let mut child = shell.spawn().context("sh")?;
    let status = child.wait()?;
    let took = began.elapsed();
    // By a signal, or as the command that keeps the time tells of one.
    let signal = status.signal().or(status.code().filter(|code| *code > 128).map(|code| code - 128));
    let ended = match (status.code(), signal) {
        (Some(0), _) => Ended::Passed,
        (_, Some(9)) if took >= limit => Ended::TimedOut,
        (_, Some(1 | 2 | 9 | 15)) => Ended::Cut,
        (Some(125..=127), _) => Ended::Cut, // no such command, or no limit can be set
        _ => Ended::Failed,
    };
    if ended != Ended::Passed {
        // A program that a failed test did not wait for.
        let group = format!("-{}", child.id());
        let mut kill = Command::new("sh");
        kill.args(["-c", "kill -KILL -- \"$1\"", "sh", &group]).stderr(Stdio::null()).stdout(Stdio::null());
        kill.status().context("kill")?;
    }
    std::fs::remove_dir_all(&scratch).ok();
    Ok((ended, took))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_it_ended() {
        let log = std::env::temp_dir().join(format!("edgewalk-mutants-child-{}", std::process::id()));
        let ended = |script: &str, millis| {
            let limit = Duration::from_millis(millis);
            run(&["sh", "-c", script], Path::new("/"), &[("A", "3")], limit, &log).expect("it runs").0
        };
        assert_eq!(ended("exit 0", 9000), Ended::Passed);
        assert_eq!(ended("exit $A", 9000), Ended::Failed);
        assert_eq!(ended("kill -ABRT $$", 9000), Ended::Failed);
        assert_eq!(ended("kill -KILL $$", 9000), Ended::Cut);
        assert_eq!(ended("sleep 60 & wait", 1600), Ended::TimedOut);
        std::fs::remove_file(&log).expect("removed");
    }
}
