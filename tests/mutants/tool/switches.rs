//! The switches: a module of every crate with faults, in the copy that they are compiled in.

use std::io::Write;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

const UNREAD: u32 = u32::MAX;
const RECORDED: u32 = u32::MAX - 1;
/// The fault that is on, 0 for none, [`RECORDED`] where all are off and those asked for are written down.
static ON: AtomicU32 = AtomicU32::new(UNREAD);
/// A bit for each that is written down; as many as cargo-mutants finds in several such repositories.
static SEEN: [AtomicU64; 1024] = [const { AtomicU64::new(0) }; 1024];

/// Whether this fault is on.
#[inline]
pub fn at(number: u32) -> bool {
    let on = ON.load(Relaxed);
    if on < RECORDED { on == number } else { asked(number) }
}

#[cold]
fn asked(number: u32) -> bool {
    if ON.load(Relaxed) == UNREAD {
        let on = match std::env::var_os("EDGEWALK_FAULTS_REACHED") {
            Some(_) => RECORDED,
            None => std::env::var("EDGEWALK_FAULT").ok().and_then(|on| on.parse().ok()).unwrap_or(0),
        };
        ON.store(on, Relaxed);
        return at(number);
    }
    let bit = 1 << (number % 64);
    if SEEN[number as usize / 64].fetch_or(bit, Relaxed) & bit == 0 {
        let path = std::env::var_os("EDGEWALK_FAULTS_REACHED").unwrap_or_default();
        let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
        // One write, whole even where threads and processes write together.
        file.and_then(|mut file| file.write_all(format!("{number}\n").as_bytes())).expect("what is reached is kept");
    }
    false
}
