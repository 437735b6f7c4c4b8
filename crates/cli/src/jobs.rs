//! Lists of independent jobs over all cores; `RAYON_NUM_THREADS` limits them.

use anyhow::Result;
use indicatif::ProgressBar;
use rayon::prelude::*;

/// Does every job. Results come in the order of the jobs, and of several errors the first one in that order: both are
/// the same for any number of threads.
pub fn all<J: Sync, T: Send>(
    jobs: &[J],
    bar: &ProgressBar,
    work: impl Fn(&J) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let done = jobs.par_iter().with_max_len(1).map(|job| {
        let result = work(job);
        bar.inc(1);
        result
    });
    done.collect::<Vec<_>>().into_iter().collect()
}
