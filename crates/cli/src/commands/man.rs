//! `edgewalk man`: the manual, a page a command.

use crate::Talk;
use crate::document::document;
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_files::Staging;
use serde_json::json;
use std::path::PathBuf;

/// Write the manual: a page for the program and for each command, as `man` reads them.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk man --out out/man && man -l out/man/edgewalk-render.1
  edgewalk man --out ~/.local/share/man/man1")]
pub struct Args {
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/man")]
    out: PathBuf,
}

/// Runs the command; `program` is the whole command line.
pub fn run(args: &Args, program: clap::Command, talk: Talk) -> Result<Verdict> {
    let mut program = program.name("edgewalk");
    program.build();
    let out = Staging::new(&args.out)?;
    let mut files = Vec::new();
    let mut waiting = vec![program];
    while let Some(command) = waiting.pop() {
        waiting.extend(command.get_subcommands().filter(|sub| sub.get_name() != "help").cloned());
        let page = clap_mangen::Man::new(command);
        let mut text = Vec::new();
        page.render(&mut text)?;
        out.write(&page.get_filename(), text)?;
        files.push(page.get_filename());
    }
    files.sort();
    out.publish(&[""; 0])?;
    talk.say(
        || document("man", json!({ "files": files })),
        || format!("{}\n    {}", args.out.display(), files.join("\n    ")),
    )?;
    Ok(Verdict::Pass)
}
