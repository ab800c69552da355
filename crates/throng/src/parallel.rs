//! Running a stage over all agents: on the threads of the current rayon pool, or on this one.
//!
//! Work is divided into contiguous ranges of rows; each writes its own part of the output and reads only the frozen
//! present, so the result does not depend on the division.

use std::ops::Range;

/// Rows a thread takes at a time: a multiple of the lanes of a vector.
#[cfg(feature = "parallel")]
const CHUNK: usize = 256;

/// Calls `work(scratch, rows, out)` for ranges of rows, where `out` is the `stride` elements of `all` of each of them.
pub(crate) fn ranges<T: Send, S>(
    all: &mut [T],
    stride: usize,
    scratch: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, Range<usize>, &mut [T]) + Sync,
) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        if rayon::current_num_threads() > 1 && all.len() > CHUNK * stride {
            all.par_chunks_mut(CHUNK * stride).enumerate().for_each_init(&scratch, |scratch, (chunk, part)| {
                let start = chunk * CHUNK;
                work(scratch, start..start + part.len() / stride, part);
            });
            return;
        }
    }
    work(&mut scratch(), 0..all.len() / stride, all);
}

/// Calls `work(scratch, row, out)` for every row, where `out` is the row's `stride` elements of `all`.
pub(crate) fn rows<T: Send, S>(
    all: &mut [T],
    stride: usize,
    scratch: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) {
    ranges(all, stride, scratch, |scratch, rows, part| {
        for (row, out) in rows.zip(part.chunks_mut(stride)) {
            work(scratch, row, out);
        }
    });
}
