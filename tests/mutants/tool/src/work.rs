//! Two workers at a list.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use anyhow::Result;

const WORKERS: usize = 2;

/// Does the work for every entry: `(worker, entries done with this one, entry)`. The first error ends it.
pub fn both<T: Sync>(list: &[T], work: impl Fn(usize, usize, &T) -> Result<()> + Sync) -> Result<()> {
    let (next, done, stop) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicBool::new(false));
    let one = |worker| -> Result<()> {
        while !stop.load(Relaxed)
            && let Some(entry) = list.get(next.fetch_add(1, Relaxed))
        {
            work(worker, done.fetch_add(1, Relaxed) + 1, entry).inspect_err(|_| stop.store(true, Relaxed))?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..WORKERS).map(|worker| scope.spawn(move || one(worker))).collect();
        let ends = workers
            .into_iter()
            .map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        // All are waited for.
        ends.collect::<Vec<_>>().into_iter().collect()
    })
}

/// A lock; what a panic left is as good as its last whole line.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What the lock held.
pub fn into<T>(mutex: Mutex<T>) -> T {
    mutex.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// The time that is left, as that of those done tells.
pub fn left(began: Instant, done: usize, all: usize) -> String {
    let seconds = began.elapsed().as_secs_f64() / done.max(1) as f64 * all.saturating_sub(done) as f64;
    format!("about {:.0} minutes left", (seconds / 60.0).ceil())
}
