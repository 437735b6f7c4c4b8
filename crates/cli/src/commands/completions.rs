//! `edgewalk completions`: what a shell needs to complete commands and options.

use crate::Talk;
use crate::document::document;
use crate::verdict::Verdict;
use anyhow::Result;
use clap_complete::Shell;
use serde_json::json;

/// Print the completions of commands and options for a shell.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk completions bash > ~/.local/share/bash-completion/completions/edgewalk
  edgewalk completions fish > ~/.config/fish/completions/edgewalk.fish
  edgewalk completions zsh > ~/.zfunc/_edgewalk")]
pub struct Args {
    /// Shell that reads them
    shell: Shell,
}

/// Runs the command; `program` is the whole command line.
pub fn run(args: &Args, mut program: clap::Command, talk: Talk) -> Result<Verdict> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut program, "edgewalk", &mut text);
    let text = String::from_utf8(text)?;
    // What is asked for is the output itself, so a quiet program prints it too.
    let talk = Talk { quiet: false, ..talk };
    talk.say(
        || document("completions", json!({ "shell": args.shell.to_string(), "text": text })),
        || text.clone(),
    )?;
    Ok(Verdict::Pass)
}
