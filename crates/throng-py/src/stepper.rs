//! Several worlds at once.

use crate::inner::Inner;
use crate::threads::Threads;
use crate::world::World;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use std::sync::{Mutex, PoisonError};

/// Threads that step several worlds side by side.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct Stepper {
    threads: Mutex<Threads>,
}

#[pymethods]
impl Stepper {
    /// Prepares this number of threads; 0 stands for the number of cores.
    #[new]
    #[pyo3(signature = (threads=0))]
    fn new(threads: usize) -> Self {
        Self { threads: Mutex::new(Threads::new(threads)) }
    }

    /// Makes `n` steps of each world. Each gets the same bits as alone.
    #[pyo3(signature = (worlds, n=1))]
    fn step(&self, py: Python<'_>, worlds: Vec<Py<World>>, n: u64) -> PyResult<()> {
        use rayon::prelude::*;
        let mut guards = vec![];
        for (k, world) in worlds.iter().enumerate() {
            if worlds[..k].iter().any(|other| other.is(world)) {
                return Err(PyValueError::new_err(format!("world {k} is given twice")));
            }
            let mut guard = world.get().lock(py)?;
            guard.events.clear();
            guard.obey(py)?;
            guards.push(guard);
        }
        let mut inners: Vec<&mut Inner> = guards.iter_mut().map(|guard| &mut **guard).collect();
        let threads = self.threads.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner).start()?;
        let steps = |inner: &mut &mut Inner| {
            for _ in 0..n {
                inner.one_step();
            }
            inner.calls.take().map_or(Ok(()), Err)
        };
        let made: Vec<PyResult<()>> = py.detach(|| threads.install(|| inners.par_iter_mut().map(steps).collect()));
        for inner in &mut inners {
            inner.changed(py)?;
        }
        made.into_iter().collect()
    }
}
