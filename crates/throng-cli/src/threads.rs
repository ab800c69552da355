//! How many threads the steps use.

use crate::failure::Failure;

/// Calls `work` with this many threads for the steps: 0 for as many as there are cores.
///
/// # Errors
/// Those of `work`, or the threads cannot be started.
#[cfg(feature = "parallel")]
pub fn with<T: Send>(threads: usize, work: impl FnOnce() -> Result<T, Failure> + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| Failure::Error(format!("cannot start {threads} threads: {error}")))?;
    pool.install(work)
}

/// Calls `work`: this program was built without threads.
///
/// # Errors
/// Those of `work`.
#[cfg(not(feature = "parallel"))]
pub fn with<T>(_threads: usize, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    work()
}
