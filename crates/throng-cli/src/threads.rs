//! The threads of steps and runs.

use crate::failure::Failure;

/// Calls `work` with this number of threads for the steps; 0 stands for the number of cores.
///
/// # Errors
/// Those of `work`, or the threads cannot be started.
#[cfg(feature = "parallel")]
pub fn with<T: Send>(threads: usize, work: impl FnOnce() -> Result<T, Failure> + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| Failure::Error(format!("cannot start {threads} threads: {error}")))?;
    pool.install(work)
}

/// Calls `work` directly: this program was built without threads.
///
/// # Errors
/// Those of `work`.
#[cfg(not(feature = "parallel"))]
pub fn with<T>(_threads: usize, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    work()
}

/// Threads that each process one item at a time.
pub struct Workers {
    #[cfg(feature = "parallel")]
    pools: Vec<rayon::ThreadPool>,
}

impl Workers {
    /// Starts this number of threads, but at most `most`, the number of items; 0 stands for the number of cores.
    ///
    /// # Errors
    /// The threads cannot be started.
    #[cfg(feature = "parallel")]
    pub fn new(threads: usize, most: usize) -> Result<Self, Failure> {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = if threads == 0 { cores() } else { threads }.min(most).max(1);
        let pool = |_| rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pools: Result<_, _> = (0..threads).map(pool).collect();
        let pools = pools.map_err(|error| Failure::Error(format!("cannot start {threads} threads: {error}")))?;
        Ok(Self { pools })
    }

    /// Returns the calling thread as the only worker: this program was built without threads.
    ///
    /// # Errors
    /// None.
    #[cfg(not(feature = "parallel"))]
    pub fn new(_threads: usize, _most: usize) -> Result<Self, Failure> {
        Ok(Self {})
    }

    /// Returns the results of `work` for `items`, in their order. Parallel work inside `work` stays on its thread.
    #[cfg(feature = "parallel")]
    pub fn map<I: Send, O: Send>(&self, items: Vec<I>, work: impl Fn(I) -> O + Sync) -> Vec<O> {
        use std::sync::{Mutex, PoisonError};
        let mut results: Vec<Option<O>> = items.iter().map(|_| None).collect();
        let tasks = Mutex::new(items.into_iter().zip(&mut results));
        let next = || tasks.lock().unwrap_or_else(PoisonError::into_inner).next();
        std::thread::scope(|scope| {
            for pool in &self.pools {
                let (next, work) = (&next, &work);
                scope.spawn(move || {
                    pool.install(|| {
                        while let Some((item, result)) = next() {
                            *result = Some(work(item));
                        }
                    });
                });
            }
        });
        drop(tasks);
        results.into_iter().flatten().collect()
    }

    /// Returns the results of `work` for `items`, in their order.
    #[cfg(not(feature = "parallel"))]
    pub fn map<I, O>(&self, items: Vec<I>, work: impl Fn(I) -> O) -> Vec<O> {
        items.into_iter().map(work).collect()
    }
}
