//! Progress bars on long work: on standard error, only for a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A bar over `length` things; hidden when quiet, and by itself when standard error is no terminal.
pub fn bar(length: u64, what: &'static str, quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(Some(length), target);
    if let Ok(style) = ProgressStyle::with_template("{bar:32} {pos}/{len} {msg} {eta}") {
        bar.set_style(style);
    }
    bar.with_message(what)
}

/// `--quiet` was asked for: for signs of life of what every command does.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Shows no sign of life from now on.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// A sign of life while an input is read, which may be large. It goes when it is dropped.
pub fn reading() -> Reading {
    Reading(spinner("reading", QUIET.load(Ordering::Relaxed)))
}

/// An input is being read.
pub struct Reading(ProgressBar);

impl Drop for Reading {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A sign of life beside work whose length is not known; hidden as a bar is.
pub fn spinner(what: &'static str, quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let spinner = ProgressBar::with_draw_target(None, target).with_message(what);
    // A thread ticks, which is needed only where somebody sees it.
    if !spinner.is_hidden() {
        spinner.enable_steady_tick(Duration::from_millis(250));
    }
    spinner
}
