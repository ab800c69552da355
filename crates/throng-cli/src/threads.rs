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

/// Threads that each take one thing to do at a time and do all of it.
pub struct Workers {
    #[cfg(feature = "parallel")]
    pools: Vec<rayon::ThreadPool>,
}

impl Workers {
    /// This many threads, 0 for as many as there are cores; not more than there are things to do.
    ///
    /// # Errors
    /// They cannot be started.
    #[cfg(feature = "parallel")]
    pub fn new(threads: usize, most: usize) -> Result<Self, Failure> {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = if threads == 0 { cores() } else { threads }.min(most).max(1);
        let pool = |_| rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pools: Result<_, _> = (0..threads).map(pool).collect();
        let pools = pools.map_err(|error| Failure::Error(format!("cannot start {threads} threads: {error}")))?;
        Ok(Self { pools })
    }

    /// One: this program was built without threads.
    ///
    /// # Errors
    /// None.
    #[cfg(not(feature = "parallel"))]
    pub fn new(_threads: usize, _most: usize) -> Result<Self, Failure> {
        Ok(Self {})
    }

    /// What `work` makes of each of `items`, in their order. Whatever `work` does in parallel stays on its thread.
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

    /// What `work` makes of each of `items`, in their order.
    #[cfg(not(feature = "parallel"))]
    pub fn map<I, O>(&self, items: Vec<I>, work: impl Fn(I) -> O) -> Vec<O> {
        items.into_iter().map(work).collect()
    }
}
