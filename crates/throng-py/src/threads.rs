//! The threads on which steps run.

use pyo3::PyResult;
use pyo3::exceptions::PyRuntimeError;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::Arc;

/// Threads that belong to a process. After a fork the child starts its own: it has none of its parent's.
pub struct Threads {
    count: usize,
    process: u32,
    pool: Option<Arc<ThreadPool>>,
}

impl Threads {
    /// Prepares this number of threads; 0 stands for the number of cores. They start when they are first used.
    pub fn new(count: usize) -> Self {
        Self { count, process: 0, pool: None }
    }

    /// Returns the number of threads that was asked for.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the threads, and starts them if they do not run.
    ///
    /// # Errors
    /// The threads cannot be started.
    pub fn start(&mut self) -> PyResult<Arc<ThreadPool>> {
        let process = std::process::id();
        if self.process != process {
            // the threads of the parent do not exist here: to end them would wait for ever
            std::mem::forget(self.pool.take());
            self.process = process;
        }
        if let Some(pool) = &self.pool {
            return Ok(pool.clone());
        }
        let count = self.count;
        let built = ThreadPoolBuilder::new().num_threads(count).build();
        let pool = Arc::new(built.map_err(|error| {
            PyRuntimeError::new_err(format!("cannot start {count} threads: {error}; give fewer threads"))
        })?);
        self.pool = Some(pool.clone());
        Ok(pool)
    }
}
