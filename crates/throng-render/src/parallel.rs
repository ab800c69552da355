//! Work divided over threads. Results do not depend on the division.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// Returns `work(0)` to `work(count - 1)`.
pub fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "parallel")]
    return (0..count).into_par_iter().map(work).collect();
    #[cfg(not(feature = "parallel"))]
    (0..count).map(work).collect()
}

/// Calls `work` with the index of every chunk of `size` items, and the chunk.
pub fn chunks<T: Send>(items: &mut [T], size: usize, work: impl Fn(usize, &mut [T]) + Sync + Send) {
    #[cfg(feature = "parallel")]
    items.par_chunks_mut(size).enumerate().for_each(|(index, chunk)| work(index, chunk));
    #[cfg(not(feature = "parallel"))]
    items.chunks_mut(size).enumerate().for_each(|(index, chunk)| work(index, chunk));
}

/// Calls `work` with the index of every chunk of `size` items of two slices of equal length, and the two chunks.
pub fn pairs<A: Send, B: Send>(
    a: &mut [A],
    b: &mut [B],
    size: usize,
    work: impl Fn(usize, &mut [A], &mut [B]) + Sync + Send,
) {
    #[cfg(feature = "parallel")]
    a.par_chunks_mut(size).zip(b.par_chunks_mut(size)).enumerate().for_each(|(index, (a, b))| work(index, a, b));
    #[cfg(not(feature = "parallel"))]
    a.chunks_mut(size).zip(b.chunks_mut(size)).enumerate().for_each(|(index, (a, b))| work(index, a, b));
}
