//! Running a stage over all agents: on the threads of the current rayon pool, or on this one.
//!
//! Work is divided into contiguous ranges of rows; each writes its own part of the output and reads only the frozen
//! present, so the result does not depend on the division.

/// Rows a thread takes at a time.
#[cfg(feature = "parallel")]
const CHUNK: usize = 128;

/// Calls `work(scratch, row, out)` for every row, where `out` is the row's `stride` elements of `all`.
pub(crate) fn rows<T: Send, S>(
    all: &mut [T],
    stride: usize,
    scratch: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        if rayon::current_num_threads() > 1 && all.len() > CHUNK * stride {
            all.par_chunks_mut(CHUNK * stride).enumerate().for_each_init(&scratch, |scratch, (chunk, part)| {
                for (at, out) in part.chunks_mut(stride).enumerate() {
                    work(scratch, chunk * CHUNK + at, out);
                }
            });
            return;
        }
    }
    let mut scratch = scratch();
    for (row, out) in all.chunks_mut(stride).enumerate() {
        work(&mut scratch, row, out);
    }
}
